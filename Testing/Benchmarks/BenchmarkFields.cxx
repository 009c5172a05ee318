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
#include "Benchmarks/OwnProcess.h"
#include "Benchmarks/PeakMemory.h"
#include "Benchmarks/Peers/AlgebraicMultigridPeers.h"
#include "Benchmarks/Peers/DirectPeers.h"
#include "Benchmarks/Peers/IncompleteCholeskyPeer.h"
#include "Benchmarks/Peers/RealForm.h"
#include "Benchmarks/Peers/SimplicialCholmodPeer.h"
#include "Benchmarks/Prescriptions.h"
#include "Benchmarks/Systems.h"
#include "Benchmarks/Timing.h"
#include "Discretisations/MakeDiscretisation.h"
#include "Operators/FaceFieldOperators.h"
#include "Support/AllIndices.h"
#include "Support/ComplexPairs.h"
#include "Support/FieldProblem.h"
#include "Support/MeshFactory.h"
#include "Support/ReadPly.h"
#include "Support/ReferenceOperators.h"
#include "Support/TbbContext.h"

#include <cmath>
#include <cstring>
#include <functional>
#include <limits>
#include <optional>
#include <type_traits>
#include <utility>

using namespace dmg;
using namespace dmg::benchmarks;

namespace
{

constexpr double Tolerance = 1e-8;
constexpr double LoosenedTolerance = 1e-3; // of a solution that is followed while a constraint moves
constexpr double LargestDifference = 1e-6;
constexpr double LongRun = 20.0; // seconds
constexpr double None = std::numeric_limits<double>::quiet_NaN();
constexpr double Infinity = std::numeric_limits<double>::infinity();
constexpr unsigned Seed = 20261121;

const std::vector<Regime> Regimes = { { "20", 20, 0.0 }, { "0.5 %", 0, 0.005 } };
const std::vector<Regime> MoreRegimes = { { "1", 1, 0.0 }, { "20", 20, 0.0 }, { "100", 100, 0.0 },
  { "0.5 %", 0, 0.005 }, { "5 %", 0, 0.05 } };

const char* const Ours = "ours";
const char* const Reference = "CHOLMOD, AMD";
const char* const GeometryCentral = "geometry-central's factor";

struct Options
{
  std::string Folder = ".";
  int Runs = 3;
  int Threads = 2;
  int Limit = 600; // seconds, of all runs of a solver
  int Cuts = 0;    // 1:4, before anything else
  int LoopCuts = 0;
  bool IterationsOnly = false;
  bool Robustness = false;
  std::string Discretisation;
  std::string Solver;
};

struct Source
{
  std::string Name;
  std::function<TriangleMesh()> Load;
};

/// A file, cut as the options say.
Source SourceOf(const std::string& path, const Options& options)
{
  std::string name = BaseName(path);
  for (const auto& [times, how] : { std::pair(options.Cuts, ", cut 1:4"), std::pair(options.LoopCuts, ", Loop") })
  {
    name += times == 0 ? "" : how + std::string(times == 1 ? "" : " x " + std::to_string(times));
  }
  return { name,
    [path, cuts = options.Cuts, loopCuts = options.LoopCuts]
    {
      test::Surface surface = test::ReadPly(path);
      for (int k = 0; k < cuts; ++k)
      {
        surface = test::Subdivide(surface);
      }
      for (int k = 0; k < loopCuts; ++k)
      {
        surface = test::SubdivideByLoop(surface);
      }
      return surface.Mesh();
    } };
}

/// One system on one surface.
struct Job
{
  Source Surface;
  FieldOptions Asked;
  Regime Prescribed;
};

// Surfaces and systems --------------------------------------------------------------------------

/// What a process needs to solve a job.
struct Workplace
{
  Workplace(const Job& job, const Options& options)
    : Context(options.Threads)
    , Surface(job.Surface.Load(), this->Context)
    , Asked(job.Asked)
    , Field(MakeDiscretisation(job.Asked.Field, this->Surface))
  {
    UseBlasThreads(options.Threads);
    test::Random random(Seed);
    this->Constraints = RandomConstraints(this->Surface.Mesh, *this->Field, job.Prescribed, random);
  }
  Workplace(const Workplace&) = delete; // the field refers to the surface
  Workplace& operator=(const Workplace&) = delete;

