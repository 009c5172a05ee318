#include "StructurePreserving/Decimation/OneRing.h"

#include "StructurePreserving/Decimation/CollapsibleMesh.h"

#include <algorithm>

namespace dmg
{
namespace
{

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

/// Gathers the ring of one edge; false where it must not be collapsed.
class Gatherer
{
public:
  Gatherer(const CollapsibleMesh& mesh, OneRing& ring)
    : Mesh(mesh)
    , Ring(ring)
  {
    ring.Loop.clear();
    ring.Sectors.clear();
    ring.NumberOfDead = 0;
    ring.NumberOfGlued = 0;
  }

  bool Interior(int halfedge);
  bool OntoBoundary(int halfedge);
  bool AlongBoundary(int halfedge);

private:
  /// The next halfedge around the vertex that one leaves, counter-clockwise.
  int Turn(int halfedge) const { return this->Mesh.Twin(TriangleMesh::Previous(halfedge)); }
  bool IsLinkedToInside(int vertex) const;
  void AppendSector(int halfedge)
  {
    this->Ring.Loop.push_back(this->Mesh.Head(halfedge));
    this->Ring.Sectors.push_back({ TriangleMesh::FaceOf(halfedge), halfedge % 3, -1 });
  }
  /// Sectors around the vertex that a halfedge leaves, up to a face.
  void AppendSectors(int halfedge, int stopFace)
  {
    for (; TriangleMesh::FaceOf(halfedge) != stopFace; halfedge = this->Turn(halfedge))
    {
      this->AppendSector(halfedge);
    }
  }
  /// The first sectors have one center before the collapse, the others another.
  void SetCenters(int numberOfFirst, int ofFirst, int ofOthers)
  {
    for (int k = 0; k < this->Ring.NumberOfSectors(); ++k)
    {
      this->Ring.Sectors[k].CenterBefore = k < numberOfFirst ? ofFirst : ofOthers;
    }
  }
  /// \param corners from the tail of the halfedge on.
  void AppendDead(int halfedge, const std::array<int, 3>& corners, int border = -1)
  {
    OneRing::DeadFace face{ TriangleMesh::FaceOf(halfedge), {}, border };
    for (int k = 0; k < 3; ++k)
    {
      face.Corners[(halfedge + k) % 3] = corners[k];
    }
    this->Ring.Dead[this->Ring.NumberOfDead++] = face;
  }
  void Glue(int ofSector, int other) { this->Ring.Glued[this->Ring.NumberOfGlued++] = { ofSector, other }; }
  void SetPositions(const Vector3& hub);
  void SetPositionsAboutMidpoint()
  {
    this->SetPositions(0.5 * (this->Mesh.Position(this->Ring.Target) + this->Mesh.Position(this->Ring.Removed)));
  }

