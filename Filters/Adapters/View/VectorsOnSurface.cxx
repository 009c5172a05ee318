#include "Adapters/View/VectorsOnSurface.h"

#include "Mesh/NormalParts.h"

#include "vtkDataSet.h"
#include "vtkIdList.h"
#include "vtkNew.h"

#include <algorithm>
#include <utility>

namespace dmg
{
namespace
{

/// \param visitNeighbours calls a function with each neighbour of an element.
template <class VisitNeighbours>
void FillFrom(Points& vectors, const std::vector<char>& isDefined, const VisitNeighbours& visitNeighbours)
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

/// Whether some point shares the vertex of another one.
bool AreJoined(vtkIdType points, const SurfaceRelation& relation)
{
  for (vtkIdType point = 0; point < points && !relation.IsOneToOne(); ++point)
  {
    const ElementRow vertices = relation.VerticesOf(point);
    if (!vertices.empty() && relation.PointOf(vertices.front()) != point)
    {
      return true;
    }
  }
  return false;
}

/// The point of a cell that is at a vertex.
vtkIdType PointAt(vtkIdList* points, int vertex, const SurfaceRelation& relation)
{
  const auto isAt = [&](vtkIdType point)
  {
    const ElementRow vertices = relation.VerticesOf(point);
    return std::find(vertices.begin(), vertices.end(), vertex) != vertices.end();
  };
  const auto found = std::find_if(points->begin(), points->end(), isAt);
  return found == points->end() ? relation.PointOf(vertex) : *found;
}

}

double VectorsOnSurface::TakeOutNormalParts(const TriangleMesh& mesh, const SurfaceRelation& relation)
{
  if (!this->AreAtVertices)
  {
    this->Values = WithoutNormalPartsOfCells(mesh, relation, this->Values);
    return 0.0;
  }
  SplitVectors split = WithoutNormalParts(mesh, this->Values, this->AtCorners);
  this->Values = std::move(split.Tangential);
  this->AtCorners = std::move(split.AtCorners);
  return split.RatioAtRim;
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
    const auto at = [&](int h)
    { return this->AtCorners.rows() > 0 ? this->AtCorners.row(h) : this->Values.row(mesh.Tail(h)); };
    means.row(face) = (at(3 * face) + at(3 * face + 1) + at(3 * face + 2)) / 3.0;
  }
  return means;
}

std::vector<vtkIdType> PointsOfCorners(vtkDataSet* dataset, const TriangleMesh& mesh, const SurfaceRelation& relation)
{
  std::vector<vtkIdType> points;
  if (!AreJoined(dataset->GetNumberOfPoints(), relation))
  {
    return points;
  }
  bool areOfVertices = true;
  vtkNew<vtkIdList> ofCell;
  for (int h = 0; h < 3 * mesh.NumberOfFaces(); ++h)
  {
    if (h % 3 == 0)
    {
      dataset->GetCellPoints(relation.CellOf(TriangleMesh::FaceOf(h)), ofCell);
    }
    points.push_back(PointAt(ofCell, mesh.Tail(h), relation));
    areOfVertices = areOfVertices && points.back() == relation.PointOf(mesh.Tail(h));
  }
  return areOfVertices ? std::vector<vtkIdType>() : points;
}

void FillFromNeighbours(VectorsOnSurface& vectors, const std::vector<char>& isDefined, const TriangleMesh& mesh,
  const SurfaceRelation& relation)
{
  FillFrom(vectors.Values, isDefined,
    [&](int element, const auto& visit)
    {
      vectors.AreAtVertices ? VisitNeighboursOfVertex(mesh, element, visit)
                            : VisitNeighboursOfCell(mesh, relation, element, visit);
    });
}

}
