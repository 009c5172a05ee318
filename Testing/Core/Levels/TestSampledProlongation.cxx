#include "Levels/SampledProlongation.h"

#include "Levels/GraphOfSamples.h"
#include "Levels/SampledLevels.h"
#include "Mesh/TangentFrames.h"
#include "Support/Errors.h"
#include "Support/MeshFactory.h"
#include "Support/Random.h"
#include "Support/SparseAssembly.h"
#include "Support/TbbContext.h"

#include <gtest/gtest.h>

#include <numeric>

using namespace dmg;
using namespace dmg::test;

namespace
{

ProlongationOperators Sampled(const TriangleMesh& mesh, const ExecutionContext& context = SerialContext())
{
  return SampledLevels(mesh, DefaultSampleDistance, context);
}

TangentGraph GraphOf(const TriangleMesh& mesh)
{
  std::vector<int> faces(mesh.NumberOfFaces());
  std::iota(faces.begin(), faces.end(), 0);
  return FaceGraph(mesh, faces, SerialContext());
}

/// Carries a direction from point 0 all over a graph.
Vector<Complex> ParallelField(const TangentGraph& graph)
{
  Vector<Complex> field = Vector<Complex>::Zero(graph.NumberOfPoints());
  field[0] = Complex(0.6, 0.8);
  std::vector<int> reached{ 0 };
  for (std::size_t next = 0; next < reached.size(); ++next)
  {
    const int point = reached[next];
    for (int link = graph.Offsets[point]; link < graph.Offsets[point + 1]; ++link)
    {
      const int neighbour = graph.Neighbours[link];
      if (field[neighbour] == 0.0)
      {
        field[neighbour] = std::conj(graph.Turns[link]) * field[point];
        reached.push_back(neighbour);
      }
    }
  }
  return field;
}

/// Prolongation from level to level reproduces a parallel field.
void ExpectParallel(const TriangleMesh& mesh)
{
  TangentGraph graph = GraphOf(mesh);
  Vector<Complex> field = ParallelField(graph);
  for (int level = 0; level < 3; ++level)
  {
    const PointSampling sampling = SamplePoints(graph, 2.5, 1.0, SerialContext());
    const TangentGraph samples = GraphOfSamples(graph, sampling, SerialContext());
    ASSERT_LT(samples.NumberOfPoints(), graph.NumberOfPoints());
    Vector<Complex> coarse(samples.NumberOfPoints());
    for (int s = 0; s < samples.NumberOfPoints(); ++s)
    {
      coarse[s] = field[sampling.Samples[s]];
    }
    const TransportOperator P = SampledProlongation(sampling, samples, SerialContext());
    EXPECT_LE((P * coarse - field).cwiseAbs().maxCoeff(), 1e-11);
    graph = samples;
    field = coarse;
  }
}

/// Rows are means of at most three turns, and every coarse unknown is seen.
void ExpectMeans(const ProlongationOperators& operators, const TriangleMesh& mesh)
{
  ASSERT_EQ(operators.NumberOfLevels(), static_cast<int>(operators.Linear.size()) + 1);
  int size = mesh.NumberOfFaces();
  for (std::size_t level = 0; level < operators.Linear.size(); ++level)
  {
    const TransportOperator& P = operators.Linear[level];
    ASSERT_EQ(P.rows(), size);
    size = static_cast<int>(P.cols());
    EXPECT_EQ(size, operators.NumbersOfVertices[level + 1]);
    std::vector<char> isSeen(P.cols(), 0);
    for (int row = 0; row < P.rows(); ++row)
    {
      double sum = 0.0;
      int entries = 0;
      for (TransportOperator::InnerIterator entry(P, row); entry; ++entry)
      {
        sum += std::abs(entry.value());
        isSeen[entry.col()] = 1;
        ++entries;
      }
      EXPECT_NEAR(sum, 1.0, 1e-12);
      EXPECT_LE(entries, 3);
    }
    EXPECT_EQ(std::count(isSeen.begin(), isSeen.end(), 0), 0);
  }
}

}

TEST(SampledProlongation, ReproducesParallelFieldsInThePlane)
{
  ExpectParallel(IrregularPlane(40, 30, 11).Mesh());
}

TEST(SampledProlongation, ReproducesParallelFieldsOnAFlatTorusInSpace)
{
  ExpectParallel(FlatTorus(8, 3).Mesh());
}

