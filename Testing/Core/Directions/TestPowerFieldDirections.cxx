#include "Directions/PowerFieldDirections.h"

#include "Operators/PowerFieldOperators.h"
#include "Support/Identities.h"
#include "Support/NamedSurfaces.h"
#include "Support/Random.h"
#include "Support/ReferenceOperators.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{

using namespace dmg;
using namespace dmg::test;

std::vector<int> Combed(const TriangleMesh& mesh, const TangentFrames& frames, const Vector<Complex>& X, int N)
{
  return CombingLabels(mesh, X, MatchDirections(mesh, SideDirections(mesh, frames), X, N), N);
}

/// [k].row(i) is direction k of element i.
std::vector<Points> DirectionsOf(
  const TangentFrames& frames, const Vector<Complex>& X, int N, bool unitLength, const std::vector<int>& labels = {})
{
  std::vector<Points> directions(N, Points(X.size(), 3));
  const Vector<Complex> first = FirstDirections(X, N, labels);
  const DirectionVectors vectors(N, unitLength, N);
  for (int i = 0; i < static_cast<int>(X.size()); ++i)
  {
    vectors.VisitAt(
      frames, i, first[i], [&](int k, const Vector3& vector) { directions[k].row(i) = vector.transpose(); });
  }
  return directions;
}

TEST(MatchDirections, LeadsEachDirectionToTheNearestBeyondTheEdge)
{
  Random random(31);
  for (const NamedSurface& surface : SmallSurfaces())
  {
    const TriangleMesh mesh = surface.Shape.Mesh();
    const TangentFrames frames = FaceFrames(mesh);
    for (const int N : { 1, 2, 3, 8 })
    {
      const Vector<Complex> X = random.Numbers(mesh.NumberOfFaces());
      const PrincipalMatching matching = MatchDirections(mesh, SideDirections(mesh, frames), X, N);
      const std::vector<Points> directions = DirectionsOf(frames, X, N, true);
      for (int e = 0; e < mesh.NumberOfEdges(); ++e)
      {
        const int h = mesh.HalfedgeOf(e);
        if (mesh.Twin(h) < 0)
        {
          EXPECT_EQ(matching.Rotation[e], 0.0);
          EXPECT_EQ(matching.Offsets[h], 0);
          continue;
        }
        EXPECT_LE(std::abs(matching.Rotation[e]), Pi / N * (1.0 + 1e-15));
        const int f = TriangleMesh::FaceOf(h);
        const int g = TriangleMesh::FaceOf(mesh.Twin(h));
        for (int k = 0; k < N; ++k)
        {
          const Complex carried = frames.ToComplex(f, directions[k].row(f).transpose()) *
            std::polar(1.0, TransportAcrossEdge(mesh, frames, h) + matching.Rotation[e]);
          const int matched = (k + matching.Offsets[h]) % N;
          const Complex there = frames.ToComplex(g, directions[matched].row(g).transpose());
          EXPECT_LT(std::abs(carried - there), 1e-12) << surface.Name << ", edge " << e;
        }
        EXPECT_EQ((matching.Offsets[h] + matching.Offsets[mesh.Twin(h)]) % N, 0);
      }
    }
  }
}

TEST(DirectionVectors, AreSymmetricRootsOfThePower)
{
  const TriangleMesh mesh = IrregularSphere(1, 4).Mesh();
  const TangentFrames frames = FaceFrames(mesh);
  Random random(14);
  for (int N = 1; N <= 8; ++N)
  {
    const Vector<Complex> X = random.Numbers(mesh.NumberOfFaces());
    std::vector<int> labels(mesh.NumberOfFaces());
    for (int& label : labels)
    {
      label = random.Index(N);
    }
    const std::vector<Points> roots = DirectionsOf(frames, X, N, false);
    const std::vector<Points> units = DirectionsOf(frames, X, N, true);
    const std::vector<Points> labelled = DirectionsOf(frames, X, N, false, labels);
    ASSERT_EQ(static_cast<int>(roots.size()), N);
    for (int f = 0; f < mesh.NumberOfFaces(); ++f)
    {
      const double length = std::abs(X[f]);
      for (int k = 0; k < N; ++k)
      {
        const Complex z = frames.ToComplex(f, roots[k].row(f).transpose());
        EXPECT_NEAR(std::abs(z), length, 20.0 * MachinePrecision * length);
        EXPECT_LT(std::abs(std::polar(length, N * std::arg(z)) - X[f]), 100.0 * N * MachinePrecision * length);
        const Complex next = frames.ToComplex(f, roots[(k + 1) % N].row(f).transpose());
        EXPECT_LT(std::abs(next - z * std::polar(1.0, 2.0 * Pi / N)), 100.0 * MachinePrecision * length);
        EXPECT_LT((units[k].row(f) - roots[k].row(f) / length).norm(), 20.0 * MachinePrecision);
        EXPECT_LT((labelled[k].row(f) - roots[(k + labels[f]) % N].row(f)).norm(), 100.0 * MachinePrecision * length);
      }
    }
  }
}

