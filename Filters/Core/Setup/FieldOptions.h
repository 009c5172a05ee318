#ifndef dmgFieldOptions_h
#define dmgFieldOptions_h

#include "Discretisations/Discretisation.h"
#include "Discretisations/DiscretisationOptions.h"
#include "Solvers/Penalties.h"
#include "Solvers/SolverOptions.h"

#include <tuple>

namespace dmg
{

/// The choices of a user: the field, the weights of its energies, and the solver.
struct FieldOptions
{
  DiscretisationOptions Field;
  /// Weight of the smoothness energy, > 0.
  double Smoothness = 1.0;
  /// Weight of soft constraints, > 0; see the discretisations for what it means.
  double Alignment = 1.0;
  ConstraintKind Constraints = ConstraintKind::Soft;
  CoarseSpaceKind CoarseSpace = CoarseSpaceKind::LinearInterpolation;
  SolverOptions Solver;

  FieldWeights Weights() const { return { this->Smoothness, this->Alignment, this->Constraints }; }

  friend bool operator==(const FieldOptions& a, const FieldOptions& b)
  {
    const auto members = [](const FieldOptions& options)
    {
      // A member that is forgotten here does not compile.
      const auto& [field, smoothness, alignment, constraints, space, solver] = options;
      return std::tie(field, smoothness, alignment, constraints, space, solver);
    };
    return members(a) == members(b);
  }
};

}

#endif
