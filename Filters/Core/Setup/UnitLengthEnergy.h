#ifndef dmgUnitLengthEnergy_h
#define dmgUnitLengthEnergy_h

#include "Setup/FieldOptions.h"
#include "Setup/FieldSolution.h"
#include "Solvers/MultigridSetup.h"
#include "Support/ExecutionContext.h"

#include <memory>

namespace dmg
{

/// A field with its product with the stiffness matrix, which is linear in it: a line search then needs one product.
struct FieldOnLine
{
  Vector<double> Unknowns;
  Vector<double> Product; ///< s R x

  FieldOnLine Plus(double step, const FieldOnLine& direction) const
  {
    return { this->Unknowns + step * direction.Unknowns, this->Product + step * direction.Product };
  }
};

/// The energy of a field whose length may differ from 1 over a short distance l, as at its singularities:
///
///   G(X) = E(X) + w int (1 - |X|)^2,   w = s / l^2,
///
/// where E is the smoothness energy, times its weight s, plus penalties of constraints. G(X) is the least value, over all Y of length 1,
/// of E(X) + w int |X - Y|^2, which is quadratic in X. So the X that minimises that for Y = X / |X| never has a larger G: a step of
/// diffusion. Fields are pairs of numbers, in the caller's order.
class UnitLengthEnergy
{
public:
  /// \param start of the same set-up and options. Its constraints count with values of length 1.
  UnitLengthEnergy(const FieldSolution& start, const FieldOptions& options, const MultigridSetup& levels,
    const ExecutionContext& context);

  /// \param weight w.
  void SetWeight(double weight) { this->Weight = weight; }

  /// The penalties of a step of diffusion, on all unknowns.
  Penalties PenaltiesOfStep() const;
  /// The values that a step from a field pulls to.
  Vector<double> ValuesOfStep(const Vector<double>& field) const;

  /// Takes hard constraints to their values.
  FieldOnLine Held(Vector<double> field, const ExecutionContext& context) const;
  FieldOnLine WithProduct(Vector<double> field, const ExecutionContext& context) const;

  /// G(X)
  double Value(const FieldOnLine& field) const;
  /// Half the gradient of G; zero where constraints are hard.
  Vector<double> HalfGradient(const FieldOnLine& field) const;
  /// The step along a direction at which the derivative of G vanishes, by Newton's method from \p first.
  double StepAlong(const FieldOnLine& direction, const FieldOnLine& field, double first) const;

private:
  const MultigridSetup& Levels;
  std::unique_ptr<StiffnessOperator> Stiffness;
  double Smoothness;
  double Weight = 1.0;
  Vector<double> Integral;         ///< of a step: the penalties of int |X - Y|^2, one per unknown
  Vector<double> Penalty;          ///< of constraints, one per unknown; infinite: hard
  Vector<double> PrescribedValues; ///< one per unknown
};

}

#endif
