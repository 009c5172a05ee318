#include "Pieces/Solvers/PetscObjects.h"

#include "Pieces/Solvers/PetscSession.h"
#include "Support/Errors.h"

#include <algorithm>
#include <limits>
#include <type_traits>

namespace dmg
{

namespace
{

PetscInt Narrow(long long number)
{
  if (number > std::numeric_limits<PetscInt>::max())
  {
    throw InvalidInput("the surface has too many vertices for this PETSc, "
                       "whose indices have 32 bits; build "
                       "DirectionalMultigrid with one of 64-bit indices");
  }
  return static_cast<PetscInt>(number);
}

/// The same integers, as PETSc's. \param copy holds them where these are longer.
PetscInt* AsPetsc(int* integers, std::size_t size, std::vector<PetscInt>& copy)
{
  if constexpr (std::is_same_v<PetscInt, int>)
  {
    return integers;
  }
  else
  {
    copy.assign(integers, integers + size);
    return copy.data();
  }
}

}

PetscRows::PetscRows(const Ranks& ranks, RowsOfRank<Complex> rows)
{
  const int size = static_cast<int>(rows.Rows.rows());
  const int columns = rows.OwnedColumns;
  const long long firstColumn = ranks.SumBefore(static_cast<long long>(columns));
  PetscInt* offsets = nullptr;
  PetscInt* indices = nullptr;
  ranks.Together(
    [&]
    {
      this->Split(rows, firstColumn);
      offsets = AsPetsc(this->OwnColumns.outerIndexPtr(), static_cast<std::size_t>(size) + 1, this->Offsets);
      indices =
        AsPetsc(this->OwnColumns.innerIndexPtr(), static_cast<std::size_t>(this->OwnColumns.nonZeros()), this->Columns);
    });
  CheckPetsc(MatCreateMPIAIJWithSplitArrays(ranks.Communicator(), size, columns, PETSC_DETERMINE, PETSC_DETERMINE,
    offsets, indices, this->OwnColumns.valuePtr(), this->OtherOffsets.data(), this->OtherColumns.data(),
    this->OtherValues.data(), this->Matrix.Place()));
}

/// Moves the entries of own columns together, in place.
void PetscRows::Split(RowsOfRank<Complex>& rows, long long firstColumn)
{
  SparseMatrix<Complex>& matrix = rows.Rows;
  const int size = static_cast<int>(matrix.rows());
  int* const offsets = matrix.outerIndexPtr();
  int* const columns = matrix.innerIndexPtr();
  Complex* const values = matrix.valuePtr();
  this->OtherOffsets.assign(1, 0);
  std::vector<std::pair<PetscInt, Complex>> others;
  int next = 0;
  int begin = 0;
  for (int row = 0; row < size; ++row)
  {
    const int end = offsets[row + 1];
    others.clear();
    for (int k = begin; k < end; ++k)
    {
      const long long global = rows.GlobalColumns[columns[k]];
      if (global >= firstColumn && global < firstColumn + rows.OwnedColumns)
      {
        columns[next] = static_cast<int>(global - firstColumn);
        values[next++] = values[k];
      }
      else
      {
        others.emplace_back(Narrow(global), values[k]);
      }
    }
    std::sort(others.begin(), others.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
    for (const auto& [column, value] : others)
    {
      this->OtherColumns.push_back(column);
      this->OtherValues.push_back(value);
    }
    this->OtherOffsets.push_back(static_cast<PetscInt>(this->OtherColumns.size()));
    begin = end;
    offsets[row + 1] = next;
  }
  Narrow(firstColumn + rows.OwnedColumns);
  matrix.resizeNonZeros(next); // keeps the memory
  this->OwnColumns.swap(matrix);
}

}
