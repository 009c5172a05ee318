#include "StructurePreserving/Decimation/CollapsibleMesh.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dmg
{

namespace
{

// Share of length^4 in the cost. Larger values give rounder coarse triangles and a worse approximation.
constexpr double LengthShare = 0.03;

constexpr int Grain = 4096;

}

CollapsibleMesh::CollapsibleMesh(const TriangleMesh& mesh, const ExecutionContext& context)
  : Positions(mesh.NumberOfVertices())
  , Quadrics(mesh.NumberOfVertices())
  , Corners(mesh.FaceCorners().data(), mesh.FaceCorners().data() + mesh.FaceCorners().size())
  , Twins(mesh.HalfedgeTwins())
  , Outgoing(mesh.NumberOfVertices())
  , LiveFaces(mesh.NumberOfFaces())
{
  this->Origin =
    0.5 * (mesh.VertexPositions().colwise().minCoeff() + mesh.VertexPositions().colwise().maxCoeff()).transpose();
  context.ParallelFor(0, mesh.NumberOfVertices(), Grain,
    [&](int first, int last)
    {
      for (int v = first; v < last; ++v)
      {
        this->Positions[v] = mesh.Position(v);
        this->Outgoing[v] = mesh.OutgoingHalfedge(v);
      }
    });
  context.ParallelFor(0, mesh.NumberOfVertices(), Grain,
    [&](int first, int last)
    {
      for (int v = first; v < last; ++v)
      {
        this->VisitOutgoing(v, [&](int h) { this->AddPlanes(mesh, h, this->Quadrics[v]); });
      }
    });
}

// The planes that a face adds to the quadric of its corner at the tail of a halfedge.
void CollapsibleMesh::AddPlanes(const TriangleMesh& mesh, int halfedge, Quadric& quadric) const
{
  const Vector3 areaVector = mesh.FaceAreaVector(TriangleMesh::FaceOf(halfedge));
  const double doubleArea = areaVector.norm();
  if (doubleArea == 0.0)
  {
    return;
  }
  const Vector3 normal = areaVector / doubleArea;
  const Vector3 corner = this->Positions[this->Tail(halfedge)] - this->Origin;
  quadric.AddPlane(normal, normal.dot(corner), 0.5 * doubleArea);
  for (int h : { halfedge, TriangleMesh::Previous(halfedge) })
  {
    // A plane through the boundary edge, perpendicular to the face, holds the boundary in place.
    const Vector3 side = this->Positions[this->Head(h)] - this->Positions[this->Tail(h)];
    const double squaredLength = side.squaredNorm();
    if (this->Twins[h] < 0 && squaredLength > 0.0)
    {
      const Vector3 across = side.cross(normal) / std::sqrt(squaredLength);
      quadric.AddPlane(across, across.dot(corner), squaredLength);
    }
  }
}

void CollapsibleMesh::InheritQuadrics(const CollapsibleMesh& finer, const std::vector<int>& vertexNumber)
{
  this->Origin = finer.Origin;
  for (std::size_t v = 0; v < vertexNumber.size(); ++v)
  {
    if (vertexNumber[v] >= 0)
    {
      this->Quadrics[vertexNumber[v]] = finer.Quadrics[v];
    }
  }
}

double CollapsibleMesh::CollapseCost(int halfedge) const
{
  const int i = this->Tail(halfedge);
  const int j = this->Head(halfedge);
  const Vector3& p = this->Positions[i];
  const Vector3& q = this->Positions[j];
  Vector3 place;
  if (this->Twins[halfedge] < 0)
  {
    place = 0.5 * (p + q);
  }
  else
  {
    const bool iOnBoundary = this->IsBoundaryVertex(i);
    const bool jOnBoundary = this->IsBoundaryVertex(j);
    if (iOnBoundary && jOnBoundary)
    {
      return std::numeric_limits<double>::infinity();
    }
    place = iOnBoundary ? p : jOnBoundary ? q : Vector3(0.5 * (p + q));
  }
  place -= this->Origin;
  const double squaredLength = (q - p).squaredNorm();
  return std::abs(this->Quadrics[i].At(place) + this->Quadrics[j].At(place)) +
    LengthShare * squaredLength * squaredLength;
}

CollapsibleMesh::Afterwork CollapsibleMesh::Collapse(const OneRing& ring)
{
  for (const OneRing::Sector& sector : ring.Sectors)
  {
    this->Corners[3 * sector.Face + sector.HubCorner] = ring.Target;
  }
  for (int d = 0; d < ring.NumberOfDead; ++d)
  {
    std::fill_n(this->Corners.begin() + 3 * ring.Dead[d].Face, 3, -1);
  }
  for (int g = 0; g < ring.NumberOfGlued; ++g)
  {
    this->Twins[ring.Glued[g][0]] = ring.Glued[g][1];
    if (ring.Glued[g][1] >= 0)
    {
      this->Twins[ring.Glued[g][1]] = ring.Glued[g][0];
    }
  }
  this->Positions[ring.Target] = ring.Positions[ring.HubIndex()];
  this->Quadrics[ring.Target].Add(this->Quadrics[ring.Removed]);
  this->Outgoing[ring.Removed] = -1;
  if (ring.Kind == CollapseKind::OntoBoundary)
  {
    // The boundary may leave the kept vertex by its first spoke, which lay in a dead face.
    const int leaving = ring.Sectors.front().LeavingSpoke();
    if (this->Twins[leaving] < 0 || this->Corners[this->Outgoing[ring.Target]] < 0)
    {
      this->Outgoing[ring.Target] = leaving;
    }
  }
  else
  {
    this->Outgoing[ring.Target] = ring.Sectors.front().LeavingSpoke();
  }

  Afterwork work;
  work.DeadFaces = ring.NumberOfDead;
  if (ring.Kind == CollapseKind::OntoBoundary)
  {
    work.Replacement[0] = { ring.Loop.front(), ring.Sectors.front().OuterHalfedge() };
    work.Replacement[1] = { ring.Loop.back(), ring.Sectors.back().ReturningSpoke() };
  }
  else
  {
    for (int g = 0; g < ring.NumberOfGlued; ++g)
    {
      const int towardsHub = ring.Glued[g][1];
      work.Replacement[g] = { this->Corners[towardsHub], towardsHub };
    }
  }
  return work;
}

void CollapsibleMesh::FinishCollapse(const Afterwork& work)
{
  for (const auto& [vertex, halfedge] : work.Replacement)
  {
    if (vertex < 0)
    {
      continue;
    }
    // A boundary vertex keeps the halfedge without a twin; that one is never in a dead face, but
    // for collapses onto the boundary, where it lives on as the replacement.
    if (this->Corners[this->Outgoing[vertex]] < 0 || this->Twins[halfedge] < 0)
    {
      this->Outgoing[vertex] = halfedge;
    }
  }
  this->LiveFaces -= work.DeadFaces;
}

CollapsibleMesh::Compacted CollapsibleMesh::Compact() const
{
  std::vector<int> vertexNumber(this->Positions.size(), -1);
  std::vector<int> faceNumber(this->NumberOfFaceSlots(), -1);
  int faces = 0;
  for (int f = 0; f < this->NumberOfFaceSlots(); ++f)
  {
    if (this->IsLive(f))
    {
      faceNumber[f] = faces++;
      for (int k = 0; k < 3; ++k)
      {
        vertexNumber[this->Corners[3 * f + k]] = 0;
      }
    }
  }
  int vertices = 0;
  for (int& number : vertexNumber)
  {
    number = number == 0 ? vertices++ : -1;
  }
  Points points(vertices, 3);
  Triangles triangles(faces, 3);
  for (std::size_t v = 0; v < vertexNumber.size(); ++v)
  {
    if (vertexNumber[v] >= 0)
    {
      points.row(vertexNumber[v]) = this->Positions[v].transpose();
    }
  }
  for (int f = 0; f < this->NumberOfFaceSlots(); ++f)
  {
    for (int k = 0; k < 3 && faceNumber[f] >= 0; ++k)
    {
      triangles(faceNumber[f], k) = vertexNumber[this->Corners[3 * f + k]];
    }
  }
  return { TriangleMesh(std::move(points), std::move(triangles)), std::move(vertexNumber), std::move(faceNumber) };
}

}
