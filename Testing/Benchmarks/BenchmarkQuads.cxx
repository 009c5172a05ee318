// Quad meshes of surfaces in PLY files.
//
//   BenchmarkQuads [--smooth] [--faces] [--any-length] [--quads 1000,4000,16000] [--beside-quadriflow] SURFACE.ply...
//
// prints a row of a table for each surface and number: what was asked for and what came of it. The field is found as Quad Mesh finds it: on the surface
// with long edges halved, at points, of unit length while smoothing, along boundary and sharp edges. With --smooth, it follows nothing; with --faces, it is
// on faces; with --any-length, it is one of any length. The column "good" is a check of the indices alone: each directed edge once, one fan per vertex, the Euler
// number of the surface, inner valences of 3 at least, no two vertices in
// one place but where the surface has such, too. The column "along" is the share of the length of boundary and sharp edges that shall become edges of
// quads which are beside one that runs along, in percent. Times are processor seconds of the calls.
//
// With --beside-quadriflow, rows have what can be said of any quads, and each is followed by one of Blender's QuadriFlow, measured by the same functions. There
// is none where `blender` is not on PATH (Debian has it: apt install blender). "Irregular": inner vertices of other than four quads. "Far": the largest
// distance of a vertex of the surface from quads, in edges of squares of the mean area.

#include "CommandLine.h"
#include "PeakMemory.h"

#include "FieldSolver.h"
#include "Peers/QuadriFlow.h"
#include "Places/NearestPlaces.h"
#include "Preparation/PreparedSurface.h"
#include "Quads/Crosses/AlignedEdges.h"
#include "Quads/Isolines/QuadDistances.h"
#include "Quads/Isolines/QuadSmoothing.h"
#include "Quads/QuadMesh.h"
#include "Quads/SurfaceQuads.h"
#include "Support/LinesAlongEdges.h"
#include "Support/ReadPly.h"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <ctime>
#include <exception>
#include <map>
#include <memory>
#include <set>
#include <sstream>
#include <string>
#include <utility>
#include <vector>

using namespace dmg;
using namespace dmg::benchmarks;

namespace
{

constexpr const char* HeadOfTable =
  "| surface | triangles | wanted | quads | good | Euler | singular | irregular besides | flipped | inverted | "
  "scaled Jacobian | along | rounds | field s | quads s | error |\n"
  "|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|---|\n";
constexpr const char* HeadOfComparison =
  "| surface | triangles | wanted | by | quads | good | irregular | inverted | scaled Jacobian | far | s | MB |\n"
  "|---|---|---|---|---|---|---|---|---|---|---|---|\n";

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

std::map<std::pair<int, int>, int> EdgesOf(const std::vector<std::array<int, 4>>& quads)
{
  std::map<std::pair<int, int>, int> edges; // the number of their quads
  for (const auto& quad : quads)
  {
    for (int k = 0; k < 4; ++k)
    {
      ++edges[std::minmax(quad[k], quad[(k + 1) % 4])];
    }
  }
  return edges;
}

bool IsGood(const FramedMesh& surface, const std::vector<std::array<int, 4>>& quads, const Points& positions)
{
  const long long euler =
    positions.rows() - static_cast<long long>(EdgesOf(quads).size()) + static_cast<long long>(quads.size());
  return euler == surface.Mesh.EulerCharacteristic() &&
    CoincidingPoints(positions) <= CoincidingPoints(surface.Mesh.VertexPositions()) && IsManifold(quads);
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
    name.c_str(), surface.Mesh.NumberOfFaces(), wanted, mesh.Quads.size(),
    report.Error.empty() && IsGood(surface, mesh.Quads, mesh.Positions) ? "yes" : "NO", report.EulerOfSurface,
    report.Singularities, report.IrregularWithoutSingularity, report.FlippedFaces, report.InvertedQuads,
    report.MeanScaledJacobian, along, report.Refinements, field, quads, report.Error.c_str());
  std::fflush(stdout);
}

/// Inner vertices that have not four quads.
int IrregularVertices(const std::vector<std::array<int, 4>>& quads)
{
  std::map<int, int> valences;
  for (const auto& [edge, number] : EdgesOf(quads))
  {
    for (const int vertex : { edge.first, edge.second })
    {
      valences[vertex] += number == 1 ? 1 << 16 : 1; // far off on the boundary
    }
  }
  return static_cast<int>(std::count_if(valences.begin(), valences.end(),
    [](const auto& valence) { return valence.second < 1 << 16 && valence.second != 4; }));
}

