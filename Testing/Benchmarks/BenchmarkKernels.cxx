// The kernels of a solve beside the machine's memory bandwidth: the product of conjugate gradients
// and the smoother of every level, in GB/s and as a share of a copy or triad of the same run.
//
//   BenchmarkKernels [--out folder] [--runs n] [--threads n] (--short | surface.ply ...)
//
// Writes kernels.csv. For power fields the matrices are those of the default solver with 0.5 % of the
// elements prescribed: nodal levels, sorted by colours and in single precision, as its cycles have them
// (in double precision, too, for comparison), and the system's own. For 1-forms and face fields: the
// product with B^T B and the blocks of the finest level. Everything is measured with 1 thread, then with
// --threads of them.
//
// Bytes are what an algorithm must read and write if every array passes once per sweep through the
// caches: values, columns and offsets of the rows, and each vector that it reads or writes. Copy
// and triad are counted the same way (a write is one pass), on arrays of 64 MB; the better of them
// is 100 %. Levels that fit into the caches exceed it. Seconds are the best of the runs: bandwidth
// is a limit.

#include "Benchmarks/CommandLine.h"
#include "Benchmarks/Csv.h"
#include "Benchmarks/Prescriptions.h"
#include "Benchmarks/Systems.h"
#include "Benchmarks/Timing.h"
#include "HarmonicField.h"
#include "Solvers/BlockSmoother.h"
#include "Solvers/GalerkinHierarchy.h"
#include "Solvers/LeastSquaresHierarchy.h"
#include "Solvers/ScaledHierarchy.h"
#include "Solvers/Smoother.h"
#include "Support/MeshFactory.h"
#include "Support/ReadPly.h"
#include "Support/SparseAssembly.h"
#include "Support/SparseKernels.h"
#include "Support/TbbContext.h"

#include <complex>

using namespace dmg;
using namespace dmg::benchmarks;

namespace
{

constexpr int Sweeps = 2;

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
        [&a, &b](int first, int last)
        { a.segment(first, last - first) = b.segment(first, last - first); });
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
  std::printf("%d threads: copy %.1f GB/s, triad %.1f GB/s\n", context.NumberOfThreads(),
    2.0 * array / copy, 3.0 * array / triad);
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

  void Append(const std::string& kernel, int level, double rows, double nonZeros, double bytes,
    double seconds)
  {
    const double bandwidth = 1e-9 * bytes / seconds;
    this->File.Row(this->Of.Surface, this->Of.Faces, this->Of.Discretisation, kernel, level, rows,
      nonZeros / rows, this->Of.Threads, 1e-6 * bytes, 1e6 * seconds, bandwidth,
      bandwidth / this->Of.Stream);
    std::printf("%-20.20s %-10s %-26s %d %9.0f %6.1f %d %8.2f %9.0f %7.2f %5.0f %%\n",
      this->Of.Surface.c_str(), this->Of.Discretisation.c_str(), kernel.c_str(), level, rows,
      nonZeros / rows, this->Of.Threads, 1e-6 * bytes, 1e6 * seconds, bandwidth,
      100.0 * bandwidth / this->Of.Stream);
    std::fflush(stdout);
  }

private:
  Csv File;
};

template <class Scalar>
void MeasureProduct(
  const SparseMatrix<Scalar>& A, int runs, KernelsTable& table, const ExecutionContext& context)
{
  const Vector<Scalar> x = Vector<Scalar>::Random(A.cols());
  Vector<Scalar> y(A.rows());
  const double seconds = Fastest(runs, [&] { Multiply(A, x, y, context); });
  const double vectors = 2.0 * sizeof(Scalar) * static_cast<double>(A.rows());
  table.Append("product, double", 0, static_cast<double>(A.rows()),
    static_cast<double>(A.nonZeros()), BytesOf(A) + vectors, seconds);
}

/// All levels but the coarsest, which is factored.
template <class Value, class Scalar>
void MeasureSmoother(GalerkinHierarchy<Scalar>& hierarchy, const std::string& precision, int runs,
  KernelsTable& table, const ExecutionContext& context)
{
  using Scaled = ScaledHierarchy<Scalar, Value>;
  Scaled scaled(hierarchy, Scaled::Content::ColouredMatrices, context);
  SmootherOptions options;
  options.PreSweeps = options.PostSweeps = Sweeps;
  for (int l = 0; l + 1 < scaled.NumberOfLevels(); ++l)
  {
    auto& level = scaled[l];
    const double rows = static_cast<double>(level.A.Lower.rows());
    const double nonZeros =
      static_cast<double>(level.A.Lower.nonZeros() + level.A.Upper.nonZeros()) + rows;
    const double matrix = BytesOf(level.A.Lower) + BytesOf(level.A.Upper);
    const double vector = sizeof(Value) * rows;
    const auto smoother = Smoother<Value>::New(level.A, options, context);
    level.b.setRandom();
    Vector<Value> r(level.b.size());
    // A sweep passes through half the matrix, reads b, x and the sums of the sweep before, and writes x
    // and its own. Before all, x, the residual and the sums are set; after all, the residual passes
    // through the other half, and the corrected x before it.
    const double sweep = 0.5 * matrix + 5.0 * vector;
    const double before = Sweeps * sweep + 0.5 * matrix + 8.0 * vector;
    table.Append("pre-smoother, " + precision, l, rows, nonZeros, before,
      Fastest(runs, [&] { smoother->PreSmooth(level.b, level.x, r, context); }));
    const double after = Sweeps * sweep + 0.5 * matrix + 2.0 * vector;
    table.Append("post-smoother, " + precision, l, rows, nonZeros, after,
      Fastest(runs, [&] { smoother->PostSmooth(level.b, level.x, context); }));
  }
}