  /// Whether the unknowns are the parts of complex numbers.
  bool IsComplex() const { return this->Field->NumberOfEquations() < this->Field->NumberOfUnknowns(); }

  test::TbbContext Context;
  FramedMesh Surface;
  FieldOptions Asked;
  std::unique_ptr<const Discretisation> Field;
  FieldConstraints Constraints;
};

template <class Scalar>
Vector<Scalar> ValuesOf(const FieldConstraints& constraints)
{
  if constexpr (std::is_same<Scalar, Complex>::value)
  {
    return AsComplex(constraints.Values);
  }
  else
  {
    return constraints.Values;
  }
}

Vector<double> AsReal(const Vector<double>& x)
{
  return x;
}
Vector<double> AsReal(const Vector<Complex>& x)
{
  return AsPairs(x);
}

double RelativeDifference(const Vector<double>& x, const Vector<double>& reference)
{
  return (x - reference).norm() / reference.norm();
}

/// What coarse spaces shall contain: the coordinate fields, projected to the surface, as unknowns of a discretisation,
/// a column each; of functions, the constants.
Eigen::MatrixXd SmoothFields(const FramedMesh& surface, const Discretisation& field)
{
  if (field.UnknownsPerElement() == 1 && field.Elements() == ElementKind::Vertices)
  {
    return Eigen::MatrixXd::Ones(field.NumberOfUnknowns(), 1);
  }
  const bool areVertices = field.Elements() == ElementKind::Vertices;
  Eigen::MatrixXd fields(field.NumberOfUnknowns(), 3);
  for (int k = 0; k < 3; ++k)
  {
    Points constant = Points::Zero(areVertices ? surface.Mesh.NumberOfVertices() : surface.Mesh.NumberOfFaces(), 3);
    constant.col(k).setOnes();
    if (field.Elements() == ElementKind::Edges)
    {
      fields.col(k) = test::FormFromFaceVectors(surface.Mesh, constant);
      continue;
    }
    Vector<Complex> vectors = AsComplex(FaceFieldFromVectors(areVertices ? surface.Vertices : surface.Faces, constant));
    for (Complex& v : vectors)
    {
      v = std::polar(std::abs(v), field.DirectionsPerPoint() * std::arg(v));
    }
    fields.col(k) = AsPairs(vectors);
  }
  return fields;
}

// Peers -------------------------------------------------------------------------------------------

std::vector<std::string> Solvers(DiscretisationKind kind)
{
  std::vector<std::string> names = { Reference, Ours, "CHOLMOD, METIS", "IC(0)-CG, RCM", "Eigen SimplicialLDLT",
    "hypre BoomerAMG", "PETSc GAMG" };
  if (kind == DiscretisationKind::OneForm)
  {
    names.insert(names.end() - 1, "hypre AMS");
  }
  if (kind == DiscretisationKind::PowerField || kind == DiscretisationKind::VertexPowerField)
  {
    names.insert(names.begin() + 3, GeometryCentral);
  }
  return names;
}

/// \return null for a library that is not there.
std::unique_ptr<peers::Peer<double>> NewRealPeer(
  const std::string& name, const Workplace& place, const std::vector<int>& unknowns)
{
  const int numbersPerElement = place.Field->UnknownsPerElement();
  const TriangleMesh& mesh = place.Surface.Mesh;
  if (name == "Eigen SimplicialLDLT")
  {
    return std::make_unique<peers::SimplicialPeer<double>>();
  }
  if (name == "hypre BoomerAMG")
  {
    return peers::NewBoomerAmgPeer(numbersPerElement);
  }
  if (name == "hypre AMS")
  {
    return peers::NewAmsPeer(SelectRows(D0(mesh, place.Context), unknowns, place.Context), mesh.VertexPositions());
  }
  const Eigen::MatrixXd fields = SmoothFields(place.Surface, *place.Field);
  return peers::NewGamgPeer(numbersPerElement, fields(unknowns, All));
}

template <class Scalar>
std::unique_ptr<peers::Peer<Scalar>> NewPeer(
  const std::string& name, const Workplace& place, const HarmonicSystem<Scalar>& system)
{
  if (name == "CHOLMOD, AMD" || name == "CHOLMOD, METIS")
  {
    return std::make_unique<peers::CholmodPeer<Scalar>>(
      name == "CHOLMOD, AMD" ? FillOrdering::AMD : FillOrdering::METIS);
  }
  if (name == GeometryCentral)
  {
    return std::make_unique<peers::SimplicialCholmodPeer<Scalar>>();
  }
  if (name == "IC(0)-CG, RCM")
  {
    return std::make_unique<peers::IncompleteCholeskyPeer<Scalar>>();
  }
  if constexpr (std::is_same<Scalar, Complex>::value)
  {
    auto real = NewRealPeer(name, place, PairsOf(system.FreeUnknowns()));
    return real ? std::make_unique<peers::RealFormPeer>(std::move(real)) : nullptr;
  }
  else
  {
    return NewRealPeer(name, place, system.FreeUnknowns());
  }
}

// What one solver takes ---------------------------------------------------------------------------

struct Row
{
  enum Stage
  {
    Setup,
    Assembly,
    Prepare,
    Solve,
    NumberOfStages,
  };
  using Times = std::array<double, NumberOfStages>;

