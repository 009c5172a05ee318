#ifndef dmgPreparedDataSet_h
#define dmgPreparedDataSet_h

#include "Adapters/Surface/MeshFromDataSet.h"
#include "Mesh/FramedMesh.h"
#include "Mesh/SurfaceRelation.h"
#include "Preparation/PreparedSurface.h"
#include "Support/ExecutionContext.h"

#include <memory>
#include <string>

class vtkDataSet;

namespace dmg
{

/// The surface of a dataset as a mesh with its frames.
struct PreparedDataSet
{
  FramedMesh Geometry;
  SurfaceRelation Relation;
  PreparationReport Report;
  std::string Digest; ///< ContentDigest

  FramedSurface Surface() const { return { this->Geometry, this->Relation }; }
};

/// MeshFromDataSet with frames. All filters of the process share the result: a surface of the same content (ContentDigest) and the same
/// options is prepared once, as long as somebody holds it. So a drawing takes the surface of the solver that made its field, and equal
/// pointers mean the same surface.
/// \throw InvalidInput as MeshFromDataSet. Cost: that of ContentDigest, and of MeshFromDataSet where nobody holds the surface.
std::shared_ptr<const PreparedDataSet> PrepareDataSet(
  vtkDataSet* surface, const PreparationOptions& options, const ExecutionContext& context);

/// PrepareDataSet of a surface whose ContentDigest is at hand.
std::shared_ptr<const PreparedDataSet> PrepareDataSet(
  vtkDataSet* surface, const std::string& digest, const PreparationOptions& options, const ExecutionContext& context);

}

#endif
