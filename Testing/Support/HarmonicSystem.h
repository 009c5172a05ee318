#ifndef dmgHarmonicSystem_h
#define dmgHarmonicSystem_h

#include "Solvers/Penalties.h"
#include "Support/Types.h"

#include <string>
#include <vector>

namespace dmg
{

/// The linear system of a smoothest field, for every discretisation:
///
///   soft  argmin  x^H L x + sum_b m_b |x_b - y_b|^2
///   hard  argmin  x^H L x  subject to  x_b = y_b
///
/// over all unknowns x, with prescribed values y_b for some of them. The system is reduced to its
/// free unknowns,
///
///   soft  A = L + I_b^T m I_b,  right-hand side m_b y_b
///   hard  A = L_ff,             right-hand side -L_fb y
///
/// where unknowns that no prescription reaches through L are not free but zero, the least of their
/// equal minimisers; so A is Hermitian positive definite, as far as L is definite on whatever
/// reaches a prescription.
///
/// A depends on which unknowns are prescribed and how strongly; the values y enter only the
/// right-hand side. Scalar is Complex for power fields (one unknown per face), double for 1-forms
/// (one per edge) and face fields (two per face).
template <class Scalar>
class HarmonicSystem
{
public:
  /// Soft constraints.
  /// \param smoothness L, n x n, Hermitian positive semi-definite, its weight included.
  /// \param mass M, n, positive: the inner product that errors are measured in.
  /// \param prescribed unknowns, ascending, each once.
  /// \param alignment m_b, one per prescribed unknown, >= 0, its weight included. A prescription
  /// with m_b = 0 holds nothing.
  /// Cost: linear in the entries of L.
  static HarmonicSystem Soft(
    SparseMatrix<Scalar> smoothness, const Vector<double>& mass, std::vector<int> prescribed, Vector<double> alignment);

  /// Hard constraints; parameters as above.
  static HarmonicSystem Hard(SparseMatrix<Scalar> smoothness, const Vector<double>& mass, std::vector<int> prescribed);

  /// Either, as the prescription says.
  static HarmonicSystem Make(SparseMatrix<Scalar> smoothness, const Vector<double>& mass, Penalties prescribed);

  /// Eigen 3.4 would copy the matrices.
  HarmonicSystem(HarmonicSystem&& other) noexcept;
  HarmonicSystem& operator=(HarmonicSystem&& other) noexcept;

  /// Takes fields out of the system that have no energy and that no prescription determines: A would be
  /// singular. The solution has no part in them.
  /// \param kernel fields without energy, one value per unknown, a column each, orthonormal.
  /// Cost: a product with A per field.
  void LeaveOutUndetermined(const Eigen::MatrixXd& kernel);
  /// How many have been left out, and of how many.
  int NumberOfUndetermined() const { return static_cast<int>(this->Undetermined.cols()); }
  int SizeOfKernel() const { return this->KernelSize; }

  /// A, Hermitian; #free x #free.
  const SparseMatrix<Scalar>& Matrix() const { return this->A; }

  /// Diagonal of the mass M of the free unknowns. Errors are |x - reference|_M / |reference|_M.
  /// Thesis, section 6.4.
  const Vector<double>& Mass() const { return this->M; }

  int NumberOfUnknowns() const { return static_cast<int>(this->Rows.size()); }
  int NumberOfFree() const { return static_cast<int>(this->Free.size()); }
  /// Unknowns that are zero because no prescription reaches them.
  int NumberOfUnreached() const { return this->Unreached; }

  /// The unknown of each row of A, ascending.
  const std::vector<int>& FreeUnknowns() const { return this->Free; }
  /// The row of A of each unknown, -1 where it is not free.
  const std::vector<int>& RowsOfUnknowns() const { return this->Rows; }

  /// \param values y, one per prescribed unknown.
  /// \return #free.
  Vector<Scalar> RightHandSide(const Vector<Scalar>& values) const;

  /// The free unknowns among all.
  Vector<Scalar> Restrict(const Vector<Scalar>& all) const;

  /// All unknowns from a solution of A x = RightHandSide(values).
  Vector<Scalar> Expand(const Vector<Scalar>& solution, const Vector<Scalar>& values) const;

private:
  /// \param smoothness is used up.
  HarmonicSystem(SparseMatrix<Scalar>& smoothness, const Vector<double>& mass, std::vector<int> prescribed,
    Vector<double> alignment, bool isHard);

  bool IsHard = false;
  std::vector<int> Prescribed;
  Vector<double> Alignment; // soft: m_b
  std::vector<int> Free;    // free -> all
  std::vector<int> Rows;    // all -> free or -1
  int Unreached = 0;
  SparseMatrix<Scalar> A;            // free x free
  SparseMatrix<Scalar> ToPrescribed; // hard: L_fb, free x prescribed
  Vector<double> M;                  // free
  Eigen::MatrixXd Undetermined;      // free, orthonormal
  int KernelSize = 0;
};

extern template class HarmonicSystem<double>;
extern template class HarmonicSystem<Complex>;

}

#endif