  int Faces = 0;
  int Unknowns = 0;
  int Runs = 0;
  int Iterations = 0;
  Times Seconds = {};
  double Residual = None;
  double Held = None; // MB
  double Peak = None;
  double Process = None;

  double Total() const { return this->Seconds[Assembly] + this->Seconds[Prepare] + this->Seconds[Solve]; }
  double Bare() const { return this->Seconds[Setup] + this->Total(); }
};
static_assert(std::is_trivially_copyable<Row>::value, "it goes through a pipe as it is");

struct Measured
{
  Row Numbers;
  std::string Note;        ///< why it did not get there, or empty
  Vector<double> Solution; ///< all unknowns; empty if there is none

  std::string Pack() const
  {
    std::string bytes(reinterpret_cast<const char*>(&this->Numbers), sizeof(Row));
    bytes += this->Note + '\0';
    bytes.append(reinterpret_cast<const char*>(this->Solution.data()),
      static_cast<std::size_t>(this->Solution.size()) * sizeof(double));
    return bytes;
  }

  static Measured Unpack(const std::string& bytes)
  {
    Measured measured;
    std::memcpy(&measured.Numbers, bytes.data(), sizeof(Row));
    measured.Note = bytes.c_str() + sizeof(Row);
    const std::size_t begin = sizeof(Row) + measured.Note.size() + 1;
    measured.Solution.resize(static_cast<Eigen::Index>((bytes.size() - begin) / sizeof(double)));
    std::memcpy(measured.Solution.data(), bytes.data() + begin, bytes.size() - begin);
    return measured;
  }
};

/// Medians of stages over runs, of which there are fewer where one takes long.
/// \param run called as run(Row::Times&) to set the seconds of each stage.
template <class Run>
void MeasureRuns(int runs, Row& row, const Run& run)
{
  std::array<std::vector<double>, Row::NumberOfStages> seconds;
  double spent = 0.0;
  for (row.Runs = 0; row.Runs < runs && spent < LongRun; ++row.Runs)
  {
    Row::Times times = {};
    run(times);
    for (int stage = 0; stage < Row::NumberOfStages; ++stage)
    {
      seconds[stage].push_back(times[stage]);
      spent += times[stage];
    }
  }
  std::transform(seconds.begin(), seconds.end(), row.Seconds.begin(), &Median);
}

/// For their time: the bare mesh has none.
void MakeFrames(const Workplace& place)
{
  FaceFrames(place.Surface.Mesh, place.Context);
  if (place.Asked.Field.Kind == DiscretisationKind::VertexPowerField)
  {
    VertexFrames(place.Surface.Mesh, place.Context);
  }
}

Measured MeasureOurs(const Workplace& place, const Options& options)
{
  Measured measured;
  Row& row = measured.Numbers;
  row.Faces = place.Surface.Mesh.NumberOfFaces();
  std::optional<test::FieldProblem> problem;
  MeasureRuns(options.Runs, row,
    [&](Row::Times& seconds)
    {
      problem.reset();
      std::shared_ptr<const MultigridSetup> setup;
      seconds[Row::Setup] = Seconds(
        [&]
        {
          MakeFrames(place);
          setup = test::SetupOf(place.Surface, nullptr, place.Asked, place.Context);
        });
      const PeakMemory memory;
      seconds[Row::Prepare] =
        Seconds([&] { problem.emplace(place.Surface, nullptr, place.Constraints, place.Asked, place.Context, setup); });
      seconds[Row::Solve] = Seconds(
        [&] {
          measured.Solution = problem->Solve(place.Constraints.Values, {}, { Tolerance, 1000 }, place.Context);
        });
      row.Peak = memory.Growth();
      row.Process = memory.OfProcess();
    });
  const SolveReport& report = problem->Report();
  row.Unknowns = static_cast<int>(measured.Solution.size());
  row.Iterations = report.Iterations.back().Iteration;
  row.Residual = report.Iterations.back().RelativeResidual;
  row.Held = 1e-6 * static_cast<double>(report.Bytes);
  measured.Note = report.Warnings.empty() ? "" : report.Warnings.front();
  return measured;
}

template <class Scalar>
Measured MeasurePeer(const Workplace& place, const std::string& name, const Options& options)
{
  Measured measured;
  Row& row = measured.Numbers;
  row.Faces = place.Surface.Mesh.NumberOfFaces();
  const Vector<Scalar> values = ValuesOf<Scalar>(place.Constraints);
  std::unique_ptr<peers::Peer<Scalar>> peer;
  std::optional<HarmonicSystem<Scalar>> system;
  MeasureRuns(options.Runs, row,
    [&](Row::Times& seconds)
    {
      peer.reset();
      seconds[Row::Assembly] = Seconds(
        [&]
        {
          MakeFrames(place);
          system.emplace(
            MakeSystem<Scalar>(place.Surface, *place.Field, place.Constraints, place.Asked, place.Context));
        });
      const Vector<Scalar> b = system->RightHandSide(values);
      peer = NewPeer(name, place, *system);
      if (!peer)
      {
        throw SolverFailure("not built");
      }
      Vector<Scalar> x;
      const PeakMemory memory;
      seconds[Row::Prepare] = Seconds([&] { peer->Prepare(system->Matrix()); });
      seconds[Row::Solve] = Seconds([&] { row.Iterations = peer->Solve(b, Tolerance, x); });
      row.Peak = memory.Growth();
      row.Process = memory.OfProcess();
      row.Residual = (b - system->Matrix() * x).norm() / b.norm();
      measured.Solution = AsReal(system->Expand(x, values));
    });
  row.Unknowns = static_cast<int>(measured.Solution.size());
  row.Held = peer->Bytes() > 0 ? 1e-6 * static_cast<double>(peer->Bytes()) : None;
  return measured;
}

Measured Measure(const Job& job, const std::string& solver, const Options& options)
{
  const ProcessOutcome outcome = InOwnProcess(options.Limit,
    [&]
    {
      const Workplace place(job, options);
      const Measured measured = solver == Ours ? MeasureOurs(place, options)
        : place.IsComplex()                    ? MeasurePeer<Complex>(place, solver, options)
                                               : MeasurePeer<double>(place, solver, options);
      return measured.Pack();
    });
  if (!outcome.Failure.empty())
  {
    Measured measured;
    measured.Note = outcome.Failure;
    return measured;
  }
  return Measured::Unpack(outcome.Result);
}

// What a second solve takes -----------------------------------------------------------------------

/// Names are literals, which stand at the same place in every process that starts as a copy of
/// another.
struct Resolve
{
  const char* Change;
  const char* Solver;
  double Prepare;
  double Solve;
  int Iterations;
  double Residual;      ///< |b - A x| / |b|
  double Error;         ///< |x - y| / |y|, y the new solution
  double ErrorOfChange; ///< |x - y| / |y - z|, z the old one
};
static_assert(std::is_trivially_copyable<Resolve>::value, "it goes through a pipe as it is");

/// A tenth of a radian, of the edge's length, or of the largest value at a vertex.
Vector<double> WithFirstValueMoved(const Workplace& place)
{
  Vector<double> values = place.Constraints.Values;
  if (place.Field->UnknownsPerElement() == 2)
  {
    values.head<2>() = Eigen::Rotation2Dd(0.1) * Vector2(values.head<2>());
  }
  else if (place.Field->Elements() == ElementKind::Edges)
  {
    const TriangleMesh& mesh = place.Surface.Mesh;
    const auto [i, j] = mesh.EdgeVertices(place.Constraints.Elements[0]);
    values[0] += 0.1 * (mesh.Position(j) - mesh.Position(i)).norm();
  }
  else
  {
    values[0] += 0.1;
  }
  return values;
}

template <class Scalar>
class ResolveMeasurement
{
public:
  ResolveMeasurement(const Workplace& place, int runs)
    : Place(place)
    , Runs(runs)
    , Setup(test::SetupOf(place.Surface, nullptr, place.Asked, place.Context))
    , System(this->SystemOf(place.Constraints, place.Asked))
    , Cholesky(this->System.Matrix())
    , Problem(place.Surface, nullptr, place.Constraints, place.Asked, place.Context, this->Setup)
  {
    this->Old = this->Solve(place.Constraints.Values, {}, Tolerance);
    this->OldExact = this->SolveExactly(this->System, place.Constraints.Values);
  }

