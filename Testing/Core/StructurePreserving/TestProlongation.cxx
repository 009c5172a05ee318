#include "StructurePreserving/Decimation/MeshHierarchy.h"
#include "StructurePreserving/SurfaceHierarchy.h"
#include "StructurePreserving/Transfers/FineEdgePaths.h"
#include "StructurePreserving/Transfers/PowerFieldProlongation.h"
#include "StructurePreserving/Transfers/ScalarProlongation.h"
#include "Support/Identities.h"
#include "Support/Levels.h"
#include "Support/MeshFactory.h"
#include "Support/Random.h"
#include "Support/TbbContext.h"

#include <gtest/gtest.h>

#include <cmath>
#include <string>

using namespace dmg;
using namespace dmg::test;

namespace
{

/// Calls visit(transition) for the levels of every surface, by both policies.
template <class Visit>
void VisitTransitions(Visit visit)
{
  HierarchyOptions options;
  options.MinimumNumberOfFaces = 60;
  VisitLevels(SurfacesToDecimate(), options, visit);
}

double At(
  const LevelTransition& transition, const Vector<double>& function, int face, const std::array<double, 3>& weights)
{
  double value = 0.0;
  for (int k = 0; k < 3; ++k)
  {
    value += weights[k] * function[transition.Coarse.FaceCorners()(face, k)];
  }
  return value;
}

/// The Whitney form of coarse edge values along a piece. Thesis, section 4.2.
double WhitneyAlong(const TriangleMesh& coarse, const std::vector<double>& form, int face,
  const std::array<double, 3>& from, const std::array<double, 3>& to)
{
  double value = 0.0;
  for (int k = 0; k < 3; ++k)
  {
    const int h = 3 * face + k;
    const int next = (k + 1) % 3;
    value += coarse.EdgeSign(h) * form[coarse.EdgeOf(h)] * (from[k] * to[next] - from[next] * to[k]);
  }
  return value;
}

}

TEST(ScalarProlongation, HasRowsOfWeights)
{
  VisitTransitions(
    [](const LevelTransition& transition)
    {
      const SparseMatrix<double> S0 = ScalarProlongation(transition, SerialContext());
      ASSERT_EQ(S0.rows(), transition.Fine.NumberOfVertices());
      ASSERT_EQ(S0.cols(), transition.Coarse.NumberOfVertices());
      EXPECT_LT(RowSumResidual(S0), 4 * MachinePrecision);
      EXPECT_GE(SmallestEntry(S0), 0.0);
      EXPECT_LE(S0.nonZeros(), 3 * S0.rows());
    });
}

TEST(ScalarProlongation, KeepsTheBoundaryOnTheBoundary)
{
  VisitTransitions(
    [](const LevelTransition& transition)
    {
      const SparseMatrix<double> S0 = ScalarProlongation(transition, SerialContext());
      for (int v = 0; v < transition.Fine.NumberOfVertices(); ++v)
      {
        if (transition.Fine.IsBoundaryVertex(v))
        {
          for (SparseMatrix<double>::InnerIterator entry(S0, v); entry; ++entry)
          {
            EXPECT_TRUE(transition.Coarse.IsBoundaryVertex(static_cast<int>(entry.col())));
          }
        }
      }
    });
}

// In a plane, the place of a fine vertex on the coarse mesh is the vertex itself.
TEST(ScalarProlongation, ReproducesLinearFunctionsInAPlane)
{
  HierarchyOptions options;
  options.MinimumNumberOfFaces = 100;
  VisitLevels(IrregularPlane(40, 30, 9).Mesh(), options,
    [](const LevelTransition& transition)
    {
      const SparseMatrix<double> S0 = ScalarProlongation(transition, SerialContext());
      const Points places = S0 * transition.Coarse.VertexPositions();
      int exact = 0;
      for (int v = 0; v < transition.Fine.NumberOfVertices(); ++v)
      {
        exact += (places.row(v) - transition.Fine.VertexPositions().row(v)).norm() < 1e-9 ? 1 : 0;
      }
      EXPECT_EQ(exact, transition.Fine.NumberOfVertices());
    });
}

