// The crosses of ../Core/SmoothField.cxx, where each rank has a piece of the surface:
//
//   mpiexec -n 4 SmoothFieldInPieces SURFACE.ply OUTPUT.txt

#include <Pieces/FieldSolverInPieces.h>

#include <cstdio>
#include <exception>
#include <fstream>
#include <iomanip>
#include <string>

namespace
{

/// The triangles of a rank, one run of the file's. Surfaces that are large have a file for each rank; points without a triangle
/// there may stay or not.
dmg::SurfacePiece ReadPiece(const char* name, int rank, int ranks, int& firstTriangle)
{
  std::ifstream file(name); // ASCII, points and triangles only
  int numberOfPoints = 0, numberOfTriangles = 0, three = 0;
  for (std::string word; file >> word && word != "end_header";)
  {
    if (word == "element" && file >> word)
    {
      file >> (word == "vertex" ? numberOfPoints : numberOfTriangles);
    }
  }
  dmg::SurfacePiece piece;
  piece.Positions.resize(numberOfPoints, 3);
  for (auto point : piece.Positions.rowwise())
    file >> point[0] >> point[1] >> point[2];
  dmg::Triangles triangles(numberOfTriangles, 3);
  for (auto triangle : triangles.rowwise())
    file >> three >> triangle[0] >> triangle[1] >> triangle[2];
  firstTriangle = static_cast<int>(1LL * numberOfTriangles * rank / ranks);
  const int end = static_cast<int>(1LL * numberOfTriangles * (rank + 1) / ranks);
  piece.Corners = triangles.middleRows(firstTriangle, end - firstTriangle);
  return piece;
}

bool Solve(const char* input, const char* output)
{
  int rank = 0, ranks = 1, first = 0;
  MPI_Comm_rank(MPI_COMM_WORLD, &rank);
  MPI_Comm_size(MPI_COMM_WORLD, &ranks);
  const dmg::SurfacePiece piece = ReadPiece(input, rank, ranks, first);
  dmg::FieldSolverInPieces solver(MPI_COMM_WORLD, piece);

  // They follow two directions, which the ranks give that have the triangles.
  dmg::FieldProblem problem;
  for (const dmg::Constraint& constraint : { dmg::Constraint{ 0, { 1, 0, 0 }, 1.0 }, { 1000, { 1, 1, 1 }, 1.0 } })
  {
    const int triangle = constraint.Element - first;
    if (0 <= triangle && triangle < piece.Corners.rows())
    {
      problem.Constraints.OnFaces.push_back({ triangle, constraint.Direction, constraint.Weight });
    }
  }
  problem.Stop.RelativeTolerance = 1e-10;
  const dmg::Field& field = solver.Solve(problem);

  // One rank after the other writes a row for each of its triangles.
  for (int turn = 0; turn < ranks; ++turn)
  {
    if (turn == rank && piece.Corners.rows() > 0)
    {
      std::ofstream file(output, rank == 0 ? std::ios::trunc : std::ios::app);
      file << std::setprecision(17)
           << field.DirectionsOnFaces(solver.Piece().Surface(), 0)
                .middleRows(solver.Piece().FirstOwnFace(), piece.Corners.rows())
           << '\n';
    }
    MPI_Barrier(MPI_COMM_WORLD);
  }
  if (rank == 0)
  {
    std::printf("%d ranks, %d iterations\n", ranks, static_cast<int>(field.Report.Iterations.size()) - 1);
  }
  return field.Report.Converged;
}

}

int main(int count, char* arguments[])
{
  MPI_Init(&count, &arguments);
  bool isDone = false;
  try
  {
    isDone = Solve(arguments[1], arguments[2]);
  }
  catch (const std::exception& error) // all ranks have the same one
  {
    std::fprintf(stderr, "%s\n", error.what());
  }
  MPI_Finalize();
  return isDone ? 0 : 1;
}
