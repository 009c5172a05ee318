#include "Derivatives.h"
#include "StructurePreserving/Decimation/MeshHierarchy.h"
#include "StructurePreserving/Overlay/OverlayProlongation.h"
#include "StructurePreserving/Transfers/FaceFieldProlongation.h"
#include "StructurePreserving/Transfers/OneFormProlongation.h"
#include "StructurePreserving/Transfers/PowerFieldProlongation.h"
#include "StructurePreserving/Transfers/ScalarProlongation.h"
#include "Support/Errors.h"
#include "Support/Identities.h"
#include "Support/Levels.h"
#include "Support/MeshFactory.h"
#include "Support/Pairs.h"
#include "Support/Random.h"
#include "Support/TbbContext.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

using namespace dmg;
using namespace dmg::test;

namespace
{

HierarchyOptions ExactOptions(CollapsePolicy policy = CollapsePolicy::IndependentRounds)
{
  HierarchyOptions options;
  options.MinimumNumberOfFaces = 60;
  options.Policy = policy;
  options.Construction = ProlongationConstruction::ExactOverlay;
  return options;
}

struct Case
{
  std::string Name;
  Surface Shape;
  CollapsePolicy Policy = CollapsePolicy::IndependentRounds;
};

/// Smaller than SurfacesToDecimate: a collapse takes a millisecond.
std::vector<Case> Cases()
{
  return {
    { "sphere", IrregularSphere(3, 7) },
    { "torus", IrregularTorus(32, 12, 11) },
    { "thin torus", IrregularTorus(100, 6, 12, 1.0, 0.08) },
    { "double torus", DoubleTorus(4) },
    { "disk", Disk(12) },
    { "grid", PlaneGrid(20, 15) },
    { "annulus", Annulus(30, 8) },
    { "needle", Needle(3, 20.0) },
    { "torus by the queue", IrregularTorus(20, 10, 11), CollapsePolicy::SequentialQueue },
    { "grid by the queue", PlaneGrid(15, 12), CollapsePolicy::SequentialQueue },
  };
}

/// Both ends of a transition with their frames, and the operators between them.
struct Level
{
  explicit Level(const LevelTransition& transition)
    : Fine(transition.Fine)
    , Coarse(transition.Coarse)
    , FineFrames(FaceFrames(transition.Fine))
    , CoarseFrames(FaceFrames(transition.Coarse))
    , Exact(transition, this->FineFrames, this->CoarseFrames, SerialContext())
  {
  }

  const TriangleMesh& Fine;
  const TriangleMesh& Coarse;
  TangentFrames FineFrames;
  TangentFrames CoarseFrames;
  OverlayProlongation Exact;
};

/// Calls visit(transition, level) for the levels of every surface.
template <class Visit>
void VisitOverlays(Visit visit)
{
  for (const Case& surface : Cases())
  {
    SCOPED_TRACE(surface.Name);
    const auto levels = VisitLevels(surface.Shape.Mesh(), ExactOptions(surface.Policy),
      [&visit](const LevelTransition& transition) { visit(transition, Level(transition)); });
    EXPECT_GE(levels.size(), 1u);
  }
}

/// The angle around the z-axis, made single-valued on each edge: closed and not exact on a torus
/// about that axis.
Vector<double> AngleForm(const TriangleMesh& mesh)
{
  const double pi = std::acos(-1.0);
  Vector<double> form(mesh.NumberOfEdges());
  for (int e = 0; e < mesh.NumberOfEdges(); ++e)
  {
    const auto [a, b] = mesh.EdgeVertices(e);
    const auto angle = [&](int v) { return std::atan2(mesh.Position(v)[1], mesh.Position(v)[0]); };
    form[e] = std::remainder(angle(b) - angle(a), 2.0 * pi);
  }
  return form;
}

}

TEST(OverlayProlongation, KeepsConstantsAndExactForms)
{
  VisitOverlays(
    [](const LevelTransition&, const Level& level)
    {
      const OverlayProlongation& exact = level.Exact;
      ASSERT_EQ(exact.S0.rows(), level.Fine.NumberOfVertices());
      ASSERT_EQ(exact.S0.cols(), level.Coarse.NumberOfVertices());
      ASSERT_EQ(exact.S1.rows(), level.Fine.NumberOfEdges());
      ASSERT_EQ(exact.S1.cols(), level.Coarse.NumberOfEdges());
      EXPECT_LT(RowSumResidual(exact.S0), 1e-14);
      EXPECT_GE(SmallestEntry(exact.S0), 0.0);
      const SparseMatrix<double> differences = DifferencesAlongEdges(level.Fine) * exact.S0;
      const SparseMatrix<double> prolonged = exact.S1 * DifferencesAlongEdges(level.Coarse);
      EXPECT_LT(LargestDifference(differences, prolonged), 1e-13);
    });
}

