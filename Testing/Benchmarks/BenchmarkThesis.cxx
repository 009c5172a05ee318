// The tables of the thesis, ours beside its printed numbers, as CSV files for plot_thesis.py.
//
//   BenchmarkThesis [--out folder] [--runs n] [--threads n] [--solves-only] surface.ply ...
//   BenchmarkThesis [--out folder] [--runs n] [--threads n] --short
//
//   solves.csv  tables 7.8 to 7.13: coarse prolongation, nested iterations and Cholesky
//   sweeps.csv  tables 7.14 to 7.16: V-cycles to an error of 1e-3, by sweeps per level
//   starts.csv  table 7.17: nested iterations by starting level
//   setup.csv   table 7.18: all levels and operators
//   curves.csv  figures 7.1 to 7.3 and 7.13 to 7.16: the error of every V-cycle
//
// fmg is ours: nested iterations with a few V-cycles per level instead of sweeps (full multigrid), on
// linear levels.
//
// Surfaces with the names of the shared mesh set stand beside the thesis's; others have its columns
// empty. As there, 0.5 % of the elements are prescribed, softly and at random, the ground truth is
// Cholesky's, and nested iterations sweep while a sweep lowers the error by 0.1 %. V-cycles are
// stationary, on the thesis's operators, with as many sweeps after the correction as before it.
// Times are medians of the runs, in milliseconds. --short does all of it on two small surfaces that it
// makes, with two numbers of sweeps.

#include "Benchmarks/CommandLine.h"
#include "Benchmarks/Csv.h"
#include "Benchmarks/Prescriptions.h"
#include "Benchmarks/ThesisTables.h"
#include "Benchmarks/Timing.h"
#include "Discretisations/MakeDiscretisation.h"
#include "StructurePreserving/SurfaceHierarchy.h"
#include "Support/FieldProblem.h"
#include "Support/MeshFactory.h"
#include "Support/ReadPly.h"
#include "Support/TbbContext.h"

#include <functional>
#include <optional>

using namespace dmg;
using namespace dmg::benchmarks;

namespace
{

const Regime Prescribed = { "0.5 %", 0, 0.005 };
constexpr double ErrorOfConvergence = 1e-3; // of tables 7.14 to 7.16
constexpr int LargestNumberOfCycles = 150;
constexpr int LargestNumberOfSweeps = 100; // per level, of nested iterations
constexpr double LeastImprovement = 1e-3;  // of the error, by each of them

struct Options
{
  std::string Folder = ".";
  int Runs = 3;
  int Threads = 2;
  bool Short = false;
  bool SolvesOnly = false; // the first table
  std::vector<std::string> Paths;
};

struct Tables
{
  explicit Tables(const std::string& folder)
    : Solves(folder + "/solves.csv",
        "surface,faces,discretisation,"
        "cp_energy,cp_error,ni_energy,ni_error,cholesky_prepare,cholesky_solve,mg_prepare,cp_solve,"
        "ni_solve,ni_sweeps,fmg_error,fmg_prepare,fmg_solve,"
        "thesis_cp_energy,thesis_cp_error,thesis_ni_energy,thesis_ni_error,thesis_cholesky_prepare,"
        "thesis_cholesky_solve,thesis_mg_prepare,thesis_cp_solve,thesis_ni_solve")
    , Sweeps(folder + "/sweeps.csv",
        "surface,discretisation,sweeps,cycles,per_cycle,total,thesis_cycles,thesis_per_cycle,"
        "thesis_total")
    , Starts(folder + "/starts.csv",
        "surface,discretisation,starting_level,error,prepare,solve,thesis_error,thesis_prepare,"
        "thesis_solve")
    , Setup(folder + "/setup.csv", "surface,faces,setup,thesis_setup")
    , Curves(folder + "/curves.csv", "surface,discretisation,sweeps,cycle,milliseconds,error")
  {
  }
  Csv Solves, Sweeps, Starts, Setup, Curves;
};

/// What a solve took and what came of it.
struct Outcome
{
  double Prepare = 0.0; // milliseconds
  double Solve = 0.0;
  SolveReport Report;

