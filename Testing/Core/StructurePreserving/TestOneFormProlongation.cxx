#include "StructurePreserving/Transfers/OneFormProlongation.h"

#include "Mesh/SpatialOrder.h"
#include "Operators/ExteriorCalculus.h"
#include "StructurePreserving/Decimation/MeshHierarchy.h"
#include "StructurePreserving/SurfaceHierarchy.h"
#include "StructurePreserving/Transfers/ScalarProlongation.h"
#include "Support/Identities.h"
#include "Support/Levels.h"
#include "Support/MeshFactory.h"
#include "Support/ReferenceOperators.h"
#include "Support/TbbContext.h"

#include <Eigen/Eigenvalues>
#include <gtest/gtest.h>

#include <map>
#include <numeric>

using namespace dmg;
using namespace dmg::test;

namespace
{

std::vector<NamedSurface> Surfaces()
{
  std::vector<NamedSurface> surfaces = SurfacesToDecimate();
  surfaces.push_back({ "zero-area faces", SphereWithZeroAreaFaces(3, 12) });
  return surfaces;
}

bool IsClosed(const TriangleMesh& mesh)
{
  return 2 * mesh.NumberOfEdges() == 3 * mesh.NumberOfFaces();
}

/// Calls visit(transition, S1) for the levels of surfaces, by both policies.
template <class Visit>
void VisitOperators(const std::vector<NamedSurface>& surfaces, int minimumNumberOfFaces, Visit visit)
{
  HierarchyOptions options;
  options.MinimumNumberOfFaces = minimumNumberOfFaces;
  options.MaximumNumberOfCoarseLevels = 6;
  VisitLevels(surfaces, options,
    [&visit](const LevelTransition& transition)
    { visit(transition, OneFormProlongation(FineEdgePaths(transition), SerialContext())); });
}

/// Closed forms that represent the cohomology of a surface: the kernel of its Laplacian.
Eigen::MatrixXd HarmonicForms(const TriangleMesh& mesh, int dimension)
{
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> solver(Eigen::MatrixXd(OneFormLaplacian(mesh, SerialContext())));
  return solver.eigenvectors().leftCols(dimension);
}

/// A vector a + b J p at p, integrated along straight edges: the fields that Whitney forms contain.
Vector<double> ConstantPlusRotation(const TriangleMesh& mesh, const Vector3& a, double b)
{
  Vector<double> form(mesh.NumberOfEdges());
  for (int edge = 0; edge < mesh.NumberOfEdges(); ++edge)
  {
    const Vector3 tail = mesh.Position(mesh.EdgeVertices(edge)[0]);
    const Vector3 head = mesh.Position(mesh.EdgeVertices(edge)[1]);
    form[edge] = a.dot(head - tail) + b * tail.cross(head).z();
  }
  return form;
}

}

TEST(OneFormProlongation, ExactFormsStayExact)
{
  VisitOperators(Surfaces(), 60,
    [](const LevelTransition& transition, const SparseMatrix<double>& S1)
    {
      ASSERT_EQ(S1.rows(), transition.Fine.NumberOfEdges());
      ASSERT_EQ(S1.cols(), transition.Coarse.NumberOfEdges());
      const SparseMatrix<double> S0 = ScalarProlongation(transition, SerialContext());
      EXPECT_LT(ExactnessResidual(transition.Fine, transition.Coarse, S0, S1), 1e-14);
      EXPECT_EQ((S1.coeffs() == 0.0).count(), 0);
      EXPECT_LT(S1.nonZeros(), 7 * S1.rows());
      EXPECT_GT(WeakestColumn(S1), 1e-3);
    });
}

