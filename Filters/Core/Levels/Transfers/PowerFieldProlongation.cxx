#include "Levels/Transfers/PowerFieldProlongation.h"

#include "Support/SparseAssembly.h"

#include <cmath>

namespace dmg
{

namespace
{

constexpr int Grain = 4096;

/// Sum over the pieces of one fine face on one coarse face.
struct Overlap
{
  int Face;
  double Length;
  Complex Turning; // sum of length e^{i angle}
};

/// Corners of a face as complex numbers in its frame.
std::array<Complex, 3> CornersInFrame(
  const TriangleMesh& mesh, const TangentFrames& frames, int face)
{
  std::array<Complex, 3> corners;
  for (int k = 0; k < 3; ++k)
  {
    corners[k] = frames.ToComplex(face,
      mesh.Position(mesh.FaceCorners()(face, k)) - mesh.Position(mesh.FaceCorners()(face, 0)));
  }
  return corners;
}

}

TransportOperator PowerFieldProlongation(const FineEdgePaths& paths,
  const TangentFrames& fineFrames, const TangentFrames& coarseFrames,
  const ExecutionContext& context)
{
  const TriangleMesh& fine = paths.Fine();
  const TriangleMesh& coarse = paths.Coarse();
  std::vector<std::array<Complex, 3>> coarseCorners(coarse.NumberOfFaces());
  context.ParallelFor(0, coarse.NumberOfFaces(), Grain, [&](int first, int last) {
    for (int t = first; t < last; ++t)
    {
      coarseCorners[t] = CornersInFrame(coarse, coarseFrames, t);
    }
  });

  const auto appendRow = [&](int face, RowEntries<Complex>& row) {
    std::array<Overlap, 64> overlaps;
    int count = 0;
    double total = 0.0;
    int anyFace = -1;
    const std::array<Complex, 3> directions = SideDirections(fine, fineFrames, face);
    for (int k = 0; k < 3; ++k)
    {
      paths.VisitPieces(3 * face + k,
        [&](int t, const std::array<double, 3>& from, const std::array<double, 3>& to) {
          anyFace = t;
          const std::array<Complex, 3>& corners = coarseCorners[t];
          const Complex piece = (to[0] - from[0]) * corners[0] + (to[1] - from[1]) * corners[1] +
            (to[2] - from[2]) * corners[2];
          const double length = std::sqrt(std::norm(piece));
          int i = 0;
          while (i < count && overlaps[i].Face != t)
          {
            ++i;
          }
          if (i == count)
          {
            if (count == static_cast<int>(overlaps.size()))
            {
              return; // a hair of a long thin face; the others say enough
            }
            overlaps[count++] = { t, 0.0, 0.0 };
          }
          overlaps[i].Length += length;
          overlaps[i].Turning += directions[k] * std::conj(piece);
          total += length;
        });
    }
    for (int i = 0; i < count; ++i)
    {
      const double turning = std::sqrt(std::norm(overlaps[i].Turning));
      if (turning > 0.0)
      {
        row.emplace_back(
          overlaps[i].Face, overlaps[i].Length / total * (overlaps[i].Turning / turning));
      }
    }
    if (row.empty())
    {
      // The whole face lies in one point of the coarse mesh: no piece has a direction.
      row.emplace_back(anyFace, TransportTurn(coarseFrames, anyFace, fineFrames, face));
    }
  };
  return AssembleMatrix<Complex>(
    fine.NumberOfFaces(), coarse.NumberOfFaces(), context, appendRow);
}

}
