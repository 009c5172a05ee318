#include "Scales/ScaleSystem.h"

#include "Discretisations/MakeDiscretisation.h"
#include "Discretisations/ScalarFunction.h"
#include "Discretisations/VertexDiscretisation.h"
#include "Operators/FunctionSource.h"
#include "Scales/SquaredStiffness.h"
#include "Setup/SetupCache.h"
#include "Support/Errors.h"
#include "Support/Permutations.h"
#include "Support/ShortText.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <string>
#include <utility>

namespace dmg
{
namespace
{

/// A lower limit means a time budget: no factor takes over.
constexpr int FewestIterationsBeforeFactor = 100;

/// c^2 is a conductivity.
std::unique_ptr<const Discretisation> FieldOf(const ScaleFilterOptions& asked, const FramedMesh& surface)
{
  const DiscretisationOptions field = FieldOptionsOf(asked).Field;
  if (asked.RelativeWavelengths.empty())
  {
    return MakeDiscretisation(field, surface);
  }
  std::vector<double> conductivity;
  std::transform(asked.RelativeWavelengths.begin(), asked.RelativeWavelengths.end(), std::back_inserter(conductivity),
    [](double relative) { return relative * relative; });
  return std::make_unique<ScalarFunction>(surface, field.Areas, std::move(conductivity));
}

void CheckRelativeWavelengths(const ScaleFilterOptions& options, int vertices)
{
  const std::vector<double>& relative = options.RelativeWavelengths;
  if (relative.empty())
  {
    return;
  }
  if (options.Quantity == ScaledQuantity::Vectors)
  {
    throw InvalidInput(
      "vectors have relative wavelengths, and the scale filter knows them of functions alone; filter flows by their "
      "parts, or give none");
  }
  if (relative.size() != static_cast<std::size_t>(vertices))
  {
    throw InvalidInput("there are " + std::to_string(relative.size()) + " relative wavelengths for " +
      std::to_string(vertices) + " vertices; give one for each");
  }
  const auto wrong = std::find_if(
    relative.begin(), relative.end(), [](double number) { return !(number > 0.0 && std::isfinite(number)); });
  if (wrong != relative.end())
  {
    throw InvalidInput("the relative wavelength at vertex " + std::to_string(wrong - relative.begin()) + " is " +
      ShortText(*wrong) + ", and must be positive and finite; repair it");
  }
}

class WholeSystem : public ScaleSystem
{
public:
  WholeSystem(SetupCache& setups, const ScaleFilterOptions& options, const ExecutionContext& context);

  const LinearOperator<double>& Stiffness() const override { return *this->StiffnessOfAll; }
  const LinearOperator<double>& Shifted() const override { return *this->ShiftedStiffness; }
  void SetShift(double s, double ofInverse, SolveReport& report, const ExecutionContext& context) override;
  Vector<double> Solve(const LinearOperator<double>& A, bool isSquared, const Vector<double>& b,
    const StoppingCriteria& stop, SolveReport& report, const ExecutionContext& context) override;
  void Centre(Vector<double>& quantity) const override;
  Vector<double> UnknownsOf(const Vector<double>& quantity, const ExecutionContext& context) const override
  {
    return Gathered(quantity, this->Setup.Levels->Hierarchy->Order, context);
  }
  Vector<double> QuantityOf(const Vector<double>& unknowns, const ExecutionContext& context) const override
  {
    return Scattered(unknowns, this->Setup.Levels->Hierarchy->Order, context);
  }

private:
  /// Shift times mass, infinite where the function is fixed.
  Vector<double> Diagonal(double shift) const;
  void Iterate(SolverMethod::Iteration& iterate, Preconditioner<double>& inverse, const LinearOperator<double>& A,
    bool isSquared, const Vector<double>& b, const StoppingCriteria& stop, Vector<double>& x, SolveReport& report,
    const ExecutionContext& context) const;
  /// Makes a factor, where there is none. \return whether there is one.
  bool HasFactor(const ExecutionContext& context);

