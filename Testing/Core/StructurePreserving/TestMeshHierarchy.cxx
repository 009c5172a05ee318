#include "StructurePreserving/Decimation/MeshHierarchy.h"

#include "Support/Errors.h"
#include "Support/Identities.h"
#include "Support/Levels.h"
#include "Support/MeshFactory.h"
#include "Support/TbbContext.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

using namespace dmg;
using namespace dmg::test;

namespace
{

HierarchyOptions Deep(CollapsePolicy policy = CollapsePolicy::IndependentRounds)
{
  HierarchyOptions options;
  options.MinimumNumberOfFaces = 60;
  options.Policy = policy;
  return options;
}

std::vector<TriangleMesh> Build(
  const TriangleMesh& mesh, const HierarchyOptions& options, const ExecutionContext& context = SerialContext())
{
  return VisitLevels(
    mesh, options, [](const LevelTransition&) {}, context);
}

int NumberOfBoundaryLoops(const TriangleMesh& mesh)
{
  std::map<int, int> next;
  for (int h = 0; h < 3 * mesh.NumberOfFaces(); ++h)
  {
    if (mesh.Twin(h) < 0)
    {
      next[mesh.Tail(h)] = mesh.Head(h);
    }
  }
  int loops = 0;
  while (!next.empty())
  {
    ++loops;
    int v = next.begin()->first;
    while (next.count(v))
    {
      const int following = next[v];
      next.erase(v);
      v = following;
    }
  }
  return loops;
}

int NumberOfComponents(const TriangleMesh& mesh)
{
  const std::vector<int> components = FaceComponents(mesh);
  return 1 + *std::max_element(components.begin(), components.end());
}

std::vector<NamedSurface> Surfaces()
{
  std::vector<NamedSurface> surfaces = SurfacesToDecimate();
  surfaces.push_back({ "prism", Prism(24, 40) });
  surfaces.push_back({ "zero-area faces", SphereWithZeroAreaFaces(4, 20) });
  return surfaces;
}

}

// The constructor of every level's TriangleMesh checks that it is manifold and oriented; what is
// left to see is that the topology is that of the surface.
TEST(MeshHierarchy, KeepsTheTopology)
{
  for (CollapsePolicy policy : { CollapsePolicy::IndependentRounds, CollapsePolicy::SequentialQueue })
  {
    for (const NamedSurface& surface : Surfaces())
    {
      SCOPED_TRACE(surface.Name);
      const TriangleMesh mesh = surface.Shape.Mesh();
      const std::vector<TriangleMesh> levels = Build(mesh, Deep(policy));
      ASSERT_GE(levels.size(), 2u);
      for (const TriangleMesh& level : levels)
      {
        EXPECT_EQ(level.EulerCharacteristic(), mesh.EulerCharacteristic());
        EXPECT_EQ(NumberOfBoundaryLoops(level), NumberOfBoundaryLoops(mesh));
        EXPECT_EQ(NumberOfComponents(level), NumberOfComponents(mesh));
      }
    }
  }
}

TEST(MeshHierarchy, ReachesTheSizesAskedFor)
{
  const TriangleMesh mesh = IrregularSphere(5, 3).Mesh(); // 20480 faces
  const std::vector<TriangleMesh> levels = Build(mesh, HierarchyOptions());
  ASSERT_EQ(levels.size(), 2u); // the third would have 1000 faces, over 70 % of 1280
  EXPECT_EQ(levels[0].NumberOfFaces(), 5120);
  EXPECT_EQ(levels[1].NumberOfFaces(), 1280);

  HierarchyOptions one;
  one.MaximumNumberOfCoarseLevels = 1;
  one.FaceRatio = 0.1;
  ASSERT_EQ(Build(mesh, one).size(), 1u);
  EXPECT_EQ(Build(mesh, one)[0].NumberOfFaces(), 2048);

  one.MaximumNumberOfCoarseLevels = 0;
  EXPECT_TRUE(Build(mesh, one).empty());
}

TEST(MeshHierarchy, LeavesSmallSurfacesAlone)
{
  EXPECT_TRUE(Build(Icosphere(2).Mesh(), HierarchyOptions()).empty());
  HierarchyOptions options;
  options.MinimumNumberOfFaces = 4;
  const std::vector<TriangleMesh> levels = Build(Icosphere(2).Mesh(), options);
  ASSERT_FALSE(levels.empty());
  EXPECT_GE(levels.back().NumberOfFaces(), 4); // a tetrahedron has no edge left to collapse
}

