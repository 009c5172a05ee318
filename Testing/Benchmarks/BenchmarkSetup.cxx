// Set-up: all levels and the operators between them, from surfaces in PLY files.
//
//   BenchmarkSetup [--runs n] [--threads n] [--grow] surface.ply ...
//
// First the stages in which a surface is read: its order in memory, the mesh in that order, the frames of faces and vertices, and
// PrepareSurface, which holds the first two and the checks. Then levels: once from samples (Nodal only), once from edge collapses with the operators of power fields (S0, SP,
// Nodal), once with all (S1 and SX as well).
// With --grow, each surface is also cut 1:4 until it has a million faces: growth with size.

#include "Benchmarks/CommandLine.h"
#include "Benchmarks/Timing.h"
#include "Levels/SampledLevels.h"
#include "Mesh/SpatialOrder.h"
#include "Preparation/PreparedSurface.h"
#include "StructurePreserving/SurfaceHierarchy.h"
#include "Support/ReadPly.h"
#include "Support/TbbContext.h"

using namespace dmg;

namespace
{

void MeasureReading(const std::string& name, const test::Surface& surface, int runs, const ExecutionContext& context)
{
  const SpatialOrder order(surface.V, surface.F, context);
  const TriangleMesh mesh = order.Apply(surface.V, surface.F, context);
  const auto print = [&](const char* stage, const auto& function)
  {
    std::vector<double> seconds;
    for (int run = 0; run < runs; ++run)
    {
      seconds.push_back(function());
    }
    std::printf("%-28s %-9s %8d %8.3f %8.3f\n", name.c_str(), stage, mesh.NumberOfFaces(), benchmarks::Median(seconds),
      *std::min_element(seconds.begin(), seconds.end()));
  };
  using benchmarks::Seconds;
  print("order", [&] { return Seconds([&] { SpatialOrder(surface.V, surface.F, context); }); });
  print("mesh", [&] { return Seconds([&] { order.Apply(surface.V, surface.F, context); }); });
  print("frames",
    [&]
    {
      return Seconds(
        [&]
        {
          FaceFrames(mesh, context);
          VertexFrames(mesh, context);
        });
    });
  print("prepared",
    [&]
    {
      CellTriangles triangles;
      triangles.Positions = surface.V;
      triangles.Corners = surface.F;
      triangles.NumberOfCells = mesh.NumberOfFaces();
      return Seconds([&] { PrepareSurface(std::move(triangles), {}, context); });
    });
}

struct Setup
{
  const char* Operators;
  bool AreSampled;
  OperatorSelection Selection;
};

void Measure(
  const std::string& name, const TriangleMesh& mesh, int runs, const Setup& setup, const ExecutionContext& context)
{
  std::vector<double> seconds;
  ProlongationOperators operators;
  for (int run = 0; run < runs; ++run)
  {
    seconds.push_back(benchmarks::Seconds(
      [&]
      {
        operators = setup.AreSampled
          ? SampledLevels(mesh, DefaultSampleDistance, context)
          : BuildSurfaceHierarchy(mesh, HierarchyOptions(), context, setup.Selection).Operators;
      }));
  }
  const std::vector<int>& faces = operators.NumbersOfFaces;
  const double median = benchmarks::Median(seconds);
  std::printf("%-28s %-9s %8d %8.3f %8.3f %12.2f  ", name.c_str(), setup.Operators, faces.front(), median,
    *std::min_element(seconds.begin(), seconds.end()), 1e6 * median / std::max(faces.front() - faces.back(), 1));
  for (std::size_t l = 1; l < faces.size(); ++l)
  {
    std::printf(" %d", faces[l]);
  }
  std::printf("\n");
  std::fflush(stdout);
}

}

int main(int argc, char* argv[])
{
  int runs = 5;
  int threads = 2;
  benchmarks::CommandLine words(argc, argv);
  words.Take("--runs", runs);
  words.Take("--threads", threads);
  const bool grow = words.Take("--grow");
  const std::vector<std::string> paths = words.Paths();
  if (words.HasUnknown() || paths.empty() || runs < 1 || threads < 1)
  {
    std::fprintf(stderr, "usage: BenchmarkSetup [--runs n] [--threads n] [--grow] surface.ply ...\n");
    return 2;
  }
  const test::TbbContext context(threads);
  benchmarks::PrintMachine(threads, runs);
  std::printf("%-28s %-9s %8s %8s %8s %12s   %s\n", "surface", "operators", "faces", "s", "s, best", "us/face less",
    "faces of the coarse levels");
  const auto measureAll = [&](const std::string& name, const TriangleMesh& mesh)
  {
    for (const Setup& setup : { Setup{ "sampled", true, { false, false, false } },
           Setup{ "power", false, { true, false, false } }, Setup{ "all", false, { true, true, true } } })
    {
      Measure(name, mesh, runs, setup, context);
    }
  };
  for (const std::string& path : paths)
  {
    test::Surface surface = test::ReadPly(path);
    MeasureReading(benchmarks::BaseName(path), surface, runs, context);
    measureAll(benchmarks::BaseName(path), surface.Mesh());
    while (grow && surface.F.rows() < 1000000)
    {
      surface = test::Subdivide(surface);
      measureAll(benchmarks::BaseName(path) + ", cut 1:4", surface.Mesh());
    }
  }
  return 0;
}