// On a closed surface both totals are zero (Stokes), with boundary they are the circulation around
// it, which the flattening onto a straight line keeps.
TEST(OverlayProlongation, KeepsTheTotalCurl)
{
  VisitOverlays(
    [](const LevelTransition&, const Level& level)
    {
      const SparseMatrix<double> curl = SumsAroundFaces(level.Fine) * level.Exact.S1;
      const Vector<double> total = curl.transpose() * Vector<double>::Ones(level.Fine.NumberOfFaces());
      const Vector<double> expected =
        SumsAroundFaces(level.Coarse).transpose() * Vector<double>::Ones(level.Coarse.NumberOfFaces());
      EXPECT_LT((total - expected).cwiseAbs().maxCoeff(), 1e-12);
    });
}

TEST(OverlayProlongation, KeepsGeneratorsClosed)
{
  for (const Surface& surface : { IrregularTorus(32, 12, 11), IrregularTorus(160, 6, 12, 1.0, 0.08) })
  {
    HierarchyOptions options = ExactOptions();
    options.MinimumNumberOfFaces = 100;
    VisitLevels(surface.Mesh(), options,
      [&](const LevelTransition& transition)
      {
        const Vector<double> form = AngleForm(transition.Coarse);
        ASSERT_LT((SumsAroundFaces(transition.Coarse) * form).cwiseAbs().maxCoeff(), 1e-12)
          << "the test's own form is not closed";
        const Vector<double> prolonged = Level(transition).Exact.S1 * form;
        EXPECT_LT((SumsAroundFaces(transition.Fine) * prolonged).cwiseAbs().maxCoeff(), 1e-12);
        EXPECT_GT(prolonged.cwiseAbs().maxCoeff(), 0.01);
      });
  }
}

// G S0 = SX G. And what S1 makes of the differences of a function are the values of its gradient
// along the halfedges.
TEST(OverlayProlongation, KeepsGradients)
{
  VisitOverlays(
    [](const LevelTransition&, const Level& level)
    {
      const SparseMatrix<double> gradients = Gradients(level.Fine, level.FineFrames) * level.Exact.S0;
      const SparseMatrix<double> prolonged = level.Exact.SX * Gradients(level.Coarse, level.CoarseFrames);
      EXPECT_LT(LargestDifference(gradients, prolonged), 1e-12 * gradients.coeffs().abs().maxCoeff());

      const Vector<double> u = Random(31).Numbers(level.Coarse.NumberOfVertices()).real();
      const Vector<double> form = level.Exact.S1 * (DifferencesAlongEdges(level.Coarse) * u);
      const Vector<double> values = ValuesAlongHalfedges(level.Fine, level.FineFrames) *
        (level.Exact.SX * (Gradients(level.Coarse, level.CoarseFrames) * u));
      double worst = 0.0;
      for (int h = 0; h < 3 * level.Fine.NumberOfFaces(); ++h)
      {
        worst = std::max(worst, std::abs(values[h] - level.Fine.EdgeSign(h) * form[level.Fine.EdgeOf(h)]));
      }
      EXPECT_LT(worst, 1e-12);
    });
}

TEST(OverlayProlongation, HasWeightsAndTurnsForPowerFields)
{
  VisitOverlays(
    [](const LevelTransition&, const Level& level)
    {
      const TransportOperator& SP = level.Exact.SP;
      ASSERT_EQ(SP.rows(), level.Fine.NumberOfFaces());
      ASSERT_EQ(SP.cols(), level.Coarse.NumberOfFaces());
      EXPECT_LT(RowSumResidual(SP.cwiseAbs()), 1e-13);
    });
}

// On a flat patch all ways from face to face turn alike. So constant fields of every N are reproduced.
TEST(OverlayProlongation, ReproducesConstantFieldsInAPlane)
{
  const Vector3 direction(0.6, -0.8, 0.0);
  VisitLevels(IrregularPlane(24, 20, 15).Mesh(), ExactOptions(),
    [&](const LevelTransition& transition)
    {
      const Level level(transition);
      for (int N : { 1, 2, 4, 8 })
      {
        const Vector<Complex> fine = PowersOfDirection(level.FineFrames, direction, N);
        const Vector<Complex> coarse = PowersOfDirection(level.CoarseFrames, direction, N);
        const SparseMatrix<Complex> transport = OnPowers(level.Exact.SP, N);
        EXPECT_LT(RelativeDifference(transport * coarse, fine), 1e-12 * N);
      }
      // A constant vector field is a gradient.
      const Vector<Complex> fine = PowersOfDirection(level.FineFrames, direction, 1);
      const Vector<Complex> coarse = PowersOfDirection(level.CoarseFrames, direction, 1);
      EXPECT_LT((level.Exact.SX * AsPairs(coarse) - AsPairs(fine)).cwiseAbs().maxCoeff(), 1e-9);
    });
}

