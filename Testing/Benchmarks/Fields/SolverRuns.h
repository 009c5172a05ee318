#ifndef dmgFieldsSolverRuns_h
#define dmgFieldsSolverRuns_h

#include "Benchmarks/Fields/Jobs.h"
#include "Benchmarks/OwnProcess.h"
#include "Benchmarks/PeakMemory.h"
#include "Benchmarks/Peers/AlgebraicMultigridPeers.h"
#include "Benchmarks/Peers/DirectPeers.h"
#include "Benchmarks/Peers/IncompleteCholeskyPeer.h"
#include "Benchmarks/Peers/RealForm.h"
#include "Benchmarks/Peers/SimplicialCholmodPeer.h"
#include "Operators/FaceFieldOperators.h"
#include "Support/AllIndices.h"
#include "Support/FieldProblem.h"
#include "Support/ReferenceOperators.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <optional>

/// The time and memory that a solver takes for a system: ours and its peers, each in a process of its own.
namespace dmg::benchmarks
{

constexpr double LongRun = 20.0; // seconds

const char* const Ours = "ours";
const char* const Reference = "CHOLMOD, AMD";
const char* const GeometryCentral = "geometry-central's factor";

/// What coarse spaces shall contain: the coordinate fields, projected to the surface, as unknowns of a discretisation,
/// a column each; of functions, the constants.
inline Eigen::MatrixXd SmoothFields(const FramedMesh& surface, const Discretisation& field)
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

inline std::vector<std::string> Solvers(DiscretisationKind kind)
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
inline std::unique_ptr<peers::Peer<double>> NewRealPeer(
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
inline void MakeFrames(const Workplace& place)
{
  FaceFrames(place.Surface.Mesh, place.Context);
  if (place.Asked.Field.Kind == DiscretisationKind::VertexPowerField)
  {
    VertexFrames(place.Surface.Mesh, place.Context);
  }
}

inline Measured MeasureOurs(const Workplace& place, const Options& options)
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

inline Measured Measure(const Job& job, const std::string& solver, const Options& options)
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

}

#endif
