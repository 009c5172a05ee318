#include "FieldSolver.h"

#include "FieldStages.h"
#include "Operators/FluxAnisotropy.h"
#include "Operators/PrincipalDirections.h"
#include "SingularFieldSolver.h"
#include "Support/Errors.h"
#include "Support/ShortText.h"

#include <cassert>
#include <cmath>
#include <optional>
#include <utility>

namespace dmg
{

namespace
{

template <class Item>
void Append(std::vector<Item>& all, const std::vector<Item>& more)
{
  all.insert(all.end(), more.begin(), more.end());
}

/// \param mayMiss whether guides may be left out.
/// \throw InvalidInput guides are given, and nothing is prescribed.
void CheckFollowsSomething(const Constraints& constraints, const GuidesReport& guides, bool mayMiss)
{
  if (mayMiss && !guides.IsAllTaken())
  {
    return;
  }
  if (constraints.AreEmpty() && !guides.IsAllTaken())
  {
    throw InvalidInput("no direction is prescribed; " + guides.LeftOut());
  }
  if (constraints.AreEmpty())
  {
    throw InvalidInput(
      "no direction is prescribed: the lines of the guides have no length or their vectors are zero, or "
      "their mask or weights are; choose others, or clear Guides for the smoothest field");
  }
}

/// \throw InvalidInput the length is negative or not finite.
void WeighBySmoothingLength(
  double relative, const TriangleMesh& mesh, const Discretisation& discretisation, Constraints& constraints)
{
  if (!(relative > 0.0) || !std::isfinite(relative))
  {
    throw InvalidInput("Smoothing Length is " + ShortText(relative) + "; make it positive, or 0 for none");
  }
  const Points& positions = mesh.VertexPositions();
  const double length = relative * (positions.colwise().maxCoeff() - positions.colwise().minCoeff()).norm();
  const auto [onFaces, atVertices] = discretisation.WeightsOfIntegral();
  const auto scale = [length](auto& all, double factor)
  {
    for (auto& constraint : all)
    {
      constraint.Weight *= factor / (length * length);
    }
  };
  scale(constraints.OnFaces, onFaces);
  scale(constraints.AtVertices, atVertices);
  scale(constraints.Values, atVertices);
}

std::string WarningOfCancelling(const std::vector<int>& faces, const ElementNames& names)
{
  const std::size_t others = faces.size() - 1;
  return "the directions prescribed on " + names.Face(faces[0]) +
    (others == 0 ? "" : " and " + std::to_string(others) + (others == 1 ? " other" : " others")) +
    " cancel, as opposite vectors do for a field of one direction, so nothing is followed there; take one of them out, "
    "or "
    "choose a Number Of Directions to which they are alike";
}

/// The share of the surface from which on sheared triangles are worth a note.
constexpr double NotableShare = 0.2;

std::string WarningOfShear(double share)
{
  return std::to_string(std::lround(100.0 * share)) +
    " % of the surface have sheared triangles, as grids have, where power fields on faces are inaccurate at any "
    "resolution; choose Power Field at Points (PointPowerField) as Discretisation";
}

}

class FieldSolver::Internals
{
public:
  Internals(TriangleMesh mesh, const ExecutionContext& context)
    : Stages(std::move(mesh), context)
  {
  }

  Constraints Follow(const FieldProblem& problem, const ExecutionContext& context, const ElementNames& names);
  void Solve(const FieldProblem& problem, const Constraints& constraints, const ExecutionContext& context,
    const ElementNames& names);
  void FindDirections(const FieldProblem& problem, const ExecutionContext& context);
  const NearestPlaces& PlacesOfSurface();

  FieldStages Stages;
  std::unique_ptr<SingularFieldSolver> WithSingularities; ///< as soon as there have been some
  const SolvedField* Solved = nullptr;                    ///< the one of both that has solved last
  Field Last;                                             ///< of the last solution or, if it is not current, one before

private:
  const SolvedField& Solver(const FieldProblem& problem);
  void FollowGuides(const FieldProblem& problem, Constraints& constraints, const ExecutionContext& context);
  void FollowFeatures(const FieldProblem& problem, int N, Constraints& constraints, const ExecutionContext& context);
  void Rotate(const FieldProblem& problem, bool isNothingSaid, Constraints& constraints, const ElementNames& names);
  const PrincipalCurvatures& Curvatures(double scale, const ExecutionContext& context);
  void WarnOfShear(const FieldProblem& problem, const ExecutionContext& context);

