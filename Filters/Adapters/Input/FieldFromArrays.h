#ifndef dmgFieldFromArrays_h
#define dmgFieldFromArrays_h

#include "Adapters/Pipeline/FilterOutputs.h"
#include "Adapters/Pipeline/PropertyRanges.h"
#include "Adapters/Surface/PolygonsFromDataSet.h"
#include "Adapters/Surface/PreparedDataSet.h"
#include "Adapters/View/ChosenArrays.h"
#include "Drawing/DirectionsOnFaces.h"
#include "Mesh/VertexConnection.h"
#include "Support/ExecutionContext.h"

#include "vtkDataSet.h"
#include "vtkInformationVector.h"
#include "vtkSmartPointer.h"

#include <initializer_list>
#include <memory>

class vtkAlgorithm;
class vtkInformation;

namespace dmg
{

/// A surface with a field of N directions that stands in its arrays.
struct SurfaceWithField
{
  vtkSmartPointer<vtkDataSet> Data; ///< that the surface comes from
  std::shared_ptr<const PreparedDataSet> Surface;
  DirectionsOnFaces Field;
  double Diagonal; ///< of the box around the triangles
  bool IsAtPoints; ///< whether it shows a power field at points
};

/// The field that was chosen with SetInputArrayToProcess, index 0; where nothing was chosen, the first of these that
/// is there: the cell array Direction0, the point array Direction0, the active vectors of cells, those of points. Where
/// cells and points have an array Direction0, both names mean that of the cells. Where cells have an array
/// SingularityIndex, the field is one at points, too (ReadFieldAtPoints).
///
/// \param N of the field; 0: that of NumberOfDirections.
/// Vectors that are not finite, as where nothing was measured, are no directions; one warning counts them.
/// \throw WrongChoice as ChooseVectors; vectors of 2 numbers on a surface that is not in a plane of constant z; no direction on
/// any triangle.
/// \throw InvalidInput what MeshFromDataSet refuses; arrays Direction0, Direction1, ... of cells that are not
/// 2 pi / N apart. Cost: linear.
SurfaceWithField ReadField(vtkAlgorithm* algorithm, vtkDataSet* surface, int N, const ExecutionContext& context);

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
/// \throw InvalidInput as FindArray; a vector is not finite; \p otherwise is zero where it is taken.
Points ReferenceVectors(
  const ChosenArray& choice, vtkDataSet* surface, const PreparedDataSet& on, const Vector3& otherwise);

/// RequestData of a filter that draws a field: reads it and calls draw(field, context), unless the input is empty or
/// this is no piece to work on. Outputs are empty before. Errors go to the algorithm, and leave its outputs empty.
/// \param N the filter's Number Of Directions, from 0 to 8; \p others are the rest of its numbers.
/// \return what RequestData returns.
template <class Draw>
int DrawField(vtkAlgorithm* algorithm, vtkInformation* request, vtkInformationVector** inputs,
  vtkInformationVector* outputs, int N, std::initializer_list<PropertyRange> others, const Draw& draw)
{
  return MakeOutputs(algorithm, request, inputs, outputs,
    [&](vtkInformationVector** whole, const ExecutionContext& context)
    {
      CheckRanges({ { "Number Of Directions", N, 0, DirectionsOnFaces::LargestN } });
      CheckRanges(others);
      const SurfaceWithField field = ReadField(algorithm, SurfaceOf(whole[0]), N, PartOfContext(context, 0.0, 0.3));
      draw(field, PartOfContext(context, 0.3, 1.0));
    });
}

}

#endif
