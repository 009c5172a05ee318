#ifndef dmgVectorsOnSurface_h
#define dmgVectorsOnSurface_h

#include "Mesh/SurfaceRelation.h"
#include "Mesh/TriangleMesh.h"

#include "vtkType.h"

#include <vector>

class vtkDataSet;

namespace dmg
{

/// Vectors at the vertices of a surface, or on its faces at the CellCentres.
struct VectorsOnSurface
{
  bool AreAtVertices;
  Points Values; ///< in the coordinates of the surface
  Points
    AtCorners{}; ///< 3 #F x 3, row h is that of the tail of halfedge h; empty where all faces of a vertex have the same

  /// The places of vectors of cells, #F x 3: the CellCentres, but where a step has moved corners (SurfaceStep::PlaceOfCell).
  Points Places{};

  /// Takes out their parts along the normals of the surface (WithoutNormalParts). \return SplitVectors::RatioAtRim. Cost: linear.
  double TakeOutNormalParts(const TriangleMesh& mesh, const SurfaceRelation& relation);

  /// The vectors on the faces. Of vertices, these are the means over the corners.
  Points OnFaces(const TriangleMesh& mesh) const;
};

/// The points of the corners of faces, each a point of the face's own cell: by halfedge, that of its tail.
/// \return empty where each vertex has one point only. Cost: linear.
std::vector<vtkIdType> PointsOfCorners(vtkDataSet* dataset, const TriangleMesh& mesh, const SurfaceRelation& relation);

/// Gives the elements without a vector the mean of their neighbours, as far as these have one. Neighbours of vertices are those along edges, and
/// neighbours of faces those across the sides of their cell.
void FillFromNeighbours(VectorsOnSurface& vectors, const std::vector<char>& isDefined, const TriangleMesh& mesh,
  const SurfaceRelation& relation);

}

#endif
