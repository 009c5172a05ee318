#include "StructurePreserving/Transfers/PathDetours.h"

#include "StructurePreserving/Transfers/FineEdgePaths.h"

#include <algorithm>
#include <cmath>
#include <unordered_map>
#include <utility>
#include <vector>

namespace dmg
{

namespace
{

/// The least share of a piece in every direction, squared, that a face must hold. With the face
/// drawn as an equilateral triangle with sides of length sqrt 2, one piece along a side counts 2.
constexpr double SmallestCoverage = 1e-4;

/// A detour of less than this share of the side would leave the face weak.
constexpr double SmallestDetour = 0.02;

/// A piece with its face drawn equilateral, so that no shape of the face counts as lack of cover.
Vector2 InEquilateral(const std::array<double, 3>& from, const std::array<double, 3>& to)
{
  const double d0 = to[0] - from[0];
  const double d1 = to[1] - from[1];
  const double d2 = to[2] - from[2];
  return { (d0 - d1) / std::sqrt(2.0), (d0 + d1 - 2.0 * d2) / std::sqrt(6.0) };
}

/// The side k of any face, from its corner k to the next.
Vector2 SideInEquilateral(int k)
{
  std::array<double, 3> from{ 0.0, 0.0, 0.0 };
  std::array<double, 3> to{ 0.0, 0.0, 0.0 };
  from[k] = 1.0;
  to[(k + 1) % 3] = 1.0;
  return InEquilateral(from, to);
}

/// The foot of a place of an equilateral face on one of its halfedges, in [0, 1].
double FootOnHalfedge(int halfedge, const std::array<double, 3>& place)
{
  return place[(halfedge + 1) % 3] + 0.5 * place[(halfedge + 2) % 3];
}

/// Sum of p p^T over pieces: in which directions a face is seen.
class Coverage
{
public:
  void Add(const Vector2& p)
  {
    this->XX += p[0] * p[0];
    this->XY += p[0] * p[1];
    this->YY += p[1] * p[1];
  }
  bool IsWeak() const
  {
    return 0.5 * (this->XX + this->YY) - std::hypot(0.5 * (this->XX - this->YY), this->XY) < SmallestCoverage;
  }
  /// The direction that is seen least.
  Vector2 Missing() const
  {
    const double angle = 0.5 * std::atan2(2.0 * this->XY, this->XX - this->YY); // seen most
    return { -std::sin(angle), std::cos(angle) };
  }

private:
  double XX = 0.0;
  double XY = 0.0;
  double YY = 0.0;
};

class Detours
{
public:
  explicit Detours(FineEdgePaths& paths)
    : Paths(paths)
  {
  }

  void Make(const ExecutionContext& context)
  {
    // A face may get cover only after a neighbour has got some, which may then need some anew.
    std::vector<int> weak = this->FindWeakFaces(context);
    int before = -1;
    while (this->Paths.NumberOfDetours() > before)
    {
      before = this->Paths.NumberOfDetours();
      std::vector<int> next;
      for (int face : weak)
      {
        if (!this->Cover(face, next))
        {
          next.push_back(face);
        }
      }
      weak = std::move(next);
    }
  }

private:
  /// A piece that could lead into the face of a side, and between which places of its twin.
  struct Candidate
  {
    FineEdgePaths::PieceOfEdge Piece{};
    int Side = -1;
    double From = 0.0;
    double To = 0.0;
  };

  std::vector<int> FindWeakFaces(const ExecutionContext& context) const
  {
    constexpr int Grain = 1024;
    const int faces = this->Paths.Coarse().NumberOfFaces();
    std::vector<char> isWeak(faces);
    context.ParallelFor(0, faces, Grain,
      [&](int first, int last)
      {
        for (int face = first; face < last; ++face)
        {
          Coverage coverage;
          this->Paths.VisitTrackedPiecesIn(face,
            [&coverage](const std::array<double, 3>& from, const std::array<double, 3>& to)
            {
              coverage.Add(InEquilateral(from, to));
              return coverage.IsWeak();
            });
          isWeak[face] = coverage.IsWeak();
        }
      });
    std::vector<int> weak;
    for (int face = 0; face < faces; ++face)
    {
      if (isWeak[face])
      {
        weak.push_back(face);
      }
    }
    return weak;
  }

  /// The coverage of a coarse face by edges that are not reserved for others.
  Coverage CoverageOf(int coarseFace, int withoutEdge = -1) const
  {
    Coverage coverage;
    for (const FineEdgePaths::PieceOfEdge& piece : this->Paths.PiecesIn(coarseFace))
    {
      const auto reserved = this->ReservedFor.find(piece.Edge);
      if (piece.Edge != withoutEdge && (reserved == this->ReservedFor.end() || reserved->second == coarseFace))
      {
        coverage.Add(InEquilateral(piece.From, piece.To));
      }
    }
    return coverage;
  }

  /// Returns whether the face is covered in all directions now; adds neighbours that no longer are.
  bool Cover(int coarseFace, std::vector<int>& robbed)
  {
    Coverage coverage = this->CoverageOf(coarseFace);
    while (coverage.IsWeak())
    {
      const Candidate candidate = this->BestCandidate(coarseFace, coverage.Missing());
      if (candidate.Side < 0)
      {
        return false;
      }
      // Half of the piece's way along the side goes through the face.
      this->Paths.Bend(candidate.Piece, candidate.Side, 0.75 * candidate.From + 0.25 * candidate.To,
        0.25 * candidate.From + 0.75 * candidate.To);
      this->ReservedFor[candidate.Piece.Edge] = coarseFace;
      const int neighbour = TriangleMesh::FaceOf(this->Paths.Coarse().Twin(candidate.Side));
      if (this->CoverageOf(neighbour).IsWeak())
      {
        robbed.push_back(neighbour);
      }
      coverage = this->CoverageOf(coarseFace);
    }
    return true;
  }

  /// The piece in a neighbour whose detour shows most of the missing direction. Edges that the
  /// neighbour can do without come first.
  Candidate BestCandidate(int coarseFace, const Vector2& missing) const
  {
    Candidate best;
    double most = 0.0;
    bool bestIsSpare = false;
    for (int k = 0; k < 3; ++k)
    {
      const int side = 3 * coarseFace + k;
      const int twin = this->Paths.Coarse().Twin(side);
      if (twin < 0)
      {
        continue;
      }
      const int neighbour = TriangleMesh::FaceOf(twin);
      const double share = std::abs(SideInEquilateral(k).normalized().dot(missing));
      for (const FineEdgePaths::PieceOfEdge& piece : this->Paths.PiecesIn(neighbour))
      {
        const double start = FootOnHalfedge(twin, piece.From);
        const double end = FootOnHalfedge(twin, piece.To);
        const double amount = share * std::abs(end - start);
        if (amount <= SmallestDetour || this->ReservedFor.count(piece.Edge) > 0)
        {
          continue;
        }
        const bool isSpare = !this->CoverageOf(neighbour, piece.Edge).IsWeak();
        if (isSpare != bestIsSpare ? isSpare : amount > most)
        {
          most = amount;
          bestIsSpare = isSpare;
          best = { piece, side, start, end };
        }
      }
    }
    return best;
  }

  FineEdgePaths& Paths;
  std::unordered_map<int, int> ReservedFor; // edges whose one value shows a face that was hidden
};

}

void MakeDetours(FineEdgePaths& paths, const ExecutionContext& context)
{
  Detours(paths).Make(context);
}

}
