#include "Scales/ScaleFilter.h"

#include "Operators/ExteriorCalculus.h"
#include "Scales/ScaleSystem.h"
#include "Scales/SquaredStiffness.h"
#include "Setup/SetupCache.h"
#include "Support/Errors.h"
#include "Support/ShortText.h"
#include "Support/Stopwatch.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

namespace dmg
{
namespace
{

/// Beyond so many times the largest eigenvalue, nothing but rounding is above the wavelength.
constexpr double LargestShift = 1e15;

/// Shorter waves have an amplitude that is off by a twentieth or more (LengthOnMesh).
constexpr double FewestCells = 4.0;

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
double UnitOf(double largest)
{
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
  Internals(std::unique_ptr<ScaleSystem> system, const ScaleFilterOptions& options)
    : System(std::move(system))
    , Order(options.Order)
    , LengthScale(options.LengthScale)
    , Least(LeastOf(options.RelativeWavelengths))
    , Most(MostOf(options.RelativeWavelengths))
    , Squared(this->System->Stiffness(), this->System->Mass)
  {
  }

  SplitScales Split(
    const Vector<double>& quantity, double wavelength, const StoppingCriteria& stop, const ExecutionContext& context);
  double Sum(double here) const { return this->System->Stiffness().Sum(here); }

  const std::unique_ptr<ScaleSystem> System;
  SolveReport Report;

private:
  void CheckQuantity(const Vector<double>& quantity) const;
  /// The system stage.
  void TakeWavelength(double wavelength, const ExecutionContext& context);
  void WarnOf(double wavelength);
  /// 1 / (2 c^2) or, of order 2, 1 / (sqrt 2 c^2), in units of the mean area. \param wavelength in the unit of the points.
  double ShiftOf(double wavelength) const;
  /// The right-hand side of the part above or below. \param smoothed R f. \return scaled as the matrix is.
  Vector<double> RightHandSide(
    bool isAbove, const Vector<double>& f, const Vector<double>& smoothed, const ExecutionContext& context) const;
  /// The part above or below of the unknowns of a centred quantity of magnitude 1, the smaller one of the two.
  Vector<double> SolveForSmaller(
    const Vector<double>& f, bool& isAbove, const StoppingCriteria& stop, const ExecutionContext& context);

  const int Order;
  const double LengthScale;
  const double Least, Most;          ///< of relative wavelengths
  SquaredStiffness Squared;          ///< R M^-1 R + s^2 M
  double Wavelength = 0.0;           ///< that the equations have; 0: none
  double Shift = 0.0;                ///< s
  std::vector<std::string> Warnings; ///< of the wavelength
};

void ScaleFilter::Internals::CheckQuantity(const Vector<double>& quantity) const
{
  const int numbers = this->System->NumbersPerVertex;
  const Eigen::Index size = numbers * this->System->Areas.size();
  if (quantity.size() != size)
  {
    throw InvalidInput("the quantity to be filtered has " + std::to_string(quantity.size()) + " numbers in place of " +
      std::to_string(size) + "; give " + std::to_string(numbers) + " for each vertex");
  }
  for (Eigen::Index i = 0; i < size; ++i)
  {
    if (!std::isfinite(quantity[i]))
    {
      throw InvalidInput(
        "the quantity to be filtered is not finite at vertex " + std::to_string(i / numbers) + "; repair it");
    }
  }
}

double ScaleFilter::Internals::ShiftOf(double wavelength) const
{
  const double c = wavelength / (2.0 * Pi);
  return this->System->MeanArea / ((this->Order == 1 ? 2.0 : std::sqrt(2.0)) * c * c);
}

void ScaleFilter::Internals::WarnOf(double wavelength)
{
  this->Warnings.clear();
  const double shortest = this->Least * wavelength;
  const double cells = shortest / this->LengthScale / this->System->Sizes.MeanEdge;
  const double longest = 2.0 * std::sqrt(this->System->Sizes.Area) * this->LengthScale;
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
  this->Shift = std::min(this->ShiftOf(wavelength / this->LengthScale), LargestShift * this->System->LargestEigenvalue);
  this->Squared.SetShift(this->Shift);
  this->WarnOf(wavelength);
  this->Report = {};
  const double ofLongest = this->ShiftOf(2.0 * Pi * this->System->Sizes.Diagonal() / this->Least);
  this->System->SetShift(this->Shift, std::max(this->Shift, ofLongest), this->Report, context);
  this->Report.PrepareSeconds = watch.Seconds();
  this->Wavelength = wavelength;
}

Vector<double> ScaleFilter::Internals::RightHandSide(
  bool isAbove, const Vector<double>& f, const Vector<double>& smoothed, const ExecutionContext& context) const
{
  if (!isAbove)
  {
    return std::pow(this->Shift, this->Order) * this->System->Mass.cwiseProduct(f);
  }
  if (this->Order == 1)
  {
    return smoothed;
  }
  Vector<double> twice;
  this->Squared.ApplySquare(f, twice, context);
  return twice;
}

/// The part above is solved for if something is fixed: its equations see the fixed values, and are zero there.
Vector<double> ScaleFilter::Internals::SolveForSmaller(
  const Vector<double>& f, bool& isAbove, const StoppingCriteria& stop, const ExecutionContext& context)
{
  Vector<double> Rf;
  const double smoothness = this->System->Stiffness().Apply(f, Rf, context);
  const double square = this->Sum(f.dot(this->System->Mass.cwiseProduct(f)));
  isAbove = this->System->HasFixed || smoothness < this->Shift * square;
  this->Report.Warnings = this->Warnings;
  const bool isSquared = this->Order == 2;
  const LinearOperator<double>& shifted = this->System->Shifted();
  return this->System->Solve(isSquared ? this->Squared : shifted, isSquared,
    this->RightHandSide(isAbove, f, Rf, context), stop, this->Report, context);
}

SplitScales ScaleFilter::Internals::Split(
  const Vector<double>& quantity, double wavelength, const StoppingCriteria& stop, const ExecutionContext& context)
{
  CheckWavelength(wavelength);
  this->System->Together([&] { this->CheckQuantity(quantity); });
  if (!this->System->HasUnknowns)
  {
    this->Report = {};
    this->Report.Converged = true;
    return { quantity, Vector<double>::Zero(quantity.size()) };
  }
  this->TakeWavelength(wavelength, PartOfContext(context, 0.0, 0.4));
  const double unit = UnitOf(this->System->Max(quantity.size() > 0 ? quantity.cwiseAbs().maxCoeff() : 0.0));
  Vector<double> varying = quantity / unit;
  this->System->Centre(varying);
  bool isAbove = false;
  const PartOfContext solving(context, 0.4, 1.0);
  Vector<double> part = this->System->QuantityOf(
    this->SolveForSmaller(this->System->UnknownsOf(varying, context), isAbove, stop, solving), context);
  this->System->Centre(part);
  if (!std::isfinite(this->Sum(part.allFinite() ? 0.0 : std::numeric_limits<double>::infinity())))
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
  : ScaleFilter(SystemOfSurface(setups, options, context), options)
{
}

ScaleFilter::ScaleFilter(std::unique_ptr<ScaleSystem> system, const ScaleFilterOptions& options)
  : Internal(std::make_unique<Internals>(std::move(system), options))
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
  this->Internal->System->Centre(varying);
  return varying;
}

double ScaleFilter::Energy(const Vector<double>& quantity) const
{
  const Vector<double>& areas = this->Areas();
  const Eigen::Index numbers = this->Internal->System->NumbersPerVertex;
  double energy = 0.0;
  for (Eigen::Index i = 0; i < quantity.size(); ++i)
  {
    energy += areas[i / numbers] * quantity[i] * quantity[i];
  }
  return this->Internal->Sum(energy);
}

double ScaleFilter::Mean(const Vector<double>& function) const
{
  const Vector<double>& areas = this->Areas();
  const double integral = this->Internal->Sum(areas.dot(function));
  return integral / this->Internal->Sum(areas.sum());
}

const Vector<double>& ScaleFilter::Areas() const
{
  return this->Internal->System->Areas;
}

const SurfaceSizes& ScaleFilter::Sizes() const
{
  return this->Internal->System->Sizes;
}

const SolveReport& ScaleFilter::Report() const
{
  return this->Internal->Report;
}

bool ScaleFilter::HasNewSetup() const
{
  return this->Internal->System->HasNewSetup;
}

}
