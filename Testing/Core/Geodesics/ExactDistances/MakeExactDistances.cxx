// Makes the numbers beside it: exact distances over the polyhedron from its vertex 0 to every so many others, by the algorithm of Xin and
// Wang in CGAL (libcgal-dev), which no test needs.
//
//   g++ -O2 -std=c++17 MakeExactDistances.cxx -lgmp -lmpfr -o make
//   ./make kitten.ply > kitten.txt
//
// A line for each vertex: its number and its distance.
#include <CGAL/Exact_predicates_inexact_constructions_kernel.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/Surface_mesh/IO/PLY.h>
#include <CGAL/Surface_mesh_shortest_path.h>

#include <algorithm>
#include <cstdio>
#include <fstream>

using Kernel = CGAL::Exact_predicates_inexact_constructions_kernel;
using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
using ShortestPaths = CGAL::Surface_mesh_shortest_path<CGAL::Surface_mesh_shortest_path_traits<Kernel, Mesh>>;

int main(int, char** arguments)
{
  std::ifstream file(arguments[1], std::ios::binary);
  Mesh mesh;
  if (!CGAL::IO::read_PLY(file, mesh))
  {
    return 1;
  }
  const int size = static_cast<int>(mesh.number_of_vertices());
  const int step = std::max(size / 200, 1);
  ShortestPaths paths(mesh);
  paths.add_source_point(Mesh::Vertex_index(0));
  for (int vertex = step; vertex < size; vertex += step)
  {
    std::printf("%d %.12g\n", vertex, paths.shortest_distance_to_source_points(Mesh::Vertex_index(vertex)).first);
  }
}
