#include "Solvers/Krylov/DeflatedPreconditioner.h"

#include "Solvers/Krylov/ConjugateGradient.h"
#include "Support/DenseAlgebra.h"
#include "Support/GridProblem.h"
#include "Support/MatrixOperator.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <limits>
#include <utility>

using namespace dmg;
using test::Densified;

namespace
{

constexpr double Epsilon = std::numeric_limits<double>::epsilon();

class DenseOperator : public Preconditioner<double>
{
public:
  explicit DenseOperator(Eigen::MatrixXd matrix)
    : Matrix(std::move(matrix))
  {
  }
  void Apply(const Vector<double>& r, Vector<double>& z, const ExecutionContext&) override { z = this->Matrix * r; }

private:
  Eigen::MatrixXd Matrix;
};

/// A smoothness energy L with eigenvalues between 1 and 2 besides a kernel, and a few unknowns held weakly:
/// what harmonic fields are to their systems.
struct WeaklyHeld
{
  WeaklyHeld(int size, int kernel, int prescribed, double weight)
  {
    const Vector<double> numbers = test::RandomVector<double>(size * size, 3301);
    const Eigen::MatrixXd random = Eigen::Map<const Eigen::MatrixXd>(numbers.data(), size, size);
    const Eigen::MatrixXd Q = Eigen::HouseholderQR<Eigen::MatrixXd>(random).householderQ();
    Vector<double> eigenvalues = Vector<double>::LinSpaced(size, 1.0, 2.0);
    eigenvalues.head(kernel).setZero();
    this->H = Q.leftCols(kernel);
    Eigen::MatrixXd dense = Q * eigenvalues.asDiagonal() * Q.transpose();
    dense = 0.5 * (dense + dense.transpose().eval());
    this->b = Vector<double>::Zero(size);
    this->Largest = 2.0 + weight;
    for (int k = 0; k < prescribed; ++k)
    {
      const int unknown = (17 * k + 3) % size;
      dense(unknown, unknown) += weight;
      this->b[unknown] = weight * (1.0 + k);
    }
    this->A = dense.sparseView();
    this->A.makeCompressed();
    // Nearly blind for the kernel, as coarse spaces are that hold it only nearly.
    Vector<double> inverses = Vector<double>::Constant(size, 0.7);
    inverses.tail(size / 2).setConstant(0.6);
    this->Inner = Q * inverses.asDiagonal() * Q.transpose();
    this->Inner = 0.5 * (this->Inner + this->Inner.transpose().eval());
  }

  test::MatrixOperator<double> Operator() const { return test::MatrixOperator<double>(this->A); }

  SparseMatrix<double> A;
  Eigen::MatrixXd H;
  Vector<double> b;
  Eigen::MatrixXd Inner;
  double Largest = 0.0; ///< no eigenvalue is larger
};

int Iterations(const WeaklyHeld& problem, Preconditioner<double>& B, Vector<double>& x, int limit = 100)
{
  SolveReport report;
  x.resize(0);
  StoppingCriteria stop;
  stop.MaximumIterations = limit;
  stop.MayEstimate = true; // as for cycles, which it deflates; r.Br has rounding errors over the weight
  ConjugateGradient(problem.Operator(), B, problem.b, stop, x, report, SerialContext());
  EXPECT_TRUE(report.Converged);
  return static_cast<int>(report.Iterations.size()) - 1;
}

}

TEST(DeflatedPreconditioner, IsItsFormula)
{
  const WeaklyHeld problem(60, 4, 6, 0.5);
  const Eigen::MatrixXd A(problem.A);
  const Eigen::MatrixXd& H = problem.H;
  const Eigen::MatrixXd Q = H * test::Inverse(test::GalerkinProduct(A, H)) * H.transpose();
  const Eigen::MatrixXd one = Eigen::MatrixXd::Identity(60, 60);
  const Eigen::MatrixXd expected = Q + (one - Q * A) * problem.Inner * (one - A * Q);

  DenseOperator inner(problem.Inner);
  DeflatedPreconditioner deflated(inner, problem.Operator(), problem.H, problem.Largest, SerialContext());
  const Eigen::MatrixXd D = Densified(deflated, 60);
  EXPECT_LE((D - expected).norm(), 1e3 * Epsilon * expected.norm());
  EXPECT_LE((D - D.transpose()).norm(), 1e3 * Epsilon * D.norm());
  EXPECT_GT(test::Eigenvalues(D).minCoeff(), 0.0);
  // Exact on H.
  EXPECT_LE((D * A * H - H).norm(), 1e3 * Epsilon * D.norm() * A.norm());
}

TEST(DeflatedPreconditioner, IterationsDoNotKnowHowWeaklyTheKernelIsHeld)
{
  // Besides H, D A has eigenvalues between 0.6 and 1.4 + 0.7 weight: conjugate gradients gain a
  // factor of 4 per iteration (Chebyshev), so 16 lead to 1e-8 of the energy, whatever the weight.
  for (const double weight : { 0.5, 1e-3, 1e-6 })
  {
    SCOPED_TRACE(weight);
    const WeaklyHeld problem(200, 6, 9, weight);
    DenseOperator inner(problem.Inner);
    DeflatedPreconditioner deflated(inner, problem.Operator(), problem.H, problem.Largest, SerialContext());
    Vector<double> x;
    EXPECT_LE(Iterations(problem, deflated, x), 16);
    const Vector<double> expected = test::Solved(Densified(problem.A), problem.b);
    EXPECT_LE((x - expected).norm(), 1e-4 * expected.norm());
  }
}

