#ifndef dmgPreparedSurface_h
#define dmgPreparedSurface_h

#include "Mesh/SurfaceRelation.h"
#include "Mesh/TriangleMesh.h"
#include "Preparation/PolygonSurface.h"
#include "Preparation/PreparationReport.h"
#include "Support/ExecutionContext.h"

namespace dmg
{

/// The order of faces and vertices of a mesh.
enum class Numbering
{
  AsGiven, ///< in the order of cells and points
  Spatial, ///< as SpatialOrder does: files have any order, and loops over the surface like this one
};

struct PreparationOptions
{
  dmg::Numbering Order = Numbering::Spatial;
  bool JoinPoints = true; ///< points that coincide are one
  bool Strict = false;    ///< what is not an oriented manifold surface is refused; no points are joined
  bool KeepsSides =
    false; ///< faces stay as the cells are, as of a piece of a surface, whose positive side only the whole has

  bool operator==(const PreparationOptions& other) const
  {
    return this->Order == other.Order && this->JoinPoints == other.JoinPoints && this->Strict == other.Strict &&
      this->KeepsSides == other.KeepsSides;
  }
};

/// An oriented manifold surface, and how it stands to the cells and points that it was made from.
struct PreparedSurface
{
  TriangleMesh Mesh;
  SurfaceRelation Relation;
  PreparationReport Report;
};

/// Makes an oriented manifold mesh of whatever triangles there are, without new points.
///
/// A surface that is one already stays as it is, and costs one pass over its boundary more than the mesh. Else:
/// - Points of the boundary that coincide are joined: equal ones, and those that the rounding of the coordinates does not tell
///   apart (RoundingOf), nearer than a hundredth of the edges there. Wider walls and gaps stay, and so do thin layers of
///   cells (UniteNear).
/// - Doubled triangles, whose corners coincide in the same way, as those of a cyclic column, and triangles with a corner twice are left out; see SurfaceRelation for what stands in for them. Both
///   sides of a face that two solids share stay (KeepTwinsOfSolids).
/// - At an edge of more than two triangles, those stay joined that continue each other (SheetsAtEdge): the boundaries of
///   solids that touch stay closed, and a plate goes on under its stiffener.
/// - Triangles are turned until neighbours agree, in each component as most of them are. A surface with one side only is
///   cut along a short seam.
/// - A point whose triangles form several fans becomes a vertex for each of them.
///
/// The corners of all faces are counter-clockwise, seen from the positive side (PositiveSide.h): components that are given the other way round
/// are turned (SurfaceRelation::IsTurned), which is no repair. So rotations, the order of directions, normal parts and curvatures have signs
/// that do not depend on the order of a file's rows or cells.
///
/// \throw InvalidInput a coordinate that is not finite, corners out of range, no triangle with an area, too many
/// triangles; with Strict, as the constructor of TriangleMesh. Messages have the numbers of cells and points.
/// Cost: O(n log n) in the number of boundary sides, else linear.
PreparedSurface PrepareSurface(
  CellTriangles&& triangles, const PreparationOptions& options, const ExecutionContext& context = SerialContext());

/// The same for polygons; see Triangulate. The relation has the centres of polygons with neighbouring corners that coincide.
PreparedSurface PrepareSurface(
  PolygonSurface&& polygons, const PreparationOptions& options, const ExecutionContext& context = SerialContext());

}

#endif
