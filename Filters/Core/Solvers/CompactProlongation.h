#ifndef dmgCompactProlongation_h
#define dmgCompactProlongation_h

#include "Solvers/PlanarProlongation.h"
#include "Support/ExecutionContext.h"
#include "Support/Packs.h"
#include "Support/SparseRows.h"
#include "Support/Types.h"

#include <cstdint>
#include <vector>

namespace dmg
{

/// A planar prolongation, or one of complex numbers, in a quarter of the memory that it and its adjoint
/// take in single precision. Both products read the same entries: six bytes each, a number among the
/// coarse unknowns of a tile of rows, and two components in units of the row, of 16 bits each. Rounding is
/// 2^-16 of the largest component of the row; what rounds to nothing is left out.
///
/// The rows of a tile stand by their lengths, and four that follow each other, a slice, are taken at once:
/// entry k of all four, then entry k + 1 (sliced ELLPACK; Monakov et al. 2010). Short rows of a slice end
/// in zeros.
///
/// Rows and columns should come in a spatial order, so that a tile has few coarse unknowns.
class CompactProlongation
{
public:
  static constexpr int RowsOfSlice = 4;

  CompactProlongation() = default;
  /// \param restriction the adjoint of the prolongation, columns ascending.
  /// \throw InvalidInput a row of the prolongation has more than 65,536 entries.
  CompactProlongation(const RowBands<Plane>& restriction, const ExecutionContext& context);

  /// Rounds a prolongation so that packing loses no more.
  static void Round(SparseMatrix<Complex>& P, const ExecutionContext& context);

  int Rows() const { return this->NumberOfRows; }
  /// Plane vectors.
  int Columns() const { return static_cast<int>(this->SlotBegins.size()) - 1; }
  long long NonZeros() const { return this->NumberOfEntries; }

  /// x += P z.
  /// \param z components, two per column.
  void AddProduct(const Vector<double>& z, Vector<double>& x, const ExecutionContext& context) const;
  /// The same with P as a complex matrix.
  void AddProduct(
    const Vector<Complex>& z, Vector<Plane>& x, const ExecutionContext& context) const;

  /// How many numbers MultiplyAdjoint needs room for.
  int SizeOfSums() const { return 2 * static_cast<int>(this->ColumnsOfTiles.size()); }

  /// z = P^T x.
  /// \param sums room for the sums of the tiles.
  void MultiplyAdjoint(const Vector<double>& x, Vector<double>& z, Vector<double>& sums,
    const ExecutionContext& context) const;
  /// z = P^H x with P as a complex matrix.
  void MultiplyAdjoint(const Vector<Plane>& x, Vector<Complex>& z, Vector<float>& sums,
    const ExecutionContext& context) const;

  /// Some rows, as they are after rounding.
  SparseMatrix<Plane> SelectedRows(
    const std::vector<int>& rows, const ExecutionContext& context) const;

  /// Rows as they are after rounding, for one thread. A tile is unpacked when one of its rows is asked for.
  class Reader
  {
  public:
    /// \param prolongation borrowed.
    explicit Reader(const CompactProlongation& prolongation)
      : P(prolongation)
      , Places(prolongation.NumberOfTiles(), -1)
    {
    }

    /// Columns ascend. Valid until Clear.
    RowOfBand<Plane> Row(int row);
    /// \param columns consecutive.
    /// \param restriction on exit so many rows of the adjoint.
    void AdjointRows(int firstColumn, int lastColumn, SparseRows<Plane>& restriction);
    /// Forgets what was unpacked.
    void Clear();

  private:
    const SparseRows<Plane>& TileAt(int tile);

    const CompactProlongation& P;
    std::vector<int> Places;                 ///< of tiles among the unpacked, -1 elsewhere
    std::vector<SparseRows<Plane>> Unpacked; ///< and, after these, room for more
    std::vector<int> Tiles;                  ///< that are unpacked
  };

  /// Held by this object.
  long long Bytes() const;

private:
  class Packing;

  /// An entry of each of four rows.
  struct Step
  {
    std::uint16_t Columns[4];   ///< among those of the tile
    std::int16_t Components[8]; ///< X and Y of each
  };

  template <class Slice, class Row>
  void AddProductBySlices(const double* z, Vector<Row>& x, const ExecutionContext& context) const;
  template <class Factors, class Row>
  void MultiplyAdjointBySlices(const Vector<Row>& x, double* z,
    Vector<typename Factors::Sum>& sums, const ExecutionContext& context) const;

  int NumberOfTiles() const { return static_cast<int>(this->ColumnBegins.size()) - 1; }
  int FirstRow(int tile) const { return tile * this->RowsOfTile; }
  int LastRow(int tile) const;
  int FirstSlice(int tile) const { return tile * ((this->RowsOfTile + 3) / 4); }
  int LastSlice(int tile) const;

  int NumberOfRows = 0;
  int RowsOfTile = 1;
  long long NumberOfEntries = 0;
  std::vector<int> ColumnBegins = { 0 }; ///< the first of each tile among ColumnsOfTiles
  std::vector<int> ColumnsOfTiles;
  std::vector<int> SlotBegins = { 0 };   ///< by column, among Slots
  std::vector<int> Slots;                ///< where a column stands among ColumnsOfTiles
  std::vector<int> StepBegins = { 0 };   ///< the first of each slice
  std::vector<Step> Steps;
  std::vector<std::uint16_t> RowsAt;     ///< of a tile, four to a slice; RowsOfTile where it has fewer
  std::vector<float> Units;              ///< as RowsAt
};

}

#endif
