#include "Pieces/ReasonToGather.h"

#include "Discretisations/MakeDiscretisation.h"
#include "Solvers/SolverMethod.h"

namespace dmg
{

std::string ReasonToGather(const FieldProblem& problem)
{
  const FieldOptions& options = problem.Options;
  if (std::string reason = ReasonForOneProcess(options.Field); !reason.empty())
  {
    return reason;
  }
  if (problem.Singularities)
  {
    return "fields with prescribed singularities are found on one process";
  }
  if (problem.UnitLengthWhileSmoothing)
  {
    return "fields are smoothed at unit length on one process";
  }
  if (options.CoarseSpace != CoarseSpaceKind::LinearInterpolation)
  {
    return "structure-preserving coarse spaces are built on one process";
  }
  const SolverKind kind = options.Solver.Kind;
  if (kind != SolverKind::Automatic && kind != SolverKind::ConjugateGradients)
  {
    return "the method " + MethodOf(kind).Name + " runs on one process, unlike conjugate gradients";
  }
  return "";
}

}
