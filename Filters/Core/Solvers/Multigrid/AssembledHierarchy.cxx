#include "Solvers/Multigrid/AssembledHierarchy.h"

#include "Solvers/Direct/ShiftedFactor.h"
#include "Solvers/Kernels/SparseDiagonal.h"
#include "Solvers/Multigrid/GalerkinCycle.h"
#include "Solvers/Multigrid/MatrixPlusDiagonal.h"
#include "Support/CountingSort.h"
#include "Support/DisjointSets.h"
#include "Support/Permutations.h"
#include "Support/SparseAssembly.h"
#include "Support/SparseKernels.h"

#include <cmath>
#include <optional>
#include <utility>

namespace dmg
{
namespace
{

/// The rows of a matrix that D leaves free.
template <class Scalar>
class FreeRows
{
public:
  FreeRows(const Vector<double>& D, const ExecutionContext& context)
    : Unknowns(static_cast<int>(D.size()))
    , Numbers(Choose(
        static_cast<int>(D.size()) / PartsOf<Scalar>, [&D](int row) { return std::isfinite(D[PartsOf<Scalar> * row]); },
        context))
  {
  }

  bool AreAll() const { return PartsOf<Scalar> * this->Size() == this->Unknowns; }
  int Size() const { return static_cast<int>(this->Numbers.size()); }
  const std::vector<int>& Rows() const { return this->Numbers; }
  bool operator==(const FreeRows& other) const { return this->Numbers == other.Numbers; }

  Vector<Scalar> Restricted(const Vector<double>& all) const
  {
    return Eigen::Map<const Vector<Scalar>>(AsRows<Scalar>(all), all.size() / PartsOf<Scalar>)(this->Numbers);
  }

  /// Zero elsewhere.
  Vector<double> Expanded(const Vector<Scalar>& part) const
  {
    Vector<double> all = Vector<double>::Zero(this->Unknowns);
    Eigen::Map<Vector<Scalar>>(AsRows<Scalar>(all), this->Unknowns / PartsOf<Scalar>)(this->Numbers) = part;
    return all;
  }

  /// The free part of R + D; its pattern has the whole diagonal.
  SparseMatrix<Scalar> Matrix(const SparseMatrix<Scalar>& R, const Vector<double>& D) const;

  std::vector<SparseMatrix<Scalar>> Prolongations(
    const std::vector<SparseMatrix<Scalar>>& all, const ExecutionContext& context) const
  {
    std::vector<SparseMatrix<Scalar>> ofFree = all;
    if (!all.empty() && !this->AreAll())
    {
      ofFree[0] = SelectRows(all[0], this->Numbers, context);
    }
    return ofFree;
  }

private:
  int Unknowns; ///< of all rows
  std::vector<int> Numbers;
};

template <class Scalar>
SparseMatrix<Scalar> FreeRows<Scalar>::Matrix(const SparseMatrix<Scalar>& R, const Vector<double>& D) const
{
  std::vector<int> columns(R.cols(), -1);
  const int size = static_cast<int>(this->Numbers.size());
  for (int i = 0; i < size; ++i)
  {
    columns[this->Numbers[i]] = i;
  }
  SparseMatrix<Scalar> A(size, size);
  A.reserve(R.nonZeros() + size);
  for (int i = 0; i < size; ++i)
  {
    const int row = this->Numbers[i];
    const double penalty = D[PartsOf<Scalar> * row];
    bool hasDiagonal = false;
    A.startVec(i);
    for (typename SparseMatrix<Scalar>::InnerIterator entry(R, row); entry; ++entry)
    {
      const int column = columns[entry.col()];
      if (column >= i && !hasDiagonal)
      {
        hasDiagonal = true;
        A.insertBack(i, i) = column == i ? entry.value() + penalty : Scalar(penalty);
      }
      if (column >= 0 && column != i)
      {
        A.insertBack(i, column) = entry.value();
      }
    }
    if (!hasDiagonal)
    {
      A.insertBack(i, i) = penalty;
    }
  }
  A.finalize();
  return A;
}

/// B^T (B x) + D x.
class FactoredOperator : public StiffnessOperator
{
public:
  FactoredOperator(const SparseMatrix<double>& factor, const ExecutionContext& context)
    : B(factor)
    , Bt(Adjoint(factor, context))
  {
  }

  int Size() const override { return static_cast<int>(this->B.cols()); }

