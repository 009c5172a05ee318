#include "StructurePreserving/Overlay/OverlayProlongation.h"

#include "StructurePreserving/Overlay/LocalProlongation.h"
#include "Support/Errors.h"
#include "Support/SparseAssembly.h"

#include <Eigen/QR>

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

namespace dmg
{

namespace
{

template <class Scalar>
using Row = std::vector<std::pair<int, Scalar>>; // columns and entries

/// The product of all local operators, formed from the coarse end: the rows of what is left of the
/// mesh, in terms of the coarse unknowns. Each collapse that is taken back replaces the rows of its
/// one-ring by combinations of the rows that were there, so that no matrix is ever multiplied.
template <class Scalar>
class BackwardProduct
{
public:
  BackwardProduct(int slots, int columns)
    : Rows(slots)
    , Columns(columns)
  {
  }

  Row<Scalar>& operator[](int slot) { return this->Rows[slot]; }
  const Row<Scalar>& operator[](int slot) const { return this->Rows[slot]; }
  int NumberOfColumns() const { return this->Columns; }

  void Undo(const std::vector<LocalRow<Scalar>>& local)
  {
    std::vector<Row<Scalar>> before(local.size());
    for (std::size_t i = 0; i < local.size(); ++i)
    {
      before[i] = this->Combination(local[i].Entries);
    }
    for (std::size_t i = 0; i < local.size(); ++i)
    {
      this->Rows[local[i].Before] = std::move(before[i]);
    }
  }

