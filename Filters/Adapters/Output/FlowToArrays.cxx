#include "Adapters/Output/FlowToArrays.h"

#include "Adapters/Output/ContoursToPolyData.h"
#include "Adapters/Pipeline/FiniteArrays.h"
#include "Adapters/Surface/ElementArrays.h"
#include "Adapters/Surface/PolyDataBuilder.h"
#include "Adapters/Surface/PreparationToFieldData.h"
#include "Drawing/ContourLines.h"
#include "Support/Errors.h"

#include "vtkCellData.h"
#include "vtkIntArray.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkStringArray.h"

#include <algorithm>
#include <string>

namespace dmg
{
namespace
{

using namespace ArrayNames;

/// The arrays of a surface with a decomposed flow.
class FlowArrays
{
public:
  FlowArrays(const SurfaceView& view, HodgeDecomposition& decomposition, const ExecutionContext& context)
    : View(view)
    , Decomposition(decomposition)
    , Context(context)
  {
  }

  void AddPart(const char* name, const Vector<Complex>& part) const
  {
    if (part.size() == 0)
    {
      return;
    }
    const FramedMesh& on = this->View.Surface().Geometry;
    this->View.OfCells(this->Context).AddVectors(name, on.Faces, part);
    const Vector<Complex> atVertices = this->Decomposition.AtVertices(part, this->Context);
    this->View.OfPoints(this->Context).AddVectors(name, on.Vertices, atVertices);
  }

  /// Adds numbers of vertices times a factor.
  void AddFunction(const char* name, const Vector<double>& values, double factor) const
  {
    if (values.size() > 0)
    {
      const Vector<double> scaled = factor * values;
      this->View.OfPoints(this->Context).Add(name, 1, scaled.data());
    }
  }

  void AddNumbers(const char* name, const Vector<double>& numbers) const
  {
    this->View.Output()->GetFieldData()->AddArray(NewArray<vtkDoubleArray>(name, 1, numbers));
  }

