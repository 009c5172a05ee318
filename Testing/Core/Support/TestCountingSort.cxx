#include "Support/CountingSort.h"

#include "Support/Permutations.h"
#include "Support/Random.h"
#include "Support/TbbContext.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>

using namespace dmg;

TEST(CountingSort, SortsAsStableSortDoesForAnyNumberOfThreads)
{
  test::Random random(2801);
  for (const int size : { 0, 1, 50, 9000, 60000 })
  {
    constexpr int numberOfKeys = 37;
    std::vector<int> keys(size);
    for (int& key : keys)
    {
      key = random.Index(numberOfKeys - 2) + 1; // the first and the last key have no items
    }
    std::vector<int> items = Identity(size);
    std::reverse(items.begin(), items.end());
    std::vector<int> expected = items;
    std::stable_sort(expected.begin(), expected.end(), [&keys](int a, int b) { return keys[a] < keys[b]; });
    for (const int threads : { 1, 2, 5 })
    {
      const SortedItems sorted = SortByKey(
        items, numberOfKeys, [&keys](int item) { return keys[item]; }, test::TbbContext(threads));
      EXPECT_EQ(sorted.Items, expected);
      ASSERT_EQ(sorted.Begins.size(), numberOfKeys + 1u);
      EXPECT_EQ(sorted.Begins.back(), size);
      for (int key = 0; key < numberOfKeys; ++key)
      {
        const auto first = std::find_if(expected.begin(), expected.end(), [&](int item) { return keys[item] >= key; });
        EXPECT_EQ(sorted.Begins[key], first - expected.begin());
      }
    }
  }
}

TEST(CountingSort, SortsByPairsForAnyNumberOfThreads)
{
  test::Random random(2802);
  for (const int size : { 0, 1, 50, 60000 })
  {
    const int numberOfKeys = size / 5 + 3;
    std::vector<std::pair<int, int>> keys(size);
    for (auto& [first, second] : keys)
    {
      first = random.Index(numberOfKeys - 2) + 1; // the first and the last key have no items
      second = random.Index(5) - 2;               // any number, some of them twice
    }
    std::vector<int> expected = Identity(size);
    std::stable_sort(expected.begin(), expected.end(), [&keys](int a, int b) { return keys[a] < keys[b]; });
    for (const int threads : { 1, 2, 5 })
    {
      const ItemsByPair sorted = SortByPair(
        size, numberOfKeys, [&keys](int item) { return keys[item]; }, test::TbbContext(threads));
      ASSERT_EQ(sorted.Items.size(), expected.size());
      ASSERT_EQ(sorted.Begins.size(), numberOfKeys + 1u);
      EXPECT_EQ(sorted.Begins.front(), 0);
      EXPECT_EQ(sorted.Begins.back(), size);
      for (int key = 0; key < numberOfKeys; ++key)
      {
        for (int k = sorted.Begins[key]; k < sorted.Begins[key + 1]; ++k)
        {
          EXPECT_EQ(sorted.Items[k].Item, expected[k]);
          EXPECT_EQ(keys[expected[k]], std::make_pair(key, sorted.Items[k].Second));
        }
      }
    }
  }
}

TEST(CountingSort, ChoosesInOrder)
{
  const test::TbbContext context(3);
  for (const int size : { 0, 5, 8192, 30000 })
  {
    std::vector<int> multiples;
    for (int number = 0; number < size; number += 7)
    {
      multiples.push_back(number);
    }
    EXPECT_EQ(Choose(
                size, [](int number) { return number % 7 == 0; }, context),
      multiples);
  }
}

TEST(Permutations, InverseIsTheSameForAnyNumberOfThreads)
{
  constexpr int size = 50021; // prime
  std::vector<int> permutation(size);
  for (int i = 0; i < size; ++i)
  {
    permutation[i] = static_cast<int>(123LL * i % size);
  }
  const std::vector<int> inverse = Inverse(permutation, test::TbbContext(3));
  for (int i = 0; i < size; ++i)
  {
    EXPECT_EQ(inverse[permutation[i]], i);
  }
}
