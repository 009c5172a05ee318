#ifndef dmgMeshFromPolyData_h
#define dmgMeshFromPolyData_h

#include "Mesh/TriangleMesh.h"

#include "vtkSmartPointer.h"
#include "vtkType.h" // For vtkIdType

#include <string>
#include <vector>

class vtkPolyData;

namespace dmg
{

/// The triangles of a vtkPolyData as a mesh, and how its elements are numbered there.
///
/// Faces keep the order of the polygons; their cells follow the vertex and line cells, as in every
/// vtkPolyData. Vertices keep the order of the points; points without a triangle are left out.
struct SurfaceMesh
{
  TriangleMesh Mesh;
  vtkIdType FirstCell = 0; ///< cell of face 0; face f is cell FirstCell + f
  std::vector<vtkIdType> PointIds; ///< point of every vertex, ascending

  vtkIdType CellOf(int face) const { return this->FirstCell + face; }
  vtkIdType PointOf(int vertex) const { return this->PointIds[vertex]; }

  /// How messages about the mesh name the caller's cells and points.
  ElementNames Names() const;
};

/// \throw InvalidInput no triangles, a polygon that is not a triangle, triangle strips, too many
/// for 32-bit numbers, and what MeshChecks.h refuses; messages name cells and points of the \p
/// surface. Cost: linear.
SurfaceMesh MeshFromPolyData(vtkPolyData* surface);

/// The way back: a new vtkPolyData with the mesh's vertices and faces.
vtkSmartPointer<vtkPolyData> PolyDataFromMesh(const TriangleMesh& mesh);

/// Fingerprint of what MeshFromPolyData reads: coordinates, polygons and numbers of cells. Equal
/// for equal content, whatever the objects, their times, the number types that hold it, and other
/// arrays. 32 hexadecimal digits of a hash that guards against accidents, not against forgery.
/// Cost: linear; some milliseconds per million triangles.
std::string ContentDigest(vtkPolyData* surface);

}

#endif