// The pieces of an edge join from end to end: the differences of a coarse function along them add up to
// the difference of its prolongation. This is d0 S0 = S1 d0.
TEST(FineEdgePaths, JoinTheEndsOfTheirEdges)
{
  VisitTransitions(
    [](const LevelTransition& transition)
    {
      Random random(5);
      Vector<double> function(transition.Coarse.NumberOfVertices());
      for (double& value : function)
      {
        value = random.Uniform(-1.0, 1.0);
      }
      const Vector<double> prolonged = ScalarProlongation(transition, SerialContext()) * function;
      const FineEdgePaths paths(transition);
      double worst = 0.0;
      for (int h = 0; h < 3 * transition.Fine.NumberOfFaces(); ++h)
      {
        const double tail = prolonged[transition.Fine.Tail(h)];
        const double head = prolonged[transition.Fine.Head(h)];
        double sum = 0.0;
        double position = tail;
        paths.VisitPieces(h,
          [&](int face, const std::array<double, 3>& from, const std::array<double, 3>& to)
          {
            const double start = At(transition, function, face, from);
            const double end = At(transition, function, face, to);
            sum += end - start;
            if (transition.Fine.EdgeSign(h) > 0) // only these pieces come in order
            {
              worst = std::max(worst, std::abs(start - position));
              position = end;
            }
          });
        if (transition.Fine.EdgeSign(h) > 0)
        {
          worst = std::max(worst, std::abs(position - head));
        }
        worst = std::max(worst, std::abs(sum - (head - tail)));
      }
      EXPECT_LT(worst, 64 * MachinePrecision);
    });
}

// Closed forms that are not exact stay closed, also where the torus is so thin and so coarse that a
// path that is right only at its ends would pass on the wrong side: the angle around the axis, made
// single-valued on each edge.
TEST(FineEdgePaths, KeepClosedFormsClosed)
{
  const double pi = std::acos(-1.0);
  for (const Surface& surface : { IrregularTorus(64, 24, 11), IrregularTorus(200, 7, 12, 1.0, 0.08) })
  {
    HierarchyOptions options;
    options.MinimumNumberOfFaces = 100;
    options.MaximumNumberOfCoarseLevels = 5;
    VisitLevels(surface.Mesh(), options,
      [&](const LevelTransition& transition)
      {
        const TriangleMesh& coarse = transition.Coarse;
        std::vector<double> form(coarse.NumberOfEdges());
        for (int e = 0; e < coarse.NumberOfEdges(); ++e)
        {
          const auto [a, b] = coarse.EdgeVertices(e);
          const auto angle = [&](int v) { return std::atan2(coarse.Position(v)[1], coarse.Position(v)[0]); };
          form[e] = std::remainder(angle(b) - angle(a), 2.0 * pi);
        }
        for (int f = 0; f < coarse.NumberOfFaces(); ++f)
        {
          double curl = 0.0;
          for (int h = 3 * f; h < 3 * f + 3; ++h)
          {
            curl += coarse.EdgeSign(h) * form[coarse.EdgeOf(h)];
          }
          ASSERT_LT(std::abs(curl), 1e-12) << "the test's own form is not closed";
        }
        const FineEdgePaths paths(transition);
        double worst = 0.0;
        for (int f = 0; f < transition.Fine.NumberOfFaces(); ++f)
        {
          double curl = 0.0;
          for (int h = 3 * f; h < 3 * f + 3; ++h)
          {
            paths.VisitPieces(h,
              [&](int face, const std::array<double, 3>& from, const std::array<double, 3>& to)
              { curl += WhitneyAlong(coarse, form, face, from, to); });
          }
          worst = std::max(worst, std::abs(curl));
        }
        EXPECT_LT(worst, 1e-13);
      });
  }
}

TEST(PowerFieldProlongation, HasRowsOfWeightOne)
{
  VisitTransitions(
    [](const LevelTransition& transition)
    {
      const TransportOperator SP = PowerFieldProlongation(
        FineEdgePaths(transition), FaceFrames(transition.Fine), FaceFrames(transition.Coarse), SerialContext());
      ASSERT_EQ(SP.rows(), transition.Fine.NumberOfFaces());
      ASSERT_EQ(SP.cols(), transition.Coarse.NumberOfFaces());
      EXPECT_LT(RowSumResidual(SP.cwiseAbs()), 16 * MachinePrecision);
    });
}

