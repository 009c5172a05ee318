#ifndef dmgSolvedSurface_h
#define dmgSolvedSurface_h

#include "Adapters/Output/BasisToArrays.h"
#include "Adapters/Output/FieldToArrays.h"
#include "Adapters/Surface/MeshFromPolyData.h"
#include "Adapters/Surface/OperatorsToFieldData.h"
#include "Constraints/NearestPlaces.h"
#include "FieldSolver.h"
#include "Operators/PrincipalDirections.h"
#include "SingularFieldSolver.h"
#include "Support/ExecutionContext.h"

#include <functional>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

class vtkPolyData;

namespace dmg
{

/// A FieldSolver for the surface of a vtkPolyData, and the arrays that show its field: what a solver filter keeps from
/// one execution to the next. Keys are contents, not modification times.
class SolvedSurface
{
public:
  /// Takes another surface, if its content is another, and the operators that it brings along if the solver wants them
  /// (WantsDecimation); others are not looked at.
  /// \throw InvalidInput as MeshFromPolyData and OperatorsFromFieldData, or the operators are those of another surface.
  void SetSurface(vtkPolyData* input, const FieldOptions& options, const ExecutionContext& context);

  FramedSurface Surface() const { return { this->Solver->Surface(), this->Numbers }; }
  const NearestPlaces& Places();

  /// The curvatures of the faces, at a scale; kept until another is asked for. See FindPrincipalDirections.
  const PrincipalCurvatures& Curvatures(double scale, const ExecutionContext& context);

  /// See FieldSolver::Solve. \return warnings for the user, where something was solved rather than kept.
  std::vector<std::string> Solve(const Constraints& directions, const FieldOptions& options,
    const StoppingCriteria& stop, const ExecutionContext& context);

  /// The same with singularities; see SingularFieldSolver::Solve.
  std::vector<std::string> Solve(const std::vector<PrescribedSingularity>& singularities, const Constraints& directions,
    const FieldOptions& options, const StoppingCriteria& stop, const ExecutionContext& context);

  /// The arrays of the field, where they are not those that stand.
  void MakeArrays(vtkPolyData* input, bool unitLength, bool combing, const ExecutionContext& context);
  /// \param hasBasis whether the harmonic fields come along.
  void AddArraysTo(vtkPolyData* surface, vtkPolyData* edges, bool hasBasis) const;
  /// Sizes, cost and convergence.
  void AddReportTo(vtkFieldData* data, bool hasBasis) const;

  /// The harmonic fields; \return whether they were made, rather than kept.
  bool MakeBasis(vtkPolyData* input, const ExecutionContext& context);
  const BasisArrays& Basis() const { return *this->BasisOfSurface; }

  const Discretisation& Field() const { return this->Solved->Field(); }
  const SolveReport& Report() const { return this->Solved->Report(); }
  /// Over all surfaces.
  FieldSolver::StageCounts Counts() const;
  double SetupSeconds() const;

private:
  std::shared_ptr<const ProlongationOperators> Operators(vtkPolyData* input, const OperatorsOrigin& origin);
  /// Solves, and forgets what is shown of another field.
  std::vector<std::string> Update(SolvedField& solver, const std::function<void()>& solve);

  std::string Digest;
  dmg::Numbering Order = dmg::Numbering::Spatial;
  SurfaceNumbering Numbers;
  std::unique_ptr<FieldSolver> Solver;
  std::unique_ptr<NearestPlaces> PlacesOfSurface;
  std::unique_ptr<SingularFieldSolver> WithSingularities; ///< as soon as there have been some
  const SolvedField* Solved = nullptr;                    ///< the one of both that has solved last
  /// All operators of this surface that were read.
  std::vector<std::pair<OperatorsOrigin, std::shared_ptr<const ProlongationOperators>>> Read;
  std::optional<std::pair<double, PrincipalCurvatures>> CurvaturesAtScale;
  std::optional<ShownField> Shown; ///< of the last solution or, if it is not current, one before
  bool IsShownCurrent = false;
  std::optional<FieldArrays> Arrays; ///< of Shown
  std::optional<BasisArrays> BasisOfSurface;
  double SurfaceSeconds = 0.0;
  double OperatorsSeconds = 0.0;
  FieldSolver::StageCounts OfFormerSurfaces;
};

}

#endif
