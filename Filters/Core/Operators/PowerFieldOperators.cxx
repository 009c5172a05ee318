#include "Operators/PowerFieldOperators.h"

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

Complex Power(Complex z, int N)
{
  Complex power = z;
  for (int n = 1; n < N; ++n)
  {
    power *= z;
  }
  return power;
}

int Modulo(int k, int N)
{
  return ((k % N) + N) % N;
}

/// A power of about unit size with the same phase, so that products of tiny powers keep theirs; a
/// zero power counts as the direction X of its frame.
Complex Phase(Complex power)
{
  const double size = std::abs(power.real()) + std::abs(power.imag());
  return size > 0.0 ? power / size : Complex(1.0);
}

/// SideDirections of every face, per halfedge.
std::vector<Complex> AllSideDirections(const TriangleMesh& mesh, const TangentFrames& faceFrames)
{
  std::vector<Complex> sides(3 * mesh.NumberOfFaces());
  for (int face = 0; face < mesh.NumberOfFaces(); ++face)
  {
    const std::array<Complex, 3> directions = SideDirections(mesh, faceFrames, face);
    std::copy(directions.begin(), directions.end(), sides.begin() + 3 * face);
  }
  return sides;
}

/// PowerEdgeWeights of one edge, the same number for both of its halfedges; it has two faces.
double PowerEdgeWeight(double squaredLength, double areaOfBothFaces)
{
  return squaredLength > 0.0
    ? 3.0 * squaredLength / std::max(areaOfBothFaces, SmallestArea * squaredLength)
    : 0.0;
}

double SquaredLength(const TriangleMesh& mesh, int halfedge)
{
  return (mesh.Position(mesh.Head(halfedge)) - mesh.Position(mesh.Tail(halfedge))).squaredNorm();
}

/// What a Laplacian wants to know of a face, and where its neighbours stand.
struct PowerFaceShape
{
  std::array<Complex, 3> Sides;
  std::array<double, 3> SquaredLengths;
  double Area;
  std::array<int, 3> Twins; ///< 3 * place of the neighbour + its side; -1 where there is none
};

std::array<int, 3> TwinsOf(const TriangleMesh& mesh, const std::vector<int>& places, int face)
{
  std::array<int, 3> twins;
  for (int k = 0; k < 3; ++k)
  {
    const int twin = mesh.Twin(3 * face + k);
    twins[k] = twin >= 0 ? 3 * places[TriangleMesh::FaceOf(twin)] + twin % 3 : -1;
  }
  return twins;
}

PowerFaceShape ShapeOf(const TriangleMesh& mesh, const TangentFrames& faceFrames,
  const std::vector<int>& places, int face)
{
  PowerFaceShape shape{ SideDirections(mesh, faceFrames, face), {}, mesh.FaceArea(face),
    TwinsOf(mesh, places, face) };
  for (int k = 0; k < 3; ++k)
  {
    shape.SquaredLengths[k] = SquaredLength(mesh, 3 * face + k);
  }
  return shape;
}

/// The places of a face and its neighbours, ascending, each once.
struct FaceAndNeighbours
{
  FaceAndNeighbours(int place, const std::array<int, 3>& twins)
  {
    this->Insert(place);
    for (const int twin : twins)
    {
      if (twin >= 0 && this->Find(twin / 3) == this->Count)
      {
        this->Insert(twin / 3);
      }
    }
  }

  /// Count if it is none of them.
  int Find(int place) const
  {
    int k = 0;
    while (k < this->Count && this->Places[k] != place)
    {
      ++k;
    }
    return k;
  }

  std::array<int, 4> Places;
  int Count = 0;

private:
  void Insert(int place)
  {
    int k = this->Count++;
    for (; k > 0 && this->Places[k - 1] > place; --k)
    {
      this->Places[k] = this->Places[k - 1];
    }
    this->Places[k] = place;
  }
};

/// e^{i angle} of TransportAcrossEdge. Both sides run along the edge, in opposite directions.
Complex Transport(Complex side, Complex sideOfTwin)
{
  return -sideOfTwin * std::conj(side);
}
Complex Transport(const std::vector<Complex>& sides, int halfedge, int twin)
{
  return Transport(sides[halfedge], sides[twin]);
}

