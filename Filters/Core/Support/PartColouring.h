#ifndef dmgPartColouring_h
#define dmgPartColouring_h

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
/// \param forItems(part, visit) calls visit(item) for all items of a part; several times does no harm.
/// Cost: linear in the visits, but for items of many parts.
template <class ForItems>
PartColouring ColourParts(int numberOfParts, int numberOfItems, const ForItems& forItems)
{
  // Items keep their parts as linked lists, the last one first.
  struct Touch
  {
    int Part;
    int Next;
  };
  std::vector<Touch> touches;
  std::vector<int> lastTouch(numberOfItems, -1);
  std::vector<int> colours(numberOfParts, 0);
  std::vector<int> forbiddenBy(numberOfParts, -1); // by colour: the last part that must not have it
  for (int part = 0; part < numberOfParts; ++part)
  {
    forItems(part, [&](int item) {
      int& last = lastTouch[item];
      if (last >= 0 && touches[last].Part == part)
      {
        return;
      }
      for (int touch = last; touch >= 0; touch = touches[touch].Next)
      {
        forbiddenBy[colours[touches[touch].Part]] = part;
      }
      touches.push_back({ part, last });
      last = static_cast<int>(touches.size()) - 1;
    });
    while (forbiddenBy[colours[part]] == part)
    {
      ++colours[part];
    }
  }

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
