#include "StructurePreserving/Transfers/FaceFieldProlongation.h"

#include "Mesh/FaceProjection.h"
#include "Support/SparseAssembly.h"

namespace dmg
{

SparseMatrix<double> FaceFieldProlongation(const FineEdgePaths& paths, const TangentFrames& fineFrames,
  const TangentFrames& coarseFrames, const ExecutionContext& context)
{
  constexpr int Grain = 4096;
  const TriangleMesh& fine = paths.Fine();
  const TriangleMesh& coarse = paths.Coarse();
  std::vector<FaceProjection> coarseSides(coarse.NumberOfFaces());
  context.ParallelFor(0, coarse.NumberOfFaces(), Grain,
    [&](int first, int last)
    {
      for (int t = first; t < last; ++t)
      {
        coarseSides[t] = ProjectionOntoSides(coarse, coarseFrames, t);
      }
    });

  const auto appendRow = [&](int face, RowEntries<Block>& row)
  {
    const Eigen::Matrix<double, 2, 3> inverse = PseudoInverse(ProjectionOntoSides(fine, fineFrames, face));
    for (int k = 0; k < 3; ++k)
    {
      paths.VisitPieces(3 * face + k,
        [&](int t, const std::array<double, 3>& from, const std::array<double, 3>& to)
        {
          // Corner 0 is the origin, side 0 leads to corner 1, and side 2 comes from corner 2.
          const FaceProjection& sides = coarseSides[t];
          const Eigen::RowVector2d piece = (to[1] - from[1]) * sides.row(0) - (to[2] - from[2]) * sides.row(2);
          AddTo<Block>(row, t, inverse.col(k) * piece);
        });
    }
  };
  return AssembleBlocks(fine.NumberOfFaces(), coarse.NumberOfFaces(), context, appendRow);
}

}