/// Angle of a triangle at the tail of a halfedge; those of a triangle sum to pi.
double CornerAngle(const std::vector<Complex>& sides, int halfedge)
{
  const double angle =
    std::arg(-sides[TriangleMesh::Previous(halfedge)] * std::conj(sides[halfedge]));
  // A corner between 0 and pi; rounding may show a straight one as -pi.
  return angle < -0.5 * Pi ? angle + 2.0 * Pi : angle;
}

/// By which the field turns across an edge beyond transport, times N, in (-pi, pi].
double TurningTimesN(
  const std::vector<Complex>& sides, const Vector<Complex>& powers, int halfedge, int twin, int N)
{
  const Complex carried =
    Power(Transport(sides, halfedge, twin), N) * Phase(powers[TriangleMesh::FaceOf(halfedge)]);
  return std::arg(Phase(powers[TriangleMesh::FaceOf(twin)]) * std::conj(carried));
}

/// The root (arg(power) + 2 pi label) / N that is nearest to a direction, as a label in [0, N).
int NearestRoot(double direction, Complex power, int N)
{
  const double turns = (N * direction - std::arg(power)) / (2.0 * Pi);
  return Modulo(static_cast<int>(std::lround(turns)), N);
}

/// Angle of direction 0 of an element in its frame.
double FirstDirection(Complex power, int label, int N)
{
  return (std::arg(power) + 2.0 * Pi * label) / N;
}

}

double TransportAcrossEdge(const TriangleMesh& mesh, const TangentFrames& faceFrames, int halfedge)
{
  const int twin = mesh.Twin(halfedge);
  const Complex here =
    SideDirections(mesh, faceFrames, TriangleMesh::FaceOf(halfedge))[halfedge % 3];
  const Complex there = SideDirections(mesh, faceFrames, TriangleMesh::FaceOf(twin))[twin % 3];
  return std::arg(-there * std::conj(here));
}

Vector<double> PowerEdgeWeights(const TriangleMesh& mesh)
{
  Vector<double> weights = Vector<double>::Zero(mesh.NumberOfEdges());
  const Vector<double> areas = mesh.FaceAreas();
  for (int edge = 0; edge < mesh.NumberOfEdges(); ++edge)
  {
    const int h = mesh.HalfedgeOf(edge);
    const int twin = mesh.Twin(h);
    if (twin >= 0)
    {
      weights[edge] = PowerEdgeWeight(SquaredLength(mesh, h),
        areas[TriangleMesh::FaceOf(h)] + areas[TriangleMesh::FaceOf(twin)]);
    }
  }
  return weights;
}

SparseMatrix<Complex> PowerLaplacian(const TriangleMesh& mesh, const TangentFrames& faceFrames,
  int N, const ExecutionContext& context)
{
  return PowerLaplacian(mesh, faceFrames, N, Identity(mesh.NumberOfFaces()), context);
}

