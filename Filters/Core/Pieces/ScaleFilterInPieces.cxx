#include "Pieces/ScaleFilterInPieces.h"

#include "Operators/FunctionSource.h"
#include "Pieces/Constraints/ConstraintsInPieces.h"
#include "Pieces/Solvers/OperatorsInPieces.h"
#include "Pieces/Solvers/PetscSession.h"
#include "Pieces/Solvers/SetupInPieces.h"
#include "Scales/ScaleSystem.h"
#include "Scales/SquaredStiffness.h"
#include "Solvers/Krylov/ConjugateGradient.h"
#include "Solvers/SolverMethod.h"
#include "Support/ComplexPairs.h"
#include "Support/Errors.h"
#include "Support/ShortText.h"

#include <algorithm>
#include <memory>
#include <optional>

namespace dmg
{

namespace
{

/// R plus a diagonal, by the off-diagonal part of R: its own diagonal changes with the penalties of the cycle.
class StiffnessInPieces : public LinearOperator<double>
{
public:
  /// \param setup is borrowed.
  StiffnessInPieces(const SetupInPieces& setup, int numbersPerUnknown)
    : Setup(setup)
    , NumbersPerUnknown(numbersPerUnknown)
  {
  }

  /// \param diagonal one for each number, that of R included.
  void SetDiagonal(const Vector<double>& diagonal) { this->Diagonal = diagonal; }

  int Size() const override { return static_cast<int>(this->Diagonal.size()); }
  double Apply(const Vector<double>& x, Vector<double>& y, const ExecutionContext&) const override
  {
    y = AsNumbers(
      this->Setup.Multigrid->MultiplyOffDiagonal(AsUnknowns(x, this->NumbersPerUnknown)), this->NumbersPerUnknown);
    y += this->Diagonal.cwiseProduct(x);
    return this->Sum(x.dot(y));
  }
  double Sum(double here) const override { return this->Setup.Piece.Everyone().Sum(here); }

private:
  const SetupInPieces& Setup;
  const int NumbersPerUnknown;
  Vector<double> Diagonal;
};

class SystemOfPieces : public ScaleSystem
{
public:
  SystemOfPieces(const PieceOfSurface& piece, const ScaleFilterOptions& options, const ExecutionContext& context);

