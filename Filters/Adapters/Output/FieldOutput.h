#ifndef dmgFieldOutput_h
#define dmgFieldOutput_h

#include "Adapters/Input/ProblemFromInputs.h"
#include "Adapters/Output/BasisToArrays.h"
#include "Adapters/Output/FieldToArrays.h"
#include "Adapters/Surface/SolverOfDataSet.h"
#include "Support/ExecutionContext.h"

#include <memory>
#include <optional>
#include <string>

class vtkFieldData;
class vtkDataSet;
class vtkInformationVector;
class vtkPolyData;

namespace dmg
{

/// The outputs of a filter that computes a field. It keeps the arrays of the last field from one execution to the next: other arrays
/// on the surface cost nothing.
class FieldOutput
{
public:
  /// \param followed WhatIsFollowed.
  /// \param outputs the surface with the field, its edges and the history of the iterations.
  void Write(const SolverOfDataSet& surface, const Field& field, const FieldInputs& inputs,
    const PreparationOptions& preparation, const std::string& followed, vtkInformationVector* outputs,
    const ExecutionContext& context);

private:
  /// The arrays of a field and of the harmonic basis that it comes with, where they are not those that stand.
  void MakeArrays(
    const SolverOfDataSet& surface, const Field& field, vtkDataSet* input, const ExecutionContext& context);
  void MakeBasis(
    const SolverOfDataSet& surface, const Field& field, vtkDataSet* input, const ExecutionContext& context);
  void AddArraysTo(const SolverOfDataSet& surface, const Field& field, vtkDataSet* output, vtkPolyData* edges) const;
  /// Sizes, cost and convergence.
  void AddReportTo(const SolverOfDataSet& surface, const Field& field, vtkFieldData* data) const;

  int Surface = 0;
  long long Field = 0;
  bool HasUnitLength = true;
  std::optional<FieldArrays> Arrays; ///< of these
  std::shared_ptr<const Eigen::MatrixXd> Basis;
  std::optional<BasisArrays> ArraysOfBasis; ///< of this basis
};

}

#endif
