#include "Pieces/FieldSolverInPieces.h"

#include "Discretisations/MakeDiscretisation.h"
#include "Pieces/CombingOverSeams.h"
#include "Pieces/Constraints/ConstraintsAtOwned.h"
#include "Pieces/Constraints/ConstraintsInPieces.h"
#include "Pieces/ProblemAgreement.h"
#include "Pieces/Solvers/EquationsInPieces.h"
#include "Pieces/Solvers/PetscSession.h"
#include "Pieces/Solvers/SetupInPieces.h"
#include "Support/Errors.h"
#include "Support/Stopwatch.h"

#include <string>
#include <utility>

namespace dmg
{

/// Each stage is built as a whole and then put in place, as in FieldSolver.
class FieldSolverInPieces::Internals
{
public:
  Internals(
    MPI_Comm communicator, const SurfacePiece& piece, const ElementNames& names, const ExecutionContext& context)
    : All(communicator)
    , Names(names)
    , Part(this->All, piece, names, context)
    , ConstraintsOfSurface(this->Part)
  {
  }

  const Field& Solve(const FieldProblem& problem, const ExecutionContext& context);

  const PetscSession Session;
  const Ranks All;
  const ElementNames Names;
  const PieceOfSurface Part;
  ConstraintsInPieces ConstraintsOfSurface;
  StageCounts Counts;
  Field Last;

private:
  void SetUp(const DiscretisationOptions& options, const ExecutionContext& context);
  void SetSystem(const EquationsInPieces& equations, const ExecutionContext& context);
  void SolveSystem(const FieldProblem& problem, const Constraints& constraints, const ExecutionContext& context);
  void FindDirections(const FieldProblem& problem, FollowedConstraints followed, const ExecutionContext& context);
  void ClearIndicesOfOthers(Field& field) const;

