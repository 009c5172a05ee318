#include "Operators/ConnectionLaplacian.h"

#include "Support/Permutations.h"
#include "Support/SparseAssembly.h"
#include "Support/Unfilled.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace dmg
{

namespace
{

constexpr int Grain = 4096;

/// Keeps |e|^2 / area of slivers finite; relative to |e|^2.
constexpr double SmallestArea = 1e-6;

constexpr int LargestPower = 5;

/// [n] is the integral of (1 - t)^n e^{i s t} for t from 0 to 1.
using Moments = std::array<Complex, LargestPower + 1>;

/// Integration by parts gives i s [n] = n [n - 1] - 1. Upwards that loses digits where s is small, downwards where it is large.
Moments MomentsOf(double s)
{
  constexpr int Terms = 16;
  const Complex is(0.0, s);
  Moments moments;
  if (std::abs(s) > 1.0)
  {
    moments[0] = (std::polar(1.0, s) - 1.0) / is;
    for (int n = 1; n <= LargestPower; ++n)
    {
      moments[n] = (static_cast<double>(n) * moments[n - 1] - 1.0) / is;
    }
    return moments;
  }
  // The series has the terms (i s)^k n! / (n + k + 1)!.
  double even = 0.0; // the sums of even and odd powers, by Horner's rule
  double odd = 0.0;
  constexpr int n = LargestPower;
  std::array<double, Terms> terms;
  double term = 1.0 / (n + 1);
  for (int k = 0; k < Terms; ++k)
  {
    terms[k] = (k / 2) % 2 == 0 ? term : -term;
    term /= n + k + 2;
  }
  for (int k = Terms - 2; k >= 0; k -= 2)
  {
    even = even * s * s + terms[k];
    odd = odd * s * s + terms[k + 1];
  }
  moments[n] = Complex(even, odd * s);
  for (int k = n; k > 0; --k)
  {
    moments[k - 1] = (1.0 + is * moments[k]) / static_cast<double>(k);
  }
  return moments;
}

/// The matrix of one face: the diagonal, and per side k the entry of its tail's row and its head's column.
struct ElementMatrix
{
  std::array<double, 3> Diagonal;
  std::array<Complex, 3> Sides;
};

ElementMatrix StiffnessOf(const TriangleMesh& mesh, const VertexConnection& connection, int N, int face)
{
  std::array<Vector3, 3> sides;
  double longest = 0.0;
  for (int k = 0; k < 3; ++k)
  {
    const int h = 3 * face + k;
    sides[k] = mesh.Position(mesh.Head(h)) - mesh.Position(mesh.Tail(h));
    longest = std::max(longest, sides[k].squaredNorm());
  }
  const double area = std::max(0.5 * sides[0].cross(sides[1]).norm(), SmallestArea * longest);
  const double s = N * connection.Curvature(face);
  const CurvedElementIntegrals integrals(s);
  ElementMatrix matrix;
  for (int k = 0; k < 3; ++k)
  {
    // Side k is opposite to the corner from which the two others start.
    const Vector3& toTail = sides[(k + 2) % 3];
    const Vector3 toHead = -sides[(k + 1) % 3];
    const double squares = toTail.squaredNorm() + toHead.squaredNorm();
    const double product = toTail.dot(toHead);
    matrix.Diagonal[(k + 2) % 3] = (sides[k].squaredNorm() + s * s / 90.0 * (squares + product)) / (4.0 * area);
    matrix.Sides[k] = std::polar(1.0, -N * connection.Transport(3 * face + k)) *
      ((integrals.OfSquares * squares - integrals.OfProduct * product) / (2.0 * area));
  }
  return matrix;
}

/// The neighbours of a vertex by their places, ascending, with the vertex itself.
void VisitNeighbours(const TriangleMesh& mesh, int vertex, const std::vector<int>& places, std::vector<int>& columns)
{
  columns.assign(1, places[vertex]);
  mesh.VisitFan(vertex,
    [&](int h)
    {
      columns.push_back(places[mesh.Head(h)]);
      if (const int last = TriangleMesh::Previous(h); mesh.Twin(last) < 0)
      {
        columns.push_back(places[mesh.Tail(last)]);
      }
    });
  std::sort(columns.begin(), columns.end());
}

int NumberOfNeighbours(const TriangleMesh& mesh, int vertex)
{
  int faces = 0;
  mesh.VisitFan(vertex, [&faces](int) { ++faces; });
  return faces + (mesh.IsBoundaryVertex(vertex) ? 1 : 0);
}

template <class MatrixOfFace>
SparseMatrix<Complex> AssembleElements(
  const TriangleMesh& mesh, const std::vector<int>& order, const ExecutionContext& context, MatrixOfFace matrixOfFace)
{
  Unfilled<ElementMatrix> elements(mesh.NumberOfFaces());
  context.ParallelFor(0, mesh.NumberOfFaces(), Grain,
    [&](int first, int last)
    {
      for (int face = first; face < last; ++face)
      {
        elements[face] = matrixOfFace(face);
      }
    });
  const std::vector<int> places = Inverse(order, context);
  const int size = mesh.NumberOfVertices();
  return FillRows<Complex>(
    size, size, context, [&](int row) { return 1 + NumberOfNeighbours(mesh, order[row]); },
    [&](int row, int* columns, Complex* values)
    {
      thread_local std::vector<int> around;
      const int vertex = order[row];
      VisitNeighbours(mesh, vertex, places, around);
      std::copy(around.begin(), around.end(), columns);
      std::fill_n(values, around.size(), Complex(0.0));
      const auto add = [&](int column, Complex value)
      { values[std::lower_bound(around.begin(), around.end(), places[column]) - around.begin()] += value; };
      mesh.VisitFan(vertex,
        [&](int h)
        {
          const ElementMatrix& element = elements[TriangleMesh::FaceOf(h)];
          const int last = TriangleMesh::Previous(h);
          add(vertex, element.Diagonal[h % 3]);
          add(mesh.Head(h), element.Sides[h % 3]);
          add(mesh.Tail(last), std::conj(element.Sides[last % 3]));
        });
    });
}

}

CurvedElementIntegrals::CurvedElementIntegrals(double s)
{
  const Moments m = MomentsOf(s);
  const Complex is(0.0, s);
  this->OfSquares = -is * (m[2] / 2.0 - m[3] / 3.0) - s * s * (m[4] / 12.0 - m[5] / 20.0);
  this->OfProduct = m[1] - is * m[3] / 3.0 - s * s * (m[3] / 6.0 - m[4] / 6.0 + m[5] / 15.0);
}

SparseMatrix<Complex> ConnectionLaplacian(
  const TriangleMesh& mesh, const VertexConnection& connection, int N, const ExecutionContext& context)
{
  return ConnectionLaplacian(mesh, connection, N, Identity(mesh.NumberOfVertices()), context);
}

SparseMatrix<Complex> ConnectionLaplacian(const TriangleMesh& mesh, const VertexConnection& connection, int N,
  const std::vector<int>& order, const ExecutionContext& context)
{
  return AssembleElements(mesh, order, context, [&](int face) { return StiffnessOf(mesh, connection, N, face); });
}

Vector<double> LumpedMass(const TriangleMesh& mesh, const ExecutionContext& context)
{
  const Vector<double> areas = mesh.FaceAreas(context);
  Vector<double> mass(mesh.NumberOfVertices());
  context.ParallelFor(0, mesh.NumberOfVertices(), Grain,
    [&](int first, int last)
    {
      for (int vertex = first; vertex < last; ++vertex)
      {
        double sum = 0.0;
        mesh.VisitFan(vertex, [&](int h) { sum += areas[TriangleMesh::FaceOf(h)]; });
        mass[vertex] = sum / 3.0;
      }
    });
  return mass;
}

}
