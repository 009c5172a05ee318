#include "Flows/HodgeDecomposition.h"

#include "Directions/PowerFieldDirections.h"
#include "Flows/HarmonicFlows.h"
#include "Mesh/TriangleQuality.h"
#include "Support/ComplexPairs.h"
#include "Support/Errors.h"
#include "Support/Remedy.h"
#include "Support/ShortText.h"

#include <cmath>
#include <optional>
#include <utility>

namespace dmg
{
namespace
{

constexpr Complex QuarterTurn(0.0, 1.0);
/// Overlaps above this share of the energy are reported.
constexpr double LargestOverlap = 1e-8;
/// Caps above this share of the area are reported.
constexpr double LargestShareOfCaps = 0.1;

std::string WarningOfCaps(const CapFaces& caps)
{
  return std::to_string(std::lround(100.0 * caps.Share)) +
    " % of the surface have triangles with an angle above 150 degrees, where parts are as inaccurate as on triangles " +
    ShortText(0.1 * std::round(10.0 * caps.RelativeRadius)) + " times as large; " + TextOf(Remedy::Retriangulate);
}

/// Squares of the flow, and of what is computed of it, stay far from the largest and smallest doubles in this range.
constexpr double SmallestFlow = 1e-40;
constexpr double LargestFlow = 1e40;

void CheckFlow(const Vector<Complex>& flow, int faces)
{
  if (flow.size() != faces)
  {
    throw InvalidInput("the flow has " + std::to_string(flow.size()) + " vectors in place of one for each of the " +
      std::to_string(faces) + " faces");
  }
  for (int face = 0; face < faces; ++face)
  {
    if (!std::isfinite(flow[face].real()) || !std::isfinite(flow[face].imag()))
    {
      throw InvalidInput("the flow is not finite on face " + std::to_string(face) + "; repair it");
    }
  }
  const double largest = faces > 0 ? flow.cwiseAbs().maxCoeff() : 0.0;
  if (largest > LargestFlow || (largest > 0.0 && largest < SmallestFlow))
  {
    throw InvalidInput("the largest vector of the flow is " + ShortText(largest) + " long; bring it to between " +
      ShortText(SmallestFlow) + " and " + ShortText(LargestFlow) + ", " + TextOf(Remedy::Rescale));
  }
}

}

class HodgeDecomposition::Internals
{
public:
  Internals(const FramedMesh& surface, FlowBoundary boundary, const SolverOptions& options, bool isGlobe)
    : Geometry(surface)
    , Sides(FindSides(surface.Mesh, isGlobe))
    , IsOpen(OpenEdges(surface.Mesh, boundary))
    , Areas(surface.Mesh.FaceAreas())
    , Potentials(surface, options)
  {
    this->Potentials.SetBoundary(this->IsOpen);
  }

  void AddGradient(const StoppingCriteria& stop, DecomposedFlow& parts, const ExecutionContext& context);
  void AddRotational(const StoppingCriteria& stop, DecomposedFlow& parts, const ExecutionContext& context);
  void AddHarmonic(const Vector<Complex>& flow, DecomposedFlow& parts, const ExecutionContext& context);
  void AddSteering(
    const Vector<Complex>& flow, const StoppingCriteria& stop, DecomposedFlow& parts, const ExecutionContext& context);
  void AddBoundaries(const Vector<Complex>& flow, DecomposedFlow& parts) const;
  void SeeFromPositiveSide(DecomposedFlow& parts) const;
  void WarnOfCaps(DecomposedFlow& parts, const ExecutionContext& context);
  void MakeBasis(const ExecutionContext& context);
  double Norm(const Vector<Complex>& X) const { return FlowProduct(this->Areas, X, X); }

