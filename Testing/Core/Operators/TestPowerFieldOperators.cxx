#include "Operators/PowerFieldOperators.h"

#include "Support/Identities.h"
#include "Support/NamedSurfaces.h"
#include "Support/Random.h"
#include "Support/ReferenceOperators.h"

#include <Eigen/Geometry>
#include <gtest/gtest.h>

#include <cmath>

namespace
{

using namespace dmg;
using namespace dmg::test;

std::vector<NamedSurface> Surfaces()
{
  std::vector<NamedSurface> surfaces = SmallSurfaces();
  surfaces.push_back({ "zero-area faces", SphereWithZeroAreaFaces(2, 3) });
  return surfaces;
}

/// The smoothness energy from its definition: directions in space, edge by edge, no matrix.
double EnergyByDifferences(const TriangleMesh& mesh, const TangentFrames& frames, const Vector<Complex>& X, int N)
{
  double energy = 0.0;
  for (int e = 0; e < mesh.NumberOfEdges(); ++e)
  {
    const int h = mesh.HalfedgeOf(e);
    if (mesh.Twin(h) < 0)
    {
      continue;
    }
    const int f = TriangleMesh::FaceOf(h);
    const int g = TriangleMesh::FaceOf(mesh.Twin(h));
    const Vector3 edge = mesh.Position(mesh.Head(h)) - mesh.Position(mesh.Tail(h));
    const Complex inF = frames.ToComplex(f, edge);
    const Complex inG = frames.ToComplex(g, edge);
    const double weight = 3.0 * edge.squaredNorm() / (mesh.FaceArea(f) + mesh.FaceArea(g));
    energy +=
      weight * std::norm(X[f] * std::polar(1.0, -N * std::arg(inF)) - X[g] * std::polar(1.0, -N * std::arg(inG)));
  }
  return energy;
}

TEST(TransportAcrossEdge, KeepsTheEdgeAndIsInvertedByTheTwin)
{
  const TriangleMesh mesh = IrregularTorus(10, 6, 4).Mesh();
  const TangentFrames frames = FaceFrames(mesh);
  for (int h = 0; h < 3 * mesh.NumberOfFaces(); ++h)
  {
    const Vector3 edge = mesh.Position(mesh.Head(h)) - mesh.Position(mesh.Tail(h));
    const Complex carried =
      frames.ToComplex(TriangleMesh::FaceOf(h), edge) * std::polar(1.0, TransportAcrossEdge(mesh, frames, h));
    const Complex there = frames.ToComplex(TriangleMesh::FaceOf(mesh.Twin(h)), edge);
    EXPECT_LT(std::abs(carried - there), 20.0 * MachinePrecision * edge.norm());
    const double back = TransportAcrossEdge(mesh, frames, mesh.Twin(h));
    EXPECT_LT(std::abs(std::polar(1.0, back + TransportAcrossEdge(mesh, frames, h)) - 1.0), 20.0 * MachinePrecision);
  }
}

TEST(TransportAcrossEdge, AgreesWithTheShortestRotationBetweenTheFaces)
{
  // Unfolding along the common edge rotates about it, which is the shortest rotation.
  const TriangleMesh mesh = IrregularSphere(2, 6).Mesh();
  const TangentFrames frames = FaceFrames(mesh);
  for (int h = 0; h < 3 * mesh.NumberOfFaces(); ++h)
  {
    const Complex turn = TransportTurn(frames, TriangleMesh::FaceOf(h), frames, TriangleMesh::FaceOf(mesh.Twin(h)));
    EXPECT_LT(std::abs(turn - std::polar(1.0, TransportAcrossEdge(mesh, frames, h))), 100.0 * MachinePrecision);
  }
}

TEST(PowerEdgeWeight, IsTheThesissAndFiniteOnSlivers)
{
  const TriangleMesh plane = PlaneGrid(1, 1).Mesh();
  for (int h = 0; h < 6; ++h) // 3 * 2 / (1/2 + 1/2) on the diagonal
  {
    EXPECT_DOUBLE_EQ(PowerEdgeWeight(plane, h), plane.Twin(h) >= 0 ? 6.0 : 0.0);
  }

  for (const Surface& surface : { SphereWithZeroAreaFaces(2, 3), Needle(2, 1e9) })
  {
    const TriangleMesh mesh = surface.Mesh();
    for (int h = 0; h < 3 * mesh.NumberOfFaces(); ++h)
    {
      const double weight = PowerEdgeWeight(mesh, h);
      EXPECT_GE(weight, 0.0); // false for NaN
      EXPECT_LE(weight, 3e6 * (1.0 + 4.0 * MachinePrecision));
    }
  }
}

TEST(PowerLaplacian, IsHermitianAndPositiveSemidefinite)
{
  for (const NamedSurface& sample : Surfaces())
  {
    SCOPED_TRACE(sample.Name);
    const TriangleMesh mesh = sample.Shape.Mesh();
    const TangentFrames frames = FaceFrames(mesh);
    for (int N : { 1, 2, 4, 7 })
    {
      const SparseMatrix<Complex> L = PowerLaplacian(mesh, frames, N);
      ASSERT_EQ(L.rows(), mesh.NumberOfFaces());
      EXPECT_TRUE(L.isCompressed());
      EXPECT_LE(HermitianResidual(L), MachinePrecision);
      const Vector<double> eigenvalues = Eigenvalues(L);
      const double scale = eigenvalues[eigenvalues.size() - 1];
      EXPECT_GT(eigenvalues[0], -1e3 * MachinePrecision * scale);
    }
  }
}

TEST(PowerLaplacian, ColumnsAscendAndTheDiagonalIsStored)
{
  // The pillow of two triangles and a valence-2 vertex: faces that meet along several edges.
  Surface pillow{ Points(3, 3), Triangles(2, 3) };
  pillow.V << 0, 0, 0, 1, 0, 0, 0, 1, 0;
  pillow.F << 0, 1, 2, 2, 1, 0;
  Surface fold{ Points(4, 3), Triangles(2, 3) };
  fold.V << 0, 0, 0, 1, 0, 0, 0.3, 0.2, 0, 0, 1, 0;
  fold.F << 0, 1, 2, 1, 3, 2;
  fold.F.conservativeResize(3, 3);
  fold.F.row(2) << 0, 2, 3;
  std::vector<NamedSurface> samples = Surfaces();
  samples.push_back({ "pillow", pillow });
  samples.push_back({ "fold", fold });
  for (const NamedSurface& sample : samples)
  {
    SCOPED_TRACE(sample.Name);
    const TriangleMesh mesh = sample.Shape.Mesh();
    const SparseMatrix<Complex> L = PowerLaplacian(mesh, FaceFrames(mesh), 2);
    for (int row = 0; row < L.rows(); ++row)
    {
      int previous = -1;
      bool hasDiagonal = false;
      for (SparseMatrix<Complex>::InnerIterator entry(L, row); entry; ++entry)
      {
        EXPECT_GT(entry.col(), previous);
        previous = static_cast<int>(entry.col());
        hasDiagonal = hasDiagonal || entry.col() == row;
      }
      EXPECT_TRUE(hasDiagonal);
    }
  }
}

TEST(PowerLaplacian, IsTheEnergyOfTheDifferencesAcrossEdges)
{
  for (const NamedSurface& sample : Surfaces())
  {
    if (std::string(sample.Name) == "zero-area faces")
    {
      continue; // where the formula divides by zero, and the weights say what is meant instead
    }
    SCOPED_TRACE(sample.Name);
    const TriangleMesh mesh = sample.Shape.Mesh();
    const TangentFrames frames = FaceFrames(mesh);
    Random random(11);
    for (int N = 1; N <= 8; ++N)
    {
      const SparseMatrix<Complex> L = PowerLaplacian(mesh, frames, N);
      const Vector<Complex> X = random.Numbers(mesh.NumberOfFaces());
      const double expected = EnergyByDifferences(mesh, frames, X, N);
      const Complex energy = X.dot(L * X);
      EXPECT_NEAR(energy.real(), expected, 1e3 * MachinePrecision * expected);
      EXPECT_NEAR(energy.imag(), 0.0, 1e3 * MachinePrecision * expected);
    }
  }
}

TEST(PowerLaplacian, DoesNotFeelTheChoiceOfFrames)
{
  const TriangleMesh mesh = IrregularTorus(12, 7, 8).Mesh();
  const TangentFrames frames = FaceFrames(mesh);
  Random random(12);
  std::vector<double> angles(mesh.NumberOfFaces());
  for (double& angle : angles)
  {
    angle = random.Uniform(-Pi, Pi);
  }
  const TangentFrames turned = Turned(frames, angles);
  for (int N = 1; N <= 8; ++N)
  {
    const Vector<Complex> X = random.Numbers(mesh.NumberOfFaces());
    const Vector<Complex> image = PowerLaplacian(mesh, frames, N) * X;
    const Vector<Complex> imageInTurned = PowerLaplacian(mesh, turned, N) * InTurnedFrames(X, angles, N);
    EXPECT_LT(RelativeDifference(imageInTurned, InTurnedFrames(image, angles, N)), 100.0 * N * MachinePrecision);
  }
}

TEST(PowerLaplacian, FollowsRelabellingRotationAndScale)
{
  const Surface surface = IrregularSphere(2, 9);
  const TriangleMesh mesh = surface.Mesh();
  const TangentFrames frames = FaceFrames(mesh);
  const Relabelled relabelled = Relabel(surface, 10);
  const TriangleMesh other = relabelled.Result.Mesh();
  const TangentFrames otherFrames = FaceFrames(other);
  Eigen::Matrix3d rotation;
  const TriangleMesh moved = RotatedAndScaled(surface, 1.2, 37.0, &rotation).Mesh();
  const TangentFrames movedFrames = FaceFrames(moved);

  Points directions(mesh.NumberOfFaces(), 3); // one random tangent vector per face, in space
  Random random(13);
  for (int f = 0; f < mesh.NumberOfFaces(); ++f)
  {
    directions.row(f) = frames.ToVector(f, random.Number()).transpose();
  }
  for (int N : { 1, 3, 4, 8 })
  {
    const auto power = [N](Complex z) { return std::polar(std::abs(z), N * std::arg(z)); };
    Vector<Complex> X(mesh.NumberOfFaces());
    Vector<Complex> Y(mesh.NumberOfFaces());
    Vector<Complex> Z(mesh.NumberOfFaces());
    for (int f = 0; f < mesh.NumberOfFaces(); ++f)
    {
      const Vector3 v = directions.row(f).transpose();
      X[f] = power(frames.ToComplex(f, v));
      Y[relabelled.NewFaces[f]] = power(otherFrames.ToComplex(relabelled.NewFaces[f], v));
      Z[f] = power(movedFrames.ToComplex(f, rotation * v));
    }
    const double energy = X.dot(PowerLaplacian(mesh, frames, N) * X).real();
    EXPECT_NEAR(Y.dot(PowerLaplacian(other, otherFrames, N) * Y).real(), energy, 1e3 * MachinePrecision * energy);
    EXPECT_NEAR(Z.dot(PowerLaplacian(moved, movedFrames, N) * Z).real(), energy, 1e3 * MachinePrecision * energy);
  }
}

TEST(PowerLaplacian, KernelOnFlatPatchesAreTheParallelFields)
{
  for (const Surface& surface : { IrregularPlane(7, 5, 3), Disk(4), Annulus(11, 3) })
  {
    const TriangleMesh mesh = surface.Mesh();
    const TangentFrames frames = FaceFrames(mesh);
    for (int N = 1; N <= 8; ++N)
    {
      const SparseMatrix<Complex> L = PowerLaplacian(mesh, frames, N);
      const Vector<Complex> X = PowersOfDirection(frames, Vector3(0.3, -0.8, 0.0), N);
      EXPECT_LT((L * X).cwiseAbs().maxCoeff(), 10.0 * N * MachinePrecision * L.coeffs().abs().maxCoeff());
      const Vector<double> eigenvalues = Eigenvalues(L);
      const double largest = eigenvalues[eigenvalues.size() - 1];
      EXPECT_LT(std::abs(eigenvalues[0]), 1e3 * MachinePrecision * largest);
      EXPECT_GT(eigenvalues[1], 1e-4 * largest); // one complex dimension, no more
    }
  }
}

TEST(PowerLaplacian, HasAParallelFieldOnAFlatTorus)
{
  // Flat inside and with trivial holonomy along both generators (MeshFactory.h): for every N
  // exactly one parallel field up to a complex factor, though the surface is bent and closed.
  const TriangleMesh mesh = FlatTorus(12, 1).Mesh();
  const TangentFrames frames = FaceFrames(mesh);
  for (int N = 1; N <= 8; ++N)
  {
    const Vector<double> eigenvalues = Eigenvalues(PowerLaplacian(mesh, frames, N));
    const double largest = eigenvalues[eigenvalues.size() - 1];
    EXPECT_LT(std::abs(eigenvalues[0]), 1e3 * MachinePrecision * largest);
    EXPECT_GT(eigenvalues[1], 1e-4 * largest);
  }
}

TEST(PowerLaplacian, CurvatureLeavesNoParallelField)
{
  const TriangleMesh mesh = Icosphere(2).Mesh();
  const TangentFrames frames = FaceFrames(mesh);
  for (int N = 1; N <= 8; ++N)
  {
    const Vector<double> eigenvalues = Eigenvalues(PowerLaplacian(mesh, frames, N));
    EXPECT_GT(eigenvalues[0], 1e-3 * eigenvalues[eigenvalues.size() - 1]);
  }
}

TEST(PowerLaplacian, LowestEigenvaluesOnTheSphereApproachTwiceTheSmoothOnes)
{
  // N-power fields are sections of the bundle of a monopole of charge N, whose Laplacian on the
  // unit sphere has the eigenvalues l (l + 1) - N^2 for l = N, N + 1 ...: the lowest is N, 2 N + 1
  // times. The thesis's weight is twice the consistent two-point flux, so ours approach 2 N.
  for (int N = 1; N <= 4; ++N)
  {
    std::vector<double> errors;
    for (int subdivisions : { 2, 3, 4 })
    {
      const TriangleMesh mesh = Icosphere(subdivisions).Mesh();
      const Vector<double> eigenvalues =
        LowestEigenvalues(PowerLaplacian(mesh, FaceFrames(mesh), N), mesh.FaceAreas(), 2 * N + 2);
      errors.push_back(std::abs(eigenvalues[2 * N] / (2.0 * N) - 1.0));
      EXPECT_LT(eigenvalues[2 * N], 1.002 * eigenvalues[0]);       // 2 N + 1 alike ...
      EXPECT_GT(eigenvalues[2 * N + 1], 3.0 * eigenvalues[2 * N]); // ... and then a gap
    }
    EXPECT_LT(errors[1], errors[0]);
    EXPECT_LT(errors[2], errors[1]);
    EXPECT_LT(errors[2], 0.01);
  }
}

}