  const CollapsibleMesh& Mesh;
  OneRing& Ring;
};

void Gatherer::SetPositions(const Vector3& hub)
{
  this->Ring.Positions.clear();
  for (const int vertex : this->Ring.Loop)
  {
    this->Ring.Positions.push_back(this->Mesh.Position(vertex));
  }
  this->Ring.Positions.push_back(this->Mesh.Position(this->Ring.Removed));
  this->Ring.Positions.push_back(this->Mesh.Position(this->Ring.Target));
  this->Ring.Positions.push_back(hub);
}

/// The loop starts at a, the corner left of the edge, goes around the kept vertex to b, the corner
/// right of the edge, and around the removed vertex back to a.
bool Gatherer::Interior(int left)
{
  const int right = this->Mesh.Twin(left);
  OneRing& ring = this->Ring;
  ring.Kind = CollapseKind::Interior;
  ring.Target = this->Mesh.Tail(left);
  ring.Removed = this->Mesh.Head(left);
  this->AppendSectors(this->Turn(left), TriangleMesh::FaceOf(right));
  const int b = ring.LoopSize();
  this->AppendSectors(this->Turn(right), TriangleMesh::FaceOf(left));
  const int size = ring.LoopSize();
  if (size < 3 || b == 0 || b == size || !AllDistinct(ring.Loop))
  {
    return false;
  }
  this->SetCenters(b, ring.TargetIndex(), ring.RemovedIndex());
  this->AppendDead(left, { ring.TargetIndex(), ring.RemovedIndex(), 0 });
  this->AppendDead(right, { ring.RemovedIndex(), ring.TargetIndex(), b });
  this->Glue(ring.Sectors[0].LeavingSpoke(), ring.Sectors[size - 1].ReturningSpoke());
  this->Glue(ring.Sectors[b].LeavingSpoke(), ring.Sectors[b - 1].ReturningSpoke());
  this->SetPositionsAboutMidpoint();
  return true;
}

/// Whether a vertex has an edge to a corner of the loop other than the first and the last.
bool Gatherer::IsLinkedToInside(int vertex) const
{
  bool isLinked = false;
  this->Mesh.VisitNeighbours(vertex,
    [&](int neighbour)
    {
      isLinked = isLinked ||
        std::find(this->Ring.Loop.begin() + 1, this->Ring.Loop.end() - 1, neighbour) != this->Ring.Loop.end() - 1;
    });
  return isLinked;
}

/// The ring of a collapse onto the boundary: the inner vertex moves along the halfedge to the boundary vertex at its head, and its
/// star becomes a fan around that.
bool Gatherer::OntoBoundary(int firstDead)
{
  OneRing& ring = this->Ring;
  ring.Kind = CollapseKind::OntoBoundary;
  ring.Removed = this->Mesh.Tail(firstDead);
  ring.Target = this->Mesh.Head(firstDead); // the first dead face is (removed, kept, x_0)
  int lastDead = this->Turn(firstDead);     // (removed, x_{m-1}, kept)
  for (; this->Mesh.Head(TriangleMesh::Next(lastDead)) != ring.Target; lastDead = this->Turn(lastDead))
  {
    this->AppendSector(lastDead);
  }
  ring.Loop.push_back(this->Mesh.Head(lastDead));
  const int size = ring.LoopSize();
  if (size < 2 || TriangleMesh::FaceOf(firstDead) == TriangleMesh::FaceOf(lastDead) || !AllDistinct(ring.Loop) ||
    this->IsLinkedToInside(ring.Target))
  {
    return false;
  }
  this->SetCenters(ring.NumberOfSectors(), ring.RemovedIndex(), -1);
  const int firstBorder = TriangleMesh::Next(firstDead); // kept -> x_0
  const int lastBorder = TriangleMesh::Next(lastDead);   // x_{m-1} -> kept
  this->AppendDead(firstDead, { ring.RemovedIndex(), ring.TargetIndex(), 0 }, firstBorder);
  this->AppendDead(lastDead, { ring.RemovedIndex(), size - 1, ring.TargetIndex() }, lastBorder);
  this->Glue(ring.Sectors.front().LeavingSpoke(), this->Mesh.Twin(firstBorder));
  this->Glue(ring.Sectors.back().ReturningSpoke(), this->Mesh.Twin(lastBorder));
  this->SetPositions(this->Mesh.Position(ring.Target));
  ring.Positions.pop_back(); // the kept vertex is the hub
  return true;
}

/// The boundary runs p -> kept -> removed -> q; the loop goes from q around the removed vertex to a,
/// the corner over the edge, and around the kept vertex to p.
bool Gatherer::AlongBoundary(int halfedge)
{
  OneRing& ring = this->Ring;
  ring.Kind = CollapseKind::AlongBoundary;
  ring.Target = this->Mesh.Tail(halfedge);
  ring.Removed = this->Mesh.Head(halfedge);
  this->AppendSectors(this->Mesh.OutgoingHalfedge(ring.Removed), TriangleMesh::FaceOf(halfedge));
  const int a = ring.LoopSize();
  for (int h = this->Turn(halfedge); h >= 0; h = this->Turn(h))
  {
    this->AppendSector(h);
    if (this->Turn(h) < 0)
    {
      ring.Loop.push_back(this->Mesh.Tail(TriangleMesh::Previous(h)));
    }
  }
  if (a == 0 || a == ring.NumberOfSectors() || !AllDistinct(ring.Loop))
  {
    return false;
  }
  this->SetCenters(a, ring.RemovedIndex(), ring.TargetIndex());
  this->AppendDead(halfedge, { ring.TargetIndex(), ring.RemovedIndex(), a });
  this->Glue(ring.Sectors[a].LeavingSpoke(), ring.Sectors[a - 1].ReturningSpoke());
  this->SetPositionsAboutMidpoint();
  return true;
}

}

bool GatherOneRing(const CollapsibleMesh& mesh, int halfedge, OneRing& ring)
{
  Gatherer gatherer(mesh, ring);
  const int twin = mesh.Twin(halfedge);
  if (twin < 0)
  {
    return gatherer.AlongBoundary(halfedge);
  }
  const bool isTailOnBoundary = mesh.IsBoundaryVertex(mesh.Tail(halfedge));
  const bool isHeadOnBoundary = mesh.IsBoundaryVertex(mesh.Head(halfedge));
  if (isTailOnBoundary && isHeadOnBoundary)
  {
    return false;
  }
  return isTailOnBoundary ? gatherer.OntoBoundary(twin)
    : isHeadOnBoundary    ? gatherer.OntoBoundary(halfedge)
                          : gatherer.Interior(halfedge);
}

}
