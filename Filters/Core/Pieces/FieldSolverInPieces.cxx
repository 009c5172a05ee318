#include "Pieces/FieldSolverInPieces.h"

#include "Discretisations/MakeDiscretisation.h"
#include "Pieces/CombingOverSeams.h"
#include "Pieces/ConstraintsInPieces.h"
#include "Pieces/PetscSession.h"
#include "Pieces/PieceConstraints.h"
#include "Pieces/PieceFieldSolver.h"
#include "Pieces/ProblemAgreement.h"
#include "Support/ComplexPairs.h"
#include "Support/Errors.h"

#include <algorithm>
#include <optional>
#include <string>
#include <tuple>
#include <utility>

namespace dmg
{
namespace
{

bool AreSame(const Constraint& a, const Constraint& b)
{
  return a.Element == b.Element && a.Direction == b.Direction && a.Weight == b.Weight && a.Side == b.Side;
}

bool AreSame(const ValueConstraint& a, const ValueConstraint& b)
{
  return a.Vertex == b.Vertex && a.Value == b.Value && a.Weight == b.Weight;
}

template <class Item>
bool AreSame(const std::vector<Item>& a, const std::vector<Item>& b)
{
  return std::equal(a.begin(), a.end(), b.begin(), b.end(), [](const Item& x, const Item& y) { return AreSame(x, y); });
}

/// All that a solve depends on.
struct SolveKey
{
  FieldOptions Options;
  dmg::Constraints Constraints;
  StoppingCriteria Stop;

  bool IsSame(const SolveKey& other) const
  {
    const dmg::Constraints &a = this->Constraints, &b = other.Constraints;
    return this->Options == other.Options && this->Stop == other.Stop && AreSame(a.OnFaces, b.OnFaces) &&
      AreSame(a.AtVertices, b.AtVertices) && AreSame(a.Values, b.Values) && a.Net == b.Net &&
      a.Source.size() == b.Source.size() && a.Source == b.Source;
  }
};

}

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
    if (this->Part.GlobalNumberOfVertices() == 0)
    {
      throw InvalidInput("no rank has a triangle of the surface; give at least one a piece");
    }
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
  void SetDiscretisation(const DiscretisationOptions& options, const ExecutionContext& context);
  void SolveSystem(const FieldProblem& problem, const Constraints& constraints, const ExecutionContext& context);
  void FindDirections(const FieldProblem& problem, FollowedConstraints followed, const ExecutionContext& context);
  void ClearIndicesOfOthers(Field& field) const;

  DiscretisationOptions OptionsOfSolver;
  std::unique_ptr<PieceFieldSolver> Solver; ///< of these options
  std::optional<SolveKey> KeyOfSolution;
  std::shared_ptr<const FieldSolution> Solution; ///< of this key
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
  FollowedConstraints followed =
    this->ConstraintsOfSurface.Follow(problem, PartOfContext(context, 0.0, 0.0), this->Names);
  this->SetDiscretisation(problem.Options.Field, PartOfContext(context, 0.0, 0.4));
  this->SolveSystem(problem, followed.Constraints, PartOfContext(context, 0.4, 0.9));
  this->FindDirections(problem, std::move(followed), PartOfContext(context, 0.9, 1.0));
  return this->Last;
}

void FieldSolverInPieces::Internals::SetDiscretisation(
  const DiscretisationOptions& options, const ExecutionContext& context)
{
  const DiscretisationOptions counting = OptionsThatCount(options);
  if (this->All.Any(!this->Solver || !(this->OptionsOfSolver == counting)))
  {
    this->KeyOfSolution.reset();
    this->Solution.reset();
    this->Solver.reset(); // its memory, before that of the next
    this->Solver = std::make_unique<PieceFieldSolver>(this->Part, counting, this->Names, context);
    this->OptionsOfSolver = counting;
    ++this->Counts.Setups;
  }
}

void FieldSolverInPieces::Internals::SolveSystem(
  const FieldProblem& problem, const Constraints& constraints, const ExecutionContext& context)
{
  const SolveKey key{ problem.Options, constraints, problem.Stop };
  if (!this->All.Any(!this->KeyOfSolution || !this->KeyOfSolution->IsSame(key)))
  {
    return;
  }
  const int systems = this->Solver->Counts().Systems;
  const PieceField field = this->Solver->Solve(constraints, problem.Options.Weights(), problem.Stop, context);
  FieldSolution solution;
  this->All.Together(
    [&]
    {
      if (!this->Part.IsEmpty())
      {
        const bool isFunction = this->OptionsOfSolver.Kind == DiscretisationKind::ScalarFunction;
        solution.Discretisation =
          MakeDiscretisation(this->OptionsOfSolver, this->Part.Surface(), &this->Part.Connection());
        solution.Unknowns =
          isFunction ? Vector<double>(field.AtVertices.real()) : Vector<double>(AsPairs(field.AtVertices));
      }
    });
  solution.Constraints = ConstraintsAtVertices(
    this->Part, this->OptionsOfSolver, ConstraintsAtOwned(this->Part, this->OptionsOfSolver, constraints, this->Names));
  solution.Report = field.Report;
  solution.SetupSeconds = field.SetupSeconds;
  this->Solution = std::make_shared<const FieldSolution>(std::move(solution));
  this->KeyOfSolution = key;
  this->Counts.Systems += this->Solver->Counts().Systems - systems;
  ++this->Counts.Solves;
}

void FieldSolverInPieces::Internals::FindDirections(
  const FieldProblem& problem, FollowedConstraints followed, const ExecutionContext& context)
{
  const bool isNew = this->Last.Solution != this->Solution;
  Field field;
  this->All.Together(
    [&]
    {
      const bool isFormer = this->Last.OnFaces.size() > 0;
      if (!this->Part.IsEmpty() && (isNew || this->Last.IsCombed != problem.Combing))
      {
        field = DirectionsOfField(this->Part.Surface(), *this->Solution->Discretisation, this->Solution->Unknowns,
          problem.Combing, isFormer ? &this->Last : nullptr, context);
        this->ClearIndicesOfOthers(field);
      }
    });
  if (isNew || this->Last.IsCombed != problem.Combing)
  {
    const bool isFunction = this->OptionsOfSolver.Kind == DiscretisationKind::ScalarFunction;
    field.N = isFunction ? 1 : this->OptionsOfSolver.N;
    field.AreSingularitiesOnFaces = !isFunction;
    field.IsCombed = problem.Combing;
    if (problem.Combing)
    {
      CombOverSeams(this->Part, field);
    }
    field.Number = this->Last.Number + 1;
    field.Report = this->Solution->Report;
    field.Solution = this->Solution;
    this->Last = std::move(field);
  }
  this->Last.HasUnitLength = problem.UnitLength;
  this->Last.Guides = followed.Guides;
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

bool FieldSolverInPieces::TellsIndexOf(int element) const
{
  const PieceOfSurface& piece = this->Internal->Part;
  return this->Internal->Last.AreSingularitiesOnFaces ? piece.IsOwnFace(element) : piece.IsOwned(element);
}

StageCounts FieldSolverInPieces::Counts() const
{
  return this->Internal->Counts;
}

}