SparseMatrix<Complex> PowerLaplacian(const TriangleMesh& mesh, const TangentFrames& faceFrames,
  int N, const std::vector<int>& order, const ExecutionContext& context)
{
  const std::vector<int> places = Inverse(order, context);
  const int faces = mesh.NumberOfFaces();
  SparseMatrix<Complex> L(faces, faces);
  MakeRoom(L, context, [&](int place) {
    return FaceAndNeighbours(place, TwinsOf(mesh, places, order[place])).Count;
  });
  const auto fillRow = [&L, N](int place, const PowerFaceShape& here, const auto& shapeAt) {
    const FaceAndNeighbours around(place, here.Twins);
    Complex* const entries = L.valuePtr() + L.outerIndexPtr()[place];
    std::copy_n(around.Places.begin(), around.Count, L.innerIndexPtr() + L.outerIndexPtr()[place]);
    std::fill_n(entries, around.Count, Complex(0.0));
    for (int k = 0; k < 3; ++k)
    {
      const int twin = here.Twins[k];
      if (twin < 0)
      {
        continue;
      }
      const PowerFaceShape& there = shapeAt(twin / 3);
      const double weight = PowerEdgeWeight(here.SquaredLengths[k], here.Area + there.Area);
      // Two faces may meet along two edges, whose entries add up.
      entries[around.Find(place)] += weight;
      entries[around.Find(twin / 3)] -=
        weight * Power(Transport(there.Sides[twin % 3], here.Sides[k]), N);
    }
  };
  // Neighbours stand near each other. So most shapes are found once, and none is held for long.
  constexpr int bandSize = 2048;
  context.ParallelFor(0, (faces + bandSize - 1) / bandSize, 1, [&](int firstBand, int lastBand) {
    const auto shapeOf = [&](int place) { return ShapeOf(mesh, faceFrames, places, order[place]); };
    std::vector<PowerFaceShape> shapes;
    for (int band = firstBand; band < lastBand; ++band)
    {
      const int first = band * bandSize;
      const int last = std::min(first + bandSize, faces);
      shapes.clear();
      for (int place = first; place < last; ++place)
      {
        shapes.push_back(shapeOf(place));
      }
      PowerFaceShape elsewhere;
      const auto shapeAt = [&](int place) -> const PowerFaceShape& {
        return first <= place && place < last ? shapes[place - first] : elsewhere = shapeOf(place);
      };
      for (int place = first; place < last; ++place)
      {
        fillRow(place, shapes[place - first], shapeAt);
      }
    }
  });
  return L;
}

std::vector<Points> DirectionsFromPowers(const TangentFrames& frames, const Vector<Complex>& powers,
  int N, bool unitLength, const std::vector<int>& labels)
{
  const int size = static_cast<int>(powers.size());
  const Complex step = std::polar(1.0, 2.0 * Pi / N);
  std::vector<Points> directions(N, Points(size, 3));
  for (int i = 0; i < size; ++i)
  {
    const double magnitude = std::abs(powers[i]);
    const double length = unitLength && magnitude > 0.0 ? 1.0 : magnitude;
    Complex root = std::polar(length, FirstDirection(powers[i], labels.empty() ? 0 : labels[i], N));
    for (int k = 0; k < N; ++k)
    {
      directions[k].row(i) = frames.ToVector(i, root).transpose();
      root *= step;
    }
  }
  return directions;
}

std::vector<int> CombingLabels(
  const TriangleMesh& mesh, const TangentFrames& faceFrames, const Vector<Complex>& powers, int N)
{
  // A minimum spanning tree by Prim's algorithm. The queue sorts edges only by classes of turning:
  // linear time, and the tree is minimal up to the width of a class, pi / (256 N).
  constexpr int numberOfClasses = 256;
  std::array<std::vector<int>, numberOfClasses> queue;
  int leastClass = numberOfClasses;

  const std::vector<Complex> sides = AllSideDirections(mesh, faceFrames);
  std::vector<int> labels(mesh.NumberOfFaces(), -1);

  const auto visit = [&](int face, int label) {
    labels[face] = label;
    for (int h = 3 * face; h < 3 * face + 3; ++h)
    {
      const int twin = mesh.Twin(h);
      if (twin < 0 || labels[TriangleMesh::FaceOf(twin)] >= 0)
      {
        continue;
      }
      // Across a zero power nothing is continued: come there last.
      int turning = numberOfClasses - 1;
      if (powers[face] != 0.0 && powers[TriangleMesh::FaceOf(twin)] != 0.0)
      {
        const double fraction = std::abs(TurningTimesN(sides, powers, h, twin, N)) / Pi;
        turning = std::min(static_cast<int>(numberOfClasses * fraction), numberOfClasses - 1);
      }
      queue[turning].push_back(h);
      leastClass = std::min(leastClass, turning);
    }
  };

  for (int seed = 0; seed < mesh.NumberOfFaces(); ++seed)
  {
    if (labels[seed] >= 0)
    {
      continue;
    }
    visit(seed, 0);
    while (leastClass < numberOfClasses)
    {
      if (queue[leastClass].empty())
      {
        ++leastClass;
        continue;
      }
      const int h = queue[leastClass].back();
      queue[leastClass].pop_back();
      const int twin = mesh.Twin(h);
      const int from = TriangleMesh::FaceOf(h);
      const int to = TriangleMesh::FaceOf(twin);
      if (labels[to] < 0)
      {
        const double carried =
          FirstDirection(powers[from], labels[from], N) + std::arg(Transport(sides, h, twin));
        visit(to, NearestRoot(carried, powers[to], N));
      }
    }
  }
  return labels;
}

