#include "StructurePreserving/Decimation/SurfaceTracking.h"

#include "Support/Errors.h"

#include <algorithm>
#include <cmath>

namespace dmg
{

namespace
{

// Barycentric coordinates below this are rounding of zero.
constexpr double RoundingOfZero = 1e-13;

double Cross(Complex a, Complex b)
{
  return a.real() * b.imag() - a.imag() * b.real();
}

std::array<double, 3> Clamped(std::array<double, 3> weights)
{
  double sum = 0.0;
  for (double& w : weights)
  {
    w = w > RoundingOfZero ? std::min(w, 1.0) : 0.0;
    sum += w;
  }
  for (double& w : weights)
  {
    w = sum > 0.0 ? w / sum : 1.0 / 3.0;
  }
  return weights;
}

}

SurfaceTracking::SurfaceTracking(const TriangleMesh& fine)
  : Fine(fine)
  , PointFaces(fine.NumberOfVertices(), -1)
  , PointWeights(fine.NumberOfVertices())
  , NextPointInFace(fine.NumberOfVertices(), -1)
  , FirstPointInFace(fine.NumberOfFaces(), -1)
  , FineEdges(3 * fine.NumberOfFaces())
  , FirstPieceInFace(fine.NumberOfFaces(), -1)
  , SectorOfFace(fine.NumberOfFaces(), 0)
  , Pages(static_cast<std::size_t>(fine.NumberOfEdges()) + 1024)
{
  for (int h = 0; h < 3 * fine.NumberOfFaces(); ++h)
  {
    this->FineEdges[h] = fine.EdgeOf(h);
  }
  while (this->NumberOfPages * NodesPerPage < 2 * fine.NumberOfEdges())
  {
    this->AllocatePage();
  }
  for (int node = 0; node < 2 * fine.NumberOfEdges(); ++node)
  {
    this->Node(node) = { -1, -1, -1, -1, 0.0 };
  }
}

std::unique_ptr<SurfaceTracking::Worker> SurfaceTracking::TakeWorker()
{
  const std::lock_guard<std::mutex> lock(this->Mutex);
  if (this->IdleWorkers.empty())
  {
    // Room for all workers that there are: destructors give them back, and must not fail.
    this->IdleWorkers.reserve(this->IdleWorkers.capacity() + 1);
    return std::make_unique<Worker>();
  }
  std::unique_ptr<Worker> worker = std::move(this->IdleWorkers.back());
  this->IdleWorkers.pop_back();
  return worker;
}

void SurfaceTracking::GiveBack(std::unique_ptr<Worker> worker)
{
  const std::lock_guard<std::mutex> lock(this->Mutex);
  this->IdleWorkers.push_back(std::move(worker));
}

int SurfaceTracking::AllocatePage()
{
  const std::lock_guard<std::mutex> lock(this->Mutex);
  if (this->NumberOfPages == static_cast<int>(this->Pages.size()))
  {
    throw SolverFailure("the paths of the fine edges cross too many coarse edges; "
                        "the surface has too many thin triangles to be decimated this far");
  }
  this->Pages[this->NumberOfPages].reset(new PathNode[NodesPerPage]);
  return NodesPerPage * this->NumberOfPages++;
}

int SurfaceTracking::AllocateNode(Worker& worker)
{
  if (!worker.FreeNodes.empty())
  {
    const int node = worker.FreeNodes.back();
    worker.FreeNodes.pop_back();
    return node;
  }
  if (worker.NextFreshNode == worker.EndOfFreshNodes)
  {
    worker.NextFreshNode = this->AllocatePage();
    worker.EndOfFreshNodes = worker.NextFreshNode + NodesPerPage;
  }
  return worker.NextFreshNode++;
}

void SurfaceTracking::Move(const OneRing& ring, const std::vector<Complex>& plane, Worker& worker)
{
  this->NumberSectors(ring);
  worker.Chains.clear();
  this->CollectPieces(ring, worker);
  this->CollectEdgesThatLeaveTheMesh(ring, worker);
  this->MovePoints(ring, plane, worker);
  this->KeepBorder(ring, worker);
  for (const Chain& chain : worker.Chains)
  {
    this->DrawChain(chain, ring, plane, worker);
  }
}

void SurfaceTracking::NumberSectors(const OneRing& ring)
{
  for (int k = 0; k < ring.NumberOfSectors(); ++k)
  {
    this->SectorOfFace[ring.Sectors[k].Face] = k;
  }
  for (int d = 0; d < ring.NumberOfDead; ++d)
  {
    this->SectorOfFace[ring.Dead[d].Face] = -1 - d;
  }
}

// Pieces in the faces of the ring join to chains from where a path enters the ring, or begins, to
// where it leaves or ends. The crossings in between are given up.
void SurfaceTracking::CollectPieces(const OneRing& ring, Worker& worker)
{
  // On the polygon: what enters or leaves here stays a crossing.
  const auto isSide = [&](int halfedge)
  {
    const int k = this->SectorOfFace[halfedge / 3];
    return halfedge == (k >= 0 ? ring.Sectors[k].OuterHalfedge() : ring.Dead[-1 - k].BorderHalfedge);
  };
  // The lists of all faces are followed at the same time: each step waits for memory, and the
  // processor waits for many at once.
  std::vector<int>& nodes = worker.Nodes;
  nodes.clear();
  const auto take = [&](int face)
  {
    if (this->FirstPieceInFace[face] >= 0)
    {
      nodes.push_back(this->FirstPieceInFace[face]);
    }
    this->FirstPieceInFace[face] = -1;
  };
  for (const OneRing::Sector& sector : ring.Sectors)
  {
    take(sector.Face);
  }
  for (int d = 0; d < ring.NumberOfDead; ++d)
  {
    take(ring.Dead[d].Face);
  }
  while (!nodes.empty())
  {
    std::size_t left = 0;
    for (const int node : nodes)
    {
      const PathNode& piece = this->Node(node);
      if (this->IsPathEnd(node) || isSide(piece.LeavingHalfedge))
      {
        worker.Chains.push_back({ node, -1 });
      }
      if (piece.NextInFace >= 0)
      {
        nodes[left++] = piece.NextInFace;
      }
    }
    nodes.resize(left);
  }
  for (Chain& chain : worker.Chains)
  {
    int node = this->Node(chain.First).Next;
    while (!this->IsPathEnd(node) && !isSide(this->Node(node).ArrivingHalfedge))
    {
      worker.FreeNodes.push_back(node);
      node = this->Node(node).Next;
    }
    chain.Last = node;
  }
}

// Fine edges that ran along an edge inside the patch become chains.
void SurfaceTracking::CollectEdgesThatLeaveTheMesh(const OneRing& ring, Worker& worker)
{
  const auto leave = [&](int halfedge)
  {
    const int edge = this->FineEdges[halfedge];
    // Both halfedges of an edge inside the patch are met; the path is made once.
    if (edge >= 0 && this->Node(StartNode(edge)).Next < 0)
    {
      this->Node(StartNode(edge)).Next = EndNode(edge);
      worker.Chains.push_back({ StartNode(edge), EndNode(edge) });
    }
    this->FineEdges[halfedge] = -1;
  };
  for (const OneRing::Sector& sector : ring.Sectors)
  {
    leave(sector.LeavingSpoke());
    leave(sector.ReturningSpoke());
  }
  for (int d = 0; d < ring.NumberOfDead; ++d)
  {
    for (int k = 0; k < 3; ++k)
    {
      const int halfedge = 3 * ring.Dead[d].Face + k;
      if (halfedge != ring.Dead[d].BorderHalfedge)
      {
        leave(halfedge);
      }
    }
  }
}

// Places a point of the polygon in the sector that holds it.
void SurfaceTracking::MovePoint(int fineVertex, Complex place, const OneRing& ring, const std::vector<Complex>& plane)
{
  const Complex hub = plane[ring.HubIndex()];
  const Complex p = place - hub;
  // The sector in which the smallest barycentric coordinate is largest: rounding may leave a point
  // on a spoke outside of both of its sectors.
  int best = 0;
  std::array<double, 3> bestWeights{ 1.0, 0.0, 0.0 };
  double bestMargin = -1e300;
  for (int k = 0; k < ring.NumberOfSectors(); ++k)
  {
    const Complex a = plane[k] - hub;
    const Complex b = plane[ring.NextOnLoop(k)] - hub;
    const double area = Cross(a, b);
    const double wa = Cross(p, b) / area;
    const double wb = Cross(a, p) / area;
    const double margin = std::min(std::min(wa, wb), 1.0 - wa - wb);
    if (margin > bestMargin)
    {
      best = k;
      bestMargin = margin;
      bestWeights = { 1.0 - wa - wb, wa, wb };
      if (margin >= 0.0)
      {
        break;
      }
    }
  }
  bestWeights = Clamped(bestWeights);
  const OneRing::Sector& sector = ring.Sectors[best];
  this->PointFaces[fineVertex] = sector.Face;
  for (int k = 0; k < 3; ++k)
  {
    this->PointWeights[fineVertex][(sector.HubCorner + k) % 3] = bestWeights[k];
  }
  this->NextPointInFace[fineVertex] = this->FirstPointInFace[sector.Face];
  this->FirstPointInFace[sector.Face] = fineVertex;
}

void SurfaceTracking::MovePoints(const OneRing& ring, const std::vector<Complex>& plane, Worker& worker)
{
  // Places are read before any point moves, since moving rewrites the lists of the faces.
  std::vector<int>& points = worker.Points;
  points.clear();
  const auto take = [&](int face)
  {
    for (int v = this->FirstPointInFace[face]; v >= 0; v = this->NextPointInFace[v])
    {
      points.push_back(v);
    }
    this->FirstPointInFace[face] = -1;
  };
  for (const OneRing::Sector& sector : ring.Sectors)
  {
    take(sector.Face);
  }
  for (int d = 0; d < ring.NumberOfDead; ++d)
  {
    take(ring.Dead[d].Face);
  }
  for (int v : points)
  {
    const int face = this->PointFaces[v];
    const std::array<double, 3>& w = this->PointWeights[v];
    Complex place = 0.0;
    const auto corner = [&](int k, int local) { place += w[k] * plane[local]; };
    const int s = this->SectorOfFace[face];
    for (int k = 0; k < 3; ++k)
    {
      if (s >= 0)
      {
        corner((ring.Sectors[s].HubCorner + k) % 3, ring.SectorBefore(s)[k]);
      }
      else
      {
        corner(k, ring.Dead[-1 - s].Corners[k]);
      }
    }
    this->MovePoint(v, place, ring, plane);
  }
  if (this->PointFaces[ring.Removed] < 0)
  {
    this->MovePoint(ring.Removed, plane[ring.RemovedIndex()], ring, plane);
  }
  if (ring.HubIndex() != ring.TargetIndex() && this->PointFaces[ring.Target] < 0)
  {
    this->MovePoint(ring.Target, plane[ring.TargetIndex()], ring, plane);
  }
}

// The border sides of dead faces live on as the first and the last spoke.
void SurfaceTracking::KeepBorder(const OneRing& ring, Worker& worker)
{
  if (ring.Kind != CollapseKind::OntoBoundary)
  {
    return;
  }
  const std::array<int, 2> before = { ring.Dead[0].BorderHalfedge, ring.Dead[1].BorderHalfedge };
  const std::array<int, 2> after = { ring.Sectors.front().LeavingSpoke(), ring.Sectors.back().ReturningSpoke() };
  for (int i : { 0, 1 })
  {
    this->FineEdges[after[i]] = this->FineEdges[before[i]];
    this->FineEdges[before[i]] = -1;
  }
  for (const Chain& chain : worker.Chains)
  {
    for (int i : { 0, 1 })
    {
      if (!this->IsPathEnd(chain.First) && this->Node(chain.First).LeavingHalfedge == before[i])
      {
        this->Node(chain.First).LeavingHalfedge = after[i];
      }
      if (!this->IsPathEnd(chain.Last) && this->Node(chain.Last).ArrivingHalfedge == before[i])
      {
        this->Node(chain.Last).ArrivingHalfedge = after[i];
      }
    }
  }
}

PlaceInRing SurfaceTracking::LocateFineVertex(
  int fineVertex, const OneRing& ring, const std::vector<Complex>& plane) const
{
  const int face = this->PointFaces[fineVertex];
  if (face >= 0)
  {
    const int k = this->SectorOfFace[face];
    const int corner = ring.Sectors[k].HubCorner;
    const std::array<double, 3>& w = this->PointWeights[fineVertex];
    return { w[corner] * plane[ring.HubIndex()] + w[(corner + 1) % 3] * plane[k] +
        w[(corner + 2) % 3] * plane[ring.NextOnLoop(k)],
      k, k, false };
  }
  if (fineVertex == ring.Target)
  {
    return { plane[ring.HubIndex()], 0, ring.NumberOfSectors() - 1, true };
  }
  int k = 0;
  while (ring.Loop[k] != fineVertex)
  {
    ++k;
  }
  const int last = ring.NumberOfSectors() - 1;
  if (ring.IsClosed())
  {
    return { plane[k], k == 0 ? last : k - 1, k, false };
  }
  return { plane[k], std::max(k - 1, 0), std::min(k, last), false };
}

PlaceInRing SurfaceTracking::LocateCrossing(
  int halfedge, double fraction, const OneRing& ring, const std::vector<Complex>& plane) const
{
  const int k = this->SectorOfFace[halfedge / 3];
  const std::array<int, 3> corners = ring.SectorAfter(k);
  const int first = (halfedge % 3 - ring.Sectors[k].HubCorner + 3) % 3;
  const Complex tail = plane[corners[first]];
  const Complex head = plane[corners[(first + 1) % 3]];
  return { (1.0 - fraction) * tail + fraction * head, k, k, false };
}

// The place at which a chain begins or ends after the collapse.
PlaceInRing SurfaceTracking::Locate(
  int node, int halfedge, double fraction, const OneRing& ring, const std::vector<Complex>& plane) const
{
  return this->IsPathEnd(node) ? this->LocateFineVertex(this->FineVertexAt(node), ring, plane)
                               : this->LocateCrossing(halfedge, fraction, ring, plane);
}

// The piece from a node to the next lies in the face of a halfedge.
void SurfaceTracking::BeginPiece(int node, int leavingHalfedge)
{
  PathNode& from = this->Node(node);
  from.LeavingHalfedge = leavingHalfedge;
  from.NextInFace = this->FirstPieceInFace[leavingHalfedge / 3];
  this->FirstPieceInFace[leavingHalfedge / 3] = node;
}

// A chain becomes the straight line between its ends, cut where it crosses spokes.
void SurfaceTracking::DrawChain(
  const Chain& chain, const OneRing& ring, const std::vector<Complex>& plane, Worker& worker)
{
  const PathNode& first = this->Node(chain.First);
  const PathNode& last = this->Node(chain.Last);
  const LineThroughRing line(ring, plane,
    this->Locate(chain.First, first.LeavingHalfedge, 1.0 - first.Fraction, ring, plane),
    this->Locate(chain.Last, last.ArrivingHalfedge, last.Fraction, ring, plane));
  int node = chain.First;
  int sector = line.FirstSector();
  this->BeginPiece(node, this->IsPathEnd(node) ? 3 * ring.Sectors[sector].Face : first.LeavingHalfedge);
  for (int k = 0; k < line.NumberOfCrossings(); ++k)
  {
    const LineThroughRing::Crossing crossing = line.LeaveSector(sector);
    const int next = this->AllocateNode(worker);
    this->Node(next).ArrivingHalfedge = crossing.Leaving;
    this->Node(next).Fraction = crossing.Fraction;
    this->Node(node).Next = next;
    this->BeginPiece(next, crossing.Entering);
    node = next;
    sector = crossing.Sector;
  }
  this->Node(node).Next = chain.Last;
}

}
