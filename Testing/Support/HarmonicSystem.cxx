#include "Support/HarmonicSystem.h"

#include "Solvers/Krylov/EnergiesOfSpace.h"
#include "Support/AllIndices.h"

#include <Eigen/QR>

#include <algorithm>
#include <cassert>
#include <utility>

namespace dmg
{

namespace
{

/// Unknowns that are connected with one of \p seeds through the entries of a matrix.
template <class Scalar>
std::vector<char> ReachedFrom(const std::vector<int>& seeds, const SparseMatrix<Scalar>& matrix)
{
  std::vector<char> reached(matrix.rows(), 0);
  std::vector<int> stack = seeds;
  for (int seed : seeds)
  {
    reached[seed] = 1;
  }
  while (!stack.empty())
  {
    const int row = stack.back();
    stack.pop_back();
    for (typename SparseMatrix<Scalar>::InnerIterator entry(matrix, row); entry; ++entry)
    {
      if (!reached[entry.col()] && entry.value() != Scalar(0))
      {
        reached[entry.col()] = 1;
        stack.push_back(static_cast<int>(entry.col()));
      }
    }
  }
  return reached;
}

/// The entries of some rows in the columns whose new number is not negative.
/// \param columnNumbers ascending where not negative.
template <class Scalar>
SparseMatrix<Scalar> Submatrix(const SparseMatrix<Scalar>& matrix, const std::vector<int>& rows,
  const std::vector<int>& columnNumbers, int numberOfColumns)
{
  SparseMatrix<Scalar> part(static_cast<int>(rows.size()), numberOfColumns);
  Eigen::Index size = 0;
  for (int row : rows)
  {
    for (typename SparseMatrix<Scalar>::InnerIterator entry(matrix, row); entry; ++entry)
    {
      size += columnNumbers[entry.col()] >= 0 ? 1 : 0;
    }
  }
  part.resizeNonZeros(size);
  int end = 0;
  for (std::size_t i = 0; i < rows.size(); ++i)
  {
    part.outerIndexPtr()[i] = end;
    for (typename SparseMatrix<Scalar>::InnerIterator entry(matrix, rows[i]); entry; ++entry)
    {
      if (columnNumbers[entry.col()] >= 0)
      {
        part.innerIndexPtr()[end] = columnNumbers[entry.col()];
        part.valuePtr()[end] = entry.value();
        ++end;
      }
    }
  }
  part.outerIndexPtr()[rows.size()] = end;
  return part;
}

/// What a vector has in common with some orthonormal fields goes.
template <class Scalar>
void RemoveParts(const Eigen::MatrixXd& fields, Vector<Scalar>& x)
{
  if (fields.cols() > 0)
  {
    const Vector<Scalar> parts = fields.transpose().cast<Scalar>() * x;
    x -= fields.cast<Scalar>() * parts;
  }
}

}

template <class Scalar>
HarmonicSystem<Scalar> HarmonicSystem<Scalar>::Soft(
  SparseMatrix<Scalar> smoothness, const Vector<double>& mass, std::vector<int> prescribed, Vector<double> alignment)
{
  return HarmonicSystem(smoothness, mass, std::move(prescribed), std::move(alignment), false);
}

template <class Scalar>
HarmonicSystem<Scalar> HarmonicSystem<Scalar>::Hard(
  SparseMatrix<Scalar> smoothness, const Vector<double>& mass, std::vector<int> prescribed)
{
  return HarmonicSystem(smoothness, mass, std::move(prescribed), {}, true);
}

template <class Scalar>
HarmonicSystem<Scalar> HarmonicSystem<Scalar>::Make(
  SparseMatrix<Scalar> smoothness, const Vector<double>& mass, Penalties prescribed)
{
  return HarmonicSystem(smoothness, mass, std::move(prescribed.Unknowns), std::move(prescribed.Alignment),
    prescribed.Kind == ConstraintKind::Hard);
}

template <class Scalar>
HarmonicSystem<Scalar>::HarmonicSystem(HarmonicSystem&& other) noexcept
{
  *this = std::move(other);
}

template <class Scalar>
HarmonicSystem<Scalar>& HarmonicSystem<Scalar>::operator=(HarmonicSystem&& other) noexcept
{
  this->IsHard = other.IsHard;
  this->Prescribed.swap(other.Prescribed);
  this->Alignment.swap(other.Alignment);
  this->Free.swap(other.Free);
  this->Rows.swap(other.Rows);
  this->Unreached = other.Unreached;
  this->A.swap(other.A);
  this->ToPrescribed.swap(other.ToPrescribed);
  this->M.swap(other.M);
  this->Undetermined.swap(other.Undetermined);
  this->KernelSize = other.KernelSize;
  return *this;
}

template <class Scalar>
HarmonicSystem<Scalar>::HarmonicSystem(SparseMatrix<Scalar>& smoothness, const Vector<double>& mass,
  std::vector<int> prescribed, Vector<double> alignment, bool isHard)
  : IsHard(isHard)
  , Prescribed(std::move(prescribed))
  , Alignment(std::move(alignment))
{
  const int numberOfUnknowns = static_cast<int>(smoothness.rows());
  const int numberOfPrescribed = static_cast<int>(this->Prescribed.size());
  assert(smoothness.cols() == numberOfUnknowns && mass.size() == numberOfUnknowns);
  assert(this->IsHard || this->Alignment.size() == numberOfPrescribed);
  smoothness.makeCompressed();

  std::vector<int> seeds;
  for (int b = 0; b < numberOfPrescribed; ++b)
  {
    if (this->IsHard || this->Alignment[b] > 0.0)
    {
      seeds.push_back(this->Prescribed[b]);
    }
  }
  std::vector<char> isFree = ReachedFrom(seeds, smoothness);
  for (int i = 0; i < numberOfUnknowns; ++i)
  {
    this->Unreached += isFree[i] ? 0 : 1;
  }
  if (this->IsHard)
  {
    for (int unknown : this->Prescribed)
    {
      isFree[unknown] = 0;
    }
  }

  this->Rows.assign(numberOfUnknowns, -1);
  this->Free.reserve(numberOfUnknowns);
  for (int i = 0; i < numberOfUnknowns; ++i)
  {
    if (isFree[i])
    {
      this->Rows[i] = this->NumberOfFree();
      this->Free.push_back(i);
    }
  }
  this->M.resize(this->NumberOfFree());
  for (int row = 0; row < this->NumberOfFree(); ++row)
  {
    this->M[row] = mass[this->Free[row]];
  }

  if (this->IsHard)
  {
    std::vector<int> prescribedNumbers(numberOfUnknowns, -1);
    for (int b = 0; b < numberOfPrescribed; ++b)
    {
      prescribedNumbers[this->Prescribed[b]] = b;
    }
    this->ToPrescribed = Submatrix(smoothness, this->Free, prescribedNumbers, numberOfPrescribed);
  }

  if (this->NumberOfFree() == numberOfUnknowns)
  {
    this->A.swap(smoothness);
  }
  else
  {
    SparseMatrix<Scalar> ofFree = Submatrix(smoothness, this->Free, this->Rows, this->NumberOfFree());
    this->A.swap(ofFree);
  }
  if (!this->IsHard)
  {
    for (int b = 0; b < numberOfPrescribed; ++b)
    {
      const int row = this->Rows[this->Prescribed[b]];
      if (row >= 0)
      {
        this->A.coeffRef(row, row) += this->Alignment[b];
      }
    }
    this->A.makeCompressed();
  }
}

template <class Scalar>
void HarmonicSystem<Scalar>::LeaveOutUndetermined(const Eigen::MatrixXd& kernel)
{
  this->KernelSize = static_cast<int>(kernel.cols());
  const Eigen::MatrixXd ofFree = kernel(this->Free, All);
  const auto fields = ofFree.cast<Scalar>();
  const Eigen::MatrixXd energies = (fields.transpose() * (this->A * fields)).real();
  const Vector<double> diagonal = this->A.diagonal().real();
  const double largest = (ofFree.cwiseAbs2().transpose() * diagonal).maxCoeff();
  this->Undetermined = EnergiesOfSpace(ofFree, energies, largest).Undetermined();
  if (this->Undetermined.cols() == 0)
  {
    return;
  }
  // As many entries of the diagonal are doubled as there are such fields U, in rows where these are
  // independent. They make A definite, and change no solution: as U^T b = 0 and U^T A = 0, what is added
  // to the equations has no part in U, so it is zero, and the unknowns of these rows are.
  const Eigen::ColPivHouseholderQR<Eigen::MatrixXd> pivots(this->Undetermined.transpose());
  for (int k = 0; k < this->NumberOfUndetermined(); ++k)
  {
    const int row = pivots.colsPermutation().indices()[k];
    this->A.coeffRef(row, row) += diagonal[row];
  }
}

template <class Scalar>
Vector<Scalar> HarmonicSystem<Scalar>::RightHandSide(const Vector<Scalar>& values) const
{
  assert(values.size() == static_cast<Eigen::Index>(this->Prescribed.size()));
  Vector<Scalar> right = Vector<Scalar>::Zero(this->NumberOfFree());
  if (this->IsHard)
  {
    right = -(this->ToPrescribed * values);
  }
  else
  {
    for (std::size_t b = 0; b < this->Prescribed.size(); ++b)
    {
      const int row = this->Rows[this->Prescribed[b]];
      if (row >= 0)
      {
        right[row] = this->Alignment[b] * values[b];
      }
    }
  }
  RemoveParts(this->Undetermined, right);
  return right;
}

template <class Scalar>
Vector<Scalar> HarmonicSystem<Scalar>::Restrict(const Vector<Scalar>& all) const
{
  assert(all.size() == this->NumberOfUnknowns());
  Vector<Scalar> part(this->NumberOfFree());
  for (int row = 0; row < this->NumberOfFree(); ++row)
  {
    part[row] = all[this->Free[row]];
  }
  return part;
}

template <class Scalar>
Vector<Scalar> HarmonicSystem<Scalar>::Expand(const Vector<Scalar>& solution, const Vector<Scalar>& values) const
{
  assert(solution.size() == this->NumberOfFree());
  Vector<Scalar> all = Vector<Scalar>::Zero(this->NumberOfUnknowns());
  Vector<Scalar> determined = solution;
  RemoveParts(this->Undetermined, determined);
  for (int row = 0; row < this->NumberOfFree(); ++row)
  {
    all[this->Free[row]] = determined[row];
  }
  if (this->IsHard)
  {
    for (std::size_t b = 0; b < this->Prescribed.size(); ++b)
    {
      all[this->Prescribed[b]] = values[b];
    }
  }
  return all;
}

template class HarmonicSystem<double>;
template class HarmonicSystem<Complex>;

}
