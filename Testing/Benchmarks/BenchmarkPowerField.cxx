// Power fields: iterations, time and memory beside the peers, in the same run.
//
//   BenchmarkPowerField [--runs n] [--threads n] [--iterations-only] surface.ply ...
//
// Two regimes: 20 prescribed faces, as a person draws, and 0.5 % of the faces. Ours starts with the
// operators at hand: prepare is assembly, Galerkin products and the coarsest factor, and solve goes
// to a relative residual of 1e-8. The peers get the assembled matrix.

#include "Benchmarks/Peers/DirectPeers.h"
#include "Benchmarks/Peers/IncompleteCholeskyPeer.h"
#include "Benchmarks/Timing.h"
#include "HarmonicField.h"
#include "Support/Random.h"
#include "Support/ReadPly.h"
#include "Support/TbbContext.h"
#include "Systems/PowerFieldSystem.h"

#include <cstdlib>
#include <cstring>
#include <optional>
#include <set>

using namespace dmg;
using namespace dmg::benchmarks;

namespace
{

constexpr double Tolerance = 1e-8;

struct Options
{
  int Runs = 3;
  int Threads = 2;
  bool IterationsOnly = false;
  std::vector<std::string> Paths;
};

struct Prescription
{
  std::string Name;
  PrescribedFaces Faces;
  Vector<Complex> Values;
};

Prescription Prescribe(const std::string& name, int faces, int count)
{
  test::Random random(20261121);
  std::set<int> chosen;
  while (static_cast<int>(chosen.size()) < count)
  {
    chosen.insert(random.Index(faces));
  }
  Prescription result{ name, {}, Vector<Complex>(count) };
  result.Faces.Faces.assign(chosen.begin(), chosen.end());
  result.Faces.Weights.assign(count, 1.0);
  for (Complex& value : result.Values)
  {
    value = std::polar(1.0, random.Uniform(-3.14159265, 3.14159265));
  }
  return result;
}

struct Row
{
  double Prepare = 0.0;
  double Solve = 0.0;
  int Iterations = 0;
  double Megabytes = 0.0;

