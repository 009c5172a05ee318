#ifndef dmgMultigridSetup_h
#define dmgMultigridSetup_h

#include "Solvers/Multigrid/StiffnessHierarchy.h"
#include "Solvers/SolverOptions.h"
#include "Support/Types.h"

#include <memory>
#include <string>

namespace dmg
{

/// The parts that solvers reuse between systems: hierarchy, mass, kernel. Vectors are in the hierarchy's order.
struct MultigridSetup
{
  std::string Fields;    ///< the discretisation by name
  std::string Name;      ///< the coarse levels by name, for reports
  bool HasLevels = true; ///< else the system is factored
  SolverTuning Tuning;
  std::unique_ptr<const StiffnessHierarchy> Hierarchy;
  /// The diagonal of the inner product that errors are measured in; see ConvergenceMeasure.
  Vector<double> Mass;
  /// Harmonic fields, a column each, orthonormal: the kernel of the smoothness energy, which cycles hold only nearly.
  Eigen::MatrixXd Kernel;
  /// Whether components without prescriptions get the smoothest field of unit norm, the lowest eigenvector of R in
  /// Mass; else zero.
  bool HasSmoothest = false;
  double Area = 1.0;              ///< of the surface
  double SquaredNormOfUnit = 1.0; ///< in Mass, of a field of magnitude 1
  std::string KernelNote;         ///< for reports: why Kernel is left out, or empty

  double MassOf(int unknown) const
  {
    return this->Mass[this->Mass.size() * unknown / this->Hierarchy->NumberOfUnknowns()];
  }

  /// Kernel in the caller's order.
  Eigen::MatrixXd HarmonicFields() const;

  /// Held by this object.
  long long Bytes() const
  {
    return this->Hierarchy->Bytes() +
      (this->Mass.size() + this->Kernel.size()) * static_cast<long long>(sizeof(double));
  }
};

}

#endif
