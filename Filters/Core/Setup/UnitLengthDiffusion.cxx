#include "Setup/UnitLengthDiffusion.h"

#include "Solvers/SolveInUnits.h"
#include "Support/ComplexPairs.h"

#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>
#include <utility>

namespace dmg
{
namespace
{

/// Lengths of diffusion, the roots of its times, over the root of the area; and the solves with each.
constexpr double Lengths[] = { 0.32, 0.16, 0.08, 0.04 };
constexpr int StepsOfLength = 5;

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

/// The penalties of a step: on each unknown that of the field before, and where something is prescribed that, too.
class StepOfDiffusion
{
public:
  StepOfDiffusion(const FieldSolution& start, const FieldOptions& options, const ExecutionContext& context)
    : Prescribed(start.Discretisation->PenaltiesOf(start.Constraints, options.Weights(), context))
    , PrescribedValues(AtUnitLength(start.Constraints.Values))
    , OfIntegral(start.Discretisation->PenaltiesOf(AllElements(*start.Discretisation), {}, context))
  {
    if (this->Prescribed.Kind == ConstraintKind::Hard)
    {
      this->Prescribed.Alignment.setConstant(
        static_cast<Eigen::Index>(this->Prescribed.Unknowns.size()), std::numeric_limits<double>::infinity());
    }
  }

  /// \param weight of the integral of |X - Y|^2.
  Penalties At(double weight) const
  {
    Penalties penalties = this->OfIntegral;
    penalties.Alignment *= weight;
    for (std::size_t k = 0; k < this->Prescribed.Unknowns.size(); ++k)
    {
      penalties.Alignment[this->Prescribed.Unknowns[k]] += this->Prescribed.Alignment[k];
    }
    return penalties;
  }

  /// The step pulls towards these: the means of the field before and of what is prescribed, by penalty.
  Vector<double> Values(const Vector<double>& before, double weight) const
  {
    Vector<double> values = AtUnitLength(before);
    for (std::size_t k = 0; k < this->Prescribed.Unknowns.size(); ++k)
    {
      const int unknown = this->Prescribed.Unknowns[k];
      const double byField = weight * this->OfIntegral.Alignment[unknown];
      const double share = byField > 0.0 ? byField / (byField + this->Prescribed.Alignment[k]) : 0.0;
      values[unknown] += (1.0 - share) * (this->PrescribedValues[k] - values[unknown]);
    }
    return values;
  }

private:
  Penalties Prescribed;
  Vector<double> PrescribedValues;
  Penalties OfIntegral;
};

}

bool HaveLengths(const Discretisation& discretisation)
{
  return discretisation.UnknownsPerElement() == 2;
}

FieldSolution DiffusedAtUnitLength(const FieldSolution& start, const PlannedSetup& setup, const FieldOptions& options,
  double area, const StoppingCriteria& stop, const ExecutionContext& context)
{
  const StepOfDiffusion step(start, options, context);
  const auto weightOf = [&options, area](double length) { return options.Smoothness / (length * length * area); };
  HarmonicProblem problem(setup.Levels, step.At(weightOf(Lengths[0])), options.Smoothness, options.Solver, setup.Choice,
    PartOfContext(context, 0.0, 0.1));
  FieldSolution field = start;
  const PartOfContext steps(context, 0.1, 1.0);
  const int number = StepsOfLength * static_cast<int>(std::size(Lengths));
  for (int k = 0; k < number; ++k)
  {
    const PartOfContext part(steps, static_cast<double>(k) / number, (k + 1.0) / number);
    const double weight = weightOf(Lengths[k / StepsOfLength]);
    if (k > 0 && k % StepsOfLength == 0)
    {
      problem.Update(step.At(weight), options.Smoothness, part);
    }
    auto [unknowns, report] = SolveInUnits(problem, step.Values(field.Unknowns, weight), field.Unknowns, stop, part);
    field.Unknowns = std::move(unknowns);
    field.Report.SolveSeconds += report.SolveSeconds;
    if (!report.Converged && field.Report.Converged)
    {
      field.Report.Converged = false;
      field.Report.Warnings.insert(field.Report.Warnings.end(), report.Warnings.begin(), report.Warnings.end());
    }
  }
  return field;
}

}
