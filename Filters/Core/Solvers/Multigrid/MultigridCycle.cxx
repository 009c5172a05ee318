#include "Solvers/Multigrid/MultigridCycle.h"

#include "Solvers/Multigrid/ScaledHierarchy.h"
#include "Solvers/Multigrid/VCycle.h"
#include "Support/Errors.h"
#include "Support/SparseKernels.h"

#include <cmath>
#include <complex>
#include <type_traits>
#include <vector>

namespace dmg
{
namespace
{

constexpr int RowGrain = 256; // rows are long on the levels that cycles are repeated on
// A bound of the eigenvalues of B A for most errors; iterations depend on it little.
constexpr double LeastEigenvalue = 0.5;

}

template <class Scalar>
class MultigridCycle<Scalar>::Internals
{
public:
  virtual ~Internals() = default;
  virtual void Update(const ExecutionContext& context) = 0;
  virtual void Apply(const Vector<Scalar>& r, Vector<Scalar>& z, const ExecutionContext& context) = 0;
  virtual long long Bytes() const = 0;
};

template <class Scalar>
template <class Value>
class MultigridCycle<Scalar>::InternalsOf : public MultigridCycle<Scalar>::Internals
{
public:
  InternalsOf(GalerkinHierarchy<Scalar>& hierarchy, const CycleOptions& options, const ExecutionContext& context)
    : Options(options)
    , Levels(hierarchy, ScaledHierarchy<Scalar, Value>::Content::MatricesForSweeps, context)
  {
    this->MakeSmoothers();
  }

  void Update(const ExecutionContext& context) override
  {
    this->Levels.Update(context);
    this->MakeSmoothers();
  }

  void Apply(const Vector<Scalar>& r, Vector<Scalar>& z, const ExecutionContext& context) override
  {
    this->Levels.Load(r, context);
    VCycle(this->Levels, this->Smoothers, 0, context);
    if (!this->Smoothers.empty() && this->Options.Repetitions > 1)
    {
      this->Levels[0].x *= this->StepOf(0);
      for (int k = 1; k < this->Options.Repetitions; ++k)
      {
        this->Repeat(this->StepOf(k), context);
      }
    }
    this->Levels.Store(z, context);
  }

  long long Bytes() const override
  {
    long long bytes = this->Levels.Bytes();
    for (const auto& smoother : this->Smoothers)
    {
      bytes += smoother->Bytes();
    }
    return bytes;
  }

private:
  using Real = typename Eigen::NumTraits<Value>::Real;

  /// The step of a cycle among the repetitions: they damp errors of eigenvalues of B A from LeastEigenvalue to 1 evenly,
  /// and others by some (Chebyshev's semi-iteration; Saad 2003, section 12.3).
  Real StepOf(int repetition) const
  {
    const double root = std::cos(EIGEN_PI * (2 * repetition + 1) / (2.0 * this->Options.Repetitions)); // in [-1, 1]
    return static_cast<Real>(2.0 / (1.0 + LeastEigenvalue + (1.0 - LeastEigenvalue) * root));
  }

  /// x_0 += step B (b_0 - A x_0).
  void Repeat(Real step, const ExecutionContext& context)
  {
    const TriangularParts<Value>& A = this->Levels[0].A;
    Vector<Value>& b = this->Levels[0].b;
    Vector<Value>& x = this->Levels[0].x;
    const Vector<Value> former = x;
    const Vector<Value> rightHandSide = b;
    context.ParallelFor(0, static_cast<int>(b.size()), RowGrain,
      [&](int first, int last)
      {
        for (int i = first; i < last; ++i)
        {
          b[i] -= former[i] + A.LowerTimes(i, former.data()) + A.UpperTimes(i, former.data());
        }
      });
    VCycle(this->Levels, this->Smoothers, 0, context);
    x = former + step * x;
    b = rightHandSide;
  }

  void MakeSmoothers()
  {
    this->Smoothers.clear();
    for (int l = 0; l + 1 < this->Levels.NumberOfLevels(); ++l)
    {
      SmootherOptions smoothing = this->Options.Smoothing;
      smoothing.PreSweeps *= l == 0 ? this->Options.FinestFactor : 1;
      smoothing.PostSweeps *= l == 0 ? this->Options.FinestFactor : 1;
      this->Smoothers.push_back(Smoother<Value>::New(this->Levels[l].A, smoothing));
    }
  }

  const CycleOptions Options;
  ScaledHierarchy<Scalar, Value> Levels;
  std::vector<std::unique_ptr<Smoother<Value>>> Smoothers; // none for the coarsest level
};

template <class Scalar>
MultigridCycle<Scalar>::MultigridCycle(
  GalerkinHierarchy<Scalar>& hierarchy, const CycleOptions& options, const ExecutionContext& context)
  : Hierarchy(hierarchy)
  , Options(options)
{
  if (options.Smoothing.PreSweeps < 0 || options.Smoothing.PostSweeps < 0)
  {
    throw InvalidInput("the number of smoothing sweeps must not be negative");
  }
  this->Build(context);
}

template <class Scalar>
MultigridCycle<Scalar>::~MultigridCycle() = default;

template <class Scalar>
bool MultigridCycle<Scalar>::NeedsDoublePrecision() const
{
  if (this->Options.Precision != CyclePrecision::Automatic)
  {
    return this->Options.Precision == CyclePrecision::Double;
  }
  // Diagonals are as large on all levels, so that the least eigenvalue falls with the share of unknowns. Cycles in a
  // row subtract A x from b, and these nearly agree for its error.
  double smallest = this->Hierarchy.CoarsestSolver().ReciprocalCondition();
  if (this->Options.Repetitions > 1)
  {
    const int coarsest = this->Hierarchy.NumberOfLevels() - 1;
    smallest *= static_cast<double>(this->Hierarchy.NumberOfUnknowns(coarsest)) / this->Hierarchy.NumberOfUnknowns(0);
  }
  return smallest < 2e-5;
}

template <class Scalar>
void MultigridCycle<Scalar>::Build(const ExecutionContext& context)
{
  using SingleScalar = std::conditional_t<std::is_same<Scalar, double>::value, float, std::complex<float>>;
  this->IsDouble = this->NeedsDoublePrecision();
  if (this->IsDouble)
  {
    this->Internal = std::make_unique<InternalsOf<Scalar>>(this->Hierarchy, this->Options, context);
  }
  else
  {
    this->Internal = std::make_unique<InternalsOf<SingleScalar>>(this->Hierarchy, this->Options, context);
  }
}

template <class Scalar>
void MultigridCycle<Scalar>::Update(const ExecutionContext& context)
{
  if (this->NeedsDoublePrecision() == this->IsDouble)
  {
    this->Internal->Update(context);
  }
  else
  {
    this->Build(context);
  }
}

template <class Scalar>
void MultigridCycle<Scalar>::Apply(const Vector<Scalar>& r, Vector<Scalar>& z, const ExecutionContext& context)
{
  this->Internal->Apply(r, z, context);
}

template <class Scalar>
long long MultigridCycle<Scalar>::Bytes() const
{
  return this->Internal->Bytes();
}

template class MultigridCycle<double>;
template class MultigridCycle<Complex>;

}
