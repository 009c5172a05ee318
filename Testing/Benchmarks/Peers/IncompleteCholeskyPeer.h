#ifndef dmgBenchmarksIncompleteCholeskyPeer_h
#define dmgBenchmarksIncompleteCholeskyPeer_h

#include "Benchmarks/Peers/IterativePeer.h"
#include "Benchmarks/Peers/Peer.h"
#include "Support/SparseKernels.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <vector>

namespace dmg::peers
{

/// An order of small bandwidth: breadth first from an end of each component, neighbours of small
/// degree first, reversed. Cuthill and McKee 1969; George and Liu 1979 for the ends.
/// \return [k] is the unknown at place k.
template <class Scalar>
std::vector<int> ReverseCuthillMcKee(const SparseMatrix<Scalar>& A)
{
  const int size = static_cast<int>(A.rows());
  const int* offsets = A.outerIndexPtr();
  const int* columns = A.innerIndexPtr();
  const auto degree = [offsets](int i) { return offsets[i + 1] - offsets[i]; };
  std::vector<int> order;
  order.reserve(size);
  std::vector<char> isPlaced(size, false);

  // Appends the component of a root; returns where its last layer begins.
  const auto appendComponent = [&](int root)
  {
    std::size_t layer = order.size();
    order.push_back(root);
    isPlaced[root] = true;
    for (std::size_t next = layer; next < order.size();)
    {
      layer = next;
      const std::size_t layerEnd = order.size();
      for (; next < layerEnd; ++next)
      {
        const std::size_t begin = order.size();
        for (int k = offsets[order[next]]; k < offsets[order[next] + 1]; ++k)
        {
          if (!isPlaced[columns[k]])
          {
            isPlaced[columns[k]] = true;
            order.push_back(columns[k]);
          }
        }
        std::sort(order.begin() + begin, order.end(),
          [&degree](int a, int b) { return degree(a) != degree(b) ? degree(a) < degree(b) : a < b; });
      }
    }
    return layer;
  };

  for (int seed = 0; seed < size; ++seed)
  {
    if (isPlaced[seed])
    {
      continue;
    }
    int root = seed;
    for (int attempt = 0; attempt < 3; ++attempt) // the third is kept
    {
      const std::size_t begin = order.size();
      const std::size_t layer = appendComponent(root);
      if (attempt == 2)
      {
        break;
      }
      root = *std::min_element(
        order.begin() + layer, order.end(), [&degree](int a, int b) { return degree(a) < degree(b); });
      for (std::size_t k = begin; k < order.size(); ++k)
      {
        isPlaced[order[k]] = false;
      }
      order.resize(begin);
    }
  }
  std::reverse(order.begin(), order.end());
  return order;
}

/// Incomplete Cholesky factorisation without fill, A = L D L^H + E, where L has a unit diagonal and
/// the pattern of the lower triangle of A, and E vanishes on the pattern of A. Meijerink and van der
/// Vorst 1977. If a pivot is not positive, the diagonal of A is enlarged by a thousandth, then by
/// twice as much, and so on (Manteuffel 1980).
template <class Scalar>
class IncompleteCholesky : public Preconditioner<Scalar>
{
public:
  explicit IncompleteCholesky(const SparseMatrix<Scalar>& A)
    : L(A.template triangularView<Eigen::StrictlyLower>())
    , InverseD(A.rows())
  {
    this->L.makeCompressed();
    while (!this->Factor(A))
    {
      this->RelativeShift = this->RelativeShift == 0.0 ? 1e-3 : 2.0 * this->RelativeShift;
      if (this->RelativeShift > 1.0)
      {
        throw SolverFailure("incomplete Cholesky broke down");
      }
    }
  }

  void Apply(const Vector<Scalar>& r, Vector<Scalar>& z, const ExecutionContext&) override
  {
    const int size = static_cast<int>(this->L.rows());
    const int* offsets = this->L.outerIndexPtr();
    const int* columns = this->L.innerIndexPtr();
    const Scalar* values = this->L.valuePtr();
    z.resize(size);
    for (int i = 0; i < size; ++i)
    {
      z[i] = r[i] - RowTimes(this->L, i, z.data());
    }
    // A row of L is a column of L^H: what is known of z_i is taken from all that come before.
    for (int i = 0; i < size; ++i)
    {
      z[i] *= this->InverseD[i];
    }
    for (int i = size; i-- > 0;)
    {
      const Scalar known = -z[i];
      for (int k = offsets[i]; k < offsets[i + 1]; ++k)
      {
        AddProduct(z[columns[k]], Eigen::numext::conj(values[k]), known);
      }
    }
  }

