#ifndef dmgFaceFieldOperators_h
#define dmgFaceFieldOperators_h

#include "Mesh/TangentFrames.h"
#include "Mesh/TriangleMesh.h"
#include "Support/ExecutionContext.h"
#include "Support/Types.h"

/// Operators on face fields: one tangent vector per face, in its frame. A field is 2 #F numbers,
/// (2 f, 2 f + 1) the components along X and Y of face f. Thesis, sections 3.3 and 6.2; de Goes et
/// al. 2016.
namespace dmg
{

/// P^+, 2 #F x 3 #F: see PseudoInverse. It is the inverse of the integrals of vectors along the halfedges of their faces, P, where no
/// face is degenerate.
SparseMatrix<double> HalfedgePseudoInverse(
  const TriangleMesh& mesh, const TangentFrames& faceFrames, const ExecutionContext& context = SerialContext());

/// G, 2 #F x #V: gradients of functions that are linear on faces, P^+ of their differences along
/// halfedges. In a degenerate face only the part along its longest side.
SparseMatrix<double> FaceGradient(
  const TriangleMesh& mesh, const TangentFrames& faceFrames, const ExecutionContext& context = SerialContext());

/// Diagonal masses, areas, by mixed elements. The divergence and the curl of FaceFieldSmoothnessFactor are integrals, so the masses of
/// vertices and edges enter energies inverted; for that, a face of less area than 1e-6 times the
/// square of its longest side counts with as much in these two.
struct FaceFieldMasses
{
  Vector<double> Vertices; ///< M_V, #V: a third of the area of the faces around; > 0
  Vector<double> Edges;    ///< M_E, #E: a third of the area of the one or two faces; > 0
  Vector<double> Faces;    ///< M_F, 2 #F: the area of the face, twice; >= 0
};
FaceFieldMasses MassesOfFaceFields(const TriangleMesh& mesh);

/// The squares that the smoothness energy of a face field sums up, dimensionless: B with X^T A X = |B X|^2, A = B^T B, and
///   X^T A X = (D_V X)^T M_V^-1 (D_V X) + (C_E X)^T M_E^-1 (C_E X) .
///
/// D_V is the divergence integrated around each vertex, positive at sources,
///   (D_V X)_v = - sum over faces f around v of A_f X_f . grad lambda_v ,
/// with lambda_v linear, 1 at v and 0 at the other vertices. D_V = -G^T M_F where no face is degenerate. It sums to zero: at boundary
/// vertices it holds the flux through the boundary, too, so fields with D_V X = 0 do not cross it. A_f grad lambda_v is half the
/// opposite side, rotated, and so finite in every face.
///
/// C_E is the curl integrated over each interior edge, counter-clockwise, (C_E X)_e = (X_g - X_f) . e , with f to the left and g to
/// the right of the edge e. Rows of boundary edges are empty. C_E G = 0.
///
/// Its kernel are the harmonic fields that run along the boundary. Their dimension is the first
/// Betti number of the surface: 2 g where it is closed, 2 g + b - 1 with b boundary loops; none on
/// spheres and discs.
/// Degenerate faces with a side of no length add 1e-6 |X_f|^2: through two of them that share that side a field
/// circulates at no cost. Others add 1e-12 |X_f|^2. Cost: O(#F) for bounded valence.
/// A row of B per vertex, M_V^-1/2 D_V, per edge, M_E^-1/2 C_E, and two per degenerate face. 12 entries per face.
SparseMatrix<double> FaceFieldSmoothnessFactor(
  const TriangleMesh& mesh, const TangentFrames& faceFrames, const ExecutionContext& context = SerialContext());

/// Tangential parts of vectors in space, #F x 3, as a face field.
Vector<double> FaceFieldFromVectors(const TangentFrames& faceFrames, const Points& vectors);

/// A face field as vectors in space, #F x 3.
Points VectorsFromFaceField(const TangentFrames& faceFrames, const Vector<double>& field);

}

#endif