TEST(DirectionVectors, OfZeroAreZero)
{
  const TriangleMesh mesh = PlaneGrid(1, 1).Mesh();
  const Vector<Complex> zero = Vector<Complex>::Zero(2);
  for (const Points& direction : DirectionsOf(FaceFrames(mesh), zero, 3, true))
  {
    EXPECT_EQ(direction.norm(), 0.0);
  }
}

/// Edges across which direction 0 does not go on as direction 0.
int CountJumps(const TriangleMesh& mesh, const TangentFrames& frames, const Vector<Complex>& X,
  const std::vector<int>& labels, int N)
{
  const std::vector<Points> directions = DirectionsOf(frames, X, N, true, labels);
  int jumps = 0;
  for (int e = 0; e < mesh.NumberOfEdges(); ++e)
  {
    const int h = mesh.HalfedgeOf(e);
    if (mesh.Twin(h) < 0)
    {
      continue;
    }
    const int f = TriangleMesh::FaceOf(h);
    const int g = TriangleMesh::FaceOf(mesh.Twin(h));
    const Complex carried =
      frames.ToComplex(f, directions[0].row(f).transpose()) * std::polar(1.0, TransportAcrossEdge(mesh, frames, h));
    const Complex there = frames.ToComplex(g, directions[0].row(g).transpose());
    jumps += std::abs(std::arg(there * std::conj(carried))) > Pi / N * (1.0 + 1e-12) ? 1 : 0;
  }
  return jumps;
}

TEST(CombingLabels, LeaveNoJumpOnADiscWithoutSingularities)
{
  const TriangleMesh mesh = IrregularPlane(12, 10, 5).Mesh();
  const TangentFrames frames = FaceFrames(mesh);
  for (int N = 1; N <= 8; ++N)
  {
    Vector<Complex> X(mesh.NumberOfFaces());
    for (int f = 0; f < mesh.NumberOfFaces(); ++f)
    {
      // A direction that turns by more than a whole turn over the patch, and slowly.
      const double angle = 0.7 * mesh.Position(mesh.Tail(3 * f)).x();
      const Vector3 v(std::cos(angle), std::sin(angle), 0.0);
      X[f] = std::polar(1.0, N * std::arg(frames.ToComplex(f, v)));
    }
    const std::vector<int> labels = Combed(mesh, frames, X, N);
    for (int label : labels)
    {
      EXPECT_GE(label, 0);
      EXPECT_LT(label, N);
    }
    if (0.7 * 1.8 * N < Pi) // rotation across an edge stays below half of what separates directions
    {
      EXPECT_EQ(CountJumps(mesh, frames, X, labels, N), 0);
      if (N > 1)
      {
        EXPECT_GT(CountJumps(mesh, frames, X, std::vector<int>(labels.size(), 0), N), 0);
      }
    }
  }
}

TEST(CombingLabels, LeaveOnlyACutThatASingularityNeeds)
{
  // One singularity of index 1/N in the centre of a disc: a cut must reach the boundary, and one
  // along a shortest path crosses about as many edges as there are rings.
  const int rings = 8;
  const TriangleMesh mesh = Disk(rings).Mesh();
  const TangentFrames frames = FaceFrames(mesh);
  for (int N : { 2, 3, 4, 6 })
  {
    Vector<Complex> X(mesh.NumberOfFaces());
    for (int f = 0; f < mesh.NumberOfFaces(); ++f)
    {
      const Vector3 centre =
        (mesh.Position(mesh.Tail(3 * f)) + mesh.Position(mesh.Head(3 * f)) + mesh.Position(mesh.Tail(3 * f + 2))) / 3.0;
      const double angle = std::atan2(centre.y(), centre.x()) / N;
      X[f] = std::polar(1.0, N * std::arg(frames.ToComplex(f, { std::cos(angle), std::sin(angle), 0.0 })));
    }
    const int jumps = CountJumps(mesh, frames, X, Combed(mesh, frames, X, N), N);
    EXPECT_GE(jumps, rings);
    EXPECT_LE(jumps, 6 * rings);
  }
}

