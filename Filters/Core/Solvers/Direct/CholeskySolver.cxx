#include "Solvers/Direct/CholeskySolver.h"

#include "Support/Remedy.h"

#include <cholmod.h>

#include <algorithm>
#include <cassert>
#include <cmath>
#include <mutex>
#include <string>
#include <type_traits>
#include <vector>

#ifdef __linux__
#include <pthread.h>
// CHOLMOD's OpenMP has it, where CHOLMOD uses OpenMP.
extern "C" void omp_set_max_active_levels(int) __attribute__((weak));
#endif

namespace dmg
{

namespace
{

/// A child process has none of its parent's OpenMP threads, but GCC's OpenMP waits for them there. After a fork, CHOLMOD
/// uses one thread.
void UseOneThreadAfterFork()
{
#ifdef __linux__
  static std::once_flag once;
  std::call_once(once,
    []
    {
      if (omp_set_max_active_levels)
      {
        pthread_atfork(nullptr, nullptr, [] { omp_set_max_active_levels(0); });
      }
    });
#endif
}

}

/// CHOLMOD without Eigen's CholmodSupport, which keeps the factor to itself, so that neither its size nor the pivot that
/// failed nor an estimate of the condition could be told, and which allocates solution and workspaces for each
/// solve. It would copy the triangle in 64-bit indices as this does.
template <class Scalar>
class CholeskySolver<Scalar>::Internals
{
public:
  explicit Internals(FillOrdering ordering)
  {
    UseOneThreadAfterFork();
    cholmod_l_start(&this->Common);
    this->Common.print = 0;
#ifdef DMG_NO_GPL
    this->Common.supernodal = CHOLMOD_SIMPLICIAL;
    this->Common.final_ll = true;
#else
    this->Common.supernodal = CHOLMOD_SUPERNODAL;
#endif
    this->Common.quick_return_if_not_posdef = true;
    if (ordering != FillOrdering::Best)
    {
      this->Common.nmethods = 1;
      this->Common.method[0].ordering = ordering == FillOrdering::AMD ? CHOLMOD_AMD : CHOLMOD_METIS;
    }
  }

  ~Internals()
  {
    cholmod_l_free_dense(&this->Solution, &this->Common);
    cholmod_l_free_dense(&this->SolveWork1, &this->Common);
    cholmod_l_free_dense(&this->SolveWork2, &this->Common);
    cholmod_l_free_factor(&this->L, &this->Common);
    cholmod_l_finish(&this->Common);
  }

  Internals(const Internals&) = delete;
  Internals& operator=(const Internals&) = delete;

  /// A matrix of CHOLMOD over arrays of ours.
  struct UpperTriangle
  {
    std::vector<SuiteSparse_long> Offsets;
    std::vector<SuiteSparse_long> Rows;
    std::vector<Scalar> Values;
    cholmod_sparse View = {};
  };

  /// The lower part of row i, conjugated, is the upper part of column i.
  static UpperTriangle UpperTriangleOf(const SparseMatrix<Scalar>& A)
  {
    assert(A.isCompressed() && A.rows() == A.cols());
    UpperTriangle upper;
    const int size = static_cast<int>(A.rows());
    upper.Offsets.reserve(size + 1);
    upper.Rows.reserve((A.nonZeros() + size) / 2);
    upper.Values.reserve((A.nonZeros() + size) / 2);
    upper.Offsets.push_back(0);
    for (int i = 0; i < size; ++i)
    {
      for (typename SparseMatrix<Scalar>::InnerIterator entry(A, i); entry && entry.col() <= i; ++entry)
      {
        upper.Rows.push_back(entry.col());
        upper.Values.push_back(Eigen::numext::conj(entry.value()));
      }
      upper.Offsets.push_back(static_cast<SuiteSparse_long>(upper.Rows.size()));
    }
    upper.View.nrow = upper.View.ncol = size;
    upper.View.nzmax = upper.Rows.size();
    upper.View.p = upper.Offsets.data();
    upper.View.i = upper.Rows.data();
    upper.View.x = upper.Values.data();
    upper.View.stype = 1;
    upper.View.itype = CHOLMOD_LONG;
    upper.View.xtype = Internals::ValueKind;
    upper.View.dtype = CHOLMOD_DOUBLE;
    upper.View.sorted = true;
    upper.View.packed = true;
    return upper;
  }

  /// \return A^-1 b, all columns one after the other, until the next call.
  const Scalar* Solve(const Scalar* b, std::size_t rows, std::size_t columns)
  {
    assert(rows == this->L->n);
    cholmod_dense right = {};
    right.nrow = right.d = rows;
    right.ncol = columns;
    right.nzmax = rows * columns;
    right.x = const_cast<Scalar*>(b); // CHOLMOD reads it and has no const
    right.xtype = Internals::ValueKind;
    right.dtype = CHOLMOD_DOUBLE;
    // CHOLMOD would use its workspaces even where it could not allocate them.
    this->Ensure(this->Solution, rows, columns);
    this->Ensure(this->SolveWork1, rows, columns);
    this->Ensure(this->SolveWork2, std::max<std::size_t>(this->L->maxesize, 1), columns);
    if (!cholmod_l_solve2(CHOLMOD_A, this->L, &right, nullptr, &this->Solution, nullptr, &this->SolveWork1,
          &this->SolveWork2, &this->Common))
    {
      this->ThrowFailure();
    }
    return static_cast<const Scalar*>(this->Solution->x);
  }

