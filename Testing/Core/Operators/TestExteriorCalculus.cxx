#include "Operators/ExteriorCalculus.h"

#include "Support/Identities.h"
#include "Support/NamedSurfaces.h"
#include "Support/Random.h"
#include "Support/ReferenceOperators.h"
#include "Support/TbbContext.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace dmg;
using namespace dmg::test;

namespace
{

using Dense = Eigen::MatrixXd;

std::vector<NamedSurface> Surfaces()
{
  std::vector<NamedSurface> surfaces = SmallSurfaces();
  surfaces.push_back({ "prism", Prism(9, 4) });
  surfaces.push_back({ "zero-area faces", SphereWithZeroAreaFaces(2, 3) });
  return surfaces;
}

/// How many eigenvalues are zero, and that none is negative.
int KernelDimension(const SparseMatrix<double>& A)
{
  const Vector<double> eigenvalues = Eigenvalues(A);
  const double zero = 1e-10 * eigenvalues.tail(1)[0];
  EXPECT_GT(eigenvalues[0], -zero);
  return static_cast<int>((eigenvalues.array() < zero).count());
}

Points Constant(int size, const Vector3& v)
{
  return v.transpose().replicate(size, 1);
}

}

TEST(ExteriorCalculus, DerivativeOfADerivativeVanishes)
{
  for (const NamedSurface& surface : Surfaces())
  {
    SCOPED_TRACE(surface.Name);
    const TriangleMesh mesh = surface.Shape.Mesh();
    EXPECT_EQ(DerivativeTwiceResidual(mesh), 0.0);
    EXPECT_EQ((D0(mesh) * Vector<double>::Ones(mesh.NumberOfVertices())).norm(), 0.0);
  }
}

TEST(ExteriorCalculus, StarsArePositiveAndCoverTheSurface)
{
  for (const NamedSurface& surface : Surfaces())
  {
    SCOPED_TRACE(surface.Name);
    const TriangleMesh mesh = surface.Shape.Mesh();
    const double area = Star2(mesh).cwiseInverse().sum();
    EXPECT_GE(area, mesh.FaceAreas().sum() * (1.0 - 1e-14));
    for (VertexAreas areas : { VertexAreas::Barycentric, VertexAreas::MixedVoronoi })
    {
      const Vector<double> star0 = Star0(mesh, areas);
      EXPECT_GT(star0.minCoeff(), 0.0);
      EXPECT_NEAR(star0.sum(), area, 1e-12 * area);
    }
    const Vector<double> positive = PositiveStar1(mesh);
    EXPECT_GT(positive.minCoeff(), 0.0);
    EXPECT_TRUE(positive.allFinite() && Star1(mesh).allFinite() && Star2(mesh).allFinite());
  }
}

// On equilateral triangles the dual of an inner edge is 1 / sqrt(3) of it, and a vertex has a third
// of its faces, by either rule.
TEST(ExteriorCalculus, StarsOfEquilateralTrianglesAreThoseOfTheirFormulas)
{
  const TriangleMesh mesh = Icosphere(0).Mesh();
  const double area = mesh.FaceArea(0);
  EXPECT_LT((Star1(mesh).array() - 1.0 / std::sqrt(3.0)).abs().maxCoeff(), 1e-14);
  EXPECT_LT((PositiveStar1(mesh).array() - 1.0 / std::sqrt(3.0)).abs().maxCoeff(), 1e-14);
  EXPECT_LT((Star0(mesh).array() - 5.0 / 3.0 * area).abs().maxCoeff(), 1e-14);
  EXPECT_LT((Star0(mesh, VertexAreas::Barycentric).array() - 5.0 / 3.0 * area).abs().maxCoeff(), 1e-14);
}

// d0^T star1 d0 is the stiffness matrix of linear functions: their Dirichlet energy is exact.
TEST(ExteriorCalculus, Star1GivesTheEnergyOfLinearFunctions)
{
  const TriangleMesh mesh = IrregularPlane(9, 7, 4).Mesh();
  const Vector3 slope(0.3, -1.1, 0.0);
  const Vector<double> difference = D0(mesh) * (mesh.VertexPositions() * slope);
  const double expected = slope.squaredNorm() * 63.0;
  EXPECT_NEAR(difference.dot(Star1(mesh).asDiagonal() * difference), expected, 1e-12 * expected);
}

