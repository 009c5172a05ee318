#ifndef dmgCellDirections_h
#define dmgCellDirections_h

#include "Mesh/SurfaceRelation.h"
#include "Mesh/TangentFrames.h"
#include "Mesh/TriangleMesh.h"
#include "Support/ExecutionContext.h"

namespace dmg
{

/// The direction of a cell of several faces: the mean of the N-th powers of its faces by area, each carried into the
/// plane of the cell by the shortest rotation between the normals; where these are opposite, by half a turn about the first axis
/// of the face. The normal of the cell is the sum of the area vectors.
class CellDirections
{
public:
  /// \param frames of the faces. Both are referred to.
  CellDirections(const TriangleMesh& mesh, const TangentFrames& frames, int N)
    : Mesh(mesh)
    , Frames(frames)
    , N(N)
  {
  }

  struct Direction
  {
    Vector3 X, Y;  ///< the tangent plane of the cell
    Complex First; ///< in it
  };

  /// \param first directions of all faces, in their frames. The first direction of the cell is the one nearest to that of
  /// its largest face. Where powers cancel, it is that one.
  /// \pre faces is not empty.
  Direction Mean(const ElementRow& faces, const Vector<Complex>& first) const;

private:
  /// The axes of the cell's plane; X is near that of its largest face.
  Direction Plane(const ElementRow& faces, int largest) const;

  const TriangleMesh& Mesh;
  const TangentFrames& Frames;
  const int N;
};

/// The normal of each cell of several faces, a row per face; empty where each cell has one face at most. See CellDirections.
Points NormalsOfCells(const TriangleMesh& mesh, const TangentFrames& frames, const SurfaceRelation& relation,
  const ExecutionContext& context = SerialContext());

/// The tangential part of a vector of a cell in the plane of one of its faces: carried there by the rotation that
/// CellDirections takes the other way. So the directions of a cell keep their angles on a face that leans out of its plane.
/// \param normal of the cell.
Complex OnFaceOfCell(const TangentFrames& frames, int face, const Vector3& normal, const Vector3& vector);

/// The largest of several faces; the first one of equal ones. \pre there is one.
int LargestFace(const TriangleMesh& mesh, const ElementRow& faces);

}

#endif
