#ifndef dmgFramedMesh_h
#define dmgFramedMesh_h

#include "Mesh/TangentFrames.h"
#include "Mesh/TriangleMesh.h"

#include <utility>

namespace dmg
{

/// A mesh with the tangent frames that its fields refer to.
struct FramedMesh
{
  TriangleMesh Mesh;
  TangentFrames Faces;    ///< FaceFrames
  TangentFrames Vertices; ///< VertexFrames

  explicit FramedMesh(TriangleMesh mesh, const ExecutionContext& context = SerialContext())
    : Mesh(std::move(mesh))
    , Faces(FaceFrames(this->Mesh, context))
    , Vertices(VertexFrames(this->Mesh, context))
  {
  }
};

}

#endif
