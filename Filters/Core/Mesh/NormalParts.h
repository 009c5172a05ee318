#ifndef dmgNormalParts_h
#define dmgNormalParts_h

#include "Mesh/SurfaceRelation.h"
#include "Mesh/TangentFrames.h"
#include "Mesh/TriangleMesh.h"
#include "Support/Types.h"

namespace dmg
{

/// The unit normal at a vertex: of the sum over the corners of a x b / (|a|^2 |b|^2), a and b the sides from the vertex (N. Max,
/// "Weights for computing vertex normals from facet normals", 1999). They are exact where the points lie on a sphere, of second order on other smooth
/// surfaces, and of first order at boundaries.
Vector3 NormalOfVertex(const TriangleMesh& mesh, int vertex);
/// The same at all vertices, #V x 3. Cost: linear.
Points NormalsOfVertices(const TriangleMesh& mesh);

/// A vector at a vertex without its part along NormalOfVertex, as in WithoutNormalParts. Zero where less than 1e-6 of it is left.
Vector3 WithoutNormalPart(const TriangleMesh& mesh, int vertex, const Vector3& vector);
/// The same, but that a vector in the plane of its frame, as those of fields, stays as it is, to the last bit.
Vector3 WithoutNormalPart(const TriangleMesh& mesh, const TangentFrames& ofVertices, int vertex, const Vector3& vector);

/// Vectors at vertices as a tangential part, and what is told of the rest.
struct SplitVectors
{
  Points Tangential; ///< #V x 3
  Points AtCorners;  ///< the same for vectors by corner; empty where there are none
  /// At boundary vertices where the surface bends, the part along the normal over the tangential one, roots of mean squares; 0 where there are none.
  /// There the normal is known on one side alone, and derivatives of the tangential part are off by about half of the normal part times the
  /// curvature, at any resolution.
  double RatioAtRim = 0.0;
};

/// Takes the part along NormalsOfVertices out of vectors, as of tractions or of velocities through a surface. Taken out by the normals of faces,
/// after means over their corners, it would leave a flow of the size of this part. At sharp edges, with a face that leans by more than 30
/// degrees, vectors stay as they are: they may be tangential to one of the faces.
/// \param vectors #V x 3. \param atCorners 3 #F x 3, row h at the tail of halfedge h, or empty.
/// Cost: linear.
SplitVectors WithoutNormalParts(const TriangleMesh& mesh, const Points& vectors, const Points& atCorners);

/// A vector of the cell of a face without its part along the normal of the cell, the mean of its triangles, as tractions on facets have it. A part along
/// the normal of a smooth surface that the cells approximate leaves a tangential one of its size times the length of a side. A vector in the plane of
/// its cell stays as it is, to the last bit. Zero where less than 1e-6 is left.
Vector3 WithoutNormalPartOfCell(
  const TriangleMesh& mesh, const SurfaceRelation& relation, int face, const Vector3& vector);

/// A vector at a place in a face, as one of a guide, without its part along the normal of the corners, interpolated; in faces at the boundary and at sharp
/// edges along the face's own. A vector in the plane of its face stays as it is.
Vector3 WithoutNormalPartAt(const TriangleMesh& mesh, int face, const Vector3& place, const Vector3& vector);

/// WithoutNormalPartOfCell for all cells. \param vectors #F x 3: row f is that of the cell of face f. Cost: linear.
Points WithoutNormalPartsOfCells(const TriangleMesh& mesh, const SurfaceRelation& relation, const Points& vectors);

}

#endif
