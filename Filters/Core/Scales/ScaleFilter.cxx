#include "Scales/ScaleFilter.h"

#include "Discretisations/MakeDiscretisation.h"
#include "Discretisations/ScalarFunction.h"
#include "Discretisations/VertexDiscretisation.h"
#include "Mesh/SurfaceSizes.h"
#include "Operators/ExteriorCalculus.h"
#include "Operators/FunctionSource.h"
#include "Scales/SquaredStiffness.h"
#include "Setup/SetupCache.h"
#include "Support/Errors.h"
#include "Support/Permutations.h"
#include "Support/ShortText.h"
#include "Support/Stopwatch.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <limits>
#include <string>
#include <utility>

namespace dmg
{
namespace
{

/// Beyond so many times the largest eigenvalue, nothing but rounding is above the wavelength.
constexpr double LargestShift = 1e15;

/// A lower limit means a time budget: no factor takes over.
constexpr int FewestIterationsBeforeFactor = 100;

/// Shorter waves have an amplitude that is off by a twentieth or more (LengthOnMesh).
constexpr double FewestCells = 4.0;

FieldOptions OptionsOf(const ScaleFilterOptions& asked)
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

/// c^2 is a conductivity.
std::unique_ptr<const Discretisation> FieldOf(const ScaleFilterOptions& asked, const FramedMesh& surface)
{
  const DiscretisationOptions field = OptionsOf(asked).Field;
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

void CheckWavelength(double wavelength)
{
  if (!(wavelength > 0.0 && std::isfinite(wavelength)))
  {
    throw InvalidInput("the wavelength " + ShortText(wavelength) +
      " is not a positive number; give a length in the unit of the points, times the length scale where there is one");
  }
}

double LeastOf(const std::vector<double>& relative)
{
  return relative.empty() ? 1.0 : *std::min_element(relative.begin(), relative.end());
}

double MostOf(const std::vector<double>& relative)
{
  return relative.empty() ? 1.0 : *std::max_element(relative.begin(), relative.end());
}

/// A power of two near the largest magnitude, for cycles that compute in single precision.
double UnitOf(const Vector<double>& numbers)
{
  const double largest = numbers.size() > 0 ? numbers.cwiseAbs().maxCoeff() : 0.0;
  return largest > 0.0 ? std::ldexp(1.0, std::ilogb(largest)) : 1.0;
}

/// The wave that a mesh of edges of length 1 has for a wave of so many edges: the length at which the second difference
/// of the wave is that of the continuous one.
double LengthOnMesh(double cells)
{
  return Pi / std::sin(Pi / std::max(2.0, cells));
}

}

double AmplitudeBelow(double wavelength, double wave, int order)
{
  return 1.0 / (1.0 + 2.0 * std::pow(wavelength / wave, 2 * order));
}

Vector<double> FunctionOfFaces(const TriangleMesh& mesh, const Vector<double>& onFaces)
{
  Vector<double> sums = Vector<double>::Zero(mesh.NumberOfVertices());
  Vector<double> weights = sums;
  for (int face = 0; face < mesh.NumberOfFaces(); ++face)
  {
    const std::array<double, 3> shares = VoronoiShares(mesh, face);
    for (int k = 0; k < 3; ++k)
    {
      const double weight = shares[k] * mesh.FaceArea(face);
      sums[mesh.FaceCorners()(face, k)] += weight * onFaces[face];
      weights[mesh.FaceCorners()(face, k)] += weight;
    }
  }
  return (weights.array() > 0.0).select(sums.array() / weights.array(), 0.0);
}

Vector<double> MeansOfFaces(const TriangleMesh& mesh, const Vector<double>& atVertices)
{
  Vector<double> means = Vector<double>::Zero(mesh.NumberOfFaces());
  for (int face = 0; face < mesh.NumberOfFaces(); ++face)
  {
    const std::array<double, 3> shares = VoronoiShares(mesh, face);
    for (int k = 0; k < 3; ++k)
    {
      means[face] += shares[k] * atVertices[mesh.FaceCorners()(face, k)];
    }
  }
  return means;
}

class ScaleFilter::Internals
{
public:
  Internals(SetupCache& setups, const ScaleFilterOptions& options, const ExecutionContext& context);

