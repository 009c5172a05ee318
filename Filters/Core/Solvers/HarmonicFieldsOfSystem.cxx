#include "Solvers/HarmonicFieldsOfSystem.h"

#include "Solvers/Krylov/EnergiesOfSpace.h"
#include "Support/AllIndices.h"
#include "Support/CountingSort.h"
#include "Support/SparseKernels.h"

#include <Eigen/QR>

#include <algorithm>
#include <cmath>

namespace dmg
{
namespace
{

constexpr int Grain = 8192;

}

Eigen::MatrixXd AdjustKernelToPenalties(
  Eigen::MatrixXd fields, const StiffnessHierarchy& hierarchy, const Vector<double>& D, const ExecutionContext& context)
{
  const int size = hierarchy.NumberOfUnknowns();
  const std::vector<int> penalised = Choose(
    size, [&D](int i) { return D[i] > 0.0 && std::isfinite(D[i]); }, context);
  const auto count = static_cast<Eigen::Index>(penalised.size());
  const bool areMet = count == 0 ||
    (count <= fields.cols() && Eigen::ColPivHouseholderQR<Eigen::MatrixXd>(fields(penalised, All)).rank() == count);
  context.ParallelFor(0, size, Grain,
    [&](int first, int last)
    {
      for (int i = first; i < last; ++i)
      {
        if (!std::isfinite(D[i]))
        {
          fields.row(i).setZero();
        }
        else if (D[i] > 0.0 && !areMet)
        {
          const double R = hierarchy.DiagonalOf(i);
          fields.row(i) *= R / (R + D[i]);
        }
      }
    });
  return fields;
}

double LargestEnergy(const Eigen::MatrixXd& vectors, const StiffnessHierarchy& hierarchy, const Vector<double>& D,
  const ExecutionContext& context)
{
  double largest = 0.0;
  for (Eigen::Index k = 0; k < vectors.cols(); ++k)
  {
    largest = std::max(largest,
      SumOverBlocks<double>(hierarchy.NumberOfUnknowns(), context,
        [&](int first, int last)
        {
          double energy = 0.0;
          for (int i = first; i < last; ++i)
          {
            energy += std::isfinite(D[i]) ? (hierarchy.DiagonalOf(i) + D[i]) * vectors(i, k) * vectors(i, k) : 0.0;
          }
          return energy;
        }));
  }
  return largest;
}

Eigen::MatrixXd UndeterminedFields(Eigen::MatrixXd fields, const LinearOperator<double>& A,
  const StiffnessHierarchy& hierarchy, const Vector<double>& D, const std::vector<int>& held,
  const ExecutionContext& context)
{
  fields(held, All).setZero();
  Eigen::MatrixXd energies(fields.cols(), fields.cols());
  Vector<double> product;
  for (Eigen::Index k = 0; k < fields.cols(); ++k)
  {
    A.Apply(fields.col(k), product, context);
    energies.col(k) = fields.transpose() * product;
  }
  return EnergiesOfSpace(fields, energies, LargestEnergy(fields, hierarchy, D, context)).Undetermined();
}

std::string WarningAboutUndetermined(int undetermined, int harmonicFields)
{
  if (undetermined == 0)
  {
    return {};
  }
  return std::to_string(undetermined) + " of the " + std::to_string(harmonicFields) +
    " harmonic fields are not determined and left out; prescribe more directions, spread over the handles and "
    "holes, or raise Alignment and weights where these are tiny";
}

}
