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
#include "Support/SparseAssembly.h"
#include "Support/Stopwatch.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <string>

namespace dmg
{

namespace
{

/// The matrix of a linear triangle over its diagonal has the trace 3 and no negative eigenvalue.
constexpr double LargestEigenvalueOfElements = 3.0;

/// A bound of the eigenvalues of a matrix over its diagonal: by elements, or by the sums of its rows.
double LargestEigenvalue(const Ranks& ranks, const SparseMatrix<Complex>& owned, int firstColumn)
{
  double largest = 1.0;
  for (int i = 0; i < owned.rows(); ++i)
  {
    double sum = 0.0;
    double diagonal = 0.0;
    for (SparseMatrix<Complex>::InnerIterator entry(owned, i); entry; ++entry)
    {
      sum += std::abs(entry.value());
      diagonal += entry.col() == firstColumn + i ? entry.value().real() : 0.0;
    }
    largest = std::max(largest, diagonal > 0.0 ? sum / diagonal : LargestEigenvalueOfElements);
  }
  return std::min(ranks.Max(largest), LargestEigenvalueOfElements);
}

/// With two cycles, functions mind uneven triangles less, as in ScalarFunction.
constexpr int CyclesOfFunctions = 2;

std::vector<int> Consecutive(int first, int size)
{
  std::vector<int> numbers(size);
  std::iota(numbers.begin(), numbers.end(), first);
  return numbers;
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
  this->MakeLaplacian(context);
  this->Prolongations =
    LevelsOfPieces(this->Part, VertexPowerField::DistanceOfSamples, PartOfContext(context, 0.2, 1.0));
  for (RowsOfRank<Complex>& prolongation : this->Prolongations)
  {
    const bool isFunction = this->IsFunction();
    this->All.Together(
      [&]
      {
        prolongation.Rows = isFunction ? SparseMatrix<Complex>(prolongation.Rows.cwiseAbs().cast<Complex>())
                                       : OnPowers(prolongation.Rows, this->OptionsOfField.N, context);
      });
  }
  this->SetupSeconds = this->Watch.Seconds();
}

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

void PieceFieldSolver::MakeLaplacian(const ExecutionContext& context)
{
  const PieceOfSurface& piece = this->Part;
  const int owned = piece.NumberOfOwned();
  const bool isFunction = this->IsFunction();
  this->Mass.setZero(owned);
  this->Stiffness.setZero(owned);
  this->All.Together(
    [&]
    {
      if (piece.IsEmpty())
      {
        return;
      }
      const TriangleMesh& mesh = piece.Surface().Mesh;
      const Vector<double> areas = isFunction ? Star0(mesh, this->OptionsOfField.Areas) : LumpedMass(mesh, context);
      this->Mass = areas.segment(piece.FirstOwned(), owned);
      const std::vector<int> rows = Consecutive(piece.FirstOwned(), owned);
      this->Laplacian.Rows = isFunction
        ? SelectRows<Complex>(CotangentLaplacian(mesh, context).cast<Complex>(), rows, context)
        : SelectRows(ConnectionLaplacian(mesh, piece.Connection(), this->OptionsOfField.N, context), rows, context);
      for (int i = 0; i < owned; ++i)
      {
        this->Stiffness[i] = this->Laplacian.Rows.coeff(i, piece.FirstOwned() + i).real();
      }
    });
  const double mean = this->All.Sum(this->Mass.sum()) / static_cast<double>(piece.GlobalNumberOfVertices());
  this->MeanMass = mean > 0.0 ? mean : 1.0;
  this->Mass = mean > 0.0 ? Vector<double>(this->Mass / mean) : Vector<double>::Ones(owned);
  this->Laplacian.GlobalColumns = piece.GlobalNumbers();
  this->Laplacian.OwnedColumns = owned;
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
  const std::vector<char> isHeld = this->Part.WithGhosts<char>(system.IsHeld);
  const std::vector<Complex> known = this->Part.WithGhosts<Complex>(system.Known);

  RowsOfRank<Complex> matrix;
  std::vector<RowsOfRank<Complex>> prolongations;
  Vector<Complex> b;
  this->All.Together(
    [&]
    {
      matrix = this->Laplacian;
      prolongations = this->Prolongations;
      b = this->SetEquations(system, isHeld, known, matrix.Rows, prolongations);
      const double smoothness = weights.Constraints == ConstraintKind::Hard ? 1.0 : weights.Smoothness;
      AddSource(source.IntegralsAtOwned() / smoothness, system.IsHeld, b);
    });
  PieceField field;
  field.UnheldComponents = system.UnheldComponents;
  field.SetupSeconds = this->SetupSeconds;
  PetscMultigrid solver(this->All, matrix, prolongations,
    LargestEigenvalue(this->All, matrix.Rows, this->Part.FirstOwned()), this->IsFunction() ? CyclesOfFunctions : 1,
    PartOfContext(context, 0.0, 0.5));
  field.Report.Solver = std::string(system.HoldsAny ? "conjugate gradients" : "LOBPCG") +
    " with one V-cycle, by PETSc on " + std::to_string(this->All.Size()) + " ranks";
  field.Report.Levels = solver.Levels();
  field.Report.PrepareSeconds = watch.Seconds();
  Vector<Complex> x =
    system.Known + this->SolveSystem(system, solver, b, stop, field.Report, PartOfContext(context, 0.5, 1.0));
  if (source.IsAny())
  {
    source.Centre(system.IsReached, x);
  }
  const std::vector<Complex> all = this->Part.WithGhosts<Complex>(x);
  field.AtVertices = Eigen::Map<const Vector<Complex>>(all.data(), static_cast<Eigen::Index>(all.size()));
  return field;
}

/// By conjugate gradients where something is held, and the smoothest field elsewhere.
Vector<Complex> PieceFieldSolver::SolveSystem(const System& system, PetscMultigrid& solver, const Vector<Complex>& b,
  const StoppingCriteria& stop, SolveReport& report, const ExecutionContext& context) const
{
  report.Converged = true;
  Vector<Complex> x = Vector<Complex>::Zero(b.size());
  if (system.HoldsAny)
  {
    x = solver.Solve(b, stop, report, context);
  }
  if (system.Smoothest.NumberOfComponents() > 0)
  {
    std::vector<IterationReport> iterations =
      system.Smoothest.Find(solver, this->MeanMass, stop.MaximumIterations, x, report, context);
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

/// Adds penalties to the Laplacian, takes held vertices out of it and out of the finest prolongation, and
/// weakens the latter where penalties are strong.
/// \return what remains on the right when the known values are taken away: D y and the diagonal solution cancel.
Vector<Complex> PieceFieldSolver::SetEquations(const System& system, const std::vector<char>& isHeld,
  const std::vector<Complex>& known, SparseMatrix<Complex>& matrix,
  std::vector<RowsOfRank<Complex>>& prolongations) const
{
  const int first = this->Part.FirstOwned();
  Vector<Complex> b = Vector<Complex>::Zero(this->Part.NumberOfOwned());
  for (int i = 0; i < this->Part.NumberOfOwned(); ++i)
  {
    double share = 0.0; // of the Laplacian in the diagonal
    for (SparseMatrix<Complex>::InnerIterator entry(matrix, i); entry; ++entry)
    {
      const int column = static_cast<int>(entry.col());
      if (column == first + i)
      {
        const double diagonal = entry.value().real() + system.D[i];
        share = system.IsHeld[i] || diagonal <= 0.0 ? 0.0 : entry.value().real() / diagonal;
        entry.valueRef() = diagonal > 0.0 ? diagonal : 1.0;
        continue;
      }
      b[i] -= system.IsHeld[i] ? Complex(0.0) : Complex(entry.value() * known[column]);
      if (system.IsHeld[i] || isHeld[column])
      {
        entry.valueRef() = 0.0;
      }
    }
    if (!prolongations.empty())
    {
      prolongations[0].Rows.row(i) *= share;
    }
  }
  return b;
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
    const double diagonal = this->Stiffness[i];
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
  system.Smoothest = SmoothestInPieces(this->All, numbersOfOwned, smoothest, this->Stiffness, this->Mass);
  system.Smoothest.AddShifts(system.D);
  const bool hasFree = std::find(system.IsHeld.begin(), system.IsHeld.end(), 0) != system.IsHeld.end();
  if (!this->All.Any(hasFree))
  {
    throw InvalidInput(
      "hard constraints hold all vertices, so that nothing is left to solve for; make them soft, or leave some out");
  }
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
    const std::unique_ptr<const Discretisation> discretisation = MakeDiscretisation(this->OptionsOfField, surface);
    const bool isFunction = this->IsFunction();
    const Vector<double> unknowns =
      isFunction ? Vector<double>(field.AtVertices.real()) : Vector<double>(AsPairs(field.AtVertices));
    directions = DirectionsOfField(surface, *discretisation, unknowns, combing, nullptr, context);
  }
  return directions;
}

}
