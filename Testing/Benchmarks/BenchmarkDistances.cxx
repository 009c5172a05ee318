// Distances along surfaces from one vertex: SurfaceDistance beside CGAL's heat method on intrinsic Delaunay triangles and Dijkstra's along the edges
// (vtkDijkstraGraphGeodesicPath, PyVista's geodesic), against CGAL's exact distances along the polyhedron.
//
//   BenchmarkDistances [--sources n] [--without-exact] SURFACE.ply...
//
// prints a row of a table for each surface and method: mean and largest relative error over the vertices and sources, processor seconds of a source
// from the bare mesh, and the growth of the resident set in MB. Sources are spread over the numbers of vertices. Exact distances take minutes and
// gigabytes on large surfaces; without them, errors are against SurfaceDistance.

#include "CommandLine.h"
#include "PeakMemory.h"

#include "Geodesics/SurfaceDistance.h"
#include "Preparation/PreparedSurface.h"
#include "Support/ReadPly.h"

#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Heat_method_3/Surface_mesh_geodesic_distances_3.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh_shortest_path.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <functional>
#include <limits>
#include <queue>
#include <string>
#include <utility>
#include <vector>

using namespace dmg;
using namespace dmg::benchmarks;

namespace
{

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using Distances = std::vector<double>;
using Method = std::function<Distances(int source)>;

constexpr double Infinity = std::numeric_limits<double>::infinity();

Mesh MeshOf(const TriangleMesh& surface)
{
  Mesh mesh;
  for (int vertex = 0; vertex < surface.NumberOfVertices(); ++vertex)
  {
    const Vector3 place = surface.Position(vertex);
    mesh.add_vertex({ place.x(), place.y(), place.z() });
  }
  for (int face = 0; face < surface.NumberOfFaces(); ++face)
  {
    const auto corner = [&](int k) { return Mesh::Vertex_index(surface.Tail(3 * face + k)); };
    mesh.add_face(corner(0), corner(1), corner(2));
  }
  return mesh;
}

Distances Exact(Mesh& mesh, int source)
{
  using Traits = CGAL::Surface_mesh_shortest_path_traits<Kernel, Mesh>;
  CGAL::Surface_mesh_shortest_path<Traits> paths(mesh);
  paths.add_source_point(Mesh::Vertex_index(source));
  paths.build_sequence_tree();
  Distances distances;
  for (const auto vertex : mesh.vertices())
  {
    const double distance = paths.shortest_distance_to_source_points(vertex).first;
    distances.push_back(distance < 0.0 ? Infinity : distance);
  }
  return distances;
}

Distances ByHeat(Mesh& mesh, int source)
{
  auto map = mesh.add_property_map<Mesh::Vertex_index, double>("distance").first;
  CGAL::Heat_method_3::Surface_mesh_geodesic_distances_3<Mesh, CGAL::Heat_method_3::Intrinsic_Delaunay> heat(mesh);
  heat.add_source(Mesh::Vertex_index(source));
  heat.estimate_geodesic_distances(map);
  Distances distances;
  for (const auto vertex : mesh.vertices())
  {
    distances.push_back(map[vertex]);
  }
  return distances;
}

Distances AlongEdges(const TriangleMesh& mesh, int source)
{
  Distances distances(mesh.NumberOfVertices(), Infinity);
  std::priority_queue<std::pair<double, int>> queue;
  distances[source] = 0.0;
  queue.emplace(0.0, source);
  while (!queue.empty())
  {
    const auto [negative, vertex] = queue.top();
    queue.pop();
    const auto reach = [&, from = vertex](int other)
    {
      const double length = distances[from] + (mesh.Position(from) - mesh.Position(other)).norm();
      if (length < distances[other])
      {
        distances[other] = length;
        queue.emplace(-length, other);
      }
    };
    if (-negative <= distances[vertex])
    {
      mesh.VisitFan(vertex,
        [&](int h)
        {
          reach(mesh.Head(h));
          reach(mesh.Tail(TriangleMesh::Previous(h)));
        });
    }
  }
  return distances;
}

Distances Ours(const TriangleMesh& mesh, int source)
{
  const FramedMesh surface(mesh);
  DistanceSources sources;
  sources.Vertices.push_back(source);
  const SurfaceDistance distance(surface, sources);
  const Vector<double>& found = distance.Field().Distances;
  return { found.data(), found.data() + found.size() };
}

/// The errors, seconds and memory of one method on one surface.
void PrintRow(const std::string& name, const TriangleMesh& mesh, const std::string& method, const Method& measure,
  const std::vector<int>& sources, const std::vector<Distances>& exact)
{
  double sum = 0.0, largest = 0.0;
  long long number = 0;
  const PeakMemory memory;
  const double start = static_cast<double>(std::clock());
  std::vector<Distances> found;
  for (const int source : sources)
  {
    found.push_back(measure(source));
  }
  const double seconds = (static_cast<double>(std::clock()) - start) / CLOCKS_PER_SEC;
  const double megabytes = memory.Growth();
  for (std::size_t k = 0; k < sources.size(); ++k)
  {
    for (int vertex = 0; vertex < mesh.NumberOfVertices(); ++vertex)
    {
      if (exact[k][vertex] > 0.0 && std::isfinite(exact[k][vertex]))
      {
        const double error = std::abs(found[k][vertex] / exact[k][vertex] - 1.0);
        sum += error;
        largest = std::max(largest, error);
        ++number;
      }
    }
  }
  std::printf("| %s | %d | %s | %.1e | %.1e | %.3f | %.0f |\n", name.c_str(), mesh.NumberOfFaces(), method.c_str(),
    sum / static_cast<double>(number), largest, seconds / static_cast<double>(sources.size()), megabytes);
  std::fflush(stdout);
}

void Run(const std::string& path, int numberOfSources, bool isExact)
{
  const test::Surface given = test::ReadPly(path);
  const PreparedSurface prepared =
    PrepareSurface({ given.V, given.F, 0, static_cast<int>(given.F.rows()), {}, {} }, PreparationOptions());
  const TriangleMesh& mesh = prepared.Mesh;
  Mesh cgal = MeshOf(mesh);
  std::vector<int> sources;
  for (int k = 0; k < numberOfSources; ++k)
  {
    sources.push_back(static_cast<int>((2LL * k + 1) * mesh.NumberOfVertices() / (2 * numberOfSources)));
  }
  const Method reference = [&](int source) { return isExact ? Exact(cgal, source) : Ours(mesh, source); };
  std::vector<Distances> exact;
  std::transform(sources.begin(), sources.end(), std::back_inserter(exact), reference);
  const std::string name = path.substr(path.find_last_of('/') + 1);
  if (isExact)
  {
    PrintRow(name, mesh, "CGAL, exact", reference, sources, exact);
  }
  PrintRow(
    name, mesh, "SurfaceDistance", [&](int source) { return Ours(mesh, source); }, sources, exact);
  PrintRow(
    name, mesh, "CGAL, heat", [&](int source) { return ByHeat(cgal, source); }, sources, exact);
  PrintRow(
    name, mesh, "Dijkstra", [&](int source) { return AlongEdges(mesh, source); }, sources, exact);
}

}

int main(int argc, char* argv[])
{
  CommandLine commandLine(argc, argv);
  int sources = 3;
  commandLine.Take("--sources", sources);
  const bool isExact = !commandLine.Take("--without-exact");
  std::printf(
    "| surface | triangles | method | mean error | largest | processor s | MB |\n|---|---|---|---|---|---|---|\n");
  for (const std::string& path : commandLine.Paths())
  {
    try
    {
      Run(path, std::max(sources, 1), isExact);
    }
    catch (const std::exception& error)
    {
      std::printf("| %s | %s |\n", path.c_str(), error.what());
    }
  }
  return 0;
}
