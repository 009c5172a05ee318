#include "Solvers/ConvergenceMeasure.h"

#include "Support/Errors.h"
#include "Support/SparseKernels.h"

#include <cmath>
#include <limits>
#include <string>

namespace dmg
{
namespace
{

/// |v|_M of v_i = entry(i).
template <class Entry>
double Norm(
  int size, const Vector<double>& mass, const Entry& entry, const ExecutionContext& context)
{
  const bool hasMass = mass.size() > 0;
  const double square = SumOverBlocks<double>(size, context,
    [&mass, hasMass, &entry](int first, int last)
    {
      double sum = 0.0;
      for (int i = first; i < last; ++i)
      {
        sum += (hasMass ? mass[i] : 1.0) * Eigen::numext::abs2(entry(i));
      }
      return sum;
    });
  return std::sqrt(square);
}

/// Zero has no relative error.
double Ratio(double number, double scale)
{
  return scale > 0.0 ? number / scale : std::numeric_limits<double>::quiet_NaN();
}

}

template <class Scalar>
void ConvergenceMeasure<Scalar>::Check(int numberOfUnknowns) const
{
  const auto fits = [numberOfUnknowns](Eigen::Index size)
  { return size == 0 || size == numberOfUnknowns; };
  if (!fits(this->Mass.size()) || !fits(this->Reference.size()))
  {
    throw InvalidInput("the mass and the reference of a convergence measure must have " +
      std::to_string(numberOfUnknowns) + " values, one per unknown");
  }
}

template <class Scalar>
double ConvergenceMeasure<Scalar>::Error(
  const Vector<Scalar>& x, const ExecutionContext& context) const
{
  const int size = static_cast<int>(x.size());
  const auto error = [this, &x](int i) { return x[i] - this->Reference[i]; };
  const auto reference = [this](int i) { return this->Reference[i]; };
  return Ratio(
    Norm(size, this->Mass, error, context), Norm(size, this->Mass, reference, context));
}

template <class Scalar>
void ConvergenceMeasure<Scalar>::Fill(IterationReport& row, const Vector<Scalar>& x,
  const Vector<Scalar>& b, const Vector<Scalar>& r, const ExecutionContext& context) const
{
  const int size = static_cast<int>(x.size());
  row.Energy = this->EnergyConstant -
    this->EnergyScale *
      (Eigen::numext::real(Dot(x, b, context)) + Eigen::numext::real(Dot(x, r, context)));
  row.MassResidual = Ratio(Norm(size, this->Mass, [&r](int i) { return r[i]; }, context),
    Norm(size, this->Mass, [&b](int i) { return b[i]; }, context));
  if (this->Reference.size() > 0)
  {
    row.Error = this->Error(x, context);
  }
}

template struct ConvergenceMeasure<double>;
template struct ConvergenceMeasure<Complex>;

}
