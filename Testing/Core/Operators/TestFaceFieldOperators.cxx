#include "Operators/FaceFieldOperators.h"

#include "Support/Identities.h"
#include "Support/NamedSurfaces.h"
#include "Support/Random.h"
#include "Support/ReferenceOperators.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace
{

using namespace dmg;
using namespace dmg::test;

template <class Visit>
void VisitSamples(Visit visit)
{
  for (const NamedSurface& sample : SmallSurfaces())
  {
    SCOPED_TRACE(sample.Name);
    const TriangleMesh mesh = sample.Shape.Mesh();
    Random random(5);
    std::vector<double> angles(mesh.NumberOfFaces());
    for (double& angle : angles)
    {
      angle = random.Uniform(-3.0, 3.0);
    }
    visit(mesh, Turned(FaceFrames(mesh), angles));
  }
}

SparseMatrix<double> Identity(int size)
{
  SparseMatrix<double> identity(size, size);
  identity.setIdentity();
  return identity;
}

/// L by the cotangents of the angles, from dot and cross products in space.
SparseMatrix<double> CotangentLaplacian(const TriangleMesh& mesh)
{
  std::vector<Eigen::Triplet<double>> entries;
  for (int h = 0; h < 3 * mesh.NumberOfFaces(); ++h)
  {
    const int i = mesh.Tail(h);
    const int j = mesh.Head(h);
    const Vector3 apex = mesh.Position(mesh.Tail(TriangleMesh::Previous(h)));
    const Vector3 a = mesh.Position(i) - apex;
    const Vector3 b = mesh.Position(j) - apex;
    const double weight = 0.5 * a.dot(b) / a.cross(b).norm();
    entries.emplace_back(i, i, weight);
    entries.emplace_back(j, j, weight);
    entries.emplace_back(i, j, -weight);
    entries.emplace_back(j, i, -weight);
  }
  SparseMatrix<double> L(mesh.NumberOfVertices(), mesh.NumberOfVertices());
  L.setFromTriplets(entries.begin(), entries.end());
  return L;
}

TEST(FaceFieldOperators, ProjectionHasAnInverse)
{
  VisitSamples(
    [](const TriangleMesh& mesh, const TangentFrames& frames)
    {
      const SparseMatrix<double> P = HalfedgeProjection(mesh, frames);
      const SparseMatrix<double> inverse = HalfedgePseudoInverse(mesh, frames);
      const int n = 2 * mesh.NumberOfFaces();
      EXPECT_LT(CommutationResidual(inverse, P, Identity(n), Identity(n)), 1e-12);
      // P P^+ is Q_I: it takes the mean of each face.
      for (int f = 0; f < mesh.NumberOfFaces(); f += 7)
      {
        const Eigen::Matrix3d Q = Eigen::MatrixXd(P.middleRows(3 * f, 3)) *
          Eigen::MatrixXd(SparseMatrix<double>(inverse.transpose()).middleRows(3 * f, 3)).transpose();
        EXPECT_LT(
          (Q - (Eigen::Matrix3d::Identity() - Eigen::Matrix3d::Constant(1.0 / 3.0))).cwiseAbs().maxCoeff(), 1e-12);
      }
    });
}

TEST(FaceFieldOperators, GradientsOfLinearFunctionsInAPlaneAreExact)
{
  for (const Surface& surface : { IrregularPlane(8, 6, 4), Disk(4), Annulus(10, 3) })
  {
    const TriangleMesh mesh = surface.Mesh();
    const TangentFrames frames = FaceFrames(mesh);
    const Vector3 slope(0.3, -1.7, 0.0);
    const Vector<double> gradient = FaceGradient(mesh, frames) * Vector<double>(mesh.VertexPositions() * slope);
    EXPECT_LT((gradient - FaceFieldOfVector(frames, slope)).cwiseAbs().maxCoeff(), 1e-13);
  }
}

TEST(FaceFieldOperators, GradientsHaveNoCurl)
{
  VisitSamples([](const TriangleMesh& mesh, const TangentFrames& frames)
    { EXPECT_LT(VanishingResidual(FaceCurl(mesh, frames), FaceGradient(mesh, frames)), 1e-14); });
}

// (X_g - X_f) . e, by vectors in space.
TEST(FaceFieldOperators, CurlIsTheJumpAlongTheEdge)
{
  VisitSamples(
    [](const TriangleMesh& mesh, const TangentFrames& frames)
    {
      Random random(3);
      Vector<double> X(2 * mesh.NumberOfFaces());
      for (double& x : X)
      {
        x = random.Uniform(-1.0, 1.0);
      }
      const Points vectors = VectorsFromFaceField(frames, X);
      const Vector<double> curl = FaceCurl(mesh, frames) * X;
      for (int e = 0; e < mesh.NumberOfEdges(); ++e)
      {
        const int h = mesh.HalfedgeOf(e);
        double expected = 0.0;
        if (mesh.Twin(h) >= 0)
        {
          const auto [a, b] = mesh.EdgeVertices(e);
          expected =
            (vectors.row(mesh.Twin(h) / 3) - vectors.row(h / 3)).dot((mesh.Position(b) - mesh.Position(a)).transpose());
        }
        EXPECT_NEAR(curl[e], expected, 1e-12);
      }
      EXPECT_LT((FaceFieldFromVectors(frames, vectors) - X).cwiseAbs().maxCoeff(), 1e-14);
    });
}

TEST(FaceFieldOperators, DivergenceIsTheAdjointOfTheGradient)
{
  VisitSamples(
    [](const TriangleMesh& mesh, const TangentFrames& frames)
    {
      const SparseMatrix<double> G = FaceGradient(mesh, frames);
      const SparseMatrix<double> D = FaceDivergence(mesh, frames);
      const Vector<double> M = MassesOfFaceFields(mesh).Faces;
      const SparseMatrix<double> adjoint = -(G.transpose() * M.asDiagonal());
      EXPECT_LT(LargestEntry(SparseMatrix<double>(D - adjoint)) / LargestEntry(D), 1e-13);
      const SparseMatrix<double> laplacian = -CotangentLaplacian(mesh);
      EXPECT_LT(LargestEntry(SparseMatrix<double>(D * G) - laplacian) / LargestEntry(laplacian), 1e-12);
      EXPECT_LT((Vector<double>::Ones(D.rows()).transpose() * D).cwiseAbs().maxCoeff(), 1e-14 * LargestEntry(D) * 10);
    });
}

TEST(FaceFieldOperators, MassesAreAreas)
{
  VisitSamples(
    [](const TriangleMesh& mesh, const TangentFrames&)
    {
      const FaceFieldMasses masses = MassesOfFaceFields(mesh);
      const double area = mesh.FaceAreas().sum();
      EXPECT_NEAR(masses.Vertices.sum(), area, 1e-13 * area);
      EXPECT_NEAR(masses.Edges.sum(), area, 1e-13 * area);
      EXPECT_NEAR(masses.Faces.sum(), 2.0 * area, 1e-13 * area);
    });
}

TEST(FaceFieldOperators, SmoothnessIsDivergenceAndCurl)
{
  VisitSamples(
    [](const TriangleMesh& mesh, const TangentFrames& frames)
    {
      const SparseMatrix<double> A = FaceFieldSmoothness(mesh, frames);
      const FaceFieldMasses masses = MassesOfFaceFields(mesh);
      Random random(4);
      Vector<double> X(2 * mesh.NumberOfFaces());
      for (double& x : X)
      {
        x = random.Uniform(-1.0, 1.0);
      }
      const Vector<double> divergence = FaceDivergence(mesh, frames) * X;
      const Vector<double> curl = FaceCurl(mesh, frames) * X;
      const double energy = divergence.cwiseAbs2().cwiseQuotient(masses.Vertices).sum() +
        curl.cwiseAbs2().cwiseQuotient(masses.Edges).sum();
      EXPECT_NEAR(X.dot(A * X), energy, 1e-13 * energy);
      const SparseMatrix<double> transposed = A.transpose();
      EXPECT_LT(LargestEntry(SparseMatrix<double>(A - transposed)), 4e-16 * LargestEntry(A));
    });
}

TEST(FaceFieldOperators, SmoothnessIsTheSquareOfItsFactor)
{
  VisitSamples(
    [](const TriangleMesh& mesh, const TangentFrames& frames)
    {
      const Eigen::MatrixXd B(FaceFieldSmoothnessFactor(mesh, frames));
      const FaceFieldMasses masses = MassesOfFaceFields(mesh);
      const Eigen::MatrixXd divergence(FaceDivergence(mesh, frames));
      const Eigen::MatrixXd curl(FaceCurl(mesh, frames));
      const Eigen::MatrixXd expected =
        divergence.transpose() * masses.Vertices.cwiseInverse().asDiagonal() * divergence +
        curl.transpose() * masses.Edges.cwiseInverse().asDiagonal() * curl;
      EXPECT_LE((B.transpose() * B - expected).norm(), 1e-13 * expected.norm());
    });
}

// Degenerate faces are held, in two rows each.
TEST(FaceFieldOperators, FactorHoldsFacesWithoutArea)
{
  const TriangleMesh mesh = SphereWithZeroAreaFaces(2, 3).Mesh();
  const TangentFrames frames = FaceFrames(mesh);
  const Eigen::MatrixXd B(FaceFieldSmoothnessFactor(mesh, frames));
  const Eigen::MatrixXd A(FaceFieldSmoothness(mesh, frames));
  EXPECT_GT(B.rows(), mesh.NumberOfVertices() + mesh.NumberOfEdges());
  EXPECT_LE((B.transpose() * B - A).norm(), 1e-13 * A.norm());
}

// Closed forms modulo gradients: the first Betti number, 2 g, or 2 g + b - 1 with boundary.
TEST(FaceFieldOperators, HarmonicFieldsHaveTheDimensionOfTheCohomology)
{
  const std::vector<std::pair<Surface, int>> surfaces = {
    { IrregularSphere(1, 2), 0 },
    { IrregularTorus(12, 7, 3), 2 },
    { DoubleTorus(2), 4 },
    { Disk(3), 0 },
    { IrregularPlane(6, 5, 3), 0 },
    { Annulus(10, 3), 1 },
    { Prism(9, 4), 1 },
    { Union(Torus(7, 5), Annulus(10, 2), Vector3(4.0, 0.0, 0.0)), 3 },
  };
  for (const auto& [surface, dimension] : surfaces)
  {
    const TriangleMesh mesh = surface.Mesh();
    const Vector<double> eigenvalues = SymmetricEigenvalues(FaceFieldSmoothness(mesh, FaceFrames(mesh)));
    const double largest = eigenvalues[eigenvalues.size() - 1];
    EXPECT_GT(eigenvalues[0], -1e-13 * largest);
    if (dimension > 0)
    {
      EXPECT_LT(eigenvalues[dimension - 1], 1e-13 * largest);
    }
    EXPECT_GT(eigenvalues[dimension], 1e-5 * largest) << "dimension " << dimension;
  }
}

// No infinities, no vanishing rows: a face without area still takes part in both energies.
TEST(FaceFieldOperators, ZeroAreaFacesStayFinite)
{
  const TriangleMesh mesh = SphereWithZeroAreaFaces(2, 3).Mesh();
  const TangentFrames frames = FaceFrames(mesh);
  const SparseMatrix<double> inverse = HalfedgePseudoInverse(mesh, frames);
  const SparseMatrix<double> G = FaceGradient(mesh, frames);
  const SparseMatrix<double> A = FaceFieldSmoothness(mesh, frames);
  EXPECT_LT(LargestEntry(inverse), 1e3);
  EXPECT_LT(LargestEntry(G), 1e3);
  EXPECT_TRUE(A.coeffs().allFinite());
  const Vector<double> eigenvalues = SymmetricEigenvalues(A);
  EXPECT_GT(eigenvalues[0], 1e-8);
}

}
