#ifndef dmgRingOverlay_h
#define dmgRingOverlay_h

#include "StructurePreserving/Decimation/CollapseRecord.h"

#include <CGAL/Gmpq.h>
#include <CGAL/Simple_cartesian.h>

#include <array>
#include <vector>

namespace dmg
{

using Rational = CGAL::Gmpq;

/// The overlay of a one-ring before and after its collapse, in the plane of their joint flattening: the places of the vertices and
/// the edges before on the sectors after. Arithmetic is rational, and doubles are rational numbers. So the sector of a point, and
/// whether a point lies on an edge or an edge along another, are decided without tolerances. Thesis, sections 4.1 and 5.2.
///
/// Vertices are named by the local numbers of the ring. A place is a sector and barycentric
/// coordinates there, hub first; they are never negative and sum to 1.
///
/// Both sides fill the same polygon, so all edges before lie on the sectors after. Only a face without area in space may be folded
/// in the plane. Then a vertex outside of the polygon is put on the hub, and an edge that leaves the polygon goes by way of the hub,
/// from which all of the polygon is visible.
///
/// Includes CGAL: for source files of this folder only.
class RingOverlay
{
public:
  explicit RingOverlay(const CollapseRecord& collapse);

  struct Place
  {
    int Sector;
    std::array<Rational, 3> Weights;
  };
  Place PlaceOf(int vertex) const;

  /// A part of an edge on one sector.
  struct Piece
  {
    int Sector;
    std::array<Rational, 3> From;
    std::array<Rational, 3> To;
  };
  /// The parts of the edge from one vertex to another, in this order. Where it runs along a spoke,
  /// in the sector on its left; on the boundary, in the only one.
  std::vector<Piece> PiecesOf(int from, int to) const;

private:
  /// The intersection of an edge's line with a spoke, strictly between the ends of the edge.
  struct Crossing
  {
    int Spoke;
    bool CounterClockwise; ///< the direction of the edge there, seen from the hub
    Rational AlongEdge;    ///< 0 at its start, 1 at its end
    Rational AlongSpoke;   ///< 0 at the hub, 1 at the polygon
  };

  int SectorBeside(int spoke, bool following) const;
  int SectorWith(int from, int to) const;
  std::array<Rational, 3> WeightsIn(int sector, int vertex) const;
  std::array<Rational, 3> WeightsIn(int sector, const Crossing& crossing) const;
  std::vector<Crossing> CrossingsOf(int from, int to) const;
  bool PassesHub(int from, int to) const;
  bool Cut(int from, int to, std::vector<Piece>& pieces) const;

  using PlaneVector = CGAL::Simple_cartesian<Rational>::Vector_2;

  /// Twice the area of hub, x_k, vertex: positive where the vertex is on the left of the spoke.
  const Rational& Area(int k, int vertex) const { return this->Areas[k * this->Ring.NumberOfVertices() + vertex]; }

  const OneRing& Ring;
  std::vector<PlaneVector> FromHub; // positions in the plane, by local number
  std::vector<Rational> Areas;
};

}

#endif
