#ifndef dmgFieldsIterationCounts_h
#define dmgFieldsIterationCounts_h

#include "Benchmarks/Csv.h"
#include "Benchmarks/Fields/Jobs.h"
#include "Support/FieldProblem.h"

#include <cmath>

/// The iterations that ours takes, for many numbers of prescribed elements or many weights.
namespace dmg::benchmarks
{

constexpr double Infinity = std::numeric_limits<double>::infinity();

const std::vector<Regime> MoreRegimes = { { "1", 1, 0.0 }, { "20", 20, 0.0 }, { "100", 100, 0.0 },
  { "0.5 %", 0, 0.005 }, { "5 %", 0, 0.05 } };

class IterationsTable
{
public:
  explicit IterationsTable(const std::string& folder)
    : File(folder + "/iterations.csv",
        "surface,faces,discretisation,N,prescribed,alignment,iterations,residual,converged,"
        "cholesky_residual,note")
  {
  }

  /// One line of counts; a count in brackets stands for a solve that did not converge, and its row also has the
  /// residual that a factorisation leaves, refined as long as that helps.
  void Append(const Source& source, const FramedMesh& surface, const FieldOptions& asked,
    const std::vector<Regime>& regimes, const std::vector<double>& alignments, const ExecutionContext& context)
  {
    const std::string kind = NameOf(asked.Field.Kind);
    const int faces = surface.Mesh.NumberOfFaces();
    std::printf("%-26s %8d %-10s %d ", source.Name.c_str(), faces, kind.c_str(), asked.Field.N);
    const auto setup = test::SetupOf(surface, nullptr, asked, context);
    for (const Regime& regime : regimes)
    {
      for (const double alignment : alignments)
      {
        FieldOptions options = asked;
        if (std::isfinite(alignment))
        {
          options.Alignment = alignment;
        }
        else
        {
          options.Constraints = ConstraintKind::Hard;
        }
        const SolveReport report = Solve(surface, setup, options, regime, context);
        const int iterations = report.Iterations.empty() ? 0 : report.Iterations.back().Iteration;
        this->File.Row(source.Name, faces, kind, asked.Field.N, regime.Name, alignment, iterations, ResidualOf(report),
          report.Converged ? 1 : 0, report.Converged ? None : ResidualByCholesky(surface, options, regime, context),
          report.Warnings.empty() ? "" : report.Warnings.front());
        std::printf(report.Converged ? " %5d " : " [%4d]", iterations);
      }
    }
    std::printf("\n");
    std::fflush(stdout);
  }

private:
  static double ResidualOf(const SolveReport& report)
  {
    return report.Iterations.empty() ? None : report.Iterations.back().RelativeResidual;
  }

  static double ResidualByCholesky(
    const FramedMesh& surface, FieldOptions options, const Regime& regime, const ExecutionContext& context)
  {
    options.Solver.Kind = SolverKind::Cholesky;
    return ResidualOf(Solve(surface, nullptr, options, regime, context));
  }

  static SolveReport Solve(const FramedMesh& surface, std::shared_ptr<const MultigridSetup> setup,
    const FieldOptions& options, const Regime& regime, const ExecutionContext& context)
  {
    test::Random random(Seed);
    const auto field = MakeDiscretisation(options.Field, surface);
    const FieldConstraints constraints = RandomConstraints(surface.Mesh, *field, regime, random);
    try
    {
      test::FieldProblem problem(surface, nullptr, constraints, options, context, std::move(setup));
      problem.Solve(constraints.Values, {}, { Tolerance, 500 }, context);
      return problem.Report();
    }
    catch (const SolverFailure& failure)
    {
      SolveReport report;
      report.Warnings.push_back(failure.what());
      return report;
    }
  }

  Csv File;
};

inline void CountIterations(const Source& source, const Options& options, IterationsTable& table)
{
  const test::TbbContext context(options.Threads);
  const FramedMesh surface(source.Load(), context);
  std::vector<double> alignments = { 1.0 };
  if (options.Robustness)
  {
    alignments = { 1e-6, 1e-4, 1e-2, 1.0, 1e2, 1e4, 1e6, 1e8, 1e10, 1e12, Infinity };
  }
  for (const DiscretisationKind kind : Discretisations(options))
  {
    for (const int N : { 1, 2, 4, 6 })
    {
      const FieldOptions asked = FieldOf(kind, N);
      if (MakeDiscretisation(asked.Field, surface)->DirectionsPerPoint() == N) // or it knows no N
      {
        table.Append(source, surface, asked, options.Robustness ? Regimes : MoreRegimes, alignments, context);
      }
    }
  }
}

inline void PrintIterationsHeader(const Options& options)
{
  std::printf("%-26s %8s %-10s N  ", "surface", "faces", "discret.");
  if (options.Robustness)
  {
    std::printf("20 prescribed, alignment 1e-6, 1e-4, ..., 1e12, then hard; then 0.5 %%\n");
    return;
  }
  for (const Regime& regime : MoreRegimes)
  {
    std::printf("%6s ", regime.Name.c_str());
  }
  std::printf("\n");
}

}

#endif
