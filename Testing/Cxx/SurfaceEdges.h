#ifndef dmgSurfaceEdges_h
#define dmgSurfaceEdges_h

#include "TestTools.h"

#include "vtkIdList.h"

#include <algorithm>
#include <map>
#include <utility>

namespace dmg::test
{

using Edge = std::pair<vtkIdType, vtkIdType>; // smaller point first

/// The edges in the documented order, with their numbers.
inline std::map<Edge, int> EdgesOf(vtkPolyData* surface)
{
  std::map<Edge, int> edges;
  vtkNew<vtkIdList> ids;
  for (vtkIdType cell = 0; cell < surface->GetNumberOfCells(); ++cell)
  {
    surface->GetCellPoints(cell, ids);
    for (int k = 0; k < 3; ++k)
    {
      edges[std::minmax({ ids->GetId(k), ids->GetId((k + 1) % 3) })] = 0;
    }
  }
  int number = 0;
  for (auto& edge : edges)
  {
    edge.second = number++;
  }
  return edges;
}

inline Vector3 Along(vtkPolyData* surface, const Edge& edge)
{
  return Vector3(surface->GetPoint(edge.second)) - Vector3(surface->GetPoint(edge.first));
}

}

#endif
