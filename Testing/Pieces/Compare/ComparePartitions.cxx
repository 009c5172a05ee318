/// Power fields of surfaces in pieces against those of one process, for any way to cut them.
///
///   mpiexec -n RANKS ComparePartitions [--weights] [surface.ply ...]
///
/// Twenty directions are prescribed, softly and then strictly. The pieces are parts of Morton's curve, those of METIS where the program
/// was built with it, random tiles, one triangle on the last rank, and none on the first. One line per surface and constraint tells the
/// iterations on one process and of each partition, and the largest difference from the factored system. With --weights, Morton's parts
/// are compared for weights from 1e-6 to 1e12. Without surfaces, two small ones are compared. The program fails where a
/// difference is above ten times the tolerance, or a partition takes more than two iterations more than one process.

#include "FieldSolver.h"
#include "Mesh/SpatialOrder.h"
#include "Partitions.h"
#include "Pieces/FieldSolverInPieces.h"
#include "ProblemsInPieces.h"
#include "Support/ComplexPairs.h"
#include "Support/ReadPly.h"

#ifdef DMG_HAS_METIS
#include <metis.h>
#endif

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>
#include <vector>

using namespace dmg;

namespace
{

constexpr double Tolerance = 1e-8;

std::vector<int> PartsOfMortonsCurve(const test::Surface& surface, int numberOfRanks)
{
  const std::vector<int> order = FacesInSpatialOrder(surface.V, surface.F, SerialContext());
  const long long triangles = surface.F.rows();
  std::vector<int> ranks(surface.F.rows());
  for (long long k = 0; k < triangles; ++k)
  {
    ranks[order[k]] = static_cast<int>(k * numberOfRanks / triangles);
  }
  return ranks;
}

#ifdef DMG_HAS_METIS
std::vector<int> PartsOfMetis(const test::Surface& surface, int numberOfRanks)
{
  idx_t triangles = static_cast<idx_t>(surface.F.rows());
  idx_t points = static_cast<idx_t>(surface.V.rows());
  idx_t common = 2; // points of neighbours
  idx_t parts = numberOfRanks;
  idx_t cut = 0;
  std::vector<idx_t> begins, corners(surface.F.data(), surface.F.data() + surface.F.size());
  for (idx_t k = 0; k <= triangles; ++k)
  {
    begins.push_back(3 * k);
  }
  std::vector<idx_t> ofTriangles(triangles, 0), ofPoints(points, 0);
  if (parts > 1)
  {
    METIS_PartMeshDual(&triangles, &points, begins.data(), corners.data(), nullptr, nullptr, &common, &parts, nullptr,
      nullptr, &cut, ofTriangles.data(), ofPoints.data());
  }
  return { ofTriangles.begin(), ofTriangles.end() };
}
#endif

std::vector<test::NamedPartition> AllPartitions()
{
  std::vector<test::NamedPartition> partitions = test::Partitions();
  partitions[0] = { "Morton", PartsOfMortonsCurve }; // in place of the order of the file, which is no partition
#ifdef DMG_HAS_METIS
  partitions.insert(partitions.begin() + 1, { "METIS", PartsOfMetis });
#endif
  return partitions;
}

Constraints TwentyDirections(const test::Surface& surface)
{
  Constraints constraints;
  const int step = std::max(1, static_cast<int>(surface.F.rows()) / 20);
  for (int face = step / 2; face < surface.F.rows(); face += step)
  {
    const Vector3 side = (surface.V.row(surface.F(face, 1)) - surface.V.row(surface.F(face, 0))).transpose();
    if (side.norm() > 0.0)
    {
      constraints.OnFaces.push_back({ face, side.normalized(), 1.0 });
    }
  }
  return constraints;
}

/// The solution of one process. Rank 0 finds it.
struct Expected
{
  int Iterations = 0;
  Vector<double> Powers; ///< pairs, per vertex
  Vector<double> Axes;   ///< three numbers per vertex
};

Expected SolveOnOneProcess(const test::Surface& surface, FieldProblem problem)
{
  Expected expected;
  expected.Powers.setZero(2 * surface.V.rows());
  expected.Axes.setZero(3 * surface.V.rows());
  if (Ranks(MPI_COMM_WORLD).Rank() == 0)
  {
    problem.Options.Solver.Kind = SolverKind::ConjugateGradients;
    FieldSolver solver(surface.Mesh());
    expected.Iterations = solver.Solve(problem).Report.Returned;
    problem.Options.Solver.Kind = SolverKind::Cholesky;
    expected.Powers = solver.Solve(problem).Solution->Unknowns;
    for (int vertex = 0; vertex < surface.V.rows(); ++vertex)
    {
      expected.Axes.segment<3>(3 * vertex) = solver.Surface().Vertices.X.row(vertex).transpose();
    }
  }
  MPI_Bcast(&expected.Iterations, 1, MPI_INT, 0, MPI_COMM_WORLD);
  MPI_Bcast(expected.Powers.data(), static_cast<int>(expected.Powers.size()), MPI_DOUBLE, 0, MPI_COMM_WORLD);
  MPI_Bcast(expected.Axes.data(), static_cast<int>(expected.Axes.size()), MPI_DOUBLE, 0, MPI_COMM_WORLD);
  return expected;
}

/// Relative to the exact solution, over all points of all pieces.
double Difference(const Ranks& ranks, const PieceOfSurface& piece, const Field& field, const test::CutPiece& cut,
  const Expected& expected)
{
  const Vector<Complex> found = test::UnknownsOf(field);
  double squares = 0.0;
  double differences = 0.0;
  for (std::size_t i = 0; i < cut.Points.size(); ++i)
  {
    const int here = piece.VerticesOfPoints()[i];
    const int there = cut.Points[i];
    // The axes of both frames may differ, and the powers turn N times as far.
    const Complex axis = piece.Surface().Vertices.ToComplex(here, expected.Axes.segment<3>(3 * there));
    const Complex power = AsComplex(expected.Powers)[there] * std::pow(axis, DiscretisationOptions().N);
    squares += std::norm(power);
    differences += std::norm(found[here] - power);
  }
  return std::sqrt(ranks.Sum(differences) / ranks.Sum(squares));
}

/// \return whether all partitions are within the limits.
bool Compare(const std::string& name, const test::Surface& surface, const FieldOptions& options,
  const std::vector<test::NamedPartition>& partitions)
{
  const Ranks ranks(MPI_COMM_WORLD);
  FieldProblem whole;
  whole.Options = options;
  whole.Constraints = TwentyDirections(surface);
  whole.Stop = { Tolerance, 100 };
  const Expected expected = SolveOnOneProcess(surface, whole);
  std::string line = name + (options.Constraints == ConstraintKind::Hard ? ", strictly" : ", softly");
  line += options.Alignment == 1.0 ? "" : ", weight " + std::to_string(options.Alignment);
  line += ": one process " + std::to_string(expected.Iterations);
  double largest = 0.0;
  bool isWithin = true;
  for (const test::NamedPartition& partition : partitions)
  {
    const test::CutPiece cut = test::CutOut(surface, partition.RanksOfTriangles(surface, ranks.Size()), ranks.Rank());
    FieldSolverInPieces solver(MPI_COMM_WORLD, cut.Piece);
    const Field& field = solver.Solve(test::OfPiece(whole, cut, surface));
    largest = std::max(largest, Difference(ranks, solver.Piece(), field, cut, expected));
    isWithin &= field.Report.Converged && field.Report.Returned <= expected.Iterations + 2;
    line += ", " + partition.Name + " " + std::to_string(field.Report.Returned);
    if (ranks.Size() == 1) // which has all, whatever the partition
    {
      break;
    }
  }
  isWithin &= largest <= 10.0 * Tolerance;
  if (ranks.Rank() == 0)
  {
    std::printf("%s; difference %.1e%s\n", line.c_str(), largest, isWithin ? "" : " BEYOND");
    std::fflush(stdout);
  }
  return isWithin;
}

bool CompareAll(const std::string& name, const test::Surface& surface, bool withWeights)
{
  std::vector<test::NamedPartition> partitions = AllPartitions();
  FieldOptions options;
  bool isWithin = true;
  if (withWeights)
  {
    partitions.resize(1);
    for (const double alignment : { 1e-6, 1e-3, 1e3, 1e6, 1e12 })
    {
      options.Alignment = alignment;
      isWithin &= Compare(name, surface, options, partitions);
    }
    return isWithin;
  }
  for (const ConstraintKind kind : { ConstraintKind::Soft, ConstraintKind::Hard })
  {
    options.Constraints = kind;
    isWithin &= Compare(name, surface, options, partitions);
  }
  return isWithin;
}

}

int main(int count, char** arguments)
{
  MPI_Init(&count, &arguments);
  std::vector<std::string> files(arguments + 1, arguments + count);
  const auto option = std::find(files.begin(), files.end(), "--weights");
  const bool withWeights = option != files.end();
  if (withWeights)
  {
    files.erase(option);
  }
  bool isWithin = true;
  for (const std::string& file : files)
  {
    isWithin &= CompareAll(file.substr(file.rfind('/') + 1), test::ReadPly(file), withWeights);
  }
  if (files.empty())
  {
    isWithin &= CompareAll("torus", test::IrregularTorus(90, 40, 4), withWeights);
    isWithin &= CompareAll("plane", test::IrregularPlane(50, 40, 5), withWeights);
  }
  MPI_Finalize();
  return isWithin ? 0 : 1;
}
