#ifndef dmgFieldOutput_h
#define dmgFieldOutput_h

#include "Adapters/Output/BasisToArrays.h"
#include "Adapters/Output/FieldToArrays.h"
#include "Adapters/Surface/SolverOfSurface.h"
#include "Support/ExecutionContext.h"

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
  /// The arrays of a field, where they are not those that stand.
  void MakeArrays(
    const SolverOfSurface& surface, const Field& field, vtkDataSet* input, const ExecutionContext& context);
  /// The harmonic fields. \return whether they were made, rather than kept.
  bool MakeBasis(const SolverOfSurface& surface, vtkDataSet* input, const ExecutionContext& context);
  const BasisArrays& Basis() const { return *this->BasisOfSurface; }

  /// \param hasBasis whether the harmonic fields come along.
  void AddArraysTo(const SolverOfSurface& surface, bool hasBasis, vtkDataSet* output, vtkPolyData* edges) const;
  /// Sizes, cost and convergence.
  void AddReportTo(const SolverOfSurface& surface, const Field& field, bool hasBasis, vtkFieldData* data) const;

private:
  void SetSurface(const SolverOfSurface& surface);

  int Surface = 0;
  long long Field = 0;
  bool HasUnitLength = true;
  std::optional<FieldArrays> Arrays; ///< of these
  std::optional<BasisArrays> BasisOfSurface;
};

}

#endif
