#ifndef dmgPartColouring_h
#define dmgPartColouring_h

#include "Solvers/Kernels/PartGraph.h"
#include "Support/SparseKernels.h"

#include <algorithm>
#include <vector>

namespace dmg
{

/// Parts of a computation that may run at the same time if they touch no item in common: colours, whose
/// parts share none. Taken colour by colour, sums come in an order that does not depend on threads.
struct PartColouring
{
  std::vector<int> Parts;  ///< colour by colour, ascending
  std::vector<int> Begins; ///< the place of the first of each colour in Parts, and their number

  int NumberOfColours() const { return static_cast<int>(this->Begins.size()) - 1; }
};

/// Gives each part the first colour that no earlier part on one of its items has.
/// \param forItems see GraphOfParts.
template <class ForItems>
PartColouring ColourParts(int numberOfParts, int numberOfItems, const ForItems& forItems)
{
  std::vector<int> colours(numberOfParts);
  ColourGreedily(GraphOfParts(numberOfParts, numberOfItems, forItems), 0, numberOfParts, colours);

  PartColouring colouring;
  const int numberOfColours =
    numberOfParts > 0 ? *std::max_element(colours.begin(), colours.end()) + 1 : 0;
  colouring.Begins.assign(numberOfColours + 1, 0);
  for (const int colour : colours)
  {
    ++colouring.Begins[colour + 1];
  }
  OffsetsFromCounts(colouring.Begins);
  std::vector<int> next = colouring.Begins;
  colouring.Parts.resize(numberOfParts);
  for (int part = 0; part < numberOfParts; ++part)
  {
    colouring.Parts[next[colours[part]]++] = part;
  }
  return colouring;
}

}

#endif
