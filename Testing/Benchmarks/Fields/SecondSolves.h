#ifndef dmgFieldsSecondSolves_h
#define dmgFieldsSecondSolves_h

#include "Benchmarks/Csv.h"
#include "Benchmarks/Fields/Jobs.h"
#include "Benchmarks/OwnProcess.h"
#include "Benchmarks/Peers/DirectPeers.h"
#include "Support/FieldProblem.h"

#include <cstring>

/// The time that a second solve takes after a value, the weights or the prescribed set changed.
namespace dmg::benchmarks
{

constexpr double LoosenedTolerance = 1e-3; // of a solution that is followed while a constraint moves

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
inline Vector<double> WithFirstValueMoved(const Workplace& place)
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

inline std::vector<Resolve> MeasureResolves(const Job& job, const Options& options, std::string& failure)
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

}

#endif
