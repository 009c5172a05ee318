#include "Adapters/Surface/MeshFromPolyData.h"

#include "Mesh/SpatialOrder.h"
#include "Support/CountingSort.h"
#include "Support/Errors.h"
#include "Support/Permutations.h"

#include "vtkCellArray.h"
#include "vtkCellArrayIterator.h"
#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkIdTypeArray.h"
#include "vtkNew.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"

#include <algorithm>
#include <cstdint>
#include <cstdio>
#include <cstring>
#include <limits>
#include <utility>

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

/// Calls visit(index, size, points) for every polygon.
template <class Visitor>
void VisitPolygons(vtkPolyData* surface, Visitor&& visit)
{
  const auto iterator = vtk::TakeSmartPointer(surface->GetPolys()->NewIterator());
  vtkIdType index = 0;
  for (iterator->GoToFirstCell(); !iterator->IsDoneWithTraversal(); iterator->GoToNextCell())
  {
    vtkIdType size;
    const vtkIdType* points;
    iterator->GetCurrentCell(size, points);
    visit(index++, size, points);
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

std::string Cell(vtkIdType id)
{
  return "cell " + std::to_string(id);
}

/// The triangles of a vtkPolyData. Points without a triangle are left out.
struct GivenTriangles
{
  Points Positions;
  Triangles Corners;               ///< rows of Positions
  std::vector<vtkIdType> PointIds; ///< of these rows, ascending
  std::vector<int> Vertices;       ///< row of every point, -1 for none
};

GivenTriangles ReadTriangles(vtkPolyData* surface, vtkIdType firstCell)
{
  const vtkIdType numberOfPoints = surface->GetNumberOfPoints();
  GivenTriangles given;
  std::vector<int>& vertices = given.Vertices;
  vertices.assign(numberOfPoints, -1);
  given.Corners.resize(surface->GetNumberOfPolys(), 3);
  VisitPolygons(surface,
    [&vertices, &given, firstCell](vtkIdType face, vtkIdType size, const vtkIdType* points)
    {
      if (size != 3)
      {
        throw InvalidInput(Cell(firstCell + face) + " is not a triangle, it has " + std::to_string(size) +
          " points; apply Triangulate (vtkTriangleFilter) first");
      }
      for (int k = 0; k < 3; ++k)
      {
        if (points[k] < 0 || points[k] >= static_cast<vtkIdType>(vertices.size()))
        {
          throw InvalidInput(Cell(firstCell + face) + " uses point " + std::to_string(points[k]) +
            ", and the surface has " + std::to_string(vertices.size()) + " points; repair the source of the surface");
        }
        vertices[points[k]] = 0;
        given.Corners(face, k) = static_cast<int>(points[k]);
      }
    });

  for (vtkIdType point = 0; point < numberOfPoints; ++point)
  {
    if (vertices[point] == 0)
    {
      vertices[point] = static_cast<int>(given.PointIds.size());
      given.PointIds.push_back(point);
    }
  }
  for (int i = 0; i < given.Corners.size(); ++i)
  {
    given.Corners.data()[i] = vertices[given.Corners.data()[i]];
  }
  given.Positions.resize(given.PointIds.size(), 3);
  VisitPoints(surface->GetPoints(),
    [&vertices, &given](vtkIdType point, double x, double y, double z)
    {
      if (vertices[point] >= 0)
      {
        given.Positions.row(vertices[point]) << x, y, z;
      }
    });
  return given;
}

ElementNames NamesOf(const std::vector<vtkIdType>& points, const std::vector<int>& polygons, vtkIdType firstCell)
{
  ElementNames names;
  names.Vertices.assign(points.begin(), points.end());
  names.Faces.resize(polygons.size());
  std::transform(polygons.begin(), polygons.end(), names.Faces.begin(),
    [firstCell](int polygon) { return static_cast<long long>(firstCell) + polygon; });
  return names;
}

/// The edges in ascending order of their (smaller, larger) point.
std::vector<int> EdgesByPoints(
  const TriangleMesh& mesh, const std::vector<int>& vertexRanks, const ExecutionContext& context)
{
  const ItemsByPair byPoints = SortByPair(
    mesh.NumberOfEdges(), mesh.NumberOfVertices(),
    [&mesh, &vertexRanks](int edge) -> std::pair<int, int>
    {
      const auto [a, b] = mesh.EdgeVertices(edge);
      return std::minmax({ vertexRanks[a], vertexRanks[b] });
    },
    context);
  std::vector<int> edges(byPoints.Items.size());
  std::transform(
    byPoints.Items.begin(), byPoints.Items.end(), edges.begin(), [](const ItemOfPair& edge) { return edge.Item; });
  return edges;
}

/// \throw InvalidInput no triangle has an area above 1e-10 times the square of its longest side: then no direction is
/// tangential to the surface.
void CheckArea(const TriangleMesh& mesh)
{
  constexpr double SmallestArea = 1e-10;
  for (int face = 0; face < mesh.NumberOfFaces(); ++face)
  {
    double longest = 0.0;
    for (int h = 3 * face; h < 3 * face + 3; ++h)
    {
      longest = std::max(longest, (mesh.Position(mesh.Head(h)) - mesh.Position(mesh.Tail(h))).squaredNorm());
    }
    if (mesh.FaceArea(face) > SmallestArea * longest)
    {
      return;
    }
  }
  throw InvalidInput("no triangle of the surface has an area, as the corners of each lie on a line; undo what has "
                     "flattened the surface, or take another");
}

SurfaceMesh InSpatialOrder(const GivenTriangles& given, vtkIdType firstCell, const ExecutionContext& context)
{
  const SpatialOrder order(given.Positions, given.Corners, context);
  TriangleMesh mesh = order.Apply(given.Positions, given.Corners, context);
  const std::vector<int> ranks = Inverse(order.Vertices(), context);
  std::vector<vtkIdType> points(ranks.size());
  std::vector<int> vertices(given.Vertices.size());
  constexpr int Grain = 8192;
  context.ParallelFor(0, static_cast<int>(vertices.size()), Grain,
    [&](int first, int last)
    {
      for (int point = first; point < last; ++point)
      {
        const int row = given.Vertices[point];
        vertices[point] = row < 0 ? -1 : ranks[row];
        if (row >= 0)
        {
          points[ranks[row]] = point;
        }
      }
    });
  CheckArea(mesh);
  std::vector<int> edges = EdgesByPoints(mesh, order.Vertices(), context);
  return { { firstCell, order.Faces(), Inverse(order.Faces(), context), std::move(points), std::move(vertices),
             std::move(edges) },
    std::move(mesh) };
}

SurfaceMesh AsGiven(GivenTriangles given, vtkIdType firstCell, const ExecutionContext& context)
{
  const std::vector<int> polygons = Identity(static_cast<int>(given.Corners.rows()));
  const ElementNames names = NamesOf(given.PointIds, polygons, firstCell);
  TriangleMesh mesh(std::move(given.Positions), std::move(given.Corners), names, context);
  CheckArea(mesh);
  std::vector<int> edges = Identity(mesh.NumberOfEdges());
  return { { firstCell, polygons, polygons, std::move(given.PointIds), std::move(given.Vertices), std::move(edges) },
    std::move(mesh) };
}

}

ElementNames SurfaceNumbering::Names() const
{
  return NamesOf(this->Points, this->Polygons, this->FirstCell);
}

SurfaceMesh MeshFromPolyData(vtkPolyData* surface, Numbering numbering, const ExecutionContext& context)
{
  const vtkIdType numberOfPoints = surface->GetNumberOfPoints();
  const vtkIdType numberOfFaces = surface->GetNumberOfPolys();
  const vtkIdType firstCell = surface->GetNumberOfVerts() + surface->GetNumberOfLines();
  if (surface->GetNumberOfStrips() > 0)
  {
    throw InvalidInput(
      Cell(firstCell + numberOfFaces) + " is a triangle strip; apply Triangulate (vtkTriangleFilter) first");
  }
  if (numberOfFaces == 0)
  {
    throw InvalidInput("the surface has no triangles; connect another, or the dataset that it was made of, through "
                       "Extract Surface (vtkGeometryFilter) and Triangulate (vtkTriangleFilter)");
  }
  if (std::max({ numberOfPoints, surface->GetNumberOfCells(), 3 * numberOfFaces }) > std::numeric_limits<int>::max())
  {
    throw InvalidInput("the surface has " + std::to_string(numberOfFaces) + " triangles, at most " +
      std::to_string(std::numeric_limits<int>::max() / 3) + " can be numbered; apply Decimate (vtkDecimatePro) first");
  }

  GivenTriangles given = ReadTriangles(surface, firstCell);
  if (numbering == Numbering::Spatial)
  {
    try
    {
      return InSpatialOrder(given, firstCell, context);
    }
    catch (const InvalidInput&)
    {
      // It is refused below, for what is the first reason in the caller's order.
    }
  }
  return AsGiven(std::move(given), firstCell, context);
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

std::string ContentDigest(vtkPolyData* surface)
{
  Hash hash;
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
  VisitPolygons(surface,
    [&hash](vtkIdType, vtkIdType size, const vtkIdType* points)
    {
      hash.Add(size);
      for (vtkIdType k = 0; k < size; ++k)
      {
        hash.Add(points[k]);
      }
    });
  return hash.Hexadecimal();
}

}
