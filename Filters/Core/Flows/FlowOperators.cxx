#include "Flows/FlowOperators.h"

#include "Mesh/FaceProjection.h"

namespace dmg
{
namespace
{

constexpr int Grain = 4096;

template <class Visit>
void ForAll(int number, const ExecutionContext& context, const Visit& visit)
{
  context.ParallelFor(0, number, Grain,
    [&visit](int first, int last)
    {
      for (int k = first; k < last; ++k)
      {
        visit(k);
      }
    });
}

/// Twice A_f grad lambda_v at the tail of a halfedge: the opposite side after a quarter turn.
Complex TurnedOppositeSide(const FramedMesh& surface, int halfedge)
{
  const int opposite = TriangleMesh::Next(halfedge);
  const Vector3 side =
    surface.Mesh.Position(surface.Mesh.Head(opposite)) - surface.Mesh.Position(surface.Mesh.Tail(opposite));
  return Complex(0.0, 1.0) * surface.Faces.ToComplex(TriangleMesh::FaceOf(halfedge), side);
}

/// On each face, the vector whose integrals along the sides are nearest to those of its halfedges.
template <class AlongHalfedge>
Vector<Complex> VectorsOfSides(const FramedMesh& surface, const AlongHalfedge& along, const ExecutionContext& context)
{
  const TriangleMesh& mesh = surface.Mesh;
  Vector<Complex> vectors(mesh.NumberOfFaces());
  ForAll(mesh.NumberOfFaces(), context,
    [&](int face)
    {
      const Vector3 sides(along(3 * face), along(3 * face + 1), along(3 * face + 2));
      const Vector2 inFrame = PseudoInverse(ProjectionOntoSides(mesh, surface.Faces, face)) * sides;
      vectors[face] = { inFrame[0], inFrame[1] };
    });
  return vectors;
}

}

Vector<Complex> GradientOnFaces(const FramedMesh& surface, const Vector<double>& u, const ExecutionContext& context)
{
  return VectorsOfSides(
    surface, [&](int h) { return u[surface.Mesh.Head(h)] - u[surface.Mesh.Tail(h)]; }, context);
}

Vector<Complex> FlowOfForm(const FramedMesh& surface, const Vector<double>& form, const ExecutionContext& context)
{
  return VectorsOfSides(
    surface, [&](int h) { return surface.Mesh.EdgeSign(h) * form[surface.Mesh.EdgeOf(h)]; }, context);
}

FlowDerivatives IntegratedDerivatives(
  const FramedMesh& surface, const Vector<Complex>& X, const ExecutionContext& context)
{
  const int vertices = surface.Mesh.NumberOfVertices();
  FlowDerivatives derivatives{ Vector<double>(vertices), Vector<double>(vertices) };
  ForAll(vertices, context,
    [&](int vertex)
    {
      Complex sum = 0.0;
      surface.Mesh.VisitFan(
        vertex, [&](int h) { sum += std::conj(X[TriangleMesh::FaceOf(h)]) * TurnedOppositeSide(surface, h); });
      derivatives.Divergence[vertex] = -0.5 * sum.real();
      derivatives.Vorticity[vertex] = 0.5 * sum.imag();
    });
  return derivatives;
}

SharesOfEdges BoundaryFlowAt(int vertex, const FramedMesh& surface, const Vector<Complex>& X)
{
  const TriangleMesh& mesh = surface.Mesh;
  Complex sum = 0.0;
  int before = -1;
  mesh.VisitFan(vertex,
    [&](int h)
    {
      sum += std::conj(X[TriangleMesh::FaceOf(h)]) * TurnedOppositeSide(surface, h);
      before = TriangleMesh::Previous(h); // at last that without a twin
    });
  const auto acrossSide = [&](int h)
  {
    const int face = TriangleMesh::FaceOf(h);
    const Vector3 side = mesh.Position(mesh.Head(h)) - mesh.Position(mesh.Tail(h));
    return std::conj(X[face]) * Complex(0.0, -1.0) * surface.Faces.ToComplex(face, side);
  };
  const Complex first = acrossSide(before), second = acrossSide(mesh.OutgoingHalfedge(vertex));
  const Complex rest = sum - first - second;
  return { std::conj(0.5 * first + 0.25 * rest), std::conj(0.5 * second + 0.25 * rest) };
}

double FlowProduct(const Vector<double>& areas, const Vector<Complex>& X, const Vector<Complex>& Y)
{
  double sum = 0.0;
  for (Eigen::Index face = 0; face < areas.size(); ++face)
  {
    sum += areas[face] * (std::conj(X[face]) * Y[face]).real();
  }
  return sum;
}

}
