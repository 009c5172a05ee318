#ifndef dmgSolverOfSurface_h
#define dmgSolverOfSurface_h

#include "Adapters/Surface/OperatorsToFieldData.h"
#include "Adapters/Surface/PreparedDataSet.h"
#include "FieldSolver.h"
#include "Support/ExecutionContext.h"

#include <memory>
#include <string>
#include <utility>
#include <vector>

class vtkDataSet;

namespace dmg
{

/// A FieldSolver for the surface of a dataset, which a filter keeps from one execution to the next, and the operators that
/// the surface brings along. Keys are contents, not modification times.
class SolverOfSurface
{
public:
  /// Takes another surface, if its content is another, and the operators that it brings along if the solver wants them
  /// (WantsDecimation); others are not looked at.
  /// \param digest that of \p input (ContentDigest).
  /// \throw InvalidInput as MeshFromDataSet and OperatorsFromFieldData, or the operators are those of another surface.
  void SetSurface(vtkDataSet* input, const std::string& digest, const FieldOptions& options,
    const PreparationOptions& preparation, const ExecutionContext& context);

  FieldSolver& Solver() { return *this->SolverOfMesh; }
  const FieldSolver& Solver() const { return *this->SolverOfMesh; }
  FramedSurface Surface() const { return this->Prepared->Surface(); }
  /// The changes that made the surface a mesh.
  const PreparationReport& Preparation() const { return this->Prepared->Report; }
  /// The sum over the surface, its operators, and the set-up of a field on it.
  double SetupSeconds(const Field& field) const;

  /// Over all surfaces.
  StageCounts Counts() const;

private:
  std::shared_ptr<const ProlongationOperators> Operators(vtkDataSet* input, const OperatorsOrigin& origin);

  std::shared_ptr<const PreparedDataSet> Prepared; ///< of the solver
  std::unique_ptr<FieldSolver> SolverOfMesh;
  /// All operators of this surface that were read, by their origin.
  std::vector<std::pair<OperatorsOrigin, std::shared_ptr<const ProlongationOperators>>> OperatorsByOrigin;
  double SurfaceSeconds = 0.0;
  double OperatorsSeconds = 0.0;
  StageCounts FormerCounts;
};

}

#endif
