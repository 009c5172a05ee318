#ifndef dmgMeshFromDataSet_h
#define dmgMeshFromDataSet_h

#include "Mesh/FramedMesh.h"
#include "Mesh/SurfaceRelation.h"
#include "Preparation/PreparedSurface.h"
#include "Support/ExecutionContext.h"

#include "vtkSmartPointer.h"

#include <string>

class vtkDataSet;
class vtkPolyData;

namespace dmg
{

/// A dataset's surface as a mesh, with the relation of its elements to cells and points.
struct SurfaceMesh : SurfaceRelation
{
  TriangleMesh Mesh;
  PreparationReport Report;
};

/// A surface with the frames that its fields refer to; borrowed.
struct FramedSurface
{
  const FramedMesh& Geometry;
  const SurfaceRelation& Relation;
};

/// Prepares the cells of two dimensions of any dataset (PrepareSurface). Lines and vertices are passed over, and so are
/// hidden cells (vtkDataSetAttributes::HIDDENCELL, or with a HIDDENPOINT). Cells of higher order are cut into linear
/// triangles between their points, as VTK draws them. Duplicate ghost cells are left out, and have the faces of their
/// twins.
/// \throw InvalidInput a cell of three dimensions, no cells of two, triangle strips of a vtkPolyData (see
/// WithoutStrips), too many for 32-bit numbers, and as PrepareSurface; messages name cells and points of the \p surface.
/// Cost: linear, besides PrepareSurface.
SurfaceMesh MeshFromDataSet(vtkDataSet* surface, const PreparationOptions& options, const ExecutionContext& context);

/// The way back: a new vtkPolyData with the mesh's vertices and faces.
vtkSmartPointer<vtkPolyData> PolyDataFromMesh(const TriangleMesh& mesh);

/// Fingerprint of what MeshFromDataSet reads: coordinates, cells, which of them are ghosts, and the options but for the
/// order. Equal for equal content, whatever the objects, their times, the number types that hold it, and other
/// arrays. 32 hexadecimal digits of a hash that guards against accidents, not against forgery.
/// Cost: linear; some milliseconds per million triangles.
std::string ContentDigest(vtkDataSet* surface, const PreparationOptions& options = {});

}

#endif