  std::vector<Resolve> Measure()
  {
    this->MoveValue();
    FieldOptions heavier = this->Place.Asked;
    heavier.Alignment *= 2.0;
    this->ChangeSystemTo("weights", this->Place.Constraints, heavier);
    test::Random random(Seed + 1);
    const Regime asMany = { "", static_cast<int>(this->Place.Constraints.Elements.size()), 0.0 };
    this->ChangeSystemTo("prescribed set",
      RandomConstraints(this->Place.Surface.Mesh, *this->Place.Field, asMany, random), this->Place.Asked);
    return std::move(this->Rows);
  }

private:
  HarmonicSystem<Scalar> SystemOf(const FieldConstraints& constraints, const FieldOptions& asked) const
  {
    return MakeSystem<Scalar>(this->Place.Surface, *this->Place.Field, constraints, asked, this->Place.Context);
  }

  Vector<double> Solve(const Vector<double>& values, const Vector<double>& start, double tolerance)
  {
    return this->Problem.Solve(values, start, { tolerance, 1000 }, this->Place.Context);
  }

  Vector<double> SolveExactly(const HarmonicSystem<Scalar>& system, const Vector<double>& values)
  {
    const Vector<Scalar> y = ValuesOf<Scalar>({ {}, {}, values });
    Vector<Scalar> x;
    this->Cholesky.Solve(system.RightHandSide(y), x);
    return AsReal(system.Expand(x, y));
  }

