#include "Solvers/Krylov/LowestOfBlock.h"

#include "Support/Hash.h"

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
/// Iterations in which a residual is not halved, after which rounding errors hold it up.
constexpr int Patience = 20;
using Block = Eigen::MatrixXd;

/// A block of vectors on each part. A block may have fewer columns than others, and none where its part is solved.
using Blocks = std::vector<Block>;

/// Some parts of a problem, whose blocks an operator takes together: column k of all of them is one vector.
class PartsOfProblem
{
public:
  PartsOfProblem(
    const EigenProblem& problem, const std::vector<int>& parts, Eigen::Index unknowns, const ExecutionContext& context)
    : Problem(problem)
    , Context(context)
    , Whole(Vector<double>::Zero(unknowns))
  {
    const Eigen::Index pair = problem.UnknownsPerMass(unknowns);
    for (const int part : parts)
    {
      const auto begin = problem.Parts.Items.begin() + problem.Parts.Begins[part];
      this->Unknowns.emplace_back(begin, problem.Parts.Items.begin() + problem.Parts.Begins[part + 1]);
      Vector<double> mass(static_cast<Eigen::Index>(this->Unknowns.back().size()));
      for (Eigen::Index k = 0; k < mass.size(); ++k)
      {
        mass[k] = problem.Mass[this->Unknowns.back()[k] / pair];
      }
      this->Masses.push_back(std::move(mass));
    }
  }

  const Vector<double>& MassOf(std::size_t part) const { return this->Masses[part]; }
  /// Sums over all processes, which each have some of the rows.
  Block Summed(Block products) const
  {
    this->Problem.Sum(products.data(), static_cast<std::size_t>(products.size()));
    return products;
  }
  double Summed(double product) const
  {
    this->Problem.Sum(&product, 1);
    return product;
  }
  Vector<double> Gather(std::size_t part, const Vector<double>& whole) const { return whole(this->Unknowns[part]); }
  void Scatter(std::size_t part, const Vector<double>& values, Vector<double>& whole) const
  {
    whole(this->Unknowns[part]) = values;
  }

  Blocks TimesA(const Blocks& X)
  {
    return this->Apply(
      X, [this](const Vector<double>& from, Vector<double>& to) { this->Problem.A.Apply(from, to, this->Context); });
  }
  Blocks Preconditioned(const Blocks& X)
  {
    return this->Apply(X,
      [this](const Vector<double>& from, Vector<double>& to) { this->Problem.Inverse.Apply(from, to, this->Context); });
  }

private:
  template <class Function>
  Blocks Apply(const Blocks& X, const Function& function)
  {
    Blocks Y;
    Eigen::Index width = 0;
    for (const Block& block : X)
    {
      Y.emplace_back(block.rows(), block.cols());
      width = std::max(width, block.cols());
    }
    Vector<double> result;
    for (Eigen::Index column = 0; column < width; ++column)
    {
      this->Whole.setZero();
      for (std::size_t part = 0; part < X.size(); ++part)
      {
        if (column < X[part].cols())
        {
          this->Scatter(part, X[part].col(column), this->Whole);
        }
      }
      function(this->Whole, result);
      for (std::size_t part = 0; part < X.size(); ++part)
      {
        if (column < X[part].cols())
        {
          Y[part].col(column) = this->Gather(part, result);
        }
      }
    }
    return Y;
  }

  const EigenProblem& Problem;
  const ExecutionContext& Context;
  std::vector<std::vector<int>> Unknowns;
  std::vector<Vector<double>> Masses;
  Vector<double> Whole; ///< zero outside of the parts
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

/// The iteration on one part.
struct BlockIteration
{
  Block X;     ///< the lowest eigenvectors so far
  Block Steps; ///< of the last iteration
  Block Span;  ///< X, the preconditioned residuals and the steps; empty where the part is solved
  double Theta = 0.0;
  double Residual = std::numeric_limits<double>::infinity();
  double Best = std::numeric_limits<double>::infinity(); ///< the last residual that was half of the one before it
  int SinceBest = 0;

  /// Rayleigh and Ritz: X becomes the lowest eigenvectors in the span. \return their residuals.
  Block Improve(const PartsOfProblem& on, const Block& ASpan, const Vector<double>& mass)
  {
    const Eigen::Index width = this->X.cols();
    const Block basis = Basis(on.Summed(this->Span.transpose() * (mass.asDiagonal() * this->Span)));
    const Block gramA = basis.transpose() * on.Summed(this->Span.transpose() * ASpan) * basis;
    const Eigen::SelfAdjointEigenSolver<Block> solver(0.5 * (gramA + gramA.transpose()));
    const Eigen::Index size = std::min(width, gramA.cols());
    const Block C = basis * solver.eigenvectors().leftCols(size);
    const Eigen::Index others = this->Span.cols() - width;
    this->Steps = this->Span.rightCols(others) * C.bottomRows(others);
    this->X = this->Span * C;
    this->Theta = solver.eigenvalues()[0];
    return ASpan * C - (mass.asDiagonal() * this->X) * solver.eigenvalues().head(size).asDiagonal();
  }

