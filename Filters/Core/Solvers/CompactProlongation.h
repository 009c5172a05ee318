#ifndef dmgCompactProlongation_h
#define dmgCompactProlongation_h

#include "Solvers/PlanarProlongation.h"
#include "Support/ExecutionContext.h"
#include "Support/Types.h"

#include <cstdint>
#include <vector>

namespace dmg
{

/// A planar prolongation in a quarter of the memory that it and its adjoint take in single precision. Both
/// products read the same entries: six bytes each, a number among the coarse unknowns of a tile of rows,
/// and two components in units of the row, of 16 bits each. Rounding is 2^-16 of the largest component
/// of the row.
///
/// Rows and columns should come in a spatial order, so that a tile has few coarse unknowns.
class CompactProlongation
{
public:
  CompactProlongation() = default;
  /// \pre no row has more than 65,535 entries.
  CompactProlongation(const SparseMatrix<Plane>& P, const ExecutionContext& context);

  int Rows() const { return static_cast<int>(this->Units.size()); }
  /// Plane vectors.
  int Columns() const { return static_cast<int>(this->SlotBegins.size()) - 1; }
  long long NonZeros() const { return static_cast<long long>(this->Entries.size()); }

  /// x += P z.
  /// \param z components, two per column.
  void AddProduct(const Vector<double>& z, Vector<double>& x, const ExecutionContext& context) const;

  /// How many numbers MultiplyAdjoint needs room for.
  int SizeOfSums() const { return 2 * static_cast<int>(this->ColumnsOfTiles.size()); }

  /// z = P^T x.
  /// \param sums room for the sums of the tiles.
  void MultiplyAdjoint(const Vector<double>& x, Vector<double>& z, Vector<double>& sums,
    const ExecutionContext& context) const;

  /// Some rows, as they are after rounding.
  SparseMatrix<Plane> SelectedRows(
    const std::vector<int>& rows, const ExecutionContext& context) const;
  /// All rows.
  SparseMatrix<Plane> Rounded(const ExecutionContext& context) const;

  /// Held by this object.
  long long Bytes() const;

private:
  struct Entry
  {
    std::uint16_t Column; ///< among those of the tile
    std::int16_t X;
    std::int16_t Y;
  };

  int NumberOfTiles() const { return static_cast<int>(this->TileBegins.size()) - 1; }
  void FillTile(int tile, const SparseMatrix<Plane>& P, std::vector<int>& places);

  std::vector<int> TileBegins;    ///< the first row of each
  std::vector<int> ColumnBegins;  ///< the first of each tile among ColumnsOfTiles
  std::vector<int> ColumnsOfTiles;
  std::vector<int> RowBegins;     ///< among Entries
  std::vector<float> Units;       ///< by row
  std::vector<Entry> Entries;
  std::vector<int> SlotBegins;    ///< by column, among Slots
  std::vector<int> Slots;         ///< where a column stands among ColumnsOfTiles
};

}

#endif
