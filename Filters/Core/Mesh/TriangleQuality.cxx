#include "Mesh/TriangleQuality.h"

#include "Support/SparseKernels.h"

#include <cmath>

namespace dmg
{

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

}
