#ifndef dmgTestFields_h
#define dmgTestFields_h

#include "Drawing/DirectionsOnFaces.h"
#include "Drawing/UnfoldedSurface.h"
#include "Support/MeshFactory.h"
#include "Support/Random.h"

#include <functional>

namespace dmg::test
{

/// A surface with a field, ready to be drawn.
struct DrawnField
{
  TriangleMesh Mesh;
  TangentFrames Frames;
  UnfoldedSurface Unfolded;
  DirectionsOnFaces Field;

  /// \param vectorAt direction 0 at the centre of a face; its tangential part counts.
  DrawnField(const Surface& surface, int N, const std::function<Vector3(const Vector3&)>& vectorAt)
    : Mesh(surface.Mesh())
    , Frames(FaceFrames(this->Mesh))
    , Unfolded(this->Mesh, this->Frames)
    , Field(N, this->FirstFrom(vectorAt))
  {
  }
  /// Directions at random.
  DrawnField(const Surface& surface, int N, unsigned seed)
    : Mesh(surface.Mesh())
    , Frames(FaceFrames(this->Mesh))
    , Unfolded(this->Mesh, this->Frames)
    , Field(N, Random(seed).Numbers(this->Mesh.NumberOfFaces()))
  {
  }
  DrawnField(const DrawnField&) = delete; // the surface is borrowed
  void operator=(const DrawnField&) = delete;

  Vector3 Centre(int face) const { return this->Unfolded.Position(face, this->Unfolded.Centre(face).Point); }

private:
  Vector<Complex> FirstFrom(const std::function<Vector3(const Vector3&)>& vectorAt) const
  {
    Vector<Complex> first(this->Mesh.NumberOfFaces());
    for (int face = 0; face < this->Mesh.NumberOfFaces(); ++face)
    {
      first[face] = this->Frames.ToComplex(face, vectorAt(this->Centre(face)));
    }
    return first;
  }
};

}

#endif
