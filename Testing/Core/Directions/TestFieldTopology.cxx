#include "Directions/FieldTopology.h"

#include "Operators/PowerFieldOperators.h"
#include "Support/NamedSurfaces.h"
#include "Support/Random.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>

namespace
{

using namespace dmg;
using namespace dmg::test;

FieldTopology TopologyOf(const TriangleMesh& mesh, int N, const std::function<Vector3(const Vector3&)>& vectorAt)
{
  const TangentFrames frames = FaceFrames(mesh);
  Vector<Complex> first(mesh.NumberOfFaces());
  for (int face = 0; face < mesh.NumberOfFaces(); ++face)
  {
    Vector3 centre = Vector3::Zero();
    for (int k = 0; k < 3; ++k)
    {
      centre += mesh.Position(mesh.FaceCorners()(face, k)) / 3.0;
    }
    first[face] = frames.ToComplex(face, vectorAt(centre));
  }
  return TopologyOfField(mesh, frames, first, N);
}

double SumOf(const FieldTopology& topology)
{
  double sum = topology.Indices.sum();
  for (const BoundaryIndex& loop : topology.Loops)
  {
    sum += loop.Index;
  }
  return sum;
}

TEST(FieldTopology, IndicesSumToTheEulerCharacteristic)
{
  std::vector<NamedSurface> surfaces = SmallSurfaces();
  surfaces.push_back({ "genus 0", Icosphere(3) });
  surfaces.push_back({ "genus 1", IrregularTorus(20, 12, 3) });
  surfaces.push_back({ "genus 2", DoubleTorus(3) });
  surfaces.push_back({ "genus 3", PerforatedSlab(3, 1, 2) });
  surfaces.push_back({ "disc", Disk(5) });
  surfaces.push_back({ "annulus", Annulus(24, 4) });
  surfaces.push_back({ "zero-area faces", SphereWithZeroAreaFaces(3, 10) });
  surfaces.push_back({ "capsule", CapsuleFromRectangle(16, 12) });
  surfaces.push_back({ "two parts", Union(Disk(3), Icosphere(2), Vector3(5.0, 0.0, 0.0)) });
  Random random(12);
  for (const NamedSurface& surface : surfaces)
  {
    const TriangleMesh mesh = surface.Shape.Mesh();
    for (const int N : { 1, 2, 3, 4, 6, 8 })
    {
      SCOPED_TRACE(surface.Name + ", N " + std::to_string(N));
      const FieldTopology rough = TopologyOfField(mesh, FaceFrames(mesh), random.Numbers(mesh.NumberOfFaces()), N);
      EXPECT_NEAR(SumOf(rough), mesh.EulerCharacteristic(), 1e-9);
      const FieldTopology smooth = TopologyOf(mesh, N, [](const Vector3& p) { return Vector3(p[1], 1.0, -p[0]); });
      EXPECT_NEAR(SumOf(smooth), mesh.EulerCharacteristic(), 1e-9);
      for (const BoundaryIndex& loop : rough.Loops)
      {
        EXPECT_NEAR(N * loop.Index, std::round(N * loop.Index), 1e-12);
        for (const int vertex : loop.Vertices)
        {
          EXPECT_TRUE(mesh.IsBoundaryVertex(vertex));
        }
      }
    }
  }
}

TEST(FieldTopology, IndexOfALoopCountsTurnsOfTheBoundaryAgainstTheField)
{
  const auto parallel = [](const Vector3&) { return Vector3(1.0, 0.2, 0.0); };
  const auto around = [](const Vector3& p) { return Vector3(-p[1], p[0], 0.0); };
  const auto outwards = [](const Vector3& p) { return p; };
  const TriangleMesh disc = Disk(6).Mesh();
  const TriangleMesh ring = Annulus(30, 5).Mesh();
  for (const int N : { 1, 2, 4 })
  {
    const FieldTopology flat = TopologyOf(disc, N, parallel);
    EXPECT_TRUE(flat.Indices.isZero(0.0));
    ASSERT_EQ(flat.Loops.size(), 1u);
    EXPECT_EQ(flat.Loops[0].Index, 1.0);
    EXPECT_EQ(flat.Loops[0].Vertices.size(), 36u);

    for (const auto& field : { std::function<Vector3(const Vector3&)>(around), { outwards } })
    {
      const FieldTopology whirl = TopologyOf(disc, N, field);
      EXPECT_EQ(whirl.Indices.sum(), 1.0) << "in the centre";
      EXPECT_EQ(whirl.Loops[0].Index, 0.0);
      for (const BoundaryIndex& loop : TopologyOf(ring, N, field).Loops)
      {
        EXPECT_EQ(loop.Index, 0.0);
      }
    }

    const FieldTopology across = TopologyOf(ring, N, parallel);
    ASSERT_EQ(across.Loops.size(), 2u);
    for (const BoundaryIndex& loop : across.Loops)
    {
      EXPECT_EQ(loop.Index, ring.Position(loop.Vertices[0]).norm() > 1.5 ? 1.0 : -1.0);
    }
  }
}

TEST(FieldTopology, CutsAreWhereTheFirstDirectionBecomesAnotherOne)
{
  const TriangleMesh mesh = IrregularPlane(8, 7, 5).Mesh();
  const TangentFrames frames = FaceFrames(mesh);
  Random random(8);
  for (const int N : { 1, 2, 4, 5 })
  {
    std::vector<int> labels(mesh.NumberOfFaces());
    Vector<Complex> first(mesh.NumberOfFaces());
    for (int face = 0; face < mesh.NumberOfFaces(); ++face)
    {
      labels[face] = random.Index(N);
      first[face] = std::polar(1.0, 2.0 * Pi * labels[face] / N) * frames.ToComplex(face, Vector3(0.4, 1.0, 0.0));
    }
    const FieldTopology topology = TopologyOfField(mesh, frames, first, N);
    std::size_t next = 0;
    for (int edge = 0; edge < mesh.NumberOfEdges(); ++edge)
    {
      const int h = mesh.HalfedgeOf(edge);
      if (mesh.Twin(h) < 0)
      {
        continue;
      }
      const int jump = (labels[TriangleMesh::FaceOf(h)] - labels[TriangleMesh::FaceOf(mesh.Twin(h))] + N) % N;
      if (jump != 0)
      {
        ASSERT_LT(next, topology.Cuts.size());
        EXPECT_EQ(topology.Cuts[next], edge);
        EXPECT_EQ(topology.Jumps[next], jump);
        ++next;
      }
    }
    EXPECT_EQ(next, topology.Cuts.size());
  }
}

}