Vector<Complex> PowersAtVertices(const TriangleMesh& mesh, const TangentFrames& faceFrames,
  const TangentFrames& vertexFrames, const Vector<Complex>& powers, int N)
{
  Vector<Complex> sums = Vector<Complex>::Zero(mesh.NumberOfVertices());
  Vector<double> angleSums = Vector<double>::Zero(mesh.NumberOfVertices());
  const std::vector<Complex> sides = AllSideDirections(mesh, faceFrames);
  for (int h = 0; h < 3 * mesh.NumberOfFaces(); ++h)
  {
    const int face = TriangleMesh::FaceOf(h);
    const int vertex = mesh.Tail(h);
    const double angle = CornerAngle(sides, h);
    const Complex turn = Power(TransportTurn(faceFrames, face, vertexFrames, vertex), N);
    sums[vertex] += angle * turn * powers[face];
    angleSums[vertex] += angle;
  }
  for (int vertex = 0; vertex < mesh.NumberOfVertices(); ++vertex)
  {
    if (angleSums[vertex] > 0.0)
    {
      sums[vertex] /= angleSums[vertex];
    }
  }
  return sums;
}

std::vector<int> VertexLabels(const TriangleMesh& mesh, const TangentFrames& faceFrames,
  const TangentFrames& vertexFrames, const Vector<Complex>& facePowers,
  const std::vector<int>& faceLabels, const Vector<Complex>& vertexPowers, int N)
{
  Vector<Complex> sums = Vector<Complex>::Zero(mesh.NumberOfVertices());
  for (int h = 0; h < 3 * mesh.NumberOfFaces(); ++h)
  {
    const int face = TriangleMesh::FaceOf(h);
    const int vertex = mesh.Tail(h);
    sums[vertex] += TransportTurn(faceFrames, face, vertexFrames, vertex) *
      std::polar(std::abs(facePowers[face]), FirstDirection(facePowers[face], faceLabels[face], N));
  }
  std::vector<int> labels(mesh.NumberOfVertices());
  for (int vertex = 0; vertex < mesh.NumberOfVertices(); ++vertex)
  {
    labels[vertex] = NearestRoot(std::arg(sums[vertex]), vertexPowers[vertex], N);
  }
  return labels;
}

Vector<double> SingularityIndices(
  const TriangleMesh& mesh, const TangentFrames& faceFrames, const Vector<Complex>& powers, int N)
{
  const std::vector<Complex> sides = AllSideDirections(mesh, faceFrames);

  // Turning around the vertices, plus their angle defects; in units of N.
  Vector<double> turning = Vector<double>::Constant(mesh.NumberOfVertices(), 2.0 * Pi * N);
  for (int h = 0; h < 3 * mesh.NumberOfFaces(); ++h)
  {
    turning[mesh.Tail(h)] -= N * CornerAngle(sides, h);
  }
  for (int edge = 0; edge < mesh.NumberOfEdges(); ++edge)
  {
    const int h = mesh.HalfedgeOf(edge);
    const int twin = mesh.Twin(h);
    if (twin >= 0)
    {
      // Counter-clockwise around its head one crosses a halfedge from its own face to the other,
      // around its tail the other way. One value for both, so that the sum over vertices cancels.
      const double angle = TurningTimesN(sides, powers, h, twin, N);
      turning[mesh.Head(h)] += angle;
      turning[mesh.Tail(h)] -= angle;
    }
  }

  Vector<double> indices(mesh.NumberOfVertices());
  for (int vertex = 0; vertex < mesh.NumberOfVertices(); ++vertex)
  {
    indices[vertex] =
      mesh.IsBoundaryVertex(vertex) ? 0.0 : std::round(turning[vertex] / (2.0 * Pi)) / N;
  }
  return indices;
}

}