  SplitScales Split(
    const Vector<double>& quantity, double wavelength, const StoppingCriteria& stop, const ExecutionContext& context);

  const std::unique_ptr<const Discretisation> Field;
  const Vector<double> Areas; ///< by vertex
  PlannedSetup Setup;
  SolveReport Report;

  /// Makes the mean of a function zero on each component in which nothing is fixed.
  void Centre(Vector<double>& quantity) const;

private:
  void CheckQuantity(const Vector<double>& quantity) const;
  /// The system stage.
  void TakeWavelength(double wavelength, const ExecutionContext& context);
  void WarnOf(double wavelength);
  /// Shift times mass, infinite where the function is fixed.
  Vector<double> Diagonal(double shift) const;
  /// The equations of the wavelength, preconditioned by \p inverse of R + s M; x is a start, or empty.
  void Iterate(SolverMethod::Iteration& iterate, Preconditioner<double>& inverse, const Vector<double>& b,
    const StoppingCriteria& stop, Vector<double>& x, const ExecutionContext& context);
  /// Goes on with a factor where cycles have stalled. If the factorisation fails, all stays as it was.
  void GoOnWithFactor(
    const Vector<double>& b, const StoppingCriteria& stop, Vector<double>& x, const ExecutionContext& context);
  /// 1 / (2 c^2) or, of order 2, 1 / (sqrt 2 c^2), in units of the mean area. \param wavelength in the unit of the points.
  double ShiftOf(double wavelength) const;
  /// The right-hand side of the part above or below. \param smoothed R f. \return scaled as the matrix is.
  Vector<double> RightHandSide(
    bool isAbove, const Vector<double>& f, const Vector<double>& smoothed, const ExecutionContext& context) const;
  /// The part above or below of an ordered, centred quantity of magnitude 1, the smaller one of the two.
  Vector<double> SolveForSmaller(
    const Vector<double>& f, bool& isAbove, const StoppingCriteria& stop, const ExecutionContext& context);

