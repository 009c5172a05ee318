// Crosses that follow two directions, without VTK: SmoothField SURFACE.ply OUTPUT.txt

#include <FieldSolver.h>

#include <cstdio>
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

  dmg::FieldSolver solver(dmg::TriangleMesh(points, triangles));
  dmg::FieldOptions options;
  options.Field.N = 4;
  // Faces, directions, and how hard they pull.
  const dmg::Constraints prescribed{ { { 0, { 1, 0, 0 }, 1.0 }, { 1000, { 1, 1, 1 }, 1.0 } }, {} };
  solver.Solve(prescribed, options, { 1e-10, 100 });

  // A row per face; 1, 2 and 3 are the others.
  std::ofstream(argv[2]) << std::setprecision(17) << solver.Directions(0).rowwise().normalized() << '\n';
  return solver.Report().Converged ? 0 : 1;
}