  void SetDiagonal(const Vector<double>& diagonal, const ExecutionContext& context) override
  {
    this->D = SparseDiagonal(diagonal, context);
  }

  double Apply(const Vector<double>& x, Vector<double>& y, const ExecutionContext& context) const override
  {
    Multiply(this->B, x, this->Product, context);
    Multiply(this->Bt, this->Product, y, context);
    return SquaredNorm(this->Product, context) + this->D.AddProduct(x, y, context);
  }

private:
  const SparseMatrix<double>& B;
  const SparseMatrix<double> Bt;
  SparseDiagonal D;
  mutable Vector<double> Product; ///< B x
};

template <class Scalar>
class AssembledCycle : public StiffnessCycle
{
public:
  /// \param isFactored whether to factor although there are coarse levels.
  AssembledCycle(const AssembledHierarchy<Scalar>& hierarchy, const Vector<double>& D,
    const StiffnessCycleOptions& options, bool isFactored, const ExecutionContext& context)
    : Fine(hierarchy)
    , Options(options)
    , IsFactored(isFactored || hierarchy.Prolongations().empty())
    , Free(D, context)
  {
    this->Build(D, context);
  }

  void Update(const Vector<double>& D, const ExecutionContext& context) override
  {
    const FreeRows<Scalar> free(D, context);
    if (!(free == this->Free))
    {
      this->Free = free;
      this->Factor.reset();
      this->Cycle.reset();
      this->Build(D, context);
      return;
    }
    SparseMatrix<Scalar> A = this->Free.Matrix(this->Fine.Matrix(), D);
    context.Checkpoint(0.2);
    if (this->Factor)
    {
      this->Factor->Update(A);
    }
    else
    {
      this->Cycle->Update(std::move(A), PartOfContext(context, 0.2, 1.0));
    }
  }

  void Apply(const Vector<double>& r, Vector<double>& z, const ExecutionContext& context) override
  {
    Vector<Scalar> solution;
    const Vector<Scalar> residual = this->Free.Restricted(r);
    if (this->Factor)
    {
      this->Factor->Apply(residual, solution, context);
    }
    else
    {
      this->Cycle->Apply(residual, solution, context);
    }
    z = this->Free.Expanded(solution);
  }

  std::vector<LevelReport> Levels() const override
  {
    return this->Factor ? std::vector<LevelReport>{ { this->Free.Size(), this->Factor->NonZeros() } }
                        : this->Cycle->Levels();
  }
  long long Bytes() const override { return this->Factor ? this->Factor->Bytes() : this->Cycle->Bytes(); }

private:
  void Build(const Vector<double>& D, const ExecutionContext& context)
  {
    SparseMatrix<Scalar> A = this->Free.Matrix(this->Fine.Matrix(), D);
    context.Checkpoint(0.2);
    if (this->IsFactored)
    {
      this->Factor.emplace(A);
      return;
    }
    CycleOptions cycle;
    cycle.Smoothing = this->Options.Coarse.Smoothing;
    cycle.Repetitions = this->Options.CyclesInARow;
    cycle.FinestFactor = this->Options.Sweeps / cycle.Smoothing.PreSweeps;
    this->Cycle.emplace(std::move(A), this->Free.Prolongations(this->Fine.Prolongations(), context),
      this->Options.Coarsening, cycle, PartOfContext(context, 0.2, 1.0));
  }

  const AssembledHierarchy<Scalar>& Fine;
  const StiffnessCycleOptions Options;
  const bool IsFactored;
  FreeRows<Scalar> Free;
  std::optional<ShiftedFactor<Scalar>> Factor; ///< or
  std::optional<GalerkinCycle<Scalar>> Cycle;
};

template <class Scalar>
class AssembledNestedIteration : public StiffnessNestedIteration
{
public:
  AssembledNestedIteration(const AssembledHierarchy<Scalar>& hierarchy, const Vector<double>& D,
    const NestedOptions& options, const ExecutionContext& context)
    : Free(D, context)
    , A(this->Free.Matrix(hierarchy.Matrix(), D))
    , Nested(A, this->Free.Prolongations(hierarchy.Prolongations(), context), options, context)
  {
  }