  double ResidualOf(const HarmonicSystem<Scalar>& system, const Vector<double>& values, const Vector<double>& all) const
  {
    const Vector<Scalar> b = system.RightHandSide(ValuesOf<Scalar>({ {}, {}, values }));
    const Vector<Scalar> x = system.Restrict(ValuesOf<Scalar>({ {}, {}, all }));
    return (b - system.Matrix() * x).norm() / b.norm();
  }

  void MoveValue()
  {
    const Vector<double> values = WithFirstValueMoved(this->Place);
    Vector<double> exact;
    std::vector<double> seconds;
    for (int run = 0; run < this->Runs; ++run)
    {
      seconds.push_back(Seconds([&] { exact = this->SolveExactly(this->System, values); }));
    }
    this->Append("value", "CHOLMOD, back-substitution", 0.0, Median(seconds), 0, this->System, values, exact, exact);
    for (const auto& [name, tolerance] :
      { std::pair{ "ours, warm, to 1e-3", LoosenedTolerance }, std::pair{ "ours, warm, to 1e-8", Tolerance } })
    {
      seconds.clear();
      Vector<double> x;
      for (int run = 0; run < this->Runs; ++run)
      {
        const double limit = tolerance;
        seconds.push_back(Seconds([&] { x = this->Solve(values, this->Old, limit); }));
      }
      this->Append("value", name, 0.0, Median(seconds), this->LastIteration(), this->System, values, x, exact);
    }
  }

  void ChangeSystemTo(const char* change, const FieldConstraints& constraints, const FieldOptions& asked)
  {
    const HarmonicSystem<Scalar> system = this->SystemOf(constraints, asked);
    std::vector<double> prepare;
    std::vector<double> solve;
    Vector<double> exact;
    for (int run = 0; run < this->Runs; ++run)
    {
      prepare.push_back(Seconds([&] { this->Cholesky.Update(system.Matrix()); }));
      solve.push_back(Seconds([&] { exact = this->SolveExactly(system, constraints.Values); }));
    }
    this->Append(change, "CHOLMOD, numeric factorisation", Median(prepare), Median(solve), 0, system,
      constraints.Values, exact, exact);
    prepare.clear();
    solve.clear();
    Vector<double> x;
    for (int run = 0; run < this->Runs; ++run)
    {
      prepare.push_back(Seconds([&] { this->Problem.Update(constraints, asked, this->Place.Context); }));
      solve.push_back(Seconds([&] { x = this->Solve(constraints.Values, this->Old, Tolerance); }));
    }
    this->Append(change, "ours, warm, to 1e-8", Median(prepare), Median(solve), this->LastIteration(), system,
      constraints.Values, x, exact);
  }

