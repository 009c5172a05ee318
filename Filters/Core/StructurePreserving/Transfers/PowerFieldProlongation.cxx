#include "StructurePreserving/Transfers/PowerFieldProlongation.h"

#include "Support/SparseAssembly.h"

#include <cmath>

namespace dmg
{

namespace
{

constexpr int Grain = 4096;

/// The pieces of one fine face's sides, summed up on each coarse face.
class Overlaps
{
public:
  void Add(int face, Complex piece, Complex direction)
  {
    this->AnyFace = face;
    int i = 0;
    while (i < this->Count && this->OnFaces[i].Face != face)
    {
      ++i;
    }
    if (i == this->Count)
    {
      if (this->Count == static_cast<int>(this->OnFaces.size()))
      {
        return; // at most so many coarse faces per fine face; the weights of the others are normalised
      }
      this->OnFaces[this->Count++] = { face, 0.0, 0.0 };
    }
    const double length = std::sqrt(std::norm(piece));
    this->OnFaces[i].Length += length;
    this->OnFaces[i].Rotation += direction * std::conj(piece);
    this->TotalLength += length;
  }

  /// Weights are shares of the length, turns are those of the mean direction.
  void AppendTo(RowEntries<Complex>& row) const
  {
    for (int i = 0; i < this->Count; ++i)
    {
      const OnFace& overlap = this->OnFaces[i];
      const double rotation = std::sqrt(std::norm(overlap.Rotation));
      if (rotation > 0.0)
      {
        row.emplace_back(overlap.Face, overlap.Length / this->TotalLength * (overlap.Rotation / rotation));
      }
    }
  }

  /// One of the faces.
  int Any() const { return this->AnyFace; }

private:
  struct OnFace
  {
    int Face;
    double Length;
    Complex Rotation; ///< sum of length e^{i angle}
  };

  std::array<OnFace, 64> OnFaces;
  int Count = 0;
  double TotalLength = 0.0;
  int AnyFace = -1;
};

/// Corners of a face as complex numbers in its frame.
std::array<Complex, 3> CornersInFrame(const TriangleMesh& mesh, const TangentFrames& frames, int face)
{
  std::array<Complex, 3> corners;
  for (int k = 0; k < 3; ++k)
  {
    corners[k] =
      frames.ToComplex(face, mesh.Position(mesh.FaceCorners()(face, k)) - mesh.Position(mesh.FaceCorners()(face, 0)));
  }
  return corners;
}

}

TransportOperator PowerFieldProlongation(const FineEdgePaths& paths, const TangentFrames& fineFrames,
  const TangentFrames& coarseFrames, const ExecutionContext& context)
{
  const TriangleMesh& fine = paths.Fine();
  const TriangleMesh& coarse = paths.Coarse();
  std::vector<std::array<Complex, 3>> coarseCorners(coarse.NumberOfFaces());
  context.ParallelFor(0, coarse.NumberOfFaces(), Grain,
    [&](int first, int last)
    {
      for (int t = first; t < last; ++t)
      {
        coarseCorners[t] = CornersInFrame(coarse, coarseFrames, t);
      }
    });

  const auto appendRow = [&](int face, RowEntries<Complex>& row)
  {
    Overlaps overlaps;
    const std::array<Complex, 3> directions = SideDirections(fine, fineFrames, face);
    for (int k = 0; k < 3; ++k)
    {
      paths.VisitPieces(3 * face + k,
        [&](int t, const std::array<double, 3>& from, const std::array<double, 3>& to)
        {
          const std::array<Complex, 3>& corners = coarseCorners[t];
          const Complex piece =
            (to[0] - from[0]) * corners[0] + (to[1] - from[1]) * corners[1] + (to[2] - from[2]) * corners[2];
          overlaps.Add(t, piece, directions[k]);
        });
    }
    overlaps.AppendTo(row);
    if (row.empty())
    {
      // The whole face lies in one point of the coarse mesh: no piece has a direction.
      row.emplace_back(overlaps.Any(), TransportTurn(coarseFrames, overlaps.Any(), fineFrames, face));
    }
  };
  return AssembleMatrix<Complex>(fine.NumberOfFaces(), coarse.NumberOfFaces(), context, appendRow);
}

}