  const int Order;
  const double LengthScale;
  const SolverOptions Options;
  const SurfaceSizes Sizes;
  const double Least, Most;          ///< of relative wavelengths
  const double MeanArea;             ///< of vertices
  const std::vector<int> Components; ///< by vertex; empty for vectors, which have no means
  const std::vector<int> FixedVertices;
  std::vector<int> FixedUnknowns;               ///< these, in the order of the hierarchy
  Vector<double> Mass;                          ///< by unknown in the order of the hierarchy, relative to the mean
  double LargestEigenvalue = 0.0;               ///< of M^-1 R, about
  std::unique_ptr<StiffnessOperator> Stiffness; ///< R, without the rows that are fixed
  std::unique_ptr<StiffnessOperator> ShiftedStiffness; ///< R + s M
  std::unique_ptr<SquaredStiffness> Squared;           ///< R M^-1 R + s^2 M
  std::unique_ptr<StiffnessCycle> Inverse;             ///< of R + s M
  std::unique_ptr<Preconditioner<double>> Factor;      ///< the same, as soon as cycles have stalled
  double ShiftOfInverse = 0.0;                         ///< s of both
  double Wavelength = 0.0;                             ///< that the equations have; 0: none
  double Shift = 0.0;                                  ///< s
  std::vector<std::string> Warnings;                   ///< of the wavelength
};

ScaleFilter::Internals::Internals(
  SetupCache& setups, const ScaleFilterOptions& options, const ExecutionContext& context)
  : Field(FieldOf(options, setups.Surface))
  , Areas(this->Field->AtVertices()->AreasOfVertices(context))
  , Order(options.Order)
  , LengthScale(options.LengthScale)
  , Options(OptionsOf(options).Solver)
  , Sizes(SizesOf(setups.Surface.Mesh))
  , Least(LeastOf(options.RelativeWavelengths))
  , Most(MostOf(options.RelativeWavelengths))
  , MeanArea(this->Areas.mean())
  , Components(
      options.Quantity == ScaledQuantity::Function ? VertexComponents(setups.Surface.Mesh) : std::vector<int>())
  , FixedVertices(options.Fixed)
{
  CheckOptions(options, setups.Surface.Mesh.NumberOfVertices());
  // A set-up of a conductivity of its own serves nobody else.
  SetupCache own(setups.Surface);
  SetupCache& from = options.RelativeWavelengths.empty() ? setups : own;
  this->Setup = from.Take(*this->Field, OptionsOf(options), nullptr, context);
  const StiffnessHierarchy& hierarchy = *this->Setup.Levels->Hierarchy;
  const int size = hierarchy.NumberOfUnknowns();
  this->Mass.resize(size);
  for (int i = 0; i < size; ++i)
  {
    this->Mass[i] = this->Areas[hierarchy.Order[i] / this->Field->UnknownsPerElement()] / this->MeanArea;
    this->LargestEigenvalue = std::max(this->LargestEigenvalue, hierarchy.DiagonalOf(i) / this->Mass[i]);
  }
  const std::vector<int> places = dmg::Inverse(hierarchy.Order, context);
  for (const int vertex : this->FixedVertices)
  {
    this->FixedUnknowns.push_back(places[vertex]);
  }
  this->Stiffness = hierarchy.Operator();
  this->Stiffness->SetDiagonal(this->Diagonal(0.0), context);
  this->ShiftedStiffness = hierarchy.Operator();
  this->Squared = std::make_unique<SquaredStiffness>(*this->Stiffness, this->Mass);
}

void ScaleFilter::Internals::CheckQuantity(const Vector<double>& quantity) const
{
  if (quantity.size() != this->Field->NumberOfUnknowns())
  {
    throw InvalidInput("the quantity to be filtered has " + std::to_string(quantity.size()) + " numbers in place of " +
      std::to_string(this->Field->NumberOfUnknowns()) + "; give " + std::to_string(this->Field->UnknownsPerElement()) +
      " for each vertex");
  }
  for (Eigen::Index i = 0; i < quantity.size(); ++i)
  {
    if (!std::isfinite(quantity[i]))
    {
      throw InvalidInput("the quantity to be filtered is not finite at vertex " +
        std::to_string(i / this->Field->UnknownsPerElement()) + "; repair it");
    }
  }
}

void ScaleFilter::Internals::Centre(Vector<double>& quantity) const
{
  if (!this->Components.empty())
  {
    FreeComponents(this->Components, this->FixedVertices).Centre(quantity, this->Areas);
  }
}

Vector<double> ScaleFilter::Internals::Diagonal(double shift) const
{
  Vector<double> D = shift * this->Mass;
  D(this->FixedUnknowns).setConstant(std::numeric_limits<double>::infinity());
  return D;
}

double ScaleFilter::Internals::ShiftOf(double wavelength) const
{
  const double c = wavelength / (2.0 * Pi);
  return this->MeanArea / ((this->Order == 1 ? 2.0 : std::sqrt(2.0)) * c * c);
}

void ScaleFilter::Internals::WarnOf(double wavelength)
{
  this->Warnings.clear();
  const double shortest = this->Least * wavelength;
  const double cells = shortest / this->LengthScale / this->Sizes.MeanEdge;
  const double longest = 2.0 * std::sqrt(this->Sizes.Area) * this->LengthScale;
  if (cells < FewestCells)
  {
    const double kept = AmplitudeBelow(cells, LengthOnMesh(cells), this->Order);
    this->Warnings.push_back("The wavelength " + ShortText(shortest) + " is " + ShortText(cells) +
      " mean edges, fewer than 4, and is not resolved: " +
      (cells < 2.0 ? "the shortest waves there are, of two edges," : "such waves") + " keep about " + ShortText(kept) +
      " of their amplitude in place of " + (cells < 2.0 ? "a smaller share." : "a third."));
  }
  else if (this->Most * wavelength > longest)
  {
    this->Warnings.push_back("The wavelength " + ShortText(this->Most * wavelength) +
      " is longer than the surface: its longest waves, of about " + ShortText(longest) + ", keep " +
      ShortText(AmplitudeBelow(this->Most * wavelength, longest, this->Order)) + " of their amplitude.");
  }
}

/// The preconditioner takes no wavelength beyond the size of the surface. Its matrix would be nearly singular, and the functions that
/// matter have a mean of zero, so that their eigenvalues do not fall further.
void ScaleFilter::Internals::TakeWavelength(double wavelength, const ExecutionContext& context)
{
  if (wavelength == this->Wavelength)
  {
    return;
  }
  const Stopwatch watch;
  this->Wavelength = 0.0;
  this->Shift = std::min(this->ShiftOf(wavelength / this->LengthScale), LargestShift * this->LargestEigenvalue);
  this->ShiftOfInverse = std::max(this->Shift, this->ShiftOf(2.0 * Pi * this->Sizes.Diagonal() / this->Least));
  this->ShiftedStiffness->SetDiagonal(this->Diagonal(this->Shift), context);
  this->Squared->SetShift(this->Shift);
  const Vector<double> D = this->Diagonal(this->ShiftOfInverse);
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
  this->WarnOf(wavelength);
  this->Report = {};
  this->Report.Solver = this->Setup.Choice.Method->Name +
    (this->Setup.Choice.Method->NeedsLevels ? " on " + this->Setup.Levels->Name : "") + this->Setup.Choice.Reason;
  this->Report.Levels = this->Inverse->Levels();
  this->Report.Bytes = this->Setup.Levels->Bytes() + this->Inverse->Bytes();
  this->Report.PrepareSeconds = watch.Seconds();
  this->Wavelength = wavelength;
}

Vector<double> ScaleFilter::Internals::RightHandSide(
  bool isAbove, const Vector<double>& f, const Vector<double>& smoothed, const ExecutionContext& context) const
{
  if (!isAbove)
  {
    return std::pow(this->Shift, this->Order) * this->Mass.cwiseProduct(f);
  }
  if (this->Order == 1)
  {
    return smoothed;
  }
  Vector<double> twice;
  this->Squared->ApplySquare(f, twice, context);
  return twice;
}

void ScaleFilter::Internals::Iterate(SolverMethod::Iteration& iterate, Preconditioner<double>& inverse,
  const Vector<double>& b, const StoppingCriteria& stop, Vector<double>& x, const ExecutionContext& context)
{
  if (this->Order == 1)
  {
    iterate(*this->ShiftedStiffness, inverse, b, stop, x, this->Report, context, nullptr);
    return;
  }
  SquaredInverse twice(inverse, this->Mass);
  iterate(*this->Squared, twice, b, stop, x, this->Report, context, nullptr);
}

void ScaleFilter::Internals::GoOnWithFactor(
  const Vector<double>& b, const StoppingCriteria& stop, Vector<double>& x, const ExecutionContext& context)
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
    return;
  }
  this->Report.Warnings = this->Warnings;
  this->Iterate(*MethodOf(SolverKind::Cholesky).Iterate, *this->Factor, b, stop, x, context);
  this->Report.Warnings.push_back(
    "Cycles did not converge, so conjugate gradients with a factor of the system took over.");
}

