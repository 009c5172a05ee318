#include "Directions/CellDirections.h"

#include <algorithm>
#include <cmath>

namespace dmg
{

namespace
{

/// Carries a vector of the plane with normal \p from into that with normal \p to by the shortest rotation between them, or by
/// half a turn about \p axis where they are opposite. \p axis is in both planes then.
Vector3 Carried(const Vector3& vector, const Vector3& from, const Vector3& to, const Vector3& axis)
{
  const double onePlusCosine = 1.0 + from.dot(to);
  return onePlusCosine > 1e-12 ? Vector3(vector - to.dot(vector) / onePlusCosine * (from + to))
                               : Vector3(2.0 * axis.dot(vector) * axis - vector);
}

/// The sum of the area vectors, normalised; where they cancel, that of the largest face.
Vector3 NormalOfCell(const TriangleMesh& mesh, const TangentFrames& frames, const ElementRow& faces, int largest)
{
  Vector3 normal = Vector3::Zero();
  for (const int face : faces)
  {
    normal += mesh.FaceAreaVector(face);
  }
  return normal.norm() > 1e-12 * mesh.FaceAreaVector(largest).norm() ? normal.stableNormalized()
                                                                     : frames.Normal(largest);
}

/// Raises the direction and keeps the magnitude.
Complex Power(Complex z, int N)
{
  return std::polar(std::abs(z), N * std::arg(z));
}

}

int LargestFace(const TriangleMesh& mesh, const ElementRow& faces)
{
  int largest = faces.front();
  double area = -1.0;
  for (const int face : faces)
  {
    const double other = mesh.FaceArea(face);
    if (other > area * (1.0 + 1e-9))
    {
      area = other;
      largest = face;
    }
  }
  return largest;
}

Points NormalsOfCells(const TriangleMesh& mesh, const TangentFrames& frames, const SurfaceRelation& relation,
  const ExecutionContext& context)
{
  constexpr int Grain = 4096;
  const int size = relation.IsOneToOne() ? 0 : mesh.NumberOfFaces();
  Points normals(size, 3);
  context.ParallelFor(0, size, Grain,
    [&](int first, int last)
    {
      for (int face = first; face < last; ++face)
      {
        const ElementRow faces = relation.FacesOf(relation.CellOf(face));
        if (faces.size() < 2)
        {
          normals.row(face) = frames.Normal(face);
        }
        else if (face == faces.front()) // writes those of the whole cell
        {
          const Vector3 normal = NormalOfCell(mesh, frames, faces, LargestFace(mesh, faces));
          std::for_each(faces.begin(), faces.end(), [&](int other) { normals.row(other) = normal; });
        }
      }
    });
  return normals;
}

Complex OnFaceOfCell(const TangentFrames& frames, int face, const Vector3& normal, const Vector3& vector)
{
  const Vector3 tangential = vector - normal.dot(vector) * normal;
  return frames.ToComplex(face, Carried(tangential, normal, frames.Normal(face), frames.X.row(face)));
}

CellDirections::Direction CellDirections::Plane(const ElementRow& faces, int largest) const
{
  const Vector3 normal = NormalOfCell(this->Mesh, this->Frames, faces, largest);
  const Vector3 axis = this->Frames.X.row(largest);
  const Vector3 x = Carried(axis, this->Frames.Normal(largest), normal, axis).normalized();
  return { x, normal.cross(x), 0.0 };
}

CellDirections::Direction CellDirections::Mean(const ElementRow& faces, const Vector<Complex>& first) const
{
  const int largest = LargestFace(this->Mesh, faces);
  Direction mean = this->Plane(faces, largest);
  const Vector3 normal = mean.X.cross(mean.Y);
  const auto carried = [&](int face) -> Complex
  {
    const Vector3 vector =
      Carried(this->Frames.ToVector(face, first[face]), this->Frames.Normal(face), normal, this->Frames.X.row(face));
    return { vector.dot(mean.X), vector.dot(mean.Y) };
  };
  const Complex ofLargest = carried(largest);
  const double smallest = 1e-12 * this->Mesh.FaceArea(largest); // for cells without area
  Complex sum = 0.0;
  double weights = 0.0, magnitudes = 0.0;
  for (const int face : faces)
  {
    const double weight = smallest > 0.0 ? this->Mesh.FaceArea(face) : 1.0;
    const Complex z = carried(face);
    sum += weight * Power(z, this->N);
    weights += weight;
    magnitudes += weight * std::abs(z);
  }
  if (!(std::abs(sum) > 1e-6 * magnitudes))
  {
    mean.First = ofLargest;
    return mean;
  }
  const double step = 2.0 * Pi / this->N;
  const double angle = std::arg(sum) / this->N;
  const double k = std::round((std::arg(ofLargest) - angle) / step);
  mean.First = std::polar(std::abs(sum) / weights, angle + k * step);
  return mean;
}

}
