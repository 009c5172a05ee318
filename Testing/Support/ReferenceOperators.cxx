#include "Support/ReferenceOperators.h"

#include "Mesh/FaceProjection.h"
#include "Operators/ConnectionLaplacian.h"
#include "Operators/FaceFieldOperators.h"
#include "Operators/PowerFieldOperators.h"
#include "Support/SparseAssembly.h"
#include "Support/SparseKernels.h"

#include <complex>

namespace dmg::test
{
namespace
{

Vector3 AlongEdge(const TriangleMesh& mesh, int edge)
{
  const auto [tail, head] = mesh.EdgeVertices(edge);
  return mesh.Position(head) - mesh.Position(tail);
}

/// The integral of e^{i s t} (1 - t)^3 / 6 for t from 0 to 1, by Simpson's rule.
Complex MassIntegral(double s)
{
  constexpr int Steps = 1000;
  Complex sum = 0.0;
  for (int k = 0; k <= Steps; ++k)
  {
    const double t = static_cast<double>(k) / Steps;
    const double weight = k == 0 || k == Steps ? 1.0 : (k % 2 == 1 ? 4.0 : 2.0);
    sum += weight * std::polar((1.0 - t) * (1.0 - t) * (1.0 - t) / 6.0, s * t);
  }
  return sum / (3.0 * Steps);
}

}

Vector<double> FormFromFaceVectors(const TriangleMesh& mesh, const Points& vectors)
{
  Vector<double> form(mesh.NumberOfEdges());
  for (int edge = 0; edge < mesh.NumberOfEdges(); ++edge)
  {
    const int h = mesh.HalfedgeOf(edge);
    const int twin = mesh.Twin(h);
    Vector3 mean = vectors.row(TriangleMesh::FaceOf(h)).transpose();
    if (twin >= 0)
    {
      mean = 0.5 * (mean + vectors.row(TriangleMesh::FaceOf(twin)).transpose());
    }
    form[edge] = mean.dot(AlongEdge(mesh, edge));
  }
  return form;
}

Vector<double> FormFromVertexVectors(const TriangleMesh& mesh, const Points& vectors)
{
  Vector<double> form(mesh.NumberOfEdges());
  for (int edge = 0; edge < mesh.NumberOfEdges(); ++edge)
  {
    const auto [tail, head] = mesh.EdgeVertices(edge);
    form[edge] = 0.5 * (vectors.row(tail) + vectors.row(head)).dot(AlongEdge(mesh, edge));
  }
  return form;
}

SparseMatrix<double> HalfedgeProjection(
  const TriangleMesh& mesh, const TangentFrames& faceFrames, const ExecutionContext& context)
{
  const int faces = mesh.NumberOfFaces();
  return AssembleMatrix<double>(3 * faces, 2 * faces, context,
    [&](int h, RowEntries<double>& row)
    {
      const int face = TriangleMesh::FaceOf(h);
      const Vector2 side = ProjectionOntoSides(mesh, faceFrames, face).row(h % 3).transpose();
      row.emplace_back(2 * face, side[0]);
      row.emplace_back(2 * face + 1, side[1]);
    });
}

SparseMatrix<double> FaceFieldSmoothness(
  const TriangleMesh& mesh, const TangentFrames& faceFrames, const ExecutionContext& context)
{
  return NormalMatrix(FaceFieldSmoothnessFactor(mesh, faceFrames, context), context);
}

SparseMatrix<double> D1(const TriangleMesh& mesh, const ExecutionContext& context)
{
  return AssembleMatrix<double>(mesh.NumberOfFaces(), mesh.NumberOfEdges(), context,
    [&mesh](int face, RowEntries<double>& row)
    {
      for (int h = 3 * face; h < 3 * face + 3; ++h)
      {
        row.emplace_back(mesh.EdgeOf(h), mesh.EdgeSign(h));
      }
    });
}

SparseMatrix<double> OneFormLaplacian(const TriangleMesh& mesh, const ExecutionContext& context, VertexAreas areas)
{
  return NormalMatrix(OneFormLaplacianFactor(mesh, context, areas), context);
}

SparseMatrix<double> FaceDivergence(
  const TriangleMesh& mesh, const TangentFrames& faceFrames, const ExecutionContext& context)
{
  const SparseMatrix<double> B = FaceFieldSmoothnessFactor(mesh, faceFrames, context);
  return MassesOfFaceFields(mesh).Vertices.cwiseSqrt().asDiagonal() * B.topRows(mesh.NumberOfVertices());
}

SparseMatrix<double> FaceCurl(
  const TriangleMesh& mesh, const TangentFrames& faceFrames, const ExecutionContext& context)
{
  const SparseMatrix<double> B = FaceFieldSmoothnessFactor(mesh, faceFrames, context);
  return MassesOfFaceFields(mesh).Edges.cwiseSqrt().asDiagonal() *
    B.middleRows(mesh.NumberOfVertices(), mesh.NumberOfEdges());
}

double TransportAcrossEdge(const TriangleMesh& mesh, const TangentFrames& faceFrames, int halfedge)
{
  const int twin = mesh.Twin(halfedge);
  const Complex here = SideDirections(mesh, faceFrames, TriangleMesh::FaceOf(halfedge))[halfedge % 3];
  const Complex there = SideDirections(mesh, faceFrames, TriangleMesh::FaceOf(twin))[twin % 3];
  return std::arg(TransportOfSides(here, there));
}

SparseMatrix<Complex> ConnectionMass(
  const TriangleMesh& mesh, const VertexConnection& connection, int N, const ExecutionContext& context)
{
  return AssembleMatrix<Complex>(mesh.NumberOfVertices(), mesh.NumberOfVertices(), context,
    [&](int vertex, RowEntries<Complex>& row)
    {
      mesh.VisitFan(vertex,
        [&](int h)
        {
          const int face = TriangleMesh::FaceOf(h);
          const double area = mesh.FaceArea(face);
          const Complex ofSide = 2.0 * area * MassIntegral(N * connection.Curvature(face));
          const int last = TriangleMesh::Previous(h);
          AddTo(row, vertex, Complex(area / 6.0));
          AddTo(row, mesh.Head(h), std::polar(1.0, -N * connection.Transport(h)) * ofSide);
          AddTo(row, mesh.Tail(last), std::conj(std::polar(1.0, -N * connection.Transport(last)) * ofSide));
        });
    });
}

}