  const std::unique_ptr<const Discretisation> Field;
  const SolverOptions Options;
  const std::vector<int> Components; ///< by vertex; empty for vectors, which have no means
  const std::vector<int> FixedVertices;
  PlannedSetup Setup;
  std::vector<int> FixedUnknowns; ///< the fixed vertices, in the order of the hierarchy
  std::unique_ptr<StiffnessOperator> StiffnessOfAll, ShiftedStiffness;
  std::unique_ptr<StiffnessCycle> Inverse;        ///< of R + s' M
  std::unique_ptr<Preconditioner<double>> Factor; ///< the same, as soon as cycles have stalled
  double ShiftOfInverse = 0.0;                    ///< s'
};

WholeSystem::WholeSystem(SetupCache& setups, const ScaleFilterOptions& options, const ExecutionContext& context)
  : Field(FieldOf(options, setups.Surface))
  , Options(FieldOptionsOf(options).Solver)
  , Components(
      options.Quantity == ScaledQuantity::Function ? VertexComponents(setups.Surface.Mesh) : std::vector<int>())
  , FixedVertices(options.Fixed)
{
  CheckOptions(options, setups.Surface.Mesh.NumberOfVertices());
  this->Areas = this->Field->AtVertices()->AreasOfVertices(context);
  this->NumbersPerVertex = this->Field->UnknownsPerElement();
  this->Sizes = SizesOf(setups.Surface.Mesh);
  this->MeanArea = this->Areas.mean();
  // A set-up of a conductivity of its own serves nobody else.
  SetupCache own(setups.Surface);
  SetupCache& from = options.RelativeWavelengths.empty() ? setups : own;
  this->Setup = from.Take(*this->Field, FieldOptionsOf(options), nullptr, context);
  this->HasNewSetup = this->Setup.IsNew;
  const StiffnessHierarchy& hierarchy = *this->Setup.Levels->Hierarchy;
  const int size = hierarchy.NumberOfUnknowns();
  this->Mass.resize(size);
  for (int i = 0; i < size; ++i)
  {
    this->Mass[i] = this->Areas[hierarchy.Order[i] / this->NumbersPerVertex] / this->MeanArea;
    this->LargestEigenvalue = std::max(this->LargestEigenvalue, hierarchy.DiagonalOf(i) / this->Mass[i]);
  }
  const std::vector<int> places = dmg::Inverse(hierarchy.Order, context);
  for (const int vertex : this->FixedVertices)
  {
    this->FixedUnknowns.push_back(places[vertex]);
  }
  this->HasFixed = !this->FixedUnknowns.empty();
  this->HasUnknowns = this->FixedUnknowns.size() < static_cast<std::size_t>(size);
  this->StiffnessOfAll = hierarchy.Operator();
  this->StiffnessOfAll->SetDiagonal(this->Diagonal(0.0), context);
  this->ShiftedStiffness = hierarchy.Operator();
}

Vector<double> WholeSystem::Diagonal(double shift) const
{
  Vector<double> D = shift * this->Mass;
  D(this->FixedUnknowns).setConstant(std::numeric_limits<double>::infinity());
  return D;
}

void WholeSystem::SetShift(double s, double ofInverse, SolveReport& report, const ExecutionContext& context)
{
  this->ShiftOfInverse = ofInverse;
  this->ShiftedStiffness->SetDiagonal(this->Diagonal(s), context);
  const Vector<double> D = this->Diagonal(ofInverse);
  this->Factor.reset();
  std::unique_ptr<StiffnessCycle> inverse = std::move(this->Inverse); // which an error makes unusable
  if (inverse)
  {
    inverse->Update(D, context);
  }
  else
  {
    inverse = this->Setup.Choice.Method->MakePreconditioner(*this->Setup.Levels, D, this->Options, context);
  }
  this->Inverse = std::move(inverse);
  report.Solver = this->Setup.Choice.Method->Name +
    (this->Setup.Choice.Method->NeedsLevels ? " on " + this->Setup.Levels->Name : "") + this->Setup.Choice.Reason;
  report.Levels = this->Inverse->Levels();
  report.Bytes = this->Setup.Levels->Bytes() + this->Inverse->Bytes();
}

void WholeSystem::Iterate(SolverMethod::Iteration& iterate, Preconditioner<double>& inverse,
  const LinearOperator<double>& A, bool isSquared, const Vector<double>& b, const StoppingCriteria& stop,
  Vector<double>& x, SolveReport& report, const ExecutionContext& context) const
{
  if (!isSquared)
  {
    iterate(A, inverse, b, stop, x, report, context, nullptr);
    return;
  }
  SquaredInverse twice(inverse, this->Mass);
  iterate(A, twice, b, stop, x, report, context, nullptr);
}

bool WholeSystem::HasFactor(const ExecutionContext& context)
{
  try
  {
    if (!this->Factor)
    {
      this->Factor = this->Setup.Levels->Hierarchy->Factor(this->Diagonal(this->ShiftOfInverse), context);
    }
  }
  catch (const SolverFailure&)
  {
    return false;
  }
  return true;
}

/// A factor goes on where cycles have stalled. If the factorisation fails, all stays as it was.
Vector<double> WholeSystem::Solve(const LinearOperator<double>& A, bool isSquared, const Vector<double>& b,
  const StoppingCriteria& asked, SolveReport& report, const ExecutionContext& context)
{
  const std::vector<std::string> warnings = report.Warnings;
  const SolverMethod& method = *this->Setup.Choice.Method;
  Vector<double> x;
  if (!this->Factor)
  {
    StoppingCriteria stop = asked;
    stop.MayEstimate = !method.IsDirect;
    this->Iterate(*method.Iterate, *this->Inverse, A, isSquared, b, stop, x, report, context);
  }
  const bool hasStalled = method.HasFallback && !report.Converged && !report.EndedByRounding &&
    asked.MaximumIterations >= FewestIterationsBeforeFactor;
  if ((this->Factor || hasStalled) && this->HasFactor(context))
  {
    report.Warnings = warnings;
    this->Iterate(*MethodOf(SolverKind::Cholesky).Iterate, *this->Factor, A, isSquared, b, asked, x, report, context);
    report.Warnings.push_back("Cycles did not converge, so conjugate gradients with a factor of the system took over.");
  }
  return x;
}

void WholeSystem::Centre(Vector<double>& quantity) const
{
  if (!this->Components.empty())
  {
    FreeComponents(this->Components, this->FixedVertices).Centre(quantity, this->Areas);
  }
}

}

FieldOptions FieldOptionsOf(const ScaleFilterOptions& asked)
{
  FieldOptions options;
  options.Field = DiscretisationOptions::OfFunctions();
  if (asked.Quantity == ScaledQuantity::Vectors)
  {
    options.Field = {};
    options.Field.N = 1;
  }
  options.Solver.Kind = MethodOf(asked.Solver.Kind).IsApproximation() ? SolverKind::Automatic : asked.Solver.Kind;
  options.Solver.ExpectedSolves = asked.Solver.ExpectedSolves;
  options.Solver.Sweeps = asked.Solver.Sweeps;
  return options;
}

void CheckOptions(const ScaleFilterOptions& options, int vertices)
{
  if (options.Order != 1 && options.Order != 2)
  {
    throw InvalidInput(
      "the order " + std::to_string(options.Order) + " of the scale filter is neither 1 nor 2; give one of them");
  }
  if (!options.Fixed.empty() && options.Quantity == ScaledQuantity::Vectors)
  {
    throw InvalidInput("vectors have fixed vertices, and the scale filter knows them of functions alone; give none");
  }
  CheckRelativeWavelengths(options, vertices);
  for (std::size_t k = 0; k < options.Fixed.size(); ++k)
  {
    const int vertex = options.Fixed[k];
    if (vertex < 0 || vertex >= vertices || (k > 0 && vertex <= options.Fixed[k - 1]))
    {
      throw InvalidInput("the fixed vertex " + std::to_string(vertex) + " is not one of the " +
        std::to_string(vertices) + " vertices, or follows no smaller one; sort fixed vertices, and name each once");
    }
  }
}

std::unique_ptr<ScaleSystem> SystemOfSurface(
  SetupCache& setups, const ScaleFilterOptions& options, const ExecutionContext& context)
{
  return std::make_unique<WholeSystem>(setups, options, context);
}

}
