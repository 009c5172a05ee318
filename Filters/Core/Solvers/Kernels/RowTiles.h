#ifndef dmgRowTiles_h
#define dmgRowTiles_h

#include "Solvers/Kernels/PartColouring.h"
#include "Support/ExecutionContext.h"
#include "Support/Types.h"

#include <algorithm>

namespace dmg
{

/// Tiles of consecutive rows of a sparse matrix, coloured so that tiles of a colour share no column. A^T x is summed colour by
/// colour, hence deterministically. Few colours are needed where rows have columns in common with rows near them alone.
class RowTiles
{
public:
  static constexpr int RowsOfTile = 4096;

  RowTiles() = default;
  explicit RowTiles(const SparseMatrix<double>& A)
    : Rows(static_cast<int>(A.rows()))
    , Colouring(ColourParts((this->Rows + RowsOfTile - 1) / RowsOfTile, static_cast<int>(A.cols()),
        [&](int tile, const auto& visit)
        {
          const int last = std::min((tile + 1) * RowsOfTile, this->Rows);
          const int* const offsets = A.outerIndexPtr();
          std::for_each(A.innerIndexPtr() + offsets[tile * RowsOfTile], A.innerIndexPtr() + offsets[last], visit);
        }))
  {
  }

  int Size() const { return static_cast<int>(this->Colouring.Parts.size()); }

  /// Calls visit(tile, firstRow, lastRow), at the same time for tiles that share no column.
  template <class Visit>
  void ForTiles(const ExecutionContext& context, const Visit& visit) const
  {
    ForColours(this->Colouring.Begins, false, context,
      [this, &visit](int t)
      {
        const int tile = this->Colouring.Parts[t];
        visit(tile, tile * RowsOfTile, std::min((tile + 1) * RowsOfTile, this->Rows));
      });
  }

private:
  int Rows = 0;
  PartColouring Colouring;
};

}

#endif
