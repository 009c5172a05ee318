#ifndef dmgPartColouring_h
#define dmgPartColouring_h

#include "Support/ExecutionContext.h"
#include "Support/SparseKernels.h"

#include <algorithm>
#include <vector>

namespace dmg
{

/// The pairs of parts of a computation that touch items in common, and so must not run at the same time.
struct PartGraph
{
  std::vector<int> Begins = { 0 }; ///< the place of the first neighbour of each part, and their number
  std::vector<int> Neighbours;     ///< of each part, ascending, without itself

  int Size() const { return static_cast<int>(this->Begins.size()) - 1; }
  const int* Begin(int part) const { return this->Neighbours.data() + this->Begins[part]; }
  const int* End(int part) const { return this->Neighbours.data() + this->Begins[part + 1]; }
};

/// \param forItems forItems(part, visit) calls visit(item) for all items of a part; several times does no harm.
/// Cost: linear in the visits, but for items of many parts.
template <class ForItems>
PartGraph GraphOfParts(int numberOfParts, int numberOfItems, const ForItems& forItems)
{
  // Items keep their parts as linked lists, the last one first.
  struct Touch
  {
    int Part;
    int Next;
  };
  std::vector<Touch> touches;
  std::vector<int> lastTouch(numberOfItems, -1);
  std::vector<int> metBy(numberOfParts, -1);               // the last part that has met it
  std::vector<std::vector<int>> neighbours(numberOfParts); // the earlier ones first
  for (int part = 0; part < numberOfParts; ++part)
  {
    forItems(part,
      [&](int item)
      {
        int& last = lastTouch[item];
        if (last >= 0 && touches[last].Part == part)
        {
          return;
        }
        for (int touch = last; touch >= 0; touch = touches[touch].Next)
        {
          const int other = touches[touch].Part;
          if (metBy[other] != part)
          {
            metBy[other] = part;
            neighbours[part].push_back(other);
          }
        }
        touches.push_back({ part, last });
        last = static_cast<int>(touches.size()) - 1;
      });
    std::sort(neighbours[part].begin(), neighbours[part].end());
    for (const int earlier : neighbours[part])
    {
      neighbours[earlier].push_back(part);
    }
  }

  PartGraph graph;
  for (const std::vector<int>& ofPart : neighbours)
  {
    graph.Neighbours.insert(graph.Neighbours.end(), ofPart.begin(), ofPart.end());
    graph.Begins.push_back(static_cast<int>(graph.Neighbours.size()));
  }
  return graph;
}

/// Colours of parts: those of a colour are no neighbours, and may run at the same time. Taken colour by colour,
/// sums come in an order that does not depend on threads.
struct PartColouring
{
  std::vector<int> Parts;  ///< colour by colour, ascending
  std::vector<int> Begins; ///< the place of the first of each colour in Parts, and their number
};

/// Gives each part the first colour that no earlier neighbour has.
inline PartColouring ColourParts(const PartGraph& graph)
{
  const int size = graph.Size();
  std::vector<int> colours(size);
  std::vector<int> forbiddenBy(size + 1, -1); // by colour: the last part that must not have it
  for (int part = 0; part < size; ++part)
  {
    std::for_each(graph.Begin(part), std::lower_bound(graph.Begin(part), graph.End(part), part),
      [&](int earlier) { forbiddenBy[colours[earlier]] = part; });
    colours[part] =
      static_cast<int>(std::find_if(forbiddenBy.begin(), forbiddenBy.end(), [part](int by) { return by != part; }) -
        forbiddenBy.begin());
  }

  PartColouring colouring;
  const int numberOfColours = size > 0 ? *std::max_element(colours.begin(), colours.end()) + 1 : 0;
  colouring.Begins.assign(numberOfColours + 1, 0);
  for (const int colour : colours)
  {
    ++colouring.Begins[colour + 1];
  }
  OffsetsFromCounts(colouring.Begins);
  std::vector<int> next = colouring.Begins;
  colouring.Parts.resize(size);
  for (int part = 0; part < size; ++part)
  {
    colouring.Parts[next[colours[part]]++] = part;
  }
  return colouring;
}

/// The same for parts on items in common; see GraphOfParts.
template <class ForItems>
PartColouring ColourParts(int numberOfParts, int numberOfItems, const ForItems& forItems)
{
  return ColourParts(GraphOfParts(numberOfParts, numberOfItems, forItems));
}

/// Calls visit(part) for parts that stand colour by colour; those of a colour at the same time.
/// \param begins the first part of each colour, and their number.
/// \param descending from the last colour to the first.
template <class Visit>
void ForColours(const std::vector<int>& begins, bool descending, const ExecutionContext& context, const Visit& visit)
{
  const int colours = static_cast<int>(begins.size()) - 1;
  for (int k = 0; k < colours; ++k)
  {
    const int colour = descending ? colours - 1 - k : k;
    context.ParallelFor(begins[colour], begins[colour + 1], 1,
      [&visit](int first, int last)
      {
        for (int part = first; part < last; ++part)
        {
          visit(part);
        }
      });
  }
}

}

#endif