  int LastIteration() const { return this->Problem.Report().Iterations.back().Iteration; }

  void Append(const char* change, const char* solver, double prepare, double solve, int iterations,
    const HarmonicSystem<Scalar>& system, const Vector<double>& values, const Vector<double>& x,
    const Vector<double>& exact)
  {
    this->Rows.push_back({ change, solver, prepare, solve, iterations, this->ResidualOf(system, values, x),
      RelativeDifference(x, exact), (x - exact).norm() / (exact - this->OldExact).norm() });
  }

  const Workplace& Place;
  const int Runs;
  const std::shared_ptr<const MultigridSetup> Setup;
  const HarmonicSystem<Scalar> System;
  CholeskySolver<Scalar> Cholesky;
  test::FieldProblem Problem;
  Vector<double> Old;
  Vector<double> OldExact;
  std::vector<Resolve> Rows;
};

std::vector<Resolve> MeasureResolves(const Job& job, const Options& options, std::string& failure)
{
  const ProcessOutcome outcome = InOwnProcess(options.Limit,
    [&]
    {
      const Workplace place(job, options);
      const std::vector<Resolve> rows = place.IsComplex() ? ResolveMeasurement<Complex>(place, options.Runs).Measure()
                                                          : ResolveMeasurement<double>(place, options.Runs).Measure();
      return std::string(reinterpret_cast<const char*>(rows.data()), rows.size() * sizeof(Resolve));
    });
  failure = outcome.Failure;
  std::vector<Resolve> rows(outcome.Result.size() / sizeof(Resolve));
  std::memcpy(rows.data(), outcome.Result.data(), outcome.Result.size());
  return rows;
}

// Tables ------------------------------------------------------------------------------------------

FieldOptions FieldOf(DiscretisationKind kind, int N = 2)
{
  FieldOptions options;
  options.Field.Kind = kind;
  options.Field.N = N;
  options.Solver.Kind = SolverKind::ConjugateGradients;
  return options;
}

std::vector<DiscretisationKind> Discretisations(const Options& options)
{
  std::vector<DiscretisationKind> kinds;
  for (const DiscretisationKind kind : { DiscretisationKind::OneForm, DiscretisationKind::FaceField,
         DiscretisationKind::PowerField, DiscretisationKind::VertexPowerField, DiscretisationKind::ScalarFunction })
  {
    if (NameOf(kind).find(options.Discretisation) != std::string::npos)
    {
      kinds.push_back(kind);
    }
  }
  return kinds;
}

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

class ResolvesTable
{
public:
  explicit ResolvesTable(const std::string& folder)
    : File(folder + "/resolves.csv",
        "surface,discretisation,prescribed,change,solver,prepare,solve,iterations,residual,error,"
        "error_of_change")
  {
  }

  void Append(const Job& job, const std::vector<Resolve>& rows)
  {
    for (const Resolve& row : rows)
    {
      const std::string kind = NameOf(job.Asked.Field.Kind);
      this->File.Row(job.Surface.Name, kind, job.Prescribed.Name, row.Change, row.Solver, row.Prepare, row.Solve,
        row.Iterations, row.Residual, row.Error, row.ErrorOfChange);
      std::printf("%-20.20s %-10s %-5s changed %-14s %-30s %7.3f + %7.3f %4d  residual %.1e, error "
                  "%.1e, of the change %.1e\n",
        job.Surface.Name.c_str(), kind.c_str(), job.Prescribed.Name.c_str(), row.Change, row.Solver, row.Prepare,
        row.Solve, row.Iterations, row.Residual, row.Error, row.ErrorOfChange);
    }
    std::fflush(stdout);
  }

private:
  Csv File;
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

// Iterations --------------------------------------------------------------------------------------

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

void CountIterations(const Source& source, const Options& options, IterationsTable& table)
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

void PrintIterationsHeader(const Options& options)
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
