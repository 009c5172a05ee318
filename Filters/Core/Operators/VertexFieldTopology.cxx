#include "Operators/VertexFieldTopology.h"

#include "Operators/PowerFieldOperators.h"

#include <cmath>

namespace dmg
{

namespace
{

constexpr int Grain = 4096;

/// The rotation along a halfedge from that along its edge.
double AlongHalfedge(const TriangleMesh& mesh, const Vector<double>& rotation, int halfedge)
{
  const int edge = mesh.EdgeOf(halfedge);
  return mesh.HalfedgeOf(edge) == halfedge ? rotation[edge] : -rotation[edge];
}

/// The rotation of the boundary against the field from a vertex of it to the next one.
double TurnFromVertex(
  const TriangleMesh& mesh, const VertexConnection& connection, const Vector<double>& rotation, int vertex)
{
  double turn = Pi - AlongHalfedge(mesh, rotation, mesh.OutgoingHalfedge(vertex));
  mesh.VisitFan(vertex, [&](int h) { turn -= connection.CornerAngle(h); });
  return turn;
}

std::vector<BoundaryIndex> LoopsOf(
  const TriangleMesh& mesh, const VertexConnection& connection, const Vector<double>& rotation, int N)
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
      turn += TurnFromVertex(mesh, connection, rotation, vertex);
    }
    loop.Index = std::round(N * turn / (2.0 * Pi)) / N;
    loops.push_back(std::move(loop));
  }
  return loops;
}

}

Vector<double> RotationAlongEdges(const TriangleMesh& mesh, const VertexConnection& connection,
  const Vector<Complex>& powers, int N, const ExecutionContext& context)
{
  Vector<double> rotation(mesh.NumberOfEdges());
  const auto argument = [&powers](int vertex) { return powers[vertex] == 0.0 ? 0.0 : std::arg(powers[vertex]); };
  context.ParallelFor(0, mesh.NumberOfEdges(), Grain,
    [&](int first, int last)
    {
      for (int edge = first; edge < last; ++edge)
      {
        const int h = mesh.HalfedgeOf(edge);
        const double difference = argument(mesh.Head(h)) - argument(mesh.Tail(h)) - N * connection.Transport(h);
        rotation[edge] = std::remainder(difference, 2.0 * Pi) / N;
      }
    });
  return rotation;
}

Vector<double> IndicesOfFaces(const TriangleMesh& mesh, const VertexConnection& connection,
  const Vector<double>& rotation, int N, const ExecutionContext& context)
{
  Vector<double> indices(mesh.NumberOfFaces());
  context.ParallelFor(0, mesh.NumberOfFaces(), Grain,
    [&](int first, int last)
    {
      for (int face = first; face < last; ++face)
      {
        double turn = connection.Curvature(face);
        for (int h = 3 * face; h < 3 * face + 3; ++h)
        {
          turn += AlongHalfedge(mesh, rotation, h);
        }
        indices[face] = std::round(N * turn / (2.0 * Pi)) / N;
      }
    });
  return indices;
}

FieldTopology TopologyOfVertexField(const TriangleMesh& mesh, const VertexConnection& connection,
  const Vector<Complex>& first, int N, const ExecutionContext& context)
{
  Vector<Complex> powers(first.size());
  context.ParallelFor(0, mesh.NumberOfVertices(), Grain,
    [&](int begin, int end)
    {
      for (int vertex = begin; vertex < end; ++vertex)
      {
        const double length = std::abs(first[vertex]);
        powers[vertex] = length > 0.0 ? Power(first[vertex] / length, N) : Complex(0.0);
      }
    });
  context.Checkpoint(0.4);
  FieldTopology topology;
  topology.Rotation = RotationAlongEdges(mesh, connection, powers, N, context);
  context.Checkpoint(0.7);
  topology.Indices = IndicesOfFaces(mesh, connection, topology.Rotation, N, context);
  topology.Loops = LoopsOf(mesh, connection, topology.Rotation, N);
  for (int edge = 0; edge < mesh.NumberOfEdges(); ++edge)
  {
    const int h = mesh.HalfedgeOf(edge);
    const Complex here = first[mesh.Tail(h)];
    const Complex there = first[mesh.Head(h)];
    if (here == 0.0 || there == 0.0)
    {
      continue;
    }
    // Direction 0 goes on to the angle of the other one, plus so many steps.
    const double onwards = std::arg(here) + connection.Transport(h) + topology.Rotation[edge] - std::arg(there);
    const int jump = (static_cast<int>(std::lround(N * onwards / (2.0 * Pi))) % N + N) % N;
    if (jump != 0)
    {
      topology.Cuts.push_back(edge);
      topology.Jumps.push_back(jump);
    }
  }
  context.Checkpoint(1.0);
  return topology;
}

}
