#include "Levels/TangentGraph.h"

#include "Mesh/TangentFrames.h"
#include "Support/Permutations.h"
#include "Support/SparseKernels.h"

#include <array>
#include <cmath>

namespace dmg
{

namespace
{

constexpr int Grain = 4096;

/// A face in its frame, seen from its point, and where its neighbours stand.
struct FlatFace
{
  std::array<Complex, 3> Sides; // unit
  std::array<Complex, 3> Midpoints;
  std::array<int, 3> Twins; // 3 * place of the neighbour + its side; -1 where there is no link
};

/// A face whose twins are not known yet.
FlatFace Flatten(const TriangleMesh& mesh, int face)
{
  FlatFace flat{ SideDirections(mesh, face), {}, {} };
  Complex corner = 0.0;
  Complex sum = 0.0;
  double weights = 0.0;
  for (int k = 0; k < 3; ++k)
  {
    const int h = 3 * face + k;
    const double length = (mesh.Position(mesh.Head(h)) - mesh.Position(mesh.Tail(h))).norm();
    flat.Midpoints[k] = corner + 0.5 * length * flat.Sides[k];
    corner += length * flat.Sides[k];
    sum += length * length * flat.Midpoints[k];
    weights += length * length;
  }
  for (Complex& midpoint : flat.Midpoints)
  {
    midpoint -= sum / weights;
  }
  return flat;
}

/// -1 unless both halfedges exist and belong to different faces.
int PlaceOfTwin(const TriangleMesh& mesh, const std::vector<int>& places, int halfedge)
{
  const int twin = mesh.Twin(halfedge);
  const bool isLink = twin >= 0 && TriangleMesh::FaceOf(twin) != TriangleMesh::FaceOf(halfedge);
  return isLink ? 3 * places[TriangleMesh::FaceOf(twin)] + twin % 3 : -1;
}

using Angles = std::array<double, 3>;

/// The angles of a face at the tails of its halfedges; those of a flat one are 0 and pi.
Angles AnglesOf(const FlatFace& face)
{
  const auto angleAfter = [&face](int side)
  { return std::abs(std::arg(-face.Sides[side] * std::conj(face.Sides[(side + 1) % 3]))); };
  const double second = angleAfter(0);
  const double third = angleAfter(1);
  return { Pi - second - third, second, third };
}

/// Per vertex, what the angles around it lack of a full turn, over the number of its faces; 0 at the
/// boundary.
Unfilled<double> CurvaturesOfCorners(
  const TriangleMesh& mesh, const Unfilled<Angles>& angles, const ExecutionContext& context)
{
  Unfilled<double> curvatures(mesh.NumberOfVertices());
  context.ParallelFor(0, mesh.NumberOfVertices(), Grain,
    [&](int first, int last)
    {
      for (int vertex = first; vertex < last; ++vertex)
      {
        curvatures[vertex] = 0.0;
        if (mesh.IsBoundaryVertex(vertex))
        {
          continue;
        }
        double lacking = 2.0 * Pi;
        int faces = 0;
        mesh.VisitFan(vertex,
          [&](int h)
          {
            lacking -= angles[TriangleMesh::FaceOf(h)][h % 3];
            ++faces;
          });
        curvatures[vertex] = lacking / faces;
      }
    });
  return curvatures;
}

}

TangentGraph FaceGraph(const TriangleMesh& mesh, const std::vector<int>& order, const ExecutionContext& context)
{
  const int faces = mesh.NumberOfFaces();
  const std::vector<int> places = Inverse(order, context);
  Unfilled<FlatFace> flat(faces);
  Unfilled<Angles> angles(faces); // in the order of the mesh
  TangentGraph graph;
  graph.Offsets.resize(faces + 1);
  context.ParallelFor(0, faces, Grain,
    [&](int first, int last)
    {
      for (int i = first; i < last; ++i)
      {
        const int face = order[i];
        flat[i] = Flatten(mesh, face);
        angles[face] = AnglesOf(flat[i]);
        graph.Offsets[i + 1] = 0;
        for (int k = 0; k < 3; ++k)
        {
          flat[i].Twins[k] = PlaceOfTwin(mesh, places, 3 * face + k);
          graph.Offsets[i + 1] += flat[i].Twins[k] >= 0;
        }
      }
    });
  const int links = OffsetsFromCounts(graph.Offsets);
  graph.Neighbours.resize(links);
  graph.Steps.resize(links);
  graph.Turns.resize(links);
  const Unfilled<double> ofCorners = CurvaturesOfCorners(mesh, angles, context);
  graph.Curvatures.resize(faces);
  context.ParallelFor(0, faces, Grain,
    [&](int first, int last)
    {
      for (int i = first; i < last; ++i)
      {
        int link = graph.Offsets[i];
        graph.Curvatures[i] = 0.0;
        for (int k = 0; k < 3; ++k)
        {
          graph.Curvatures[i] += ofCorners[mesh.Tail(3 * order[i] + k)];
          const int twin = flat[i].Twins[k];
          if (twin >= 0)
          {
            const FlatFace& there = flat[twin / 3];
            // Both sides run along the edge, in opposite directions.
            const Complex turn = -flat[i].Sides[k] * std::conj(there.Sides[twin % 3]);
            graph.Neighbours[link] = twin / 3;
            graph.Turns[link] = turn;
            graph.Steps[link] = flat[i].Midpoints[k] - turn * there.Midpoints[twin % 3];
            ++link;
          }
        }
      }
    });
  return graph;
}

TangentGraph VertexGraph(const TriangleMesh& mesh, const VertexConnection& connection, const std::vector<int>& order,
  const ExecutionContext& context)
{
  const int vertices = mesh.NumberOfVertices();
  const std::vector<int> places = Inverse(order, context);
  TangentGraph graph;
  graph.Offsets.resize(vertices + 1);
  graph.Curvatures.resize(vertices);
  context.ParallelFor(0, vertices, Grain,
    [&](int first, int last)
    {
      for (int i = first; i < last; ++i)
      {
        int links = mesh.IsBoundaryVertex(order[i]) ? 1 : 0;
        graph.Curvatures[i] = 0.0;
        mesh.VisitFan(order[i],
          [&](int h)
          {
            ++links;
            graph.Curvatures[i] += connection.Curvature(TriangleMesh::FaceOf(h)) / 3.0;
          });
        graph.Offsets[i + 1] = links;
      }
    });
  const int links = OffsetsFromCounts(graph.Offsets);
  graph.Neighbours.resize(links);
  graph.Steps.resize(links);
  graph.Turns.resize(links);
  const auto lengthOf = [&mesh](int h) { return (mesh.Position(mesh.Head(h)) - mesh.Position(mesh.Tail(h))).norm(); };
  context.ParallelFor(0, vertices, Grain,
    [&](int first, int last)
    {
      for (int i = first; i < last; ++i)
      {
        int link = graph.Offsets[i];
        const auto add = [&](int neighbour, double length, double polar, double turn)
        {
          graph.Neighbours[link] = places[neighbour];
          graph.Steps[link] = std::polar(length, polar);
          graph.Turns[link] = std::polar(1.0, turn);
          ++link;
        };
        mesh.VisitFan(order[i],
          [&](int h)
          {
            add(mesh.Head(h), lengthOf(h), connection.PolarAngle(h), -connection.Transport(h));
            const int back = TriangleMesh::Previous(h);
            if (mesh.Twin(back) < 0)
            {
              add(mesh.Tail(back), lengthOf(back), connection.PolarAngle(h) + connection.CornerAngle(h),
                connection.Transport(back));
            }
          });
      }
    });
  return graph;
}

}
