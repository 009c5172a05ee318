#ifndef dmgTestSolverOfUnknowns_h
#define dmgTestSolverOfUnknowns_h

#include "FieldSolver.h"
#include "Singularities/SingularFieldSolver.h"

#include <memory>
#include <utility>
#include <vector>

namespace dmg::test
{

/// A FieldSolver for tests that look at numbers: constraints and options go in, unknowns come out.
class SolverOfUnknowns
{
public:
  explicit SolverOfUnknowns(TriangleMesh mesh, const ExecutionContext& context = SerialContext())
    : Solver(std::move(mesh), context)
  {
  }

  const Vector<double>& Solve(const Constraints& constraints, const FieldOptions& options,
    const StoppingCriteria& stop = {}, const ExecutionContext& context = SerialContext(),
    const ElementNames& names = {})
  {
    this->Problem.Singularities.reset();
    return this->Solve(constraints, options, stop, context, names, this->Problem);
  }
  const Vector<double>& Solve(const std::vector<PrescribedSingularity>& singularities, const Constraints& constraints,
    const FieldOptions& options, const StoppingCriteria& stop = {}, const ExecutionContext& context = SerialContext(),
    const ElementNames& names = {})
  {
    this->Problem.Singularities = singularities;
    return this->Solve(constraints, options, stop, context, names, this->Problem);
  }

  void SetOperators(std::shared_ptr<const ProlongationOperators> operators)
  {
    this->Solver.SetOperators(std::move(operators));
  }
  void SetMemoryLimit(long long bytes) { this->Solver.SetMemoryLimit(bytes); }
  const FramedMesh& Surface() const { return this->Solver.Surface(); }
  LinearSystem Equations() const { return this->Solver.Equations(); }
  StageCounts Counts() const { return this->Solver.Counts(); }

  // Results of the last solve.
  const FieldSolution& Solution() const { return *this->Last->Solution; }
  const Discretisation& Field() const { return *this->Solution().Discretisation; }
  const FieldConstraints& Constrained() const { return this->Solution().Constraints; }
  const Vector<double>& Unknowns() const { return this->Solution().Unknowns; }
  /// Across edges, with prescribed singularities.
  const Vector<double>& Rotation() const { return this->Solution().Connection->Rotation; }
  const SolveReport& Report() const { return this->Last->Report; }
  /// Of the field's magnitude.
  Points Directions(int k) const { return this->Solver.Directions(k); }

private:
  const Vector<double>& Solve(const Constraints& constraints, const FieldOptions& options, const StoppingCriteria& stop,
    const ExecutionContext& context, const ElementNames& names, dmg::FieldProblem& problem)
  {
    problem.Constraints = constraints;
    problem.Options = options;
    problem.Stop = stop;
    problem.Combing = false;
    problem.UnitLength = false;
    this->Last = &this->Solver.Solve(problem, context, names);
    return this->Unknowns();
  }

  FieldSolver Solver;
  dmg::FieldProblem Problem;
  const dmg::Field* Last = nullptr;
};

}

#endif
