#include "Operators/FieldTopology.h"

#include "Operators/PowerFieldDirections.h"
#include "Operators/PowerFieldOperators.h"

#include <cmath>

namespace dmg
{

namespace
{

constexpr int Grain = 4096;

/// The rotation of the boundary against the field at one of its vertices.
double TurnAtBoundary(
  const TriangleMesh& mesh, const Unfilled<Corner>& corners, const Vector<double>& rotation, int vertex)
{
  double turn = Pi;
  mesh.VisitFan(vertex,
    [&](int h)
    {
      // The sum is that of SingularityIndices; the edges at both ends of the fan add nothing.
      const int edge = mesh.EdgeOf(h);
      turn -= corners[h].Angle + (mesh.HalfedgeOf(edge) == h ? 1.0 : -1.0) * rotation[edge];
    });
  return turn;
}

std::vector<BoundaryIndex> LoopsOf(
  const TriangleMesh& mesh, const Unfilled<Corner>& corners, const Vector<double>& rotation, int N)
{
  std::vector<BoundaryIndex> loops;
  std::vector<char> isDone(mesh.NumberOfVertices(), 0);
  for (int start = 0; start < mesh.NumberOfVertices(); ++start)
  {
    if (isDone[start] || !mesh.IsBoundaryVertex(start))
    {
      continue;
    }
    BoundaryIndex loop;
    double turn = 0.0;
    for (int vertex = start; !isDone[vertex]; vertex = mesh.Head(mesh.OutgoingHalfedge(vertex)))
    {
      isDone[vertex] = 1;
      loop.Vertices.push_back(vertex);
      turn += TurnAtBoundary(mesh, corners, rotation, vertex);
    }
    loop.Index = std::round(N * turn / (2.0 * Pi)) / N;
    loops.push_back(std::move(loop));
  }
  return loops;
}

/// The number k for which the first direction is root k of its power (PowerFieldDirections).
int LabelOf(Complex first, Complex power, int N)
{
  if (first == 0.0)
  {
    return 0;
  }
  const double turns = (N * std::arg(first) - std::arg(power)) / (2.0 * Pi);
  return (static_cast<int>(std::lround(turns)) % N + N) % N;
}

}

FieldTopology TopologyOfField(const TriangleMesh& mesh, const TangentFrames& faceFrames, const Vector<Complex>& first,
  int N, const ExecutionContext& context)
{
  const Unfilled<Complex> sides = SideDirections(mesh, faceFrames, context);
  const Unfilled<Corner> corners = Corners(mesh, sides, faceFrames, VertexFrames(mesh, context), context);
  Vector<Complex> powers(first.size());
  std::vector<signed char> labels(first.size());
  context.ParallelFor(0, mesh.NumberOfFaces(), Grain,
    [&](int begin, int end)
    {
      for (int face = begin; face < end; ++face)
      {
        const double length = std::abs(first[face]);
        powers[face] = length > 0.0 ? Power(first[face] / length, N) : Complex(0.0);
        labels[face] = static_cast<signed char>(LabelOf(first[face], powers[face], N));
      }
    });
  context.Checkpoint(0.4);
  PrincipalMatching matching = MatchDirections(mesh, sides, powers, N, context);
  context.Checkpoint(0.7);

  FieldTopology topology;
  topology.Indices = SingularityIndices(mesh, corners, matching.Rotation, N, context);
  topology.Loops = LoopsOf(mesh, corners, matching.Rotation, N);
  for (int edge = 0; edge < mesh.NumberOfEdges(); ++edge)
  {
    const int h = mesh.HalfedgeOf(edge);
    if (mesh.Twin(h) < 0)
    {
      continue;
    }
    const int here = TriangleMesh::FaceOf(h);
    const int there = TriangleMesh::FaceOf(mesh.Twin(h));
    const int jump = (labels[here] + matching.Offsets[h] - labels[there] + N) % N;
    if (jump != 0 && first[here] != 0.0 && first[there] != 0.0)
    {
      topology.Cuts.push_back(edge);
      topology.Jumps.push_back(jump);
    }
  }
  topology.Rotation = std::move(matching.Rotation);
  context.Checkpoint(1.0);
  return topology;
}

}
