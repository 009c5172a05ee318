#include "Levels/PointSampling.h"

#include "Levels/GraphOfSamples.h"
#include "Mesh/TangentFrames.h"
#include "Support/MeshFactory.h"
#include "Support/TbbContext.h"

#include <gtest/gtest.h>

#include <cmath>
#include <numeric>
#include <utility>

using namespace dmg;
using namespace dmg::test;

namespace
{

/// More curvature than any test surface has.
constexpr double Curved = 1e6;

std::vector<int> AllFaces(const TriangleMesh& mesh)
{
  std::vector<int> faces(mesh.NumberOfFaces());
  std::iota(faces.begin(), faces.end(), 0);
  return faces;
}

/// Mean of the midpoints of the sides, each by its squared length.
Vector3 PointOf(const TriangleMesh& mesh, int face)
{
  Vector3 sum = Vector3::Zero();
  double weights = 0.0;
  for (int h = 3 * face; h < 3 * face + 3; ++h)
  {
    const Vector3 side = mesh.Position(mesh.Head(h)) - mesh.Position(mesh.Tail(h));
    sum += 0.5 * side.squaredNorm() * (mesh.Position(mesh.Head(h)) + mesh.Position(mesh.Tail(h)));
    weights += side.squaredNorm();
  }
  return sum / weights;
}

/// In a plane, steps are differences of points and turns change nothing but the frame.
void ExpectPlanar(
  const TangentGraph& graph, const std::vector<int>& faces, const TriangleMesh& mesh, const TangentFrames& frames)
{
  const Complex any(0.3, -0.7);
  ASSERT_EQ(graph.NumberOfPoints(), static_cast<int>(faces.size()));
  for (int i = 0; i < graph.NumberOfPoints(); ++i)
  {
    for (int link = graph.Offsets[i]; link < graph.Offsets[i + 1]; ++link)
    {
      const int j = graph.Neighbours[link];
      const Vector3 step = frames.ToVector(faces[i], graph.Steps[link]);
      EXPECT_LE((PointOf(mesh, faces[i]) + step - PointOf(mesh, faces[j])).norm(), 1e-12);
      const Vector3 here = frames.ToVector(faces[i], graph.Turns[link] * any);
      EXPECT_LE((here - frames.ToVector(faces[j], any)).norm(), 1e-12);
    }
  }
}

}

TEST(TangentGraph, IsExactInThePlane)
{
  const TriangleMesh mesh = IrregularPlane(12, 9, 5).Mesh();
  const std::vector<int> faces = AllFaces(mesh);
  const TangentGraph graph = FaceGraph(mesh, faces, SerialContext());
  ExpectPlanar(graph, faces, mesh, FaceFrames(mesh));
}

TEST(TangentGraph, LinksFacesAcrossEachInnerEdge)
{
  const TriangleMesh mesh = Annulus(9, 4).Mesh();
  int inner = 0;
  for (int edge = 0; edge < mesh.NumberOfEdges(); ++edge)
  {
    inner += mesh.Twin(mesh.HalfedgeOf(edge)) >= 0;
  }
  EXPECT_EQ(FaceGraph(mesh, AllFaces(mesh), SerialContext()).NumberOfLinks(), 2 * inner);
}

TEST(PointSampling, PlacesAndLevelsAreExactInThePlane)
{
  const TriangleMesh mesh = IrregularPlane(40, 30, 7).Mesh();
  const TangentFrames frames = FaceFrames(mesh);
  std::vector<int> faces = AllFaces(mesh);
  TangentGraph graph = FaceGraph(mesh, faces, SerialContext());
  for (int level = 0; level < 3; ++level)
  {
    const PointSampling sampling = SamplePoints(graph, 2.5, Curved, SerialContext());
    for (int point = 0; point < graph.NumberOfPoints(); ++point)
    {
      const int sample = faces[sampling.Samples[sampling.Owners[point]]];
      const Vector3 place = PointOf(mesh, sample) + frames.ToVector(sample, sampling.Places[point]);
      EXPECT_LE((place - PointOf(mesh, faces[point])).norm(), 1e-12);
    }
    std::vector<int> sampledFaces;
    for (const int sample : sampling.Samples)
    {
      sampledFaces.push_back(faces[sample]);
    }
    graph = GraphOfSamples(graph, sampling, SerialContext());
    faces = sampledFaces;
    ExpectPlanar(graph, faces, mesh, frames);
  }
}

