#ifndef dmgSolverOfSurface_h
#define dmgSolverOfSurface_h

#include "Adapters/Surface/MeshFromPolyData.h"
#include "Adapters/Surface/OperatorsToFieldData.h"
#include "FieldSolver.h"
#include "Support/ExecutionContext.h"

#include <memory>
#include <string>
#include <utility>
#include <vector>

class vtkPolyData;

namespace dmg
{

/// A FieldSolver for the surface of a vtkPolyData, which a filter keeps from one execution to the next, and the operators that
/// the surface brings along. Keys are contents, not modification times.
class SolverOfSurface
{
public:
  /// Takes another surface, if its content is another, and the operators that it brings along if the solver wants them
  /// (WantsDecimation); others are not looked at.
  /// \throw InvalidInput as MeshFromPolyData and OperatorsFromFieldData, or the operators are those of another surface.
  void SetSurface(vtkPolyData* input, const FieldOptions& options, const ExecutionContext& context);

  FieldSolver& Solver() { return *this->SolverOfMesh; }
  const FieldSolver& Solver() const { return *this->SolverOfMesh; }
  FramedSurface Surface() const { return { this->SolverOfMesh->Surface(), this->Numbers }; }
  /// Another one for each surface.
  int Number() const { return this->NumberOfSurface; }

  /// Over all surfaces.
  SolvedField::StageCounts Counts() const;
  /// Of the surface, its operators, and the set-up of a field on it.
  double SetupSeconds(const Field& field) const;

private:
  std::shared_ptr<const ProlongationOperators> Operators(vtkPolyData* input, const OperatorsOrigin& origin);

  std::string Digest;
  dmg::Numbering Order = dmg::Numbering::Spatial;
  SurfaceNumbering Numbers;
  std::unique_ptr<FieldSolver> SolverOfMesh;
  int NumberOfSurface = 0;
  /// All operators of this surface that were read.
  std::vector<std::pair<OperatorsOrigin, std::shared_ptr<const ProlongationOperators>>> Read;
  double SurfaceSeconds = 0.0;
  double OperatorsSeconds = 0.0;
  SolvedField::StageCounts OfFormerSurfaces;
};

}

#endif