  const FramedMesh& Geometry;
  const SidesOfSurface Sides;
  std::vector<char> IsOpen; ///< by edge
  const Vector<double> Areas;
  FlowPotentials Potentials;
  std::optional<Eigen::MatrixXd> Basis;
  std::optional<Unfilled<Corner>> CornersOfFaces;
  std::optional<CapFaces> Caps;
  int Bases = 0;
  int Solves = 0;

private:
  void TakeReport(DecomposedFlow& parts);
};

void HodgeDecomposition::Internals::TakeReport(DecomposedFlow& parts)
{
  ++this->Solves;
  const SolveReport& report = this->Potentials.Report();
  parts.Converged &= report.Converged || report.EndedByRounding;
  parts.Warnings.insert(parts.Warnings.end(), report.Warnings.begin(), report.Warnings.end());
}

void HodgeDecomposition::Internals::AddGradient(
  const StoppingCriteria& stop, DecomposedFlow& parts, const ExecutionContext& context)
{
  parts.Potential = this->Potentials.Potential(parts.Derivatives, stop, context);
  this->TakeReport(parts);
  parts.Gradient = GradientOnFaces(this->Geometry, parts.Potential, context);
  parts.GradientEnergy = this->Norm(parts.Gradient);
}

void HodgeDecomposition::Internals::AddRotational(
  const StoppingCriteria& stop, DecomposedFlow& parts, const ExecutionContext& context)
{
  parts.StreamFunction = this->Potentials.StreamFunction(parts.Derivatives, stop, context);
  this->TakeReport(parts);
  parts.Rotational = QuarterTurn * GradientOnFaces(this->Geometry, parts.StreamFunction, context);
  parts.RotationalEnergy = this->Norm(parts.Rotational);
}

void HodgeDecomposition::Internals::MakeBasis(const ExecutionContext& context)
{
  if (!this->Basis)
  {
    this->Basis = HarmonicFlows(this->Potentials, context);
    this->Bases += this->Basis->cols() > 0 ? 1 : 0;
  }
}

void HodgeDecomposition::Internals::AddHarmonic(
  const Vector<Complex>& flow, DecomposedFlow& parts, const ExecutionContext& context)
{
  this->MakeBasis(context);
  Vector<Complex> weighted = flow;
  for (Eigen::Index face = 0; face < flow.size(); ++face)
  {
    weighted[face] *= this->Areas[face];
  }
  parts.Coefficients = this->Basis->transpose() * AsPairs(weighted);
  const Vector<double> field = *this->Basis * parts.Coefficients;
  parts.Harmonic = AsComplex(field);
  parts.HarmonicEnergy = this->Norm(parts.Harmonic);
}

void HodgeDecomposition::Internals::AddSteering(
  const Vector<Complex>& flow, const StoppingCriteria& stop, DecomposedFlow& parts, const ExecutionContext& context)
{
  const FlowFunctions inside = this->Potentials.ZeroOnBoundary(parts.Derivatives, stop, context);
  this->TakeReport(parts);
  ++this->Solves; // there are two
  parts.Steering = flow - GradientOnFaces(this->Geometry, inside.Potential, context) -
    QuarterTurn * GradientOnFaces(this->Geometry, inside.StreamFunction, context);
}

void HodgeDecomposition::Internals::AddBoundaries(const Vector<Complex>& flow, DecomposedFlow& parts) const
{
  const std::vector<BoundaryPart>& all = this->Potentials.Parts();
  const auto number = static_cast<Eigen::Index>(all.size());
  parts.Flux.resize(number);
  parts.Circulation.resize(number);
  parts.StreamValues.setZero(number);
  for (Eigen::Index k = 0; k < number; ++k)
  {
    const std::vector<int> vertices = all[k].OwnVertices();
    parts.Flux[k] = -parts.Derivatives.Divergence(vertices).sum();
    parts.Circulation[k] = -parts.Derivatives.Vorticity(vertices).sum();
    if (!all[k].IsLoop)
    {
      const Complex ofEnds = BoundaryFlowAt(all[k].Vertices.front(), this->Geometry, flow).After +
        BoundaryFlowAt(all[k].Vertices.back(), this->Geometry, flow).Before;
      parts.Flux[k] += ofEnds.real();
      parts.Circulation[k] += ofEnds.imag();
    }
    if (parts.StreamFunction.size() > 0)
    {
      parts.StreamValues[k] = parts.StreamFunction(all[k].Vertices).mean();
    }
  }
}

/// Solvers turn counter-clockwise as the cells do.
void HodgeDecomposition::Internals::SeeFromPositiveSide(DecomposedFlow& parts) const
{
  const Vector<double>& signs = this->Sides.OfVertices;
  parts.Derivatives.Vorticity.array() *= signs.array();
  if (parts.StreamFunction.size() > 0)
  {
    parts.StreamFunction.array() *= signs.array();
  }
  for (Eigen::Index k = 0; k < parts.Circulation.size(); ++k)
  {
    const double sign = signs[this->Potentials.Parts()[k].Vertices[0]];
    parts.Circulation[k] *= sign;
    parts.StreamValues[k] *= sign;
  }
}

void HodgeDecomposition::Internals::WarnOfCaps(DecomposedFlow& parts, const ExecutionContext& context)
{
  if (!this->Caps)
  {
    this->Caps = FindCaps(this->Geometry.Mesh, context);
  }
  if (this->Caps->Share > LargestShareOfCaps)
  {
    parts.Warnings.push_back(WarningOfCaps(*this->Caps));
  }
}

HodgeDecomposition::HodgeDecomposition(
  const FramedMesh& surface, FlowBoundary boundary, const SolverOptions& options, bool isGlobe)
  : Internal(std::make_unique<Internals>(surface, boundary, options, isGlobe))
{
}

HodgeDecomposition::~HodgeDecomposition() = default;

HodgeDecomposition::HodgeDecomposition(HodgeDecomposition&&) noexcept = default;

void HodgeDecomposition::SetBoundary(FlowBoundary boundary)
{
  this->SetBoundary(OpenEdges(this->Internal->Geometry.Mesh, boundary));
}

void HodgeDecomposition::SetBoundary(const std::vector<char>& isOpen)
{
  if (this->Internal->IsOpen != isOpen)
  {
    this->Internal->IsOpen = isOpen;
    this->Internal->Potentials.SetBoundary(isOpen);
    this->Internal->Basis.reset();
  }
}

DecomposedFlow HodgeDecomposition::Decompose(
  const Vector<Complex>& flow, const FlowParts& wanted, const StoppingCriteria& stop, const ExecutionContext& context)
{
  Internals& of = *this->Internal;
  CheckFlow(flow, of.Geometry.Mesh.NumberOfFaces());
  DecomposedFlow parts;
  parts.Derivatives = IntegratedDerivatives(of.Geometry, flow, context);
  parts.Energy = of.Norm(flow);
  parts.Residual = flow;
  if (wanted.Gradient)
  {
    of.AddGradient(stop, parts, PartOfContext(context, 0.0, 0.5));
    parts.Residual -= parts.Gradient;
  }
  if (wanted.Rotational)
  {
    of.AddRotational(stop, parts, PartOfContext(context, 0.5, 0.8));
    parts.Residual -= parts.Rotational;
  }
  if (wanted.Harmonic)
  {
    of.AddHarmonic(flow, parts, PartOfContext(context, 0.8, 0.9));
    parts.Residual -= parts.Harmonic;
  }
  if (wanted.Steering)
  {
    of.AddSteering(flow, stop, parts, PartOfContext(context, 0.9, 0.95));
  }
  parts.ResidualEnergy = of.Norm(parts.Residual);
  of.AddBoundaries(flow, parts);
  of.SeeFromPositiveSide(parts);
  const double overlap = std::abs(
    parts.Energy - parts.GradientEnergy - parts.RotationalEnergy - parts.HarmonicEnergy - parts.ResidualEnergy);
  if (overlap > LargestOverlap * parts.Energy)
  {
    parts.Warnings.push_back("The parts have " + ShortText(overlap / parts.Energy) +
      " of the energy in common, as some triangles are too thin, or the solver has not converged.");
  }
  if (wanted.Gradient || wanted.Rotational || wanted.Harmonic || wanted.Steering)
  {
    of.WarnOfCaps(parts, context);
  }
  context.Checkpoint(1.0);
  return parts;
}

const Eigen::MatrixXd& HodgeDecomposition::HarmonicBasis(const ExecutionContext& context)
{
  this->Internal->MakeBasis(context);
  return *this->Internal->Basis;
}

Vector<Complex> HodgeDecomposition::AtVertices(const Vector<Complex>& part, const ExecutionContext& context)
{
  const FramedMesh& on = this->Internal->Geometry;
  std::optional<Unfilled<Corner>>& corners = this->Internal->CornersOfFaces;
  if (!corners)
  {
    corners = Corners(on.Mesh, SideDirections(on.Mesh, on.Faces, context), on.Faces, on.Vertices, context);
  }
  return PowersAtVertices(on.Mesh, *corners, part, 1, context);
}

const std::vector<BoundaryPart>& HodgeDecomposition::Boundaries() const
{
  return this->Internal->Potentials.Parts();
}

SetupCache& HodgeDecomposition::Setups()
{
  return this->Internal->Potentials.SharedSetups();
}

const SidesOfSurface& HodgeDecomposition::Sides() const
{
  return this->Internal->Sides;
}

const SolveReport& HodgeDecomposition::Report() const
{
  return this->Internal->Potentials.Report();
}

HodgeDecomposition::StageCounts HodgeDecomposition::Counts() const
{
  const Internals& of = *this->Internal;
  return { of.Potentials.Counts().Setups, of.Bases + of.Potentials.Counts().Functions, of.Solves };
}

}
