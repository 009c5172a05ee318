#include "Support/SparseRows.h"

namespace dmg
{

void SortIndices(int* indices, int size)
{
  constexpr int few = 24;
  if (size > few)
  {
    std::sort(indices, indices + size);
    return;
  }
  for (int next = 1; next < size; ++next)
  {
    const int index = indices[next];
    int place = next;
    for (; place > 0 && indices[place - 1] > index; --place)
    {
      indices[place] = indices[place - 1];
    }
    indices[place] = index;
  }
}

}