  /// The sum of multiples of rows, given by {slot, factor}.
  template <class Terms>
  Row<Scalar> Combination(const Terms& terms) const
  {
    Row<Scalar> products;
    for (const auto& [slot, factor] : terms)
    {
      for (const auto& [column, entry] : this->Rows[slot])
      {
        products.emplace_back(column, factor * entry);
      }
    }
    std::sort(products.begin(), products.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    Row<Scalar> sum;
    for (const auto& [column, product] : products)
    {
      if (sum.empty() || sum.back().first != column)
      {
        sum.emplace_back(column, Scalar(0));
      }
      sum.back().second += product;
    }
    return sum;
  }

private:
  std::vector<Row<Scalar>> Rows; // by slot
  int Columns;
};

/// Calls visit(local) for all collapses, the last one first.
template <class Visit>
void VisitBackwards(const LevelTransition& transition, const ExecutionContext& context, Visit visit)
{
  constexpr int CollapsesPerCheckpoint = 64;
  constexpr int CollapsesPerPiece = 4;
  if (!transition.Collapses)
  {
    throw InvalidInput("the hierarchy did not record its collapses; build it with the construction "
                       "by exact overlay");
  }
  const std::vector<CollapseRecord>& collapses = *transition.Collapses;
  for (int end = static_cast<int>(collapses.size()); end > 0;)
  {
    const int begin = std::max(0, end - CollapsesPerCheckpoint);
    std::vector<std::unique_ptr<LocalProlongation>> locals(end - begin);
    context.ParallelFor(begin, end, CollapsesPerPiece,
      [&](int first, int last)
      {
        for (int i = first; i < last; ++i)
        {
          locals[i - begin] = std::make_unique<LocalProlongation>(collapses[i]);
        }
      });
    for (int i = end; i-- > begin;)
    {
      visit(*locals[i - begin]);
    }
    end = begin;
    context.Checkpoint(1.0 - static_cast<double>(end) / collapses.size());
  }
}

/// Calls visit(slot, element) for the slots that the coarse mesh has as elements.
template <class Visit>
void VisitCoarse(const std::vector<int>& coarseElement, Visit visit)
{
  for (std::size_t slot = 0; slot < coarseElement.size(); ++slot)
  {
    if (coarseElement[slot] >= 0)
    {
      visit(static_cast<int>(slot), coarseElement[slot]);
    }
  }
}

BackwardProduct<double> UnitZeroForms(const LevelTransition& transition)
{
  BackwardProduct<double> product(transition.Fine.NumberOfVertices(), transition.Coarse.NumberOfVertices());
  VisitCoarse(transition.CoarseVertex, [&](int slot, int vertex) { product[slot] = { { vertex, 1.0 } }; });
  return product;
}

/// Values along coarse halfedges in terms of the 1-form.
BackwardProduct<double> HalfedgesOfOneForms(const LevelTransition& transition)
{
  const TriangleMesh& coarse = transition.Coarse;
  BackwardProduct<double> product(3 * transition.Fine.NumberOfFaces(), coarse.NumberOfEdges());
  VisitCoarse(transition.CoarseFace,
    [&](int slot, int face)
    {
      for (int k = 0; k < 3; ++k)
      {
        const int h = 3 * face + k;
        product[3 * slot + k] = { { coarse.EdgeOf(h), static_cast<double>(coarse.EdgeSign(h)) } };
      }
    });
  return product;
}

/// The sides of a face in its frame, one per row: P of the thesis, section 3.3.
Eigen::Matrix<double, 3, 2> SidesInFrame(const TriangleMesh& mesh, const TangentFrames& frames, int face)
{
  Eigen::Matrix<double, 3, 2> sides;
  for (int k = 0; k < 3; ++k)
  {
    const int h = 3 * face + k;
    const Complex side = frames.ToComplex(face, mesh.Position(mesh.Head(h)) - mesh.Position(mesh.Tail(h)));
    sides.row(k) << side.real(), side.imag();
  }
  return sides;
}

/// P_coarse: values along coarse halfedges in terms of the face field.
BackwardProduct<double> HalfedgesOfFaceFields(const LevelTransition& transition, const TangentFrames& coarseFrames)
{
  BackwardProduct<double> product(3 * transition.Fine.NumberOfFaces(), 2 * transition.Coarse.NumberOfFaces());
  VisitCoarse(transition.CoarseFace,
    [&](int slot, int face)
    {
      const Eigen::Matrix<double, 3, 2> sides = SidesInFrame(transition.Coarse, coarseFrames, face);
      for (int k = 0; k < 3; ++k)
      {
        product[3 * slot + k] = { { 2 * face, sides(k, 0) }, { 2 * face + 1, sides(k, 1) } };
      }
    });
  return product;
}

/// z -> z^N for unit z.
Complex UnitPower(Complex z, int N)
{
  Complex power = 1.0;
  for (int n = 0; n < N; ++n)
  {
    power *= z;
  }
  return power;
}

/// Powers in the frames of local operators, whose X is the first side, in terms of those in the
/// coarse frames.
BackwardProduct<Complex> PowersFromCoarseFrames(
  const LevelTransition& transition, const TangentFrames& coarseFrames, int N)
{
  BackwardProduct<Complex> product(transition.Fine.NumberOfFaces(), transition.Coarse.NumberOfFaces());
  VisitCoarse(transition.CoarseFace,
    [&](int slot, int face)
    {
      const Complex firstSide = SideDirections(transition.Coarse, coarseFrames, face)[0];
      product[slot] = { { face, UnitPower(std::conj(firstSide), N) } };
    });
  return product;
}

std::vector<LocalRow<Complex>> OnPowers(std::vector<LocalRow<Complex>> local, int N)
{
  for (LocalRow<Complex>& row : local)
  {
    for (auto& [after, entry] : row.Entries)
    {
      const double weight = std::abs(entry);
      entry = weight * UnitPower(entry / weight, N);
    }
  }
  return local;
}

SparseMatrix<double> FineVertices(
  const BackwardProduct<double>& product, const LevelTransition& transition, const ExecutionContext& context)
{
  return AssembleMatrix<double>(transition.Fine.NumberOfVertices(), product.NumberOfColumns(), context,
    [&](int vertex, Row<double>& row) { row = product[vertex]; });
}

SparseMatrix<double> FineEdges(
  const BackwardProduct<double>& product, const LevelTransition& transition, const ExecutionContext& context)
{
  const TriangleMesh& fine = transition.Fine;
  return AssembleMatrix<double>(fine.NumberOfEdges(), product.NumberOfColumns(), context,
    [&](int edge, Row<double>& row)
    {
      const int h = fine.HalfedgeOf(edge);
      row = product[h];
      for (auto& [column, entry] : row)
      {
        entry *= fine.EdgeSign(h);
      }
    });
}

/// The field of each fine face from the values along its halfedges, by P_fine^+.
SparseMatrix<double> FineFaceFields(const BackwardProduct<double>& product, const LevelTransition& transition,
  const TangentFrames& fineFrames, const ExecutionContext& context)
{
  const TriangleMesh& fine = transition.Fine;
  return AssembleMatrix<double>(2 * fine.NumberOfFaces(), product.NumberOfColumns(), context,
    [&](int i, Row<double>& row)
    {
      const int face = i / 2;
      const Eigen::Matrix<double, 2, 3> inverse =
        SidesInFrame(fine, fineFrames, face).completeOrthogonalDecomposition().pseudoInverse();
      std::array<std::pair<int, double>, 3> terms;
      for (int k = 0; k < 3; ++k)
      {
        terms[k] = { 3 * face + k, inverse(i % 2, k) };
      }
      row = product.Combination(terms);
    });
}

SparseMatrix<Complex> FinePowers(const BackwardProduct<Complex>& product, const LevelTransition& transition,
  const TangentFrames& fineFrames, int N, const ExecutionContext& context)
{
  return AssembleMatrix<Complex>(transition.Fine.NumberOfFaces(), product.NumberOfColumns(), context,
    [&](int face, Row<Complex>& row)
    {
      row = product[face];
      const Complex firstSide = SideDirections(transition.Fine, fineFrames, face)[0];
      for (auto& [column, entry] : row)
      {
        entry *= UnitPower(firstSide, N);
      }
    });
}

/// Weights of one product and turns of another, with the same non-zeros.
TransportOperator WithTurns(const SparseMatrix<Complex>& weights, const SparseMatrix<Complex>& turns)
{
  TransportOperator result = turns;
  for (Eigen::Index i = 0; i < result.nonZeros(); ++i)
  {
    Complex& entry = result.valuePtr()[i];
    const double length = std::abs(entry);
    // Any rotation will do where all paths cancel.
    entry = weights.valuePtr()[i].real() * (length > 0.0 ? entry / length : Complex(1.0));
  }
  return result;
}

}

OverlayProlongation::OverlayProlongation(const LevelTransition& transition, const TangentFrames& fineFrames,
  const TangentFrames& coarseFrames, const ExecutionContext& context)
{
  BackwardProduct<double> zeroForms = UnitZeroForms(transition);
  BackwardProduct<double> oneForms = HalfedgesOfOneForms(transition);
  BackwardProduct<double> faceFields = HalfedgesOfFaceFields(transition, coarseFrames);
  BackwardProduct<Complex> weights = PowersFromCoarseFrames(transition, coarseFrames, 0);
  BackwardProduct<Complex> turns = PowersFromCoarseFrames(transition, coarseFrames, 1);
  VisitBackwards(transition, context,
    [&](const LocalProlongation& local)
    {
      zeroForms.Undo(local.Vertices);
      oneForms.Undo(local.Halfedges);
      faceFields.Undo(local.ZeroSumHalfedges);
      weights.Undo(OnPowers(local.Powers, 0));
      turns.Undo(local.Powers);
    });
  this->S0 = FineVertices(zeroForms, transition, context);
  context.Checkpoint(1.0);
  this->S1 = FineEdges(oneForms, transition, context);
  context.Checkpoint(1.0);
  this->SX = FineFaceFields(faceFields, transition, fineFrames, context);
  context.Checkpoint(1.0);
  this->SP = WithTurns(
    FinePowers(weights, transition, fineFrames, 0, context), FinePowers(turns, transition, fineFrames, 1, context));
}

}