// Constants of all directions together: sum_e m_e |e|^2 is twice the area.
TEST(ExteriorCalculus, PositiveStar1MeasuresVectors)
{
  const TriangleMesh mesh = IrregularPlane(9, 7, 4).Mesh();
  double sum = 0.0;
  for (const Vector3& axis : { Vector3(1.0, 0.0, 0.0), Vector3(0.0, 1.0, 0.0) })
  {
    const Vector<double> form = FormFromFaceVectors(mesh, Constant(mesh.NumberOfFaces(), axis));
    sum += form.dot(PositiveStar1(mesh).asDiagonal() * form);
  }
  EXPECT_NEAR(sum, 2.0 * 63.0, 1e-11);
}

TEST(OneFormLaplacian, IsItsDefinition)
{
  for (const NamedSurface& surface : Surfaces())
  {
    SCOPED_TRACE(surface.Name);
    const TriangleMesh mesh = surface.Shape.Mesh();
    for (VertexAreas areas : { VertexAreas::Barycentric, VertexAreas::MixedVoronoi })
    {
      const Dense d0 = D0(mesh);
      const Dense d1 = D1(mesh);
      const Dense divergence = d0.transpose() * Star1(mesh).asDiagonal();
      const Dense expected = d1.transpose() * Star2(mesh).asDiagonal() * d1 +
        divergence.transpose() * Star0(mesh, areas).cwiseInverse().asDiagonal() * divergence;
      const Dense L1 = OneFormLaplacian(mesh, SerialContext(), areas);
      EXPECT_LT((L1 - expected).cwiseAbs().maxCoeff(), 1e-14 * expected.cwiseAbs().maxCoeff());
      EXPECT_EQ((L1 - L1.transpose()).cwiseAbs().maxCoeff(), 0.0);
    }
  }
}

TEST(OneFormLaplacian, IsTheSameForAnyNumberOfThreads)
{
  const TriangleMesh mesh = IrregularTorus(80, 50, 5).Mesh();
  EXPECT_EQ(
    RelativeDifference(OneFormLaplacianFactor(mesh, TbbContext(3)), OneFormLaplacianFactor(mesh, SerialContext())),
    0.0);
}

// Harmonic forms: 2g on closed surfaces, 2g + b - 1 with b boundary loops and natural conditions.
TEST(OneFormLaplacian, HasTheHarmonicFormsAsKernel)
{
  const auto dimension = [](const Surface& surface)
  { return KernelDimension(OneFormLaplacian(surface.Mesh(), SerialContext())); };
  EXPECT_EQ(dimension(IrregularSphere(2, 3)), 0);
  EXPECT_EQ(dimension(IrregularTorus(12, 7, 5)), 2);
  EXPECT_EQ(dimension(DoubleTorus(2)), 4);
  EXPECT_EQ(dimension(IrregularPlane(7, 6, 8)), 0);
  EXPECT_EQ(dimension(Annulus(12, 3)), 1);
  EXPECT_EQ(dimension(Prism(9, 4)), 1);
  EXPECT_EQ(dimension(Union(Icosphere(1), IrregularTorus(9, 6, 2), Vector3(4.0, 0.0, 0.0))), 2);
}

// Away from the boundary a constant field has neither curl nor divergence, on any triangles.
TEST(OneFormLaplacian, ConstantsInAPlaneHaveNoCurlAndNoDivergenceInside)
{
  const TriangleMesh mesh = IrregularPlane(9, 7, 4).Mesh();
  const Vector<double> form = FormFromFaceVectors(mesh, Constant(mesh.NumberOfFaces(), Vector3(0.3, -1.1, 0.0)));
  EXPECT_LT((D1(mesh) * form).cwiseAbs().maxCoeff(), 1e-14);
  const Vector<double> divergence = D0(mesh).transpose() * Star1(mesh).asDiagonal() * form;
  for (int v = 0; v < mesh.NumberOfVertices(); ++v)
  {
    if (!mesh.IsBoundaryVertex(v))
    {
      EXPECT_LT(std::abs(divergence[v]), 1e-13);
    }
  }
}

