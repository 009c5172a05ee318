#ifndef dmgSweepOrder_h
#define dmgSweepOrder_h

#include "Support/Types.h"

#include <vector>

namespace dmg
{

/// The unknowns of a symmetric matrix in the order in which Gauss-Seidel takes them, part by part.
///
/// Parts are colours, no two unknowns of which are coupled: threads share each. Or they are tiles of unknowns
/// near each other, which have colours themselves: threads share the tiles of each.
struct SweepOrder
{
  std::vector<int> Unknowns;       ///< a permutation
  std::vector<int> Begins;         ///< where each part begins; one more than parts
  std::vector<int> ColoursOfTiles; ///< the first tile of each colour, and their number; none for colours
};

/// Greedy colours: each unknown, in ascending order, takes the smallest colour free among its neighbours.
/// Within a colour, unknowns are sorted by the numbers of their neighbours of earlier and of later colours, so that the lengths of
/// loops over their rows repeat; then ascending.
template <class Scalar>
SweepOrder Colouring(const SparseMatrix<Scalar>& A);

/// Tiles of unknowns that follow each other in A, by greedy colours of the tiles. Tiles begin with even unknowns.
/// \pre unknowns come in a spatial order.
template <class Scalar>
SweepOrder Tiling(const SparseMatrix<Scalar>& A);

/// Colours where rows are short; tiles where they are long and colours would be too small to share, as on coarse
/// levels of vectors.
template <class Scalar>
SweepOrder OrderForSweeps(const SparseMatrix<Scalar>& A);

/// One colour only, the order of the matrix: what a smoother without colours needs.
SweepOrder SingleColour(int size);

}

#endif
