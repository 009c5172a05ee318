// The five discretisations beside their peers: time, memory, iterations and agreement, in one run.
//
//   BenchmarkFields [--out folder] [--runs n] [--threads n] [--limit seconds]
//     [--discretisation name] [--solver name] [--cut n | --loop n] (--short | surface.ply ...)
//   BenchmarkFields [--out folder] [--threads n] (--iterations-only | --robustness)
//     [--discretisation name] [--cut n | --loop n] (--short | surface.ply ...)
//
//   fields.csv      every solver to a relative residual of 1e-8, with 20 prescribed elements, as
//                   a person draws, and 0.5 % of them
//   resolves.csv    what a second solve takes: one value moved, other weights, another set
//   iterations.csv  ours alone, for N = 1, 2, 4, 6 and other numbers of elements
//                   (--iterations-only), or for weights of alignment over eighteen orders of
//                   magnitude and hard constraints, an alignment of inf (--robustness)
//
// The columns of fields.csv, in seconds, medians of the runs:
//   setup     what ours needs of the surface, whatever is prescribed, from the bare mesh
//   assembly  frames and matrix. Ours assembles while it sets up or prepares, and counts it there
//   prepare   factorisation or preconditioner
//   solve     to the tolerance
//   total     assembly + prepare + solve: what a surface takes whose set-up is at hand
//   bare      all four: from the bare mesh
// and in MB: held by the solver, its peak beyond mesh, operators and peers' matrix, and the peak
// of the process. Each solver runs in a process of its own, so that memory can be counted and a
// peer be stopped that takes longer than the limit; one that takes long is measured once.
// difference is |x - y| / |y| to CHOLMOD's y. The program fails if a solver that has converged
// differs by more than 1e-6.
//
// --discretisation and --solver restrict the run to names that contain the word ("second solves" are
// those of resolves.csv). --cut and --loop cut each surface 1:4 so many times, in its plane triangles or by
// Loop's rule. --short does all of it on a small surface that it makes.

#include "Benchmarks/CommandLine.h"
#include "Benchmarks/Csv.h"
#include "Benchmarks/Fields/IterationCounts.h"
#include "Benchmarks/Fields/Jobs.h"
#include "Benchmarks/Fields/SecondSolves.h"
#include "Benchmarks/Fields/SolverRuns.h"

#include <cmath>
#include <utility>

using namespace dmg;
using namespace dmg::benchmarks;

namespace
{

constexpr double LargestDifference = 1e-6;

/// The table of times; remembers whether all who converged agree.
class FieldsTable
{
public:
  explicit FieldsTable(const std::string& folder)
    : File(folder + "/fields.csv",
        "surface,faces,discretisation,prescribed,unknowns,solver,runs,setup,assembly,prepare,solve,"
        "total,bare,iterations,residual,difference,held_mb,peak_mb,process_mb,note")
  {
    std::printf("%-20s %-10s %-5s %-20s %7s %7s %7s %7s %7s %7s %5s %6s %6s %6s  %s\n", "surface", "discret.", "presc",
      "solver", "setup", "assem.", "prepare", "solve", "total", "bare", "iter.", "held", "peak", "proc.", "difference");
  }

