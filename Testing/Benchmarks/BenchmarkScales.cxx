// The scale filter on functions beside conjugate gradients with the diagonal as preconditioner, which ocean models use, and beside a factor.
//
//   BenchmarkScales [--limit n] SURFACE.ply...
//
// prints a row of a table for each surface, order and wavelength: iterations and processor seconds of the filter, of which "system" is what a
// wavelength costs beside the solve; the same by a factor of CHOLMOD; and iterations and seconds of the peer on the same equations, by the
// same rule to the same tolerance, at most so many (default 5000; then with a plus). The function is white noise.

#include "CommandLine.h"

#include "Mesh/SurfaceSizes.h"
#include "Operators/CotangentLaplacian.h"
#include "Preparation/PreparedSurface.h"
#include "Scales/ScaleFilter.h"
#include "Setup/SetupCache.h"
#include "Solvers/Krylov/ConjugateGradient.h"
#include "Support/MatrixOperator.h"
#include "Support/Random.h"
#include "Support/ReadPly.h"

#include <cmath>
#include <cstdio>
#include <ctime>
#include <string>

using namespace dmg;
using namespace dmg::benchmarks;

namespace
{

constexpr StoppingCriteria Stop{ 1e-6, 200 };

/// Multiplies by the inverse of a matrix's diagonal.
class Jacobi : public Preconditioner<double>
{
public:
  explicit Jacobi(const SparseMatrix<double>& A)
    : Inverse(A.diagonal().cwiseInverse())
  {
  }

  void Apply(const Vector<double>& r, Vector<double>& z, const ExecutionContext&) override
  {
    z = this->Inverse.cwiseProduct(r);
  }

private:
  const Vector<double> Inverse;
};

struct Cost
{
  int Iterations = 0;
  double System = 0.0, Solve = 0.0;
  bool Converged = false;
};

double ProcessorSeconds()
{
  return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
}

int IterationsOf(const SolveReport& report)
{
  return report.Iterations.empty() ? 0 : report.Iterations.back().Iteration;
}

Cost Ours(ScaleFilter& filter, const Vector<double>& b, double wavelength)
{
  const double start = ProcessorSeconds();
  filter.Split(b, wavelength, Stop);
  const double first = ProcessorSeconds();
  filter.Split(b, wavelength, Stop); // now the system is at hand
  const double second = ProcessorSeconds() - first;
  return { IterationsOf(filter.Report()), first - start - second, second, filter.Report().Converged };
}

/// M b by the equations of the part below, of which the product with the matrix of order 2 is that of an assembled matrix.
Cost ByDiagonal(const SparseMatrix<double>& L, const Vector<double>& M, const Vector<double>& b, double wavelength,
  int order, int limit)
{
  const double start = ProcessorSeconds();
  const double c = wavelength / (2.0 * Pi);
  SparseMatrix<double> A = 2.0 * c * c * L;
  if (order == 2)
  {
    const SparseMatrix<double> scaled = M.cwiseInverse().asDiagonal() * L;
    A = c * c * (A * scaled);
  }
  A += SparseMatrix<double>(M.asDiagonal());
  Jacobi preconditioner(A);
  const double assembled = ProcessorSeconds();
  Vector<double> x;
  SolveReport report;
  ConjugateGradient<double>(test::MatrixOperator<double>(A), preconditioner, M.cwiseProduct(b),
    { Stop.RelativeTolerance, limit }, x, report, SerialContext());
  return { IterationsOf(report), assembled - start, ProcessorSeconds() - assembled, report.Converged };
}

void Run(const std::string& path, int limit)
{
  const test::Surface given = test::ReadPly(path);
  const PreparedSurface prepared =
    PrepareSurface({ given.V, given.F, 0, static_cast<int>(given.F.rows()), {}, {} }, PreparationOptions());
  const FramedMesh surface(prepared.Mesh);
  SetupCache setups(surface);
  const SparseMatrix<double> L = CotangentLaplacian(surface.Mesh, SerialContext());
  test::Random random(7);
  Vector<double> b(surface.Mesh.NumberOfVertices());
  for (double& number : b)
  {
    number = random.Uniform(-1.0, 1.0);
  }
  const std::string name = path.substr(path.find_last_of('/') + 1);
  for (const int order : { 1, 2 })
  {
    ScaleFilterOptions options;
    options.Order = order;
    options.Solver.Kind = SolverKind::ConjugateGradients;
    ScaleFilter byCycles(setups, options);
    options.Solver.Kind = SolverKind::Cholesky;
    ScaleFilter byFactor(setups, options);
    for (const double cells : { 2.0, 10.0, 50.0, 200.0, 2000.0 })
    {
      const double wavelength = cells * SizesOf(surface.Mesh).MeanEdge;
      const Cost ours = Ours(byCycles, b, wavelength);
      const Cost factor = Ours(byFactor, b, wavelength);
      const Cost peer = ByDiagonal(L, byCycles.Areas(), b, wavelength, order, limit);
      std::printf("| %s | %d | %d | %g | %d%s | %.2f | %.2f | %d | %.2f | %.2f | %d%s | %.2f |\n", name.c_str(),
        surface.Mesh.NumberOfVertices(), order, cells, ours.Iterations, ours.Converged ? "" : "+", ours.System,
        ours.Solve, factor.Iterations, factor.System, factor.Solve, peer.Iterations, peer.Converged ? "" : "+",
        peer.System + peer.Solve);
      std::fflush(stdout);
    }
  }
}

}

int main(int argc, char* argv[])
{
  CommandLine commandLine(argc, argv);
  int limit = 5000;
  commandLine.Take("--limit", limit);
  std::printf(
    "| surface | points | order | cells | iterations | system s | solve s | by a factor | system s | solve s | "
    "by the diagonal | s |\n|---|---|---|---|---|---|---|---|---|---|---|---|\n");
  for (const std::string& path : commandLine.Paths())
  {
    try
    {
      Run(path, limit);
    }
    catch (const std::exception& error)
    {
      std::printf("| %s | %s |\n", path.c_str(), error.what());
    }
  }
  return 0;
}
