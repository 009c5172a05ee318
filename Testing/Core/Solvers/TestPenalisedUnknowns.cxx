#include "Solvers/Multigrid/PenalisedUnknowns.h"

#include "Support/TbbContext.h"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

using namespace dmg;

namespace
{

constexpr double Infinity = std::numeric_limits<double>::infinity();

/// Of six unknowns, 1, 3 and 4 are penalised, 5 is held.
const std::vector<double> Pulls = { 0.0, 2.0, 0.0, 1e-3, 50.0, Infinity };
const std::vector<double> Couplings = { 1.0, 4.0, 1.0, 0.5, 0.0, 1.0 };
const std::vector<int> Penalised = { 1, 3, 4 };

template <class Scalar>
PenalisedUnknowns<Scalar> Make()
{
  return PenalisedUnknowns<Scalar>(
    static_cast<int>(Pulls.size()), [](int i) { return Pulls[i]; }, [](int i) { return Couplings[i]; },
    SerialContext());
}

/// Where (y - c)^2 R + y^2 D is least.
double Yielded(int i, double c)
{
  return Couplings[i] * c / (Couplings[i] + Pulls[i]);
}

}

TEST(PenalisedUnknowns, ArePenalisedButNotHeld)
{
  EXPECT_EQ(Make<double>().Unknowns(), Penalised);
  EXPECT_TRUE(PenalisedUnknowns<double>().Unknowns().empty());
}

TEST(PenalisedUnknowns, TakeTheCorrectionOfLeastEnergy)
{
  PenalisedUnknowns<double> unknowns = Make<double>();
  const Vector<double> smoothed = Vector<double>::LinSpaced(6, 1.0, 2.0);
  const Vector<double> correction = Vector<double>::LinSpaced(6, -3.0, 7.0);
  Vector<double> residual = Vector<double>::Ones(6);
  unknowns.ScaleResidual(residual, smoothed, SerialContext());
  Vector<double> x = smoothed + correction;
  unknowns.ScaleCorrection(x, SerialContext());
  for (int i = 0; i < 6; ++i)
  {
    const bool isPenalised = i == 1 || i == 3 || i == 4;
    const double taken = isPenalised ? Yielded(i, correction[i]) : correction[i];
    EXPECT_NEAR(x[i], smoothed[i] + taken, 1e-14);
    // The restriction is the adjoint of the prolongation.
    EXPECT_NEAR(residual[i], isPenalised ? Yielded(i, 1.0) : 1.0, 1e-15);
  }
}

TEST(PenalisedUnknowns, HaveTheSameBitsForAnyNumberOfThreads)
{
  constexpr int Size = 50000; // several pieces of a loop
  const auto corrected = [](const ExecutionContext& context)
  {
    PenalisedUnknowns<double> unknowns(
      Size, [](int i) { return 1.0 / (1 + i % 7); }, [](int i) { return 1.0 + i % 3; }, context);
    const Vector<double> smoothed = Vector<double>::LinSpaced(Size, 0.1, 0.9);
    Vector<double> residual = Vector<double>::LinSpaced(Size, -1.0, 1.0);
    unknowns.ScaleResidual(residual, smoothed, context);
    Vector<double> x = smoothed + residual;
    unknowns.ScaleCorrection(x, context);
    return x;
  };
  const Vector<double> expected = corrected(SerialContext());
  for (const int threads : { 2, 3 })
  {
    EXPECT_EQ(corrected(test::TbbContext(threads)), expected) << threads;
  }
}

TEST(PenalisedUnknowns, AreSpringsOfThatEnergy)
{
  // A coarse function of one at each.
  SparseMatrix<Complex> rows(3, 3);
  rows.setIdentity();
  Make<std::complex<float>>().ScaleRows(rows, SerialContext());
  for (int k = 0; k < 3; ++k)
  {
    const int i = Penalised[k];
    const double y = Yielded(i, 1.0);
    const double energy = (y - 1.0) * (y - 1.0) * Couplings[i] + y * y * Pulls[i];
    EXPECT_NEAR(std::norm(rows.coeff(k, k)), energy, 1e-14);
  }
}
