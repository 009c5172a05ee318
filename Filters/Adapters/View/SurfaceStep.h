#ifndef dmgSurfaceStep_h
#define dmgSurfaceStep_h

#include "Adapters/Surface/ElementArrays.h"
#include "Adapters/Surface/MeshFromDataSet.h"
#include "Mesh/TriangleMesh.h" // For Vector3

#include "vtkDataSet.h"
#include "vtkSmartPointer.h"

#include <optional>
#include <string>

class vtkPolyData;

namespace dmg
{

/// One change of a dataset on its way to the surface that the core sees (SurfaceView): the way forth, of its geometry and of the user's
/// vectors, and the way back, of arrays and lines. A step leaves the numbers of cells and points as they are.
class SurfaceStep
{
public:
  virtual ~SurfaceStep() = default;
  SurfaceStep(const SurfaceStep&) = delete;
  SurfaceStep& operator=(const SurfaceStep&) = delete;

  /// The dataset after the step; the one before it where nothing changes.
  vtkDataSet* Data() const { return this->Result; }

  /// A place of the user in the coordinates of the surface.
  virtual Vector3 PlaceForth(const Vector3& place) const { return place; }
  /// A vector of the user in the coordinates of the surface. \param place on the surface.
  virtual Vector3 VectorForth(const Vector3& vector, const Vector3& /*place*/) const { return vector; }
  /// Whether the user's vectors have no direction at a place of the surface, as eastward and northward ones at a pole.
  virtual bool IsPole(const Vector3& /*place*/) const { return false; }
  /// Whether the dataset before the step lies in a plane, so that vectors may have 2 numbers.
  virtual bool IsFromPlane() const { return false; }

  /// The place of the data of a cell whose corners the step has moved.
  virtual std::optional<Vector3> PlaceOfCell(vtkIdType /*cell*/) const { return {}; }

  /// Changes an array that was added to the output into one of the dataset before the step.
  virtual void ArrayBack(const AddedArray& /*array*/, const SurfaceRelation& /*relation*/) const {}
  /// Takes lines to the coordinates of the dataset before the step.
  virtual void LinesBack(vtkPolyData* /*lines*/) const {}

  /// Adds to the field data of the output what the step has done.
  virtual void Report(vtkFieldData* /*fieldData*/) const {}
  /// A warning for the user; empty where there is none.
  virtual std::string Warning(const TriangleMesh& /*mesh*/) const { return ""; }

protected:
  SurfaceStep() = default;

  vtkSmartPointer<vtkDataSet> Result;
};

}

#endif
