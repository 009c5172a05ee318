#include "StructurePreserving/Transfers/ScalarProlongation.h"

#include "Support/SparseAssembly.h"

namespace dmg
{

SparseMatrix<double> ScalarProlongation(const LevelTransition& transition, const ExecutionContext& context)
{
  return AssembleMatrix<double>(transition.Fine.NumberOfVertices(), transition.Coarse.NumberOfVertices(), context,
    [&](int vertex, RowEntries<double>& row)
    {
      if (transition.Tracking.IsCorner(vertex))
      {
        row.emplace_back(transition.CoarseVertex[vertex], 1.0);
        return;
      }
      const SurfacePlace place = transition.Tracking.PlaceOf(vertex);
      const int face = transition.CoarseFace[place.Face];
      for (int k = 0; k < 3; ++k)
      {
        if (place.Weights[k] > 0.0)
        {
          row.emplace_back(transition.Coarse.FaceCorners()(face, k), place.Weights[k]);
        }
      }
    });
}

}
