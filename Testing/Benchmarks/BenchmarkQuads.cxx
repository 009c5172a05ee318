// Quad meshes of surfaces in PLY files.
//
//   BenchmarkQuads [--smooth] [--faces] [--any-length] [--quads 1000,4000,16000] SURFACE.ply...
//
// prints a row of a table for each surface and number: what was asked for and what came of it. The field follows boundary and sharp edges;
// with --smooth, nothing. It is a power field at points; with --faces, on faces. It has unit length while smoothing, as in Quad Mesh; with --any-length, not. The column "good" is a check of the indices alone: each directed edge once, one fan per vertex, the Euler number of
// the surface, inner valences of 3 at least, no two vertices in
// one place but where the surface has such, too. The column "along" is the share of the length of boundary and sharp edges that shall become edges of
// quads which are beside one that runs along, in percent. Times are processor seconds of the calls.

#include "CommandLine.h"

#include "FieldSolver.h"
#include "Preparation/PreparedSurface.h"
#include "Quads/Crosses/AlignedEdges.h"
#include "Quads/QuadMesh.h"
#include "Support/LinesAlongEdges.h"
#include "Support/ReadPly.h"

#include <cstdio>
#include <ctime>
#include <exception>
#include <map>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

using namespace dmg;
using namespace dmg::benchmarks;

