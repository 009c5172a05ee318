#include "Support/SparseRows.h"

namespace dmg
{

void SortIndices(std::vector<int>& indices)
{
  if (indices.size() > 24)
  {
    std::sort(indices.begin(), indices.end());
    return;
  }
  for (std::size_t next = 1; next < indices.size(); ++next)
  {
    const int index = indices[next];
    std::size_t place = next;
    for (; place > 0 && indices[place - 1] > index; --place)
    {
      indices[place] = indices[place - 1];
    }
    indices[place] = index;
  }
}

}
