#include "Setup/UnitLengthEnergy.h"

#include "Support/Permutations.h"

#include <cmath>
#include <limits>
#include <numeric>
#include <utility>

namespace dmg
{
namespace
{

/// Pairs divided by their lengths; zero where they are zero.
Vector<double> AtUnitLength(const Vector<double>& pairs)
{
  Vector<double> unit(pairs.size());
  for (Eigen::Index k = 0; k < pairs.size(); k += 2)
  {
    const double length = std::hypot(pairs[k], pairs[k + 1]);
    unit.segment<2>(k) = length > 0.0 ? Eigen::Vector2d(pairs.segment<2>(k) / length) : Eigen::Vector2d::Zero();
  }
  return unit;
}

/// All elements, with the weights of an integral over the surface.
FieldConstraints AllElements(const Discretisation& discretisation)
{
  const Discretisation::IntegralWeights weights = discretisation.WeightsOfIntegral();
  FieldConstraints all;
  all.Elements.resize(discretisation.NumberOfElements());
  std::iota(all.Elements.begin(), all.Elements.end(), 0);
  all.Weights.assign(
    all.Elements.size(), discretisation.Elements() == ElementKind::Faces ? weights.OnFaces : weights.AtVertices);
  return all;
}

}

UnitLengthEnergy::UnitLengthEnergy(const FieldSolution& start, const FieldOptions& options,
  const MultigridSetup& levels, const ExecutionContext& context)
  : Levels(levels)
  , Stiffness(levels.Hierarchy->Operator())
  , Smoothness(options.Smoothness)
  , Integral(Vector<double>::Zero(start.Unknowns.size()))
  , Penalty(Vector<double>::Zero(start.Unknowns.size()))
  , PrescribedValues(Vector<double>::Zero(start.Unknowns.size()))
{
  this->Stiffness->SetDiagonal(this->Integral, context);
  const Discretisation& discretisation = *start.Discretisation;
  const Penalties integral = discretisation.PenaltiesOf(AllElements(discretisation), {}, context);
  this->Integral(integral.Unknowns) = integral.Alignment;
  const Penalties prescribed = discretisation.PenaltiesOf(start.Constraints, options.Weights(), context);
  if (prescribed.Kind == ConstraintKind::Hard)
  {
    this->Penalty(prescribed.Unknowns).setConstant(std::numeric_limits<double>::infinity());
  }
  else
  {
    this->Penalty(prescribed.Unknowns) = prescribed.Alignment;
  }
  this->PrescribedValues(prescribed.Unknowns) = AtUnitLength(start.Constraints.Values);
}

Penalties UnitLengthEnergy::PenaltiesOfStep() const
{
  Penalties all;
  all.Kind = ConstraintKind::Soft;
  all.Unknowns.resize(this->Integral.size());
  std::iota(all.Unknowns.begin(), all.Unknowns.end(), 0);
  all.Alignment = this->Weight * this->Integral + this->Penalty;
  return all;
}

/// The means of the field, at length 1, and of what is prescribed, by penalty.
Vector<double> UnitLengthEnergy::ValuesOfStep(const Vector<double>& field) const
{
  Vector<double> values = AtUnitLength(field);
  for (Eigen::Index k = 0; k < values.size(); ++k)
  {
    if (this->Penalty[k] > 0.0)
    {
      const double byField = this->Weight * this->Integral[k];
      const double share = byField > 0.0 ? byField / (byField + this->Penalty[k]) : 0.0;
      values[k] += (1.0 - share) * (this->PrescribedValues[k] - values[k]);
    }
  }
  return values;
}

FieldOnLine UnitLengthEnergy::WithProduct(Vector<double> field, const ExecutionContext& context) const
{
  const std::vector<int>& order = this->Levels.Hierarchy->Order;
  Vector<double> product;
  this->Stiffness->Apply(Gathered(field, order, context), product, context);
  return { std::move(field), this->Smoothness * Scattered(product, order, context) };
}

FieldOnLine UnitLengthEnergy::Held(Vector<double> field, const ExecutionContext& context) const
{
  return this->WithProduct(this->Penalty.array().isInf().select(this->PrescribedValues, field), context);
}

double UnitLengthEnergy::Value(const FieldOnLine& field) const
{
  const Vector<double>& x = field.Unknowns;
  double energy = x.dot(field.Product);
  for (Eigen::Index k = 0; k < x.size(); k += 2)
  {
    const double shorter = 1.0 - std::hypot(x[k], x[k + 1]);
    energy += this->Weight * this->Integral[k] * shorter * shorter;
    for (const Eigen::Index i : { k, k + 1 })
    {
      const double difference = x[i] - this->PrescribedValues[i];
      energy += std::isfinite(this->Penalty[i]) ? this->Penalty[i] * difference * difference : 0.0;
    }
  }
  return energy;
}

Vector<double> UnitLengthEnergy::HalfGradient(const FieldOnLine& field) const
{
  const Vector<double>& x = field.Unknowns;
  Vector<double> gradient = field.Product;
  gradient += this->Weight * this->Integral.cwiseProduct(x - AtUnitLength(x));
  for (Eigen::Index k = 0; k < x.size(); ++k)
  {
    const double penalty = this->Penalty[k];
    gradient[k] = std::isfinite(penalty) ? gradient[k] + penalty * (x[k] - this->PrescribedValues[k]) : 0.0;
  }
  return gradient;
}

double UnitLengthEnergy::StepAlong(const FieldOnLine& direction, const FieldOnLine& field, double first) const
{
  constexpr int MostSteps = 8;
  constexpr double Accuracy = 1e-3;
  const Vector<double>& d = direction.Unknowns;
  const Vector<double> soft = this->Penalty.array().isFinite().select(this->Penalty, 0.0);
  const double stiffness = d.dot(direction.Product) + d.cwiseAbs2().dot(soft);
  const double whole = stiffness + this->Weight * d.cwiseAbs2().dot(this->Integral);
  double step = first;
  for (int k = 0; k < MostSteps && whole > 0.0; ++k)
  {
    const FieldOnLine there = field.Plus(step, direction);
    double curvature = stiffness;
    for (Eigen::Index i = 0; i < d.size(); i += 2)
    {
      const Eigen::Vector2d x = there.Unknowns.segment<2>(i), along = d.segment<2>(i);
      const double length = std::max(x.norm(), 1e-12);
      const double radial = x.dot(along) * x.dot(along) / (length * length);
      curvature += this->Weight * this->Integral[i] * (radial + (1.0 - 1.0 / length) * (along.squaredNorm() - radial));
    }
    // where G is not convex, the quadratic that bounds it from above
    const double change = -d.dot(this->HalfGradient(there)) / (curvature > Accuracy * whole ? curvature : whole);
    step += change;
    if (std::abs(change) < Accuracy * std::max(1.0, std::abs(step)))
    {
      break;
    }
  }
  return step;
}

}
