#ifndef dmgIsolineCells_h
#define dmgIsolineCells_h

#include "Mesh/TriangleMesh.h"
#include "Quads/Isolines/IsolineArrangement.h"
#include "Support/Types.h"

#include <array>
#include <vector>

namespace dmg
{

/// The cells that isolines cut the surface into. Each one becomes a vertex of the quad mesh, and each crossing a quad of the four cells
/// around it.
struct IsolineCells
{
  std::vector<std::array<int, 4>>
    OfDarts;                      ///< by node and slot: the cell to the left of the dart; -1 in slot 3 of an end
  std::vector<char> IsOutside;    ///< by cell: whether it is what lies beyond a boundary loop
  std::vector<char> IsOnBoundary; ///< by cell
  std::vector<int> OfVertices;    ///< by vertex of the surface: its cell, -1 if no arc is beside it

  int Size() const { return static_cast<int>(this->IsOutside.size()); }
  /// The cells before and after a point of an edge, along HalfedgeOf(edge); -1 where its isoline crosses no other one.
  std::array<int, 2> BesidePoint(const IsolineArrangement& isolines, int point) const;
  /// The cell of a place on an edge.
  /// \param t the part of the way along HalfedgeOf(edge).
  int OnEdge(const TriangleMesh& mesh, const IsolineArrangement& isolines, int edge, double t) const;
};

/// Cost: linear.
IsolineCells FindCells(const TriangleMesh& mesh, const IsolineArrangement& isolines);

/// The smallest vertex of those that one can go to from a vertex over edges that no isoline crosses.
std::vector<int> UncrossedSets(const TriangleMesh& mesh, const IsolineArrangement& isolines);

}

#endif
