#ifndef dmgFieldOutput_h
#define dmgFieldOutput_h

#include "Adapters/Output/BasisToArrays.h"
#include "Adapters/Output/FieldToArrays.h"
#include "Adapters/Surface/SolverOfSurface.h"
#include "Support/ExecutionContext.h"

#include <memory>
#include <optional>

class vtkFieldData;
class vtkDataSet;
class vtkPolyData;

namespace dmg
{

/// The arrays that show the last field of a SolverOfSurface, which a filter keeps from one execution to the next: other arrays
/// on the surface cost nothing.
class FieldOutput
{
public:
  /// The arrays of a field and of the harmonic basis that it comes with, where they are not those that stand.
  void MakeArrays(
    const SolverOfSurface& surface, const Field& field, vtkDataSet* input, const ExecutionContext& context);
  void AddArraysTo(const SolverOfSurface& surface, const Field& field, vtkDataSet* output, vtkPolyData* edges) const;
  /// Sizes, cost and convergence.
  void AddReportTo(const SolverOfSurface& surface, const Field& field, vtkFieldData* data) const;

private:
  void MakeBasis(
    const SolverOfSurface& surface, const Field& field, vtkDataSet* input, const ExecutionContext& context);

  int Surface = 0;
  long long Field = 0;
  bool HasUnitLength = true;
  std::optional<FieldArrays> Arrays; ///< of these
  std::shared_ptr<const Eigen::MatrixXd> Basis;
  std::optional<BasisArrays> ArraysOfBasis; ///< of this basis
};

}

#endif
