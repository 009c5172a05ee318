#ifndef dmgSolverOfSurface_h
#define dmgSolverOfSurface_h

#include "Adapters/Surface/Kept.h"
#include "Adapters/Surface/OperatorsToFieldData.h"
#include "FieldSolver.h"
#include "Support/ExecutionContext.h"

#include <memory>
#include <string>
#include <utility>
#include <vector>

class vtkDataSet;

namespace dmg
{

/// A FieldSolver for the surface of a dataset, and the operators that the surface brings along.
class SolverOfSurface
{
public:
  /// Takes another surface, if its content is another, and the operators that it brings along if the solver wants them
  /// (WantsDecimation); others are not looked at.
  /// \param digest that of \p input (ContentDigest).
  /// \throw InvalidInput as MeshFromDataSet and OperatorsFromFieldData, or the operators are those of another surface.
  void SetSurface(vtkDataSet* input, const std::string& digest, const FieldOptions& options,
    const PreparationOptions& preparation, const ExecutionContext& context);

  FieldSolver& Solver() const { return *this->Engine; }
  FramedSurface Surface() const { return this->Engine.Surface().Surface(); }
  /// The changes that made the surface a mesh.
  const PreparationReport& Preparation() const { return this->Engine.Surface().Report; }
  /// The sum over the surface, its operators, and the set-up of a field on it.
  double SetupSeconds(const Field& field) const;

  /// Over all surfaces.
  StageCounts Counts() const { return this->Engine.Counts() + this->ReadOperators; }
  long long Bytes() const { return this->Engine.Bytes(); }

private:
  std::shared_ptr<const ProlongationOperators> Operators(vtkDataSet* input, const OperatorsOrigin& origin);

  /// One solver takes all options.
  struct NoOptions
  {
    friend bool operator==(const NoOptions&, const NoOptions&) { return true; }
  };

  EngineOfSurface<FieldSolver, NoOptions> Engine;
  /// All operators of this surface that were read, by their origin.
  std::vector<std::pair<OperatorsOrigin, std::shared_ptr<const ProlongationOperators>>> OperatorsByOrigin;
  double SurfaceSeconds = 0.0;
  double OperatorsSeconds = 0.0;
  StageCounts ReadOperators; ///< set-ups that the solver has not counted
};

}

#endif
