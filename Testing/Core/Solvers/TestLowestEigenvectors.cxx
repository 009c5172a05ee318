#include "Solvers/Krylov/LowestEigenvectors.h"

#include "Support/DenseAlgebra.h"
#include "Support/MatrixOperator.h"
#include "Support/TbbContext.h"

#include <Eigen/LU>
#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <vector>

using namespace dmg;

namespace
{

/// B = matrix.
class DenseInverse : public Preconditioner<double>
{
public:
  explicit DenseInverse(Eigen::MatrixXd matrix)
    : Matrix(std::move(matrix))
  {
  }
  void Apply(const Vector<double>& r, Vector<double>& z, const ExecutionContext&) override { z = this->Matrix * r; }

private:
  const Eigen::MatrixXd Matrix;
};

/// Chains of springs with fixed ends, one after the other; their numbers of points.
SparseMatrix<double> Chains(const std::vector<int>& lengths)
{
  std::vector<Eigen::Triplet<double>> entries;
  int i = 0;
  for (const int length : lengths)
  {
    for (int k = 0; k < length; ++k, ++i)
    {
      entries.emplace_back(i, i, 2.0);
      if (k > 0)
      {
        entries.emplace_back(i, i - 1, -1.0);
        entries.emplace_back(i - 1, i, -1.0);
      }
    }
  }
  SparseMatrix<double> A(i, i);
  A.setFromTriplets(entries.begin(), entries.end());
  return A;
}

SortedItems PartsOf(const std::vector<int>& lengths)
{
  SortedItems parts;
  parts.Begins = { 0 };
  for (const int length : lengths)
  {
    parts.Begins.push_back(parts.Begins.back() + length);
  }
  parts.Items.resize(parts.Begins.back());
  std::iota(parts.Items.begin(), parts.Items.end(), 0);
  return parts;
}

/// Of a chain of springs.
double LowestEigenvalue(int length)
{
  return 2.0 - 2.0 * std::cos(Pi / (length + 1));
}

}

// x_k = sin(k pi / (n + 1)).
TEST(LowestEigenvectors, ChainsOfSpringsHaveSines)
{
  const std::vector<int> lengths{ 50, 1, 20, 300 };
  const SparseMatrix<double> A = Chains(lengths);
  const test::MatrixOperator<double> matrix(A);
  // Far from the inverse: no more than its diagonal and a shift of the spectrum.
  DenseInverse inverse(test::Inverse<double>(Eigen::MatrixXd(A) + 0.01 * Eigen::MatrixXd::Identity(371, 371)));
  const Vector<double> mass = Vector<double>::Constant(371, 3.0);
  const SortedItems parts = PartsOf(lengths);
  Vector<double> x = Vector<double>::Zero(371);
  SolveReport report;
  const std::vector<double> theta =
    FindLowestEigenvectors({ matrix, inverse, mass, parts }, { 1e-7, 100 }, x, report, SerialContext());
  EXPECT_TRUE(report.Converged);
  ASSERT_EQ(theta.size(), lengths.size());
  for (std::size_t part = 0; part < lengths.size(); ++part)
  {
    const int n = lengths[part];
    EXPECT_NEAR(theta[part], LowestEigenvalue(n) / 3.0, 1e-12 * theta[part] + 1e-15);
    const auto vector = x.segment(parts.Begins[part], n);
    EXPECT_NEAR(3.0 * vector.squaredNorm(), 1.0, 1e-13);
    Vector<double> sine(n);
    for (int k = 0; k < n; ++k)
    {
      sine[k] = std::sin((k + 1) * Pi / (n + 1));
    }
    EXPECT_NEAR(std::abs(vector.dot(sine)) / sine.norm() * std::sqrt(3.0), 1.0, 1e-12) << n;
  }
}

// From the eigenvector nothing is to be done, and from zero any number of threads gives the same bits.
TEST(LowestEigenvectors, DependOnTheStartAlone)
{
  const std::vector<int> lengths{ 4000, 9000 };
  const SparseMatrix<double> A = Chains(lengths);
  const test::MatrixOperator<double> matrix(A);
  class Diagonal : public Preconditioner<double>
  {
    void Apply(const Vector<double>& r, Vector<double>& z, const ExecutionContext&) override { z = 0.5 * r; }
  } diagonal;
  const Vector<double> mass = Vector<double>::Ones(13000);
  const SortedItems parts = PartsOf(lengths);
  const EigenProblem problem{ matrix, diagonal, mass, parts };
  Vector<double> first = Vector<double>::Zero(13000);
  Vector<double> second = first;
  SolveReport report;
  FindLowestEigenvectors(problem, { 1e-6, 30 }, first, report, SerialContext());
  EXPECT_FALSE(report.Converged);
  EXPECT_EQ(report.Iterations.size(), 31u);
  EXPECT_EQ(report.Warnings.size(), 1u);
  for (std::size_t k = 1; k < report.Iterations.size(); ++k)
  {
    EXPECT_LE(report.Iterations[k].Energy, report.Iterations[k - 1].Energy) << k;
  }
  FindLowestEigenvectors(problem, { 1e-6, 30 }, second, report, test::TbbContext(3));
  EXPECT_EQ(first, second);

  for (int k = 0; k < 4000; ++k)
  {
    first[k] = std::sin((k + 1) * Pi / 4001);
  }
  for (int k = 0; k < 9000; ++k)
  {
    first[4000 + k] = std::sin((k + 1) * Pi / 9001);
  }
  SolveReport ofSolution;
  FindLowestEigenvectors(problem, { 1e-6, 30 }, first, ofSolution, SerialContext());
  EXPECT_TRUE(ofSolution.Converged);
  EXPECT_EQ(ofSolution.Iterations.size(), 1u);
}

