#ifndef dmgSingleProlongation_h
#define dmgSingleProlongation_h

#include "Support/ExecutionContext.h"
#include "Support/Types.h"

namespace dmg
{

/// A planar prolongation, or one of complex numbers, in single precision: rows of 12 bytes per entry, which both products
/// read. The adjoint sums the rows of a fixed number of parts, each into a vector of its own, and then the parts, so
/// that bits do not depend on the number of threads.
///
/// Sliced rows of fewer bytes per entry cost more to pack than they gain.
class SingleProlongation
{
public:
  SingleProlongation() = default;
  /// \param matrix compressed; it comes back empty.
  explicit SingleProlongation(SparseMatrix<Complex32>&& matrix);
  /// Eigen 3.4 would copy the matrix.
  SingleProlongation(SingleProlongation&& other) noexcept { this->P.swap(other.P); }
  SingleProlongation& operator=(SingleProlongation&& other) noexcept
  {
    this->P.swap(other.P);
    return *this;
  }

  const SparseMatrix<Complex32>& Matrix() const { return this->P; }
  int Rows() const { return static_cast<int>(this->P.rows()); }
  /// Plane vectors.
  int Columns() const { return static_cast<int>(this->P.cols()); }
  long long NonZeros() const { return this->P.nonZeros(); }

  /// x += P z.
  /// \param z components, two per column.
  void AddProduct(const Vector<double>& z, Vector<double>& x, const ExecutionContext& context) const;
  /// The same with P as a complex matrix.
  void AddProduct(const Vector<Complex>& z, Vector<Complex32>& x, const ExecutionContext& context) const;

  /// The number of numbers that MultiplyAdjoint needs room for.
  Eigen::Index SizeOfSums() const { return Eigen::Index(2) * NumberOfParts * this->Columns(); }

  /// z = P^T x.
  /// \param sums room for the sums of the parts.
  void MultiplyAdjoint(
    const Vector<double>& x, Vector<double>& z, Vector<double>& sums, const ExecutionContext& context) const;
  /// z = P^H x with P as a complex matrix.
  void MultiplyAdjoint(
    const Vector<Complex32>& x, Vector<Complex>& z, Vector<float>& sums, const ExecutionContext& context) const;

  SparseMatrix<Complex32> SelectedRows(const std::vector<int>& rows, const ExecutionContext& context) const;

  /// Held by this object.
  long long Bytes() const;

private:
  static constexpr int NumberOfParts = 16;

  /// Calls add(row, column, entry, sums of the part) for all entries, part by part, and then sum(column, value of
  /// its first component, of its second) for all columns.
  template <class Real, class Add, class Sum>
  void SumParts(Vector<Real>& sums, const ExecutionContext& context, const Add& add, const Sum& sum) const;

  SparseMatrix<Complex32> P;
};

}

#endif