namespace
{

double ProcessorSeconds()
{
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

PreparedSurface ReadSurface(const std::string& path)
{
  const test::Surface surface = test::ReadPly(path);
  return PrepareSurface({ surface.V, surface.F, 0, static_cast<int>(surface.F.rows()), {}, {} }, PreparationOptions());
}

/// Whether each directed edge is there once, and quads around each vertex are one fan of three at least, but on the boundary.
bool IsManifold(const std::vector<std::array<int, 4>>& quads)
{
  std::map<std::pair<int, int>, int> nextAround; // by vertex and neighbour: the neighbour before it in the quad
  std::map<int, int> valences;
  for (const auto& quad : quads)
  {
    for (int k = 0; k < 4; ++k)
    {
      if (!nextAround.emplace(std::make_pair(quad[k], quad[(k + 1) % 4]), quad[(k + 3) % 4]).second)
      {
        return false;
      }
      ++valences[quad[k]];
    }
  }
  std::map<int, int> starts; // a neighbour from which the fan of a vertex begins
  std::set<int> onBoundary;
  for (const auto& [side, previous] : nextAround)
  {
    if (nextAround.count({ side.second, side.first }) == 0)
    {
      starts[side.first] = side.second;
      onBoundary.insert({ side.first, side.second });
    }
    starts.emplace(side.first, side.second);
  }
  for (const auto& [vertex, valence] : valences)
  {
    int length = 0;
    for (auto corner = nextAround.find({ vertex, starts[vertex] }); corner != nextAround.end() && length < valence;
         corner = nextAround.find({ vertex, corner->second }))
    {
      ++length;
    }
    if (length != valence || (valence < 3 && onBoundary.count(vertex) == 0))
    {
      return false;
    }
  }
  return true;
}

/// Points that are in the place of another one.
Eigen::Index CoincidingPoints(const Points& positions)
{
  std::set<std::array<double, 3>> places;
  for (int point = 0; point < positions.rows(); ++point)
  {
    places.insert({ positions(point, 0), positions(point, 1), positions(point, 2) });
  }
  return positions.rows() - static_cast<Eigen::Index>(places.size());
}

bool IsGood(const FramedMesh& surface, const QuadMesh& mesh)
{
  std::set<std::pair<int, int>> edges;
  for (const auto& quad : mesh.Quads)
  {
    for (int k = 0; k < 4; ++k)
    {
      edges.insert(std::minmax(quad[k], quad[(k + 1) % 4]));
    }
  }
  const long long euler =
    mesh.Positions.rows() - static_cast<long long>(edges.size()) + static_cast<long long>(mesh.Quads.size());
  return mesh.Report.Error.empty() && euler == surface.Mesh.EulerCharacteristic() &&
    CoincidingPoints(mesh.Positions) <= CoincidingPoints(surface.Mesh.VertexPositions()) && IsManifold(mesh.Quads);
}

/// The percentage of features along which an edge of a quad runs.
double AlongFeatures(
  const FramedMesh& surface, const Vector<Complex>& powers, const QuadOptions& options, const QuadMesh& mesh)
{
  const SurfaceAngles angles(surface, SerialContext());
  const CrossField field = MatchCrosses(surface, angles, powers, SerialContext());
  const std::vector<char> features = FindAlignedEdges(surface, angles, field, options);
  return 100.0 * test::ShareAlongEdges(surface.Mesh, features, mesh.Quads, mesh.Positions);
}

void PrintRow(const std::string& name, const FramedMesh& surface, double wanted, const QuadMesh& mesh, double along,
  double field, double quads)
{
  const QuadReport& report = mesh.Report;
  std::printf("| %s | %d | %g | %zu | %s | %d | %d | %d | %d | %d | %.3f | %.1f | %d | %.1f | %.1f | %s |\n",
    name.c_str(), surface.Mesh.NumberOfFaces(), wanted, mesh.Quads.size(), IsGood(surface, mesh) ? "yes" : "NO",
    report.EulerOfSurface, report.Singularities, report.IrregularWithoutSingularity, report.FlippedFaces,
    report.InvertedQuads, report.MeanScaledJacobian, along, report.Refinements, field, quads, report.Error.c_str());
  std::fflush(stdout);
}

void Run(
  const std::string& path, const std::vector<double>& numbers, bool followsFeatures, bool isOnFaces, bool hasUnitLength)
{
  const PreparedSurface prepared = ReadSurface(path);
  const std::string name = path.substr(path.find_last_of('/') + 1);
  const double start = ProcessorSeconds();
  FieldSolver solver(prepared.Mesh);
  FieldProblem problem;
  problem.Options.Field.Kind = isOnFaces ? DiscretisationKind::PowerField : DiscretisationKind::VertexPowerField;
  problem.Features.BoundaryWeight = followsFeatures ? 1000.0 : 0.0;
  if (followsFeatures)
  {
    problem.Constraints.OnFaces = AlongSharpLines(solver.Surface(), {}, 1000.0);
  }
  problem.UnitLengthWhileSmoothing = hasUnitLength;
  const Vector<Complex> powers = solver.Solve(problem).OnFaces.array().pow(4);
  const double field = ProcessorSeconds() - start;
  for (const double number : numbers)
  {
    QuadOptions options;
    options.NumberOfQuads = number;
    const double before = ProcessorSeconds();
    const QuadMesh mesh = MakeQuads(solver.Surface(), powers, options);
    const double quads = ProcessorSeconds() - before;
    PrintRow(
      name, solver.Surface(), number, mesh, AlongFeatures(solver.Surface(), powers, options, mesh), field, quads);
  }
}

std::vector<double> NumbersOf(const std::string& text)
{
  std::vector<double> numbers;
  std::istringstream stream(text);
  for (std::string number; std::getline(stream, number, ',');)
  {
    numbers.push_back(std::stod(number));
  }
  return numbers;
}

}

int main(int argc, char* argv[])
{
  CommandLine commandLine(argc, argv);
  std::string numbers = "4000";
  commandLine.Take("--quads", numbers);
  const bool isSmooth = commandLine.Take("--smooth"), isOnFaces = commandLine.Take("--faces"),
             hasAnyLength = commandLine.Take("--any-length");
  std::printf("| surface | triangles | wanted | quads | good | Euler | singular | irregular besides | flipped | "
              "inverted | scaled Jacobian | "
              "along | rounds | field s | quads s | error "
              "|\n|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  for (const std::string& path : commandLine.Paths())
  {
    try
    {
      Run(path, NumbersOf(numbers), !isSmooth, isOnFaces, !hasAnyLength);
    }
    catch (const std::exception& error)
    {
      std::printf("| %s | %s |\n", path.c_str(), error.what());
    }
  }
  return 0;
}
