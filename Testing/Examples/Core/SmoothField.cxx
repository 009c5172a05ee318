// A cross field on an icosahedron that follows one direction, without VTK.

#include <FieldSolver.h>

#include <cstdio>

int main()
{
  const double g = 1.618033988749895;
  dmg::Points points(12, 3);
  points << -1, g, 0, 1, g, 0, -1, -g, 0, 1, -g, 0, 0, -1, g, 0, 1, g, 0, -1, -g, 0, 1, -g, g, 0, -1,
    g, 0, 1, -g, 0, -1, -g, 0, 1;
  dmg::Triangles triangles(20, 3);
  triangles << 0, 11, 5, 0, 5, 1, 0, 1, 7, 0, 7, 10, 0, 10, 11, 1, 5, 9, 5, 11, 4, 11, 10, 2, 10, 7, 6,
    7, 1, 8, 3, 9, 4, 3, 4, 2, 3, 2, 6, 3, 6, 8, 3, 8, 9, 4, 9, 5, 2, 4, 11, 6, 2, 10, 8, 6, 7, 9, 8, 1;

  dmg::FieldSolver solver(dmg::TriangleMesh(points, triangles));
  dmg::FieldOptions options;
  options.Field.N = 4;
  solver.Solve({ { { 0, dmg::Vector3(1.0, 0.0, 0.0), 1.0 } }, {} }, options);
  const dmg::Points first = solver.Directions(0); // a row per face; 1, 2, 3 are the others

  std::printf("%d faces, residual %g\n", static_cast<int>(first.rows()),
    solver.Report().Iterations.back().RelativeResidual);
  return solver.Report().Converged ? 0 : 1;
}
