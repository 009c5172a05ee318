#include "Mesh/TriangleQuality.h"

#include "Support/SparseKernels.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace dmg
{
namespace
{

/// Integrals over faces.
struct SumsOfFaces
{
  explicit SumsOfFaces(int = 0) {}
  double Area = 0.0;
  double CapArea = 0.0;
  double Radii = 0.0;     ///< of the circles of caps
  double HalfSides = 0.0; ///< half of their longest sides

  void Add(const TriangleMesh& mesh, int face)
  {
    std::array<double, 3> sides;
    for (int k = 0; k < 3; ++k)
    {
      sides[k] = (mesh.Position(mesh.Head(3 * face + k)) - mesh.Position(mesh.Tail(3 * face + k))).norm();
    }
    std::sort(sides.begin(), sides.end());
    const auto [a, b, c] = sides;
    const double area = mesh.FaceArea(face);
    this->Area += area;
    if (c * c > a * a + b * b + std::sqrt(3.0) * a * b) // the cosine of 150 degrees is -sqrt(3) / 2
    {
      this->CapArea += area;
      this->Radii += 0.25 * a * b * c; // the radius is that over the area
      this->HalfSides += 0.5 * c * area;
    }
  }

  SumsOfFaces& operator+=(const SumsOfFaces& other)
  {
    this->Area += other.Area;
    this->CapArea += other.CapArea;
    this->Radii += other.Radii;
    this->HalfSides += other.HalfSides;
    return *this;
  }
};

}

double TriangleQuality(const TriangleMesh& mesh, int face)
{
  const Vector3 a = mesh.Position(mesh.Tail(3 * face));
  const Vector3 b = mesh.Position(mesh.Tail(3 * face + 1));
  const Vector3 c = mesh.Position(mesh.Tail(3 * face + 2));
  const double squares = (b - a).squaredNorm() + (c - b).squaredNorm() + (a - c).squaredNorm();
  return squares > 0.0 ? 2.0 * std::sqrt(3.0) * (b - a).cross(c - a).norm() / squares : 0.0;
}

double ShareOfFacesBelow(double quality, const TriangleMesh& mesh, const ExecutionContext& context)
{
  const int faces = mesh.NumberOfFaces();
  const double count = SumOverBlocks<double>(faces, context,
    [&](int first, int last)
    {
      int below = 0;
      for (int face = first; face < last; ++face)
      {
        below += TriangleQuality(mesh, face) < quality ? 1 : 0;
      }
      return static_cast<double>(below);
    });
  return faces > 0 ? count / faces : 0.0;
}

CapFaces FindCaps(const TriangleMesh& mesh, const ExecutionContext& context)
{
  const SumsOfFaces sums = SumOverBlocks<SumsOfFaces>(mesh.NumberOfFaces(), context,
    [&mesh](int first, int last)
    {
      SumsOfFaces part;
      for (int face = first; face < last; ++face)
      {
        part.Add(mesh, face);
      }
      return part;
    });
  return sums.HalfSides > 0.0 ? CapFaces{ sums.CapArea / sums.Area, sums.Radii / sums.HalfSides } : CapFaces{};
}

}
