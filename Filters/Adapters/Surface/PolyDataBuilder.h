#ifndef dmgPolyDataBuilder_h
#define dmgPolyDataBuilder_h

#include "Adapters/Surface/NewArrays.h"
#include "Mesh/TriangleMesh.h" // For Vector3

#include "vtkCellArray.h"
#include "vtkCellData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"

#include <string>
#include <vector>

namespace dmg
{

/// Points in double precision, and vertices, lines or polygons on them, all of one kind, as vtkPolyData with arrays.
class PolyDataBuilder
{
public:
  enum class Cells
  {
    None,
    Vertices,
    Lines,
    Polygons
  };

  explicit PolyDataBuilder(Cells kind)
    : Kind(kind)
  {
  }

  /// \return its number.
  vtkIdType AddPoint(const Vector3& position)
  {
    this->Positions.insert(this->Positions.end(), position.begin(), position.end());
    return this->NumberOfPoints() - 1;
  }

  /// Adds a cell on points that are there.
  void AddCell(const std::vector<vtkIdType>& points)
  {
    this->CellsOnPoints->InsertNextCell(static_cast<vtkIdType>(points.size()), points.data());
  }

  /// Adds a line over points that are there, the numbers from \p first to before \p end, and back to the first one if it is closed.
  void AddLine(vtkIdType first, vtkIdType end, bool isClosed);

  vtkIdType NumberOfPoints() const { return static_cast<vtkIdType>(this->Positions.size()) / 3; }
  vtkIdType NumberOfCells() const { return this->CellsOnPoints->GetNumberOfCells(); }

  /// Makes \p output the points and cells; its arrays stay.
  void Finish(vtkPolyData* output) const;

private:
  const Cells Kind;
  std::vector<double> Positions;
  vtkNew<vtkCellArray> CellsOnPoints;
};

/// Adds an array of points or cells, but not as active scalars: ParaView would colour by it.
template <class Array, class Values>
void AddToPoints(vtkPolyData* output, const std::string& name, const Values& values)
{
  output->GetPointData()->AddArray(NewArray<Array>(name, 1, values));
}

template <class Array, class Values>
void AddToCells(vtkPolyData* output, const std::string& name, const Values& values)
{
  output->GetCellData()->AddArray(NewArray<Array>(name, 1, values));
}

/// A copy as writers of VTK take texture coordinates: in single precision, as that of PLY crashes with others; and none is -1, but the next number
/// to it, as that of OBJ leaves those out, and all after them move up.
vtkSmartPointer<vtkDataArray> AsTextureCoordinates(vtkDataArray* array);

/// Vectors as the active normals of points, in single precision.
void SetNormals(vtkPolyData* output, const std::vector<Vector3>& normals);

}

#endif
