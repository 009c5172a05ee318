#include "Hierarchy/TangentGraph.h"

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

/// A face in its frame, seen from its point.
struct FlatFace
{
  std::array<Complex, 3> Sides; // unit
  std::array<Complex, 3> Midpoints;
};

FlatFace Flatten(const TriangleMesh& mesh, int face)
{
  FlatFace flat{ SideDirections(mesh, face), {} };
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

/// Whether both halfedges exist and belong to different faces.
bool IsLink(const TriangleMesh& mesh, int halfedge)
{
  const int twin = mesh.Twin(halfedge);
  return twin >= 0 && TriangleMesh::FaceOf(twin) != TriangleMesh::FaceOf(halfedge);
}

/// The angles of a face at the tails of its halfedges; those of a flat one are 0 and pi.
std::array<double, 3> Angles(const FlatFace& face)
{
  std::array<double, 3> angles;
  for (int k = 0; k < 3; ++k)
  {
    const Complex turn = -face.Sides[(k + 2) % 3] * std::conj(face.Sides[k]);
    angles[k] = std::abs(std::arg(turn));
  }
  return angles;
}

/// Per vertex, what the angles around it lack of a full turn, over the number of its faces; 0 at the
/// boundary.
/// \param flat in the given order of the faces.
std::vector<double> CurvaturesOfCorners(const TriangleMesh& mesh, const std::vector<int>& order,
  const std::vector<FlatFace>& flat, const ExecutionContext& context)
{
  constexpr double fullTurn = 2.0 * 3.14159265358979323846;
  std::vector<std::array<double, 3>> angles(flat.size());
  context.ParallelFor(0, static_cast<int>(flat.size()), Grain,
    [&](int first, int last)
    {
      for (int i = first; i < last; ++i)
      {
        angles[i] = Angles(flat[i]);
      }
    });
  std::vector<double> curvatures(mesh.NumberOfVertices(), fullTurn);
  std::vector<int> faces(mesh.NumberOfVertices(), 0);
  for (std::size_t i = 0; i < order.size(); ++i)
  {
    for (int k = 0; k < 3; ++k)
    {
      const int vertex = mesh.Tail(3 * order[i] + k);
      curvatures[vertex] -= angles[i][k];
      ++faces[vertex];
    }
  }
  for (int vertex = 0; vertex < mesh.NumberOfVertices(); ++vertex)
  {
    curvatures[vertex] = mesh.IsBoundaryVertex(vertex) ? 0.0 : curvatures[vertex] / faces[vertex];
  }
  return curvatures;
}

}

TangentGraph FaceGraph(
  const TriangleMesh& mesh, const std::vector<int>& order, const ExecutionContext& context)
{
  const int faces = mesh.NumberOfFaces();
  const std::vector<int> places = Inverse(order);
  std::vector<FlatFace> flat(faces);
  TangentGraph graph;
  graph.Offsets.assign(faces + 1, 0);
  context.ParallelFor(0, faces, Grain,
    [&](int first, int last)
    {
      for (int i = first; i < last; ++i)
      {
        const int face = order[i];
        flat[i] = Flatten(mesh, face);
        for (int h = 3 * face; h < 3 * face + 3; ++h)
        {
          graph.Offsets[i + 1] += IsLink(mesh, h);
        }
      }
    });
  const int links = OffsetsFromCounts(graph.Offsets);
  graph.Neighbours.resize(links);
  graph.Steps.resize(links);
  graph.Turns.resize(links);
  const std::vector<double> ofCorners = CurvaturesOfCorners(mesh, order, flat, context);
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
          const int h = 3 * order[i] + k;
          graph.Curvatures[i] += ofCorners[mesh.Tail(h)];
          if (IsLink(mesh, h))
          {
            const int twin = mesh.Twin(h);
            const int j = places[TriangleMesh::FaceOf(twin)];
            const FlatFace& there = flat[j];
            // Both sides run along the edge, in opposite directions.
            const Complex turn = -flat[i].Sides[k] * std::conj(there.Sides[twin % 3]);
            graph.Neighbours[link] = j;
            graph.Turns[link] = turn;
            graph.Steps[link] = flat[i].Midpoints[k] - turn * there.Midpoints[twin % 3];
            ++link;
          }
        }
      }
    });
  return graph;
}

}
