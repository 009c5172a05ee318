// Crosses without VTK: SmoothField SURFACE.ply OUTPUT.txt

#include <FieldSolver.h>

#include <cmath>
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

  // They follow two directions: faces, directions, and how hard they pull.
  dmg::FieldSolver solver(dmg::TriangleMesh(points, triangles));
  dmg::FieldProblem problem;
  problem.Constraints.OnFaces = { { 0, { 1, 0, 0 }, 1.0 }, { 1000, { 1, 1, 1 }, 1.0 } };
  problem.Stop.RelativeTolerance = 1e-10;
  const dmg::Field& field = solver.Solve(problem);
  // A row per face; 1, 2 and 3 are the others.
  std::ofstream(argv[2]) << std::setprecision(17) << solver.Directions(0) << '\n';
  if (!field.Report.Converged)
    return 1;

  // They follow a line over the surface, and sharp edges half as hard.
  problem.Constraints = {};
  problem.Guides.Lines = { { { points.row(0), points.row(1), points.row(2) }, { 2.0 } } };
  problem.Features.SharpEdgesWeight = 1.0;
  solver.Solve(problem);
  std::printf("%lld segments followed\n", field.Guides.Taken);

  // They turn as little as is possible with these singularities alone: 4 times indices that sum to the Euler characteristic.
  problem.Singularities = { { 0, -3 }, { 100, -3 }, { 200, -1 }, { 300, -1 } };
  solver.Solve(problem);
  return field.Report.Converged && std::abs(field.Indices[100] + 0.75) < 1e-6 ? 0 : 1;
}
