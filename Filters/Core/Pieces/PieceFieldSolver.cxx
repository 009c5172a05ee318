#include "Pieces/PieceFieldSolver.h"

#include "Discretisations/MakeDiscretisation.h"
#include "Discretisations/PowerField.h"
#include "Discretisations/VertexPowerField.h"
#include "Levels/TransportOperator.h"
#include "Operators/ConnectionLaplacian.h"
#include "Operators/CotangentLaplacian.h"
#include "Operators/PowerFieldOperators.h"
#include "Pieces/PetscMultigrid.h"
#include "Pieces/PieceConstraints.h"
#include "Pieces/SmoothestInPieces.h"
#include "Pieces/SourceInPieces.h"
#include "Solvers/LimitedPenalty.h"
#include "Support/ComplexPairs.h"
#include "Support/Errors.h"
#include "Support/Remedy.h"
#include "Support/ShortText.h"
#include "Support/Stopwatch.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

namespace dmg
{

namespace
{

/// With two cycles, functions mind uneven triangles less, as in ScalarFunction.
constexpr int CyclesOfFunctions = 2;

/// Keeps consecutive rows, in place.
void KeepRows(SparseMatrix<Complex>& matrix, int first, int count)
{
  int* const offsets = matrix.outerIndexPtr();
  const int begin = offsets[first];
  const int end = offsets[first + count];
  std::copy(matrix.innerIndexPtr() + begin, matrix.innerIndexPtr() + end, matrix.innerIndexPtr());
  std::copy(matrix.valuePtr() + begin, matrix.valuePtr() + end, matrix.valuePtr());
  for (int row = 0; row <= count; ++row)
  {
    offsets[row] = offsets[first + row] - begin;
  }
  matrix.conservativeResize(count, matrix.cols());
  matrix.resizeNonZeros(end - begin);
}

std::string TextOf(const DiscretisationOptions& field)
{
  return "kind " + std::to_string(static_cast<int>(field.Kind)) + ", N = " + std::to_string(field.N) + ", areas " +
    std::to_string(static_cast<int>(field.Areas));
}

std::string TextOf(const FieldWeights& weights, const StoppingCriteria& stop)
{
  return "smoothness " + ShortText(weights.Smoothness) + ", alignment " + ShortText(weights.Alignment) +
    (weights.Constraints == ConstraintKind::Hard ? ", hard" : ", soft") + ", tolerance " +
    ShortText(stop.RelativeTolerance) + ", iterations " + std::to_string(stop.MaximumIterations);
}

/// \param source of owned vertices.
void AddSource(const Vector<double>& source, const std::vector<char>& isHeld, Vector<Complex>& b)
{
  for (Eigen::Index i = 0; i < source.size(); ++i)
  {
    b[i] += isHeld[i] ? 0.0 : source[i];
  }
}

}

/// The equations of owned unknowns.
struct PieceFieldSolver::System
{
  Vector<double> D = {};
  Vector<Complex> Known = {}; ///< values that are held, and the diagonal solution elsewhere
  std::vector<char> IsHeld = {};
  std::vector<char> IsReached = {}; ///< by component, whether a constraint holds it
  SmoothestInPieces Smoothest;
  bool HoldsAny = false; ///< whether a constraint does
  int UnheldComponents = 0;
};

PieceFieldSolver::PieceFieldSolver(MPI_Comm communicator, const SurfacePiece& piece, const DiscretisationOptions& field,
  const ElementNames& names, const ExecutionContext& context)
  : All(communicator)
  , OptionsOfField(field)
  , Names(names)
  , OwnPart(std::make_unique<const PieceOfSurface>(this->All, piece, names, PartOfContext(context, 0.0, 0.5)))
  , Part(*this->OwnPart)
{
  this->SetUp(PartOfContext(context, 0.5, 1.0));
}

PieceFieldSolver::PieceFieldSolver(const PieceOfSurface& piece, const DiscretisationOptions& field,
  const ElementNames& names, const ExecutionContext& context)
  : All(piece.Everyone().Communicator())
  , OptionsOfField(field)
  , Names(names)
  , Part(piece)
{
  this->SetUp(context);
}

void PieceFieldSolver::SetUp(const ExecutionContext& context)
{
  this->CheckField();
  this->Components = ComponentsOfPieces(this->Part);
  this->SetMass(context);
  std::vector<RowsOfRank<Complex>> prolongations = this->Prolongations(context);
  this->Multigrid = std::make_unique<PetscMultigrid>(
    this->All, this->Laplacian(context), std::move(prolongations), this->IsFunction() ? CyclesOfFunctions : 1);
  this->SetupSeconds = this->Watch.Seconds();
}

PieceFieldSolver::~PieceFieldSolver() = default;

void PieceFieldSolver::CheckField() const
{
  this->All.CheckSame(TextOf(this->OptionsOfField), "the field");
  if (this->Part.GlobalNumberOfVertices() == 0)
  {
    throw InvalidInput("no rank has a triangle of the surface; give at least one a piece");
  }
  if (this->OptionsOfField.Kind == DiscretisationKind::VertexPowerField)
  {
    CheckNumberOfDirections(this->OptionsOfField.N);
  }
  else if (this->OptionsOfField.Kind != DiscretisationKind::ScalarFunction)
  {
    throw InvalidInput(
      "on a surface in pieces there are power fields at points and functions; for other fields gather it on "
      "one rank");
  }
}

void PieceFieldSolver::SetMass(const ExecutionContext& context)
{
  const int owned = this->Part.NumberOfOwned();
  this->Mass.setZero(owned);
  this->All.Together(
    [&]
    {
      if (!this->Part.IsEmpty())
      {
        const TriangleMesh& mesh = this->Part.Surface().Mesh;
        const Vector<double> areas =
          this->IsFunction() ? Star0(mesh, this->OptionsOfField.Areas) : LumpedMass(mesh, context);
        this->Mass = areas.segment(this->Part.FirstOwned(), owned);
      }
    });
  const double mean = this->All.Sum(this->Mass.sum()) / static_cast<double>(this->Part.GlobalNumberOfVertices());
  this->MeanMass = mean > 0.0 ? mean : 1.0;
  this->Mass = mean > 0.0 ? Vector<double>(this->Mass / mean) : Vector<double>::Ones(owned);
}

/// The rows of owned vertices.
RowsOfRank<Complex> PieceFieldSolver::Laplacian(const ExecutionContext& context) const
{
  RowsOfRank<Complex> laplacian;
  laplacian.OwnedColumns = this->Part.NumberOfOwned();
  this->All.Together(
    [&]
    {
      if (!this->Part.IsEmpty())
      {
        const TriangleMesh& mesh = this->Part.Surface().Mesh;
        SparseMatrix<Complex> rows = this->IsFunction()
          ? SparseMatrix<Complex>(CotangentLaplacian(mesh, context).cast<Complex>())
          : ConnectionLaplacian(mesh, this->Part.Connection(), this->OptionsOfField.N, context);
        laplacian.Rows.swap(rows);
        KeepRows(laplacian.Rows, this->Part.FirstOwned(), this->Part.NumberOfOwned());
      }
      laplacian.GlobalColumns = this->Part.GlobalNumbers();
    });
  return laplacian;
}

/// The prolongations of powers or values.
std::vector<RowsOfRank<Complex>> PieceFieldSolver::Prolongations(const ExecutionContext& context) const
{
  std::vector<RowsOfRank<Complex>> prolongations =
    LevelsOfPieces(this->Part, VertexPowerField::DistanceOfSamples, PartOfContext(context, 0.2, 1.0));
  for (RowsOfRank<Complex>& prolongation : prolongations)
  {
    this->All.Together(
      [&]
      {
        SparseMatrix<Complex> rows = this->IsFunction()
          ? SparseMatrix<Complex>(prolongation.Rows.cwiseAbs().cast<Complex>())
          : OnPowers(prolongation.Rows, this->OptionsOfField.N, context);
        prolongation.Rows.swap(rows);
      });
  }
  return prolongations;
}

PieceField PieceFieldSolver::Solve(const Constraints& constraints, const FieldWeights& weights,
  const StoppingCriteria& stop, const ExecutionContext& context)
{
  const Stopwatch watch;
  this->Session.Check();
  this->All.CheckSame(TextOf(weights, stop), "weights or criteria");
  CheckWeights(weights);
  const std::vector<PowerAtVertex> atOwned =
    ConstraintsAtOwned(this->Part, this->OptionsOfField, constraints, this->Names);
  System system = this->MakeSystem(atOwned, weights);
  SourceInPieces source(this->Part, this->Components, constraints, this->Names);
  this->HoldComponents(system, atOwned, source.IsAny());
  if (source.IsAny())
  {
    source.Balance(system.IsReached, constraints.Net);
    system.UnheldComponents = 0; // the source has a solution there
  }
  this->SetSystem(system, PartOfContext(context, 0.0, 0.5));
  Vector<Complex> b = this->RightHandSide(system);
  const double smoothness = weights.Constraints == ConstraintKind::Hard ? 1.0 : weights.Smoothness;
  AddSource(source.IntegralsAtOwned() / smoothness, system.IsHeld, b);
  PieceField field;
  field.UnheldComponents = system.UnheldComponents;
  field.SetupSeconds = this->SetupSeconds;
  field.Report.Solver = std::string(system.HoldsAny ? "conjugate gradients" : "LOBPCG") +
    " with one V-cycle, by PETSc on " + std::to_string(this->All.Size()) + " ranks";
  field.Report.Levels = this->Multigrid->Levels();
  field.Report.PrepareSeconds = watch.Seconds();
  Vector<Complex> x = this->SolveSystem(system, b, stop, field.Report, PartOfContext(context, 0.5, 1.0));
  if (source.IsAny())
  {
    source.Centre(system.IsReached, x);
  }
  const std::vector<Complex> all = this->Part.WithGhosts<Complex>(x);
  field.AtVertices = Eigen::Map<const Vector<Complex>>(all.data(), static_cast<Eigen::Index>(all.size()));
  ++this->Completed.Solves;
  return field;
}

/// Keeps the matrices where penalties are the same on all ranks.
void PieceFieldSolver::SetSystem(const System& system, const ExecutionContext& context)
{
  const bool isSame = this->HasSystem && this->Penalties == system.D && this->HeldVertices == system.IsHeld;
  if (!this->All.Any(!isSame))
  {
    return;
  }
  this->HasSystem = false;
  this->Multigrid->SetPenalties(system.D, system.IsHeld, context);
  this->Penalties = system.D;
  this->HeldVertices = system.IsHeld;
  this->HasSystem = true;
  ++this->Completed.Systems;
}

/// The rest when the known values are taken away: D y and the diagonal solution cancel.
Vector<Complex> PieceFieldSolver::RightHandSide(const System& system) const
{
  Vector<Complex> b = -this->Multigrid->MultiplyOffDiagonal(system.Known);
  for (Eigen::Index i = 0; i < b.size(); ++i)
  {
    b[i] = system.IsHeld[i] ? Complex(0.0) : b[i];
  }
  return b;
}

/// Conjugate gradients where something is held, and the smoothest field elsewhere.
Vector<Complex> PieceFieldSolver::SolveSystem(const System& system, const Vector<Complex>& b,
  const StoppingCriteria& stop, SolveReport& report, const ExecutionContext& context)
{
  report.Converged = true;
  Vector<Complex> x = system.Known;
  if (system.HoldsAny)
  {
    x += this->Multigrid->Solve(b, stop, report, context);
  }
  if (system.Smoothest.NumberOfComponents() > 0)
  {
    this->FormerSmoothest.conservativeResizeLike(Vector<Complex>::Zero(x.size()));
    std::vector<IterationReport> iterations = system.Smoothest.Find(
      *this->Multigrid, this->MeanMass, stop.MaximumIterations, this->FormerSmoothest, x, report, context);
    if (!system.HoldsAny)
    {
      report.Iterations = std::move(iterations);
      report.Returned = report.Iterations.back().Iteration;
    }
  }
  if (const int zero = system.UnheldComponents - system.Smoothest.NumberOfComponents(); zero > 0)
  {
    report.Warnings.push_back(std::to_string(zero) +
      (this->IsFunction()
          ? " components of the surface hold no prescribed value; the function is zero there"
          : " components of the surface hold no prescribed direction and have no area; the field is zero "
            "there"));
  }
  return x;
}

PieceFieldSolver::System PieceFieldSolver::MakeSystem(
  const std::vector<PowerAtVertex>& constraints, const FieldWeights& weights) const
{
  const int owned = this->Part.NumberOfOwned();
  System system{ Vector<double>::Zero(owned), Vector<Complex>::Zero(owned), std::vector<char>(owned, 0), {},
    SmoothestInPieces(this->All) };
  for (int i = 0; i < owned; ++i)
  {
    const PowerAtVertex& constraint = constraints[i];
    if (!(constraint.Weight > 0.0))
    {
      continue;
    }
    const Complex value = constraint.Power / constraint.Weight;
    if (weights.Constraints == ConstraintKind::Hard)
    {
      system.IsHeld[i] = 1;
      system.Known[i] = value;
      continue;
    }
    const double diagonal = this->Multigrid->Stiffness()[i];
    const double penalty = weights.Alignment * constraint.Weight * this->Mass[i] / weights.Smoothness;
    system.D[i] = LimitedPenalty(penalty, diagonal);
    system.Known[i] = system.D[i] > 0.0 ? Complex(system.D[i] / (diagonal + system.D[i]) * value) : Complex(0.0);
  }
  return system;
}

/// Components without constraints get the smoothest field, if they have one; else one vertex is held at zero, the solution
/// there.
void PieceFieldSolver::HoldComponents(
  System& system, const std::vector<PowerAtVertex>& constraints, bool hasSource) const
{
  const int owned = this->Part.NumberOfOwned();
  const std::vector<int>& components = this->Components.OfOwned;
  std::vector<char> isReached(this->Components.NumberBound, 0);
  std::vector<char> isThere = isReached;
  std::vector<char> hasArea = isReached;
  bool isConstrained = false;
  for (int i = 0; i < owned; ++i)
  {
    const bool holds = constraints[i].Weight > 0.0 && (system.D[i] > 0.0 || system.IsHeld[i]);
    isReached[components[i]] |= holds;
    isThere[components[i]] = 1;
    hasArea[components[i]] |= this->Mass[i] > 0.0;
    isConstrained |= constraints[i].Weight > 0.0;
  }
  isConstrained = this->All.Any(isConstrained);
  this->All.Any(isReached);
  this->All.Any(hasArea);
  std::vector<char> isAnywhere = isThere;
  this->All.Any(isAnywhere);
  system.IsReached = isReached;
  system.HoldsAny = hasSource || std::find(isReached.begin(), isReached.end(), 1) != isReached.end();
  if (!system.HoldsAny && isConstrained)
  {
    throw InvalidInput(
      "all prescribed cells have zero area, so that they hold nothing; prescribe a direction on another "
      "cell or make the constraints hard");
  }
  if (!system.HoldsAny && this->IsFunction())
  {
    throw InvalidInput("no rank prescribes a value, so the function of least smoothness energy is zero; " +
      TextOf(Remedy::PrescribedValues));
  }
  std::vector<int> numbers(isThere.size(), -1); // of components with a smoothest field
  std::vector<int> ranksThatHold(isThere.size(), this->All.Size());
  int smoothest = 0;
  for (std::size_t component = 0; component < isThere.size(); ++component)
  {
    const bool isUnheld = isAnywhere[component] && !isReached[component];
    const bool hasSmoothest = isUnheld && hasArea[component] && !this->IsFunction();
    system.UnheldComponents += isUnheld;
    numbers[component] = hasSmoothest ? smoothest++ : -1;
    if (isUnheld && !hasSmoothest && isThere[component])
    {
      ranksThatHold[component] = this->All.Rank();
    }
  }
  this->HoldOneVertex(ranksThatHold, system);
  std::vector<int> numbersOfOwned;
  for (const int component : components)
  {
    numbersOfOwned.push_back(numbers[component]);
  }
  system.Smoothest = SmoothestInPieces(this->All, numbersOfOwned, smoothest, this->Multigrid->Stiffness(), this->Mass);
  system.Smoothest.AddShifts(system.D);
}

/// Holds the first vertex of some components at zero, on the lowest rank that has one.
/// \param ranks per component this rank if it has such a vertex, else the number of ranks.
void PieceFieldSolver::HoldOneVertex(std::vector<int>& ranks, System& system) const
{
  MPI_Allreduce(MPI_IN_PLACE, ranks.data(), static_cast<int>(ranks.size()), MPI_INT, MPI_MIN, this->All.Communicator());
  for (int i = 0; i < this->Part.NumberOfOwned(); ++i)
  {
    int& rank = ranks[this->Components.OfOwned[i]];
    if (rank == this->All.Rank())
    {
      rank = this->All.Size(); // done
      system.IsHeld[i] = 1;
      system.Known[i] = 0.0;
    }
  }
}

Field PieceFieldSolver::Directions(const PieceField& field, bool combing, const ExecutionContext& context) const
{
  Field directions;
  if (!this->Part.IsEmpty())
  {
    const FramedMesh& surface = this->Part.Surface();
    const bool isFunction = this->IsFunction();
    const std::unique_ptr<const Discretisation> discretisation =
      MakeDiscretisation(this->OptionsOfField, surface, &this->Part.Connection());
    const Vector<double> unknowns =
      isFunction ? Vector<double>(field.AtVertices.real()) : Vector<double>(AsPairs(field.AtVertices));
    directions = DirectionsOfField(surface, *discretisation, unknowns, combing, nullptr, context);
  }
  return directions;
}

}