  const SparseMatrix<Scalar>& Lower() const { return this->L; }
  double Pivot(int i) const { return 1.0 / this->InverseD[i]; }
  double Shift() const { return this->RelativeShift; }

  long long Bytes() const
  {
    return this->L.nonZeros() * static_cast<long long>(sizeof(Scalar) + sizeof(int)) +
      this->L.rows() * static_cast<long long>(sizeof(int) + sizeof(double));
  }

private:
  bool Factor(const SparseMatrix<Scalar>& A)
  {
    const int size = static_cast<int>(A.rows());
    const int* offsets = this->L.outerIndexPtr();
    const int* columns = this->L.innerIndexPtr();
    Scalar* values = this->L.valuePtr();
    std::vector<int> placeOf(size, -1); // where row i has its entry in a column
    std::vector<double> D(size);
    for (int i = 0; i < size; ++i)
    {
      double diagonal = 0.0;
      int next = offsets[i];
      for (typename SparseMatrix<Scalar>::InnerIterator entry(A, i); entry && entry.col() <= i; ++entry)
      {
        if (entry.col() == i)
        {
          diagonal = Eigen::numext::real(entry.value()) * (1.0 + this->RelativeShift);
        }
        else
        {
          placeOf[entry.col()] = next;
          values[next++] = entry.value();
        }
      }
      // Column by column: values[k] holds l_ik d_k, until it is divided by d_k.
      for (int k = offsets[i]; k < offsets[i + 1]; ++k)
      {
        const int column = columns[k];
        Scalar sum = values[k];
        for (int m = offsets[column]; m < offsets[column + 1]; ++m)
        {
          const int place = placeOf[columns[m]];
          if (place >= offsets[i])
          {
            sum -= values[place] * D[columns[m]] * Eigen::numext::conj(values[m]);
          }
        }
        values[k] = sum / D[column];
        diagonal -= Eigen::numext::abs2(values[k]) * D[column];
      }
      if (!(diagonal > 0.0))
      {
        return false;
      }
      D[i] = diagonal;
      this->InverseD[i] = 1.0 / diagonal;
    }
    return true;
  }

  SparseMatrix<Scalar> L; ///< strictly lower
  Vector<double> InverseD;
  double RelativeShift = 0.0;
};

/// Conjugate gradients with incomplete Cholesky in the order of Cuthill and McKee.
template <class Scalar>
class IncompleteCholeskyPeer : public Peer<Scalar>
{
public:
  std::string Name() const override { return "IC(0)-CG, RCM"; }

  void Prepare(const SparseMatrix<Scalar>& matrix) override
  {
    this->Order = ReverseCuthillMcKee(matrix);
    this->Places.resize(this->Order.size());
    for (std::size_t k = 0; k < this->Order.size(); ++k)
    {
      this->Places[this->Order[k]] = static_cast<int>(k);
    }
    SparseMatrix<Scalar> permuted = Permuted(matrix, this->Order, this->Places, SerialContext());
    this->A.swap(permuted);
    this->Factor.emplace(this->A);
  }

  int Solve(const Vector<Scalar>& b, double tolerance, Vector<Scalar>& x) override
  {
    Vector<Scalar> right(b.size());
    for (int k = 0; k < static_cast<int>(b.size()); ++k)
    {
      right[k] = b[this->Order[k]];
    }
    Vector<Scalar> solution;
    const int iterations = SolveIteratively(this->A, *this->Factor, right, tolerance, solution);
    x.resize(b.size());
    for (int i = 0; i < static_cast<int>(b.size()); ++i)
    {
      x[i] = solution[this->Places[i]];
    }
    return iterations;
  }

  long long Bytes() const override
  {
    return this->Factor->Bytes() + this->A.nonZeros() * static_cast<long long>(sizeof(Scalar) + sizeof(int)) +
      3 * this->A.rows() * static_cast<long long>(sizeof(int));
  }

private:
  std::vector<int> Order;
  std::vector<int> Places;
  SparseMatrix<Scalar> A;
  std::optional<IncompleteCholesky<Scalar>> Factor;
};

}

#endif
