#ifndef dmgDistanceToArrays_h
#define dmgDistanceToArrays_h

#include "Adapters/View/SurfaceView.h"
#include "Geodesics/SurfaceDistance.h"
#include "Support/ExecutionContext.h"

#include <utility>
#include <vector>

class vtkPolyData;
class vtkTable;

namespace dmg
{

/// A SurfaceDistance as arrays and datasets. Lengths are in the unit of the points times a scale.
class DistanceOutput
{
public:
  /// Borrows distance and view.
  DistanceOutput(const SurfaceDistance& distance, double scale, const SurfaceView& view, PartOfContext context)
    : Distance(distance)
    , Scale(scale)
    , View(view)
    , Context(std::move(context))
  {
  }

  /// Adds Distance, NearestSource and DirectionFromSource, and what field data tell of them, to the output of the view.
  void AddArrays() const;

  /// Makes lines of the distances or, where there are none, of a number of levels, evenly spaced between the least and the largest one.
  /// \param lines an empty output.
  /// \throw InvalidInput as SurfaceDistance::OffsetLines.
  void MakeOffsetLines(std::vector<double> distances, int levels, vtkPolyData* lines) const;

  /// Makes shortest paths to all targets, and a table with a row for each of them.
  /// \param paths, table empty outputs.
  void MakePaths(const std::vector<Vector3>& targets, vtkPolyData* paths, vtkTable* table) const;

private:
  const SurfaceDistance& Distance;
  const double Scale;
  const SurfaceView& View;
  const PartOfContext Context;
};

}

#endif