  void AllowNaNAtPoints(const std::vector<const char*>& names) const
  {
    for (const char* const name : names)
    {
      AllowNaN(this->View.Output()->GetPointData()->GetAbstractArray(name));
    }
  }

private:
  const SurfaceView& View;
  HodgeDecomposition& Decomposition;
  const ExecutionContext& Context;
};

/// Values with the same distance between neighbours, inside of the range of a function; none for a constant one.
std::vector<double> EvenValues(const Vector<double>& function, int number)
{
  std::vector<double> values;
  const double smallest = function.minCoeff();
  const double step = (function.maxCoeff() - smallest) / std::max(number, 1);
  for (int k = 0; k < number && step > 0.0; ++k)
  {
    values.push_back(smallest + (k + 0.5) * step);
  }
  return values;
}

/// The vertices, lifted off the surface along its normal.
Points LiftedVertices(const FramedMesh& surface, double lift)
{
  Points places = surface.Mesh.VertexPositions();
  const double height = lift * (places.colwise().maxCoeff() - places.colwise().minCoeff()).norm();
  for (int vertex = 0; vertex < places.rows() && height > 0.0; ++vertex)
  {
    places.row(vertex) += height * surface.Vertices.Normal(vertex).transpose();
  }
  return places;
}

/// Makes \p output the lines where the stream function of a flow has evenly spaced values.
void MakeStreamlines(const FramedMesh& surface, const Vector<double>& psi, const SidesOfSurface& sides,
  const FlowOptions& options, vtkPolyData* output, const ExecutionContext& context)
{
  std::vector<double> values = EvenValues(psi, options.NumberOfContours);
  const ContourLines lines =
    FindContourLines(surface.Mesh, LiftedVertices(surface, options.Lift), psi, values, sides, context);
  for (double& value : values)
  {
    value *= options.LengthScale;
  }
  ContoursToPolyData(lines, StreamFunction, values, output);
}

/// \throw InvalidInput there is none of this number.
void CheckIsBoundary(int number, std::size_t boundaries)
{
  if (number > 0 && static_cast<std::size_t>(number) >= boundaries)
  {
    throw InvalidInput("Reference Boundary is " + std::to_string(number) + ", and the surface has " +
      std::to_string(boundaries) + (boundaries == 1 ? " boundary" : " boundaries") + "; choose a number from 0 to " +
      std::to_string(std::max<std::size_t>(boundaries, 1) - 1));
  }
}

/// Makes \p output a line for each part of the boundary, closed where it is a loop, with the numbers of the flow.
void MakeBoundaries(const TriangleMesh& mesh, const std::vector<BoundaryPart>& loops, const DecomposedFlow& parts,
  const FlowOptions& options, vtkPolyData* output)
{
  CheckIsBoundary(options.ReferenceBoundary, loops.size());
  PolyDataBuilder drawing(PolyDataBuilder::Cells::Lines);
  for (const BoundaryPart& loop : loops)
  {
    const vtkIdType first = drawing.NumberOfPoints();
    for (const int vertex : loop.Vertices)
    {
      drawing.AddPoint(mesh.Position(vertex));
    }
    drawing.AddLine(first, drawing.NumberOfPoints(), loop.IsLoop);
  }
  drawing.Finish(output);
  const auto add = [&](const char* name, double scale, const auto& number)
  {
    Vector<double> numbers(static_cast<Eigen::Index>(loops.size()));
    for (Eigen::Index k = 0; k < numbers.size(); ++k)
    {
      numbers[k] = scale * number(k);
    }
    AddToCells<vtkDoubleArray>(output, name, numbers);
  };
  const double scale = options.LengthScale;
  const Vector<double>& values = parts.StreamValues;
  add(Boundary, 1.0, [](Eigen::Index k) { return static_cast<double>(k); });
  add(BoundaryLength, scale, [&](Eigen::Index k) { return loops[k].Length; });
  add(BoundaryIsOpen, 1.0, [&](Eigen::Index k) { return loops[k].IsOpen ? 1.0 : 0.0; });
  add(BoundaryCirculation, scale, [&](Eigen::Index k) { return parts.Circulation[k]; });
  add(BoundaryFlux, scale, [&](Eigen::Index k) { return parts.Flux[k]; });
  if (values.size() > 0 && !loops.empty())
  {
    const int reference = std::max(options.ReferenceBoundary, 0);
    const auto isBeside = [&](Eigen::Index k) { return loops[k].Component == loops[reference].Component; };
    add(BoundaryStreamFunction, scale, [&](Eigen::Index k) { return values[k]; });
    add(BoundaryTransport, scale, [&](Eigen::Index k) { return values[k] - (isBeside(k) ? values[reference] : 0.0); });
  }
}

/// \param report null: nothing was solved for.
void AddReport(const DecomposedFlow& parts, const SolveReport* report, vtkFieldData* data)
{
  if (!report)
  {
    return;
  }
  data->AddArray(NewValue<vtkStringArray>(ArrayNames::Solver, report->Solver));
  data->AddArray(NewValue<vtkIntArray>(ArrayNames::Converged, parts.Converged ? 1 : 0));
  data->AddArray(NewValue<vtkDoubleArray>(ArrayNames::SolverBytes, static_cast<double>(report->Bytes)));
}

/// \return what the user should know of them.
std::string AddDerivatives(
  const FlowArrays& arrays, const DerivativesAtVertices& derivatives, const SidesOfSurface& sides, double scale)
{
  arrays.AddFunction(Divergence, derivatives.Divergence, 1.0 / scale);
  arrays.AddFunction(Vorticity, Vector<double>(derivatives.Vorticity.cwiseProduct(sides.OfVertices)), 1.0 / scale);
  std::string warning = WarningOfUndetermined(derivatives);
  if (!warning.empty())
  {
    arrays.AllowNaNAtPoints({ Divergence, Vorticity });
  }
  return warning;
}

void AddEnergies(const FlowArrays& arrays, const DecomposedFlow& parts, double scale)
{
  Vector<double> energies(5);
  energies << parts.Energy, parts.GradientEnergy, parts.RotationalEnergy, parts.HarmonicEnergy, parts.ResidualEnergy;
  arrays.AddNumbers(FlowEnergies, scale * scale * energies);
  arrays.AddNumbers(
    FlowShares, parts.Energy > 0.0 ? Vector<double>(energies.tail(4) / parts.Energy) : Vector<double>::Zero(4));
  arrays.AddNumbers(HarmonicCoefficients, scale * parts.Coefficients);
}

/// The widths of half the first row of triangles beside each boundary: their area over the length of the boundary. Where the points are
/// centres of cells, the flow of such a strip is missing in transports.
Vector<double> HalfCells(const TriangleMesh& mesh, const std::vector<BoundaryPart>& all)
{
  Vector<double> widths = Vector<double>::Zero(static_cast<Eigen::Index>(all.size()));
  for (Eigen::Index k = 0; k < widths.size(); ++k)
  {
    const std::vector<int>& vertices = all[k].Vertices;
    for (std::size_t i = 0; i < vertices.size() - (all[k].IsLoop ? 0 : 1); ++i)
    {
      widths[k] += mesh.FaceArea(TriangleMesh::FaceOf(mesh.OutgoingHalfedge(vertices[i])));
    }
    widths[k] /= all[k].Length > 0.0 ? all[k].Length : 1.0;
  }
  return widths;
}

void AddBoundaries(const FlowArrays& arrays, const DecomposedFlow& parts, const std::vector<BoundaryPart>& all,
  const SurfaceRelation& relation, double scale)
{
  Vector<double> points(static_cast<Eigen::Index>(all.size()));
  Vector<double> lengths(points.size());
  Vector<double> areOpen(points.size());
  for (Eigen::Index k = 0; k < points.size(); ++k)
  {
    const std::vector<int>& vertices = all[k].Vertices;
    points[k] = static_cast<double>(relation.PointOf(vertices[all[k].IsLoop ? 0 : vertices.size() / 2]));
    lengths[k] = scale * all[k].Length;
    areOpen[k] = all[k].IsOpen ? 1.0 : 0.0;
  }
  arrays.AddNumbers(BoundaryPoint, points);
  arrays.AddNumbers(BoundaryLength, lengths);
  arrays.AddNumbers(BoundaryIsOpen, areOpen);
  arrays.AddNumbers(BoundaryCirculation, scale * parts.Circulation);
  arrays.AddNumbers(BoundaryFlux, scale * parts.Flux);
  arrays.AddNumbers(BoundaryStreamFunction, scale * parts.StreamValues);
}

}

std::string WriteFlow(const DecomposedFlow& parts, HodgeDecomposition& decomposition, const FaceFlow& flow,
  const FlowOptions& options, const SurfaceView& view, vtkPolyData* streamlines, vtkPolyData* boundaries,
  const ExecutionContext& context)
{
  vtkDataSet* const output = view.Output();
  const FramedMesh& on = view.Surface().Geometry;
  const double scale = options.LengthScale;
  const SidesOfSurface& sides = decomposition.Sides();
  AddPositiveSide(sides.Kinds, output->GetFieldData());
  const FlowArrays arrays(view, decomposition, context);
  arrays.AddPart(GradientPart, parts.Gradient);
  arrays.AddPart(RotationalPart, parts.Rotational);
  context.Checkpoint(0.5);
  arrays.AddPart(HarmonicPart, parts.Harmonic);
  arrays.AddPart(Residual, parts.Residual);
  arrays.AddPart(SteeringFlow, parts.Steering);
  if (flow.Normal.size() > 0)
  {
    view.OfCells(context).Add(NormalComponent, 1, Vector<double>(flow.Normal.cwiseProduct(sides.OfFaces)).data());
  }
  arrays.AddFunction(Potential, parts.Potential, scale);
  arrays.AddFunction(StreamFunction, parts.StreamFunction, scale);
  const std::string warning =
    options.Derivatives ? AddDerivatives(arrays, flow.Derivatives(context), sides, scale) : "";
  AddEnergies(arrays, parts, scale);
  AddBoundaries(arrays, parts, decomposition.Boundaries(), view.Relation(), scale);
  if (options.IsOfCentres)
  {
    arrays.AddNumbers(BoundaryHalfCell, scale * HalfCells(on.Mesh, decomposition.Boundaries()));
  }
  MakeBoundaries(on.Mesh, decomposition.Boundaries(), parts, options, boundaries);
  view.LinesBack(boundaries);
  const bool isSolved = options.Parts.Gradient || options.Parts.Rotational || options.Parts.Steering;
  AddReport(parts, isSolved ? &decomposition.Report() : nullptr, output->GetFieldData());
  if (parts.StreamFunction.size() > 0)
  {
    output->GetPointData()->SetActiveScalars(StreamFunction);
    MakeStreamlines(on, parts.StreamFunction, sides, options, streamlines, context);
    view.LinesBack(streamlines);
  }
  context.Checkpoint(1.0);
  return warning;
}

}