/// The mean normals of the surface near the corners and the middle of each quad.
Points OutsidesOf(const NearestPlaces& places, const std::vector<std::array<int, 4>>& quads, const Points& positions)
{
  Points outsides = Points::Zero(static_cast<int>(quads.size()), 3);
  for (std::size_t quad = 0; quad < quads.size(); ++quad)
  {
    Vector3 middle = Vector3::Zero();
    const auto add = [&](const Vector3& position)
    { outsides.row(quad) += places.Surface.Faces.Normal(places(position).Face).transpose(); };
    for (const int vertex : quads[quad])
    {
      add(positions.row(vertex).transpose());
      middle += 0.25 * positions.row(vertex).transpose();
    }
    add(middle);
  }
  return outsides;
}

void PrintComparison(const std::string& name, const FramedMesh& surface, double wanted, const std::string& method,
  const std::vector<std::array<int, 4>>& quads, const Points& positions, double seconds, double megabytes)
{
  const Vector<double> jacobians =
    ScaledJacobians(quads, positions, OutsidesOf(NearestPlaces(surface), quads, positions));
  const double length = std::sqrt(AreasOfQuads(quads, positions).mean());
  const Vector<double> distances = DistancesFromQuads(surface.Mesh, quads, positions);
  std::printf("| %s | %d | %g | %s | %zu | %s | %d | %d | %.3f | %.2f | %.1f | %.0f |\n", name.c_str(),
    surface.Mesh.NumberOfFaces(), wanted, method.c_str(), quads.size(),
    IsGood(surface, quads, positions) ? "yes" : "NO", IrregularVertices(quads),
    static_cast<int>((jacobians.array() < -1e-6).count()), jacobians.mean(),
    distances.size() > 0 ? distances.maxCoeff() / length : -1.0, seconds, megabytes);
  std::fflush(stdout);
}

/// Which field quads follow.
struct KindOfField
{
  bool FollowsFeatures = true, IsOnFaces = false, HasUnitLength = true;
};

Vector<Complex> FindPowers(const FramedMesh& surface, const KindOfField& kind)
{
  FieldSolver solver(std::shared_ptr<const FramedMesh>(std::shared_ptr<void>(), &surface));
  FieldProblem problem;
  problem.Options.Field.Kind = kind.IsOnFaces ? DiscretisationKind::PowerField : DiscretisationKind::VertexPowerField;
  if (kind.FollowsFeatures)
  {
    problem.Features.BoundaryWeight = 1000.0;
    problem.Constraints.OnFaces = AlongSharpLines(surface, {}, 1000.0);
  }
  problem.UnitLengthWhileSmoothing = kind.HasUnitLength;
  return FourthPowers(solver.Solve(problem).OnFaces);
}

void RunQuadriFlow(const std::string& path, const std::string& name, const FramedMesh& surface, double number)
{
  try
  {
    if (const auto peer = peers::MakeQuadsByQuadriFlow(path, number))
    {
      PrintComparison(name, surface, number, "QuadriFlow, Blender " + peer->Version, peer->Quads, peer->Positions,
        peer->Seconds, peer->Megabytes);
    }
  }
  catch (const std::exception& error)
  {
    std::printf("| %s | | %g | QuadriFlow | %s |\n", name.c_str(), number, error.what());
  }
}

void Run(const std::string& path, const std::vector<double>& numbers, const KindOfField& kind, bool isBesidePeer)
{
  const PreparedSurface prepared = ReadSurface(path);
  const std::string name = path.substr(path.find_last_of('/') + 1);
  const FramedMesh surface(prepared.Mesh);
  for (const double number : numbers)
  {
    QuadOptions options;
    options.NumberOfQuads = number;
    const PeakMemory memory;
    const double start = ProcessorSeconds();
    const std::shared_ptr<const FinerSurface> finer = SurfaceForQuads(surface, options);
    const FramedMesh& fine = finer ? finer->Geometry : surface;
    const Vector<Complex> powers = FindPowers(fine, kind);
    const double field = ProcessorSeconds() - start;
    const QuadMesh mesh = MakeQuads(surface, finer, powers, options);
    const double quads = ProcessorSeconds() - start - field, megabytes = memory.Growth();
    if (isBesidePeer)
    {
      PrintComparison(name, surface, number, "Quad Mesh", mesh.Quads, mesh.Positions, field + quads, megabytes);
      RunQuadriFlow(path, name, surface, number);
    }
    else
    {
      PrintRow(name, surface, number, mesh, AlongFeatures(fine, powers, options, mesh), field, quads);
    }
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
  KindOfField kind;
  kind.FollowsFeatures = !commandLine.Take("--smooth");
  kind.IsOnFaces = commandLine.Take("--faces");
  kind.HasUnitLength = !commandLine.Take("--any-length");
  const bool isBesidePeer = commandLine.Take("--beside-quadriflow");
  std::printf("%s", isBesidePeer ? HeadOfComparison : HeadOfTable);
  for (const std::string& path : commandLine.Paths())
  {
    try
    {
      Run(path, NumbersOf(numbers), kind, isBesidePeer);
    }
    catch (const std::exception& error)
    {
      std::printf("| %s | %s |\n", path.c_str(), error.what());
    }
  }
  return 0;
}