TEST(MeshHierarchy, RefusesOptionsOutOfRange)
{
  const TriangleMesh mesh = Icosphere(1).Mesh();
  HierarchyOptions options;
  options.FaceRatio = 1.0;
  EXPECT_THROW(Build(mesh, options), InvalidInput);
  options = HierarchyOptions();
  options.MaximumNumberOfCoarseLevels = -1;
  EXPECT_THROW(Build(mesh, options), InvalidInput);
  options = HierarchyOptions();
  options.MinimumNumberOfFaces = 3;
  EXPECT_THROW(Build(mesh, options), InvalidInput);
}

TEST(MeshHierarchy, HasTheSameBitsForAnyNumberOfThreads)
{
  for (const Surface& surface : { IrregularTorus(96, 48, 21), IrregularPlane(70, 60, 22) })
  {
    const TriangleMesh mesh = surface.Mesh();
    const std::vector<TriangleMesh> expected = Build(mesh, Deep());
    for (int threads : { 2, 3, 8 })
    {
      const std::vector<TriangleMesh> levels = Build(mesh, Deep(), TbbContext(threads));
      ASSERT_EQ(levels.size(), expected.size());
      for (std::size_t l = 0; l < levels.size(); ++l)
      {
        EXPECT_TRUE(levels[l].VertexPositions() == expected[l].VertexPositions());
        EXPECT_TRUE(levels[l].FaceCorners() == expected[l].FaceCorners());
      }
    }
  }
}

TEST(MeshHierarchy, KeepsFlatSurfacesFlatAndTheirOutline)
{
  // Area and boundary length of a square do not change when only collinear points leave its sides;
  // the boundary planes of the quadrics hold its corners.
  const TriangleMesh mesh = IrregularPlane(40, 40, 31).Mesh();
  const std::vector<TriangleMesh> levels = Build(mesh, Deep());
  ASSERT_GE(levels.size(), 2u);
  for (const TriangleMesh& level : levels)
  {
    EXPECT_LT(level.VertexPositions().col(2).cwiseAbs().maxCoeff(), 1e-14);
    EXPECT_NEAR(level.FaceAreas().sum(), 1600.0, 0.01 * 1600.0);
  }
}

// From the cost of a collapse: the area between a sphere and its coarse level shrinks the size of the
// faces, so volumes agree to the order of the squared edge length, (4 pi / #F) here.
TEST(MeshHierarchy, KeepsTheShape)
{
  const TriangleMesh mesh = Icosphere(5).Mesh();
  for (const TriangleMesh& level : Build(mesh, Deep()))
  {
    double volume = 0.0;
    for (int f = 0; f < level.NumberOfFaces(); ++f)
    {
      volume += level.FaceAreaVector(f).dot(level.Position(level.FaceCorners()(f, 0))) / 6.0;
    }
    const double sphere = 4.0 / 3.0 * std::acos(-1.0);
    EXPECT_NEAR(volume / sphere, 1.0, 3.0 * 4.0 * std::acos(-1.0) / level.NumberOfFaces());
  }
}

// Where a boundary is drawn together into a point, a collapse onto it may bring all corners of a face
// there, which no TriangleMesh takes. Whether one comes up depends on the order of collapses.
TEST(MeshHierarchy, KeepsTheCornersOfFacesApart)
{
  for (unsigned seed : { 3u, 4u, 5u, 6u, 7u, 8u })
  {
    SCOPED_TRACE(seed);
    const TriangleMesh mesh = Relabel(CapsuleFromRectangle(60, 30), seed).Result.Mesh();
    for (CollapsePolicy policy : { CollapsePolicy::IndependentRounds, CollapsePolicy::SequentialQueue })
    {
      HierarchyOptions options = Deep(policy);
      options.MinimumNumberOfFaces = 20;
      const std::vector<TriangleMesh> levels = Build(mesh, options);
      ASSERT_GE(levels.size(), 3u);
      EXPECT_EQ(levels.back().EulerCharacteristic(), 1);
    }
  }
}

TEST(MeshHierarchy, StopsWhenAsked)
{
  const TriangleMesh mesh = IrregularSphere(4, 41).Mesh();
  for (int checkpoints : { 1, 2, 6, 13 })
  {
    TbbContext context(1);
    context.CancelAfter(checkpoints);
    EXPECT_THROW(Build(mesh, Deep(), context), Cancelled);
  }
}

TEST(MeshHierarchy, ReportsProgressUpToOne)
{
  const TbbContext context(1);
  Build(IrregularSphere(4, 42).Mesh(), Deep(), context);
  ASSERT_GT(context.Progress().size(), 10u);
  EXPECT_TRUE(std::is_sorted(context.Progress().begin(), context.Progress().end()));
  EXPECT_GE(context.Progress().front(), 0.0);
  EXPECT_EQ(context.Progress().back(), 1.0);
}
