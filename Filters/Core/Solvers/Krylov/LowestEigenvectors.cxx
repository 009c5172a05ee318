#include "Solvers/Krylov/LowestEigenvectors.h"

#include "Solvers/Krylov/LowestOfBlock.h"
#include "Support/Hash.h"
#include "Support/Remedy.h"
#include "Support/SparseKernels.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <array>
#include <chrono>
#include <cmath>
#include <cstdint>
#include <iomanip>
#include <numeric>
#include <sstream>
#include <string>
#include <vector>

namespace dmg
{
namespace
{

constexpr int Trials = 3; // x, w and p
using Small = Eigen::Matrix<double, Trials, Trials>;

/// Inner products of the vectors x, w, p of one part: in A and in M.
struct Gram
{
  Small A = Small::Zero();
  Small M = Small::Zero();

  Gram& operator+=(const Gram& other)
  {
    this->A += other.A;
    this->M += other.M;
    return *this;
  }
};

/// The coefficients of x, w and p in the next x.
using Coefficients = Eigen::Vector3d;

/// The coefficients of least Rayleigh quotient. Vectors that depend on those before them are left out, and so are those
/// that are too short to change x: in a part that is solved, w is made of rounding errors and may be almost parallel to x.
Coefficients LeastRayleighQuotient(const Gram& gram)
{
  constexpr double SmallestAngle = 1e-12; // its squared sine
  constexpr double Shortest = 1e-26;      // its squared length over that of x
  Eigen::Vector3d scale;
  int size = 0;
  while (size < Trials && gram.M(size, size) > Shortest * gram.M(0, 0))
  {
    scale[size] = 1.0 / std::sqrt(gram.M(size, size));
    ++size;
  }
  for (; size > 1; --size)
  {
    const auto factors = scale.head(size).asDiagonal();
    const Eigen::MatrixXd M = factors * gram.M.topLeftCorner(size, size) * factors;
    const Eigen::MatrixXd A = factors * gram.A.topLeftCorner(size, size) * factors;
    if (M.selfadjointView<Eigen::Lower>().eigenvalues()[0] < SmallestAngle)
    {
      continue;
    }
    const Eigen::GeneralizedSelfAdjointEigenSolver<Eigen::MatrixXd> solver(A, M);
    if (solver.info() == Eigen::Success)
    {
      Coefficients coefficients = Coefficients::Zero();
      coefficients.head(size) = factors * solver.eigenvectors().col(0);
      return coefficients[0] < 0.0 ? Coefficients(-coefficients) : coefficients;
    }
  }
  return Coefficients::Unit(0);
}

/// The iteration, step by step. Vectors are zero outside the parts.
class LocallyOptimalIteration
{
public:
  LocallyOptimalIteration(const EigenProblem& problem, Vector<double>& x, const ExecutionContext& context)
    : Problem(problem)
    , Context(context)
    , x(x)
    , Pair(problem.UnknownsPerMass(x.size()))
    , Theta(problem.Parts.Begins.size() - 1)
  {
    this->MakePieces();
  }

  /// x^T M x = 1.
  void Start();
  /// theta, r = A x - theta M x, w = B r. \return the largest sqrt(r^T w / theta).
  double FindResidual();
  /// The residual of each part.
  const std::vector<double>& Residuals() const { return this->ResidualsOfParts; }
  /// The best combination of x, w and p becomes x.
  void Step();
  /// A x anew, free of the rounding errors of its recurrence.
  void Refresh() { this->Problem.A.Apply(this->x, this->Ax, this->Context); }

  const std::vector<double>& Eigenvalues() const { return this->Theta; }

private:
  /// A piece of a part, short enough to share the work between threads.
  struct Piece
  {
    int Part;
    int Begin;
    int End;
  };

  void MakePieces();
  double MassOf(int unknown) const { return this->Problem.Mass[unknown / this->Pair]; }
  template <class Visit>
  void ForEach(const Visit& visit) const;
  /// Sums for each part over its unknowns, in their order.
  template <class Sum, class Add>
  std::vector<Sum> SumsOfParts(const Sum& zero, const Add& add) const;
  void Normalise();

