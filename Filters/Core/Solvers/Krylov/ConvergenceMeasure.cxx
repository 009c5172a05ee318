#include "Solvers/Krylov/ConvergenceMeasure.h"

#include "Support/Errors.h"
#include "Support/SparseKernels.h"

#include <cmath>
#include <limits>
#include <string>

namespace dmg
{
namespace
{

/// M_ii.
class MassOf
{
public:
  MassOf(const Vector<double>* mass, int numberOfUnknowns)
    : Mass(mass)
    , IsOfPairs(mass && mass->size() < numberOfUnknowns)
  {
  }
  double operator()(int i) const { return this->Mass ? (*this->Mass)[this->IsOfPairs ? i / 2 : i] : 1.0; }

private:
  const Vector<double>* const Mass;
  const bool IsOfPairs;
};

/// |v|_M of v_i = entry(i).
template <class Entry>
double Norm(int size, const Vector<double>* mass, const Entry& entry, const ExecutionContext& context)
{
  const MassOf massOf(mass, size);
  const double square = SumOverBlocks<double>(size, context,
    [&massOf, &entry](int first, int last)
    {
      double sum = 0.0;
      for (int i = first; i < last; ++i)
      {
        sum += massOf(i) * Eigen::numext::abs2(entry(i));
      }
      return sum;
    });
  return std::sqrt(square);
}

/// The sums of one pass over an iterate.
struct Sums
{
  explicit Sums(int = 0) {}
  double Energy = 0.0;   ///< Re x^H (b + r)
  double Residual = 0.0; ///< |r|_M^2
  double Right = 0.0;    ///< |b|_M^2

  Sums& operator+=(const Sums& other)
  {
    this->Energy += other.Energy;
    this->Residual += other.Residual;
    this->Right += other.Right;
    return *this;
  }
};

/// Zero has no relative error.
double Ratio(double number, double scale)
{
  return scale > 0.0 ? number / scale : std::numeric_limits<double>::quiet_NaN();
}

}

template <class Scalar>
void ConvergenceMeasure<Scalar>::Check(int numberOfUnknowns) const
{
  if ((this->Mass && this->Mass->size() != numberOfUnknowns && 2 * this->Mass->size() != numberOfUnknowns) ||
    (this->Reference.size() > 0 && this->Reference.size() != numberOfUnknowns))
  {
    throw InvalidInput("the mass and the reference of a convergence measure must have " +
      std::to_string(numberOfUnknowns) + " values, one per unknown, or the mass half as many");
  }
}

template <class Scalar>
double ConvergenceMeasure<Scalar>::Error(const Vector<Scalar>& x, const ExecutionContext& context) const
{
  const int size = static_cast<int>(x.size());
  const auto error = [this, &x](int i)
  { return x[i] + (this->Offset ? (*this->Offset)[i] : Scalar(0)) - this->Reference[i]; };
  const auto reference = [this](int i) { return this->Reference[i]; };
  return Ratio(Norm(size, this->Mass, error, context), Norm(size, this->Mass, reference, context));
}

template <class Scalar>
void ConvergenceMeasure<Scalar>::Fill(IterationReport& row, const Vector<Scalar>& x,
  const Vector<Scalar>& rightHandSide, const Vector<Scalar>& r, const ExecutionContext& context) const
{
  const Vector<Scalar>& b = this->RightHandSide ? *this->RightHandSide : rightHandSide;
  const MassOf massOf(this->Mass, static_cast<int>(x.size()));
  const Sums sums = SumOverBlocks<Sums>(static_cast<int>(x.size()), context,
    [&](int first, int last)
    {
      Sums sum;
      for (int i = first; i < last; ++i)
      {
        const double mass = massOf(i);
        const Scalar value = this->Offset ? x[i] + (*this->Offset)[i] : x[i];
        sum.Energy += Eigen::numext::real(Eigen::numext::conj(value) * (b[i] + r[i]));
        sum.Residual += mass * Eigen::numext::abs2(r[i]);
        sum.Right += mass * Eigen::numext::abs2(b[i]);
      }
      return sum;
    });
  row.Energy = this->EnergyConstant - this->EnergyScale * sums.Energy;
  row.MassResidual = Ratio(std::sqrt(sums.Residual), std::sqrt(sums.Right));
  if (this->Reference.size() > 0)
  {
    row.Error = this->Error(x, context);
  }
}

template struct ConvergenceMeasure<double>;
template struct ConvergenceMeasure<Complex>;

}