  /// \p matrix has room for \p rows times \p columns, as cholmod_solve2 asks for it.
  void Ensure(cholmod_dense*& matrix, std::size_t rows, std::size_t columns)
  {
    if (matrix == nullptr || matrix->nzmax < rows * columns)
    {
      cholmod_l_free_dense(&matrix, &this->Common);
      matrix = cholmod_l_allocate_dense(rows, columns, rows, Internals::ValueKind, &this->Common);
    }
    if (matrix == nullptr)
    {
      this->ThrowFailure();
    }
  }

  void Analyze(UpperTriangle& A)
  {
    this->L = cholmod_l_analyze(&A.View, &this->Common);
    if (this->L == nullptr)
    {
      this->ThrowFailure();
    }
  }

  void Factor(UpperTriangle& A)
  {
    cholmod_l_factorize(&A.View, this->L, &this->Common);
    if (this->Common.status == CHOLMOD_NOT_POSDEF)
    {
      const auto* permutation = static_cast<const SuiteSparse_long*>(this->L->Perm);
      throw NotPositiveDefinite("the matrix is not positive definite: the Cholesky factorisation stopped at unknown " +
        std::to_string(permutation[this->L->minor]));
    }
    if (this->Common.status < CHOLMOD_OK)
    {
      this->ThrowFailure();
    }
  }

  [[noreturn]] void ThrowFailure() const
  {
    if (this->Common.status == CHOLMOD_OUT_OF_MEMORY || this->Common.status == CHOLMOD_TOO_LARGE)
    {
      throw FactorDoesNotFit("the Cholesky factor does not fit into memory; " + TextOf(Remedy::ConjugateGradients) +
        " or " + TextOf(Remedy::FewerTriangles));
    }
    throw UnexpectedFailure("CHOLMOD failed with status " + std::to_string(this->Common.status));
  }

  static constexpr int ValueKind = std::is_same<Scalar, double>::value ? CHOLMOD_REAL : CHOLMOD_COMPLEX;

  // CHOLMOD writes statistics and errors here even when it only reads the factor.
  mutable cholmod_common Common;
  cholmod_factor* L = nullptr;
  cholmod_dense* Solution = nullptr;
  cholmod_dense* SolveWork1 = nullptr;
  cholmod_dense* SolveWork2 = nullptr;
};

template <class Scalar>
CholeskySolver<Scalar>::CholeskySolver(
  const SparseMatrix<Scalar>& A, FillOrdering ordering, const ExecutionContext& context)
  : Internal(std::make_unique<Internals>(ordering))
{
  context.Checkpoint(0.0);
  auto upper = Internals::UpperTriangleOf(A);
  this->Internal->Analyze(upper);
  context.Checkpoint(0.3);
  this->Internal->Factor(upper);
}

template <class Scalar>
CholeskySolver<Scalar>::~CholeskySolver() = default;
template <class Scalar>
CholeskySolver<Scalar>::CholeskySolver(CholeskySolver&&) noexcept = default;
template <class Scalar>
CholeskySolver<Scalar>& CholeskySolver<Scalar>::operator=(CholeskySolver&&) noexcept = default;

template <class Scalar>
void CholeskySolver<Scalar>::Update(const SparseMatrix<Scalar>& A)
{
  assert(A.rows() == this->NumberOfUnknowns());
  auto upper = Internals::UpperTriangleOf(A);
  this->Internal->Factor(upper);
}

template <class Scalar>
void CholeskySolver<Scalar>::Solve(const Vector<Scalar>& b, Vector<Scalar>& x)
{
  x = Eigen::Map<const Vector<Scalar>>(this->Internal->Solve(b.data(), b.size(), 1), b.size());
}

template <class Scalar>
void CholeskySolver<Scalar>::Solve(const Columns& b, Columns& x)
{
  x = Eigen::Map<const Columns>(this->Internal->Solve(b.data(), b.rows(), b.cols()), b.rows(), b.cols());
}

template <class Scalar>
int CholeskySolver<Scalar>::NumberOfUnknowns() const
{
  return static_cast<int>(this->Internal->L->n);
}

template <class Scalar>
long long CholeskySolver<Scalar>::NonZeros() const
{
  const cholmod_factor& L = *this->Internal->L;
  return static_cast<long long>(L.is_super ? L.xsize : L.nzmax);
}

template <class Scalar>
long long CholeskySolver<Scalar>::Bytes() const
{
  const cholmod_factor& L = *this->Internal->L;
  const std::size_t indices = L.is_super ? 2 * L.n + 4 * (L.nsuper + 1) + L.ssize : 6 * L.n + L.nzmax;
  return this->NonZeros() * sizeof(Scalar) + indices * sizeof(SuiteSparse_long);
}

template <class Scalar>
double CholeskySolver<Scalar>::ReciprocalCondition() const
{
  return cholmod_l_rcond(this->Internal->L, &this->Internal->Common);
}

template class CholeskySolver<double>;
template class CholeskySolver<Complex>;

}
