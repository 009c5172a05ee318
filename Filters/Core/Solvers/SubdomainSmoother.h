#ifndef dmgSubdomainSmoother_h
#define dmgSubdomainSmoother_h

#include "Solvers/CholeskySolver.h"
#include "Solvers/SchwarzBlocks.h"
#include "Support/ExecutionContext.h"
#include "Support/Types.h"

#include <optional>
#include <vector>

namespace dmg
{

/// Multiplicative Schwarz on subdomains of thousands of unknowns, for a sum of squares, A = B^T B + D with D
/// diagonal. They need not cover all unknowns, and may overlap.
///
/// Where triangles are needles, fields of 1e-9 of the diagonal's energy reach over many of them: too far for
/// the dense blocks of BlockSmoother, and too faint for their single precision. A sparse factor in double
/// precision holds them, in less memory than dense blocks of a tenth of its size. Same bits for any number of
/// threads, as far as those of CholeskySolver.
class SubdomainSmoother
{
public:
  /// All arguments are borrowed and must stay where they are. SetDiagonal comes next.
  /// \param B, Bt the factor and its transpose.
  /// \param subdomains of columns of B, each once and in ascending order; none is empty.
  SubdomainSmoother(
    const SparseMatrix<double>& B, const SparseMatrix<double>& Bt, const UnknownBlocks& subdomains);

  /// A = B^T B + D.
  /// \param D one entry per unknown, >= 0. Infinite: the unknown is zero.
  /// \throw SolverFailure memory ran out.
  /// Cost: a sparse Cholesky factorisation per subdomain; ordered and analysed the first time only.
  void SetDiagonal(const Vector<double>& D, const ExecutionContext& context);

  /// Smooths A x = b from x = 0, once over all subdomains.
  /// \param x, r on exit the result and its residual b - A x; zero where unknowns are held.
  void PreSmooth(const Vector<double>& b, Vector<double>& x, Vector<double>& r,
    const ExecutionContext& context);

  /// Smooths A x = b from the given x, subdomains in the opposite order: the adjoint of PreSmooth.
  /// \pre x is zero where unknowns are held.
  void PostSmooth(const Vector<double>& b, Vector<double>& x, const ExecutionContext& context);

  /// Held by this object.
  long long Bytes() const;

private:
  struct Subdomain
  {
    const int* Unknowns;
    int Size;
    std::optional<CholeskySolver<double>> Factor;
    Vector<double> Residual;
    Vector<double> Step;
  };

  void SortByColour(std::vector<Subdomain> subdomains);
  SparseMatrix<double> MatrixOf(const Subdomain& subdomain) const;
  double ResidualAt(int unknown, const Vector<double>& b, const Vector<double>& x) const;
  void Sweep(
    bool descending, const Vector<double>& b, Vector<double>& x, const ExecutionContext& context);
  /// Solves for the unknowns of one subdomain.
  void Correct(Subdomain& subdomain, const Vector<double>& b, Vector<double>& x);

  const SparseMatrix<double>& B;
  const SparseMatrix<double>& Bt;
  std::vector<Subdomain> Subdomains; ///< colour by colour
  std::vector<int> ColourBegins = { 0 };
  Vector<double> D;
  Vector<double> Bx;
};

}

#endif