  /// Whether x is accurate although rounding errors bound the residual. Where cells are of very different shapes, rounding errors of
  /// products with A are large in the energy norm, but not in the field. Then the norm of B r in M measures the error of x.
  /// \param squaredError of x, by that norm.
  bool IsSolved(double squaredError, double tolerance)
  {
    constexpr double SmallError = 1e-4;
    const bool isBest = this->Residual < 0.5 * this->Best;
    this->Best = isBest ? this->Residual : this->Best;
    this->SinceBest = isBest ? 0 : this->SinceBest + 1;
    return this->Residual <= tolerance || (this->SinceBest >= Patience && squaredError <= SmallError * SmallError);
  }

  /// \param W the preconditioned residuals R.
  void Extend(const PartsOfProblem& on, const Block& R, const Block& W, const Vector<double>& mass, double tolerance)
  {
    this->Residual = std::sqrt(std::max(0.0, on.Summed(R.col(0).dot(W.col(0)))) / this->Theta);
    if (this->IsSolved(on.Summed(W.col(0).cwiseAbs2().dot(mass)), tolerance))
    {
      this->Span.resize(this->X.rows(), 0);
      return;
    }
    this->Span.resize(this->X.rows(), this->X.cols() + W.cols() + this->Steps.cols());
    this->Span << this->X, W, this->Steps;
  }
};

/// Starts with pseudo-random vectors without their rough parts, and x.
std::vector<BlockIteration> Start(PartsOfProblem& on, std::size_t numberOfParts, const Vector<double>& x)
{
  Blocks random;
  for (std::size_t part = 0; part < numberOfParts; ++part)
  {
    const Vector<double>& mass = on.MassOf(part);
    const double unknowns = on.Summed(static_cast<double>(mass.size()));
    Block block(mass.size(), static_cast<Eigen::Index>(std::min<double>(BlockSize, unknowns)));
    for (Eigen::Index k = 0; k < block.size(); ++k)
    {
      block.data()[k] = PseudoRandom(static_cast<std::uint64_t>(k));
    }
    random.push_back(mass.asDiagonal() * block);
  }
  std::vector<BlockIteration> iterations(numberOfParts);
  const Blocks smooth = on.Preconditioned(random);
  for (std::size_t part = 0; part < numberOfParts; ++part)
  {
    iterations[part].X = smooth[part];
    iterations[part].X.col(0) = on.Gather(part, x);
    iterations[part].Span = iterations[part].X;
  }
  return iterations;
}

}

std::vector<LowestOfPart> FindLowestOfBlocks(const EigenProblem& problem, const std::vector<int>& parts,
  const StoppingCriteria& stop, Vector<double>& x, std::vector<double>& theta, const ExecutionContext& context)
{
  PartsOfProblem on(problem, parts, x.size(), context);
  std::vector<BlockIteration> iterations = Start(on, parts.size(), x);
  Blocks spans(parts.size()), residuals(parts.size());
  const auto isSolved = [](const BlockIteration& iteration) { return iteration.Span.cols() == 0; };
  for (int k = 0; !std::all_of(iterations.begin(), iterations.end(), isSolved); ++k)
  {
    for (std::size_t part = 0; part < parts.size(); ++part)
    {
      spans[part] = iterations[part].Span;
    }
    const Blocks images = on.TimesA(spans);
    for (std::size_t part = 0; part < parts.size(); ++part)
    {
      residuals[part] = isSolved(iterations[part]) ? Block(spans[part].rows(), 0)
                                                   : iterations[part].Improve(on, images[part], on.MassOf(part));
    }
    const Blocks corrections = on.Preconditioned(residuals);
    for (std::size_t part = 0; part < parts.size(); ++part)
    {
      if (!isSolved(iterations[part]))
      {
        iterations[part].Extend(on, residuals[part], corrections[part], on.MassOf(part), stop.RelativeTolerance);
      }
    }
    context.Checkpoint(static_cast<double>(k) / stop.MaximumIterations);
    if (k == stop.MaximumIterations)
    {
      break;
    }
  }
  std::vector<LowestOfPart> found;
  for (std::size_t part = 0; part < parts.size(); ++part)
  {
    on.Scatter(part, iterations[part].X.col(0), x);
    theta[parts[part]] = iterations[part].Theta;
    found.push_back({ iterations[part].Residual, isSolved(iterations[part]) });
  }
  return found;
}

}