  const LinearOperator<double>& Stiffness() const override { return this->StiffnessHere; }
  const LinearOperator<double>& Shifted() const override { return this->ShiftedStiffness; }
  void SetShift(double s, double ofInverse, SolveReport& report, const ExecutionContext& context) override;
  Vector<double> Solve(const LinearOperator<double>& A, bool isSquared, const Vector<double>& b,
    const StoppingCriteria& stop, SolveReport& report, const ExecutionContext& context) override;
  void Centre(Vector<double>& quantity) const override;
  Vector<double> UnknownsOf(const Vector<double>& quantity, const ExecutionContext&) const override
  {
    return quantity.segment(this->NumbersPerVertex * this->Piece.FirstOwned(), this->Mass.size());
  }
  Vector<double> QuantityOf(const Vector<double>& unknowns, const ExecutionContext&) const override;
  double Max(double here) const override { return this->Piece.Everyone().Max(here); }
  void Together(const std::function<void()>& step) const override { this->Piece.Everyone().Together(step); }

private:
  const PetscSession Session;
  const PieceOfSurface& Piece;
  const SetupInPieces Setup;
  Vector<double> Diagonal; ///< of R, for each number
  std::optional<FreeComponents> Free;
  StiffnessInPieces StiffnessHere, ShiftedStiffness;
};

SystemOfPieces::SystemOfPieces(
  const PieceOfSurface& piece, const ScaleFilterOptions& options, const ExecutionContext& context)
  : Piece(piece)
  , Setup(piece, FieldOptionsOf(options).Field, context)
  , StiffnessHere(this->Setup, options.Quantity == ScaledQuantity::Vectors ? 2 : 1)
  , ShiftedStiffness(this->Setup, options.Quantity == ScaledQuantity::Vectors ? 2 : 1)
{
  this->NumbersPerVertex = options.Quantity == ScaledQuantity::Vectors ? 2 : 1;
  this->Sizes = SizesOf(piece);
  this->MeanArea = this->Setup.MeanArea;
  this->Areas = Vector<double>::Zero(piece.NumberOfVertices());
  this->Areas.segment(piece.FirstOwned(), piece.NumberOfOwned()) = this->MeanArea * this->Setup.Mass;
  const Vector<double>& stiffness = this->Setup.Multigrid->Stiffness();
  this->Mass.resize(this->NumbersPerVertex * piece.NumberOfOwned());
  this->Diagonal.resize(this->Mass.size());
  double largest = 0.0;
  for (int i = 0; i < this->Mass.size(); ++i)
  {
    this->Mass[i] = this->Setup.Mass[i / this->NumbersPerVertex];
    this->Diagonal[i] = stiffness[i / this->NumbersPerVertex];
    largest = std::max(largest, this->Diagonal[i] / this->Mass[i]);
  }
  this->LargestEigenvalue = piece.Everyone().Max(largest);
  this->StiffnessHere.SetDiagonal(this->Diagonal);
  if (options.Quantity == ScaledQuantity::Function)
  {
    this->Free.emplace(
      this->Setup.Components.OfOwned, this->Setup.Components.NumberBound, std::vector<int>(), SumOf(piece.Everyone()));
  }
}

void SystemOfPieces::SetShift(double s, double ofInverse, SolveReport& report, const ExecutionContext& context)
{
  const Ranks& ranks = this->Piece.Everyone();
  EndingTogether(ranks.Communicator(),
    [&]
    {
      this->Session.Check();
      const std::vector<char> isHeld(this->Piece.NumberOfOwned(), 0);
      this->ShiftedStiffness.SetDiagonal(this->Diagonal + s * this->Mass);
      this->Setup.Multigrid->SetPenalties(ofInverse * this->Setup.Mass, isHeld, context);
      report.Solver = "conjugate gradients with a V-cycle, by PETSc on " + std::to_string(ranks.Size()) + " ranks";
      report.Levels = this->Setup.Multigrid->Levels();
    });
}

Vector<double> SystemOfPieces::Solve(const LinearOperator<double>& A, bool isSquared, const Vector<double>& b,
  const StoppingCriteria& asked, SolveReport& report, const ExecutionContext& context)
{
  const Ranks& ranks = this->Piece.Everyone();
  return EndingTogether(ranks.Communicator(),
    [&]
    {
      StoppingCriteria stop = asked;
      stop.MayEstimate = true;
      CycleInPieces cycle(*this->Setup.Multigrid, this->NumbersPerVertex);
      SquaredInverse twice(cycle, this->Mass);
      Preconditioner<double>& inverse = isSquared ? static_cast<Preconditioner<double>&>(twice) : cycle;
      Vector<double> x;
      ConjugateGradient(A, inverse, b, stop, x, report, ContextOfRanks(ranks, context));
      return x;
    });
}

void SystemOfPieces::Centre(Vector<double>& quantity) const
{
  if (this->Free)
  {
    Vector<double> owned = this->UnknownsOf(quantity, SerialContext());
    this->Free->Centre(owned, this->Setup.Mass);
    quantity = this->QuantityOf(owned, SerialContext());
  }
}

Vector<double> SystemOfPieces::QuantityOf(const Vector<double>& unknowns, const ExecutionContext&) const
{
  const std::vector<Complex> all = this->Piece.WithGhosts<Complex>(AsUnknowns(unknowns, this->NumbersPerVertex));
  return AsNumbers(
    Eigen::Map<const Vector<Complex>>(all.data(), static_cast<Eigen::Index>(all.size())), this->NumbersPerVertex);
}

}

std::string ReasonToGather(const ScaleFilterOptions& options)
{
  if (!options.Fixed.empty())
  {
    return "functions with fixed values are filtered on one process";
  }
  if (!options.RelativeWavelengths.empty())
  {
    return "wavelengths that vary are those of one process";
  }
  const SolverKind kind = options.Solver.Kind;
  return MethodOf(kind).IsApproximation() || kind == SolverKind::Automatic || kind == SolverKind::ConjugateGradients
    ? ""
    : "the method " + MethodOf(kind).Name + " runs on one process, unlike conjugate gradients";
}

ScaleFilter ScaleFilterInPieces(
  const PieceOfSurface& piece, const ScaleFilterOptions& options, const ExecutionContext& context)
{
  const Ranks& ranks = piece.Everyone();
  const std::string reason = ReasonToGather(options);
  ranks.Together(
    [&]
    {
      CheckOptions(options, piece.NumberOfVertices());
      if (!reason.empty())
      {
        throw InvalidInput(reason + "; gather the surface on one rank");
      }
    });
  ranks.CheckSame("order " + std::to_string(options.Order) +
      (options.Quantity == ScaledQuantity::Vectors ? " of vectors" : " of functions") + ", length scale " +
      ShortText(options.LengthScale),
    "the scale filter");
  return EndingTogether(ranks.Communicator(),
    [&] { return ScaleFilter(std::make_unique<SystemOfPieces>(piece, options, context), options); });
}

}
