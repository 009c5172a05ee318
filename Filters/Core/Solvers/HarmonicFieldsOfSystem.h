#ifndef dmgHarmonicFieldsOfSystem_h
#define dmgHarmonicFieldsOfSystem_h

#include "Solvers/Krylov/LinearOperator.h"
#include "Solvers/Multigrid/StiffnessHierarchy.h"
#include "Support/ExecutionContext.h"
#include "Support/Types.h"

#include <string>
#include <vector>

/// The harmonic fields, the kernel of R, in a system A = R + D. Fields are columns, and all is in the
/// order of the hierarchy.
namespace dmg
{

/// The harmonic fields as deflation takes them: they are zero where unknowns are held, and take the share R / (R + D) where
/// unknowns are penalised (PenalisedUnknowns). Otherwise strong penalties would give them so much energy that deflation had no
/// effect. If a harmonic field exists for any prescribed values, it is the solution, and the fields stay as they are.
Eigen::MatrixXd AdjustKernelToPenalties(Eigen::MatrixXd fields, const StiffnessHierarchy& hierarchy,
  const Vector<double>& D, const ExecutionContext& context);

/// The largest energy that some vectors could have if nothing cancelled.
double LargestEnergy(const Eigen::MatrixXd& vectors, const StiffnessHierarchy& hierarchy, const Vector<double>& D,
  const ExecutionContext& context);

/// The harmonic fields that nothing determines, the kernel of A: orthonormal columns.
/// \param held unknowns that are zero.
/// Cost: a product with A for each field.
Eigen::MatrixXd UndeterminedFields(Eigen::MatrixXd fields, const LinearOperator<double>& A,
  const StiffnessHierarchy& hierarchy, const Vector<double>& D, const std::vector<int>& held,
  const ExecutionContext& context);

/// One sentence for the user where prescriptions leave some of the harmonic fields undetermined, else empty.
std::string WarningAboutUndetermined(int undetermined, int harmonicFields);

}

#endif
