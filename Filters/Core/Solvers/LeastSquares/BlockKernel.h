#ifndef dmgBlockKernel_h
#define dmgBlockKernel_h

#include "Solvers/Kernels/Packs.h"
#include "Solvers/LeastSquares/BlockGroups.h"

/// The kernel of a BlockSmoother for the blocks in the lanes of a pack, float or FloatPack: it reads and writes their
/// places in vectors, and multiplies by their inverses.
namespace dmg
{

/// y = A x for a symmetric matrix in each lane, its lower triangle by rows.
/// \param ahead a matrix that will be needed soon.
template <class Pack>
inline void MultiplySymmetric(const float* triangle, int size, const Pack* x, Pack* y, const float* ahead)
{
  constexpr int lanes = LanesOf<Pack>;
  for (int i = 0; i < size; ++i)
  {
    const int begin = i * (i + 1) / 2;
    const float* const row = triangle + begin * lanes;
    Prefetch(ahead + begin * lanes, (i + 1) * lanes);
    Pack sum = LoadPack<Pack>(row + i * lanes) * x[i];
    for (int j = 0; j < i; ++j)
    {
      const Pack entry = LoadPack<Pack>(row + j * lanes);
      sum += entry * x[j];
      y[j] += entry * x[i];
    }
    y[i] = sum;
  }
}

/// The same where lanes are of no use, but rows are long.
inline void MultiplySymmetric(const float* triangle, int size, const float* x, float* y, const float*)
{
  constexpr int lanes = LanesOf<FloatPack>;
  for (int i = 0; i < size; ++i, ++triangle)
  {
    FloatPack sums{};
    const FloatPack factors = FloatPack{} + x[i];
    int j = 0;
    for (; j + lanes <= i; j += lanes, triangle += lanes)
    {
      const FloatPack entries = LoadPack<FloatPack>(triangle);
      sums += entries * LoadPack<FloatPack>(x + j);
      StorePack(LoadPack<FloatPack>(y + j) + entries * factors, y + j);
    }
    float sum = SumOfLanes(sums);
    for (; j < i; ++j, ++triangle)
    {
      sum += *triangle * x[j];
      y[j] += *triangle * x[i];
    }
    y[i] = sum + *triangle * x[i];
  }
}

/// Places of unknowns and rows of B in vectors: anywhere.
template <class Pack>
class PlacesAnywhere
{
public:
  PlacesAnywhere(const BlockPattern& pattern, const int* places)
    : Unknowns(places)
    , Rows(places + pattern.Unknowns() * Lanes)
    , NumberOfPlaces((pattern.Unknowns() + pattern.Rows()) * Lanes)
  {
  }
  int Size() const { return this->NumberOfPlaces; }

  Pack UnknownOf(const float* x, int i) const { return GatherPack<Pack>(x, this->Unknowns + i * Lanes); }
  void SetUnknown(Pack pack, float* x, int i) const { ScatterPack<Pack>(pack, x, this->Unknowns + i * Lanes); }
  Pack RowOf(const float* Bx, int k) const { return GatherPack<Pack>(Bx, this->Rows + k * Lanes); }
  void SetRow(Pack pack, float* Bx, int k) const { ScatterPack<Pack>(pack, Bx, this->Rows + k * Lanes); }

private:
  static constexpr int Lanes = LanesOf<Pack>;
  const int* const Unknowns;
  const int* const Rows;
  const int NumberOfPlaces;
};

/// The lanes of unknowns and of inner rows side by side.
class PlacesInOrder
{
public:
  PlacesInOrder(const BlockPattern& pattern, const int* rows, int firstPlace)
    : Of(pattern)
    , FirstPlace(firstPlace)
    , Rows(rows)
  {
  }
  int Size() const { return this->Of.InnerRows + (this->Of.Rows() - this->Of.InnerRows) * Lanes; }

  FloatPack UnknownOf(const float* x, int i) const { return LoadPack<FloatPack>(x + this->FirstPlace + i * Lanes); }
  void SetUnknown(FloatPack pack, float* x, int i) const { StorePack(pack, x + this->FirstPlace + i * Lanes); }
  FloatPack RowOf(const float* Bx, int k) const
  {
    return k < this->Of.InnerRows ? LoadPack<FloatPack>(Bx + this->Rows[k])
                                  : GatherPack<FloatPack>(Bx, this->OuterRow(k));
  }
  void SetRow(FloatPack pack, float* Bx, int k) const
  {
    k < this->Of.InnerRows ? StorePack(pack, Bx + this->Rows[k]) : ScatterPack<FloatPack>(pack, Bx, this->OuterRow(k));
  }

private:
  static constexpr int Lanes = LanesOf<FloatPack>;
  const int* OuterRow(int k) const { return this->Rows + this->Of.InnerRows + (k - this->Of.InnerRows) * Lanes; }

  const BlockPattern& Of;
  const int FirstPlace;
  const int* const Rows; ///< of inner ones the first lane's
};

}

#endif
