#ifndef dmgPartGraph_h
#define dmgPartGraph_h

#include "Support/Permutations.h"

#include <algorithm>
#include <vector>

namespace dmg
{

/// Which parts of a computation touch items in common, and so must not run at the same time.
struct PartGraph
{
  std::vector<int> Begins = { 0 }; ///< the place of the first neighbour of each part, and their number
  std::vector<int> Neighbours;     ///< of each part, ascending, without itself

  int Size() const { return static_cast<int>(this->Begins.size()) - 1; }
  const int* Begin(int part) const { return this->Neighbours.data() + this->Begins[part]; }
  const int* End(int part) const { return this->Neighbours.data() + this->Begins[part + 1]; }
};

/// \param forItems(part, visit) calls visit(item) for all items of a part; several times does no harm.
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
  std::vector<int> metBy(numberOfParts, -1);              // the last part that has met it
  std::vector<std::vector<int>> neighbours(numberOfParts); // the earlier ones first
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

/// \param order where part k of the result stands in the graph.
inline PartGraph Permuted(const PartGraph& graph, const std::vector<int>& order)
{
  const std::vector<int> places = Inverse(order);
  PartGraph permuted;
  for (const int part : order)
  {
    const auto begin = permuted.Neighbours.insert(
      permuted.Neighbours.end(), graph.Begin(part), graph.End(part));
    std::for_each(begin, permuted.Neighbours.end(), [&places](int& other) { other = places[other]; });
    std::sort(begin, permuted.Neighbours.end());
    permuted.Begins.push_back(static_cast<int>(permuted.Neighbours.size()));
  }
  return permuted;
}

/// Gives each part of a range the first colour that no earlier neighbour in the range has.
/// \param colours of all parts; those of the range are set.
inline void ColourGreedily(
  const PartGraph& graph, int firstPart, int lastPart, std::vector<int>& colours)
{
  std::vector<int> forbiddenBy(lastPart - firstPart + 1, -1); // by colour: the last part that must not have it
  for (int part = firstPart; part < lastPart; ++part)
  {
    const int* const end = std::lower_bound(graph.Begin(part), graph.End(part), part);
    for (const int* other = std::lower_bound(graph.Begin(part), end, firstPart); other != end; ++other)
    {
      forbiddenBy[colours[*other]] = part;
    }
    colours[part] = static_cast<int>(std::find_if(forbiddenBy.begin(), forbiddenBy.end(),
                                       [part](int by) { return by != part; }) -
      forbiddenBy.begin());
  }
}

}

#endif
