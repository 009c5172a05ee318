#include "Quads/Map/ClosestIntegers.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>
#include <vector>

namespace dmg
{

namespace
{

/// Numbers of which some are rounded. The real ones come first, with their conditional means and covariances.
///
/// A number that is rounded takes c c^T / C_ii from the covariance C of the others, c its column. These products are kept, and subtracted
/// many at a time, which passes over C less often; the diagonal is always up to date.
class ConditionalRounding
{
public:
  ConditionalRounding(Eigen::MatrixXd covariance, Vector<double> mean)
    : C(std::move(covariance))
    , Diagonal(this->C.diagonal())
    , Mean(std::move(mean))
    , Kept(this->Mean.size(), MostKept)
    , Rounded(this->Mean.size())
    , Names(this->Mean.size())
  {
    std::iota(this->Names.begin(), this->Names.end(), 0);
  }

  Vector<double> Round(const ExecutionContext& context)
  {
    const int size = static_cast<int>(this->Names.size());
    for (int left = size; left > 0; --left)
    {
      context.Checkpoint(1.0 - static_cast<double>(left) / size);
      this->Exchange(this->Cheapest(left), left - 1, left);
      this->RoundLast(left - 1);
    }
    return this->Rounded;
  }

private:
  static constexpr int MostKept = 64;

  int Cheapest(int left) const
  {
    const auto distances = this->Mean.head(left).array() - this->Mean.head(left).array().round();
    int cheapest = 0;
    (distances.square() / this->Diagonal.head(left).array().max(1e-300)).minCoeff(&cheapest);
    return cheapest;
  }

  void Exchange(int a, int b, int left)
  {
    if (a != b)
    {
      this->C.col(a).head(left).swap(this->C.col(b).head(left));
      this->C.row(a).head(left).swap(this->C.row(b).head(left));
      this->Kept.row(a).swap(this->Kept.row(b));
      std::swap(this->Diagonal[a], this->Diagonal[b]);
      std::swap(this->Mean[a], this->Mean[b]);
      std::swap(this->Names[a], this->Names[b]);
    }
  }

  /// Rounds number k, and lets those before it follow.
  void RoundLast(int k)
  {
    const double variance = std::max(this->Diagonal[k], 1e-300);
    const double integer = std::round(this->Mean[k]);
    const auto kept = this->Kept.leftCols(this->NumberKept);
    const Vector<double> column = this->C.col(k).head(k) - kept.topRows(k) * kept.row(k).transpose();
    this->Rounded[this->Names[k]] = integer;
    this->Mean.head(k) += column * ((integer - this->Mean[k]) / variance);
    this->Diagonal.head(k) -= column.cwiseAbs2() / variance;
    this->Kept.col(this->NumberKept++).head(k) = column / std::sqrt(variance);
    if (this->NumberKept == MostKept)
    {
      const auto rows = this->Kept.topRows(k);
      this->C.topLeftCorner(k, k).noalias() -= rows * rows.transpose();
      this->NumberKept = 0;
    }
  }

  Eigen::MatrixXd C;
  Vector<double> Diagonal; ///< of the covariance less the products that are kept
  Vector<double> Mean;
  Eigen::MatrixXd Kept; ///< C less the sum of k k^T over its first columns k is the covariance
  int NumberKept = 0;
  Vector<double> Rounded;
  std::vector<int> Names;
};

/// Moves of one number or of two by one, as long as they lower the energy by more than rounding errors.
class UnitMoves
{
public:
  UnitMoves(const Eigen::MatrixXd& S, const Vector<double>& x, Vector<double>& y)
    : S(S)
    , Y(y)
    , Gradient(S * (y - x))
  {
  }

  void Run(const ExecutionContext& context)
  {
    constexpr int Most = 20000;
    constexpr Eigen::Index LargestForPairs = 1200; // pairs of more would take longer than all else
    for (int move = 0; move < Most; ++move)
    {
      context.Checkpoint(1.0);
      Move best = this->BestOfOne();
      if (best.Gain <= this->SmallestGain && this->Y.size() <= LargestForPairs)
      {
        best = this->BestOfTwo();
      }
      if (best.Gain <= this->SmallestGain)
      {
        return;
      }
      this->Step(best.First, best.FirstStep);
      if (best.Second >= 0)
      {
        this->Step(best.Second, best.SecondStep);
      }
    }
  }

private:
  struct Move
  {
    double Gain = 0.0;
    int First = -1, Second = -1;
    double FirstStep = 0.0, SecondStep = 0.0;
  };

  /// The gain of a step of number i in its better direction.
  double GainOf(int i) const { return 2.0 * std::abs(this->Gradient[i]) - this->S(i, i); }
  double StepOf(int i) const { return this->Gradient[i] > 0.0 ? -1.0 : 1.0; }

  Move BestOfOne() const
  {
    Move best;
    for (int i = 0; i < this->Y.size(); ++i)
    {
      if (this->GainOf(i) > best.Gain)
      {
        best = { this->GainOf(i), i, -1, this->StepOf(i), 0.0 };
      }
    }
    return best;
  }

  Move BestOfTwo() const
  {
    Move best;
    for (int i = 0; i < this->Y.size(); ++i)
    {
      for (int j = 0; j < i; ++j)
      {
        this->TryPair(i, j, best);
      }
    }
    return best;
  }

  /// Steps in the same and in opposite directions.
  void TryPair(int i, int j, Move& best) const
  {
    const double diagonal = this->S(i, i) + this->S(j, j);
    for (const double sign : { 1.0, -1.0 })
    {
      const double slope = this->Gradient[i] + sign * this->Gradient[j];
      const double gain = 2.0 * std::abs(slope) - diagonal - 2.0 * sign * this->S(i, j);
      if (gain > best.Gain)
      {
        const double step = slope > 0.0 ? -1.0 : 1.0;
        best = { gain, i, j, step, sign * step };
      }
    }
  }

  void Step(int i, double step)
  {
    this->Y[i] += step;
    this->Gradient += step * this->S.col(i);
  }

  const Eigen::MatrixXd& S;
  Vector<double>& Y;
  Vector<double> Gradient; ///< half of the energy's
  const double SmallestGain = 1e-9;
};

}

Vector<double> ClosestIntegers(
  const Eigen::MatrixXd& S, const Eigen::MatrixXd& inverse, const Vector<double>& x, const ExecutionContext& context)
{
  if (x.size() == 0)
  {
    return x;
  }
  Vector<double> y = ConditionalRounding(inverse, x).Round(context);
  UnitMoves(S, x, y).Run(context);
  return y;
}

Eigen::MatrixXd InverseOf(const Eigen::MatrixXd& S, const ExecutionContext& context)
{
  constexpr Eigen::Index Block = 32;
  const Eigen::LLT<Eigen::MatrixXd> factor(S);
  Eigen::MatrixXd inverse = Eigen::MatrixXd::Identity(S.rows(), S.cols());
  for (Eigen::Index first = 0; first < S.cols(); first += Block)
  {
    context.Checkpoint(static_cast<double>(first) / static_cast<double>(S.cols()));
    auto columns = inverse.middleCols(first, std::min(Block, S.cols() - first));
    factor.solveInPlace(columns);
  }
  return inverse;
}

}
