#include "Solvers/Krylov/IterationMonitor.h"

#include "Support/MatrixOperator.h"
#include <gtest/gtest.h>

#include <cmath>
#include <optional>
#include <string>

using namespace dmg;

namespace
{

/// B = Factor I, of which the norm is the root of Factor times the Euclidean one.
class Scaling : public Preconditioner<double>
{
public:
  void Apply(const Vector<double>& r, Vector<double>& z, const ExecutionContext&) override { z = this->Factor * r; }

  double Factor = 1.0;
};

/// A = I, b = 1: an iterate t b has the residual 1 - t and the energy norm t.
class MonitoredIteration : public ::testing::Test
{
protected:
  MonitoredIteration() { this->A.setIdentity(); }

  void Begin(StoppingCriteria stop)
  {
    this->Iteration.emplace(this->Matrix, this->B, this->b, stop, this->x, this->Report, this->Context, nullptr);
    this->Iteration->Begin(this->r);
    this->Iteration->Precondition(this->r, this->z);
    this->Iteration->KeepBest();
  }

  void GoTo(double t)
  {
    this->x = t * this->b;
    this->Iteration->AppendResidual(this->r);
  }

  SparseMatrix<double> A{ 1, 1 };
  const test::MatrixOperator<double> Matrix{ this->A };
  const Vector<double> b = Vector<double>::Ones(1);
  SerialContext Context;
  Scaling B;
  Vector<double> x;
  Vector<double> r;
  Vector<double> z;
  SolveReport Report;
  std::optional<IterationMonitor<double>> Iteration;
};

}

TEST_F(MonitoredIteration, AsksForNoMoreIterationsWhereRoundingHasEndedThem)
{
  for (const bool isEnded : { false, true })
  {
    constexpr int Limit = 20;
    this->x.resize(0);
    this->Report.Warnings.clear();
    this->Begin({ 1e-11, Limit });
    for (int iteration = 1; iteration <= Limit; ++iteration)
    {
      ASSERT_TRUE(this->Iteration->MayContinue());
      this->GoTo(1.0 - 1e-9 * (iteration <= 2 || isEnded ? std::abs(iteration - 2) + 1 : 1.0 / iteration));
      this->Iteration->Precondition(this->r, this->z);
      this->Iteration->KeepBest();
    }
    EXPECT_FALSE(this->Iteration->MayContinue());
    this->Iteration->End();
    EXPECT_EQ(this->Report.Returned, isEnded ? 2 : Limit);
    ASSERT_EQ(this->Report.Warnings.size(), 1U);
    EXPECT_EQ(this->Report.Warnings[0].find("rounding") != std::string::npos, isEnded) << this->Report.Warnings[0];
    EXPECT_EQ(this->Report.Warnings[0].find("raise") == std::string::npos, isEnded);
  }
}

TEST_F(MonitoredIteration, BestIsTheOneBeforeWhereAMeasuredResidualIsRaised)
{
  this->Begin({ 0.01, 2 });
  this->GoTo(0.9);
  this->Iteration->Precondition(this->r, this->z);
  this->Iteration->KeepBest();
  this->GoTo(0.95);
  this->Iteration->Precondition(this->r, this->z);
  EXPECT_NEAR(this->Report.Iterations[2].RelativeResidual, 0.05 / 0.95, 1e-15);
  this->Iteration->ComputeResidual(this->r);
  this->B.Factor = 1e4;
  this->Iteration->Precondition(this->r, this->z);
  EXPECT_NEAR(this->Report.Iterations[2].RelativeResidual, 100.0 * 0.05 / 0.95, 1e-12);
  this->Iteration->KeepBest();
  EXPECT_EQ(this->Iteration->IterationsSinceBest(), 1);
  EXPECT_FALSE(this->Iteration->MayContinue());
  this->B.Factor = 1.0;
  this->Iteration->End();
  EXPECT_FALSE(this->Report.Converged);
  EXPECT_EQ(this->Report.Returned, 1);
  EXPECT_EQ(this->x[0], 0.9);
  EXPECT_NEAR(this->Report.Iterations[1].RelativeResidual, 0.1 / 0.9, 1e-15);
  ASSERT_EQ(this->Report.Warnings.size(), 1u);
  EXPECT_NE(this->Report.Warnings[0].find("1.1e-01 (iteration 1,"), std::string::npos);
}

TEST_F(MonitoredIteration, EstimateConvergesOnlyWhereAllowedAndSteady)
{
  for (const bool mayEstimate : { false, true })
  {
    StoppingCriteria stop{ 0.01, 10 };
    stop.MayEstimate = mayEstimate;
    for (const double change : { 1.0, 1.9, 2.1, 0.4 }) // of the ratio from row 0 to row 1
    {
      this->B.Factor = 1.0;
      this->x.resize(0);
      this->Begin(stop);
      this->GoTo(0.9);
      this->B.Factor = change * change;
      this->Iteration->Precondition(this->r, this->z);
      this->Iteration->KeepBest();
      this->GoTo(0.999);
      EXPECT_TRUE(this->Iteration->SeemsConverged());
      EXPECT_EQ(this->Iteration->HasConverged(), mayEstimate && change < 2.0 && change > 0.5);
      this->Iteration->Precondition(this->r, this->z);
      EXPECT_TRUE(this->Iteration->HasConverged());
    }
  }
}

TEST_F(MonitoredIteration, PreconditionerThatIsNotPositiveMeasuresNothing)
{
  this->Begin({ 0.01, 10 });
  this->GoTo(0.999);
  this->B.Factor = -1.0;
  EXPECT_LT(this->Iteration->Precondition(this->r, this->z), 0.0);
  EXPECT_TRUE(this->Iteration->SeemsConverged());
  EXPECT_FALSE(this->Iteration->HasConverged());
  this->Iteration->KeepBest();
  this->Iteration->StopShort("of the preconditioner");
  this->Iteration->End();
  EXPECT_FALSE(this->Report.Converged);
  EXPECT_EQ(this->Report.Returned, 0);
}