// Turning the frames turns the operators with them.
TEST(OverlayProlongation, DoesNotDependOnTheFrames)
{
  HierarchyOptions options = ExactOptions();
  options.MaximumNumberOfCoarseLevels = 1;
  VisitLevels(IrregularTorus(24, 10, 3).Mesh(), options,
    [](const LevelTransition& transition)
    {
      Random random(17);
      std::vector<double> fineAngles(transition.Fine.NumberOfFaces());
      std::vector<double> coarseAngles(transition.Coarse.NumberOfFaces());
      for (std::vector<double>* angles : { &fineAngles, &coarseAngles })
      {
        for (double& angle : *angles)
        {
          angle = random.Uniform(-3.0, 3.0);
        }
      }
      const Level level(transition);
      const TangentFrames fine = Turned(level.FineFrames, fineAngles);
      const TangentFrames coarse = Turned(level.CoarseFrames, coarseAngles);
      const OverlayProlongation turned(transition, fine, coarse, SerialContext());
      const Vector<Complex> field = random.Numbers(transition.Coarse.NumberOfFaces());
      const Vector<Complex> inTurned = InTurnedFrames(field, coarseAngles, 1);
      EXPECT_LT(RelativeDifference(turned.SP * inTurned, InTurnedFrames(level.Exact.SP * field, fineAngles, 1)), 1e-13);
      const auto applied = [](const SparseMatrix<double>& SX, const Vector<Complex>& x)
      { return AsComplex(SX * AsPairs(x)); };
      EXPECT_LT(
        RelativeDifference(applied(turned.SX, inTurned), InTurnedFrames(applied(level.Exact.SX, field), fineAngles, 1)),
        1e-12);
    });
}

// The tracked operators and the exact ones are equal for one collapse (TestLocalProlongation.cxx).
// Over many they differ, though both keep what is tested above: a tracked point is linear on the
// coarse mesh, its row has three entries however often it moved, and a tracked edge is pulled
// straight in each ring as a whole, over all that it crossed before. The product interpolates the
// values of each mesh in between: rows grow with every collapse, to some ten entries in S0 and
// thirty in S1, on average, and the entries become those of a smoother function. Where that
// function is linear in space to begin with, in a plane, they agree again.
TEST(OverlayProlongation, DiffersFromTrackingOverManyCollapses)
{
  VisitLevels(IrregularSphere(4, 7).Mesh(), ExactOptions(),
    [](const LevelTransition& transition)
    {
      const Level level(transition);
      const SparseMatrix<double> tracked = ScalarProlongation(transition, SerialContext());
      EXPECT_LE(tracked.nonZeros(), 3 * tracked.rows());
      EXPECT_GT(level.Exact.S0.nonZeros(), 2 * tracked.nonZeros());
      EXPECT_GT(LargestDifference(level.Exact.S0, tracked), 0.01);
      // Near each other they stay: an entry is a weight, and its place hardly moves.
      const Points exactPlaces = level.Exact.S0 * transition.Coarse.VertexPositions();
      const Points trackedPlaces = tracked * transition.Coarse.VertexPositions();
      const double coarseEdge = std::sqrt(4.0 * std::acos(-1.0) / transition.Coarse.NumberOfFaces());
      EXPECT_LT((exactPlaces - trackedPlaces).rowwise().norm().maxCoeff(), coarseEdge);
    });
  VisitLevels(IrregularPlane(24, 20, 5).Mesh(), ExactOptions(),
    [](const LevelTransition& transition)
    {
      const Level level(transition);
      const Points places = level.Exact.S0 * transition.Coarse.VertexPositions();
      EXPECT_LT((places - transition.Fine.VertexPositions()).rowwise().norm().maxCoeff(), 1e-9);
    });
}

// As above, for S1: the same on exact forms up to the difference of S0, equal on constant vectors
// in a plane, and five times the entries on curved surfaces.
TEST(OverlayProlongation, AgreesWithTrackedOneFormsWhereItMust)
{
  VisitLevels(IrregularSphere(4, 7).Mesh(), ExactOptions(),
    [](const LevelTransition& transition)
    {
      const Level level(transition);
      const SparseMatrix<double> tracked = OneFormProlongation(FineEdgePaths(transition), SerialContext());
      const SparseMatrix<double> ofForms = (level.Exact.S1 - tracked) * DifferencesAlongEdges(level.Coarse);
      const SparseMatrix<double> ofFunctions =
        DifferencesAlongEdges(level.Fine) * (level.Exact.S0 - ScalarProlongation(transition, SerialContext()));
      EXPECT_LT(LargestDifference(ofForms, ofFunctions), 1e-12);
      EXPECT_GT(level.Exact.S1.nonZeros(), 3 * tracked.nonZeros());
    });
  VisitLevels(IrregularPlane(24, 20, 5).Mesh(), ExactOptions(),
    [](const LevelTransition& transition)
    {
      const Level level(transition);
      const Vector<double> constant = DifferencesAlongEdges(level.Coarse) * level.Coarse.VertexPositions().col(0);
      EXPECT_LT((level.Exact.S1 * constant - OneFormProlongation(FineEdgePaths(transition), SerialContext()) * constant)
                  .cwiseAbs()
                  .maxCoeff(),
        1e-9);
    });
}

