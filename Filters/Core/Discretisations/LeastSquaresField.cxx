#include "Discretisations/LeastSquaresField.h"

#include "Analysis/HarmonicForms.h"
#include "Solvers/Multigrid/AssembledHierarchy.h"
#include "Support/SparseKernels.h"

#include <utility>

namespace dmg
{
namespace
{

// Blocks on the finest level do not overlap, and sweeps over them follow each other in the caches: for what
// they do, they are cheap.
constexpr int FinestSweepsFactor = 3;
constexpr int CoarseCycles = 2;
constexpr int LargestCoarseFactor = 10000;
// The distance that a smoothed interpolation reaches.
constexpr double DistanceOfSamples = 7.0;

}

std::unique_ptr<const StiffnessHierarchy> LeastSquaresField::Coarsen(
  const LinearProlongations& linear, const ExecutionContext& context) const
{
  const auto takeLevels = [&]
  {
    LeastSquaresLevels levels = this->LinearLevels(linear.All(), context);
    linear.Forget();
    return levels; // handed on as it is: Eigen 3.4 would copy what is moved
  };
  return std::make_unique<LeastSquaresHierarchy>(
    CoarsenLeastSquares(this->Factor(context), takeLevels(), this->Coarsening(), PartOfContext(context, 0.2, 1.0)));
}

std::unique_ptr<const StiffnessHierarchy> LeastSquaresField::Assemble(
  const ProlongationOperators* operators, CoarseSpaceKind space, const ExecutionContext& context) const
{
  std::vector<SparseMatrix<double>> prolongations;
  if (operators && space == CoarseSpaceKind::LinearInterpolation)
  {
    CheckOperators(!operators->Linear.empty(), this->RemedyOfOperators());
    prolongations = this->LinearProlongationsOfUnknowns(operators->Linear, context);
  }
  else if (operators)
  {
    CheckOperators(!this->PreservingProlongations(*operators).empty(), this->RemedyOfOperators());
    prolongations = this->PreservingProlongations(*operators);
  }
  SparseMatrix<double> B = this->Factor(context);
  SparseMatrix<double> R = NormalMatrix(B, context);
  return std::make_unique<AssembledHierarchy<double>>(R, std::move(prolongations), std::move(B));
}

double LeastSquaresField::SampleDistance() const
{
  return DistanceOfSamples;
}

SolverTuning LeastSquaresField::Tuning() const
{
  SolverTuning tuning;
  tuning.FinestSweepsFactor = FinestSweepsFactor;
  tuning.CoarseCycles = CoarseCycles;
  tuning.LargestCoarseFactor = LargestCoarseFactor;
  return tuning;
}

int LeastSquaresField::NumberOfHarmonicFields() const
{
  return NumberOfGenerators(this->Surface.Mesh);
}

}