// Also forms that no function has: around both circles of a torus, so thin and so coarse that a path
// with no more than the right ends would pass on the wrong side, and around four of genus 2.
TEST(OneFormProlongation, ClosedFormsStayClosed)
{
  const auto expectClosed = [](const NamedSurface& surface, int dimension, int coarsest)
  {
    int fewestFaces = surface.Shape.F.rows();
    VisitOperators({ surface }, coarsest,
      [&](const LevelTransition& transition, const SparseMatrix<double>& S1)
      {
        fewestFaces = std::min(fewestFaces, transition.Coarse.NumberOfFaces());
        if (transition.Coarse.NumberOfFaces() > 600)
        {
          return; // the forms come from a dense matrix
        }
        const Eigen::MatrixXd forms = HarmonicForms(transition.Coarse, dimension);
        for (int k = 0; k < dimension; ++k)
        {
          const Vector<double> z = forms.col(k);
          ASSERT_LT((D1(transition.Coarse) * z).cwiseAbs().maxCoeff(), 1e-11);
          EXPECT_LT(ClosednessResidual(transition.Fine, S1, z), 1e-11);
        }
      });
    EXPECT_LT(fewestFaces, 150);
  };
  expectClosed({ "thin torus", IrregularTorus(200, 7, 12, 1.0, 0.08) }, 2, 100);
  expectClosed({ "double torus", DoubleTorus(5) }, 4, 100);
  expectClosed({ "annulus", Annulus(60, 16) }, 1, 60);
}

// In a plane the places of fine edges on coarse triangles are the edges themselves, so what the Whitney
// interpolant contains comes out exactly; with b = 1/2 the curl of every fine face is its area.
TEST(OneFormProlongation, ReproducesConstantsAndRotationsInAPlane)
{
  const Vector3 a(0.3, -1.1, 0.0);
  HierarchyOptions options;
  options.MinimumNumberOfFaces = 100;
  VisitLevels(IrregularPlane(40, 30, 9).Mesh(), options,
    [&a](const LevelTransition& transition)
    {
      const TriangleMesh& fine = transition.Fine;
      const SparseMatrix<double> S1 = OneFormProlongation(FineEdgePaths(transition), SerialContext());
      const Vector<double> prolonged = S1 * ConstantPlusRotation(transition.Coarse, a, 0.5);
      EXPECT_LT(RelativeDifference(prolonged, ConstantPlusRotation(fine, a, 0.5)), 1e-12);
      EXPECT_LT((D1(fine) * prolonged - fine.FaceAreas()).cwiseAbs().maxCoeff(), 1e-11);
      EXPECT_LT(TotalCurlResidual(fine, transition.Coarse, S1), 1e-12);
    });
}

// No more than that both sides of an edge carry opposite values; with a boundary that is kept, the plane
// above shows more.
TEST(OneFormProlongation, KeepsTheTotalCurlOfClosedSurfaces)
{
  int closed = 0;
  VisitOperators(Surfaces(), 60,
    [&closed](const LevelTransition& transition, const SparseMatrix<double>& S1)
    {
      if (IsClosed(transition.Fine))
      {
        ++closed;
        EXPECT_LT(TotalCurlResidual(transition.Fine, transition.Coarse, S1), 1e-13);
      }
    });
  EXPECT_GT(closed, 0);
}

// A coarse surface with two triangles that the fine one does not reach, one behind the other: nothing
// runs over four of its edges, and the nearest path to the outer triangle is two faces away.
TEST(OneFormProlongation, LetsSomePathSeeEveryCoarseEdge)
{
  const Surface fineSurface = PlaneGrid(4, 3);
  Surface coarseSurface = fineSurface;
  const int vertices = static_cast<int>(fineSurface.V.rows());
  const int faces = static_cast<int>(fineSurface.F.rows());
  coarseSurface.V.conservativeResize(vertices + 2, 3);
  coarseSurface.V.bottomRows(2) << 0.5, -1.0, 0.0, 1.5, -1.0, 0.0;
  coarseSurface.F.conservativeResize(faces + 2, 3);
  coarseSurface.F.bottomRows(2) << 1, 0, vertices, 1, vertices, vertices + 1;
  const TriangleMesh fine = fineSurface.Mesh();
  const TriangleMesh coarse = coarseSurface.Mesh();
  ASSERT_EQ(coarse.NumberOfEdges(), fine.NumberOfEdges() + 4);

  const SurfaceTracking tracking(fine);
  std::vector<int> coarseVertex(vertices);
  std::vector<int> coarseFace(faces);
  std::iota(coarseVertex.begin(), coarseVertex.end(), 0);
  std::iota(coarseFace.begin(), coarseFace.end(), 0);
  const LevelTransition transition{ fine, coarse, tracking, coarseVertex, coarseFace };

  const SparseMatrix<double> S1 = OneFormProlongation(FineEdgePaths(transition), SerialContext());
  EXPECT_GE(WeakestColumn(S1), 0.5);
  const SparseMatrix<double> S0 = ScalarProlongation(transition, SerialContext());
  EXPECT_LT(ExactnessResidual(fine, coarse, S0, S1), 1e-15);
  // Three rows at least have changed, no more than one per unseen edge: the others are those of edges
  // that run along their coarse edges.
  int single = 0;
  for (int row = 0; row < S1.rows(); ++row)
  {
    single += S1.row(row).nonZeros() == 1 ? 1 : 0;
  }
  EXPECT_GE(single, S1.rows() - 4);
}

