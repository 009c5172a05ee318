/// Fields of a surface in pieces: seconds of each stage, memory and messages.
///
///   mpiexec -n RANKS BenchmarkPieces TRIANGLES
///
/// The surface is a torus with bumps of many sizes, of which each rank makes a slice; no rank ever has all of it. One line per run, of
/// the slowest rank and of the largest.

#include "Pieces/PieceFieldSolver.h"
#include "Support/Stopwatch.h"

#include <sys/resource.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>

using namespace dmg;

namespace
{

/// A place on the torus; the same bits for the same numbers, whichever rank asks.
Vector3 PlaceOf(int i, int j, int around, int across)
{
  const double u = 2.0 * Pi * (i % around) / around;
  const double v = 2.0 * Pi * (j % across) / across;
  double radius = 0.4;
  for (int k = 1; k <= 6; ++k)
  {
    radius += 0.02 / k * std::sin((3 * k + 1) * u + k) * std::cos((2 * k + 1) * v + 2 * k);
  }
  const double distance = 1.0 + radius * std::cos(v);
  return { distance * std::cos(u), distance * std::sin(u), radius * std::sin(v) };
}

SurfacePiece SliceOf(int around, int across, int rank, int ranks)
{
  const int first = static_cast<int>(static_cast<long long>(around) * rank / ranks);
  const int last = static_cast<int>(static_cast<long long>(around) * (rank + 1) / ranks);
  SurfacePiece piece;
  piece.Positions.resize((last - first + 1) * across, 3);
  piece.Corners.resize(2 * (last - first) * across, 3);
  const auto pointOf = [&](int i, int j) { return (i - first) * across + j % across; };
  for (int i = first; i <= last; ++i)
  {
    for (int j = 0; j < across; ++j)
    {
      piece.Positions.row(pointOf(i, j)) = PlaceOf(i, j, around, across).transpose();
      if (i < last)
      {
        const int row = 2 * pointOf(i, j);
        piece.Corners.row(row) << pointOf(i, j), pointOf(i + 1, j), pointOf(i + 1, j + 1);
        piece.Corners.row(row + 1) << pointOf(i, j), pointOf(i + 1, j + 1), pointOf(i, j + 1);
      }
    }
  }
  return piece;
}

/// Bytes.
double PeakMemory()
{
  rusage usage;
  getrusage(RUSAGE_SELF, &usage);
  return 1024.0 * static_cast<double>(usage.ru_maxrss);
}

void Run(long long triangles)
{
  const Ranks ranks(MPI_COMM_WORLD);
  const int across = static_cast<int>(std::sqrt(static_cast<double>(triangles) / 4.0));
  const int around = 2 * across;
  const double before = PeakMemory();
  SurfacePiece piece = SliceOf(around, across, ranks.Rank(), ranks.Size());
  const double faces = static_cast<double>(piece.Corners.rows());
  const Stopwatch watch;
  PieceFieldSolver solver(MPI_COMM_WORLD, piece, {});
  const double setup = watch.Seconds();
  Constraints constraints;
  for (int face = 1000; face < solver.Piece().NumberOfOwnFaces(); face += 100000)
  {
    constraints.OnFaces.push_back(
      { face, solver.Piece().Surface().Faces.X.row(solver.Piece().FirstOwnFace() + face).transpose(), 1.0 });
  }
  const PieceField field = solver.Solve(constraints, {}, { 1e-8, 100 });
  const double solved = watch.Seconds();
  const Field directions = solver.Directions(field);
  const double all = ranks.Max(watch.Seconds());
  const double slowestSetup = ranks.Max(setup);
  const double prepare = ranks.Max(field.Report.PrepareSeconds);
  const double solve = ranks.Max(field.Report.SolveSeconds);
  const double drawing = ranks.Max(watch.Seconds() - solved);
  const double peak = ranks.Max(PeakMemory() - before);
  const double total = ranks.Sum(faces);
  const double sent = ranks.Sum(static_cast<double>(ranks.BytesSent() + solver.Piece().Everyone().BytesSent()));
  if (ranks.Rank() == 0)
  {
    std::printf("%d ranks, %.0f triangles: set-up %.2f s, system %.2f s, solve %.2f s, directions %.2f s, all %.2f s; "
                "%d iterations, %d levels; peak %.0f MB on the largest rank, %.0f bytes per own triangle; "
                "sent %.2f MB besides PETSc's\n",
      ranks.Size(), total, slowestSetup, prepare, solve, drawing, all, field.Report.Returned,
      static_cast<int>(field.Report.Levels.size()), peak / 1e6, peak * ranks.Size() / total, sent / 1e6);
  }
}

}

int main(int count, char** arguments)
{
  MPI_Init(&count, &arguments);
  Run(count > 1 ? std::atoll(arguments[1]) : 1000000);
  MPI_Finalize();
  return 0;
}
