#include "Adapters/Output/CurvaturesToArrays.h"

#include "Adapters/Surface/ElementArrays.h"

namespace dmg
{

namespace
{

void AddDirection(
  const ArraysOfCells& cells, const std::string& name, const TangentFrames& frames, const Vector<Complex>& directions)
{
  cells.AddDirection(name, frames, directions, 2);
}

void AddDirection(
  const ArraysOfPoints& points, const std::string& name, const TangentFrames& frames, const Vector<Complex>& directions)
{
  points.AddVectors(name, frames, directions);
}

template <class Arrays>
void AddTo(const Arrays& arrays, const TangentFrames& frames, const PrincipalCurvatures& curvatures)
{
  AddDirection(arrays, ArrayNames::MaximumDirection, frames, curvatures.MaximumDirections);
  AddDirection(arrays, ArrayNames::MinimumDirection, frames, Complex(0.0, 1.0) * curvatures.MaximumDirections);
  arrays.Add(ArrayNames::MaximumCurvature, 1, curvatures.Maximum.data());
  arrays.Add(ArrayNames::MinimumCurvature, 1, curvatures.Minimum.data());
  arrays.Add(ArrayNames::Confidence, 1, curvatures.Confidence.data());
}

}

void AddCurvatures(const SurfaceView& view, const PrincipalDirections& curvatures, const ExecutionContext& context)
{
  AddTo(view.OfCells(context), view.Surface().Geometry.Faces, curvatures.Faces);
  context.Checkpoint(0.5);
  AddTo(view.OfPoints(context), view.Surface().Geometry.Vertices, curvatures.Vertices);
  context.Checkpoint(1.0);
}

}