/// What conjugate gradients and cycles do for power fields.
void MeasurePowers(const TriangleMesh& mesh, const TangentFrames& frames,
  const ProlongationOperators& operators, const FieldOptions& field, int runs, KernelsTable& table,
  const ExecutionContext& context)
{
  test::Random random(20261121);
  const FieldConstraints constraints =
    RandomConstraints(mesh, field.Kind, { "0.5 %", 0, 0.005 }, random);
  const HarmonicSystem<Complex> system =
    MakeSystem<Complex>(mesh, frames, constraints, field, context);
  MeasureProduct(system.Matrix(), runs, table, context);
  std::vector<SparseMatrix<Complex>> prolongations;
  for (const TransportOperator& transport : operators.Nodal)
  {
    prolongations.push_back(OnPowers(transport, field.N, context));
  }
  prolongations[0] = SelectRows(prolongations[0], system.FreeUnknowns(), context);
  GalerkinHierarchy<Complex> hierarchy(
    system.Matrix(), std::move(prolongations), GalerkinOptions(), context);
  MeasureSmoother<std::complex<float>>(hierarchy, "single", runs, table, context);
  MeasureSmoother<Complex>(hierarchy, "double", runs, table, context);
}

/// What they do for 1-forms and face fields, on the finest level.
void MeasureSquares(const TriangleMesh& mesh, const TangentFrames& frames,
  const ProlongationOperators& operators, const FieldOptions& field, int runs, KernelsTable& table,
  const ExecutionContext& context)
{
  FieldOptions byCycles = field;
  byCycles.Solver.Kind = SolverKind::ConjugateGradients;
  const auto surface = MakeRoughnessSurface(mesh, frames, &operators, byCycles, context);
  const auto& hierarchy = dynamic_cast<const LeastSquaresHierarchy&>(*surface->Hierarchy);
  const double unknowns = hierarchy.NumberOfUnknowns();
  const double rows = static_cast<double>(hierarchy.B.rows());
  const double nonZeros = static_cast<double>(hierarchy.B.nonZeros());
  Vector<double> x = Vector<double>::Random(hierarchy.NumberOfUnknowns());
  Vector<double> y;

  // Before B: x and the scales are read, their product and zeros in y written. With it, once: the
  // product is read, y read and written. After it: x, y, D and the scales are read, y is written.
  const LeastSquaresOperator A(hierarchy, Vector<double>::Zero(x.size()));
  const double product = BytesOf(hierarchy.B) + sizeof(double) * 12.0 * unknowns;
  table.Append("B^T B, double", 0, unknowns, nonZeros, product,
    Fastest(runs, [&] { A.Apply(x, y, context); }));

  // A sweep reads the blocks, their inverses and columns of B, and b; and reads and writes x and B x.
  BlockSmoother smoother(hierarchy.B, hierarchy.Tiles, hierarchy.Blocks, Sweeps);
  const double sweep = static_cast<double>(hierarchy.Blocks.Bytes()) +
    sizeof(float) * (3.0 * unknowns + 2.0 * rows);
  Vector<double> r;
  // Then the residual: b; x and r are written; B and B x are read, and r once more.
  const double before = Sweeps * sweep + BytesOf(hierarchy.B) + sizeof(float) * (unknowns + rows) +
    sizeof(double) * 5.0 * unknowns;
  const Vector<double> b = Vector<double>::Random(x.size());
  table.Append("blocks, pre", 0, unknowns, nonZeros, before,
    Fastest(runs, [&] { smoother.PreSmooth(b, x, r, context); }));
  const double after = Sweeps * sweep + BytesOf(hierarchy.B) + sizeof(float) * (2.0 * unknowns + rows) +
    sizeof(double) * 4.0 * unknowns;
  table.Append("blocks, post", 0, unknowns, nonZeros, after,
    Fastest(runs, [&] { smoother.PostSmooth(b, x, context); }));

  // The interpolation, and what it reads and writes on the fine level.
  const CompactProlongation& P = hierarchy.Prolongation;
  const double interpolation = static_cast<double>(P.Bytes()) + sizeof(double) * unknowns;
  const auto entries = static_cast<double>(P.NonZeros());
  Vector<double> coarse;
  Vector<double> sums;
  table.Append("restriction", 0, unknowns, entries, interpolation,
    Fastest(runs, [&] { P.MultiplyAdjoint(b, coarse, sums, context); }));
  table.Append("prolongation", 0, unknowns, entries, interpolation + sizeof(double) * unknowns,
    Fastest(runs, [&] { P.AddProduct(coarse, x, context); }));
}

void MeasureSurface(
  const std::string& name, const TriangleMesh& mesh, const Options& options, KernelsTable& table)
{
  const test::TbbContext all(options.Threads);
  const TangentFrames frames = FaceFrames(mesh, all);
  for (int threads = 1;; threads = options.Threads)
  {
    const test::TbbContext context(threads);
    for (const Discretisation kind :
      { Discretisation::OneForm, Discretisation::FaceField, Discretisation::PowerField })
    {
      FieldOptions field;
      field.Kind = kind;
      const ProlongationOperators operators =
        BuildSurfaceHierarchy(mesh, LevelsFor(field), all, { false, false, false }).Operators;
      field.N = 2;
      const double stream = StreamBandwidth(options.Runs, context); // near what it measures
      table.Of = { name, mesh.NumberOfFaces(), NameOf(kind), threads, stream };
      const auto measure = kind == Discretisation::PowerField ? &MeasurePowers : &MeasureSquares;
      measure(mesh, frames, operators, field, options.Runs, table, context);
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
  std::printf("%-20s %-10s %-26s l %9s %6s t %8s %9s %7s %7s\n", "surface", "discret.", "kernel",
    "rows", "/row", "MB", "us", "GB/s", "share");
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