TEST(SampledProlongation, ReproducesLinearFunctionsInsideThePlane)
{
  const TriangleMesh mesh = IrregularPlane(60, 60, 13).Mesh();
  const TangentFrames frames = FaceFrames(mesh);
  const TangentGraph graph = GraphOf(mesh);
  const PointSampling sampling = SamplePoints(graph, 3.0, 1.0, SerialContext());
  const TangentGraph samples = GraphOfSamples(graph, sampling, SerialContext());
  const TransportOperator P = SampledProlongation(sampling, samples, SerialContext());
  int exact = 0;
  for (int point = 0; point < graph.NumberOfPoints(); ++point)
  {
    // Where the samples lie, seen from the owner.
    const int owner = sampling.Owners[point];
    Complex mean = 0.0;
    for (TransportOperator::InnerIterator entry(P, point); entry; ++entry)
    {
      for (int link = samples.Offsets[owner]; link < samples.Offsets[owner + 1]; ++link)
      {
        if (samples.Neighbours[link] == entry.col())
        {
          mean += std::abs(entry.value()) * samples.Steps[link];
        }
      }
    }
    exact += std::abs(mean - sampling.Places[point]) <= 1e-12;
  }
  EXPECT_GE(exact, 0.95 * graph.NumberOfPoints()); // beyond far sides and the boundary it is constant
}

TEST(SampledProlongation, IsAMeanOnEverySurface)
{
  for (const Surface& surface : { IrregularSphere(5, 3), IrregularTorus(60, 30, 4), Disk(30), Annulus(60, 20),
         DoubleTorus(6), SphereWithZeroAreaFaces(4, 60), Needle(4, 200.0), Prism(7, 200),
         Union(IrregularSphere(4, 3), Icosphere(0), Vector3(3.0, 0.0, 0.0)) })
  {
    const TriangleMesh mesh = surface.Mesh();
    SCOPED_TRACE(mesh.NumberOfFaces());
    const ProlongationOperators operators = Sampled(mesh);
    EXPECT_GE(operators.NumberOfLevels(), 2);
    ExpectMeans(operators, mesh);
  }
}

TEST(SampledProlongation, LeavesSmallSurfacesAlone)
{
  EXPECT_EQ(Sampled(Icosphere(1).Mesh()).NumberOfLevels(), 1);
}

TEST(SampledProlongation, StopsWhereManySmallPiecesAreLeft)
{
  Surface pieces = Icosphere(0);
  for (int k = 0; k < 7; ++k)
  {
    pieces = Union(pieces, pieces, Vector3(3.0 * (1 << k), 0.0, 0.0));
  }
  const TriangleMesh mesh = pieces.Mesh(); // 128 icosahedra
  ExpectMeans(Sampled(mesh), mesh);
}

TEST(SampledProlongation, HasTheSameBitsForAnyNumberOfThreads)
{
  const TriangleMesh mesh = IrregularTorus(160, 70, 3).Mesh();
  const ProlongationOperators one = Sampled(mesh);
  for (const int threads : { 2, 5 })
  {
    const ProlongationOperators other = Sampled(mesh, TbbContext(threads));
    ASSERT_EQ(one.Linear.size(), other.Linear.size());
    for (std::size_t level = 0; level < one.Linear.size(); ++level)
    {
      EXPECT_EQ((one.Linear[level] - other.Linear[level]).norm(), 0.0);
    }
  }
}

TEST(SampledProlongation, RefusesADistanceWithoutSamples)
{
  EXPECT_THROW(SampledLevels(Icosphere(3).Mesh(), 1.0, SerialContext()), InvalidInput);
}

TEST(SampledProlongation, TakesItsRowsInAnyOrder)
{
  const TriangleMesh mesh = IrregularPlane(40, 30, 17).Mesh();
  const TangentGraph graph = GraphOf(mesh);
  const PointSampling sampling = SamplePoints(graph, 3.0, 1.0, SerialContext());
  const TangentGraph samples = GraphOfSamples(graph, sampling, SerialContext());
  std::vector<int> points(graph.NumberOfPoints());
  for (int row = 0; row < graph.NumberOfPoints(); ++row)
  {
    points[row] = graph.NumberOfPoints() - 1 - row;
  }
  const TransportOperator inOrder = SampledProlongation(sampling, samples, SerialContext());
  const TransportOperator reversed = SampledProlongation(sampling, samples, points, SerialContext());
  EXPECT_EQ((reversed - SelectRows(inOrder, points, SerialContext())).norm(), 0.0);
}
