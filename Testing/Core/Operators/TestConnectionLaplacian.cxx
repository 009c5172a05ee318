#include "Operators/ConnectionLaplacian.h"

#include "Operators/ExteriorCalculus.h"
#include "Support/Identities.h"
#include "Support/MeshFactory.h"
#include "Support/Random.h"
#include "Support/ReferenceOperators.h"
#include "Support/TbbContext.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>

using namespace dmg;
using namespace dmg::test;

namespace
{

/// Simpson's rule on [0, 1].
Complex Integral(const std::function<Complex(double)>& f)
{
  constexpr int steps = 4000;
  Complex sum = f(0.0) + f(1.0);
  for (int i = 1; i < steps; ++i)
  {
    sum += (i % 2 == 1 ? 4.0 : 2.0) * f(static_cast<double>(i) / steps);
  }
  return sum / (3.0 * steps);
}

/// A section on one triangle by values at its corners, from its definition: each value is carried along straight lines. In the
/// frame that is carried from corner 0 the derivative is d + i a, a the potential of a constant curvature.
struct SectionOnTriangle
{
  std::array<Complex, 3> Values;
  Complex ToFirst;  ///< transport from corner 0 to corner 1
  Complex FromLast; ///< from corner 2 to corner 0
  double Curvature;

  Complex At(double b1, double b2) const
  {
    return this->Values[0] * (1.0 - b1 - b2) +
      this->Values[1] * b1 * std::conj(this->ToFirst) * std::polar(1.0, this->Curvature * b2) +
      this->Values[2] * b2 * this->FromLast * std::polar(1.0, -this->Curvature * b1);
  }

  /// Covariant derivatives along both coordinates.
  std::array<Complex, 2> DerivativesAt(double b1, double b2) const
  {
    constexpr double step = 1e-5;
    const Complex i(0.0, this->Curvature);
    const Complex value = this->At(b1, b2);
    return { (this->At(b1 + step, b2) - this->At(b1 - step, b2)) / (2.0 * step) + i * b2 * value,
      (this->At(b1, b2 + step) - this->At(b1, b2 - step)) / (2.0 * step) - i * b1 * value };
  }
};

struct Energies
{
  double Dirichlet = 0.0;
  double Mass = 0.0;
};

/// Of a section on a face, by the midpoints of many small triangles.
Energies EnergiesByQuadrature(
  const TriangleMesh& mesh, const VertexConnection& connection, int N, const Vector<Complex>& X, int face)
{
  SectionOnTriangle section;
  for (int k = 0; k < 3; ++k)
  {
    section.Values[k] = X[mesh.FaceCorners()(face, k)];
  }
  section.ToFirst = std::polar(1.0, N * connection.Transport(3 * face));
  section.FromLast = std::polar(1.0, N * connection.Transport(3 * face + 2));
  section.Curvature = N * connection.Curvature(face);
  Eigen::Matrix<double, 3, 2> sides;
  sides.col(0) = mesh.Position(mesh.FaceCorners()(face, 1)) - mesh.Position(mesh.FaceCorners()(face, 0));
  sides.col(1) = mesh.Position(mesh.FaceCorners()(face, 2)) - mesh.Position(mesh.FaceCorners()(face, 0));
  const Eigen::Matrix2d inverseMetric = (sides.transpose() * sides).inverse();
  constexpr int n = 60;
  Energies energies;
  const double area = mesh.FaceArea(face) / (n * n);
  const auto add = [&](double b1, double b2)
  {
    const auto [first, second] = section.DerivativesAt(b1, b2);
    const Eigen::Vector2cd derivatives(first, second);
    energies.Dirichlet += area * derivatives.dot(inverseMetric * derivatives).real();
    energies.Mass += area * std::norm(section.At(b1, b2));
  };
  for (int i = 0; i < n; ++i)
  {
    for (int j = 0; i + j < n; ++j)
    {
      add((i + 1.0 / 3.0) / n, (j + 1.0 / 3.0) / n);
      if (i + j < n - 1)
      {
        add((i + 2.0 / 3.0) / n, (j + 2.0 / 3.0) / n);
      }
    }
  }
  return energies;
}

}

