#include "Directions/PowerFieldDirections.h"

#include "Operators/PowerFieldOperators.h"
#include "Support/SparseKernels.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace dmg
{

namespace
{

constexpr int Grain = 4096;

int Modulo(int k, int N)
{
  return ((k % N) + N) % N;
}

double Argument(Complex power)
{
  return power == 0.0 ? 0.0 : std::arg(power);
}

/// Angle of direction k of an element in its frame.
double AngleOfDirection(Complex power, int k, int N)
{
  return (Argument(power) + 2.0 * Pi * k) / N;
}

/// The number of times that a direction is 2 pi / N ahead of direction 0 of an element.
double StepsFromFirst(Complex direction, Complex power, int N)
{
  return (N * Argument(direction) - Argument(power)) / (2.0 * Pi);
}

/// Classes of rotation, by halfedge: the queue of a tree sorts edges only by them.
using RotationClass = unsigned char;
constexpr int NumberOfClasses = 256;

std::vector<RotationClass> ClassesOf(const TriangleMesh& mesh, const Vector<Complex>& powers,
  const Vector<double>& rotation, int N, const ExecutionContext& context)
{
  std::vector<RotationClass> classes(3 * mesh.NumberOfFaces());
  context.ParallelFor(0, mesh.NumberOfEdges(), Grain,
    [&](int first, int last)
    {
      for (int edge = first; edge < last; ++edge)
      {
        const int h = mesh.HalfedgeOf(edge);
        const int twin = mesh.Twin(h);
        if (twin < 0)
        {
          continue;
        }
        // Across a zero power nothing is continued: come there last.
        const bool isContinued = powers[TriangleMesh::FaceOf(h)] != 0.0 && powers[TriangleMesh::FaceOf(twin)] != 0.0;
        const double fraction = isContinued ? std::abs(N * rotation[edge]) / Pi : 1.0;
        classes[h] = classes[twin] =
          static_cast<RotationClass>(std::min(static_cast<int>(NumberOfClasses * fraction), NumberOfClasses - 1));
      }
    });
  return classes;
}

}

Vector<double> Arguments(const Vector<Complex>& powers, const ExecutionContext& context)
{
  Vector<double> arguments(powers.size());
  context.ParallelFor(0, static_cast<int>(powers.size()), Grain,
    [&](int first, int last)
    { std::transform(powers.data() + first, powers.data() + last, arguments.data() + first, Argument); });
  return arguments;
}

PrincipalMatching MatchDirections(const TriangleMesh& mesh, const Unfilled<Complex>& sides,
  const Vector<Complex>& powers, int N, const ExecutionContext& context)
{
  const Vector<double> arguments = Arguments(powers, context);
  PrincipalMatching matching{ Vector<double>(mesh.NumberOfEdges()),
    std::vector<signed char>(3 * mesh.NumberOfFaces()) };
  context.ParallelFor(0, mesh.NumberOfEdges(), Grain,
    [&](int first, int last)
    {
      for (int edge = first; edge < last; ++edge)
      {
        const int h = mesh.HalfedgeOf(edge);
        const int twin = mesh.Twin(h);
        if (twin < 0)
        {
          matching.Rotation[edge] = 0.0;
          continue;
        }
        // arguments[here] + N transport + N rotation = arguments[there] + 2 pi offset
        const double difference = arguments[TriangleMesh::FaceOf(twin)] - arguments[TriangleMesh::FaceOf(h)] -
          N * std::arg(TransportOfSides(sides[h], sides[twin]));
        const double turns = std::round(difference / (2.0 * Pi));
        matching.Rotation[edge] = (difference - 2.0 * Pi * turns) / N;
        const int offset = Modulo(-static_cast<int>(turns), N);
        matching.Offsets[h] = static_cast<signed char>(offset);
        matching.Offsets[twin] = static_cast<signed char>(Modulo(-offset, N));
      }
    });
  return matching;
}

std::vector<int> CombingLabels(const TriangleMesh& mesh, const Vector<Complex>& powers,
  const PrincipalMatching& matching, int N, const ExecutionContext& context)
{
  // A minimum spanning tree by Prim's algorithm. The queue sorts edges only by classes of rotation:
  // linear time, and the tree is minimal up to the width of a class, pi / (256 N).
  const std::vector<RotationClass> classes = ClassesOf(mesh, powers, matching.Rotation, N, context);
  std::array<std::vector<int>, NumberOfClasses> queue;
  int leastClass = NumberOfClasses;
  std::vector<signed char> labels(mesh.NumberOfFaces(), -1); // small: they are read all over the place

  const auto visit = [&](int face, int label)
  {
    labels[face] = static_cast<signed char>(label);
    for (int h = 3 * face; h < 3 * face + 3; ++h)
    {
      const int twin = mesh.Twin(h);
      if (twin >= 0 && labels[TriangleMesh::FaceOf(twin)] < 0)
      {
        queue[classes[h]].push_back(h);
        leastClass = std::min<int>(leastClass, classes[h]);
      }
    }
  };

  for (int seed = 0; seed < mesh.NumberOfFaces(); ++seed)
  {
    if (labels[seed] >= 0)
    {
      continue;
    }
    visit(seed, 0);
    while (leastClass < NumberOfClasses)
    {
      if (queue[leastClass].empty())
      {
        ++leastClass;
        continue;
      }
      const int h = queue[leastClass].back();
      queue[leastClass].pop_back();
      const int to = TriangleMesh::FaceOf(mesh.Twin(h));
      if (labels[to] < 0)
      {
        visit(to, Modulo(labels[TriangleMesh::FaceOf(h)] + matching.Offsets[h], N));
      }
    }
  }
  return std::vector<int>(labels.begin(), labels.end());
}

std::vector<int> LabelsNearTo(
  const Vector<Complex>& former, const Vector<Complex>& powers, int N, const ExecutionContext& context)
{
  constexpr double LargeTurn = 0.25; // in steps of 2 pi / N
  std::vector<int> labels(powers.size());
  const int turned = SumOverBlocks<int>(static_cast<int>(powers.size()), context,
    [&](int first, int last)
    {
      int count = 0;
      for (int i = first; i < last; ++i)
      {
        const double steps = StepsFromFirst(former[i], powers[i], N);
        labels[i] = former[i] == 0.0 ? 0 : Modulo(static_cast<int>(std::lround(steps)), N);
        count += std::abs(steps - std::round(steps)) > LargeTurn;
      }
      return count;
    });
  return 2 * turned > static_cast<int>(powers.size()) ? std::vector<int>() : labels;
}

Vector<Complex> FirstDirections(
  const Vector<Complex>& powers, int N, const std::vector<int>& labels, const ExecutionContext& context)
{
  Vector<Complex> directions(powers.size());
  context.ParallelFor(0, static_cast<int>(powers.size()), Grain,
    [&](int first, int last)
    {
      for (int i = first; i < last; ++i)
      {
        const int label = labels.empty() ? 0 : labels[i];
        directions[i] = std::polar(std::abs(powers[i]), AngleOfDirection(powers[i], label, N));
      }
    });
  return directions;
}

Vector<Complex> PowersAtVertices(const TriangleMesh& mesh, const Unfilled<Corner>& corners,
  const Vector<Complex>& powers, int N, const ExecutionContext& context)
{
  Vector<Complex> atVertices(mesh.NumberOfVertices());
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
            const auto& [turn, angle] = corners[h];
            sum += angle * Power(turn, N) * powers[TriangleMesh::FaceOf(h)];
            sumOfAngles += angle;
          });
        atVertices[vertex] = sumOfAngles > 0.0 ? sum / sumOfAngles : sum;
      }
    });
  return atVertices;
}

