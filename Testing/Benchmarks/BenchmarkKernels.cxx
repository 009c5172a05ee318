// The kernels of a solve beside the machine's memory bandwidth: the product of conjugate gradients
// and the smoother of every level, in GB/s and as a share of a copy or triad of the same run.
//
//   BenchmarkKernels [--out folder] [--runs n] [--threads n] (--short | surface.ply ...)
//
// Writes kernels.csv. All are those of the default solver: for power fields the product with the
// Laplacian, and the sweeps of the finest level; for 1-forms and face fields the product with B^T B, and the
// blocks of the finest level; for all three the interpolation from the finest level, and the sweeps of the
// levels below. Everything is measured with 1 thread, then with --threads of them.
//
// Bytes are what an algorithm must read and write if every array passes once per sweep through the
// caches: values, columns and offsets of the rows, and each vector that it reads or writes. Copy
// and triad are counted the same way (a write is one pass), on arrays of 64 MB; the better of them
// is 100 %. Levels that fit into the caches exceed it. Seconds are the best of the runs: bandwidth
// is a limit.

#include "Benchmarks/CommandLine.h"
#include "Benchmarks/Csv.h"
#include "Benchmarks/Prescriptions.h"
#include "Benchmarks/Timing.h"
#include "Solvers/Laplacian/LaplacianHierarchy.h"
#include "Solvers/LeastSquares/BlockSmoother.h"
#include "Solvers/LeastSquares/LeastSquaresHierarchy.h"
#include "Solvers/Multigrid/GalerkinHierarchy.h"
#include "Solvers/Multigrid/LevelStack.h"
#include "Solvers/Multigrid/Smoother.h"
#include "Support/FieldProblem.h"
#include "Support/MeshFactory.h"
#include "Support/ReadPly.h"
#include "Support/SparseKernels.h"
#include "Support/TbbContext.h"

#include <complex>

using namespace dmg;
using namespace dmg::benchmarks;

namespace
{

constexpr int Sweeps = 2;
constexpr int SweepsOfBlocks = 6; // as the solver; they follow each other in the caches

struct Options
{
  std::string Folder = ".";
  int Runs = 10;
  int Threads = 2;
};

/// Seconds of the fastest of several calls.
template <class Function>
double Fastest(int runs, const Function& function)
{
  double fastest = std::numeric_limits<double>::infinity();
  for (int run = 0; run < runs; ++run)
  {
    fastest = std::min(fastest, Seconds(function));
  }
  return fastest;
}

/// McCalpin's STREAM: GB/s of the better of a copy and a triad.
double StreamBandwidth(int runs, const ExecutionContext& context)
{
  constexpr int size = 8 << 20;
  constexpr int grain = 1 << 16;
  const Vector<double> b = Vector<double>::Random(size);
  const Vector<double> c = Vector<double>::Random(size);
  Vector<double> a = Vector<double>::Zero(size);
  const double copy = Fastest(runs,
    [&]
    {
      context.ParallelFor(0, size, grain,
        [&a, &b](int first, int last) { a.segment(first, last - first) = b.segment(first, last - first); });
    });
  const double triad = Fastest(runs,
    [&]
    {
      context.ParallelFor(0, size, grain,
        [&a, &b, &c](int first, int last)
        {
          const int count = last - first;
          a.segment(first, count) = b.segment(first, count) + 3.0 * c.segment(first, count);
        });
    });
  const double array = 1e-9 * sizeof(double) * size;
  std::printf("%d threads: copy %.1f GB/s, triad %.1f GB/s\n", context.NumberOfThreads(), 2.0 * array / copy,
    3.0 * array / triad);
  return std::max(2.0 * array / copy, 3.0 * array / triad);
}

template <class Value>
double BytesOf(const SparseMatrix<Value>& A)
{
  return static_cast<double>(A.nonZeros()) * (sizeof(Value) + sizeof(int)) +
    (static_cast<double>(A.rows()) + 1.0) * sizeof(int);
}

class KernelsTable
{
public:
  explicit KernelsTable(const std::string& folder)
    : File(folder + "/kernels.csv",
        "surface,faces,discretisation,kernel,level,rows,entries_per_row,threads,mb,microseconds,"
        "gb_per_second,share_of_stream")
  {
  }

  /// The surface and system that the next rows belong to, and the bandwidth they are compared with.
  struct Heading
  {
    std::string Surface;
    int Faces;
    std::string Discretisation;
    int Threads;
    double Stream;
  };
  Heading Of;