  const EigenProblem& Problem;
  const ExecutionContext& Context;
  Vector<double>& x;
  Vector<double> w, p, Ax, Aw, Ap, r;
  const int Pair; ///< unknowns that share a mass
  std::vector<double> Theta;
  std::vector<double> ResidualsOfParts; ///< residuals
  std::vector<Piece> Pieces;
};

void LocallyOptimalIteration::MakePieces()
{
  constexpr int Length = 4096;
  const std::vector<int>& begins = this->Problem.Parts.Begins;
  for (int part = 0; part + 1 < static_cast<int>(begins.size()); ++part)
  {
    for (int begin = begins[part]; begin < begins[part + 1]; begin += Length)
    {
      this->Pieces.push_back({ part, begin, std::min(begin + Length, begins[part + 1]) });
    }
  }
}

/// visit(part, unknown), at the same time for several.
template <class Visit>
void LocallyOptimalIteration::ForEach(const Visit& visit) const
{
  this->Context.ParallelFor(0, static_cast<int>(this->Pieces.size()), 2,
    [&](int first, int last)
    {
      for (int k = first; k < last; ++k)
      {
        for (int item = this->Pieces[k].Begin; item < this->Pieces[k].End; ++item)
        {
          visit(this->Pieces[k].Part, this->Problem.Parts.Items[item]);
        }
      }
    });
}

template <class Sum, class Add>
std::vector<Sum> LocallyOptimalIteration::SumsOfParts(const Sum& zero, const Add& add) const
{
  std::vector<Sum> ofPieces(this->Pieces.size(), zero);
  this->Context.ParallelFor(0, static_cast<int>(this->Pieces.size()), 2,
    [&](int first, int last)
    {
      for (int k = first; k < last; ++k)
      {
        Sum sum = zero;
        for (int item = this->Pieces[k].Begin; item < this->Pieces[k].End; ++item)
        {
          add(sum, this->Problem.Parts.Items[item]);
        }
        ofPieces[k] = sum;
      }
    });
  std::vector<Sum> sums(this->Theta.size(), zero);
  for (std::size_t k = 0; k < this->Pieces.size(); ++k)
  {
    sums[this->Pieces[k].Part] += ofPieces[k];
  }
  this->Problem.Sum(reinterpret_cast<double*>(sums.data()), sums.size() * sizeof(Sum) / sizeof(double));
  return sums;
}

void LocallyOptimalIteration::Normalise()
{
  const std::vector<double> squares =
    this->SumsOfParts(0.0, [this](double& sum, int i) { sum += this->MassOf(i) * this->x[i] * this->x[i]; });
  this->ForEach([&](int part, int i) { this->x[i] /= std::sqrt(squares[part]); });
}

void LocallyOptimalIteration::Start()
{
  const std::vector<double> squares =
    this->SumsOfParts(0.0, [this](double& sum, int i) { sum += this->MassOf(i) * this->x[i] * this->x[i]; });
  this->r.setZero(this->x.size());
  this->ForEach([&](int part, int i) { this->r[i] = squares[part] > 0.0 ? 0.0 : this->MassOf(i) * PseudoRandom(i); });
  // Rough parts of a random start would take several iterations to fade.
  this->Problem.Inverse.Apply(this->r, this->w, this->Context);
  this->ForEach([&](int part, int i) { this->x[i] = squares[part] > 0.0 ? this->x[i] : this->w[i]; });
  this->Normalise();
  this->Refresh();
  this->p.setZero(this->x.size());
  this->Ap.setZero(this->x.size());
}

double LocallyOptimalIteration::FindResidual()
{
  this->Theta = this->SumsOfParts(0.0, [this](double& sum, int i) { sum += this->x[i] * this->Ax[i]; });
  this->ForEach(
    [this](int part, int i) { this->r[i] = this->Ax[i] - this->Theta[part] * this->MassOf(i) * this->x[i]; });
  this->Problem.Inverse.Apply(this->r, this->w, this->Context);
  const std::vector<double> squares =
    this->SumsOfParts(0.0, [this](double& sum, int i) { sum += this->r[i] * this->w[i]; });
  this->ResidualsOfParts.assign(this->Theta.size(), 0.0);
  double largest = 0.0;
  for (std::size_t part = 0; part < this->Theta.size(); ++part)
  {
    largest = std::max(largest, squares[part] / this->Theta[part]);
    this->ResidualsOfParts[part] = std::sqrt(squares[part] / this->Theta[part]);
  }
  return std::sqrt(largest);
}

void LocallyOptimalIteration::Step()
{
  this->Problem.A.Apply(this->w, this->Aw, this->Context);
  const std::array<const Vector<double>*, Trials> vectors{ &this->x, &this->w, &this->p };
  const std::array<const Vector<double>*, Trials> images{ &this->Ax, &this->Aw, &this->Ap };
  const std::vector<Gram> grams = this->SumsOfParts(Gram(),
    [&](Gram& sum, int i)
    {
      for (int row = 0; row < Trials; ++row)
      {
        for (int column = 0; column <= row; ++column)
        {
          sum.A(row, column) += (*vectors[row])[i] * (*images[column])[i];
          sum.M(row, column) += (*vectors[row])[i] * this->MassOf(i) * (*vectors[column])[i];
        }
      }
    });
  std::vector<Coefficients> coefficients;
  coefficients.reserve(grams.size());
  for (const Gram& gram : grams)
  {
    Gram whole;
    whole.A = gram.A.selfadjointView<Eigen::Lower>();
    whole.M = gram.M.selfadjointView<Eigen::Lower>();
    coefficients.push_back(LeastRayleighQuotient(whole));
  }
  this->ForEach(
    [&](int part, int i)
    {
      const Coefficients& c = coefficients[part];
      this->p[i] = c[1] * this->w[i] + c[2] * this->p[i];
      this->Ap[i] = c[1] * this->Aw[i] + c[2] * this->Ap[i];
      this->x[i] = c[0] * this->x[i] + this->p[i];
      this->Ax[i] = c[0] * this->Ax[i] + this->Ap[i];
    });
}

/// Parts that are too slow by themselves are solved for once more, by blocks of vectors. \return the row of the report.
IterationReport SolveSlowParts(const LocallyOptimalIteration& iteration, const EigenProblem& problem,
  const StoppingCriteria& stop, Vector<double>& x, std::vector<double>& eigenvalues, bool& isConverged,
  const ExecutionContext& context)
{
  IterationReport row;
  row.RelativeResidual = 0.0;
  std::vector<int> slow;
  for (std::size_t part = 0; part < eigenvalues.size(); ++part)
  {
    const double residual = iteration.Residuals()[part];
    if (residual > stop.RelativeTolerance)
    {
      slow.push_back(static_cast<int>(part));
    }
    else
    {
      row.RelativeResidual = std::max(row.RelativeResidual, residual);
    }
  }
  isConverged = true;
  for (const LowestOfPart& part : FindLowestOfBlocks(problem, slow, stop, x, eigenvalues, context))
  {
    row.RelativeResidual = std::max(row.RelativeResidual, part.Residual);
    isConverged &= part.IsSolved;
  }
  row.Energy = std::accumulate(eigenvalues.begin(), eigenvalues.end(), 0.0);
  return row;
}

std::string WarningOfResidual(double residual, double tolerance)
{
  std::ostringstream text;
  text << std::setprecision(2) << "The smoothest field was found to a residual of " << residual << " instead of "
       << tolerance << ", as the limit of iterations is reached; raise " << TextOf(Remedy::Iterations) << ".";
  return text.str();
}

}

std::vector<double> FindLowestEigenvectors(const EigenProblem& problem, const StoppingCriteria& stop, Vector<double>& x,
  SolveReport& report, const ExecutionContext& context)
{
  using Clock = std::chrono::steady_clock;
  const auto start = Clock::now();
  const auto secondsSince = [start] { return std::chrono::duration<double>(Clock::now() - start).count(); };
  LocallyOptimalIteration iteration(problem, x, context);
  iteration.Start();
  report.Iterations.clear();
  report.Converged = false;
  for (int k = 0;; ++k)
  {
    IterationReport row;
    row.Iteration = k;
    row.RelativeResidual = iteration.FindResidual();
    row.Seconds = secondsSince();
    row.Energy = std::accumulate(iteration.Eigenvalues().begin(), iteration.Eigenvalues().end(), 0.0);
    report.Iterations.push_back(row);
    report.Converged = row.RelativeResidual <= stop.RelativeTolerance;
    context.Checkpoint(static_cast<double>(k) / stop.MaximumIterations);
    if (report.Converged || k == stop.MaximumIterations)
    {
      break;
    }
    iteration.Step();
  }
  std::vector<double> eigenvalues = iteration.Eigenvalues();
  constexpr int Patience = 100; // who allows fewer iterations wants to see them
  if (!report.Converged && stop.MaximumIterations >= Patience)
  {
    IterationReport row = SolveSlowParts(iteration, problem, stop, x, eigenvalues, report.Converged, context);
    row.Iteration = report.Iterations.back().Iteration + 1;
    row.Seconds = secondsSince();
    report.Iterations.push_back(row);
  }
  if (!report.Converged)
  {
    report.Warnings.push_back(WarningOfResidual(report.Iterations.back().RelativeResidual, stop.RelativeTolerance));
  }
  report.SolveSeconds = report.Iterations.back().Seconds;
  return eigenvalues;
}

}
