#include "Levels/OperatorsFromOtherSide.h"

#include <utility>

namespace dmg
{
namespace
{

/// Changes the entries of rows that are turned. \param size of the blocks: an element has so many rows and columns.
/// \return which elements of the columns have entries there: those that are turned, too.
template <class Scalar, class Change>
std::vector<char> ChangeRows(
  SparseMatrix<Scalar>& matrix, const std::vector<char>& isTurned, int size, const Change& change)
{
  std::vector<char> columns(matrix.cols() / size, 0);
  for (int row = 0; row < matrix.outerSize(); ++row)
  {
    for (typename SparseMatrix<Scalar>::InnerIterator entry(matrix, row); isTurned[row / size] && entry; ++entry)
    {
      columns[entry.col() / size] = 1;
      entry.valueRef() = change(entry.valueRef(), row % size == entry.col() % size);
    }
  }
  return columns;
}

}

ProlongationOperators SeenFromOtherSide(ProlongationOperators&& operators, const std::vector<char>& isTurned)
{
  if (!isTurned.empty())
  {
    const auto conjugate = [](Complex z, bool) { return std::conj(z); };
    for (auto* const transports : { &operators.SP, &operators.Linear })
    {
      std::vector<char> rows = isTurned;
      for (TransportOperator& transport : *transports)
      {
        rows = ChangeRows(transport, rows, 1, conjugate);
      }
    }
    std::vector<char> rows = isTurned;
    for (SparseMatrix<double>& prolongation : operators.SX)
    {
      rows =
        ChangeRows(prolongation, rows, 2, [](double number, bool isOnAxis) { return isOnAxis ? number : -number; });
    }
  }
  return std::move(operators);
}

}
