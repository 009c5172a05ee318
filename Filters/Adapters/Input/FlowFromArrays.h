#ifndef dmgFlowFromArrays_h
#define dmgFlowFromArrays_h

#include "Adapters/Input/EastAndNorth.h"
#include "Adapters/Surface/MeshFromDataSet.h"
#include "Flows/FittedDerivatives.h"
#include "Support/ExecutionContext.h"
#include "Support/Types.h"

#include "vtkSmartPointer.h"

#include <functional>
#include <string>
#include <vector>

class vtkAlgorithm;
class vtkDataArray;
class vtkDataSet;

namespace dmg
{

/// A flow by faces.
struct FaceFlow
{
  Vector<Complex> Tangential; ///< in the frames of the faces
  Vector<double> Normal;      ///< components along the normals; empty where there are none
  /// Its divergence and vorticity, from what was given.
  std::function<DerivativesAtVertices(const ExecutionContext&)> Derivatives;
};

/// The flow of a dataset that was chosen with SetInputArrayToProcess: vectors (index 0) or, where index 1 is chosen, eastward (1) and
/// northward components (2) about an axis through the origin. Of points, a face has the mean over its corners. At a point or cell on the
/// axis, which has no east, the flow is the mean of its neighbours.
class ChosenFlow
{
public:
  /// \param isMap the dataset is a map in longitudes and latitudes (FlatMap.h): vectors are eastward, northward and upward.
  /// \throw WrongChoice nothing is chosen.
  /// \throw InvalidInput as FindArray; the axis is zero where it is needed.
  ChosenFlow(vtkAlgorithm* algorithm, vtkDataSet* input, const Vector3& axis, bool isMap);

  /// Whether the surface lies around the origin, whatever its shape.
  bool IsOnGlobe() const { return this->Components.Eastward.Array || this->IsMap; }

  /// Cells with a number that is NaN, or with such a point, have no flow, as land. \return the dataset with these cells hidden; itself
  /// where there are none.
  /// \throw InvalidInput no cell has a flow; values can only be fill values: infinite, or 1e8 times the median of the others.
  vtkSmartPointer<vtkDataSet> WithFlow(vtkDataSet* dataset);
  /// Makes arrays of the cells that WithFlow has hidden NaN, and of their points that are not of the surface; writes their number as
  /// CellsWithoutFlow.
  /// \param names of arrays of cells and points; those that \p output lacks are passed over.
  void MarkCellsWithoutFlow(
    vtkDataSet* output, const SurfaceRelation& relation, const std::vector<std::string>& names) const;
  /// A sentence about values that look like fill values; empty where there are none.
  const std::string& Warning() const { return this->Suspicion; }

  /// \throw WrongChoice vectors of 2 numbers on a surface that is not in a plane of constant z; eastward and northward components in a
  ///   plane. Cost: linear.
  FaceFlow On(const FramedSurface& surface, const ExecutionContext& context) const;

private:
  Vector3 At(vtkIdType tuple, const Vector3& place) const;
  void CheckFillValues(const std::vector<char>& isNaN);

  EastAndNorth Components;
  vtkDataArray* Vectors = nullptr; ///< null where components are chosen
  bool OnPoints = false;
  bool IsMap = false;
  std::vector<char> IsHidden; ///< by cell; empty where none is
  std::string Suspicion;
};

}

#endif