TEST(PointSampling, KeepsSamplesApartAndLeavesNoRoomForMore)
{
  // More than one block of points, and all at equal spacing.
  const TriangleMesh mesh = PlaneGrid(90, 90).Mesh();
  const std::vector<int> faces = AllFaces(mesh);
  const TangentGraph graph = FaceGraph(mesh, faces, SerialContext());
  const double radius = 2.5;
  const PointSampling sampling = SamplePoints(graph, radius, Curved, SerialContext());
  const int inside = mesh.NumberOfFaces() / 2;
  const int begin = graph.Offsets[inside];
  ASSERT_EQ(graph.Offsets[inside + 1], begin + 3);
  double sum = 0.0;
  for (int link = begin; link < begin + 3; ++link)
  {
    sum += 1.0 / std::abs(graph.Steps[link]);
  }
  const double distance = radius * 3.0 / sum;
  for (std::size_t s = 0; s < sampling.Samples.size(); ++s)
  {
    EXPECT_EQ(sampling.Owners[sampling.Samples[s]], static_cast<int>(s));
    EXPECT_EQ(sampling.Places[sampling.Samples[s]], Complex(0.0));
    const Vector3 here = PointOf(mesh, sampling.Samples[s]);
    const auto isInside = [](const Vector3& p) { return p[0] > 5.0 && p[0] < 85.0 && p[1] > 5.0 && p[1] < 85.0; };
    for (std::size_t t = 0; t < s; ++t)
    {
      const Vector3 there = PointOf(mesh, sampling.Samples[t]);
      EXPECT_TRUE(!isInside(here) || !isInside(there) || (here - there).norm() > 0.999 * distance);
    }
  }
  for (int point = 0; point < graph.NumberOfPoints(); ++point)
  {
    EXPECT_LE(std::abs(sampling.Places[point]), 1.6 * distance); // spacings differ at the boundary
  }
}

TEST(TangentGraph, SumsCurvatureToTheTheoremOfGaussAndBonnet)
{
  const double fullTurn = 2.0 * std::acos(-1.0);
  for (const auto& [surface, characteristic] :
    { std::make_pair(Icosphere(4), 2), std::make_pair(IrregularTorus(60, 30, 3), 0) })
  {
    const TriangleMesh mesh = surface.Mesh();
    TangentGraph graph = FaceGraph(mesh, AllFaces(mesh), SerialContext());
    for (int level = 0; level < 3; ++level)
    {
      EXPECT_NEAR(
        std::accumulate(graph.Curvatures.begin(), graph.Curvatures.end(), 0.0), fullTurn * characteristic, 1e-9);
      const PointSampling sampling = SamplePoints(graph, 2.5, 1.0, SerialContext());
      graph = GraphOfSamples(graph, sampling, SerialContext());
    }
  }
}

TEST(TangentGraph, HasNoCurvatureInThePlaneNorAtItsBoundary)
{
  const TriangleMesh mesh = IrregularPlane(12, 9, 5).Mesh();
  for (const double curvature : FaceGraph(mesh, AllFaces(mesh), SerialContext()).Curvatures)
  {
    EXPECT_NEAR(curvature, 0.0, 1e-12);
  }
}

TEST(PointSampling, IsDenserWhereTheSurfaceIsCurved)
{
  // A sphere holds 4 pi: so many radians for each sample at most, and as many samples at least.
  const TriangleMesh mesh = Icosphere(5).Mesh();
  const TangentGraph graph = FaceGraph(mesh, AllFaces(mesh), SerialContext());
  const double largest = 0.05;
  const PointSampling sampling = SamplePoints(graph, 1e3, largest, SerialContext());
  EXPECT_GE(sampling.Samples.size(), 4.0 * std::acos(-1.0) / largest);
  EXPECT_LE(sampling.Samples.size(), mesh.NumberOfFaces() / 4);
}

TEST(PointSampling, TakesEveryPointWhereEachHoldsTooMuchCurvature)
{
  const TriangleMesh mesh = Icosphere(1).Mesh();
  const TangentGraph graph = FaceGraph(mesh, AllFaces(mesh), SerialContext());
  const PointSampling sampling = SamplePoints(graph, 3.0, 1e-3, SerialContext());
  EXPECT_EQ(static_cast<int>(sampling.Samples.size()), mesh.NumberOfFaces());
}

TEST(PointSampling, HasTheSameBitsForAnyNumberOfThreads)
{
  const TriangleMesh mesh = IrregularTorus(160, 70, 3).Mesh();
  const auto make = [&](int threads)
  {
    const TbbContext context(threads);
    const TangentGraph graph = FaceGraph(mesh, AllFaces(mesh), context);
    const PointSampling sampling = SamplePoints(graph, 3.0, 0.5, context);
    return std::make_pair(sampling, GraphOfSamples(graph, sampling, context));
  };
  const auto one = make(1);
  for (const int threads : { 2, 5 })
  {
    const auto other = make(threads);
    EXPECT_EQ(one.first.Samples, other.first.Samples);
    EXPECT_EQ(one.first.Owners, other.first.Owners);
    EXPECT_EQ(one.first.Places, other.first.Places);
    EXPECT_EQ(one.first.Turns, other.first.Turns);
    EXPECT_EQ(one.second.Neighbours, other.second.Neighbours);
    EXPECT_EQ(one.second.Steps, other.second.Steps);
    EXPECT_EQ(one.second.Turns, other.second.Turns);
    EXPECT_EQ(one.second.Curvatures, other.second.Curvatures);
  }
}