TEST(DeflatedPreconditioner, IsDefinedForFewerPrescriptionsThanKernelVectors)
{
  // A is singular. What it holds is found; H^T A H has no inverse.
  for (const int prescribed : { 1, 2, 5 })
  {
    SCOPED_TRACE(prescribed);
    const WeaklyHeld problem(120, 6, prescribed, 1.0);
    DenseOperator inner(problem.Inner);
    DeflatedPreconditioner deflated(inner, problem.Operator(), problem.H, problem.Largest, SerialContext());
    const Eigen::MatrixXd D = Densified(deflated, 120);
    ASSERT_TRUE(D.allFinite());
    EXPECT_LE((D - D.transpose()).norm(), 1e4 * Epsilon * D.norm());
    Vector<double> x;
    EXPECT_LE(Iterations(problem, deflated, x), 20);
    // Of all solutions, the one with no part in what is not held.
    const Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd> pseudo{ Eigen::MatrixXd(problem.A) };
    EXPECT_EQ(pseudo.rank(), 120 - 6 + prescribed);
    EXPECT_LE((x - pseudo.solve(problem.b)).norm(), 1e-5 * x.norm());
    EXPECT_LE((problem.A * x - problem.b).norm(), 1e-7 * problem.b.norm());
  }
}

TEST(DeflatedPreconditioner, EnergiesThatAreRoundingErrorsAreNotInverted)
{
  // One unknown is held and the kernel has six dimensions, so that five have no energy. Scaling the
  // system scales its rounding errors, and what the preconditioner takes for one.
  for (const double scale : { 1e-8, 1.0, 1e8 })
  {
    SCOPED_TRACE(scale);
    WeaklyHeld problem(120, 6, 1, 1.0);
    problem.A *= scale;
    DenseOperator inner(problem.Inner / scale);
    DeflatedPreconditioner deflated(inner, problem.Operator(), problem.H, scale * problem.Largest, SerialContext());
    // Q would be about 1e16 / scale; but the kernel has energies of 1 / 120 or so, or none.
    const Eigen::MatrixXd D = Densified(deflated, 120);
    EXPECT_LE(scale * D.norm(), 1e4);
  }
}

TEST(DeflatedPreconditioner, VectorsThatAreHeldAreNoKernel)
{
  // Two blocks, one of them held; the kernel of A in H is one vector of the other.
  const WeaklyHeld block(40, 2, 1, 1.0);
  Eigen::MatrixXd A = Eigen::MatrixXd::Zero(80, 80);
  A.topLeftCorner(40, 40) = Eigen::MatrixXd(block.A);
  Eigen::MatrixXd inner = Eigen::MatrixXd::Zero(80, 80);
  inner.topLeftCorner(40, 40) = block.Inner;
  Eigen::MatrixXd H = Eigen::MatrixXd::Zero(80, 4);
  H.topLeftCorner(40, 2) = block.H;
  const SparseMatrix<double> sparse = A.sparseView();
  DenseOperator B(inner);
  DeflatedPreconditioner deflated(B, test::MatrixOperator<double>(sparse), H, block.Largest, SerialContext());
  EXPECT_EQ(deflated.Kernel().Size(), 1);
  const Vector<double> x = test::RandomVector<double>(80, 3307);
  Vector<double> without = x;
  deflated.Kernel().Remove(without, SerialContext());
  EXPECT_LE((A * (x - without)).norm(), 1e3 * Epsilon * x.norm());
  EXPECT_EQ((x - without).tail(40).norm(), 0.0);
  EXPECT_GT((x - without).norm(), 1e-3);
}

TEST(DeflatedPreconditioner, HeldUnknownsStayZero)
{
  // Rows of A, B and H that are zero, as where an unknown is held.
  WeaklyHeld problem(60, 4, 6, 0.5);
  for (const int held : { 0, 17, 59 })
  {
    Eigen::MatrixXd A(problem.A);
    A.row(held).setZero();
    A.col(held).setZero();
    problem.A = A.sparseView();
    problem.Inner.row(held).setZero();
    problem.Inner.col(held).setZero();
    problem.H.row(held).setZero();
  }
  DenseOperator inner(problem.Inner);
  DeflatedPreconditioner deflated(inner, problem.Operator(), problem.H, problem.Largest, SerialContext());
  const Eigen::MatrixXd D = Densified(deflated, 60);
  for (const int held : { 0, 17, 59 })
  {
    EXPECT_EQ(D.row(held).norm(), 0.0);
  }
  // Exact on what is left of H.
  EXPECT_LE((D * problem.A * problem.H - problem.H).norm(), 1e4 * Epsilon * D.norm() * 2.5);
}
