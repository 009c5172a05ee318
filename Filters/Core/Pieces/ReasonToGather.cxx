#include "Pieces/ReasonToGather.h"

#include "Solvers/SolverMethod.h"

namespace dmg
{

std::string ReasonToGather(const FieldProblem& problem)
{
  const FieldOptions& options = problem.Options;
  switch (options.Field.Kind)
  {
    case DiscretisationKind::FaceField:
    case DiscretisationKind::OneForm:
      return "flows are found on one process";
    case DiscretisationKind::PowerField:
      return "power fields on faces are found on one process, unlike those at points";
    case DiscretisationKind::VertexPowerField:
    case DiscretisationKind::ScalarFunction:
      break;
  }
  if (problem.Singularities)
  {
    return "fields with prescribed singularities are found on one process";
  }
  if (options.CoarseSpace != CoarseSpaceKind::LinearInterpolation)
  {
    return "structure-preserving coarse spaces are built on one process";
  }
  const SolverKind kind = options.Solver.Kind;
  if (kind != SolverKind::Automatic && kind != SolverKind::ConjugateGradients)
  {
    return MethodOf(kind).Name + " run on one process, unlike conjugate gradients";
  }
  if (options.Solver.CompareWithCholesky)
  {
    return "the system is factored on one process, to compare with";
  }
  if (!problem.Guides.AreEmpty())
  {
    return "guides are brought to the surface on one process";
  }
  const FeatureOptions& features = problem.Features;
  if (features.BoundaryWeight > 0.0 || features.SharpEdgesWeight > 0.0 || features.CurvatureWeight > 0.0)
  {
    return "features of the surface are found on one process";
  }
  if (problem.SmoothingLength != 0.0)
  {
    return "a smoothing length is applied on one process";
  }
  if (!problem.Rotation.AreZero())
  {
    return "fields are turned against what they follow on one process";
  }
  if (problem.Constraints.Source.size() > 0)
  {
    return "functions with a source are found on one process";
  }
  return "";
}

}
