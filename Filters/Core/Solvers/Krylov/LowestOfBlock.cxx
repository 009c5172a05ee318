#include "Solvers/Krylov/LowestOfBlock.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>

namespace dmg
{
namespace
{

constexpr int BlockSize = 8;
using Block = Eigen::MatrixXd;

/// In [-1, 1); SplitMix64 (Steele et al. 2014).
double PseudoRandom(std::uint64_t index)
{
  std::uint64_t z = (index + 1) * 0x9e3779b97f4a7c15ULL;
  z = (z ^ (z >> 30)) * 0xbf58476d1ce4e5b9ULL;
  z = (z ^ (z >> 27)) * 0x94d049bb133111ebULL;
  return static_cast<double>(static_cast<std::int64_t>(z ^ (z >> 31))) * 0x1p-63;
}

/// One part of a problem: its unknowns stand side by side in a block.
class PartOfProblem
{
public:
  PartOfProblem(const EigenProblem& problem, int part, int numberOfUnknowns, const ExecutionContext& context)
    : Problem(problem)
    , Context(context)
    , Unknowns(problem.Parts.Items.begin() + problem.Parts.Begins[part],
        problem.Parts.Items.begin() + problem.Parts.Begins[part + 1])
    , Whole(Vector<double>::Zero(numberOfUnknowns))
    , Mass(static_cast<Eigen::Index>(this->Unknowns.size()))
  {
    const int pair = static_cast<int>(numberOfUnknowns / problem.Mass.size());
    for (Eigen::Index k = 0; k < this->Mass.size(); ++k)
    {
      this->Mass[k] = problem.Mass[this->Unknowns[k] / pair];
    }
  }

  Eigen::Index Size() const { return this->Mass.size(); }
  Block TimesMass(const Block& X) const { return this->Mass.asDiagonal() * X; }
  Block TimesA(const Block& X)
  {
    return this->Apply(
      X, [this](const Vector<double>& from, Vector<double>& to) { this->Problem.A.Apply(from, to, this->Context); });
  }
  Block Preconditioned(const Block& X)
  {
    return this->Apply(X,
      [this](const Vector<double>& from, Vector<double>& to) { this->Problem.Inverse.Apply(from, to, this->Context); });
  }

  Vector<double> Gather(const Vector<double>& whole) const { return whole(this->Unknowns); }
  void Scatter(const Vector<double>& part, Vector<double>& whole) const { whole(this->Unknowns) = part; }

private:
  template <class Function>
  Block Apply(const Block& X, const Function& function)
  {
    Block Y(X.rows(), X.cols());
    Vector<double> result;
    for (Eigen::Index column = 0; column < X.cols(); ++column)
    {
      this->Whole(this->Unknowns) = X.col(column);
      function(this->Whole, result);
      Y.col(column) = result(this->Unknowns);
    }
    return Y;
  }

  const EigenProblem& Problem;
  const ExecutionContext& Context;
  const std::vector<int> Unknowns;
  Vector<double> Whole; ///< zero outside of the part
  Vector<double> Mass;
};

/// A basis of the columns that are not combinations of others, orthonormal in M.
Block Basis(const Block& gramM)
{
  const Vector<double> scale = gramM.diagonal().cwiseMax(std::numeric_limits<double>::min()).cwiseSqrt().cwiseInverse();
  const Block scaled = scale.asDiagonal() * gramM * scale.asDiagonal();
  const Eigen::SelfAdjointEigenSolver<Block> solver(scaled);
  constexpr double Smallest = 1e-13;
  const Eigen::Index rank = (solver.eigenvalues().array() > Smallest).count();
  const Vector<double> roots = solver.eigenvalues().tail(rank).cwiseSqrt().cwiseInverse();
  return scale.asDiagonal() * solver.eigenvectors().rightCols(rank) * roots.asDiagonal();
}

}

double FindLowestOfBlock(const EigenProblem& problem, int part, const StoppingCriteria& stop, Vector<double>& x,
  double& theta, const ExecutionContext& context)
{
  PartOfProblem on(problem, part, static_cast<int>(x.size()), context);
  const Eigen::Index width = std::min<Eigen::Index>(BlockSize, on.Size());
  Block X(on.Size(), width);
  for (Eigen::Index k = 0; k < X.size(); ++k)
  {
    X.data()[k] = PseudoRandom(static_cast<std::uint64_t>(k));
  }
  X = on.Preconditioned(on.TimesMass(X));
  X.col(0) = on.Gather(x);
  Block S = X;
  Block steps(on.Size(), 0);
  double residual = std::numeric_limits<double>::infinity();
  for (int k = 0;; ++k)
  {
    // Rayleigh and Ritz: the lowest eigenvectors in the span of S.
    const Block AS = on.TimesA(S);
    const Block basis = Basis(S.transpose() * on.TimesMass(S));
    const Block gramA = basis.transpose() * (S.transpose() * AS) * basis;
    const Eigen::SelfAdjointEigenSolver<Block> solver(0.5 * (gramA + gramA.transpose()));
    const Eigen::Index size = std::min(width, gramA.cols());
    const Block C = basis * solver.eigenvectors().leftCols(size);
    const Eigen::Index others = S.cols() - X.cols();
    steps = others > 0 ? Block(S.rightCols(others) * C.bottomRows(others)) : Block(on.Size(), 0);
    X = S * C;
    const Block R = AS * C - on.TimesMass(X) * solver.eigenvalues().head(size).asDiagonal();
    const Block W = on.Preconditioned(R);
    theta = solver.eigenvalues()[0];
    residual = std::sqrt(std::max(0.0, R.col(0).dot(W.col(0))) / theta);
    context.Checkpoint(static_cast<double>(k) / stop.MaximumIterations);
    if (residual <= stop.RelativeTolerance || k == stop.MaximumIterations)
    {
      break;
    }
    S.resize(on.Size(), X.cols() + W.cols() + steps.cols());
    S << X, W, steps;
  }
  on.Scatter(X.col(0), x);
  return residual;
}

}