TEST(OneFormProlongation, HasTheSameBitsForAnyNumberOfThreads)
{
  HierarchyOptions options;
  options.MaximumNumberOfCoarseLevels = 1;
  VisitLevels(IrregularTorus(96, 48, 21).Mesh(), options,
    [](const LevelTransition& transition)
    {
      const SparseMatrix<double> expected = OneFormProlongation(FineEdgePaths(transition), SerialContext());
      EXPECT_EQ(RelativeDifference(OneFormProlongation(FineEdgePaths(transition), TbbContext(3)), expected), 0.0);
    });
}

// Rows of level 0 stand in the caller's numbers and orientations of edges. The second way to them goes
// by pairs of vertices.
TEST(SurfaceHierarchy, HasOneFormsInTheCallersNumbering)
{
  for (const Surface& surface :
    { Relabel(IrregularSphere(4, 3), 8).Result, Relabel(IrregularPlane(40, 30, 5), 9).Result })
  {
    const TriangleMesh mesh = surface.Mesh();
    HierarchyOptions options;
    options.MinimumNumberOfFaces = 100;
    const SurfaceHierarchy hierarchy = BuildSurfaceHierarchy(mesh, options, SerialContext());
    const ProlongationOperators& operators = hierarchy.Operators;
    ASSERT_EQ(operators.S1.size(), hierarchy.CoarseLevels.size());
    EXPECT_EQ(operators.NumbersOfEdges[0], mesh.NumberOfEdges());
    for (std::size_t l = 0; l < operators.S1.size(); ++l)
    {
      const TriangleMesh& fine = l == 0 ? mesh : hierarchy.CoarseLevels[l - 1];
      const TriangleMesh& coarse = hierarchy.CoarseLevels[l];
      EXPECT_EQ(operators.NumbersOfEdges[l + 1], coarse.NumberOfEdges());
      EXPECT_LT(ExactnessResidual(fine, coarse, operators.S0[l], operators.S1[l]), 1e-14);
    }

    std::map<std::array<int, 2>, int> edges;
    for (int edge = 0; edge < mesh.NumberOfEdges(); ++edge)
    {
      edges[mesh.EdgeVertices(edge)] = edge;
    }
    const SpatialOrder order(mesh.VertexPositions(), mesh.FaceCorners(), SerialContext());
    const TriangleMesh sorted = order.Apply(mesh.VertexPositions(), mesh.FaceCorners(), SerialContext());
    options.MaximumNumberOfCoarseLevels = 1;
    VisitLevels(sorted, options,
      [&](const LevelTransition& transition)
      {
        const SparseMatrix<double> S1 = OneFormProlongation(FineEdgePaths(transition), SerialContext());
        for (int edge = 0; edge < mesh.NumberOfEdges(); ++edge)
        {
          const int tail = order.Vertices()[transition.Fine.EdgeVertices(edge)[0]];
          const int head = order.Vertices()[transition.Fine.EdgeVertices(edge)[1]];
          const int old = edges.at({ std::min(tail, head), std::max(tail, head) });
          const double sign = tail < head ? 1.0 : -1.0;
          const Eigen::RowVectorXd difference =
            Eigen::RowVectorXd(operators.S1[0].row(old)) - sign * Eigen::RowVectorXd(S1.row(edge));
          ASSERT_EQ(difference.cwiseAbs().maxCoeff(), 0.0);
        }
      });
  }
}
