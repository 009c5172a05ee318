#ifndef dmgCellDirections_h
#define dmgCellDirections_h

#include "Mesh/SurfaceRelation.h"
#include "Mesh/TangentFrames.h"
#include "Mesh/TriangleMesh.h"

namespace dmg
{

/// The direction of a cell of several faces: the mean of the N-th powers of its faces by area, each carried into the
/// plane of the cell by the shortest rotation between the normals. The normal of the cell is the sum of the area vectors.
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

/// The largest of several faces; the first one of equal ones. \pre there is one.
int LargestFace(const TriangleMesh& mesh, const ElementRow& faces);

}

#endif