Vector<Complex> FirstDirectionsAtVertices(const TriangleMesh& mesh, const std::function<Complex(int)>& turnFromFace,
  const Vector<Complex>& ofFaces, const Vector<Complex>& vertexPowers, int N, const ExecutionContext& context)
{
  Vector<Complex> directions(mesh.NumberOfVertices());
  context.ParallelFor(0, mesh.NumberOfVertices(), Grain,
    [&](int first, int last)
    {
      for (int vertex = first; vertex < last; ++vertex)
      {
        Complex sum = 0.0;
        mesh.VisitFan(vertex, [&](int h) { sum += turnFromFace(h) * ofFaces[TriangleMesh::FaceOf(h)]; });
        const Complex power = vertexPowers[vertex];
        const auto step = static_cast<int>(std::lround(StepsFromFirst(sum, power, N)));
        directions[vertex] = std::polar(std::abs(power), AngleOfDirection(power, step, N));
      }
    });
  return directions;
}

Vector<double> SingularityIndices(const TriangleMesh& mesh, const Unfilled<Corner>& corners,
  const Vector<double>& rotation, int N, const ExecutionContext& context)
{
  Vector<double> indices(mesh.NumberOfVertices());
  context.ParallelFor(0, mesh.NumberOfVertices(), Grain,
    [&](int first, int last)
    {
      for (int vertex = first; vertex < last; ++vertex)
      {
        double turn = 2.0 * Pi;
        mesh.VisitFan(vertex,
          [&](int h)
          {
            // Counter-clockwise one crosses this halfedge from its twin's face to its own.
            const int edge = mesh.EdgeOf(h);
            turn -= corners[h].Angle + (mesh.HalfedgeOf(edge) == h ? 1.0 : -1.0) * rotation[edge];
          });
        indices[vertex] = mesh.IsBoundaryVertex(vertex) ? 0.0 : std::round(N * turn / (2.0 * Pi)) / N + 0.0; // no -0
      }
    });
  return indices;
}

}
