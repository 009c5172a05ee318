#ifndef dmgTestFieldProblem_h
#define dmgTestFieldProblem_h

#include "Setup/FieldSetup.h"
#include "Solvers/HarmonicProblem.h"

#include <memory>

/// The stages of FieldSolver one by one and without its cache, for tests and benchmarks that want to see each.
namespace dmg::test
{

/// What FieldSolver would set up for such options.
/// \param operators null: those that the solver takes by itself, samples or none.
std::shared_ptr<const MultigridSetup> SetupOf(const FramedMesh& surface, const ProlongationOperators* operators,
  const FieldOptions& options, const ExecutionContext& context);

/// Whether cycles with R and D apart would solve this.
bool SplitsOperator(const FramedMesh& surface, const ProlongationOperators* operators, const FieldOptions& options);

/// Directions as a discretisation takes them.
FieldConstraints MakeFieldConstraints(
  const FramedMesh& surface, const Constraints& directions, const FieldOptions& options);

/// The system stage, and the solve stage on top of it.
class FieldProblem
{
public:
  /// \param setup of this surface and these options, if it is at hand; else it is made.
  FieldProblem(const FramedMesh& surface, const ProlongationOperators* operators, const FieldConstraints& constraints,
    const FieldOptions& options, const ExecutionContext& context,
    std::shared_ptr<const MultigridSetup> setup = nullptr);

  /// Other elements or weights.
  void Update(const FieldConstraints& constraints, const FieldOptions& options, const ExecutionContext& context);

  Vector<double> Solve(const Vector<double>& values, const Vector<double>& start, const StoppingCriteria& stop,
    const ExecutionContext& context, const ReferenceSolution& reference = {});

  Eigen::MatrixXd HarmonicFields() const { return this->Problem->Setup().HarmonicFields(); }
  const SolveReport& Report() const { return this->Problem->Report(); }

private:
  std::shared_ptr<const Discretisation> Field;
  std::unique_ptr<HarmonicProblem> Problem;
};

/// Power fields on faces, all else by default.
inline FieldOptions PowersOnFaces()
{
  FieldOptions options;
  options.Field.Kind = DiscretisationKind::PowerField;
  return options;
}

/// The same of power fields on faces, in complex numbers.
class PowerFieldProblem
{
public:
  PowerFieldProblem(const FramedMesh& surface, const ProlongationOperators* operators,
    const FieldConstraints& prescribed, const FieldOptions& options, const ExecutionContext& context)
    : Problem(surface, operators, prescribed, options, context)
  {
  }

  Vector<Complex> Solve(const Vector<Complex>& values, const Vector<Complex>& start, const StoppingCriteria& stop,
    const ExecutionContext& context);
  const SolveReport& Report() const { return this->Problem.Report(); }

private:
  FieldProblem Problem;
};

}

#endif
