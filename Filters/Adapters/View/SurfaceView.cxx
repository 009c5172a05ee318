#include "Adapters/View/SurfaceView.h"

#include "Adapters/Pipeline/FilterOutputs.h"
#include "Adapters/Surface/OutputTable.h"
#include "Adapters/Surface/PreparationToFieldData.h"
#include "Flows/FittedDerivatives.h" // For CellCentres
#include "Mesh/PositiveSide.h"

#include "vtkCellData.h"
#include "vtkDataSet.h"
#include "vtkPointData.h"

#include <algorithm>

namespace dmg
{
namespace
{

/// The mean of the vectors of the points that the corners around a vertex have, each counted once.
template <class VectorAt>
Vector3 MeanOfPoints(
  const TriangleMesh& mesh, const std::vector<vtkIdType>& ofCorners, int vertex, const VectorAt& vectorAt)
{
  std::vector<vtkIdType> points;
  mesh.VisitFan(vertex, [&](int h) { points.push_back(ofCorners[h]); });
  std::sort(points.begin(), points.end());
  points.erase(std::unique(points.begin(), points.end()), points.end());
  Vector3 sum = Vector3::Zero();
  for (const vtkIdType point : points)
  {
    sum += vectorAt(point, vertex);
  }
  return sum / static_cast<double>(points.size());
}

}

void SurfaceView::Prepare(const PreparationOptions& options, const ExecutionContext& context)
{
  this->Kept = PrepareDataSet(this->Data(), options, context);
  this->Prepare(options, this->Kept->Surface(), this->Kept->Report);
}

void SurfaceView::Prepare(
  const PreparationOptions& options, const FramedSurface& surface, const PreparationReport& report)
{
  this->Options = options;
  this->Framed.emplace(surface);
  this->Report = report;
}

Vector3 SurfaceView::PlaceForth(Vector3 place) const
{
  for (const auto& step : this->Steps)
  {
    place = step->PlaceForth(place);
  }
  return place;
}

Vector3 SurfaceView::VectorForth(const VectorArrays& arrays, vtkIdType tuple, const Vector3& place) const
{
  Vector3 vector = arrays.At(tuple, place);
  for (auto step = this->Steps.begin(); step != this->Steps.end() && !arrays.AreComponents(); ++step)
  {
    vector = (*step)->VectorForth(vector, place);
  }
  return vector;
}

bool SurfaceView::IsPole(const Vector3& place) const
{
  return std::any_of(
    this->Steps.begin(), this->Steps.end(), [&place](const auto& step) { return step->IsPole(place); });
}

bool SurfaceView::IsFromPlane() const
{
  return std::any_of(this->Steps.begin(), this->Steps.end(), [](const auto& step) { return step->IsFromPlane(); });
}

Points SurfaceView::PlacesOfCells(const Points& centres) const
{
  Points places = centres;
  for (const auto& step : this->Steps)
  {
    for (int face = 0; face < places.rows(); ++face)
    {
      if (const auto place = step->PlaceOfCell(this->Relation().CellOf(face)))
      {
        places.row(face) = place->transpose();
      }
    }
  }
  return places;
}

VectorsOnSurface SurfaceView::Vectors(const VectorArrays& arrays) const
{
  const TriangleMesh& mesh = this->Mesh();
  const SurfaceRelation& relation = this->Relation();
  if (arrays.AreComponents() && HaveConstantZ(mesh.VertexPositions()))
  {
    throw WrongChoice("the surface is a plane, and eastward and northward components need a globe around the origin; "
                      "set Coordinates to Longitude and Latitude in Degrees, or choose vectors");
  }
  if (const std::string problem = this->IsFromPlane() ? "" : arrays.ProblemOn(mesh.VertexPositions()); !problem.empty())
  {
    throw WrongChoice(problem);
  }
  const bool atVertices = arrays.AreOnPoints();
  const std::vector<vtkIdType> ofCorners =
    atVertices ? PointsOfCorners(this->Data(), mesh, relation) : std::vector<vtkIdType>();
  const Points places = atVertices ? mesh.VertexPositions() : CellCentres(mesh, relation);
  const auto at = [&](vtkIdType tuple, int element)
  { return this->VectorForth(arrays, tuple, places.row(element).transpose()); };
  VectorsOnSurface vectors{ atVertices, Points(places.rows(), 3) };
  vectors.Places = atVertices ? Points() : this->PlacesOfCells(places);
  std::vector<char> isDefined(places.rows(), 1);
  for (int element = 0; element < places.rows(); ++element)
  {
    const Vector3 vector = !ofCorners.empty()
      ? MeanOfPoints(mesh, ofCorners, element, at)
      : at(atVertices ? relation.PointOf(element) : relation.CellOf(element), element);
    vectors.Values.row(element) = vector.transpose();
    isDefined[element] = this->IsPole(places.row(element).transpose()) ? 0 : 1;
  }
  FillFromNeighbours(vectors, isDefined, mesh, relation);
  vectors.AtCorners.resize(static_cast<Eigen::Index>(ofCorners.size()), 3);
  for (int h = 0; h < vectors.AtCorners.rows(); ++h)
  {
    const int vertex = mesh.Tail(h);
    vectors.AtCorners.row(h) =
      isDefined[vertex] ? at(ofCorners[h], vertex).transpose().eval() : vectors.Values.row(vertex).eval();
  }
  return vectors;
}

Vector<double> SurfaceView::Numbers(const ChosenArray& chosen) const
{
  const TriangleMesh& mesh = this->Mesh();
  const SurfaceRelation& relation = this->Relation();
  const bool atVertices = chosen.OnPoints();
  const std::vector<vtkIdType> ofCorners =
    atVertices ? PointsOfCorners(this->Data(), mesh, relation) : std::vector<vtkIdType>();
  const auto at = [&chosen](vtkIdType tuple, int) { return Vector3(chosen.Array->GetComponent(tuple, 0), 0.0, 0.0); };
  Vector<double> numbers(atVertices ? mesh.NumberOfVertices() : mesh.NumberOfFaces());
  for (int element = 0; element < numbers.size(); ++element)
  {
    numbers[element] = ofCorners.empty()
      ? at(atVertices ? relation.PointOf(element) : relation.CellOf(element), element)[0]
      : MeanOfPoints(mesh, ofCorners, element, at)[0];
  }
  return numbers;
}

void SurfaceView::StartOutput(vtkDataSet* output, const std::string& filter)
{
  this->OutputData = output;
  output->ShallowCopy(this->GivenData);
  RemoveOutputs(filter, output);
  AddPreparation(this->Report, this->Options, output->GetFieldData());
  AddPositiveSide(this->Report.Sides, output->GetFieldData());
  for (const auto& step : this->Steps)
  {
    step->Report(output->GetFieldData());
  }
}

ArrayChange SurfaceView::WayBack() const
{
  if (this->Steps.empty())
  {
    return {};
  }
  return [this](const AddedArray& added)
  {
    std::for_each(
      this->Steps.rbegin(), this->Steps.rend(), [&](const auto& step) { step->ArrayBack(added, this->Relation()); });
  };
}

ArraysOfCells SurfaceView::OfCells(const ExecutionContext& context, double elsewhere) const
{
  return { this->Mesh(), this->Relation(), this->GivenData, this->OutputData->GetCellData(), context, elsewhere,
    this->WayBack() };
}

ArraysOfPoints SurfaceView::OfPoints(const ExecutionContext& context, double elsewhere) const
{
  return { this->Relation(), this->GivenData, this->OutputData->GetPointData(), context, elsewhere, this->WayBack() };
}

void SurfaceView::LinesBack(vtkPolyData* lines) const
{
  std::for_each(this->Steps.rbegin(), this->Steps.rend(), [lines](const auto& step) { step->LinesBack(lines); });
}

std::vector<std::string> SurfaceView::Warnings() const
{
  std::vector<std::string> warnings;
  std::for_each(this->Steps.rbegin(), this->Steps.rend(),
    [&](const auto& step) { warnings.push_back(step->Warning(this->Mesh())); });
  return warnings;
}

}