TEST(ConnectionLaplacian, IntegralsAreThoseOfTheirFormulas)
{
  for (const double s : { 0.0, 1e-12, -1e-4, 0.03, 0.7, 0.9999, 1.0001, -1.5, 4.0, -12.0, 30.0 })
  {
    const CurvedElementIntegrals integrals(s);
    const Complex is(0.0, s);
    const auto weighted = [s](double t, Complex f) { return std::polar(1.0, s * t) * f; };
    const Complex squares = Integral(
      [&](double t)
      {
        const double m = 1.0 - t;
        return weighted(
          t, -is * (m * m / 2.0 - m * m * m / 3.0) - s * s * (std::pow(m, 4) / 12.0 - std::pow(m, 5) / 20.0));
      });
    const Complex product = Integral(
      [&](double t)
      {
        const double m = 1.0 - t;
        return weighted(
          t, m - is * m * m * m / 3.0 - s * s * (m * m * m / 6.0 - std::pow(m, 4) / 6.0 + std::pow(m, 5) / 15.0));
      });
    const double scale = 1.0 + s * s;
    EXPECT_LT(std::abs(integrals.OfSquares - squares), 1e-12 * scale) << s;
    EXPECT_LT(std::abs(integrals.OfProduct - product), 1e-12 * scale) << s;
  }
}

TEST(ConnectionLaplacian, IsTheEnergyOfSectionsByTheirDefinition)
{
  const FramedMesh surface(IrregularSphere(0, 3).Mesh()); // 20 faces, 0.63 radians of curvature each
  const TriangleMesh& mesh = surface.Mesh;
  const VertexConnection connection(surface);
  Random random(7);
  for (int N : { 1, 4, 8 })
  {
    const Vector<Complex> X = random.Numbers(mesh.NumberOfVertices());
    Energies expected;
    for (int face = 0; face < mesh.NumberOfFaces(); ++face)
    {
      const Energies ofFace = EnergiesByQuadrature(mesh, connection, N, X, face);
      expected.Dirichlet += ofFace.Dirichlet;
      expected.Mass += ofFace.Mass;
    }
    // The quadrature has an error of the square of its step.
    EXPECT_NEAR(
      X.dot(ConnectionLaplacian(mesh, connection, N) * X).real(), expected.Dirichlet, 2e-3 * expected.Dirichlet);
    EXPECT_NEAR(X.dot(ConnectionMass(mesh, connection, N) * X).real(), expected.Mass, 2e-3 * expected.Mass);
  }
}

TEST(ConnectionLaplacian, IsTheCotangentLaplacianInAPlane)
{
  for (const Surface& shape : { IrregularPlane(9, 7, 4), Disk(5), Annulus(24, 4) })
  {
    const FramedMesh surface(shape.Mesh());
    const TriangleMesh& mesh = surface.Mesh;
    const SparseMatrix<double> d0 = D0(mesh);
    const SparseMatrix<double> cotangents = SparseMatrix<double>(d0.transpose()) * Star1(mesh).asDiagonal() * d0;
    for (int N : { 1, 2, 4, 8 })
    {
      const Vector<Complex> parallel = PowersOfDirection(surface.Vertices, Vector3(0.6, 0.8, 0.0), N);
      const SparseMatrix<Complex> L = ConnectionLaplacian(mesh, VertexConnection(surface), N);
      const SparseMatrix<Complex> inOneFrame = parallel.conjugate().asDiagonal() * L * parallel.asDiagonal();
      EXPECT_LT(RelativeDifference(inOneFrame, cotangents.cast<Complex>()), 1e-12);
    }
  }
}