/// The part above is solved for if something is fixed: its equations see the fixed values, and are zero there.
Vector<double> ScaleFilter::Internals::SolveForSmaller(
  const Vector<double>& f, bool& isAbove, const StoppingCriteria& asked, const ExecutionContext& context)
{
  Vector<double> Rf;
  this->Stiffness->Apply(f, Rf, context);
  isAbove = !this->FixedUnknowns.empty() || f.dot(Rf) < this->Shift * f.dot(this->Mass.cwiseProduct(f));
  const Vector<double> b = this->RightHandSide(isAbove, f, Rf, context);
  this->Report.Warnings = this->Warnings;
  Vector<double> x;
  if (!this->Factor)
  {
    StoppingCriteria stop = asked;
    stop.MayEstimate = !this->Setup.Choice.Method->IsDirect;
    this->Iterate(*this->Setup.Choice.Method->Iterate, *this->Inverse, b, stop, x, context);
  }
  const bool hasStalled = this->Setup.Choice.Method->HasFallback && !this->Report.Converged &&
    !this->Report.EndedByRounding && asked.MaximumIterations >= FewestIterationsBeforeFactor;
  if (this->Factor || hasStalled)
  {
    this->GoOnWithFactor(b, asked, x, context);
  }
  return x;
}

SplitScales ScaleFilter::Internals::Split(
  const Vector<double>& quantity, double wavelength, const StoppingCriteria& stop, const ExecutionContext& context)
{
  CheckWavelength(wavelength);
  this->CheckQuantity(quantity);
  if (this->FixedUnknowns.size() == static_cast<std::size_t>(quantity.size()))
  {
    this->Report = {};
    this->Report.Converged = true;
    return { quantity, Vector<double>::Zero(quantity.size()) };
  }
  this->TakeWavelength(wavelength, PartOfContext(context, 0.0, 0.4));
  const std::vector<int>& order = this->Setup.Levels->Hierarchy->Order;
  const double unit = UnitOf(quantity);
  Vector<double> varying = quantity / unit;
  this->Centre(varying);
  bool isAbove = false;
  Vector<double> part =
    Scattered(this->SolveForSmaller(Gathered(varying, order, context), isAbove, stop, PartOfContext(context, 0.4, 1.0)),
      order, context);
  this->Centre(part);
  if (!part.allFinite())
  {
    throw UnexpectedFailure("the filtered quantity is not finite");
  }
  SplitScales split;
  if (isAbove)
  {
    split.Above = unit * part;
    split.Below = quantity - split.Above;
  }
  else
  {
    split.Below = quantity - unit * (varying - part);
    split.Above = quantity - split.Below;
  }
  return split;
}

ScaleFilter::ScaleFilter(const FramedMesh& surface, const ScaleFilterOptions& options, const ExecutionContext& context)
  : ScaleFilter(*std::make_unique<SetupCache>(surface), options, context)
{
}

ScaleFilter::ScaleFilter(SetupCache& setups, const ScaleFilterOptions& options, const ExecutionContext& context)
  : Internal(std::make_unique<Internals>(setups, options, context))
{
}

ScaleFilter::~ScaleFilter() = default;

ScaleFilter::ScaleFilter(ScaleFilter&&) noexcept = default;

SplitScales ScaleFilter::Split(
  const Vector<double>& quantity, double wavelength, const StoppingCriteria& stop, const ExecutionContext& context)
{
  return this->Internal->Split(quantity, wavelength, stop, context);
}

Vector<double> ScaleFilter::Varying(const Vector<double>& quantity) const
{
  Vector<double> varying = quantity;
  this->Internal->Centre(varying);
  return varying;
}

const Vector<double>& ScaleFilter::Areas() const
{
  return this->Internal->Areas;
}

const SolveReport& ScaleFilter::Report() const
{
  return this->Internal->Report;
}

bool ScaleFilter::HasNewSetup() const
{
  return this->Internal->Setup.IsNew;
}

}
