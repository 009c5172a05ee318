#ifndef dmgTestTorusProblem_h
#define dmgTestTorusProblem_h

#include "Support/GridProblem.h"

#include <array>
#include <utility>

namespace dmg::test
{

/// Edges of an n x n grid on the torus whose squares are cut by their rising diagonals: three per
/// node, to the right, up, and diagonally.
class TorusGrid
{
public:
  explicit TorusGrid(int n)
    : N(n)
  {
  }

  enum Direction
  {
    Right,
    Up,
    Diagonal
  };

  int NumberOfNodes() const { return this->N * this->N; }
  int Node(int x, int y) const { return (y % this->N) * this->N + x % this->N; }
  int Edge(int x, int y, Direction direction) const { return 3 * this->Node(x, y) + direction; }

private:
  int N;
};

/// The Laplacian of 1-forms on a torus of n x n nodes, L1 = d1^T *2 d1 + *1 d0 *0^-1 d0^T *1, with
/// random positive stars, plus weights on a few edges that make it definite; rows of 11 entries.
/// Prolongations are Whitney's interpolation, exact for circulations: 1 or 3 entries a row.
/// \param n even, levels - 1 times.
inline GridProblem<double> MakeTorusProblem(int n, int levels)
{
  using Direction = TorusGrid::Direction;
  GridProblem<double> problem;
  Random random(20261122);
  const TorusGrid grid(n);
  const int nodes = grid.NumberOfNodes();
  std::vector<Eigen::Triplet<double>> d0, d1;
  for (int y = 0; y < n; ++y)
  {
    for (int x = 0; x < n; ++x)
    {
      const int right = grid.Edge(x, y, Direction::Right);
      const int up = grid.Edge(x, y, Direction::Up);
      const int diagonal = grid.Edge(x, y, Direction::Diagonal);
      const std::array<std::pair<int, int>, 3> ends = { std::pair(right, grid.Node(x + 1, y)),
        std::pair(up, grid.Node(x, y + 1)), std::pair(diagonal, grid.Node(x + 1, y + 1)) };
      for (const auto& [edge, end] : ends)
      {
        d0.emplace_back(edge, grid.Node(x, y), -1.0);
        d0.emplace_back(edge, end, 1.0);
      }
      const int lower = 2 * grid.Node(x, y);
      d1.emplace_back(lower, right, 1.0);
      d1.emplace_back(lower, grid.Edge(x + 1, y, Direction::Up), 1.0);
      d1.emplace_back(lower, diagonal, -1.0);
      d1.emplace_back(lower + 1, diagonal, 1.0);
      d1.emplace_back(lower + 1, grid.Edge(x, y + 1, Direction::Right), -1.0);
      d1.emplace_back(lower + 1, up, -1.0);
    }
  }
  const auto star = [&random](int size)
  {
    Vector<double> weights(size);
    for (double& weight : weights)
    {
      weight = random.Uniform(0.8, 1.25);
    }
    return weights;
  };
  const SparseMatrix<double> D0 = FromTriplets(3 * nodes, nodes, d0);
  const SparseMatrix<double> D1 = FromTriplets(2 * nodes, 3 * nodes, d1);
  const SparseMatrix<double> gradient = star(3 * nodes).asDiagonal() * D0;
  const SparseMatrix<double> curl = star(2 * nodes).asDiagonal() * D1;
  const SparseMatrix<double> divergence = star(nodes).asDiagonal() * SparseMatrix<double>(gradient.transpose());
  problem.A = SparseMatrix<double>(D1.transpose() * curl) + SparseMatrix<double>(gradient * divergence);
  for (int k = 0; k < 10; ++k)
  {
    const int edge = random.Index(3 * nodes);
    problem.A.coeffRef(edge, edge) += 1.0;
  }
  problem.A.makeCompressed();

  for (int level = 1; level < levels; ++level)
  {
    const TorusGrid fine(n >> (level - 1));
    const TorusGrid coarse(n >> level);
    std::vector<Eigen::Triplet<double>> entries;
    for (int y = 0; y < n >> level; ++y)
    {
      for (int x = 0; x < n >> level; ++x)
      {
        const int right = coarse.Edge(x, y, Direction::Right);
        const int up = coarse.Edge(x, y, Direction::Up);
        const int diagonal = coarse.Edge(x, y, Direction::Diagonal);
        for (const int half : { 0, 1 })
        {
          entries.emplace_back(fine.Edge(2 * x + half, 2 * y, Direction::Right), right, 0.5);
          entries.emplace_back(fine.Edge(2 * x, 2 * y + half, Direction::Up), up, 0.5);
          entries.emplace_back(fine.Edge(2 * x + half, 2 * y + half, Direction::Diagonal), diagonal, 0.5);
        }
        // From the middle of side ij to that of side ik of a triangle: (jk + ik - ij) / 4.
        const auto inside = [&entries](int edge, int jk, double signJk, int ik, double signIk, int ij, double signIj)
        {
          entries.emplace_back(edge, jk, 0.25 * signJk);
          entries.emplace_back(edge, ik, 0.25 * signIk);
          entries.emplace_back(edge, ij, -0.25 * signIj);
        };
        const int farUp = coarse.Edge(x + 1, y, Direction::Up);
        const int farRight = coarse.Edge(x, y + 1, Direction::Right);
        const auto middle = [&fine, x, y](int dx, int dy, Direction direction)
        { return fine.Edge(2 * x + dx, 2 * y + dy, direction); };
        inside(middle(1, 0, Direction::Up), farUp, 1.0, diagonal, 1.0, right, 1.0);
        inside(middle(1, 0, Direction::Diagonal), diagonal, 1.0, farUp, 1.0, right, -1.0);
        inside(middle(1, 1, Direction::Right), right, 1.0, farUp, -1.0, diagonal, -1.0);
        inside(middle(0, 1, Direction::Right), farRight, 1.0, diagonal, 1.0, up, 1.0);
        inside(middle(0, 1, Direction::Diagonal), diagonal, 1.0, farRight, 1.0, up, -1.0);
        inside(middle(1, 1, Direction::Up), up, 1.0, farRight, -1.0, diagonal, -1.0);
      }
    }
    problem.P.push_back(FromTriplets(3 * fine.NumberOfNodes(), 3 * coarse.NumberOfNodes(), entries));
  }
  return problem;
}

}

#endif
