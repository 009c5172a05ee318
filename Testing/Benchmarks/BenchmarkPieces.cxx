/// Fields of a surface in pieces: seconds of each stage, memory and messages.
///
///   mpiexec -n RANKS BenchmarkPieces TRIANGLES|surface.ply ...
///
/// TRIANGLES is a torus with bumps of many sizes, of which each rank makes a slice; no rank ever has all of it. A file is read by all
/// ranks, each of which keeps a part of Morton's curve. One line per surface, of the slowest rank and of the largest.

#include "Mesh/SpatialOrder.h"
#include "Pieces/FieldSolverInPieces.h"
#include "Support/AllIndices.h"
#include "Support/ReadPly.h"
#include "Support/Stopwatch.h"

#include <sys/resource.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

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

SurfacePiece PartOf(const test::Surface& surface, int rank, int ranks)
{
  const std::vector<int> order = FacesInSpatialOrder(surface.V, surface.F, SerialContext());
  const long long faces = surface.F.rows();
  std::vector<int> numbers(surface.V.rows(), -1);
  std::vector<int> points;
  std::vector<int> corners;
  for (long long k = faces * rank / ranks; k < faces * (rank + 1) / ranks; ++k)
  {
    for (int corner = 0; corner < 3; ++corner)
    {
      int& number = numbers[surface.F(order[k], corner)];
      if (number < 0)
      {
        number = static_cast<int>(points.size());
        points.push_back(surface.F(order[k], corner));
      }
      corners.push_back(number);
    }
  }
  SurfacePiece piece;
  piece.Positions = surface.V(points, All);
  piece.Corners = Eigen::Map<const Triangles>(corners.data(), static_cast<Eigen::Index>(corners.size() / 3), 3);
  return piece;
}

/// Bytes.
double PeakMemory()
{
  rusage usage;
  getrusage(RUSAGE_SELF, &usage);
  return 1024.0 * static_cast<double>(usage.ru_maxrss);
}

SurfacePiece PieceOf(const std::string& surface, const Ranks& ranks)
{
  if (surface.find(".ply") != std::string::npos)
  {
    return PartOf(test::ReadPly(surface), ranks.Rank(), ranks.Size());
  }
  const int across = static_cast<int>(std::sqrt(std::atof(surface.c_str()) / 4.0));
  return SliceOf(2 * across, across, ranks.Rank(), ranks.Size());
}

void Run(const std::string& surface)
{
  const Ranks ranks(MPI_COMM_WORLD);
  const double before = PeakMemory();
  const SurfacePiece piece = PieceOf(surface, ranks);
  const double faces = static_cast<double>(piece.Corners.rows());
  const Stopwatch watch;
  FieldSolverInPieces solver(MPI_COMM_WORLD, piece);
  const double surfaceSeconds = watch.Seconds();
  FieldProblem problem;
  problem.Stop = { 1e-8, 100 };
  const int step = std::max(1, solver.Piece().NumberOfOwnFaces() * ranks.Size() / 20); // 20 constraints
  for (int face = step / 2; face < solver.Piece().NumberOfOwnFaces(); face += step)
  {
    problem.Constraints.OnFaces.push_back(
      { face, solver.Piece().Surface().Faces.X.row(solver.Piece().FirstOwnFace() + face).transpose(), 1.0 });
  }
  const Field& field = solver.Solve(problem);
  const double end = watch.Seconds();
  const double all = ranks.Max(end);
  const double setup = surfaceSeconds + field.Solution->SetupSeconds;
  const double slowestSetup = ranks.Max(setup);
  const double prepare = ranks.Max(field.Report.PrepareSeconds);
  const double solve = ranks.Max(field.Report.SolveSeconds);
  const double drawing = ranks.Max(end - setup - field.Report.PrepareSeconds - field.Report.SolveSeconds);
  const double peak = ranks.Max(PeakMemory() - before);
  const double total = ranks.Sum(faces);
  const double sent = ranks.Sum(static_cast<double>(ranks.BytesSent() + solver.Piece().Everyone().BytesSent()));
  if (ranks.Rank() == 0)
  {
    std::printf(
      "%s, %d ranks, %.0f triangles: set-up %.2f s, system %.2f s, solve %.2f s, directions %.2f s, all %.2f s; "
      "%d iterations, %d levels; peak of the largest rank %.0f MB, %.0f bytes per own triangle; "
      "sent %.2f MB besides PETSc's\n",
      surface.c_str(), ranks.Size(), total, slowestSetup, prepare, solve, drawing, all, field.Report.Returned,
      static_cast<int>(field.Report.Levels.size()), peak / 1e6, peak * ranks.Size() / total, sent / 1e6);
  }
}

}

int main(int count, char** arguments)
{
  MPI_Init(&count, &arguments);
  for (int k = 1; k < count; ++k)
  {
    Run(arguments[k]);
  }
  MPI_Finalize();
  return 0;
}
