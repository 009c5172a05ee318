#include "Adapters/Output/CurvaturesToArrays.h"

#include "Adapters/Surface/ElementArrays.h"

#include "vtkCellData.h"
#include "vtkPointData.h"

namespace dmg
{

namespace
{

template <class Arrays>
void AddTo(const Arrays& arrays, const TangentFrames& frames, const PrincipalCurvatures& curvatures)
{
  const auto turned = [&](Complex turn)
  {
    Points vectors(frames.X.rows(), 3);
    for (int element = 0; element < vectors.rows(); ++element)
    {
      vectors.row(element) = frames.ToVector(element, turn * curvatures.MaximumDirections[element]).transpose();
    }
    return vectors;
  };
  arrays.Add(ArrayNames::MaximumDirection, 3, turned(1.0).data());
  arrays.Add(ArrayNames::MinimumDirection, 3, turned(Complex(0.0, 1.0)).data());
  arrays.Add(ArrayNames::MaximumCurvature, 1, curvatures.Maximum.data());
  arrays.Add(ArrayNames::MinimumCurvature, 1, curvatures.Minimum.data());
  arrays.Add(ArrayNames::Confidence, 1, curvatures.Confidence.data());
}

}

void AddCurvatures(const FramedSurface& surface, const PrincipalDirections& curvatures, vtkPolyData* input,
  vtkPolyData* output, const ExecutionContext& context)
{
  AddTo(ArraysOfCells(surface.Numbering, input, output->GetCellData(), context), surface.On.Faces, curvatures.Faces);
  context.Checkpoint(0.5);
  AddTo(ArraysOfPoints(surface.Numbering, input, output->GetPointData(), context), surface.On.Vertices,
    curvatures.Vertices);
  context.Checkpoint(1.0);
}

}
