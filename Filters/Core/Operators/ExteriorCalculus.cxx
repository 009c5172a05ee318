#include "Operators/ExteriorCalculus.h"

#include "Support/SparseAssembly.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace dmg
{

namespace
{

constexpr int Grain = 4096;

/// Relative to the square of the longest side.
constexpr double SmallestArea = 1e-4;
/// The same for the directions of a face (FaceProjection.h).
constexpr double DegenerateArea = 1e-10;

Vector3 Along(const TriangleMesh& mesh, int halfedge)
{
  return mesh.Position(mesh.Head(halfedge)) - mesh.Position(mesh.Tail(halfedge));
}

Vector3 AlongEdge(const TriangleMesh& mesh, int edge)
{
  const auto [tail, head] = mesh.EdgeVertices(edge);
  return mesh.Position(head) - mesh.Position(tail);
}

double RaisedArea(const TriangleMesh& mesh, int face, double smallest = SmallestArea)
{
  double longest = 0.0;
  for (int h = 3 * face; h < 3 * face + 3; ++h)
  {
    longest = std::max(longest, Along(mesh, h).squaredNorm());
  }
  return std::max(mesh.FaceArea(face), smallest * longest);
}

/// Product of the two sides at each corner of a face, from the corner outwards.
std::array<double, 3> CornerProducts(const TriangleMesh& mesh, int face)
{
  std::array<double, 3> products;
  for (int k = 0; k < 3; ++k)
  {
    products[k] = -Along(mesh, 3 * face + k).dot(Along(mesh, 3 * face + (k + 2) % 3));
  }
  return products;
}

/// Gradients of the barycentric coordinates of a face.
std::array<Vector3, 3> BarycentricGradients(const TriangleMesh& mesh, int face)
{
  const double doubleArea = 2.0 * RaisedArea(mesh, face);
  const Vector3 turn = mesh.FaceAreaVector(face) / (doubleArea * doubleArea);
  std::array<Vector3, 3> gradients;
  for (int k = 0; k < 3; ++k)
  {
    gradients[k] = turn.cross(Along(mesh, 3 * face + (k + 1) % 3));
  }
  return gradients;
}

/// The form along a halfedge.
double ValueAlong(const TriangleMesh& mesh, const Vector<double>& form, int halfedge)
{
  return mesh.EdgeSign(halfedge) * form[mesh.EdgeOf(halfedge)];
}

/// Calls visit(edge, sign) for the edges at a vertex, counter-clockwise; sign +1 where the edge
/// leads to the vertex, as in D0.
template <class Visit>
void VisitEdgesAt(const TriangleMesh& mesh, int vertex, Visit visit)
{
  const auto visitEdge = [&](int edge) { visit(edge, mesh.EdgeVertices(edge)[1] == vertex ? 1.0 : -1.0); };
  const int first = mesh.OutgoingHalfedge(vertex);
  int h = first;
  do
  {
    visitEdge(mesh.EdgeOf(h));
    const int incoming = TriangleMesh::Previous(h);
    h = mesh.Twin(incoming);
    if (h < 0)
    {
      visitEdge(mesh.EdgeOf(incoming));
    }
  } while (h >= 0 && h != first);
}

}

SparseMatrix<double> D0(const TriangleMesh& mesh, const ExecutionContext& context)
{
  return AssembleMatrix<double>(mesh.NumberOfEdges(), mesh.NumberOfVertices(), context,
    [&mesh](int edge, RowEntries<double>& row)
    {
      const auto [tail, head] = mesh.EdgeVertices(edge);
      row.emplace_back(tail, -1.0);
      row.emplace_back(head, 1.0);
    });
}

std::array<double, 3> VoronoiShares(const TriangleMesh& mesh, int face)
{
  const std::array<double, 3> products = CornerProducts(mesh, face);
  std::array<double, 3> shares;
  for (int k = 0; k < 3; ++k)
  {
    if (products[k] <= 0.0)
    {
      shares.fill(0.25);
      shares[k] = 0.5;
      return shares;
    }
  }
  // The kite at a corner is (sum over its sides |side|^2 cot(opposite angle)) / 8.
  std::array<double, 3> perSide;
  for (int k = 0; k < 3; ++k)
  {
    perSide[k] = Along(mesh, 3 * face + k).squaredNorm() * products[(k + 2) % 3];
  }
  const double sum = perSide[0] + perSide[1] + perSide[2];
  for (int k = 0; k < 3; ++k)
  {
    shares[k] = 0.5 * (perSide[k] + perSide[(k + 2) % 3]) / sum;
  }
  return shares;
}

Vector<double> Star0(const TriangleMesh& mesh, VertexAreas areas)
{
  Vector<double> star = Vector<double>::Zero(mesh.NumberOfVertices());
  for (int face = 0; face < mesh.NumberOfFaces(); ++face)
  {
    const double area = RaisedArea(mesh, face);
    const std::array<double, 3> shares = areas == VertexAreas::MixedVoronoi
      ? VoronoiShares(mesh, face)
      : std::array<double, 3>{ 1.0 / 3.0, 1.0 / 3.0, 1.0 / 3.0 };
    for (int k = 0; k < 3; ++k)
    {
      star[mesh.FaceCorners()(face, k)] += shares[k] * area;
    }
  }
  return star;
}

namespace
{

/// Half the sum of the cotangents opposite to each edge.
Vector<double> Cotangents(const TriangleMesh& mesh, double smallestArea)
{
  Vector<double> star = Vector<double>::Zero(mesh.NumberOfEdges());
  for (int face = 0; face < mesh.NumberOfFaces(); ++face)
  {
    const std::array<double, 3> products = CornerProducts(mesh, face);
    const double doubleArea = 2.0 * RaisedArea(mesh, face, smallestArea);
    for (int k = 0; k < 3; ++k)
    {
      star[mesh.EdgeOf(3 * face + k)] += 0.5 * products[(k + 2) % 3] / doubleArea;
    }
  }
  return star;
}

}

Vector<double> Star1(const TriangleMesh& mesh)
{
  return Cotangents(mesh, SmallestArea);
}

Vector<double> Star1OfFaceFields(const TriangleMesh& mesh)
{
  return Cotangents(mesh, DegenerateArea);
}

double PositiveStar1OfEdge(const TriangleMesh& mesh, int edge)
{
  const int h = mesh.HalfedgeOf(edge);
  const int twin = mesh.Twin(h);
  double area = RaisedArea(mesh, TriangleMesh::FaceOf(h)) / 3.0;
  if (twin >= 0)
  {
    area += RaisedArea(mesh, TriangleMesh::FaceOf(twin)) / 3.0;
  }
  return std::min(2.0 * area / AlongEdge(mesh, edge).squaredNorm(), 1.0 / SmallestArea);
}

Vector<double> PositiveStar1(const TriangleMesh& mesh, const ExecutionContext& context)
{
  Vector<double> star(mesh.NumberOfEdges());
  constexpr int grain = 4096;
  context.ParallelFor(0, mesh.NumberOfEdges(), grain,
    [&mesh, &star](int first, int last)
    {
      for (int edge = first; edge < last; ++edge)
      {
        star[edge] = PositiveStar1OfEdge(mesh, edge);
      }
    });
  return star;
}

Vector<double> Star2(const TriangleMesh& mesh)
{
  Vector<double> star(mesh.NumberOfFaces());
  for (int face = 0; face < mesh.NumberOfFaces(); ++face)
  {
    star[face] = 1.0 / RaisedArea(mesh, face);
  }
  return star;
}

SparseMatrix<double> OneFormLaplacianFactor(
  const TriangleMesh& mesh, const ExecutionContext& context, VertexAreas areas)
{
  const int faces = mesh.NumberOfFaces();
  const Vector<double> star0 = Star0(mesh, areas);
  const Vector<double> star1 = Star1(mesh);
  const Vector<double> star2 = Star2(mesh);
  return AssembleMatrix<double>(faces + mesh.NumberOfVertices(), mesh.NumberOfEdges(), context,
    [&](int r, RowEntries<double>& row)
    {
      if (r < faces)
      {
        for (int h = 3 * r; h < 3 * r + 3; ++h)
        {
          AddTo(row, mesh.EdgeOf(h), mesh.EdgeSign(h) * std::sqrt(star2[r]));
        }
        return;
      }
      const int vertex = r - faces;
      VisitEdgesAt(mesh, vertex,
        [&](int edge, double sign) { row.emplace_back(edge, sign * star1[edge] / std::sqrt(star0[vertex])); });
    });
}

Points WhitneyAtFaces(const TriangleMesh& mesh, const Vector<double>& form, const ExecutionContext& context)
{
  Points vectors(mesh.NumberOfFaces(), 3);
  context.ParallelFor(0, mesh.NumberOfFaces(), Grain,
    [&](int first, int last)
    {
      for (int face = first; face < last; ++face)
      {
        const std::array<Vector3, 3> gradients = BarycentricGradients(mesh, face);
        Vector3 vector = Vector3::Zero();
        for (int k = 0; k < 3; ++k)
        {
          vector += ValueAlong(mesh, form, 3 * face + k) / 3.0 * (gradients[(k + 1) % 3] - gradients[k]);
        }
        vectors.row(face) = vector.transpose();
      }
    });
  return vectors;
}

Points WhitneyAtVertices(const TriangleMesh& mesh, const TangentFrames& faceFrames, const TangentFrames& vertexFrames,
  const Unfilled<Corner>& corners, const Vector<double>& form, const ExecutionContext& context)
{
  Points vectors(mesh.NumberOfVertices(), 3);
  context.ParallelFor(0, mesh.NumberOfVertices(), Grain,
    [&](int first, int last)
    {
      for (int vertex = first; vertex < last; ++vertex)
      {
        Complex sum = 0.0;
        double sumOfAngles = 0.0;
        mesh.VisitFan(vertex,
          [&](int h)
          {
            const int face = TriangleMesh::FaceOf(h);
            const int k = h % 3;
            const int next = (k + 1) % 3;
            const int previous = (k + 2) % 3;
            const std::array<Vector3, 3> gradients = BarycentricGradients(mesh, face);
            const Vector3 inFace = ValueAlong(mesh, form, h) * gradients[next] -
              ValueAlong(mesh, form, 3 * face + previous) * gradients[previous];
            const auto& [turn, angle] = corners[h];
            sum += angle * turn * faceFrames.ToComplex(face, inFace);
            sumOfAngles += angle;
          });
        const double scale = sumOfAngles > 0.0 ? 1.0 / sumOfAngles : 0.0;
        vectors.row(vertex) = vertexFrames.ToVector(vertex, scale * sum).transpose();
      }
    });
  return vectors;
}

SparseMatrix<double> FormFromFaceField(
  const TriangleMesh& mesh, const TangentFrames& faceFrames, const ExecutionContext& context)
{
  return AssembleMatrix<double>(mesh.NumberOfEdges(), 2 * mesh.NumberOfFaces(), context,
    [&](int edge, RowEntries<double>& row)
    {
      const auto [i, j] = mesh.EdgeVertices(edge);
      const Vector3 along = mesh.Position(j) - mesh.Position(i);
      const int halfedge = mesh.HalfedgeOf(edge);
      const double share = mesh.Twin(halfedge) < 0 ? 1.0 : 0.5;
      for (int h : { halfedge, mesh.Twin(halfedge) })
      {
        if (h >= 0)
        {
          const int face = TriangleMesh::FaceOf(h);
          const Complex z = share * faceFrames.ToComplex(face, along);
          AddTo(row, 2 * face, z.real());
          AddTo(row, 2 * face + 1, z.imag());
        }
      }
    });
}

}
