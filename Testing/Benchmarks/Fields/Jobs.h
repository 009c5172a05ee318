#ifndef dmgFieldsJobs_h
#define dmgFieldsJobs_h

#include "Benchmarks/Prescriptions.h"
#include "Benchmarks/Systems.h"
#include "Benchmarks/Timing.h"
#include "Discretisations/MakeDiscretisation.h"
#include "Support/ComplexPairs.h"
#include "Support/MeshFactory.h"
#include "Support/ReadPly.h"
#include "Support/TbbContext.h"

#include <cstdio>
#include <functional>
#include <limits>
#include <memory>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

/// What is to be solved: surfaces, systems and what is prescribed on them.
namespace dmg::benchmarks
{

constexpr double Tolerance = 1e-8;
constexpr double None = std::numeric_limits<double>::quiet_NaN();
constexpr unsigned Seed = 20261121;

const std::vector<Regime> Regimes = { { "20", 20, 0.0 }, { "0.5 %", 0, 0.005 } };

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
inline Source SourceOf(const std::string& path, const Options& options)
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

inline Vector<double> AsReal(const Vector<double>& x)
{
  return x;
}
inline Vector<double> AsReal(const Vector<Complex>& x)
{
  return AsPairs(x);
}

inline double RelativeDifference(const Vector<double>& x, const Vector<double>& reference)
{
  return (x - reference).norm() / reference.norm();
}

inline FieldOptions FieldOf(DiscretisationKind kind, int N = 2)
{
  FieldOptions options;
  options.Field.Kind = kind;
  options.Field.N = N;
  options.Solver.Kind = SolverKind::ConjugateGradients;
  return options;
}

inline std::vector<DiscretisationKind> Discretisations(const Options& options)
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

}

#endif
