// The parts of a flow without VTK: Flow SURFACE.ply OUTPUT.txt

#include <Flows/HodgeDecomposition.h>

#include <fstream>
#include <iomanip>
#include <string>

int main(int, char* argv[])
{
  std::ifstream file(argv[1]); // ASCII, points and triangles only
  int numberOfPoints = 0, numberOfTriangles = 0, three = 0;
  for (std::string word; file >> word && word != "end_header";)
  {
    if (word == "element" && file >> word)
    {
      file >> (word == "vertex" ? numberOfPoints : numberOfTriangles);
    }
  }
  dmg::Points points(numberOfPoints, 3);
  for (auto point : points.rowwise())
    file >> point[0] >> point[1] >> point[2];
  dmg::Triangles triangles(numberOfTriangles, 3);
  for (auto triangle : triangles.rowwise())
    file >> three >> triangle[0] >> triangle[1] >> triangle[2];

  const dmg::FramedMesh surface(dmg::TriangleMesh(points, triangles));
  dmg::Vector<dmg::Complex> flow = dmg::Vector<dmg::Complex>::Zero(numberOfTriangles); // along two triangles only
  flow[0] = surface.Faces.ToComplex(0, { 1, 0, 0 });
  flow[1000] = surface.Faces.ToComplex(1000, { 1, 1, 1 });
  dmg::HodgeDecomposition hodge(surface, dmg::FlowBoundary::Closed);
  const dmg::DecomposedFlow parts = hodge.Decompose(flow);

  std::ofstream output(argv[2]);
  output << std::setprecision(17);
  for (int face = 0; face < numberOfTriangles; ++face)
  {
    const dmg::Vector3 gradient = surface.Faces.ToVector(face, parts.Gradient[face]);
    const dmg::Vector3 rotational = surface.Faces.ToVector(face, parts.Rotational[face]);
    output << gradient.transpose() << ' ' << rotational.transpose() << '\n';
  }
  return parts.Converged ? 0 : 1;
}
