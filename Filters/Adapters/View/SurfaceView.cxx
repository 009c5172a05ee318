#include "Adapters/View/SurfaceView.h"

#include "Adapters/Pipeline/FilterOutputs.h"
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

/// Gives the elements without a vector the mean of their neighbours, as far as these have one.
/// \param visitNeighbours calls a function with each of them.
template <class VisitNeighbours>
void FillFromNeighbours(Points& vectors, const std::vector<char>& isDefined, const VisitNeighbours& visitNeighbours)
{
  for (int element = 0; element < vectors.rows(); ++element)
  {
    if (isDefined[element])
    {
      continue;
    }
    Vector3 sum = Vector3::Zero();
    int number = 0;
    visitNeighbours(element,
      [&](int neighbour)
      {
        sum += isDefined[neighbour] ? Vector3(vectors.row(neighbour).transpose()) : Vector3::Zero();
        number += isDefined[neighbour] ? 1 : 0;
      });
    vectors.row(element) = sum.transpose() / std::max(number, 1);
  }
}

/// Calls visit(vertex) for the neighbours of a vertex.
template <class Visit>
void VisitNeighboursOfVertex(const TriangleMesh& mesh, int vertex, const Visit& visit)
{
  mesh.VisitFan(vertex,
    [&](int h)
    {
      visit(mesh.Head(h));
      if (mesh.Twin(TriangleMesh::Previous(h)) < 0)
      {
        visit(mesh.Tail(TriangleMesh::Previous(h)));
      }
    });
}

/// Calls visit(face) for the neighbours of the faces of a cell, that of a face.
template <class Visit>
void VisitNeighboursOfCell(const TriangleMesh& mesh, const SurfaceRelation& relation, int face, const Visit& visit)
{
  for (const int part : relation.FacesOf(relation.CellOf(face)))
  {
    mesh.VisitNeighbours(part, visit);
  }
}

}

Points VectorsOnSurface::OnFaces(const TriangleMesh& mesh) const
{
  if (!this->AreAtVertices)
  {
    return this->Values;
  }
  Points means(mesh.NumberOfFaces(), 3);
  for (int face = 0; face < means.rows(); ++face)
  {
    const auto corners = mesh.FaceCorners().row(face);
    means.row(face) =
      (this->Values.row(corners[0]) + this->Values.row(corners[1]) + this->Values.row(corners[2])) / 3.0;
  }
  return means;
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

bool SurfaceView::IsPole(const Vector3& place) const
{
  return std::any_of(
    this->Steps.begin(), this->Steps.end(), [&place](const auto& step) { return step->IsPole(place); });
}

bool SurfaceView::IsFromPlane() const
{
  return std::any_of(this->Steps.begin(), this->Steps.end(), [](const auto& step) { return step->IsFromPlane(); });
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
  const Points places = atVertices ? mesh.VertexPositions() : CellCentres(mesh, relation);
  Points vectors(places.rows(), 3);
  std::vector<char> isDefined(places.rows(), 1);
  for (int element = 0; element < vectors.rows(); ++element)
  {
    const Vector3 place = places.row(element).transpose();
    Vector3 vector = arrays.At(atVertices ? relation.PointOf(element) : relation.CellOf(element), place);
    for (auto step = this->Steps.begin(); step != this->Steps.end() && !arrays.AreComponents(); ++step)
    {
      vector = (*step)->VectorForth(vector, place);
    }
    vectors.row(element) = vector.transpose();
    isDefined[element] = this->IsPole(place) ? 0 : 1;
  }
  FillFromNeighbours(vectors, isDefined,
    [&](int element, const auto& visit)
    {
      atVertices ? VisitNeighboursOfVertex(mesh, element, visit)
                 : VisitNeighboursOfCell(mesh, relation, element, visit);
    });
  return { atVertices, std::move(vectors) };
}

void SurfaceView::StartOutput(vtkDataSet* output)
{
  this->OutputData = output;
  output->ShallowCopy(this->GivenData);
  AddPreparation(this->Report, this->Options, output->GetFieldData());
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