// A x = M x / 2 for any x: solved at the start, pairs of unknowns stay as they are while the iteration goes on for the others,
// although nothing but rounding errors is left of their residuals.
TEST(LowestEigenvectors, PartsThatAreSolvedStayNormal)
{
  std::vector<int> lengths(2000, 2);
  lengths.push_back(300);
  SparseMatrix<double> A = Chains(lengths);
  Vector<double> mass = Vector<double>::Ones(A.rows());
  for (int i = 0; i < 4000; ++i)
  {
    mass[i] = 1.0 + 0.001 * (i / 2);
    A.col(i) *= 0.0;
    A.coeffRef(i, i) = 0.5 * mass[i];
  }
  const test::MatrixOperator<double> matrix(A);
  class Diagonal : public Preconditioner<double>
  {
  public:
    explicit Diagonal(Vector<double> inverse)
      : Inverse(std::move(inverse))
    {
    }
    void Apply(const Vector<double>& r, Vector<double>& z, const ExecutionContext&) override
    {
      z = this->Inverse.cwiseProduct(r);
    }

  private:
    const Vector<double> Inverse;
  } diagonal(A.diagonal().cwiseInverse());
  const SortedItems parts = PartsOf(lengths);
  Vector<double> x = Vector<double>::Zero(A.rows());
  SolveReport report;
  const std::vector<double> theta =
    FindLowestEigenvectors({ matrix, diagonal, mass, parts }, { 1e-12, 100 }, x, report, SerialContext());
  for (int part = 0; part < 2000; ++part)
  {
    ASSERT_NEAR(theta[part], 0.5, 1e-13) << part;
    ASSERT_NEAR(mass[2 * part] * x.segment(2 * part, 2).squaredNorm(), 1.0, 1e-13) << part;
  }
}

// Both halves of a part have almost the same eigenvalue, as both sides of a thin plate do. Blocks of vectors find it, for all
// parts in the applications that the slowest takes.
TEST(LowestEigenvectors, ManyPartsWithCloseEigenvaluesCostWhatOneDoes)
{
  class Counted : public Preconditioner<double>
  {
  public:
    explicit Counted(Vector<double> inverse)
      : Inverse(std::move(inverse))
    {
    }
    void Apply(const Vector<double>& r, Vector<double>& z, const ExecutionContext&) override
    {
      z = this->Inverse.cwiseProduct(r);
      ++this->Applications;
    }
    int Applications = 0;

  private:
    const Vector<double> Inverse;
  };
  constexpr int Half = 12;
  const auto applications = [=](int numberOfParts)
  {
    SparseMatrix<double> A = Chains(std::vector<int>(2 * numberOfParts, Half));
    for (int part = 0; part < numberOfParts; ++part)
    {
      const int end = 2 * Half * part + Half;
      A.coeffRef(end - 1, end) = -1e-7;
      A.coeffRef(end, end - 1) = -1e-7;
    }
    A.makeCompressed();
    const test::MatrixOperator<double> matrix(A);
    Counted inverse(Vector<double>::Constant(A.rows(), 0.5));
    const Vector<double> mass = Vector<double>::Ones(A.rows());
    const SortedItems parts = PartsOf(std::vector<int>(numberOfParts, 2 * Half));
    Vector<double> x = Vector<double>::Zero(A.rows());
    SolveReport report;
    const std::vector<double> theta =
      FindLowestEigenvectors({ matrix, inverse, mass, parts }, { 1e-11, 100 }, x, report, SerialContext());
    EXPECT_TRUE(report.Converged);
    for (int part = 0; part < numberOfParts; ++part)
    {
      // The coupling lowers the sum of both halves' eigenvectors, by the product of their ends.
      const double end = std::sqrt(2.0 / (Half + 1)) * std::sin(Half * Pi / (Half + 1));
      EXPECT_NEAR(theta[part], LowestEigenvalue(Half) - 1e-7 * end * end, 1e-13);
      EXPECT_NEAR(x.segment(parts.Begins[part], 2 * Half).squaredNorm(), 1.0, 1e-12);
    }
    return inverse.Applications;
  };
  const int ofOne = applications(1);
  EXPECT_GT(ofOne, 102); // a block has been at work
  EXPECT_LE(applications(40), 2 * ofOne);
}
