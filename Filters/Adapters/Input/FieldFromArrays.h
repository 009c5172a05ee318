#ifndef dmgFieldFromArrays_h
#define dmgFieldFromArrays_h

#include "Adapters/Pipeline/FilterOutputs.h"
#include "Adapters/Pipeline/PropertyRanges.h"
#include "Adapters/Surface/PolygonsFromDataSet.h"
#include "Adapters/View/ChosenArrays.h"
#include "Adapters/View/SurfaceView.h"
#include "Drawing/DirectionsOnFaces.h"
#include "Mesh/VertexConnection.h"
#include "Support/ExecutionContext.h"

#include "vtkDataSet.h"
#include "vtkInformationVector.h"

class vtkAlgorithm;
class vtkInformation;

namespace dmg
{

/// A surface with a field of N directions that stands in its arrays.
struct SurfaceWithField
{
  SurfaceView& View; ///< borrowed
  DirectionsOnFaces Field;
  double Diagonal; ///< of the box around the triangles
  bool IsAtPoints; ///< whether it shows a power field at points
};

/// The meaning of cells without a direction.
enum class GapsInField
{
  AreSurface,
  AreHoles
};

/// The field that was chosen with SetInputArrayToProcess, index 0; where nothing was chosen, the first of these that
/// is there: the cell array Direction0, the point array Direction0, the active vectors of cells, those of points. Where
/// cells and points have an array Direction0, both names mean that of the cells. Where cells have an array
/// SingularityIndex, the field is one at points, too (ReadFieldAtPoints).
///
/// \param gaps whether cells without a direction, as of masked data, are parts of the surface or holes in it: \p view hides them then, but for one that
///   is alone, which has the direction of a cell beside it (FillLoneCells).
/// \param view becomes the surface that the filter before has prepared (PreparationOf). \param N of the field; 0: that of NumberOfDirections.
/// Vectors that are not finite, as where nothing was measured, are no directions; one warning counts them.
/// \throw WrongChoice as ChooseVectors; vectors of 2 numbers on a surface that is not in a plane of constant z; no direction on
/// any triangle.
/// \throw InvalidInput what MeshFromDataSet refuses; arrays Direction0, Direction1, ... of cells that are not
/// 2 pi / N apart. Cost: linear.
SurfaceWithField ReadField(vtkAlgorithm* algorithm, SurfaceView& view, int N, const ExecutionContext& context,
  GapsInField gaps = GapsInField::AreSurface);

/// A power field at points, where its singularities are found.
struct FieldAtVertices
{
  VertexConnection Connection;
  Vector<Complex> First; ///< direction of each vertex
};

/// \pre \p given IsAtPoints.
FieldAtVertices ReadFieldAtPoints(const SurfaceWithField& given, const ExecutionContext& context);

/// The vectors of an array, one for each face of the mesh; of points, the mean over the corners.
/// \param otherwise the Axis: the vector of all faces where no array is chosen.
/// \throw InvalidInput as FindArray and SuspectedFillValues, of which the algorithm warns; a vector is not finite; \p otherwise is zero where it is taken.
Points ReferenceVectors(
  vtkAlgorithm* algorithm, const ChosenArray& choice, const SurfaceView& view, const Vector3& otherwise);

/// RequestData of a filter that draws a field: reads it and calls draw(field, context), unless the input is empty or
/// this is no piece to work on. Outputs are empty before. Errors go to the algorithm, and leave its outputs empty.
/// \param N the filter's Number Of Directions, from 0 to 8; \p properties() is the table of the others.
/// \return what RequestData returns.
template <class Properties, class Draw>
int DrawField(vtkAlgorithm* algorithm, vtkInformation* request, vtkInformationVector** inputs,
  vtkInformationVector* outputs, int N, const Properties& properties, const Draw& draw,
  GapsInField gaps = GapsInField::AreSurface)
{
  return MakeOutputs(algorithm, request, inputs, outputs,
    [&](vtkInformationVector** whole, const ExecutionContext& context)
    {
      CheckRanges({ { "Number Of Directions", N, 0, DirectionsOnFaces::LargestN } });
      properties().Check();
      SurfaceView view(SurfaceOf(whole[0]));
      const SurfaceWithField field = ReadField(algorithm, view, N, PartOfContext(context, 0.0, 0.3), gaps);
      draw(field, PartOfContext(context, 0.3, 1.0));
    });
}

}

#endif
