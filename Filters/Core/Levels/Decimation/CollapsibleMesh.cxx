#include "Levels/Decimation/CollapsibleMesh.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dmg
{

namespace
{

// Share of length^4 in the cost. Larger values give rounder coarse triangles and a worse
// approximation; 0.01 to 0.1 do equally well in scalar multigrid.
constexpr double LengthShare = 0.03;

constexpr int Grain = 4096;

bool AllDistinct(const std::vector<int>& vertices)
{
  for (std::size_t i = 1; i < vertices.size(); ++i)
  {
    for (std::size_t j = 0; j < i; ++j)
    {
      if (vertices[i] == vertices[j])
      {
        return false;
      }
    }
  }
  return true;
}

}

CollapsibleMesh::CollapsibleMesh(const TriangleMesh& mesh, const ExecutionContext& context)
  : Positions(mesh.NumberOfVertices())
  , Quadrics(mesh.NumberOfVertices())
  , Corners(mesh.FaceCorners().data(), mesh.FaceCorners().data() + mesh.FaceCorners().size())
  , Twins(mesh.HalfedgeTwins())
  , Outgoing(mesh.NumberOfVertices())
  , LiveFaces(mesh.NumberOfFaces())
{
  this->Origin = 0.5 *
    (mesh.VertexPositions().colwise().minCoeff() + mesh.VertexPositions().colwise().maxCoeff())
      .transpose();
  context.ParallelFor(0, mesh.NumberOfVertices(), Grain, [&](int first, int last) {
    for (int v = first; v < last; ++v)
    {
      this->Positions[v] = mesh.Position(v);
      this->Outgoing[v] = mesh.OutgoingHalfedge(v);
    }
  });
  context.ParallelFor(0, mesh.NumberOfVertices(), Grain, [&](int first, int last) {
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

void CollapsibleMesh::InheritQuadrics(
  const CollapsibleMesh& finer, const std::vector<int>& vertexNumber)
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

Vector3 CollapsibleMesh::CollapsePosition(int halfedge) const
{
  const int i = this->Tail(halfedge);
  const int j = this->Head(halfedge);
  if (this->Twins[halfedge] >= 0)
  {
    if (this->IsBoundaryVertex(i))
    {
      return this->Positions[i];
    }
    if (this->IsBoundaryVertex(j))
    {
      return this->Positions[j];
    }
  }
  return 0.5 * (this->Positions[i] + this->Positions[j]);
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

bool CollapsibleMesh::GatherOneRing(int halfedge, OneRing& ring) const
{
  ring.Loop.clear();
  ring.Sectors.clear();
  ring.NumberOfDead = 0;
  ring.NumberOfGlued = 0;
  if (this->Twins[halfedge] < 0)
  {
    return this->GatherAlongBoundary(halfedge, ring);
  }
  const bool tailOnBoundary = this->IsBoundaryVertex(this->Tail(halfedge));
  const bool headOnBoundary = this->IsBoundaryVertex(this->Head(halfedge));
  if (tailOnBoundary && headOnBoundary)
  {
    return false;
  }
  if (tailOnBoundary)
  {
    return this->GatherOntoBoundary(this->Twins[halfedge], ring);
  }
  if (headOnBoundary)
  {
    return this->GatherOntoBoundary(halfedge, ring);
  }
  return this->GatherInterior(halfedge, ring);
}

void CollapsibleMesh::SetPositions(OneRing& ring, const Vector3& hub) const
{
  ring.Positions.clear();
  for (int vertex : ring.Loop)
  {
    ring.Positions.push_back(this->Positions[vertex]);
  }
  ring.Positions.push_back(this->Positions[ring.Removed]);
  ring.Positions.push_back(this->Positions[ring.Kept]);
  ring.Positions.push_back(hub);
}

// The loop starts at a, the corner left of the edge, goes around the kept vertex to b, the corner
// right of the edge, and around the removed vertex back to a.
bool CollapsibleMesh::GatherInterior(int halfedge, OneRing& ring) const
{
  const int left = halfedge;
  const int right = this->Twins[halfedge];
  ring.Kind = CollapseKind::Interior;
  ring.Kept = this->Tail(left);
  ring.Removed = this->Head(left);

  const auto walk = [&](int first, int stopFace) {
    int h = first;
    while (TriangleMesh::FaceOf(h) != stopFace)
    {
      ring.Loop.push_back(this->Head(h));
      ring.Sectors.push_back({ TriangleMesh::FaceOf(h), h % 3, -1 });
      h = this->Twins[TriangleMesh::Previous(h)];
    }
  };
  walk(this->Twins[TriangleMesh::Previous(left)], TriangleMesh::FaceOf(right));
  const int b = ring.LoopSize();
  walk(this->Twins[TriangleMesh::Previous(right)], TriangleMesh::FaceOf(left));
  const int size = ring.LoopSize();
  if (size < 3 || b == 0 || b == size || !AllDistinct(ring.Loop))
  {
    return false;
  }
  for (int k = 0; k < size; ++k)
  {
    ring.Sectors[k].CenterBefore = k < b ? ring.KeptIndex() : ring.RemovedIndex();
  }

  const auto dead = [&](int h, std::array<int, 3> corners) {
    OneRing::DeadFace face{ TriangleMesh::FaceOf(h), {}, -1 };
    for (int k = 0; k < 3; ++k)
    {
      face.Corners[(h + k) % 3] = corners[k];
    }
    return face;
  };
  ring.Dead[0] = dead(left, { ring.KeptIndex(), ring.RemovedIndex(), 0 });
  ring.Dead[1] = dead(right, { ring.RemovedIndex(), ring.KeptIndex(), b });
  ring.NumberOfDead = 2;
  ring.Glued[0] = { ring.Sectors[0].LeavingSpoke(), ring.Sectors[size - 1].ReturningSpoke() };
  ring.Glued[1] = { ring.Sectors[b].LeavingSpoke(), ring.Sectors[b - 1].ReturningSpoke() };
  ring.NumberOfGlued = 2;
  this->SetPositions(ring, 0.5 * (this->Positions[ring.Kept] + this->Positions[ring.Removed]));
  return true;
}

// From the inner vertex, along the halfedge, onto the boundary vertex at its head: the star of the
// inner vertex becomes a fan around the other.
bool CollapsibleMesh::GatherOntoBoundary(int halfedge, OneRing& ring) const
{
  ring.Kind = CollapseKind::OntoBoundary;
  ring.Removed = this->Tail(halfedge);
  ring.Kept = this->Head(halfedge);

  const int firstDead = halfedge; // (removed, kept, x_0)
  int h = this->Twins[TriangleMesh::Previous(halfedge)];
  while (this->Head(TriangleMesh::Next(h)) != ring.Kept)
  {
    ring.Loop.push_back(this->Head(h));
    ring.Sectors.push_back({ TriangleMesh::FaceOf(h), h % 3, -1 });
    h = this->Twins[TriangleMesh::Previous(h)];
  }
  const int lastDead = h; // (removed, x_{m-1}, kept)
  ring.Loop.push_back(this->Head(h));
  const int size = ring.LoopSize();
  if (size < 2 || TriangleMesh::FaceOf(firstDead) == TriangleMesh::FaceOf(lastDead) ||
    !AllDistinct(ring.Loop))
  {
    return false;
  }
  // The new spokes must not exist already.
  bool linked = false;
  const auto check = [&](int vertex) {
    for (int k = 1; k + 1 < size; ++k)
    {
      linked = linked || ring.Loop[k] == vertex;
    }
  };
  this->VisitOutgoing(ring.Kept, [&](int g) {
    check(this->Head(g));
    check(this->Tail(TriangleMesh::Previous(g)));
  });
  if (linked)
  {
    return false;
  }
  for (OneRing::Sector& sector : ring.Sectors)
  {
    sector.CenterBefore = ring.RemovedIndex();
  }

  const int firstBorder = TriangleMesh::Next(firstDead); // kept -> x_0
  const int lastBorder = TriangleMesh::Next(lastDead);   // x_{m-1} -> kept
  ring.Dead[0] = { TriangleMesh::FaceOf(firstDead), {}, firstBorder };
  ring.Dead[0].Corners[firstDead % 3] = ring.RemovedIndex();
  ring.Dead[0].Corners[(firstDead + 1) % 3] = ring.KeptIndex();
  ring.Dead[0].Corners[(firstDead + 2) % 3] = 0;
  ring.Dead[1] = { TriangleMesh::FaceOf(lastDead), {}, lastBorder };
  ring.Dead[1].Corners[lastDead % 3] = ring.RemovedIndex();
  ring.Dead[1].Corners[(lastDead + 1) % 3] = size - 1;
  ring.Dead[1].Corners[(lastDead + 2) % 3] = ring.KeptIndex();
  ring.NumberOfDead = 2;
  ring.Glued[0] = { ring.Sectors.front().LeavingSpoke(), this->Twins[firstBorder] };
  ring.Glued[1] = { ring.Sectors.back().ReturningSpoke(), this->Twins[lastBorder] };
  ring.NumberOfGlued = 2;
  this->SetPositions(ring, this->Positions[ring.Kept]);
  ring.Positions.pop_back(); // the kept vertex is the hub
  return true;
}

// The boundary runs p -> kept -> removed -> q; the loop goes from q around the removed vertex to a,
// the corner over the edge, and around the kept vertex to p.
bool CollapsibleMesh::GatherAlongBoundary(int halfedge, OneRing& ring) const
{
  ring.Kind = CollapseKind::AlongBoundary;
  ring.Kept = this->Tail(halfedge);
  ring.Removed = this->Head(halfedge);
  const int deadFace = TriangleMesh::FaceOf(halfedge);

  int h = this->Outgoing[ring.Removed];
  while (TriangleMesh::FaceOf(h) != deadFace)
  {
    ring.Loop.push_back(this->Head(h));
    ring.Sectors.push_back({ TriangleMesh::FaceOf(h), h % 3, -1 });
    h = this->Twins[TriangleMesh::Previous(h)];
  }
  const int a = ring.LoopSize();
  h = this->Twins[TriangleMesh::Previous(halfedge)];
  while (h >= 0)
  {
    ring.Loop.push_back(this->Head(h));
    ring.Sectors.push_back({ TriangleMesh::FaceOf(h), h % 3, -1 });
    const int returning = TriangleMesh::Previous(h);
    h = this->Twins[returning];
    if (h < 0)
    {
      ring.Loop.push_back(this->Tail(returning));
    }
  }
  const int sectors = ring.NumberOfSectors();
  if (a == 0 || a == sectors || !AllDistinct(ring.Loop))
  {
    return false;
  }
  for (int k = 0; k < sectors; ++k)
  {
    ring.Sectors[k].CenterBefore = k < a ? ring.RemovedIndex() : ring.KeptIndex();
  }
  ring.Dead[0] = { deadFace, {}, -1 };
  ring.Dead[0].Corners[halfedge % 3] = ring.KeptIndex();
  ring.Dead[0].Corners[(halfedge + 1) % 3] = ring.RemovedIndex();
  ring.Dead[0].Corners[(halfedge + 2) % 3] = a;
  ring.NumberOfDead = 1;
  ring.Glued[0] = { ring.Sectors[a].LeavingSpoke(), ring.Sectors[a - 1].ReturningSpoke() };
  ring.NumberOfGlued = 1;
  this->SetPositions(ring, 0.5 * (this->Positions[ring.Kept] + this->Positions[ring.Removed]));
  return true;
}

CollapsibleMesh::Afterwork CollapsibleMesh::Collapse(const OneRing& ring)
{
  for (const OneRing::Sector& sector : ring.Sectors)
  {
    this->Corners[3 * sector.Face + sector.HubCorner] = ring.Kept;
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
  this->Positions[ring.Kept] = ring.Positions[ring.HubIndex()];
  this->Quadrics[ring.Kept].Add(this->Quadrics[ring.Removed]);
  this->Outgoing[ring.Removed] = -1;
  if (ring.Kind == CollapseKind::OntoBoundary)
  {
    // The boundary may leave the kept vertex by its first spoke, which lay in a dead face.
    const int leaving = ring.Sectors.front().LeavingSpoke();
    if (this->Twins[leaving] < 0 || this->Corners[this->Outgoing[ring.Kept]] < 0)
    {
      this->Outgoing[ring.Kept] = leaving;
    }
  }
  else
  {
    this->Outgoing[ring.Kept] = ring.Sectors.front().LeavingSpoke();
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
  return { TriangleMesh(std::move(points), std::move(triangles)), std::move(vertexNumber),
    std::move(faceNumber) };
}

}