// On a flat patch a constant field is the same in every frame, and prolonging it is exact, for every
// N. So is the linear hierarchy, from level to level.
TEST(PowerFieldProlongation, ReproducesConstantFieldsInAPlane)
{
  const Vector3 direction = Vector3(0.6, -0.8, 0.0);
  const TriangleMesh mesh = IrregularPlane(48, 40, 15).Mesh();
  HierarchyOptions options;
  options.MinimumNumberOfFaces = 100;
  const SurfaceHierarchy hierarchy = BuildSurfaceHierarchy(mesh, options, SerialContext());
  ASSERT_GE(hierarchy.CoarseLevels.size(), 2u);
  for (int N = 1; N <= 8; ++N)
  {
    Vector<Complex> fineFaces = PowersOfDirection(FaceFrames(mesh), direction, N);
    Vector<Complex> fineVertices;
    for (std::size_t l = 0; l < hierarchy.CoarseLevels.size(); ++l)
    {
      const TriangleMesh& coarse = hierarchy.CoarseLevels[l];
      const Vector<Complex> faces = PowersOfDirection(FaceFrames(coarse), direction, N);
      const Vector<Complex> vertices = PowersOfDirection(VertexFrames(coarse), direction, N);

      const Vector<Complex> prolonged = OnPowers(hierarchy.Operators.SP[l], N) * faces;
      EXPECT_LT(RelativeDifference(prolonged, fineFaces), 1e-9 * N) << "level " << l;

      const Vector<Complex> linear = OnPowers(hierarchy.Operators.Linear[l], N) * vertices;
      EXPECT_LT(RelativeDifference(linear, l == 0 ? fineFaces : fineVertices), 1e-12 * N);
      fineFaces = faces;
      fineVertices = vertices;
    }
  }
}

// Turning the frames turns the operator with them: (turned SP) = diag(e^-ia) SP diag(e^ib).
TEST(PowerFieldProlongation, DoesNotDependOnTheFrames)
{
  HierarchyOptions options;
  options.MinimumNumberOfFaces = 100;
  options.MaximumNumberOfCoarseLevels = 1;
  VisitLevels(IrregularTorus(48, 20, 3).Mesh(), options,
    [](const LevelTransition& transition)
    {
      Random random(17);
      std::vector<double> fineAngles(transition.Fine.NumberOfFaces());
      std::vector<double> coarseAngles(transition.Coarse.NumberOfFaces());
      for (double& angle : fineAngles)
      {
        angle = random.Uniform(-3.0, 3.0);
      }
      for (double& angle : coarseAngles)
      {
        angle = random.Uniform(-3.0, 3.0);
      }
      const TangentFrames fine = FaceFrames(transition.Fine);
      const TangentFrames coarse = FaceFrames(transition.Coarse);
      const SparseMatrix<Complex> plain =
        OnPowers(PowerFieldProlongation(FineEdgePaths(transition), fine, coarse, SerialContext()), 4);
      const SparseMatrix<Complex> turned =
        OnPowers(PowerFieldProlongation(
                   FineEdgePaths(transition), Turned(fine, fineAngles), Turned(coarse, coarseAngles), SerialContext()),
          4);
      const Vector<Complex> field = random.Numbers(transition.Coarse.NumberOfFaces());
      EXPECT_LT(RelativeDifference(
                  turned * InTurnedFrames(field, coarseAngles, 4), InTurnedFrames(plain * field, fineAngles, 4)),
        1e-13);
    });
}

TEST(SurfaceHierarchy, HasTheSameBitsForAnyNumberOfThreads)
{
  const TriangleMesh mesh = IrregularTorus(96, 48, 21).Mesh();
  const HierarchyOptions options;
  const ProlongationOperators expected = BuildSurfaceHierarchy(mesh, options, SerialContext()).Operators;
  const auto same = [](const auto& a, const auto& b)
  {
    ASSERT_EQ(a.size(), b.size());
    for (std::size_t l = 0; l < a.size(); ++l)
    {
      ASSERT_EQ(a[l].nonZeros(), b[l].nonZeros());
      EXPECT_TRUE(std::equal(a[l].innerIndexPtr(), a[l].innerIndexPtr() + a[l].nonZeros(), b[l].innerIndexPtr()));
      EXPECT_TRUE(std::equal(a[l].valuePtr(), a[l].valuePtr() + a[l].nonZeros(), b[l].valuePtr()));
    }
  };
  for (int threads : { 2, 3, 8 })
  {
    const ProlongationOperators operators = BuildSurfaceHierarchy(mesh, options, TbbContext(threads)).Operators;
    same(operators.S0, expected.S0);
    same(operators.SP, expected.SP);
    same(operators.Linear, expected.Linear);
  }
}

// Operators stand in the caller's numbering, whatever order the work was done in: S0 takes the
// coordinates of level 1 near those of level 0.
TEST(SurfaceHierarchy, KeepsTheCallersNumbering)
{
  const Surface surface = Relabel(Icosphere(4), 8).Result;
  const SurfaceHierarchy hierarchy = BuildSurfaceHierarchy(surface.Mesh(), HierarchyOptions(), SerialContext());
  ASSERT_EQ(hierarchy.CoarseLevels.size(), 1u);
  const Points places = hierarchy.Operators.S0[0] * hierarchy.CoarseLevels[0].VertexPositions();
  EXPECT_LT((places - surface.V).rowwise().norm().maxCoeff(), 0.2); // an edge of level 1 is 0.12 long
}
