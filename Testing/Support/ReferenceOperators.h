#ifndef dmgTestReferenceOperators_h
#define dmgTestReferenceOperators_h

#include "Mesh/TangentFrames.h"
#include "Mesh/TriangleMesh.h"
#include "Mesh/VertexConnection.h"
#include "Operators/ExteriorCalculus.h"
#include "Support/ExecutionContext.h"
#include "Support/Types.h"

/// Operators that the core does without, as it has their factors or other forms of them. Tests compare with these.
namespace dmg::test
{

/// The 1-form of a vector per face (#F x 3): along an edge, the mean over its faces of the vector's
/// product with the edge.
Vector<double> FormFromFaceVectors(const TriangleMesh& mesh, const Points& vectors);

/// The 1-form of a vector per vertex (#V x 3), by the trapezoidal rule along the edges.
Vector<double> FormFromVertexVectors(const TriangleMesh& mesh, const Points& vectors);

/// P, 3 #F x 2 #F: integrals of the vectors along the halfedges of their faces.
SparseMatrix<double> HalfedgeProjection(
  const TriangleMesh& mesh, const TangentFrames& faceFrames, const ExecutionContext& context = SerialContext());

/// The smoothness matrix A = B^T B, B = FaceFieldSmoothnessFactor; 2 #F x 2 #F.
SparseMatrix<double> FaceFieldSmoothness(
  const TriangleMesh& mesh, const TangentFrames& faceFrames, const ExecutionContext& context = SerialContext());

/// Derivative of 1-forms, #F x #E: the sum around a face (the curl, integrated). D1 D0 = 0 exactly.
SparseMatrix<double> D1(const TriangleMesh& mesh, const ExecutionContext& context = SerialContext());

/// The Hodge Laplacian of 1-forms in weak form, #E x #E: B^T B, B = OneFormLaplacianFactor.
SparseMatrix<double> OneFormLaplacian(
  const TriangleMesh& mesh, const ExecutionContext& context, VertexAreas areas = VertexAreas::MixedVoronoi);

/// D_V, #V x 2 #F, and C_E, #E x 2 #F: the rows of FaceFieldSmoothnessFactor times the roots of their masses.
SparseMatrix<double> FaceDivergence(
  const TriangleMesh& mesh, const TangentFrames& faceFrames, const ExecutionContext& context = SerialContext());
SparseMatrix<double> FaceCurl(
  const TriangleMesh& mesh, const TangentFrames& faceFrames, const ExecutionContext& context = SerialContext());

/// Angle that carries a direction across an interior edge, from the frame of the face of
/// \p halfedge into the frame of the face of its twin: unfold both faces into one plane along the
/// edge.
/// \pre the halfedge has a twin.
double TransportAcrossEdge(const TriangleMesh& mesh, const TangentFrames& faceFrames, int halfedge);

/// The mass of linear elements, as in the appendix of Knoeppel et al. 2013: X^H M X is the integral of |X|^2. #V x #V, Hermitian, positive semi-definite; a unit of
/// area. Cost: O(#F).
SparseMatrix<Complex> ConnectionMass(const TriangleMesh& mesh, const VertexConnection& connection, int N,
  const ExecutionContext& context = SerialContext());

}

#endif
