#include "Operators/CellDirections.h"

#include <cmath>

namespace dmg
{

namespace
{

/// Carries a vector of the plane with normal \p from into that with normal \p to by the shortest rotation between them.
Vector3 Carried(const Vector3& vector, const Vector3& from, const Vector3& to)
{
  const double onePlusCosine = 1.0 + from.dot(to);
  return onePlusCosine > 1e-12 ? Vector3(vector - to.dot(vector) / onePlusCosine * (from + to)) : vector;
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

CellDirections::Direction CellDirections::Plane(const ElementRow& faces, int largest) const
{
  Vector3 normal = Vector3::Zero();
  for (const int face : faces)
  {
    normal += this->Mesh.FaceAreaVector(face);
  }
  const Vector3 ofLargest = this->Frames.Normal(largest);
  normal = normal.norm() > 1e-12 * this->Mesh.FaceAreaVector(largest).norm() ? normal.stableNormalized() : ofLargest;
  const Vector3 x = Carried(this->Frames.X.row(largest).transpose(), ofLargest, normal).normalized();
  return { x, normal.cross(x), 0.0 };
}

CellDirections::Direction CellDirections::Mean(const ElementRow& faces, const Vector<Complex>& first) const
{
  const int largest = LargestFace(this->Mesh, faces);
  Direction mean = this->Plane(faces, largest);
  const Vector3 normal = mean.X.cross(mean.Y);
  const auto carried = [&](int face) -> Complex
  {
    const Vector3 vector = Carried(this->Frames.ToVector(face, first[face]), this->Frames.Normal(face), normal);
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