// The parallel fields of a flat torus are its harmonic forms: their energy is zero.
TEST(OneFormLaplacian, ParallelFieldsOfAFlatTorusHaveNoEnergy)
{
  const TriangleMesh mesh = FlatTorus(9, 1).Mesh();
  const TangentFrames frames = FaceFrames(mesh);
  // Carry a vector from face to face across edges, unfolded.
  std::vector<Complex> field(mesh.NumberOfFaces(), 0.0);
  std::vector<int> stack = { 0 };
  field[0] = { 0.6, 0.8 };
  while (!stack.empty())
  {
    const int face = stack.back();
    stack.pop_back();
    const std::array<Complex, 3> sides = SideDirections(mesh, frames, face);
    for (int k = 0; k < 3; ++k)
    {
      const int twin = mesh.Twin(3 * face + k);
      const int other = TriangleMesh::FaceOf(twin);
      if (field[other] == 0.0)
      {
        field[other] = -SideDirections(mesh, frames, other)[twin % 3] * std::conj(sides[k]) * field[face];
        stack.push_back(other);
      }
    }
  }
  Points vectors(mesh.NumberOfFaces(), 3);
  for (int face = 0; face < mesh.NumberOfFaces(); ++face)
  {
    vectors.row(face) = frames.ToVector(face, field[face]).transpose();
  }
  const Vector<double> form = FormFromFaceVectors(mesh, vectors);
  const SparseMatrix<double> L1 = OneFormLaplacian(mesh, SerialContext());
  EXPECT_LT((L1 * form).cwiseAbs().maxCoeff(), 1e-12 * L1.coeffs().abs().maxCoeff() * form.cwiseAbs().maxCoeff());
  EXPECT_LT((WhitneyAtFaces(mesh, form) - vectors).cwiseAbs().maxCoeff(), 1e-12);
}

TEST(Whitney, ReproducesConstantsInAPlane)
{
  const Vector3 v(0.3, -1.1, 0.0);
  for (const Surface& surface : { IrregularPlane(9, 7, 4), Disk(5), Annulus(14, 4) })
  {
    const TriangleMesh mesh = surface.Mesh();
    const Points onFaces = Constant(mesh.NumberOfFaces(), v);
    const Points onVertices = Constant(mesh.NumberOfVertices(), v);
    const Vector<double> form = FormFromFaceVectors(mesh, onFaces);
    EXPECT_LT((form - FormFromVertexVectors(mesh, onVertices)).cwiseAbs().maxCoeff(), 1e-14);
    EXPECT_LT((WhitneyAtFaces(mesh, form) - onFaces).cwiseAbs().maxCoeff(), 1e-13);
    EXPECT_LT((WhitneyAtVertices(mesh, FaceFrames(mesh), VertexFrames(mesh), CornersOf(mesh), form) - onVertices)
                .cwiseAbs()
                .maxCoeff(),
      1e-13);
  }
}

// The interpolant is linear along an edge, so its integral is what its values at the ends average
// to: the edge's own value, from either face.
TEST(Whitney, IntegratesToTheForm)
{
  const TriangleMesh mesh = IrregularTorus(9, 6, 2).Mesh();
  Random random(3);
  const Vector<double> form = random.Numbers(mesh.NumberOfEdges()).real();
  const SparseMatrix<double> curl = D1(mesh);
  const Points atCentres = WhitneyAtFaces(mesh, form);
  for (int h = 0; h < 3 * mesh.NumberOfFaces(); ++h)
  {
    // From the centre of the face to the middle of a side the interpolant changes by half its curl,
    // over the area, times the turned displacement.
    const int face = TriangleMesh::FaceOf(h);
    const Vector3 tail = mesh.Position(mesh.Tail(h));
    const Vector3 head = mesh.Position(mesh.Head(h));
    const Vector3 centre = (mesh.Position(mesh.FaceCorners()(face, 0)) + mesh.Position(mesh.FaceCorners()(face, 1)) +
                             mesh.Position(mesh.FaceCorners()(face, 2))) /
      3.0;
    const double area = mesh.FaceArea(face);
    const Vector3 normal = mesh.FaceAreaVector(face) / (2.0 * area);
    const double density = curl.row(face).dot(form) / area;
    const Vector3 atMiddle =
      atCentres.row(face).transpose() + 0.5 * density * normal.cross(0.5 * (tail + head) - centre);
    EXPECT_NEAR(atMiddle.dot(head - tail), mesh.EdgeSign(h) * form[mesh.EdgeOf(h)], 1e-12);
  }
}

TEST(Whitney, StaysFiniteOnFacesWithoutArea)
{
  const TriangleMesh mesh = SphereWithZeroAreaFaces(2, 3).Mesh();
  const Vector<double> form = Vector<double>::Ones(mesh.NumberOfEdges());
  EXPECT_TRUE(WhitneyAtFaces(mesh, form).allFinite());
  EXPECT_TRUE(WhitneyAtVertices(mesh, FaceFrames(mesh), VertexFrames(mesh), CornersOf(mesh), form).allFinite());
  EXPECT_TRUE(OneFormLaplacian(mesh, SerialContext()).coeffs().allFinite());
}
