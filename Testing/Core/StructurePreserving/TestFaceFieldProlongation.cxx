#include "StructurePreserving/Transfers/FaceFieldProlongation.h"

#include "Operators/FaceFieldOperators.h"
#include "StructurePreserving/Decimation/CollapsibleMesh.h"
#include "StructurePreserving/SurfaceHierarchy.h"
#include "StructurePreserving/Transfers/ScalarProlongation.h"
#include "Support/Identities.h"
#include "Support/Levels.h"
#include "Support/MeshFactory.h"
#include "Support/Random.h"
#include "Support/ReferenceOperators.h"
#include "Support/TbbContext.h"

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>

namespace
{

using namespace dmg;
using namespace dmg::test;

/// Calls visit(transition) for the levels of every surface, by both policies.
template <class Visit>
void VisitTransitions(Visit visit, int minimumNumberOfFaces = 60)
{
  HierarchyOptions options;
  options.MinimumNumberOfFaces = minimumNumberOfFaces;
  options.MaximumNumberOfCoarseLevels = 8;
  VisitLevels(SurfacesToDecimate(), options, visit);
}

Vector<double> RandomValues(int size, unsigned seed)
{
  Random random(seed);
  Vector<double> values(size);
  for (double& value : values)
  {
    value = random.Uniform(-1.0, 1.0);
  }
  return values;
}

/// Differences of a function along all halfedges.
Vector<double> Differences(const TriangleMesh& mesh, const Vector<double>& function)
{
  Vector<double> differences(3 * mesh.NumberOfFaces());
  for (int h = 0; h < differences.size(); ++h)
  {
    differences[h] = function[mesh.Head(h)] - function[mesh.Tail(h)];
  }
  return differences;
}

/// Smallest of the sums of squares of what the fine level sees of a coarse face, over directions in
/// it: the least eigenvalues of the 2 x 2 blocks on the diagonal of SX^T diag(A_f) SX, over the
/// area of the coarse face.
Vector<double> SmallestSights(const LevelTransition& transition, const SparseMatrix<double>& SX)
{
  const Vector<double> fineAreas = transition.Fine.FaceAreas();
  std::vector<Eigen::Matrix2d> blocks(transition.Coarse.NumberOfFaces(), Eigen::Matrix2d::Zero());
  for (int r = 0; r < SX.rows(); ++r)
  {
    for (SparseMatrix<double>::InnerIterator a(SX, r); a; ++a)
    {
      for (SparseMatrix<double>::InnerIterator b(SX, r); b; ++b)
      {
        if (a.col() / 2 == b.col() / 2)
        {
          blocks[a.col() / 2](a.col() % 2, b.col() % 2) += fineAreas[r / 2] * a.value() * b.value();
        }
      }
    }
  }
  Vector<double> sights(blocks.size());
  for (std::size_t t = 0; t < blocks.size(); ++t)
  {
    const Eigen::SelfAdjointEigenSolver<Eigen::Matrix2d> solver(blocks[t]);
    sights[t] = solver.eigenvalues()[0] / transition.Coarse.FaceArea(static_cast<int>(t));
  }
  return sights;
}

// G S0 = SX G, and the same along halfedges: SX at exact fields is S1.
TEST(FaceFieldProlongation, CommutesWithTheGradient)
{
  VisitTransitions(
    [](const LevelTransition& transition)
    {
      const TangentFrames fineFrames = FaceFrames(transition.Fine);
      const TangentFrames coarseFrames = FaceFrames(transition.Coarse);
      const SparseMatrix<double> S0 = ScalarProlongation(transition, SerialContext());
      const SparseMatrix<double> SX =
        FaceFieldProlongation(FineEdgePaths(transition), fineFrames, coarseFrames, SerialContext());
      ASSERT_EQ(SX.rows(), 2 * transition.Fine.NumberOfFaces());
      ASSERT_EQ(SX.cols(), 2 * transition.Coarse.NumberOfFaces());
      const SparseMatrix<double> fineG = FaceGradient(transition.Fine, fineFrames);
      const SparseMatrix<double> coarseG = FaceGradient(transition.Coarse, coarseFrames);
      EXPECT_LT(CommutationResidual(SX, coarseG, fineG, S0), 1e-12);

      const Vector<double> function = RandomValues(transition.Coarse.NumberOfVertices(), 3);
      const Vector<double> along = HalfedgeProjection(transition.Fine, fineFrames) * (SX * (coarseG * function));
      EXPECT_LT((along - Differences(transition.Fine, S0 * function)).cwiseAbs().maxCoeff(), 1e-12);
    });
}

// The integrals along the sides of a fine face sum to zero, though the pieces' do not: P P^+ = Q_I.
TEST(FaceFieldProlongation, FiltersTheMeanOutOfThePieces)
{
  VisitTransitions(
    [](const LevelTransition& transition)
    {
      const TriangleMesh& fine = transition.Fine;
      const TangentFrames fineFrames = FaceFrames(fine);
      const TangentFrames coarseFrames = FaceFrames(transition.Coarse);
      const FineEdgePaths paths(transition);
      const SparseMatrix<double> SX = FaceFieldProlongation(paths, fineFrames, coarseFrames, SerialContext());
      const Vector<double> X = RandomValues(static_cast<int>(SX.cols()), 4);
      const Points vectors = VectorsFromFaceField(coarseFrames, X);
      const Vector<double> along = HalfedgeProjection(fine, fineFrames) * (SX * X);
      double worst = 0.0;
      for (int f = 0; f < fine.NumberOfFaces(); ++f)
      {
        Vector3 pieces = Vector3::Zero();
        for (int k = 0; k < 3; ++k)
        {
          paths.VisitPieces(3 * f + k,
            [&](int t, const std::array<double, 3>& from, const std::array<double, 3>& to)
            {
              for (int c = 0; c < 3; ++c)
              {
                pieces[k] += (to[c] - from[c]) *
                  vectors.row(t).dot(transition.Coarse.VertexPositions().row(transition.Coarse.FaceCorners()(t, c)));
              }
            });
        }
        worst = std::max(worst, std::abs(along.segment<3>(3 * f).sum()));
        const Vector3 filtered = pieces.array() - pieces.mean();
        worst = std::max(worst, (along.segment<3>(3 * f) - filtered).cwiseAbs().maxCoeff());
      }
      EXPECT_LT(worst, 1e-12);
    });
}

TEST(FaceFieldProlongation, ReproducesConstantFieldsInAPlane)
{
  const Vector3 direction(0.6, -0.8, 0.0);
  const TriangleMesh mesh = IrregularPlane(48, 40, 15).Mesh();
  HierarchyOptions options;
  options.MinimumNumberOfFaces = 100;
  const SurfaceHierarchy hierarchy = BuildSurfaceHierarchy(mesh, options, SerialContext());
  ASSERT_GE(hierarchy.CoarseLevels.size(), 2u);
  Vector<double> fine = FaceFieldOfVector(FaceFrames(mesh), direction);
  for (std::size_t l = 0; l < hierarchy.CoarseLevels.size(); ++l)
  {
    const Vector<double> coarse = FaceFieldOfVector(FaceFrames(hierarchy.CoarseLevels[l]), direction);
    EXPECT_LT((hierarchy.Operators.SX[l] * coarse - fine).cwiseAbs().maxCoeff(), 1e-9);
    fine = coarse;
  }
}

// Where nothing has been collapsed every face takes its own vector back.
TEST(FaceFieldProlongation, IsTheIdentityWithoutCollapses)
{
  const TriangleMesh mesh = IrregularTorus(24, 12, 3).Mesh();
  const SurfaceTracking tracking(mesh);
  std::vector<int> vertices(mesh.NumberOfVertices());
  std::vector<int> faces(mesh.NumberOfFaces());
  for (int v = 0; v < mesh.NumberOfVertices(); ++v)
  {
    vertices[v] = v;
  }
  for (int f = 0; f < mesh.NumberOfFaces(); ++f)
  {
    faces[f] = f;
  }
  const LevelTransition transition{ mesh, mesh, tracking, vertices, faces };
  const TangentFrames frames = FaceFrames(mesh);
  SparseMatrix<double> identity(2 * mesh.NumberOfFaces(), 2 * mesh.NumberOfFaces());
  identity.setIdentity();
  const SparseMatrix<double> SX = FaceFieldProlongation(FineEdgePaths(transition), frames, frames, SerialContext());
  EXPECT_LT(LargestEntry(SparseMatrix<double>(SX - identity)), 1e-13);
}

TEST(FaceFieldProlongation, StaysFiniteOnZeroAreaFaces)
{
  HierarchyOptions options;
  options.MinimumNumberOfFaces = 100;
  VisitLevels(SphereWithZeroAreaFaces(4, 30).Mesh(), options,
    [](const LevelTransition& transition)
    {
      const SparseMatrix<double> SX = FaceFieldProlongation(
        FineEdgePaths(transition), FaceFrames(transition.Fine), FaceFrames(transition.Coarse), SerialContext());
      EXPECT_TRUE(SX.coeffs().allFinite());
    });
}

TEST(SurfaceHierarchy, BringsFaceFieldsIntoTheCallersOrder)
{
  const Vector3 direction(0.6, -0.8, 0.0);
  const TriangleMesh mesh = Relabel(IrregularPlane(48, 40, 15), 6).Result.Mesh();
  const SurfaceHierarchy hierarchy = BuildSurfaceHierarchy(mesh, HierarchyOptions(), TbbContext(2));
  const SurfaceHierarchy serial = BuildSurfaceHierarchy(mesh, HierarchyOptions(), SerialContext());
  const SparseMatrix<double>& SX = hierarchy.Operators.SX[0];
  const Vector<double> prolonged = SX * FaceFieldOfVector(FaceFrames(hierarchy.CoarseLevels[0]), direction);
  EXPECT_LT((prolonged - FaceFieldOfVector(FaceFrames(mesh), direction)).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_EQ(LargestEntry(SparseMatrix<double>(SX - serial.Operators.SX[0])), 0.0);
}

// The new vertex of a collapse inside an outer triangle of the ring: the coarse face there lies
// within that triangle, and no fine edge is seen from it but the side that both have in common.
TEST(FineEdgePaths, LeadThroughAFaceThatOnlyOneSideShows)
{
  const TriangleMesh fine = PlaneGrid(5, 4).Mesh();
  int h = 0;
  while ((fine.Position(fine.Tail(h)) - Vector3(2.0, 2.0, 0.0)).norm() > 0.1 ||
    (fine.Position(fine.Head(h)) - Vector3(3.0, 2.0, 0.0)).norm() > 0.1)
  {
    ++h;
  }
  const TangentFrames fineFrames = FaceFrames(fine);
  const SparseMatrix<double> A = FaceFieldSmoothness(fine, fineFrames);
  const Vector3 direction(0.6, -0.8, 0.0);
  OneRing ring;
  ASSERT_TRUE(GatherOneRing(CollapsibleMesh(fine), h, ring));
  for (int k = 0; k < ring.NumberOfSectors(); ++k)
  {
    SCOPED_TRACE(k);
    CollapsibleMesh shrinking(fine);
    SurfaceTracking tracking(fine);
    const std::array<int, 3> outer = ring.SectorBefore(k);
    ring.Positions[ring.HubIndex()] =
      (ring.Positions[outer[0]] + ring.Positions[outer[1]] + ring.Positions[outer[2]]) / 3.0;
    std::vector<Complex> plane;
    for (const Vector3& position : ring.Positions)
    {
      plane.emplace_back(position[0], position[1]);
    }
    std::unique_ptr<SurfaceTracking::Worker> worker = tracking.TakeWorker();
    tracking.Move(ring, plane, *worker);
    shrinking.FinishCollapse(shrinking.Collapse(ring));
    const CollapsibleMesh::Compacted coarse = shrinking.Compact();
    const LevelTransition transition{ fine, coarse.Mesh, tracking, coarse.VertexNumber, coarse.FaceNumber };

    // Without the detour: no piece of any length inside.
    double longest = 0.0;
    tracking.VisitPiecesIn(
      ring.Sectors[k].Face, [&](int slotHalfedge) { return shrinking.Tail(slotHalfedge); },
      [&](int, const std::array<double, 3>& from, const std::array<double, 3>& to)
      {
        longest = std::max(longest, std::abs(to[0] - from[0]) + std::abs(to[1] - from[1]));
        return true;
      });
    EXPECT_LT(longest, 1e-12);

    const FineEdgePaths paths(transition);
    EXPECT_GE(paths.NumberOfDetours(), 1);
    const TangentFrames coarseFrames = FaceFrames(coarse.Mesh);
    const SparseMatrix<double> SX = FaceFieldProlongation(paths, fineFrames, coarseFrames, SerialContext());
    EXPECT_GT(SmallestSights(transition, SX).minCoeff(), 1e-3);
    const SparseMatrix<double> coarseA = SparseMatrix<double>(SX.transpose()) * A * SX;
    EXPECT_GT(coarseA.diagonal().minCoeff(), 1e-3 * coarseA.diagonal().maxCoeff());
    // More than the diagonal: the fine level tells all coarse fields apart.
    EXPECT_GT(SymmetricEigenvalues(SparseMatrix<double>(SX.transpose()) * SX)[0], 1e-5);

    EXPECT_LT(CommutationResidual(SX, FaceGradient(coarse.Mesh, coarseFrames), FaceGradient(fine, fineFrames),
                ScalarProlongation(transition, SerialContext())),
      1e-13);
    EXPECT_LT((SX * FaceFieldOfVector(coarseFrames, direction) - FaceFieldOfVector(fineFrames, direction))
                .cwiseAbs()
                .maxCoeff(),
      1e-13);
    tracking.GiveBack(std::move(worker));
  }
}

// The same happens by itself where a surface is decimated until few faces are left (the failures of
// the thesis's table 7.9).
TEST(FineEdgePaths, LeadThroughEveryCoarseFace)
{
  int detours = 0;
  VisitTransitions(
    [&](const LevelTransition& transition)
    {
      const TangentFrames fineFrames = FaceFrames(transition.Fine);
      const TangentFrames coarseFrames = FaceFrames(transition.Coarse);
      const FineEdgePaths paths(transition);
      const SparseMatrix<double> SX = FaceFieldProlongation(paths, fineFrames, coarseFrames, SerialContext());
      detours += paths.NumberOfDetours();
      EXPECT_GT(SmallestSights(transition, SX).minCoeff(), 1e-7);
    },
    8);
  EXPECT_GT(detours, 0) << "no face was weak before: the test tests nothing";
}

}
