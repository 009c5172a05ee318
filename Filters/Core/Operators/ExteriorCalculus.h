#ifndef dmgExteriorCalculus_h
#define dmgExteriorCalculus_h

#include "Mesh/TangentFrames.h"
#include "Mesh/TriangleMesh.h"
#include "Support/ExecutionContext.h"
#include "Support/Types.h"

#include <array>

/// Discrete exterior calculus: a k-form is a number per vertex (k = 0), edge (k = 1: its integral
/// along the edge, in the edge's orientation) or face (k = 2: its integral over the face,
/// counter-clockwise). Thesis, sections 3.1 and 3.2; Hirani 2003; Desbrun et al. 2008.
///
/// Where a metric quantity divides by an area, the area of a face is raised to 1e-4 times the
/// square of its longest side, so that slivers and faces of no area stay finite; the exterior
/// derivatives know no metric and are exact everywhere. All functions cost O(#F).
namespace dmg
{

/// Derivative of 0-forms, #E x #V: the value at an edge's larger vertex less that at its smaller
/// one.
SparseMatrix<double> D0(const TriangleMesh& mesh, const ExecutionContext& context = SerialContext());

/// The part that a vertex has of the faces around it.
enum class VertexAreas
{
  /// A third of each face.
  Barycentric,
  /// The places nearest to the vertex; in an obtuse face a half for the obtuse corner and a quarter
  /// for the others (Meyer et al. 2003).
  MixedVoronoi,
};

/// The shares that the corners have of a face by MixedVoronoi, positive; they sum to 1.
std::array<double, 3> VoronoiShares(const TriangleMesh& mesh, int face);

/// Hodge star of 0-forms, #V areas, always positive; they sum to the (raised) area of the surface.
Vector<double> Star0(const TriangleMesh& mesh, VertexAreas areas = VertexAreas::MixedVoronoi);

/// Hodge star of 1-forms, #E, dimensionless: length of the dual edge over that of the edge, half
/// the sum of the cotangents opposite to it. Zero or negative where the edge is not Delaunay: good
/// for energies that stay semi-definite whatever its sign (OneFormLaplacianFactor), not as a mass.
Vector<double> Star1(const TriangleMesh& mesh);

/// Star1 as face fields have it: with it, d0^T star1 of a closed form is the divergence of its vectors (FaceFieldOperators.h). Areas are raised
/// to 1e-10 times the square of the longest side only, where directions of a face end, too (FaceProjection.h).
Vector<double> Star1OfFaceFields(const TriangleMesh& mesh);

/// A mass of 1-forms, #E, dimensionless and always positive: 2 A_e / |e|^2, A_e a third of the
/// faces at e, at most 1e4. It agrees with Star1 on equilateral triangles and, on every mesh
/// without slivers, with |v|^2 times the area on the average over the directions of a constant
/// vector v.
Vector<double> PositiveStar1(const TriangleMesh& mesh, const ExecutionContext& context = SerialContext());

/// The entry of PositiveStar1 of one edge.
double PositiveStar1OfEdge(const TriangleMesh& mesh, int edge);

/// Hodge star of 2-forms, #F: 1 / area.
Vector<double> Star2(const TriangleMesh& mesh);

/// The Hodge energy of 1-forms as a sum of squares, the squared curl plus the squared divergence, integrated: |B h|^2 = h^T L1 h with
///   L1 = d1^T star2 d1 + star1 d0 star0^-1 d0^T star1,
/// d1 the sum around a face. B has a row per face, star2^1/2 d1, and per vertex, star0^-1/2 d0^T star1; 4 entries per edge. L1 is
/// positive semi-definite for every sign of Star1, because Star0 is positive.
///
/// On a boundary the conditions are the natural ones, no flux across it and no curl on it. The kernel are the harmonic forms. Their
/// dimension is 2 g per closed component of genus g, 2 g + b - 1 with b > 0 boundary loops. Thesis, section 6.1 with its transposes
/// put right.
SparseMatrix<double> OneFormLaplacianFactor(
  const TriangleMesh& mesh, const ExecutionContext& context, VertexAreas areas = VertexAreas::MixedVoronoi);

/// The vector of a 1-form at the centre of each face, #F x 3: that of its Whitney interpolant
///   sum over sides ij of z_ij (b_i grad b_j - b_j grad b_i),   b the barycentric coordinates.
/// Exact for constant vectors in a plane.
Points WhitneyAtFaces(
  const TriangleMesh& mesh, const Vector<double>& form, const ExecutionContext& context = SerialContext());

/// The vector of a 1-form at each vertex, #V x 3, tangent to \p vertexFrames: the mean of the
/// Whitney interpolants of the faces around, by corner angle, each carried into the tangent plane
/// of the vertex by the shortest rotation between the normals.
Points WhitneyAtVertices(const TriangleMesh& mesh, const TangentFrames& faceFrames, const TangentFrames& vertexFrames,
  const Unfilled<Corner>& corners, const Vector<double>& form, const ExecutionContext& context = SerialContext());

/// The 1-form of a face field, #E x 2 #F: along an edge, the mean over its faces of the vector's product with the edge.
SparseMatrix<double> FormFromFaceField(
  const TriangleMesh& mesh, const TangentFrames& faceFrames, const ExecutionContext& context);

}

#endif