  void Append(const std::string& kernel, int level, double rows, double nonZeros, double bytes, double seconds)
  {
    const double bandwidth = 1e-9 * bytes / seconds;
    this->File.Row(this->Of.Surface, this->Of.Faces, this->Of.Discretisation, kernel, level, rows, nonZeros / rows,
      this->Of.Threads, 1e-6 * bytes, 1e6 * seconds, bandwidth, bandwidth / this->Of.Stream);
    std::printf("%-20.20s %-10s %-26s %d %9.0f %6.1f %d %8.2f %9.0f %7.2f %5.0f %%\n", this->Of.Surface.c_str(),
      this->Of.Discretisation.c_str(), kernel.c_str(), level, rows, nonZeros / rows, this->Of.Threads, 1e-6 * bytes,
      1e6 * seconds, bandwidth, 100.0 * bandwidth / this->Of.Stream);
    std::fflush(stdout);
  }

private:
  Csv File;
};

/// The product of conjugate gradients, and the bytes that it reads and writes.
void MeasureProduct(const std::string& name, const StiffnessHierarchy& hierarchy, double rows, double nonZeros,
  double bytes, int runs, KernelsTable& table, const ExecutionContext& context)
{
  const int unknowns = hierarchy.NumberOfUnknowns();
  const auto A = hierarchy.Operator();
  const Vector<double> x = Vector<double>::Random(unknowns);
  Vector<double> y;
  table.Append(name, 0, rows, nonZeros, bytes, Fastest(runs, [&] { A->Apply(x, y, context); }));
}

/// Both directions, and what they read and write on the fine level.
template <class Coarse, class Fine, class Sum>
void MeasureInterpolation(
  const SingleProlongation& P, Coarse coarse, int runs, KernelsTable& table, const ExecutionContext& context)
{
  Vector<Fine> fine = Vector<Fine>::Random(P.Rows());
  Vector<Sum> sums;
  const double rows = P.Rows();
  const auto entries = static_cast<double>(P.NonZeros());
  const double bytes = static_cast<double>(P.Bytes()) + sizeof(Fine) * rows;
  table.Append(
    "restriction", 0, rows, entries, bytes, Fastest(runs, [&] { P.MultiplyAdjoint(fine, coarse, sums, context); }));
  table.Append("prolongation", 0, rows, entries, bytes + sizeof(Fine) * rows,
    Fastest(runs, [&] { P.AddProduct(coarse, fine, context); }));
}

constexpr SmootherOptions SweepsOfLevels()
{
  SmootherOptions options;
  options.PreSweeps = options.PostSweeps = Sweeps;
  return options;
}

/// \param smoother for A, by SweepsOfLevels.
template <class Value>
void MeasureSweeps(const TriangularParts<Value>& A, Smoother<Value>& smoother, int level, int runs, KernelsTable& table,
  const ExecutionContext& context)
{
  const double rows = static_cast<double>(A.Lower.rows());
  const double nonZeros = static_cast<double>(A.Lower.nonZeros() + A.Upper.nonZeros()) + rows;
  const double matrix = BytesOf(A.Lower) + BytesOf(A.Upper);
  const double vector = sizeof(Value) * rows;
  const Vector<Value> b = Vector<Value>::Random(A.Lower.rows());
  Vector<Value> x(b.size());
  // A sweep passes through half the matrix, reads the diagonal, b, x and the sums of the sweep before, and
  // writes x and its own, but for the last one. Before all, the sums are set; after all, the residual, in
  // place of the sums, passes through the other half, and the corrected x before it.
  const double sweep = 0.5 * matrix + 5.5 * vector;
  const double before = Sweeps * sweep + 0.5 * matrix + 3.0 * vector;
  table.Append("sweeps, pre", level, rows, nonZeros, before, Fastest(runs, [&] { smoother.PreSmooth(b, x, context); }));
  const double after = Sweeps * sweep + 0.5 * matrix + 2.0 * vector;
  table.Append(
    "sweeps, post", level, rows, nonZeros, after, Fastest(runs, [&] { smoother.PostSmooth(b, x, context); }));
}

/// The levels below the finest but the coarsest, which is factored.
/// \param lower of the first of them.
template <class Value, class Scalar>
void MeasureCoarseLevels(const SparseMatrix<Scalar>& lower, const std::vector<SparseMatrix<Scalar>>& coarser, int runs,
  KernelsTable& table, const ExecutionContext& context)
{
  GalerkinHierarchy<Scalar> hierarchy(SymmetricFromLower(lower, context), coarser, GalerkinOptions(), context);
  LevelStack<Scalar, Value> levels(hierarchy, SweepsOfLevels(), 1, context);
  for (int l = 0; l + 1 < levels.NumberOfLevels(); ++l)
  {
    const auto smoother = Smoother<Value>::New(levels[l].A, SweepsOfLevels());
    MeasureSweeps(levels[l].A, *smoother, l + 1, runs, table, context);
  }
}

/// What conjugate gradients and cycles do for power fields.
void MeasurePowers(const LaplacianHierarchy& hierarchy, int runs, KernelsTable& table, const ExecutionContext& context)
{
  MeasureProduct("product, double", hierarchy, hierarchy.Rows(), static_cast<double>(hierarchy.L.nonZeros()),
    BytesOf(hierarchy.L) + 2.0 * sizeof(double) * hierarchy.NumberOfUnknowns(), runs, table, context);
  MeasureInterpolation<Vector<Complex>, std::complex<float>, float>(
    hierarchy.Prolongation, Vector<Complex>(hierarchy.CoarseLower.rows()), runs, table, context);
  const Vector<float> inverseDiagonal = hierarchy.L.diagonal().real().cwiseInverse().cast<float>();
  const auto smoother =
    Smoother<std::complex<float>>::NewWithDiagonal(hierarchy.Sweeps, inverseDiagonal, SweepsOfLevels());
  MeasureSweeps(hierarchy.Sweeps, *smoother, 0, runs, table, context);
  MeasureCoarseLevels<std::complex<float>>(hierarchy.CoarseLower, hierarchy.Coarser, runs, table, context);
}

/// What they do for 1-forms and face fields.
void MeasureSquares(
  const LeastSquaresHierarchy& hierarchy, int runs, KernelsTable& table, const ExecutionContext& context)
{
  const double unknowns = hierarchy.NumberOfUnknowns();
  const double rows = static_cast<double>(hierarchy.B.rows());
  const double nonZeros = static_cast<double>(hierarchy.B.nonZeros());

  // Before B: x and the scales are read, their product and zeros in y written. With it, once: the
  // product is read, y read and written. After it: y and the scales are read, y is written.
  MeasureProduct("B^T B, double", hierarchy, unknowns, nonZeros,
    BytesOf(hierarchy.B) + sizeof(double) * 10.0 * unknowns, runs, table, context);

  // A sweep reads the blocks, their inverses and columns of B, D and b; and reads and writes x and B x.
  BlockSmoother smoother(
    hierarchy.B, hierarchy.Tiles, hierarchy.Blocks, Vector<double>::Zero(hierarchy.B.cols()), SweepsOfBlocks, context);
  const double sweep = static_cast<double>(smoother.Bytes()) +
    sizeof(int) * static_cast<double>(hierarchy.Blocks.Unknowns.size()) + sizeof(float) * (unknowns + rows);
  Vector<double> x, r;
  // Then the residual: x, D and b are read; x and r are written; B and B x are read, and r once more.
  const double before = SweepsOfBlocks * sweep + BytesOf(hierarchy.B) + sizeof(float) * (2.0 * unknowns + rows) +
    sizeof(double) * 5.0 * unknowns;
  const Vector<double> b = Vector<double>::Random(hierarchy.NumberOfUnknowns());
  table.Append(
    "blocks, pre", 0, unknowns, nonZeros, before, Fastest(runs, [&] { smoother.PreSmooth(b, x, r, context); }));
  // Or before it B x, and b; and then x is read and written.
  const double after = SweepsOfBlocks * sweep + BytesOf(hierarchy.B) + sizeof(float) * (2.0 * unknowns + rows) +
    sizeof(double) * 4.0 * unknowns;
  table.Append(
    "blocks, post", 0, unknowns, nonZeros, after, Fastest(runs, [&] { smoother.PostSmooth(b, x, context); }));

  MeasureInterpolation<Vector<double>, double, double>(
    hierarchy.Prolongation, Vector<double>(hierarchy.CoarseLower.rows()), runs, table, context);
  MeasureCoarseLevels<float>(hierarchy.CoarseLower, hierarchy.Coarser, runs, table, context);
}

void MeasureSurface(const std::string& name, const TriangleMesh& mesh, const Options& options, KernelsTable& table)
{
  const test::TbbContext all(options.Threads);
  const FramedMesh surface(mesh, all);
  for (int threads = 1;; threads = options.Threads)
  {
    const test::TbbContext context(threads);
    for (const DiscretisationKind kind :
      { DiscretisationKind::OneForm, DiscretisationKind::FaceField, DiscretisationKind::PowerField })
    {
      FieldOptions field;
      field.Field.Kind = kind;
      field.Field.N = 2;
      field.Solver.Kind = SolverKind::ConjugateGradients;
      const auto setup = test::SetupOf(surface, nullptr, field, all);
      const double stream = StreamBandwidth(options.Runs, context); // near what it measures
      table.Of = { name, mesh.NumberOfFaces(), NameOf(kind), threads, stream };
      if (const auto* const powers = dynamic_cast<const LaplacianHierarchy*>(setup->Hierarchy.get()))
      {
        MeasurePowers(*powers, options.Runs, table, context);
      }
      else
      {
        MeasureSquares(dynamic_cast<const LeastSquaresHierarchy&>(*setup->Hierarchy), options.Runs, table, context);
      }
    }
    if (threads == options.Threads)
    {
      break;
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
  const bool isShort = words.Take("--short");
  const std::vector<std::string> paths = words.Paths();
  if (words.HasUnknown() || paths.empty() != isShort || options.Runs < 1 || options.Threads < 1)
  {
    std::fprintf(stderr,
      "usage: BenchmarkKernels [--out folder] [--runs n] [--threads n] (--short | surface.ply "
      "...)\n");
    return 2;
  }
  PrintMachine(options.Threads, options.Runs);
  std::printf("%-20s %-10s %-26s l %9s %6s t %8s %9s %7s %7s\n", "surface", "discret.", "kernel", "rows", "/row", "MB",
    "us", "GB/s", "share");
  KernelsTable table(options.Folder);
  if (isShort)
  {
    MeasureSurface("torus", test::IrregularTorus(96, 40, 7).Mesh(), options, table);
  }
  for (const std::string& path : paths)
  {
    MeasureSurface(BaseName(path), test::ReadPly(path).Mesh(), options, table);
  }
  return 0;
}
