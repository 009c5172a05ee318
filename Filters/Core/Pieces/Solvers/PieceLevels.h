#ifndef dmgPieceLevels_h
#define dmgPieceLevels_h

#include "Pieces/Surface/PieceOfSurface.h"
#include "Support/ExecutionContext.h"
#include "Support/Types.h"

#include <utility>
#include <vector>

namespace dmg
{

/// The rows that a rank has of a matrix over all ranks. Rows, and columns as far as they are owned, are numbered from rank to rank.
template <class Scalar>
struct RowsOfRank
{
  SparseMatrix<Scalar> Rows;            ///< columns are numbers of this rank
  std::vector<long long> GlobalColumns; ///< per column the number over all ranks
  int OwnedColumns = 0;                 ///< columns that this rank owns

  RowsOfRank() = default;
  /// Eigen 3.4 would copy the rows.
  RowsOfRank(RowsOfRank&& other) noexcept { *this = std::move(other); }
  RowsOfRank& operator=(RowsOfRank&& other) noexcept
  {
    this->Rows.swap(other.Rows);
    std::swap(this->GlobalColumns, other.GlobalColumns);
    std::swap(this->OwnedColumns, other.OwnedColumns);
    return *this;
  }
};

/// Levels of samples of a surface in pieces: each rank samples the vertices that it owns, and interpolates between its samples
/// and those of others beside them. No sample of another rank's vertices depends on this rank's.
/// Collective. \param distance between samples of the first level; see SampledLevels.
/// \return the prolongations of directions, finest first. There are none where all ranks have few vertices together.
/// Messages: one exchange of 40 bytes per ghost point and level.
std::vector<RowsOfRank<Complex>> LevelsOfPieces(
  const PieceOfSurface& piece, double distance, const ExecutionContext& context);

}

#endif
