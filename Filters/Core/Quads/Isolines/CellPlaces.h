#ifndef dmgCellPlaces_h
#define dmgCellPlaces_h

#include "Mesh/FramedMesh.h"
#include "Places/NearestPlaces.h"
#include "Places/SurfacePlace.h"
#include "Quads/Crosses/AlignedEdges.h"
#include "Quads/Crosses/CrossField.h"
#include "Quads/Crosses/LinesOfEdges.h"
#include "Quads/Isolines/IsolineArrangement.h"
#include "Quads/Isolines/IsolineCells.h"

#include <vector>

namespace dmg
{

/// The way in which a vertex of the quad mesh is held at its place.
enum class Hold
{
  Free,   ///< it may move over the surface
  OnLine, ///< on an aligned edge, along which it may move, or on the boundary
  AtPoint ///< at an end, a branch or a bend of aligned edges
};

/// The places on the surface of the vertices that stand for cells, by cell.
struct CellPlaces
{
  std::vector<SurfacePlace> Places; ///< no face for cells that no quad uses
  std::vector<Hold> Holds;
  std::vector<int> Singularities; ///< number of singular vertices in the cell
};

/// A cell lies at its singular vertex, or where both coordinates are integers in it, in a face that the map does not turn over;
/// along aligned edges where one is an integer. Else it lies at the mean of the crossings around it.
/// \param lines of aligned edges.
/// Cost: linear.
CellPlaces PlaceCells(const NearestPlaces& surface, const SurfaceAngles& angles, const CrossField& field,
  const LinesOfEdges& lines, const MapOfCorners& map, const IsolineArrangement& isolines, const IsolineCells& cells);

/// The positions of places; zero where there is none.
Points PositionsOf(const TriangleMesh& mesh, const CellPlaces& places);

/// The place of a face that a position on it has.
SurfacePlace PlaceInFace(const TriangleMesh& mesh, int face, const Vector3& position);

}

#endif
