#include "Solvers/PrescribedSystem.h"

#include "Solvers/LimitedPenalty.h"
#include "Support/CountingSort.h"
#include "Support/Errors.h"
#include "Support/Permutations.h"
#include "Support/SparseKernels.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace dmg
{
namespace
{

constexpr double Infinity = std::numeric_limits<double>::infinity();

/// 1 / (R_ii + D_i), zero where unknowns are held or neither is there.
Vector<double> InverseDiagonal(
  const StiffnessHierarchy& hierarchy, const Vector<double>& D, const ExecutionContext& context)
{
  constexpr int Grain = 8192;
  Vector<double> inverse(D.size());
  context.ParallelFor(0, static_cast<int>(D.size()), Grain,
    [&](int first, int last)
    {
      for (int i = first; i < last; ++i)
      {
        const double diagonal = hierarchy.DiagonalOf(i) + D[i];
        inverse[i] = diagonal > 0.0 ? 1.0 / diagonal : 0.0;
      }
    });
  return inverse;
}

/// The places of some items in an order.
std::vector<int> PlacesOf(const std::vector<int>& items, const std::vector<int>& order, const ExecutionContext& context)
{
  const std::vector<int> all = Inverse(order, context);
  std::vector<int> places;
  places.reserve(items.size());
  for (const int item : items)
  {
    places.push_back(all[item]);
  }
  return places;
}

}

PrescribedSystem::PrescribedSystem(std::shared_ptr<const MultigridSetup> setup)
  : SetupOfSystem(std::move(setup))
  , A(this->SetupOfSystem->Hierarchy->Operator())
{
}

void PrescribedSystem::Prescribe(Penalties prescribed, double smoothness, const ExecutionContext& context)
{
  const StiffnessHierarchy& hierarchy = *this->Setup().Hierarchy;
  this->Prescribed = std::move(prescribed);
  this->SmoothnessWeight = this->IsHard() ? 1.0 : smoothness;
  this->Places = PlacesOf(this->Prescribed.Unknowns, hierarchy.Order, context);
  const std::vector<char> isReached = this->SetPenalties();
  this->SetUnreached(
    Choose(
      hierarchy.NumberOfUnknowns(), [&](int i) { return !isReached[hierarchy.ComponentOf(i)]; }, context),
    context);
  const Vector<double> D = this->Diagonal();
  this->A->SetDiagonal(D, context);
  this->A->SetInverseDiagonal(InverseDiagonal(hierarchy, D, context));
}

std::vector<char> PrescribedSystem::SetPenalties()
{
  const StiffnessHierarchy& hierarchy = *this->Setup().Hierarchy;
  this->Limited.setZero(this->IsHard() ? 0 : static_cast<Eigen::Index>(this->Places.size()));
  std::vector<char> isReached(hierarchy.NumberOfComponents(), 0);
  bool holdsAny = this->Places.empty();
  for (std::size_t k = 0; k < this->Places.size(); ++k)
  {
    const int place = this->Places[k];
    const bool holds = this->IsHard() ||
      (this->Limited[k] =
          LimitedPenalty(this->Prescribed.Alignment[k] / this->SmoothnessWeight, hierarchy.DiagonalOf(place))) > 0.0;
    isReached[hierarchy.ComponentOf(place)] |= holds;
    holdsAny |= holds;
  }
  if (!holdsAny)
  {
    throw InvalidInput("all prescribed cells have zero area, so that they hold nothing; prescribe a "
                       "direction on another cell or make the constraints hard");
  }
  return isReached;
}

/// Components without prescriptions have the smoothest field; where the set-up knows none, or a component has no area, they
/// are zero, the least of equal minimisers.
void PrescribedSystem::SetUnreached(const std::vector<int>& unreached, const ExecutionContext& context)
{
  const MultigridSetup& setup = this->Setup();
  std::vector<char> hasSmoothest(setup.Hierarchy->NumberOfComponents(), 0);
  for (const int i : unreached)
  {
    hasSmoothest[setup.Hierarchy->ComponentOf(i)] |= setup.HasSmoothest && setup.MassOf(i) > 0.0;
  }
  std::vector<int> smoothest, still;
  for (const int i : unreached)
  {
    (hasSmoothest[setup.Hierarchy->ComponentOf(i)] ? smoothest : still).push_back(i);
  }
  this->WithoutPrescriptions = UnprescribedComponents(setup, smoothest, context);

  this->WarningsOfSystem.clear();
  if (!still.empty())
  {
    this->WarningsOfSystem.push_back(std::to_string(still.size()) + " of " +
      std::to_string(setup.Hierarchy->NumberOfUnknowns()) +
      (setup.HasSmoothest
          ? " unknowns lie in components of the surface that hold no prescribed direction and have no area; the field "
            "is zero there"
          : " values lie in components of the surface that hold no prescribed value; the function is zero there"));
  }
  this->HeldUnknowns = std::move(still);
  if (this->IsHard())
  {
    this->HeldUnknowns.insert(this->HeldUnknowns.end(), this->Places.begin(), this->Places.end());
    std::sort(this->HeldUnknowns.begin(), this->HeldUnknowns.end());
  }
}

Vector<double> PrescribedSystem::Diagonal() const
{
  Vector<double> D = Vector<double>::Zero(this->Setup().Hierarchy->NumberOfUnknowns());
  for (Eigen::Index k = 0; k < this->Limited.size(); ++k)
  {
    D[this->Places[k]] = this->Limited[k];
  }
  this->WithoutPrescriptions.SetDiagonal(D);
  D(this->HeldUnknowns).setConstant(Infinity);
  return D;
}

Vector<double> PrescribedSystem::RightHandSide(const Vector<double>& values, const ExecutionContext& context) const
{
  Vector<double> b = Vector<double>::Zero(this->Setup().Hierarchy->NumberOfUnknowns());
  for (std::size_t k = 0; k < this->Places.size(); ++k)
  {
    b[this->Places[k]] = (this->IsHard() ? 1.0 : this->Limited[k]) * values[k];
  }
  if (this->IsHard())
  {
    // - R_fb y, as D is zero on what is free
    Vector<double> product;
    this->A->Apply(b, product, context);
    b = -product;
  }
  SetZero(b, this->HeldUnknowns, context);
  return b;
}

Vector<double> PrescribedSystem::HeldByPenalties(const Vector<double>& values) const
{
  Vector<double> held = Vector<double>::Zero(this->Setup().Hierarchy->NumberOfUnknowns());
  const Vector<double>& inverse = *this->A->InverseDiagonal();
  for (Eigen::Index k = 0; k < this->Limited.size(); ++k)
  {
    const int place = this->Places[k];
    held[place] = this->Limited[k] * inverse[place] * values[k];
  }
  return held;
}

LinearSystem PrescribedSystem::Equations(
  const Vector<double>& values, const ExecutionContext& context, const Vector<double>& source) const
{
  const StiffnessHierarchy& hierarchy = *this->Setup().Hierarchy;
  Vector<double> D = this->Diagonal();
  D(this->Unprescribed().Unknowns()).setZero();
  const auto isFree = [&D](Eigen::Index i) { return std::isfinite(D[i]); };
  SparseMatrix<double> A = hierarchy.RealMatrix(context);
  A += SparseMatrix<double>(D.array().isFinite().select(D, 0.0).matrix().asDiagonal());
  A.prune([&isFree](Eigen::Index i, Eigen::Index j, double) { return i == j || (isFree(i) && isFree(j)); });
  for (const int i : this->HeldUnknowns)
  {
    A.coeffRef(i, i) = 1.0;
  }
  A.makeCompressed();
  Vector<double> b = this->RightHandSide(values, context);
  if (source.size() > 0)
  {
    Vector<double> added = Gathered(source, hierarchy.Order, context);
    added(this->Unprescribed().Unknowns()).setZero();
    b += added / this->Smoothness();
  }
  this->InsertHeld(values, b);
  return { Permuted(A, Inverse(hierarchy.Order), hierarchy.Order, context), Scattered(b, hierarchy.Order, context) };
}

void PrescribedSystem::InsertHeld(const Vector<double>& values, Vector<double>& x) const
{
  if (this->IsHard())
  {
    for (std::size_t k = 0; k < this->Places.size(); ++k)
    {
      x[this->Places[k]] = values[k];
    }
  }
}

}
