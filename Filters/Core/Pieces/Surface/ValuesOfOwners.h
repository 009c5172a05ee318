#ifndef dmgValuesOfOwners_h
#define dmgValuesOfOwners_h

#include "Pieces/Surface/Ranks.h"

#include <vector>

namespace dmg
{

/// An element of a surface in pieces: where it is owned, and its number there.
struct PlaceOnRank
{
  int Rank;
  int Number;

  friend bool operator<(const PlaceOnRank& a, const PlaceOnRank& b)
  {
    return a.Rank != b.Rank ? a.Rank < b.Rank : a.Number < b.Number;
  }
  friend bool operator==(const PlaceOnRank& a, const PlaceOnRank& b)
  {
    return a.Rank == b.Rank && a.Number == b.Number;
  }
};

/// Brings what owners know of their elements to the ranks that need it. Who needs what is found once.
class ValuesOfOwners
{
public:
  /// Collective. \param places of the elements that this rank needs values of; some may be its own.
  ValuesOfOwners(const Ranks& ranks, const std::vector<PlaceOnRank>& places)
    : All(ranks)
  {
    std::vector<std::vector<int>> wanted(ranks.Size());
    std::vector<int> counts(ranks.Size(), 0);
    for (const auto& [rank, number] : places)
    {
      wanted[rank].push_back(number);
    }
    int begin = 0;
    for (int rank = 0; rank < ranks.Size(); ++rank)
    {
      counts[rank] = begin;
      begin += static_cast<int>(wanted[rank].size());
    }
    for (const auto& place : places)
    {
      this->Order.push_back(counts[place.Rank]++);
    }
    this->Wanted = ranks.Exchange(wanted);
  }

  /// Collective. \param valueOf a function of the number of an own element.
  /// \return one value per place.
  template <class Value, class ValueOf>
  std::vector<Value> Fetch(const ValueOf& valueOf) const
  {
    std::vector<std::vector<Value>> values(this->All.Size());
    for (int rank = 0; rank < this->All.Size(); ++rank)
    {
      for (int k = this->Wanted.Begins[rank]; k < this->Wanted.Begins[rank + 1]; ++k)
      {
        values[rank].push_back(valueOf(this->Wanted.Items[k]));
      }
    }
    const Received<Value> received = this->All.Exchange(values);
    std::vector<Value> inOrder;
    inOrder.reserve(this->Order.size());
    for (const int place : this->Order)
    {
      inOrder.push_back(received.Items[place]);
    }
    return inOrder;
  }

  /// Collective. \param appendOf (number of an own element, list) appends any number of values.
  /// \return a list per place.
  template <class Value, class AppendOf>
  std::vector<std::vector<Value>> FetchLists(const AppendOf& appendOf) const
  {
    std::vector<std::vector<Value>> values(this->All.Size());
    std::vector<std::vector<int>> sizes(this->All.Size());
    for (int rank = 0; rank < this->All.Size(); ++rank)
    {
      for (int k = this->Wanted.Begins[rank]; k < this->Wanted.Begins[rank + 1]; ++k)
      {
        const std::size_t former = values[rank].size();
        appendOf(this->Wanted.Items[k], values[rank]);
        sizes[rank].push_back(static_cast<int>(values[rank].size() - former));
      }
    }
    const Received<int> receivedSizes = this->All.Exchange(sizes);
    const Received<Value> received = this->All.Exchange(values);
    std::vector<std::vector<Value>> lists;
    auto next = received.Items.begin();
    for (const int size : receivedSizes.Items)
    {
      lists.emplace_back(next, next + size);
      next += size;
    }
    std::vector<std::vector<Value>> inOrder;
    for (const int place : this->Order)
    {
      inOrder.push_back(lists[place]);
    }
    return inOrder;
  }

private:
  const Ranks& All;
  std::vector<int> Order; ///< of each place in what comes back
  Received<int> Wanted;   ///< numbers of own elements
};

}

#endif