TEST(CombingLabels, CoverEveryComponentAndSurviveZeroPowers)
{
  const TriangleMesh mesh = Union(Icosphere(1), Torus(5, 4), Vector3(4.0, 0.0, 0.0)).Mesh();
  const TangentFrames frames = FaceFrames(mesh);
  Vector<Complex> X = PowersOfDirection(frames, Vector3(1.0, 2.0, 3.0), 4);
  X[3] = 0.0;
  for (int label : Combed(mesh, frames, X, 4))
  {
    EXPECT_GE(label, 0);
    EXPECT_LT(label, 4);
  }
}

TEST(PowersAtVertices, AreExactOnAFlatPatch)
{
  const TriangleMesh mesh = IrregularPlane(9, 7, 6).Mesh();
  const TangentFrames faceFrames = FaceFrames(mesh);
  const TangentFrames vertexFrames = VertexFrames(mesh);
  const Vector3 v(0.6, -0.8, 0.0);
  for (int N = 1; N <= 8; ++N)
  {
    const Vector<Complex> X = 2.5 * PowersOfDirection(faceFrames, v, N);
    const Vector<Complex> expected = 2.5 * PowersOfDirection(vertexFrames, v, N);
    EXPECT_LT(RelativeDifference(PowersAtVertices(mesh, CornersOf(mesh), X, N), expected), 20.0 * N * MachinePrecision);
  }
}

TEST(PowersAtVertices, FollowASmoothFieldOnTheSphere)
{
  // East, away from the poles, at the rate of the mesh size.
  const auto east = [](const Vector3& p) { return Vector3(-p.y(), p.x(), 0.0).normalized(); };
  for (int N : { 1, 4 })
  {
    std::vector<double> errors;
    for (int subdivisions : { 3, 4 })
    {
      const TriangleMesh mesh = Icosphere(subdivisions).Mesh();
      const TangentFrames faceFrames = FaceFrames(mesh);
      const TangentFrames vertexFrames = VertexFrames(mesh);
      Vector<Complex> X(mesh.NumberOfFaces());
      for (int f = 0; f < mesh.NumberOfFaces(); ++f)
      {
        const Vector3 centre = faceFrames.Normal(f);
        X[f] = std::polar(1.0, N * std::arg(faceFrames.ToComplex(f, east(centre))));
      }
      const Vector<Complex> atVertices = PowersAtVertices(mesh, CornersOf(mesh), X, N);
      double error = 0.0;
      for (int v = 0; v < mesh.NumberOfVertices(); ++v)
      {
        const Vector3 p = mesh.Position(v);
        if (std::abs(p.z()) < 0.8)
        {
          const Complex expected = vertexFrames.ToComplex(v, east(p));
          error = std::max(error, std::abs(atVertices[v] - std::polar(1.0, N * std::arg(expected))));
        }
      }
      errors.push_back(error);
    }
    EXPECT_LT(errors[1], 0.6 * errors[0]);
    EXPECT_LT(errors[1], 0.05 * N);
  }
}

TEST(FirstDirectionsAtVertices, AreThoseOfTheFacesAround)
{
  const TriangleMesh mesh = IrregularPlane(8, 8, 7).Mesh();
  const TangentFrames faceFrames = FaceFrames(mesh);
  const TangentFrames vertexFrames = VertexFrames(mesh);
  const Vector3 v(std::cos(0.4), std::sin(0.4), 0.0);
  for (int N = 1; N <= 8; ++N)
  {
    const Vector<Complex> X = PowersOfDirection(faceFrames, v, N);
    const std::vector<int> faceLabels = Combed(mesh, faceFrames, X, N);
    const Vector<Complex> atVertices = PowersAtVertices(mesh, CornersOf(mesh), X, N);
    const Vector<Complex> first = FirstDirectionsAtVertices(
      mesh, [corners = CornersOf(mesh)](int h) { return corners[h].Turn; }, FirstDirections(X, N, faceLabels),
      atVertices, N);
    const Points ofFaces = DirectionsOf(faceFrames, X, N, true, faceLabels)[0];
    Points ofVertices(mesh.NumberOfVertices(), 3);
    for (int vertex = 0; vertex < mesh.NumberOfVertices(); ++vertex)
    {
      ofVertices.row(vertex) = vertexFrames.ToVector(vertex, first[vertex]).transpose();
    }
    EXPECT_LT((ofFaces.rowwise() - ofFaces.row(0)).norm(), 1e-12);
    EXPECT_LT((ofVertices.rowwise() - ofFaces.row(0)).norm(), 1e-12);
  }
}

