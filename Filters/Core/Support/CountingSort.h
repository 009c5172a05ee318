#ifndef dmgCountingSort_h
#define dmgCountingSort_h

#include "Support/ExecutionContext.h"
#include "Support/Permutations.h"
#include "Support/Unfilled.h"

#include <algorithm>
#include <utility>
#include <vector>

namespace dmg
{

/// Items sorted by keys: those of key k are [Begins[k], Begins[k + 1]).
struct SortedItems
{
  std::vector<int> Items;
  std::vector<int> Begins;
};

/// Sorts items by key(item) in [0, numberOfKeys), keeping the order of equal ones.
/// Cost: linear. Each thread counts all keys, so there should be fewer of them than items.
template <class Key>
SortedItems SortByKey(const std::vector<int>& items, int numberOfKeys, const Key& key, const ExecutionContext& context)
{
  constexpr int SmallestBand = 8192;
  const int size = static_cast<int>(items.size());
  // Each band's part of a key follows that of the band before it, so their number does not matter.
  const int bands = std::clamp(size / SmallestBand, 1, context.NumberOfThreads());
  const auto bandBegin = [size, bands](int band)
  { return static_cast<int>(static_cast<long long>(size) * band / bands); };
  const auto forEach = [&](const auto& visit)
  {
    context.ParallelFor(0, bands, 1,
      [&](int first, int last)
      {
        for (int band = first; band < last; ++band)
        {
          for (int k = bandBegin(band); k < bandBegin(band + 1); ++k)
          {
            visit(band, items[k]);
          }
        }
      });
  };
  std::vector<std::vector<int>> places(bands, std::vector<int>(numberOfKeys, 0));
  forEach([&](int band, int item) { ++places[band][key(item)]; });

  SortedItems sorted;
  sorted.Begins.resize(numberOfKeys + 1);
  int next = 0;
  for (int k = 0; k < numberOfKeys; ++k)
  {
    sorted.Begins[k] = next;
    for (std::vector<int>& place : places)
    {
      next += std::exchange(place[k], next);
    }
  }
  sorted.Begins[numberOfKeys] = next;
  sorted.Items.resize(size);
  forEach([&](int band, int item) { sorted.Items[places[band][key(item)]++] = item; });
  return sorted;
}

/// An item under the second of two keys.
struct ItemOfPair
{
  int Second;
  int Item;

  bool operator<(const ItemOfPair& other) const
  {
    return this->Second != other.Second ? this->Second < other.Second : this->Item < other.Item;
  }
};

/// Items sorted by two keys: those of first key k are [Begins[k], Begins[k + 1]).
struct ItemsByPair
{
  Unfilled<ItemOfPair> Items;
  std::vector<int> Begins;
};

/// Sorts the numbers below \p size by keys(number), a pair, the first in [0, numberOfKeys), and then by themselves.
/// Cost: linear where few have the same first key.
template <class Keys>
ItemsByPair SortByPair(int size, int numberOfKeys, const Keys& keys, const ExecutionContext& context)
{
  constexpr int Grain = 4096;
  SortedItems byFirst = SortByKey(
    Identity(size), numberOfKeys, [&keys](int item) { return keys(item).first; }, context);
  ItemsByPair sorted{ Unfilled<ItemOfPair>(size), std::move(byFirst.Begins) };
  context.ParallelFor(0, numberOfKeys, Grain,
    [&](int firstKey, int lastKey)
    {
      for (int key = firstKey; key < lastKey; ++key)
      {
        const int begin = sorted.Begins[key];
        const int end = sorted.Begins[key + 1];
        for (int k = begin; k < end; ++k)
        {
          sorted.Items[k] = { keys(byFirst.Items[k]).second, byFirst.Items[k] };
        }
        std::sort(sorted.Items.begin() + begin, sorted.Items.begin() + end);
      }
    });
  return sorted;
}

/// The numbers below \p size with isChosen(number), ascending.
template <class IsChosen>
std::vector<int> Choose(int size, const IsChosen& isChosen, const ExecutionContext& context)
{
  constexpr int BlockSize = 8192;
  std::vector<std::vector<int>> chosen((size + BlockSize - 1) / BlockSize);
  context.ParallelFor(0, static_cast<int>(chosen.size()), 1,
    [&](int first, int last)
    {
      for (int block = first; block < last; ++block)
      {
        const int end = std::min((block + 1) * BlockSize, size);
        for (int number = block * BlockSize; number < end; ++number)
        {
          if (isChosen(number))
          {
            chosen[block].push_back(number);
          }
        }
      }
    });
  std::vector<int> all;
  for (const std::vector<int>& part : chosen)
  {
    all.insert(all.end(), part.begin(), part.end());
  }
  return all;
}

}

#endif