  const IterationReport& Last() const { return this->Report.Iterations.back(); }
};

/// One of the three problems of the thesis on one surface, ready to be solved in any way.
struct Problem
{
  std::string Name;
  int Index; // of the thesis's columns
  FieldOptions Options;
  std::function<Outcome(const FieldOptions&)> Solve;
};

std::vector<Problem> Problems(
  const FramedMesh& surface, const ProlongationOperators& operators, const ExecutionContext& context)
{
  test::Random random(20261121);
  const auto prescribe = [&surface, &random](DiscretisationKind kind)
  {
    const auto field = MakeDiscretisation({ kind }, surface);
    return RandomConstraints(surface.Mesh, *field, Prescribed, random);
  };
  const FieldConstraints onEdges = prescribe(DiscretisationKind::OneForm);
  const FieldConstraints onFaces = prescribe(DiscretisationKind::PowerField);
  const StoppingCriteria stop = { 1e-12, LargestNumberOfCycles };
  std::vector<Problem> problems;
  for (const DiscretisationKind kind :
    { DiscretisationKind::OneForm, DiscretisationKind::FaceField, DiscretisationKind::PowerField })
  {
    FieldOptions options;
    options.Field.Kind = kind;
    options.Field.N = 2;
    options.CoarseSpace = CoarseSpaceKind::StructurePreserving;
    const FieldConstraints& constraints = kind == DiscretisationKind::OneForm ? onEdges : onFaces;
    FieldOptions direct = options;
    direct.Solver.Kind = SolverKind::Cholesky;
    const Vector<double> truth = test::FieldProblem(surface, &operators, constraints, direct, context)
                                   .Solve(constraints.Values, {}, stop, context);
    const auto solve = [&surface, &operators, &context, constraints, stop, truth](const FieldOptions& asked)
    {
      std::optional<test::FieldProblem> problem;
      Outcome outcome;
      outcome.Prepare = 1e3 * Seconds([&] { problem.emplace(surface, &operators, constraints, asked, context); });
      problem->Solve(constraints.Values, {}, stop, context, { truth, LeastImprovement });
      outcome.Report = problem->Report();
      outcome.Solve = 1e3 * outcome.Report.SolveSeconds;
      return outcome;
    };
    problems.push_back({ NameOf(kind), static_cast<int>(problems.size()), options, solve });
  }
  return problems;
}

/// Times are medians; the rest is the same in every run.
Outcome MedianOf(int runs, const Problem& problem, const FieldOptions& options)
{
  std::vector<double> prepare, solve;
  Outcome outcome;
  for (int run = 0; run < runs; ++run)
  {
    outcome = problem.Solve(options);
    prepare.push_back(outcome.Prepare);
    solve.push_back(outcome.Solve);
  }
  outcome.Prepare = Median(prepare);
  outcome.Solve = Median(solve);
  return outcome;
}

/// Full multigrid on linear levels; face fields, the hardest, get the most cycles.
FieldOptions FullMultigrid(const Problem& problem)
{
  constexpr int cycles[] = { 3, 8, 2 };
  FieldOptions options = problem.Options;
  options.CoarseSpace = CoarseSpaceKind::LinearInterpolation;
  options.Solver.Kind = SolverKind::NestedIterations;
  options.Solver.Nested.Cycles = cycles[problem.Index];
  options.Solver.Nested.Sweeps = 0;
  return options;
}

FieldOptions With(FieldOptions options, SolverKind kind)
{
  options.Solver.Kind = kind;
  options.Solver.Nested.Sweeps = LargestNumberOfSweeps;
  return options;
}

int SweepsOnTheFinest(const SolveReport& report)
{
  int sweeps = 0;
  for (const IterationReport& row : report.Iterations)
  {
    sweeps += row.Level == 0 ? 1 : 0;
  }
  return sweeps - 1; // the first row is the start
}

void MeasureSolves(const Options& options, const std::string& surface, int faces, const Problem& problem,
  const thesis::Mesh* printed, Tables& tables)
{
  const Outcome cholesky = MedianOf(options.Runs, problem, With(problem.Options, SolverKind::Cholesky));
  const Outcome coarse = MedianOf(options.Runs, problem, With(problem.Options, SolverKind::CoarseProlongation));
  const Outcome nested = MedianOf(options.Runs, problem, With(problem.Options, SolverKind::NestedIterations));
  const Outcome full = MedianOf(options.Runs, problem, FullMultigrid(problem));
  const double none = thesis::Failed;
  const thesis::Solves of =
    printed ? printed->Of[problem.Index] : thesis::Solves{ none, none, none, none, none, none, none, none, none };
  tables.Solves.Row(surface, faces, problem.Name, coarse.Last().MassResidual, coarse.Last().Error,
    nested.Last().MassResidual, nested.Last().Error, cholesky.Prepare, cholesky.Solve, nested.Prepare, coarse.Solve,
    nested.Solve, SweepsOnTheFinest(nested.Report), full.Last().Error, full.Prepare, full.Solve, of.CoarseEnergy,
    of.CoarseError, of.NestedEnergy, of.NestedError, of.CholeskyPrepare, of.CholeskySolve, of.MultigridPrepare,
    of.CoarseSolve, of.NestedSolve);
  std::printf("%-26s %-10s errors: CP %.3f (%.3f), NI %.4f (%.4f) in %.0f ms (%.0f), FMG %.4f in %.0f ms\n",
    surface.c_str(), problem.Name.c_str(), coarse.Last().Error, of.CoarseError, nested.Last().Error, of.NestedError,
    nested.Solve, of.NestedSolve, full.Last().Error, full.Solve);
  std::fflush(stdout);
}

/// Cycles until the error falls below a limit, or none.
std::optional<int> CyclesToConverge(const SolveReport& report)
{
  for (const IterationReport& row : report.Iterations)
  {
    if (row.Error < ErrorOfConvergence)
    {
      return row.Iteration;
    }
  }
  return std::nullopt;
}

void MeasureCycles(
  const Options& options, const std::string& surface, const Problem& problem, bool isThesisSurface, Tables& tables)
{
  for (int sweeps = 1; sweeps <= (options.Short ? 2 : 8); ++sweeps)
  {
    FieldOptions cycles = With(problem.Options, SolverKind::VCycles);
    cycles.Solver.Sweeps = sweeps;
    const Outcome outcome = problem.Solve(cycles);
    const auto& rows = outcome.Report.Iterations;
    const double perCycle = outcome.Solve / std::max<std::size_t>(rows.size() - 1, 1);
    const std::optional<int> number = CyclesToConverge(outcome.Report);
    const double ours = number ? *number : thesis::Failed;
    const thesis::Cycles printed =
      isThesisSurface ? thesis::CyclesBySweeps[problem.Index][sweeps - 1] : thesis::Cycles{ 0, thesis::Failed };
    const double theirs = isThesisSurface ? printed.Number : thesis::Failed;
    tables.Sweeps.Row(surface, problem.Name, sweeps, ours, perCycle, ours * perCycle, theirs, printed.PerCycle,
      theirs * printed.PerCycle);
  }
}

void MeasureStarts(const Options& options, const std::string& surface, const Problem& problem, int coarsest,
  bool isThesisSurface, Tables& tables)
{
  for (int level = coarsest; level >= 1; --level)
  {
    FieldOptions nested = With(problem.Options, SolverKind::NestedIterations);
    nested.Solver.StartingLevel = level;
    const Outcome outcome = MedianOf(options.Runs, problem, nested);
    const std::size_t index = coarsest - level; // the thesis counts from the coarsest
    const double none = thesis::Failed;
    const thesis::Start printed = isThesisSurface && problem.Index == 2 && index < thesis::Starts.size()
      ? thesis::Starts[index]
      : thesis::Start{ none, none, none };
    tables.Starts.Row(surface, problem.Name, level, outcome.Last().Error, outcome.Prepare, outcome.Solve, printed.Error,
      printed.Prepare, printed.Solve);
  }
}

/// The sweeps per level that the thesis took for its figures, section 7.2.1.
int SweepsOfFigures(const Problem& problem)
{
  return problem.Index == 0 ? 6 : 2;
}

void MeasureCurve(const std::string& surface, const Problem& problem, Tables& tables)
{
  FieldOptions cycles = With(problem.Options, SolverKind::VCycles);
  cycles.Solver.Sweeps = SweepsOfFigures(problem);
  const Outcome outcome = problem.Solve(cycles);
  for (const IterationReport& row : outcome.Report.Iterations)
  {
    tables.Curves.Row(surface, problem.Name, cycles.Solver.Sweeps, row.Iteration, 1e3 * row.Seconds, row.Error);
  }
}

void Measure(const Options& options, const std::string& name, const TriangleMesh& mesh, const ExecutionContext& context,
  Tables& tables)
{
  const thesis::Mesh* printed = nullptr;
  for (const thesis::Mesh& candidate : thesis::Meshes)
  {
    printed = name == candidate.File ? &candidate : printed;
  }

  SurfaceHierarchy hierarchy;
  std::vector<double> setup;
  for (int run = 0; run < options.Runs; ++run)
  {
    setup.push_back(Seconds([&] { hierarchy = BuildSurfaceHierarchy(mesh, HierarchyOptions(), context); }));
  }
  tables.Setup.Row(name, mesh.NumberOfFaces(), 1e3 * Median(setup), printed ? printed->Setup : thesis::Failed);

  const FramedMesh surface(mesh);
  // Tables 7.14 to 7.17 are of the thesis's largest mesh.
  const bool isLargest = printed == &thesis::Meshes.front();
  const int coarsest = hierarchy.Operators.NumberOfLevels() - 1;
  for (const Problem& problem : Problems(surface, hierarchy.Operators, context))
  {
    MeasureSolves(options, name, mesh.NumberOfFaces(), problem, printed, tables);
    if (options.SolvesOnly)
    {
      continue;
    }
    MeasureCurve(name, problem, tables);
    if (isLargest || options.Short)
    {
      MeasureCycles(options, name, problem, isLargest, tables);
      MeasureStarts(options, name, problem, coarsest, isLargest, tables);
    }
  }
}

}

int main(int argc, char* argv[])
{
  Options options;
  CommandLine words(argc, argv);
  words.Take("--out", options.Folder);
  words.Take("--runs", options.Runs);
  words.Take("--threads", options.Threads);
  options.Short = words.Take("--short");
  options.SolvesOnly = words.Take("--solves-only");
  options.Paths = words.Paths();
  if (words.HasUnknown() || options.Paths.empty() != options.Short || options.Runs < 1 || options.Threads < 1)
  {
    std::fprintf(stderr,
      "usage: BenchmarkThesis [--out folder] [--runs n] [--threads n] "
      "(--short | [--solves-only] surface.ply ...)\n");
    return 2;
  }
  const test::TbbContext context(options.Threads);
  PrintMachine(options.Threads, options.Runs);
  std::printf("the thesis's numbers in brackets\n");
  Tables tables(options.Folder);
  for (const std::string& path : options.Paths)
  {
    Measure(options, BaseName(path), test::ReadPly(path).Mesh(), context, tables);
  }
  if (options.Short)
  {
    Measure(options, "sphere", test::IrregularSphere(5, 7).Mesh(), context, tables);
    Measure(options, "torus", test::IrregularTorus(96, 40, 7).Mesh(), context, tables);
  }
  return 0;
}