TEST(SingularityIndices, SumToTheEulerCharacteristicForAnyField)
{
  for (const Surface& surface :
    { IrregularSphere(2, 1), Icosphere(2), IrregularTorus(12, 7, 2), Torus(3, 3), DoubleTorus(2), Needle(2, 100.0),
      FlatTorus(8, 1), SphereWithZeroAreaFaces(3, 8), Union(Icosphere(1), Torus(6, 4), Vector3(4.0, 0.0, 0.0)) })
  {
    const TriangleMesh mesh = surface.Mesh();
    const TangentFrames frames = FaceFrames(mesh);
    Random random(21);
    for (int N = 1; N <= 8; ++N)
    {
      const Vector<Complex> fields[] = { random.Numbers(mesh.NumberOfFaces()),
        Vector<Complex>::Zero(mesh.NumberOfFaces()), // no direction anywhere, still a sum
        PowersOfDirection(frames, Vector3(0.2, 0.5, 0.9), N) };
      for (const Vector<Complex>& X : fields)
      {
        const Vector<double> indices = IndicesOf(mesh, frames, X, N);
        EXPECT_NEAR(indices.sum(), mesh.EulerCharacteristic(), 1e-9);
        for (double index : indices)
        {
          EXPECT_NEAR(N * index, std::round(N * index), 8.0 * MachinePrecision * N);
        }
      }
    }
  }
}

TEST(SingularityIndices, OfEastAreOneAtThePoles)
{
  const TriangleMesh mesh = Icosphere(4).Mesh();
  const TangentFrames frames = FaceFrames(mesh);
  for (int N = 1; N <= 4; ++N)
  {
    Vector<Complex> X(mesh.NumberOfFaces());
    for (int f = 0; f < mesh.NumberOfFaces(); ++f)
    {
      const Vector3 n = frames.Normal(f);
      const Complex east = frames.ToComplex(f, Vector3(-n.y(), n.x(), 0.0));
      X[f] = std::polar(1.0, N * std::arg(east));
    }
    const Vector<double> indices = IndicesOf(mesh, frames, X, N);
    double north = 0.0;
    double south = 0.0;
    for (int v = 0; v < mesh.NumberOfVertices(); ++v)
    {
      const double z = mesh.Position(v).z();
      (z > 0.0 ? north : south) += indices[v];
      if (std::abs(z) < 0.95)
      {
        EXPECT_EQ(indices[v], 0.0);
      }
    }
    EXPECT_NEAR(north, 1.0, 1e-12);
    EXPECT_NEAR(south, 1.0, 1e-12);
  }
}

TEST(SingularityIndices, AreThoseOfModelSingularitiesInThePlane)
{
  const TriangleMesh mesh = Disk(5).Mesh();
  const TangentFrames frames = FaceFrames(mesh);
  for (int N = 1; N <= 8; ++N)
  {
    for (int k = -2; k <= 2; ++k)
    {
      Vector<Complex> X(mesh.NumberOfFaces());
      for (int f = 0; f < mesh.NumberOfFaces(); ++f)
      {
        const Vector3 centre =
          (mesh.Position(mesh.Tail(3 * f)) + mesh.Position(mesh.Head(3 * f)) + mesh.Position(mesh.Tail(3 * f + 2))) /
          3.0;
        // z^k as a power field: its N directions turn by 2 pi k / N around the centre.
        const double angle = k * std::atan2(centre.y(), centre.x());
        const double frame = std::arg(frames.ToComplex(f, Vector3(1.0, 0.0, 0.0)));
        X[f] = std::polar(1.0, angle + N * frame);
      }
      const Vector<double> indices = IndicesOf(mesh, frames, X, N);
      EXPECT_NEAR(indices[0], static_cast<double>(k) / N, 4.0 * MachinePrecision);
      EXPECT_NEAR(indices.cwiseAbs().sum(), std::abs(indices[0]), 4.0 * MachinePrecision);
    }
  }
}

}
