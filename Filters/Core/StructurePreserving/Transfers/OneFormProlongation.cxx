#include "StructurePreserving/Transfers/OneFormProlongation.h"

#include "Support/SparseAssembly.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace dmg
{

namespace
{

/// The size of entries below which a coarse edge counts as unseen: their squares are lost in rounding.
constexpr double SmallestEntry = 1e-6;

/// Columns without an entry of some size.
std::vector<int> UnseenEdges(const SparseMatrix<double>& S1)
{
  std::vector<char> isSeen(S1.cols(), 0);
  for (Eigen::Index i = 0; i < S1.nonZeros(); ++i)
  {
    if (std::abs(S1.valuePtr()[i]) > SmallestEntry)
    {
      isSeen[S1.innerIndexPtr()[i]] = 1;
    }
  }
  std::vector<int> unseen;
  for (int edge = 0; edge < S1.cols(); ++edge)
  {
    if (!isSeen[edge])
    {
      unseen.push_back(edge);
    }
  }
  return unseen;
}

/// Finds fine edges that can make a detour, each once.
class Detours
{
public:
  explicit Detours(const FineEdgePaths& paths)
    : Coarse(paths.Coarse())
    , EdgesOnFace(paths.Coarse().NumberOfFaces())
    , IsTaken(paths.Fine().NumberOfEdges(), 0)
  {
    for (int edge = 0; edge < paths.Fine().NumberOfEdges(); ++edge)
    {
      paths.VisitPieces(paths.Fine().HalfedgeOf(edge),
        [this, edge](int face, const auto&, const auto&) { this->EdgesOnFace[face].push_back(edge); });
    }
  }

  /// A fine edge with a path over a coarse face, or over the nearest one that has any left; -1
  /// where there are none.
  int TakeEdgeNear(int coarseFace)
  {
    std::vector<int> queue = { coarseFace };
    std::vector<char> isQueued(this->Coarse.NumberOfFaces(), 0);
    isQueued[coarseFace] = 1;
    for (std::size_t next = 0; next < queue.size(); ++next)
    {
      const int face = queue[next];
      for (int edge : this->EdgesOnFace[face])
      {
        if (!this->IsTaken[edge])
        {
          this->IsTaken[edge] = 1;
          return edge;
        }
      }
      for (int h = 3 * face; h < 3 * face + 3; ++h)
      {
        const int twin = this->Coarse.Twin(h);
        if (twin >= 0 && !isQueued[TriangleMesh::FaceOf(twin)])
        {
          isQueued[TriangleMesh::FaceOf(twin)] = 1;
          queue.push_back(TriangleMesh::FaceOf(twin));
        }
      }
    }
    return -1;
  }

private:
  const TriangleMesh& Coarse;
  std::vector<std::vector<int>> EdgesOnFace;
  std::vector<char> IsTaken; // per fine edge
};

/// Lets some path see every coarse edge.
///
/// A detour within a coarse face changes the integral by the curl of the face, which is constant,
/// times the area that it encloses; so would a loop around the face anywhere along the path, there
/// and back by the same way. Here it encloses half of the face.
void BendPathsToUnseenEdges(const FineEdgePaths& paths, SparseMatrix<double>& S1)
{
  constexpr double Enclosed = 0.5;
  std::vector<int> unseen = UnseenEdges(S1);
  if (unseen.empty())
  {
    return;
  }
  const TriangleMesh& coarse = paths.Coarse();
  Detours detours(paths);
  // A detour could take back the only entry of another edge: hence until all are seen.
  for (; !unseen.empty(); unseen = UnseenEdges(S1))
  {
    std::vector<Eigen::Triplet<double>> changes;
    for (int coarseEdge : unseen)
    {
      const int face = TriangleMesh::FaceOf(coarse.HalfedgeOf(coarseEdge));
      const int fineEdge = detours.TakeEdgeNear(face);
      if (fineEdge < 0)
      {
        return; // fewer fine edges than unseen coarse ones: not a coarsening
      }
      for (int h = 3 * face; h < 3 * face + 3; ++h)
      {
        changes.emplace_back(fineEdge, coarse.EdgeOf(h), Enclosed * coarse.EdgeSign(h));
      }
    }
    SparseMatrix<double> change(S1.rows(), S1.cols());
    change.setFromTriplets(changes.begin(), changes.end());
    S1 = SparseMatrix<double>(S1 + change);
  }
}

}

SparseMatrix<double> OneFormProlongation(const FineEdgePaths& paths, const ExecutionContext& context)
{
  const TriangleMesh& fine = paths.Fine();
  const TriangleMesh& coarse = paths.Coarse();

  SparseMatrix<double> S1 = AssembleMatrix<double>(fine.NumberOfEdges(), coarse.NumberOfEdges(), context,
    [&](int edge, RowEntries<double>& row)
    {
      const int halfedge = fine.HalfedgeOf(edge);
      const double sign = fine.EdgeSign(halfedge);
      paths.VisitPieces(halfedge,
        [&](int face, const std::array<double, 3>& p, const std::array<double, 3>& q)
        {
          for (int i = 0; i < 3; ++i)
          {
            const int j = (i + 1) % 3;
            const int side = 3 * face + i;
            const double value = p[i] * q[j] - p[j] * q[i];
            if (value != 0.0)
            {
              AddTo(row, coarse.EdgeOf(side), sign * coarse.EdgeSign(side) * value);
            }
          }
        });
      row.erase(std::remove_if(row.begin(), row.end(), [](const auto& e) { return e.second == 0.0; }), row.end());
    });
  BendPathsToUnseenEdges(paths, S1);
  return S1;
}

}
