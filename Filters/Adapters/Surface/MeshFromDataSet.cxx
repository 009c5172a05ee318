#include "Adapters/Surface/MeshFromDataSet.h"

#include "Adapters/Data/VisitCells.h"
#include "Adapters/Surface/PolygonsFromDataSet.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkIdTypeArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <type_traits>
#include <utility>
#include <variant>

namespace dmg
{

namespace
{

/// Calls visit(index, x, y, z) for every point, in double precision.
template <class Visitor>
void VisitPoints(vtkPoints* points, Visitor&& visit)
{
  if (!points)
  {
    return;
  }
  const vtkIdType size = points->GetNumberOfPoints();
  const auto visitAll = [size, &visit](const auto* xyz)
  {
    for (vtkIdType i = 0; i < size; ++i, xyz += 3)
    {
      visit(i, static_cast<double>(xyz[0]), static_cast<double>(xyz[1]), static_cast<double>(xyz[2]));
    }
  };
  vtkDataArray* const array = points->GetData();
  if (auto* doubles = vtkDoubleArray::FastDownCast(array))
  {
    visitAll(doubles->GetPointer(0));
  }
  else if (auto* floats = vtkFloatArray::FastDownCast(array))
  {
    visitAll(floats->GetPointer(0));
  }
  else // other types and memory layouts
  {
    double xyz[3];
    for (vtkIdType i = 0; i < size; ++i)
    {
      array->GetTuple(i, xyz);
      visit(i, xyz[0], xyz[1], xyz[2]);
    }
  }
}

/// A word-wise multiplicative hash; two of them with different multipliers run side by side.
class Hash
{
public:
  void Add(std::uint64_t word)
  {
    this->First = (this->First ^ word) * 0x9e3779b97f4a7c15ull; // 2^64 / golden ratio
    this->First ^= this->First >> 32;
    this->Second = (this->Second + word) * 0xd1342543de82ef95ull; // a spectrally good multiplier
    this->Second ^= this->Second >> 29;
  }
  void Add(vtkIdType number) { this->Add(static_cast<std::uint64_t>(number)); }
  void Add(double number)
  {
    std::uint64_t bits;
    std::memcpy(&bits, &number, sizeof(bits));
    this->Add(bits);
  }

  std::string Hexadecimal() const
  {
    char text[33];
    std::snprintf(text, sizeof(text), "%016llx%016llx", static_cast<unsigned long long>(this->First),
      static_cast<unsigned long long>(this->Second));
    return text;
  }

private:
  std::uint64_t First = 0x243f6a8885a308d3ull; // the digits of pi
  std::uint64_t Second = 0x13198a2e03707344ull;
};

/// The points and polygons of a vtkPolyData.
void AddTo(Hash& hash, vtkPolyData* surface)
{
  hash.Add(surface->GetNumberOfPoints());
  hash.Add(surface->GetNumberOfVerts() + surface->GetNumberOfLines());
  hash.Add(surface->GetNumberOfPolys());
  hash.Add(surface->GetNumberOfStrips());
  VisitPoints(surface->GetPoints(),
    [&hash](vtkIdType, double x, double y, double z)
    {
      hash.Add(x);
      hash.Add(y);
      hash.Add(z);
    });
  VisitCells(surface->GetPolys(),
    [&hash](vtkIdType, vtkIdType size, const vtkIdType* points)
    {
      hash.Add(size);
      for (vtkIdType k = 0; k < size; ++k)
      {
        hash.Add(points[k]);
      }
    });
}

template <class Number>
void AddTo(Hash& hash, const Number* numbers, std::size_t size)
{
  hash.Add(static_cast<std::uint64_t>(size));
  for (std::size_t i = 0; i < size; ++i)
  {
    if constexpr (std::is_same_v<Number, double>)
    {
      hash.Add(numbers[i]);
    }
    else
    {
      hash.Add(static_cast<vtkIdType>(numbers[i]));
    }
  }
}

/// The surface of any other dataset, as it is read.
void AddTo(Hash& hash, const PolygonSurface& polygons)
{
  hash.Add(static_cast<vtkIdType>(polygons.NumberOfCells)); // those that are no polygons have tuples in arrays, too
  AddTo(hash, polygons.Positions.data(), polygons.Positions.size());
  AddTo(hash, polygons.Offsets.data(), polygons.Offsets.size());
  AddTo(hash, polygons.Corners.data(), polygons.Corners.size());
  AddTo(hash, polygons.Cells.data(), polygons.Cells.size());
  AddTo(hash, polygons.IsDuplicate.data(), polygons.IsDuplicate.size());
}

/// Whether some cells or points may be ghosts.
bool HasGhosts(vtkDataSet* surface)
{
  const char* const name = vtkDataSetAttributes::GhostArrayName();
  return surface->GetCellData()->HasArray(name) || surface->GetPointData()->HasArray(name);
}

}

SurfaceMesh MeshFromDataSet(vtkDataSet* surface, const PreparationOptions& options, const ExecutionContext& context)
{
  PreparedSurface prepared = std::visit(
    [&](auto&& cells) { return PrepareSurface(std::move(cells), options, context); }, ReadSurfaceCells(surface));
  return { std::move(prepared.Relation), std::move(prepared.Mesh), prepared.Report };
}

vtkSmartPointer<vtkPolyData> PolyDataFromMesh(const TriangleMesh& mesh)
{
  vtkNew<vtkDoubleArray> coordinates;
  coordinates->SetNumberOfComponents(3);
  coordinates->SetNumberOfTuples(mesh.NumberOfVertices());
  const Points& positions = mesh.VertexPositions();
  std::copy_n(positions.data(), positions.size(), coordinates->GetPointer(0));
  vtkNew<vtkIdTypeArray> corners;
  corners->SetNumberOfValues(3 * static_cast<vtkIdType>(mesh.NumberOfFaces()));
  const Triangles& triangles = mesh.FaceCorners();
  std::copy_n(triangles.data(), triangles.size(), corners->GetPointer(0));

  vtkNew<vtkPoints> points;
  points->SetData(coordinates);
  vtkNew<vtkCellArray> polygons;
  polygons->SetData(3, corners);
  auto surface = vtkSmartPointer<vtkPolyData>::New();
  surface->SetPoints(points);
  surface->SetPolys(polygons);
  return surface;
}

std::string ContentDigest(vtkDataSet* surface, const PreparationOptions& options)
{
  Hash hash;
  auto* const polyData = vtkPolyData::SafeDownCast(surface);
  if (polyData)
  {
    AddTo(hash, polyData);
  }
  if (!polyData || HasGhosts(surface))
  {
    const SurfaceCells cells = ReadSurfaceCells(surface);
    if (auto* const polygons = std::get_if<PolygonSurface>(&cells))
    {
      AddTo(hash, *polygons);
    }
  }
  if (options.Strict || !options.JoinPoints)
  {
    hash.Add(static_cast<vtkIdType>(options.Strict ? 1 : 2));
  }
  return hash.Hexadecimal();
}

}
