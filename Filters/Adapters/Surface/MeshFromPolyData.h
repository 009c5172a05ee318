#ifndef dmgMeshFromPolyData_h
#define dmgMeshFromPolyData_h

#include "Mesh/FramedMesh.h"
#include "Support/ExecutionContext.h"

#include "vtkSmartPointer.h"
#include "vtkType.h" // For vtkIdType

#include <string>
#include <vector>

class vtkPolyData;

namespace dmg
{

/// The order in which a mesh numbers its faces and vertices.
enum class Numbering
{
  OfPolyData, ///< in the order of polygons and points
  Spatial,    ///< as SpatialOrder does: files have any order, and loops over the surface like this one
};

/// The numbers of a mesh's elements in the vtkPolyData that it was made from.
///
/// The cells of polygons follow those of vertices and lines, as in every vtkPolyData. Points without
/// a triangle are left out.
struct SurfaceNumbering
{
  vtkIdType FirstCell = 0;       ///< cell of polygon 0; polygon p is cell FirstCell + p
  std::vector<int> Polygons;     ///< polygon of every face
  std::vector<int> Faces;        ///< face of every polygon
  std::vector<vtkIdType> Points; ///< point of every vertex
  std::vector<int> Vertices;     ///< vertex of every point, -1 for none
  std::vector<int> Edges;        ///< all edges, in ascending order of their (smaller, larger) point

  vtkIdType CellOf(int face) const { return this->FirstCell + this->Polygons[face]; }
  vtkIdType PointOf(int vertex) const { return this->Points[vertex]; }
  /// -1 for a cell that is no face.
  int FaceOf(vtkIdType cell) const
  {
    const vtkIdType polygon = cell - this->FirstCell;
    return polygon >= 0 && polygon < static_cast<vtkIdType>(this->Faces.size()) ? this->Faces[polygon] : -1;
  }
  /// -1 for a point that is no vertex.
  int VertexOf(vtkIdType point) const { return this->Vertices[point]; }
  /// +1 where an edge of the mesh runs from its smaller to its larger point, else -1.
  int EdgeSign(const TriangleMesh& mesh, int edge) const
  {
    const auto [tail, head] = mesh.EdgeVertices(edge);
    return this->Points[tail] < this->Points[head] ? 1 : -1;
  }

  /// The names of the caller's cells and points in messages about the mesh.
  ElementNames Names() const;
};

/// The triangles of a vtkPolyData as a mesh.
struct SurfaceMesh : SurfaceNumbering
{
  TriangleMesh Mesh;
};

/// A surface with the frames that its fields refer to; borrowed.
struct FramedSurface
{
  const FramedMesh& On;
  const SurfaceNumbering& Numbering;
};

/// \throw InvalidInput no triangles, a polygon that is not a triangle, triangle strips, too many
/// for 32-bit numbers, and what MeshChecks.h refuses; messages name cells and points of the \p
/// surface, the first in its order. Cost: linear.
SurfaceMesh MeshFromPolyData(vtkPolyData* surface, Numbering numbering, const ExecutionContext& context);

/// The way back: a new vtkPolyData with the mesh's vertices and faces.
vtkSmartPointer<vtkPolyData> PolyDataFromMesh(const TriangleMesh& mesh);

/// Fingerprint of what MeshFromPolyData reads: coordinates, polygons and numbers of cells. Equal
/// for equal content, whatever the objects, their times, the number types that hold it, and other
/// arrays. 32 hexadecimal digits of a hash that guards against accidents, not against forgery.
/// Cost: linear; some milliseconds per million triangles.
std::string ContentDigest(vtkPolyData* surface);

}

#endif