// As above, for SX. The tracked one fits all three sides of a fine face at once (Q_I), and only on
// the finest mesh; the thesis's does so after each collapse, and keeps the sides at the polygons
// (Q_B).
TEST(OverlayProlongation, AgreesWithTrackedFaceFieldsWhereItMust)
{
  VisitLevels(IrregularSphere(4, 7).Mesh(), ExactOptions(),
    [](const LevelTransition& transition)
    {
      const Level level(transition);
      const SparseMatrix<double> tracked =
        FaceFieldProlongation(FineEdgePaths(transition), level.FineFrames, level.CoarseFrames, SerialContext());
      const SparseMatrix<double> ofFields = (level.Exact.SX - tracked) * Gradients(level.Coarse, level.CoarseFrames);
      const SparseMatrix<double> ofFunctions =
        Gradients(level.Fine, level.FineFrames) * (level.Exact.S0 - ScalarProlongation(transition, SerialContext()));
      EXPECT_LT(LargestDifference(ofFields, ofFunctions), 1e-12 * ofFunctions.coeffs().abs().maxCoeff());
      EXPECT_GT(level.Exact.SX.nonZeros(), 3 * tracked.nonZeros());
    });
}

TEST(OverlayProlongation, HasTheSameBitsForAnyNumberOfThreads)
{
  const auto operators = [](const ExecutionContext& context)
  {
    std::vector<OverlayProlongation> levels;
    VisitLevels(
      IrregularTorus(32, 16, 21).Mesh(), ExactOptions(),
      [&](const LevelTransition& transition)
      { levels.emplace_back(transition, FaceFrames(transition.Fine), FaceFrames(transition.Coarse), context); },
      context);
    return levels;
  };
  const auto expectSame = [](const auto& a, const auto& b)
  {
    ASSERT_EQ(a.nonZeros(), b.nonZeros());
    EXPECT_TRUE(std::equal(a.innerIndexPtr(), a.innerIndexPtr() + a.nonZeros(), b.innerIndexPtr()));
    EXPECT_TRUE(std::equal(a.valuePtr(), a.valuePtr() + a.nonZeros(), b.valuePtr()));
  };
  const std::vector<OverlayProlongation> expected = operators(SerialContext());
  const std::vector<OverlayProlongation> found = operators(TbbContext(3));
  ASSERT_EQ(expected.size(), found.size());
  for (std::size_t l = 0; l < expected.size(); ++l)
  {
    expectSame(found[l].S0, expected[l].S0);
    expectSame(found[l].S1, expected[l].S1);
    expectSame(found[l].SX, expected[l].SX);
    expectSame(found[l].SP, expected[l].SP);
  }
}

// Faces without area may lie folded in the plane; G is no gradient in them, all else holds.
TEST(OverlayProlongation, SurvivesFacesWithoutArea)
{
  for (const Surface& surface : { SphereWithZeroAreaFaces(3, 12), CapsuleFromRectangle(24, 12) })
  {
    const auto levels = VisitLevels(surface.Mesh(), ExactOptions(),
      [](const LevelTransition& transition)
      {
        const Level level(transition);
        EXPECT_LT(RowSumResidual(level.Exact.S0), 1e-14);
        EXPECT_GE(SmallestEntry(level.Exact.S0), 0.0);
        const SparseMatrix<double> differences = DifferencesAlongEdges(level.Fine) * level.Exact.S0;
        const SparseMatrix<double> prolonged = level.Exact.S1 * DifferencesAlongEdges(level.Coarse);
        EXPECT_LT(LargestDifference(differences, prolonged), 1e-13);
        EXPECT_LT(RowSumResidual(level.Exact.SP.cwiseAbs()), 1e-13);
        EXPECT_TRUE(level.Exact.SX.coeffs().allFinite());
      });
    EXPECT_GE(levels.size(), 1u);
  }
}

TEST(OverlayProlongation, NeedsTheRecordOfTheCollapses)
{
  VisitLevels(IrregularSphere(3, 7).Mesh(), { 0.25, 1, 60 },
    [](const LevelTransition& transition) { EXPECT_THROW(Level{ transition }, InvalidInput); });
}