  DiscretisationOptions OptionsOfSetup;
  std::unique_ptr<const SetupInPieces> Setup; ///< of these options
  bool HasSystem = false;                     ///< whether the set-up's multigrid has the matrix of Equations
  std::unique_ptr<const EquationsInPieces> Equations;
  StoppingCriteria Stop;
  Vector<double> Smoothest;                      ///< see EquationsInPieces::Solve
  std::shared_ptr<const FieldSolution> Solution; ///< of Equations and Stop
};

const Field& FieldSolverInPieces::Internals::Solve(const FieldProblem& problem, const ExecutionContext& context)
{
  CheckAgreement(this->All, problem);
  this->All.Together(
    [&]
    {
      if (const std::string reason = ReasonToGather(problem); !reason.empty())
      {
        throw InvalidInput(reason + "; gather the surface on one rank");
      }
    });
  this->Session.Check();
  this->SetUp(problem.Options.Field, PartOfContext(context, 0.0, 0.4));
  FollowedConstraints followed =
    this->ConstraintsOfSurface.Follow(problem, *this->Setup->Fields, PartOfContext(context, 0.4, 0.4), this->Names);
  this->SolveSystem(problem, followed.Constraints, PartOfContext(context, 0.4, 0.9));
  this->FindDirections(problem, std::move(followed), PartOfContext(context, 0.9, 1.0));
  return this->Last;
}

void FieldSolverInPieces::Internals::SetUp(const DiscretisationOptions& options, const ExecutionContext& context)
{
  const DiscretisationOptions counting = OptionsThatCount(options);
  if (this->Setup && this->OptionsOfSetup == counting)
  {
    return;
  }
  this->Solution.reset();
  this->Smoothest.resize(0);
  this->Equations.reset();
  this->HasSystem = false;
  this->Setup.reset(); // its memory, before that of the next
  this->Setup = std::make_unique<const SetupInPieces>(this->Part, counting, context);
  this->OptionsOfSetup = counting;
  ++this->Counts.Setups;
}

void FieldSolverInPieces::Internals::SetSystem(const EquationsInPieces& equations, const ExecutionContext& context)
{
  const bool isSame = this->HasSystem && equations.HasSameMatrix(*this->Equations);
  if (this->All.Any(!isSame))
  {
    this->HasSystem = false;
    equations.SetMatrix(context);
    ++this->Counts.Systems;
  }
}

void FieldSolverInPieces::Internals::SolveSystem(
  const FieldProblem& problem, const Constraints& constraints, const ExecutionContext& context)
{
  const Stopwatch watch;
  const std::vector<PowerAtVertex> atOwned =
    ConstraintsAtOwned(this->Part, *this->Setup->Fields, constraints, this->Names);
  auto equations = std::make_unique<const EquationsInPieces>(*this->Setup, atOwned,
    problem.Options.Field.HasDirections() ? Vector<double>()
                                          : SourceAtOwned(this->Part, constraints.Source, this->Names),
    constraints.Net, problem.Options.Weights());
  const bool isSame = this->Solution && equations->HasSameMatrix(*this->Equations) &&
    equations->HasSameValues(*this->Equations) && this->Stop == problem.Stop;
  if (!this->All.Any(!isSame))
  {
    return;
  }
  this->Solution.reset();
  this->SetSystem(*equations, PartOfContext(context, 0.0, 0.5));
  this->Equations = std::move(equations);
  this->HasSystem = true;
  FieldSolution solution;
  solution.Discretisation = this->Setup->Fields;
  solution.Report.PrepareSeconds = watch.Seconds();
  const std::vector<Complex> all = this->Part.WithGhosts<Complex>(
    this->Equations->Solve(this->Smoothest, problem.Stop, solution.Report, PartOfContext(context, 0.5, 1.0)));
  solution.Unknowns = this->Setup->Fields->AsUnknowns(
    Eigen::Map<const Vector<Complex>>(all.data(), static_cast<Eigen::Index>(all.size())));
  solution.Constraints = this->Setup->Fields->MeansOf(this->Part.WithGhosts<PowerAtVertex>(atOwned));
  solution.SetupSeconds = this->Setup->Seconds;
  this->Solution = std::make_shared<const FieldSolution>(std::move(solution));
  this->Stop = problem.Stop;
  ++this->Counts.Solves;
}

void FieldSolverInPieces::Internals::FindDirections(
  const FieldProblem& problem, FollowedConstraints followed, const ExecutionContext& context)
{
  const bool isNew = this->Last.Solution != this->Solution;
  if (isNew || this->Last.IsCombed != problem.Combing)
  {
    Field field;
    this->All.Together(
      [&]
      {
        field = DirectionsOfField(this->Part.Surface(), *this->Solution->Discretisation, this->Solution->Unknowns,
          problem.Combing, this->Last.Solution ? &this->Last : nullptr, context);
        this->ClearIndicesOfOthers(field);
      });
    if (problem.Combing)
    {
      CombOverSeams(this->Part, field);
    }
    field.Report = this->Solution->Report;
    field.Solution = this->Solution;
    this->Last = std::move(field);
  }
  this->Last.HasUnitLength = problem.UnitLength;
  this->Last.Guides = followed.Guides;
  this->Last.Features = std::move(followed.Features);
  if (isNew)
  {
    const std::vector<std::string>& more = this->Last.Report.Warnings;
    followed.Warnings.insert(followed.Warnings.end(), more.begin(), more.end());
  }
  this->Last.Warnings = std::move(followed.Warnings);
}

/// Ghosts do not have all of their neighbours.
void FieldSolverInPieces::Internals::ClearIndicesOfOthers(Field& field) const
{
  std::vector<char> isKnown(field.Indices.size(), 0);
  for (int triangle = 0; triangle < this->Part.NumberOfOwnFaces(); ++triangle)
  {
    const int face = this->Part.FirstOwnFace() + triangle;
    for (int k = 0; k < 3; ++k)
    {
      isKnown[field.AreSingularitiesOnFaces ? face : this->Part.Surface().Mesh.FaceCorners()(face, k)] = 1;
    }
  }
  for (Eigen::Index element = 0; element < field.Indices.size(); ++element)
  {
    field.Indices[element] = isKnown[element] ? field.Indices[element] : 0.0;
  }
}

FieldSolverInPieces::FieldSolverInPieces(
  MPI_Comm communicator, const SurfacePiece& piece, const ElementNames& names, const ExecutionContext& context)
  : Internal(
      EndingTogether(communicator, [&] { return std::make_unique<Internals>(communicator, piece, names, context); }))
{
}

FieldSolverInPieces::~FieldSolverInPieces() = default;

const PieceOfSurface& FieldSolverInPieces::Piece() const
{
  return this->Internal->Part;
}

const Field& FieldSolverInPieces::Solve(const FieldProblem& problem, const ExecutionContext& context)
{
  return EndingTogether(
    this->Internal->All.Communicator(), [&]() -> const Field& { return this->Internal->Solve(problem, context); });
}

bool FieldSolverInPieces::ReportsIndexOf(int element) const
{
  const PieceOfSurface& piece = this->Internal->Part;
  return this->Internal->Last.AreSingularitiesOnFaces ? piece.IsOwnFace(element) : piece.IsOwned(element);
}

StageCounts FieldSolverInPieces::Counts() const
{
  return this->Internal->Counts;
}

}
