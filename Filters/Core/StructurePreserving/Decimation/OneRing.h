#ifndef dmgOneRing_h
#define dmgOneRing_h

#include "Support/Types.h"

#include <array>
#include <vector>

namespace dmg
{

class CollapsibleMesh;

/// The effect of an edge collapse on the boundary of the surface.
enum class CollapseKind
{
  /// Both ends inside the surface: they meet at the midpoint.
  Interior,
  /// One end on the boundary: the inner one moves onto it.
  OntoBoundary,
  /// A boundary edge: its ends meet at its midpoint.
  AlongBoundary,
};

/// The patch of faces that an edge collapse replaces, before and after it. Thesis, section 4.1.
///
/// Before, the faces fill a polygon around the vertices Kept and Removed. After, they are a fan of
/// sectors (hub, x_k, x_{k+1}) around the hub, the new vertex, which takes the index Kept. The rest
/// of the polygon's corners, x_0 ... x_{m-1}, counter-clockwise, do not change. The fan is closed
/// for interior collapses. Otherwise the hub lies on the polygon, and sectors run from x_0 to
/// x_{m-1}.
///
/// Local vertex numbers: k for x_k, then RemovedIndex(), TargetIndex(), HubIndex().
struct OneRing
{
  /// A face that survives: the sector's corners start, in the face, at HubCorner.
  struct Sector
  {
    int Face;
    int HubCorner;
    int CenterBefore; ///< local number of the corner that the hub replaces

    /// The halfedge from x_k to x_k+1.
    int OuterHalfedge() const { return 3 * this->Face + (this->HubCorner + 1) % 3; }
    /// The halfedge from the hub to x_k.
    int LeavingSpoke() const { return 3 * this->Face + this->HubCorner; }
    /// The halfedge from x_k+1 to the hub.
    int ReturningSpoke() const { return 3 * this->Face + (this->HubCorner + 2) % 3; }
  };

  /// A face that disappears, with local numbers for its corners.
  struct DeadFace
  {
    int Face;
    std::array<int, 3> Corners;
    /// OntoBoundary only: the side that lives on as the first or the last spoke; else -1.
    int BorderHalfedge;
  };

  CollapseKind Kind = CollapseKind::Interior;
  int Target = -1;
  int Removed = -1;
  std::vector<int> Loop;
  std::vector<Sector> Sectors;
  std::array<DeadFace, 2> Dead{};
  int NumberOfDead = 0;
  /// Pairs of halfedges that become twins; of a pair, the first belongs to a sector.
  std::array<std::array<int, 2>, 2> Glued{};
  int NumberOfGlued = 0;
  /// Positions in space by local number.
  std::vector<Vector3> Positions;

  bool IsClosed() const { return this->Kind == CollapseKind::Interior; }
  int LoopSize() const { return static_cast<int>(this->Loop.size()); }
  int NumberOfSectors() const { return static_cast<int>(this->Sectors.size()); }
  int NumberOfVertices() const { return static_cast<int>(this->Positions.size()); }
  int RemovedIndex() const { return this->LoopSize(); }
  int TargetIndex() const { return this->LoopSize() + 1; }
  /// A collapse onto the boundary leaves the kept vertex where it is: it is the hub.
  int HubIndex() const { return this->Kind == CollapseKind::OntoBoundary ? this->TargetIndex() : this->LoopSize() + 2; }
  int NextOnLoop(int k) const { return k + 1 == this->LoopSize() ? 0 : k + 1; }

  /// Corners of sector \p k before and after the collapse, hub first.
  std::array<int, 3> SectorBefore(int k) const { return { this->Sectors[k].CenterBefore, k, this->NextOnLoop(k) }; }
  std::array<int, 3> SectorAfter(int k) const { return { this->HubIndex(), k, this->NextOnLoop(k) }; }
};

/// The faces that the collapse of an edge would replace.
/// \return false where the surface would not stay manifold (the link condition) or an ear of the
/// boundary would be lost.
bool GatherOneRing(const CollapsibleMesh& mesh, int halfedge, OneRing& ring);

}

#endif
