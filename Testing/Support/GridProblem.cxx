#include "Support/GridProblem.h"

#include "Support/Random.h"

#include <cmath>

namespace dmg::test
{

template <class Scalar>
SparseMatrix<Scalar> FromTriplets(int rows, int columns, const std::vector<Eigen::Triplet<Scalar>>& entries)
{
  SparseMatrix<Scalar> A(rows, columns);
  A.setFromTriplets(entries.begin(), entries.end());
  A.makeCompressed();
  return A;
}

template <class Scalar>
GridProblem<Scalar> MakeGridProblem(int depth, int levels)
{
  GridProblem<Scalar> problem;
  const double pi = std::acos(-1.0);
  Random random(20261121);
  std::vector<double> gauge;
  for (int level = 0; level < levels; ++level)
  {
    const int n = (1 << (depth - level)) - 1;
    const auto index = [n](int x, int y) { return (y - 1) * n + (x - 1); }; // x, y in [1, n]
    const auto isInside = [n](int x, int y) { return x >= 1 && x <= n && y >= 1 && y <= n; };
    // In Landau's gauge, transport along y is trivial, and along x it turns by field * y per step.
    const double field = 2.0 * 2.0 * pi / ((n + 1.0) * (n + 1.0));

    const std::vector<double> finerGauge = gauge;
    gauge.resize(n * n);
    for (double& angle : gauge)
    {
      angle = random.Uniform(0.0, 2.0 * pi);
    }
    if (level == 0)
    {
      std::vector<Eigen::Triplet<Scalar>> entries;
      for (int y = 1; y <= n; ++y)
      {
        for (int x = 1; x <= n; ++x)
        {
          const int i = index(x, y);
          entries.emplace_back(i, i, Scalar(4.0));
          const auto couple = [&](int ofX, int ofY, double angle)
          {
            if (isInside(ofX, ofY))
            {
              const int j = index(ofX, ofY);
              entries.emplace_back(i, j, -Phase<Scalar>(angle + gauge[j] - gauge[i]));
            }
          };
          couple(x - 1, y, field * y);
          couple(x + 1, y, -field * y);
          couple(x, y - 1, 0.0);
          couple(x, y + 1, 0.0);
        }
      }
      problem.A = FromTriplets(n * n, n * n, entries);
    }
    else
    {
      const int fineN = 2 * n + 1;
      const double fineField = field / 4.0;
      std::vector<Eigen::Triplet<Scalar>> entries;
      for (int y = 1; y <= n; ++y)
      {
        for (int x = 1; x <= n; ++x)
        {
          for (int dy = -1; dy <= 1; ++dy)
          {
            for (int dx = -1; dx <= 1; ++dx)
            {
              const int fineX = 2 * x + dx;
              const int fineY = 2 * y + dy;
              const int i = (fineY - 1) * fineN + (fineX - 1);
              const int j = index(x, y);
              // Transport from the coarse node: along y first, then along x.
              const double angle = fineField * fineY * dx + gauge[j] - finerGauge[i];
              const double weight = (dx == 0 ? 1.0 : 0.5) * (dy == 0 ? 1.0 : 0.5);
              entries.emplace_back(i, j, weight * Phase<Scalar>(angle));
            }
          }
        }
      }
      problem.P.push_back(FromTriplets(fineN * fineN, n * n, entries));
    }
  }
  return problem;
}

template <class Scalar>
Vector<Scalar> RandomVector(int size, unsigned seed)
{
  Random random(seed);
  Vector<Scalar> x(size);
  for (Scalar& number : x)
  {
    if constexpr (std::is_same<Scalar, Complex>::value)
    {
      number = random.Number();
    }
    else
    {
      number = random.Uniform(-1.0, 1.0);
    }
  }
  return x;
}

template SparseMatrix<double> FromTriplets(int, int, const std::vector<Eigen::Triplet<double>>&);
template SparseMatrix<Complex> FromTriplets(int, int, const std::vector<Eigen::Triplet<Complex>>&);
template SparseMatrix<Complex32> FromTriplets(int, int, const std::vector<Eigen::Triplet<Complex32>>&);
template GridProblem<double> MakeGridProblem(int, int);
template GridProblem<Complex> MakeGridProblem(int, int);
template Vector<double> RandomVector(int, unsigned);
template Vector<Complex> RandomVector(int, unsigned);

}
