#include "Directions/ShapeOfSingularity.h"

#include <cmath>
#include <limits>
#include <set>

namespace dmg
{
namespace
{

/// The faces within two rings of a vertex or face, ascending; without the face itself.
std::set<int> FacesAround(const TriangleMesh& mesh, const SingularElement& singularity)
{
  constexpr int Rings = 2;
  std::set<int> faces, vertices;
  if (singularity.IsFace)
  {
    faces.insert(singularity.Element);
  }
  else
  {
    vertices.insert(singularity.Element);
  }
  for (int ring = 0; ring < Rings; ++ring)
  {
    for (const int face : faces)
    {
      for (int k = 0; k < 3; ++k)
      {
        vertices.insert(mesh.FaceCorners()(face, k));
      }
    }
    for (const int vertex : vertices)
    {
      mesh.VisitFan(vertex, [&faces](int h) { faces.insert(TriangleMesh::FaceOf(h)); });
    }
  }
  if (singularity.IsFace)
  {
    faces.erase(singularity.Element);
  }
  return faces;
}

Vector3 CentreOfFace(const TriangleMesh& mesh, int face)
{
  Vector3 centre = Vector3::Zero();
  for (int k = 0; k < 3; ++k)
  {
    centre += mesh.Position(mesh.FaceCorners()(face, k)) / 3.0;
  }
  return centre;
}

}

ShapeOfSingularity ShapeAt(
  const FramedMesh& surface, const Vector<Complex>& first, int N, const SingularElement& singularity)
{
  const TriangleMesh& mesh = surface.Mesh;
  const int element = singularity.Element;
  const TangentFrames& frames = singularity.IsFace ? surface.Faces : surface.Vertices;
  const Vector3 centre = singularity.IsFace ? CentreOfFace(mesh, element) : Vector3(mesh.Position(element));
  const int turns = static_cast<int>(std::lround(N * singularity.Index)); // of N-th powers around it
  Complex sum = 0.0;
  for (const int face : FacesAround(mesh, singularity))
  {
    const Complex radius = frames.ToComplex(element, CentreOfFace(mesh, face) - centre);
    const Complex direction = frames.ToComplex(element, surface.Faces.ToVector(face, first[face]));
    if (radius != 0.0 && direction != 0.0)
    {
      sum += std::polar(1.0, N * std::arg(direction) - turns * std::arg(radius));
    }
  }
  ShapeOfSingularity shape{ {}, std::numeric_limits<double>::quiet_NaN() };
  if (sum == 0.0)
  {
    return shape;
  }
  const double angle = std::arg(sum);
  const int axes = std::abs(N - turns);
  for (int k = 0; k < axes; ++k)
  {
    shape.Axes.push_back(frames.ToVector(element, std::polar(1.0, (angle + 2.0 * Pi * k) / (N - turns))));
  }
  if (axes == 0)
  {
    shape.SpiralAngle = angle / N;
  }
  return shape;
}

}