  std::unique_ptr<NearestPlaces> Places;
  std::optional<std::pair<double, PrincipalCurvatures>> CurvaturesAtScale;
  std::optional<double> ShearedShare;
  bool IsCurrent = false; ///< whether the directions of Last are those of the solution
};

const NearestPlaces& FieldSolver::Internals::PlacesOfSurface()
{
  if (!this->Places)
  {
    this->Places = std::make_unique<NearestPlaces>(this->Stages.Surface());
  }
  return *this->Places;
}

const PrincipalCurvatures& FieldSolver::Internals::Curvatures(double scale, const ExecutionContext& context)
{
  if (!this->CurvaturesAtScale || this->CurvaturesAtScale->first != scale)
  {
    this->CurvaturesAtScale.emplace(scale, FindPrincipalDirections(this->Stages.Surface(), scale, context).Faces);
  }
  return this->CurvaturesAtScale->second;
}

/// All that the field follows as constraints, turned.
Constraints FieldSolver::Internals::Follow(
  const FieldProblem& problem, const ExecutionContext& context, const ElementNames& names)
{
  Constraints constraints = problem.Constraints;
  if (problem.SmoothingLength != 0.0)
  {
    WeighBySmoothingLength(problem.SmoothingLength, this->Stages.Surface().Mesh,
      this->Stages.DiscretisationFor(problem.Options.Field), constraints);
  }
  this->FollowGuides(problem, constraints, context);
  const DiscretisationOptions& field = problem.Options.Field;
  if (field.Kind == DiscretisationKind::ScalarFunction)
  {
    return constraints;
  }
  const int N = this->Stages.DiscretisationFor(field).DirectionsPerPoint();
  const std::size_t warnings = this->Last.Warnings.size();
  this->FollowFeatures(problem, N, constraints, context);
  const bool isNothingSaid = this->Last.Warnings.size() == warnings; // else it is said why nothing is followed
  this->Rotate(problem, isNothingSaid, constraints, names);
  const std::vector<int> cancelling = LeaveOutCancelling(constraints.OnFaces, this->Stages.Surface().Faces, N);
  if (!cancelling.empty())
  {
    this->Last.Warnings.push_back(WarningOfCancelling(cancelling, names));
  }
  return constraints;
}

void FieldSolver::Internals::FollowGuides(
  const FieldProblem& problem, Constraints& constraints, const ExecutionContext& context)
{
  this->Last.Guides = {};
  if (problem.Guides.AreEmpty())
  {
    return;
  }
  const FollowedGuides followed = dmg::FollowGuides(problem.Guides, this->PlacesOfSurface(), context);
  Append(constraints.OnFaces, followed.Directions);
  CheckFollowsSomething(constraints, followed.Report, problem.Guides.MayMiss);
  if (!followed.Report.IsAllTaken())
  {
    this->Last.Warnings.push_back(followed.Report.LeftOut());
  }
  this->Last.Guides = followed.Report;
}

void FieldSolver::Internals::FollowFeatures(
  const FieldProblem& problem, int N, Constraints& constraints, const ExecutionContext& context)
{
  CheckFeatures(problem.Features);
  const PrincipalCurvatures* curvatures = nullptr;
  if (problem.Features.CurvatureWeight > 0.0 && N % 2 == 0)
  {
    if (problem.Options.Constraints == ConstraintKind::Hard && !problem.Singularities)
    {
      throw InvalidInput("principal directions are followed on all triangles, which hard constraints would leave no "
                         "freedom; set Constraint Type to Soft, or Curvature Weight to 0");
    }
    curvatures = &this->Curvatures(problem.Features.CurvatureScale, context);
  }
  const FollowedFeatures followed = dmg::FollowFeatures(this->Stages.Surface(), N, problem.Features, curvatures);
  Append(constraints.OnFaces, followed.Directions);
  Append(this->Last.Warnings, followed.Warnings);
}

void FieldSolver::Internals::Rotate(
  const FieldProblem& problem, bool isNothingSaid, Constraints& constraints, const ElementNames& names)
{
  if (problem.Rotation.AreZero())
  {
    return;
  }
  if (isNothingSaid && constraints.OnFaces.empty() && constraints.AtVertices.empty())
  {
    this->Last.Warnings.push_back(
      "nothing is followed that the field could be turned against, so Rotation and Rotation "
      "Array have no effect; add what it shall follow, or set them to 0 and None");
    return;
  }
  Turn(constraints, this->Stages.Surface(), problem.Rotation, names);
}

/// The warnings of the solver come once, where something was solved rather than kept.
void FieldSolver::Internals::Solve(const FieldProblem& problem, const Constraints& constraints,
  const ExecutionContext& context, const ElementNames& names)
{
  const SolvedField& solver = this->Solver(problem);
  const SolvedField* const former = std::exchange(this->Solved, nullptr);
  const int solves = solver.Counts().Solves;
  if (problem.Singularities)
  {
    this->WithSingularities->Solve(*problem.Singularities, constraints, problem.Options, problem.Stop, context, names);
  }
  else
  {
    this->Stages.Solve(constraints, problem.Options, problem.Stop, context, names);
  }
  this->Solved = &solver;
  if (former != &solver || solver.Counts().Solves != solves)
  {
    this->IsCurrent = false;
    Append(this->Last.Warnings, solver.Report().Warnings);
    this->WarnOfShear(problem, context);
  }
}

void FieldSolver::Internals::WarnOfShear(const FieldProblem& problem, const ExecutionContext& context)
{
  if (problem.Options.Field.Kind != DiscretisationKind::PowerField || problem.Singularities)
  {
    return;
  }
  if (!this->ShearedShare)
  {
    this->ShearedShare = ShareOfShearedArea(this->Stages.Surface(), context);
  }
  if (*this->ShearedShare > NotableShare)
  {
    this->Last.Warnings.push_back(WarningOfShear(*this->ShearedShare));
  }
}

const SolvedField& FieldSolver::Internals::Solver(const FieldProblem& problem)
{
  if (!problem.Singularities)
  {
    return this->Stages;
  }
  if (!this->WithSingularities)
  {
    this->WithSingularities = std::make_unique<SingularFieldSolver>(this->Stages.Surface());
  }
  return *this->WithSingularities;
}

void FieldSolver::Internals::FindDirections(const FieldProblem& problem, const ExecutionContext& context)
{
  if (!this->IsCurrent || this->Last.IsCombed != problem.Combing)
  {
    Field field = DirectionsOfField(this->Stages.Surface(), this->Solved->Field(), this->Solved->Unknowns(),
      problem.Combing, this->Last.Number > 0 ? &this->Last : nullptr, context);
    field.Number = this->Last.Number + 1;
    field.Guides = this->Last.Guides;
    field.Warnings = std::move(this->Last.Warnings);
    this->Last = std::move(field);
    this->IsCurrent = true;
  }
  this->Last.HasUnitLength = problem.UnitLength;
  this->Last.Report = this->Solved->Report();
  this->Last.SetupSeconds = this->Solved->SetupSeconds();
}

FieldSolver::FieldSolver(TriangleMesh mesh, const ExecutionContext& context)
  : Internal(std::make_unique<Internals>(std::move(mesh), context))
{
}

FieldSolver::~FieldSolver() = default;

const FramedMesh& FieldSolver::Surface() const
{
  return this->Internal->Stages.Surface();
}

const NearestPlaces& FieldSolver::Places()
{
  return this->Internal->PlacesOfSurface();
}

void FieldSolver::SetOperators(std::shared_ptr<const ProlongationOperators> operators)
{
  this->Internal->Stages.SetOperators(std::move(operators));
}

void FieldSolver::SetMemoryLimit(long long bytes)
{
  this->Internal->Stages.SetMemoryLimit(bytes);
}

const Field& FieldSolver::Solve(const FieldProblem& problem, const ExecutionContext& context, const ElementNames& names)
{
  Internals& of = *this->Internal;
  if (problem.Singularities)
  {
    CheckTakesSingularities(problem.Options.Field);
  }
  of.Last.Warnings.clear();
  const Constraints constraints = of.Follow(problem, PartOfContext(context, 0.0, 0.0), names);
  of.Solve(problem, constraints, PartOfContext(context, 0.0, 0.9), names);
  of.FindDirections(problem, PartOfContext(context, 0.9, 1.0));
  return of.Last;
}

Points FieldSolver::Directions(int k) const
{
  return this->Internal->Last.DirectionsOnFaces(this->Surface(), k);
}

LinearSystem FieldSolver::Equations(const ExecutionContext& context) const
{
  return this->Internal->Stages.Equations(context);
}

const SolvedField& FieldSolver::Solved() const
{
  assert(this->Internal->Solved);
  return *this->Internal->Solved;
}

SolvedField::StageCounts FieldSolver::Counts() const
{
  SolvedField::StageCounts counts = this->Internal->Stages.Counts();
  if (const SolvedField* const other = this->Internal->WithSingularities.get())
  {
    counts.Setups += other->Counts().Setups;
    counts.Systems += other->Counts().Systems;
    counts.Solves += other->Counts().Solves;
  }
  return counts;
}

}
