#include "Directions/FieldTopology.h"

#include "Directions/PowerFieldDirections.h"
#include "Operators/PowerFieldOperators.h"

#include <cmath>

namespace dmg
{
namespace
{

constexpr int Grain = 4096;

/// Two neighbours beside or at the ends of an edge.
struct Neighbours
{
  int Here, There;
  double Transport; ///< the angle that carries directions from here to there
};

/// N-th powers of length 1; 0 where there is no direction.
Vector<Complex> UnitPowers(const Vector<Complex>& first, int N, const ExecutionContext& context)
{
  Vector<Complex> powers(first.size());
  context.ParallelFor(0, static_cast<int>(first.size()), Grain,
    [&](int begin, int end)
    {
      for (int i = begin; i < end; ++i)
      {
        const double length = std::abs(first[i]);
        powers[i] = length > 0.0 ? Power(first[i] / length, N) : Complex(0.0);
      }
    });
  return powers;
}

double MultipleOfIndex(double turn, int N)
{
  return std::round(N * turn / (2.0 * Pi)) / N;
}

/// The rotation along a halfedge from that along its edge.
double AlongHalfedge(const TriangleMesh& mesh, const Vector<double>& rotation, int halfedge)
{
  const int edge = mesh.EdgeOf(halfedge);
  return mesh.HalfedgeOf(edge) == halfedge ? rotation[edge] : -rotation[edge];
}

/// \param turnAt the rotation of the boundary against the field at a vertex, or from it to the next one.
template <class TurnAt>
std::vector<BoundaryIndex> LoopsOf(const TriangleMesh& mesh, int N, const TurnAt& turnAt)
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
      turn += turnAt(vertex);
    }
    loop.Index = MultipleOfIndex(turn, N);
    loops.push_back(std::move(loop));
  }
  return loops;
}

/// Finds Cuts and Jumps from the Rotation.
/// \param neighboursOf(halfedge) of the HalfedgeOf an edge; There is negative where there is one alone.
template <class NeighboursOf>
void FindCuts(const TriangleMesh& mesh, const Vector<Complex>& first, int N, const NeighboursOf& neighboursOf,
  FieldTopology& topology)
{
  for (int edge = 0; edge < mesh.NumberOfEdges(); ++edge)
  {
    const auto [here, there, transport] = neighboursOf(mesh.HalfedgeOf(edge));
    if (there < 0 || first[here] == 0.0 || first[there] == 0.0)
    {
      continue;
    }
    // Direction 0 goes on to direction `jump` of the other element.
    const double onwards = std::arg(first[here]) + transport + topology.Rotation[edge] - std::arg(first[there]);
    const int jump = (static_cast<int>(std::lround(N * onwards / (2.0 * Pi))) % N + N) % N;
    if (jump != 0)
    {
      topology.Cuts.push_back(edge);
      topology.Jumps.push_back(jump);
    }
  }
}

}

FieldTopology TopologyOfField(const TriangleMesh& mesh, const TangentFrames& faceFrames, const Vector<Complex>& first,
  int N, const ExecutionContext& context)
{
  const Unfilled<Complex> sides = SideDirections(mesh, faceFrames, context);
  const Unfilled<Corner> corners = Corners(mesh, sides, faceFrames, VertexFrames(mesh, context), context);
  context.Checkpoint(0.4);
  FieldTopology topology;
  topology.Rotation = MatchDirections(mesh, sides, UnitPowers(first, N, context), N, context).Rotation;
  context.Checkpoint(0.7);
  topology.Indices = SingularityIndices(mesh, corners, topology.Rotation, N, context);
  topology.Loops = LoopsOf(mesh, N,
    [&](int vertex)
    {
      // The sum is that of SingularityIndices; the edges at both ends of the fan add nothing.
      double turn = Pi;
      mesh.VisitFan(vertex, [&](int h) { turn -= corners[h].Angle + AlongHalfedge(mesh, topology.Rotation, h); });
      return turn;
    });
  FindCuts(
    mesh, first, N,
    [&](int h)
    {
      const int twin = mesh.Twin(h);
      return twin < 0 ? Neighbours{ TriangleMesh::FaceOf(h), -1, 0.0 }
                      : Neighbours{ TriangleMesh::FaceOf(h), TriangleMesh::FaceOf(twin),
                          std::arg(TransportOfSides(sides[h], sides[twin])) };
    },
    topology);
  context.Checkpoint(1.0);
  return topology;
}

FieldTopology TopologyOfVertexField(const TriangleMesh& mesh, const VertexConnection& connection,
  const Vector<Complex>& first, int N, const ExecutionContext& context)
{
  FieldTopology topology;
  topology.Rotation = RotationAlongEdges(mesh, connection, UnitPowers(first, N, context), N, context);
  context.Checkpoint(0.7);
  topology.Indices = IndicesOfFaces(mesh, connection, topology.Rotation, N, context);
  topology.Loops = LoopsOf(mesh, N,
    [&](int vertex)
    {
      double turn = Pi - AlongHalfedge(mesh, topology.Rotation, mesh.OutgoingHalfedge(vertex));
      mesh.VisitFan(vertex, [&](int h) { turn -= connection.CornerAngle(h); });
      return turn;
    });
  FindCuts(
    mesh, first, N,
    [&](int h) {
      return Neighbours{ mesh.Tail(h), mesh.Head(h), connection.Transport(h) };
    },
    topology);
  context.Checkpoint(1.0);
  return topology;
}

Vector<double> RotationAlongEdges(const TriangleMesh& mesh, const VertexConnection& connection,
  const Vector<Complex>& powers, int N, const ExecutionContext& context)
{
  Vector<double> rotation(mesh.NumberOfEdges());
  const Vector<double> arguments = Arguments(powers, context);
  context.ParallelFor(0, mesh.NumberOfEdges(), Grain,
    [&](int first, int last)
    {
      for (int edge = first; edge < last; ++edge)
      {
        const int h = mesh.HalfedgeOf(edge);
        const double difference = arguments[mesh.Head(h)] - arguments[mesh.Tail(h)] - N * connection.Transport(h);
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
        indices[face] = MultipleOfIndex(turn, N);
      }
    });
  return indices;
}

}