  double Total() const { return this->Prepare + this->Solve; }
};

void Print(const std::string& surface, int faces, const std::string& regime, int N,
  const std::string& solver, const Row& row)
{
  std::printf("%-26s %8d %-8s %2d  %-26s %8.3f %8.3f %8.3f %6d %8.0f\n", surface.c_str(), faces,
    regime.c_str(), N, solver.c_str(), row.Prepare, row.Solve, row.Total(), row.Iterations,
    row.Megabytes);
  std::fflush(stdout);
}

template <class Measure>
Row MedianOf(int runs, Measure measure)
{
  std::vector<double> prepare;
  std::vector<double> solve;
  Row row;
  for (int run = 0; run < runs; ++run)
  {
    row = measure();
    prepare.push_back(row.Prepare);
    solve.push_back(row.Solve);
  }
  row.Prepare = Median(prepare);
  row.Solve = Median(solve);
  return row;
}

Row MeasureOurs(const TriangleMesh& mesh, const TangentFrames& frames,
  const ProlongationOperators& operators, const Prescription& prescription, int N,
  const ExecutionContext& context)
{
  PowerFieldOptions options;
  options.N = N;
  options.Solver = SolverKind::ConjugateGradients;
  StoppingCriteria stop;
  stop.RelativeTolerance = Tolerance;
  std::optional<HarmonicProblem<Complex>> problem;
  Row row;
  row.Prepare = Seconds([&] {
    problem.emplace(MakePowerFieldProblem(
      mesh, frames, &operators, prescription.Faces, options, context));
  });
  row.Solve = Seconds([&] { problem->Solve(prescription.Values, {}, stop, context); });
  const SolveReport& report = problem->Report();
  row.Iterations = static_cast<int>(report.Iterations.size()) - 1;
  row.Megabytes = 1e-6 * static_cast<double>(report.Bytes);
  if (!report.Converged)
  {
    std::printf("not converged: %s\n", report.Warnings.empty() ? "" : report.Warnings[0].c_str());
  }
  return row;
}

Row MeasurePeer(peers::Peer<Complex>& peer, const HarmonicSystem<Complex>& system,
  const Vector<Complex>& values)
{
  const Vector<Complex> b = system.RightHandSide(values);
  Vector<Complex> x;
  Row row;
  row.Prepare = Seconds([&] { peer.Prepare(system.Matrix()); });
  row.Solve = Seconds([&] { row.Iterations = peer.Solve(b, Tolerance, x); });
  row.Megabytes = 1e-6 * static_cast<double>(peer.Bytes());
  return row;
}

void MeasureSurface(const std::string& path, const Options& options)
{
  const test::TbbContext context(options.Threads);
  const TriangleMesh mesh = test::ReadPly(path).Mesh();
  const std::string name = BaseName(path);
  const int faces = mesh.NumberOfFaces();
  const TangentFrames frames = FaceFrames(mesh);
  const ProlongationOperators operators =
    BuildSurfaceHierarchy(mesh, HierarchyOptions(), context).Operators;

  for (const Prescription& prescription :
    { Prescribe("20", faces, 20), Prescribe("0.5 %", faces, faces / 200) })
  {
    for (int N : { 1, 2, 4, 6 })
    {
      Print(name, faces, prescription.Name, N, "ours",
        MedianOf(options.IterationsOnly ? 1 : options.Runs, [&] {
          return MeasureOurs(mesh, frames, operators, prescription, N, context);
        }));
    }
    if (options.IterationsOnly)
    {
      continue;
    }
    const int N = 2;
    const HarmonicSystem<Complex> system =
      MakePowerFieldSystem(mesh, frames, N, prescription.Faces, PowerFieldWeights());
    std::vector<std::unique_ptr<peers::Peer<Complex>>> peers;
    peers.push_back(std::make_unique<peers::CholmodPeer<Complex>>(FillOrdering::AMD));
    peers.push_back(std::make_unique<peers::CholmodPeer<Complex>>(FillOrdering::METIS));
    peers.push_back(std::make_unique<peers::IncompleteCholeskyPeer<Complex>>());
    for (const auto& peer : peers)
    {
      try
      {
        Print(name, faces, prescription.Name, N, peer->Name(), MedianOf(options.Runs, [&] {
          return MeasurePeer(*peer, system, prescription.Values);
        }));
      }
      catch (const SolverFailure& failure)
      {
        std::printf("%s: %s\n", peer->Name().c_str(), failure.what());
      }
    }
  }
}

}

int main(int argc, char* argv[])
{
  Options options;
  for (int i = 1; i < argc; ++i)
  {
    if (!std::strcmp(argv[i], "--runs") && i + 1 < argc)
    {
      options.Runs = std::atoi(argv[++i]);
    }
    else if (!std::strcmp(argv[i], "--threads") && i + 1 < argc)
    {
      options.Threads = std::atoi(argv[++i]);
    }
    else if (!std::strcmp(argv[i], "--iterations-only"))
    {
      options.IterationsOnly = true;
    }
    else
    {
      options.Paths.push_back(argv[i]);
    }
  }
  if (options.Paths.empty() || options.Runs < 1 || options.Threads < 1)
  {
    std::fprintf(stderr,
      "usage: BenchmarkPowerField [--runs n] [--threads n] [--iterations-only] surface.ply ...\n");
    return 2;
  }
  PrintMachine(options.Threads, options.IterationsOnly ? 1 : options.Runs);
  std::printf("%-26s %8s %-8s %2s  %-26s %8s %8s %8s %6s %8s\n", "surface", "faces", "presc.", "N",
    "solver", "prepare", "solve", "total", "iter.", "MB");
  for (const std::string& path : options.Paths)
  {
    MeasureSurface(path, options);
  }
  return 0;
}
