#include "Support/MeshFactory.h"

#include <CGAL/Simple_cartesian.h>
#include <CGAL/Surface_mesh.h>
#include <CGAL/subdivision_method_3.h>

namespace dmg::test
{

Surface SubdivideByLoop(const Surface& surface)
{
  using Kernel = CGAL::Simple_cartesian<double>;
  using Mesh = CGAL::Surface_mesh<Kernel::Point_3>;
  Mesh mesh;
  std::vector<Mesh::Vertex_index> vertices;
  for (int v = 0; v < surface.V.rows(); ++v)
  {
    vertices.push_back(mesh.add_vertex({ surface.V(v, 0), surface.V(v, 1), surface.V(v, 2) }));
  }
  for (int f = 0; f < surface.F.rows(); ++f)
  {
    mesh.add_face(vertices[surface.F(f, 0)], vertices[surface.F(f, 1)], vertices[surface.F(f, 2)]);
  }
  CGAL::Subdivision_method_3::Loop_subdivision(mesh, CGAL::parameters::number_of_iterations(1));
  mesh.collect_garbage();

  Surface subdivided;
  subdivided.V.resize(mesh.number_of_vertices(), 3);
  for (const Mesh::Vertex_index v : mesh.vertices())
  {
    const Kernel::Point_3& p = mesh.point(v);
    subdivided.V.row(static_cast<int>(v)) << p.x(), p.y(), p.z();
  }
  subdivided.F.resize(mesh.number_of_faces(), 3);
  for (const Mesh::Face_index f : mesh.faces())
  {
    int corner = 0;
    for (const Mesh::Vertex_index v : mesh.vertices_around_face(mesh.halfedge(f)))
    {
      subdivided.F(static_cast<int>(f), corner++) = static_cast<int>(v);
    }
  }
  return subdivided;
}

}