  void Append(const Job& job, const std::string& solver, const Measured& measured, const Vector<double>& reference)
  {
    const std::string kind = NameOf(job.Asked.Field.Kind);
    const char* const surface = job.Surface.Name.c_str();
    const char* const regime = job.Prescribed.Name.c_str();
    if (measured.Solution.size() == 0)
    {
      this->File.Row(surface, None, kind, regime, None, solver, 0, None, None, None, None, None, None, None, None, None,
        None, None, None, measured.Note);
      std::printf(
        "%-20.20s %-10s %-5s %-20s %s\n", surface, kind.c_str(), regime, solver.c_str(), measured.Note.c_str());
      std::fflush(stdout);
      return;
    }
    const Row& row = measured.Numbers;
    const double difference = reference.size() > 0 ? RelativeDifference(measured.Solution, reference) : None;
    const bool converged = row.Residual <= 2.0 * Tolerance;
    const bool agrees = !(converged && difference > LargestDifference);
    this->AllAgree = this->AllAgree && agrees;
    const auto& [setup, assembly, prepare, solve] = row.Seconds;
    char held[8] = "-";
    if (!std::isnan(row.Held))
    {
      std::snprintf(held, sizeof(held), "%.0f", row.Held);
    }
    char differs[16] = "-";
    if (!std::isnan(difference))
    {
      std::snprintf(differs, sizeof(differs), "%.1e", difference);
    }
    this->File.Row(surface, row.Faces, kind, regime, row.Unknowns, solver, row.Runs, setup, assembly, prepare, solve,
      row.Total(), row.Bare(), row.Iterations, row.Residual, difference, row.Held, row.Peak, row.Process,
      measured.Note);
    std::printf("%-20.20s %-10s %-5s %-20s %7.3f %7.3f %7.3f %7.3f %7.3f %7.3f %5d %6s %6.0f %6.0f  "
                "%s%s %s\n",
      surface, kind.c_str(), regime, solver.c_str(), setup, assembly, prepare, solve, row.Total(), row.Bare(),
      row.Iterations, held, row.Peak, row.Process, differs, agrees ? "" : " DIFFERS", measured.Note.c_str());
    std::fflush(stdout);
  }

  bool Agree() const { return this->AllAgree; }

private:
  Csv File;
  bool AllAgree = true;
};

void MeasureSurface(const Source& surface, const Options& options, FieldsTable& fields, ResolvesTable& resolves)
{
  for (const DiscretisationKind kind : Discretisations(options))
  {
    for (const Regime& regime : Regimes)
    {
      const Job job = { surface, FieldOf(kind), regime };
      Vector<double> reference;
      for (const std::string& solver : Solvers(kind))
      {
        if (solver.find(options.Solver) == std::string::npos)
        {
          continue;
        }
        const Measured measured = Measure(job, solver, options);
        if (solver == Reference)
        {
          reference = measured.Solution;
        }
        fields.Append(job, solver, measured, reference);
      }
      if (std::string("second solves").find(options.Solver) != std::string::npos)
      {
        std::string failure;
        resolves.Append(job, MeasureResolves(job, options, failure));
        if (!failure.empty())
        {
          std::printf("second solves: %s\n", failure.c_str());
        }
      }
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
  words.Take("--limit", options.Limit);
  words.Take("--cut", options.Cuts);
  words.Take("--loop", options.LoopCuts);
  words.Take("--discretisation", options.Discretisation);
  words.Take("--solver", options.Solver);
  options.IterationsOnly = words.Take("--iterations-only");
  options.Robustness = words.Take("--robustness");
  std::vector<Source> surfaces;
  const bool isShort = words.Take("--short");
  if (isShort)
  {
    surfaces.push_back({ "torus", [] { return test::IrregularTorus(64, 28, 7).Mesh(); } });
  }
  for (const std::string& path : words.Paths())
  {
    surfaces.push_back(SourceOf(path, options));
  }
  if (words.HasUnknown() || surfaces.empty() || options.Cuts < 0 || options.LoopCuts < 0 || options.Runs < 1 ||
    options.Threads < 1 || options.Limit < 1)
  {
    std::fprintf(stderr,
      "usage: BenchmarkFields [--out folder] [--runs n] [--threads n] [--limit seconds]\n"
      "         [--discretisation name] [--solver name] [--iterations-only | --robustness]\n"
      "         [--cut n | --loop n] (--short | surface.ply ...)\n");
    return 2;
  }
  const bool countsOnly = options.IterationsOnly || options.Robustness;
  PrintMachine(options.Threads, countsOnly ? 1 : options.Runs);
  if (countsOnly)
  {
    IterationsTable table(options.Folder);
    PrintIterationsHeader(options);
    for (const Source& surface : surfaces)
    {
      CountIterations(surface, options, table);
    }
    return 0;
  }
  FieldsTable fields(options.Folder);
  ResolvesTable resolves(options.Folder);
  for (const Source& surface : surfaces)
  {
    MeasureSurface(surface, options, fields, resolves);
  }
  if (!fields.Agree())
  {
    std::printf("some solutions differ by more than %.0e\n", LargestDifference);
  }
  return fields.Agree() ? 0 : 1;
}