TEST(ConnectionLaplacian, IsHermitianAndPositiveOnAnyTriangles)
{
  for (const Surface& shape :
    { IrregularSphere(1, 4), Needle(1, 100.0), PlaneWithThinTriangles(6, 4), SphereWithZeroAreaFaces(2, 3) })
  {
    const FramedMesh surface(shape.Mesh());
    const VertexConnection connection(surface);
    for (int N : { 1, 4, 8 })
    {
      for (const SparseMatrix<Complex>& A :
        { ConnectionLaplacian(surface.Mesh, connection, N), ConnectionMass(surface.Mesh, connection, N) })
      {
        EXPECT_LE(HermitianResidual(A), MachinePrecision);
        const Vector<double> eigenvalues = Eigenvalues(A);
        EXPECT_GT(eigenvalues.minCoeff(), -1e-12 * eigenvalues.maxCoeff());
      }
    }
  }
}

TEST(ConnectionLaplacian, DoesNotDependOnFrames)
{
  const FramedMesh surface(IrregularTorus(12, 8, 4).Mesh());
  Random random(11);
  std::vector<double> angles;
  for (int vertex = 0; vertex < surface.Mesh.NumberOfVertices(); ++vertex)
  {
    angles.push_back(random.Uniform(-3.0, 3.0));
  }
  FramedMesh turned = surface;
  turned.Vertices = Turned(surface.Vertices, angles);
  for (int N : { 1, 4, 8 })
  {
    const SparseMatrix<Complex> L = ConnectionLaplacian(surface.Mesh, VertexConnection(surface), N);
    const SparseMatrix<Complex> other = ConnectionLaplacian(surface.Mesh, VertexConnection(turned), N);
    const Vector<Complex> X = random.Numbers(surface.Mesh.NumberOfVertices());
    const Vector<Complex> there = other * InTurnedFrames(X, angles, N);
    EXPECT_LT(RelativeDifference(there, InTurnedFrames(L * X, angles, N)), 1e-12);
  }
}

TEST(ConnectionLaplacian, OtherOrdersPermuteIt)
{
  const FramedMesh surface(IrregularPlane(6, 5, 4).Mesh());
  const VertexConnection connection(surface);
  const int size = surface.Mesh.NumberOfVertices();
  std::vector<int> order(size);
  for (int i = 0; i < size; ++i)
  {
    order[i] = (i * 5 + 3) % size; // 42 vertices
  }
  const SparseMatrix<Complex> L = ConnectionLaplacian(surface.Mesh, connection, 4);
  const SparseMatrix<Complex> permuted = ConnectionLaplacian(surface.Mesh, connection, 4, order, TbbContext(2));
  for (int i = 0; i < size; ++i)
  {
    for (int j = 0; j < size; ++j)
    {
      EXPECT_EQ(permuted.coeff(i, j), L.coeff(order[i], order[j]));
    }
  }
}

// The covariant Laplacian of the N-th power of the tangent bundle of the unit sphere has the lowest eigenvalue N.
TEST(ConnectionLaplacian, LowestEigenvalueOnTheSphereConvergesWithOrderTwo)
{
  for (const bool isIrregular : { false, true })
  {
    for (int N : { 1, 2, 4, 8 })
    {
      std::vector<double> errors;
      for (int subdivisions : { 3, 4 })
      {
        const FramedMesh surface((isIrregular ? IrregularSphere(subdivisions, 3) : Icosphere(subdivisions)).Mesh());
        const SparseMatrix<Complex> L = ConnectionLaplacian(surface.Mesh, VertexConnection(surface), N);
        errors.push_back(LowestEigenvalues(L, LumpedMass(surface.Mesh), 2 * N + 1)[0] / N - 1.0);
      }
      EXPECT_LT(std::abs(errors[1]), 0.005);
      EXPECT_GT(errors[0] / errors[1], 3.5);
      EXPECT_LT(errors[0] / errors[1], 4.5);
    }
  }
}
