#include "Pieces/Solvers/EquationsInPieces.h"

#include "Pieces/Solvers/OperatorsInPieces.h"
#include "Solvers/LimitedPenalty.h"
#include "Support/ComplexPairs.h"
#include "Support/Errors.h"
#include "Support/Remedy.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <string>
#include <utility>

namespace dmg
{

namespace
{

/// R + D for the eigensolver.
class MatrixOfMultigrid : public LinearOperator<double>
{
public:
  MatrixOfMultigrid(PetscMultigrid& multigrid, int size)
    : Multigrid(multigrid)
    , NumberOfUnknowns(size)
  {
  }

  int Size() const override { return this->NumberOfUnknowns; }
  /// \return zero, since no iteration here asks for the energy.
  double Apply(const Vector<double>& x, Vector<double>& y, const ExecutionContext&) const override
  {
    y = AsPairs(this->Multigrid.Multiply(AsComplex(x)));
    return 0.0;
  }

private:
  PetscMultigrid& Multigrid;
  const int NumberOfUnknowns;
};

/// An unknown is a complex number, two real ones.
MeasureOfFields MeasureOf(const SetupInPieces& setup)
{
  const auto vertices = static_cast<double>(setup.Piece.GlobalNumberOfVertices()); // the sum of Mass
  return { setup.Mass, 2, [&setup](int i) { return setup.Multigrid->Stiffness()[i / 2]; },
    [&setup](int i) { return setup.Components.OfOwned[i / 2]; }, setup.Components.NumberBound, vertices, vertices,
    vertices * setup.MeanArea, SumOf(setup.Piece.Everyone()) };
}

}

EquationsInPieces::EquationsInPieces(const SetupInPieces& setup, const std::vector<PowerAtVertex>& atOwned,
  Vector<double> source, NetSource net, const FieldWeights& weights)
  : Setup(setup)
  , D(Vector<double>::Zero(setup.Piece.NumberOfOwned()))
  , IsFixed(setup.Piece.NumberOfOwned(), 0)
  , Known(Vector<Complex>::Zero(setup.Piece.NumberOfOwned()))
  , Source(std::move(source))
{
  CheckWeights(weights);
  const Ranks& ranks = setup.Piece.Everyone();
  const std::vector<int> held = this->Prescribe(atOwned, weights);
  this->Free.emplace(setup.Components.OfOwned, setup.Components.NumberBound, held, SumOf(ranks));
  this->HasSource = ranks.Any(this->Source.size() > 0);
  this->IsPrescribed = ranks.Any(!held.empty()) || this->HasSource;
  const bool isConstrained =
    ranks.Any(std::any_of(atOwned.begin(), atOwned.end(), [](const PowerAtVertex& at) { return at.Weight > 0.0; }));
  if (!this->IsPrescribed && isConstrained)
  {
    throw InvalidInput(
      "all prescribed cells have zero area, so that they hold nothing; prescribe a direction on another "
      "cell or make the constraints hard");
  }
  if (!this->IsPrescribed && !setup.Fields->HasSmoothest())
  {
    throw InvalidInput("no rank prescribes a value, so the function of least smoothness energy is zero; " +
      TextOf(Remedy::PrescribedValues));
  }
  if (this->HasSource)
  {
    this->BalanceSource(net, weights.Constraints == ConstraintKind::Hard ? 1.0 : weights.Smoothness);
  }
  this->FillUnprescribed();
}

std::vector<int> EquationsInPieces::Prescribe(const std::vector<PowerAtVertex>& atOwned, const FieldWeights& weights)
{
  std::vector<int> held;
  for (int i = 0; i < this->D.size(); ++i)
  {
    const auto& [weight, sum] = atOwned[i];
    if (!(weight > 0.0))
    {
      continue;
    }
    this->Known[i] = sum / weight;
    if (weights.Constraints == ConstraintKind::Hard)
    {
      this->IsFixed[i] = 1;
    }
    else
    {
      const double diagonal = this->Setup.Multigrid->Stiffness()[i];
      const double penalty = weights.Alignment * weight * this->Setup.Mass[i] / weights.Smoothness;
      const double D = this->D[i] = LimitedPenalty(penalty, diagonal);
      this->Known[i] *= D > 0.0 ? D / (diagonal + D) : 0.0;
    }
    if (this->IsFixed[i] || this->D[i] > 0.0)
    {
      held.push_back(i);
    }
  }
  return held;
}

void EquationsInPieces::BalanceSource(NetSource net, double smoothness)
{
  const PieceOfSurface& piece = this->Setup.Piece;
  this->AreasOfSource = IntegratedSource(piece.Surface().Mesh).segment(piece.FirstOwned(), piece.NumberOfOwned());
  this->Free->Balance(this->Source, this->AreasOfSource, net);
  this->Source /= smoothness;
}

/// A component without constraints has the smoothest field if it has an area. Else its first vertex is fixed at zero, the solution there
/// or, with a source, one of those that differ by a constant.
void EquationsInPieces::FillUnprescribed()
{
  const PieceOfSurface& piece = this->Setup.Piece;
  const std::vector<int>& components = this->Setup.Components.OfOwned;
  const Vector<double> masses = this->Free->Sums(this->Setup.Mass);
  std::vector<double> firsts(this->Setup.Components.NumberBound, std::numeric_limits<double>::infinity());
  std::vector<int> smoothest;
  const auto globalNumber = [&piece](int i)
  { return static_cast<double>(piece.GlobalNumbers()[piece.FirstOwned() + i]); };
  for (int i = 0; i < piece.NumberOfOwned(); ++i)
  {
    const int component = components[i];
    if (this->Setup.Fields->HasSmoothest() && masses[component] > 0.0)
    {
      smoothest.insert(smoothest.end(), { 2 * i, 2 * i + 1 });
    }
    else if (this->Free->IsFree(component))
    {
      firsts[component] = std::min(firsts[component], globalNumber(i));
    }
  }
  piece.Everyone().Min(firsts);
  this->NumberOfZero = std::count_if(firsts.begin(), firsts.end(), [](double first) { return std::isfinite(first); });
  for (int i = 0; i < piece.NumberOfOwned(); ++i)
  {
    this->IsFixed[i] |= globalNumber(i) == firsts[components[i]];
  }
  this->Smoothest = UnprescribedComponents(MeasureOf(this->Setup), smoothest, SerialContext());
  Vector<double> shifts = Vector<double>::Zero(2 * piece.NumberOfOwned());
  this->Smoothest.SetDiagonal(shifts);
  this->D += shifts(Eigen::seqN(0, piece.NumberOfOwned(), 2));
}

void EquationsInPieces::SetMatrix(const ExecutionContext& context) const
{
  this->Setup.Multigrid->SetPenalties(this->D, this->IsFixed, context);
}

/// The rest when the known values are taken away: D y and the diagonal solution cancel.
Vector<Complex> EquationsInPieces::RightHandSide() const
{
  Vector<Complex> b = -this->Setup.Multigrid->MultiplyOffDiagonal(this->Known);
  if (this->HasSource)
  {
    b += this->Source;
  }
  for (Eigen::Index i = 0; i < b.size(); ++i)
  {
    b[i] = this->IsFixed[i] ? Complex(0.0) : b[i];
  }
  return b;
}

Vector<Complex> EquationsInPieces::Solve(
  Vector<double>& smoothest, const StoppingCriteria& stop, SolveReport& report, const ExecutionContext& context) const
{
  report.Solver = std::string(this->IsPrescribed ? "conjugate gradients" : "LOBPCG") +
    " with one V-cycle, by PETSc on " + std::to_string(this->Setup.Piece.Everyone().Size()) + " ranks";
  report.Levels = this->Setup.Multigrid->Levels();
  report.Converged = true;
  Vector<Complex> x = this->Known;
  if (this->IsPrescribed)
  {
    x += this->Setup.Multigrid->Solve(this->RightHandSide(), stop, report, context);
  }
  if (this->Smoothest.AreAny())
  {
    this->FindSmoothest(smoothest, stop, x, report, context);
  }
  if (this->HasSource)
  {
    Vector<double> u = x.real();
    this->Free->Centre(u, this->AreasOfSource);
    x = u;
  }
  else if (this->NumberOfZero > 0)
  {
    report.Warnings.push_back(std::to_string(this->NumberOfZero) + " components of the surface hold no prescribed " +
      (this->Setup.Fields->HasSmoothest() ? "direction and have no area; the field is zero there"
                                          : "value; the function is zero there"));
  }
  return x;
}

void EquationsInPieces::FindSmoothest(Vector<double>& smoothest, const StoppingCriteria& stop, Vector<Complex>& x,
  SolveReport& report, const ExecutionContext& context) const
{
  PetscMultigrid& multigrid = *this->Setup.Multigrid;
  Vector<double> pairs = AsPairs(x);
  Vector<double> start = Vector<double>::Zero(pairs.size());
  for (const int i : this->Smoothest.Unknowns())
  {
    start[i] = smoothest.size() > 0 ? smoothest[i] : 0.0;
  }
  const MatrixOfMultigrid matrix(multigrid, static_cast<int>(pairs.size()));
  CycleInPieces cycle(multigrid, 2);
  std::vector<IterationReport> iterations = this->Smoothest.FindSmoothest(
    matrix, cycle, std::move(start), stop, pairs, report, ContextOfRanks(this->Setup.Piece.Everyone(), context));
  x = AsComplex(pairs);
  smoothest = Vector<double>::Zero(pairs.size());
  for (const int i : this->Smoothest.Unknowns())
  {
    smoothest[i] = pairs[i];
  }
  if (!this->IsPrescribed)
  {
    report.Iterations = std::move(iterations);
    report.Returned = report.Iterations.back().Iteration;
  }
}

}
