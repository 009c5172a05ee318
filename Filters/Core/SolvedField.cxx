#include "SolvedField.h"

#include "Operators/PowerFieldDirections.h"

namespace dmg
{

Points SolvedField::Directions(int k, const ExecutionContext& context) const
{
  const auto& [mesh, faceFrames, vertexFrames] = this->Surface();
  const Discretisation& field = this->Field();
  const Unfilled<Corner> corners =
    Corners(mesh, SideDirections(mesh, faceFrames, context), faceFrames, vertexFrames, context);
  const int N = field.DirectionsPerPoint();
  const Vector<Complex> first = FirstDirections(field.Powers(this->Unknowns(), corners, context).Faces, N, {}, context);
  const Complex turn = std::polar(1.0, 2.0 * Pi * k / N);
  Points vectors(mesh.NumberOfFaces(), 3);
  for (int face = 0; face < mesh.NumberOfFaces(); ++face)
  {
    vectors.row(face) = faceFrames.ToVector(face, turn * first[face]).transpose();
  }
  return vectors;
}

}