  void Solve(const Vector<double>& b, const SweepOptions& sweeps, Vector<double>& x, SolveReport& report,
    const ExecutionContext& context, const ConvergenceMeasure<double>& measure) override
  {
    const Vector<double> mass = (*measure.Mass)(this->Free.Rows()); // one per row
    ConvergenceMeasure<Scalar> ofFree;
    ofFree.EnergyConstant = measure.EnergyConstant;
    ofFree.EnergyScale = measure.EnergyScale;
    ofFree.Mass = &mass;
    Vector<Scalar> offset;
    Vector<Scalar> rightHandSide;
    if (measure.Offset)
    {
      offset = this->Free.Restricted(*measure.Offset);
      rightHandSide = this->Free.Restricted(*measure.RightHandSide);
      ofFree.Offset = &offset;
      ofFree.RightHandSide = &rightHandSide;
    }
    if (measure.Reference.size() > 0)
    {
      ofFree.Reference = this->Free.Restricted(measure.Reference);
      ofFree.LeastImprovement = measure.LeastImprovement;
    }
    Vector<Scalar> solution;
    this->Nested.Solve(this->Free.Restricted(b), sweeps, solution, report, context, &ofFree);
    x = this->Free.Expanded(solution);
  }

  std::vector<LevelReport> Levels() const override { return this->Nested.Levels(); }
  long long Bytes() const override { return this->Nested.Bytes(); }

private:
  const FreeRows<Scalar> Free;
  const SparseMatrix<Scalar> A;
  NestedIteration<Scalar> Nested;
};

}

template <class Scalar>
AssembledHierarchy<Scalar>::AssembledHierarchy(
  SparseMatrix<Scalar>& matrix, std::vector<SparseMatrix<Scalar>> prolongations, SparseMatrix<double> factor)
  : P(std::move(prolongations))
{
  this->R.swap(matrix); // Eigen 3.4 would copy what is moved
  this->B.swap(factor);
  this->Diagonal = this->R.diagonal().real();
  this->Order = Identity(PartsOf<Scalar> * static_cast<int>(this->R.rows()));
  const std::vector<int> ofRows = ConnectedColumns(this->R);
  std::vector<int> components(this->Order.size());
  for (std::size_t unknown = 0; unknown < components.size(); ++unknown)
  {
    components[unknown] = ofRows[unknown / PartsOf<Scalar>];
  }
  this->SetComponents(std::move(components));
}

template <class Scalar>
double AssembledHierarchy<Scalar>::DiagonalOf(int unknown) const
{
  return this->Diagonal[unknown / PartsOf<Scalar>];
}

template <class Scalar>
SparseMatrix<double> AssembledHierarchy<Scalar>::RealMatrix(const ExecutionContext& context) const
{
  return OnRealUnknowns(this->R, context);
}

template <class Scalar>
std::unique_ptr<StiffnessOperator> AssembledHierarchy<Scalar>::Operator() const
{
  if (this->B.rows() > 0)
  {
    return std::make_unique<FactoredOperator>(this->B, SerialContext());
  }
  return std::make_unique<MatrixPlusDiagonal<Scalar>>(this->R);
}

template <class Scalar>
std::unique_ptr<StiffnessCycle> AssembledHierarchy<Scalar>::Cycle(
  const Vector<double>& D, const StiffnessCycleOptions& options, const ExecutionContext& context) const
{
  return std::make_unique<AssembledCycle<Scalar>>(*this, D, options, false, context);
}

template <class Scalar>
std::unique_ptr<Preconditioner<double>> AssembledHierarchy<Scalar>::Factor(
  const Vector<double>& D, const ExecutionContext& context) const
{
  return std::make_unique<AssembledCycle<Scalar>>(*this, D, StiffnessCycleOptions(), true, context);
}

template <class Scalar>
std::unique_ptr<StiffnessNestedIteration> AssembledHierarchy<Scalar>::NestedIterations(
  const Vector<double>& D, const StiffnessCycleOptions& options, bool maySweep, const ExecutionContext& context) const
{
  return std::make_unique<AssembledNestedIteration<Scalar>>(
    *this, D, NestedOptions{ options.Coarsening, maySweep }, context);
}

template <class Scalar>
long long AssembledHierarchy<Scalar>::Bytes() const
{
  long long bytes = BytesOf(this->R) + BytesOf(this->B) + this->BytesOfUnknowns();
  for (const SparseMatrix<Scalar>& prolongation : this->P)
  {
    bytes += BytesOf(prolongation);
  }
  return bytes;
}

template class AssembledHierarchy<double>;
template class AssembledHierarchy<Complex>;

}
