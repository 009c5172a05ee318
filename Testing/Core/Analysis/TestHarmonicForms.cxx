#include "Analysis/HarmonicForms.h"

#include "Operators/ExteriorCalculus.h"
#include "Operators/FaceFieldOperators.h"
#include "StructurePreserving/SurfaceHierarchy.h"
#include "Support/Identities.h"
#include "Support/MeshFactory.h"
#include "Support/ReferenceOperators.h"
#include "Support/TbbContext.h"

#include <Eigen/Dense>
#include <gtest/gtest.h>

#include <string>
#include <vector>

namespace
{

using namespace dmg;
using namespace dmg::test;

struct Case
{
  std::string Name;
  Surface Shape;
  int Dimension; ///< sum over components of 2 g, or 2 g + b - 1 with b > 0 boundary loops
};

/// A double torus from which the faces \p first and \p second are taken; they share no vertex.
Surface WithoutFaces(const Surface& surface, int first, int second)
{
  Surface result{ surface.V, Triangles(surface.F.rows() - 2, 3) };
  int next = 0;
  for (int face = 0; face < surface.F.rows(); ++face)
  {
    if (face != first && face != second)
    {
      result.F.row(next++) = surface.F.row(face);
    }
  }
  return result;
}

std::vector<Case> Cases()
{
  const Vector3 aside(6.0, 0.0, 0.0);
  return {
    { "sphere", IrregularSphere(2, 2), 0 },
    { "needle", Needle(2, 50.0), 0 },
    { "torus", IrregularTorus(14, 8, 3), 2 },
    { "smallest torus", Torus(3, 3), 2 },
    { "double torus", DoubleTorus(3), 4 },
    { "plane", IrregularPlane(8, 6, 1), 0 },
    { "disk", Disk(4), 0 },
    { "annulus", Annulus(10, 3), 1 },
    { "cylinder", Prism(7, 5), 1 },
    { "torus with two holes", WithoutFaces(IrregularTorus(14, 8, 3), 0, 150), 3 },
    { "sphere and torus", Union(Icosphere(1), IrregularTorus(12, 6, 4), aside), 2 },
    { "torus and annulus", Union(Torus(8, 6), Annulus(9, 2), aside), 3 },
    { "two tori", Union(Torus(8, 6), IrregularTorus(12, 6, 4), aside), 4 },
    { "relabelled double torus", Relabel(DoubleTorus(2), 5).Result, 4 },
  };
}

void ExpectOrthonormal(const Eigen::MatrixXd& columns)
{
  const Eigen::MatrixXd gram = columns.transpose() * columns;
  EXPECT_LE((gram - Eigen::MatrixXd::Identity(gram.rows(), gram.cols())).norm(), 1e-13);
}

int Rank(const Eigen::MatrixXd& columns)
{
  return static_cast<int>(Eigen::ColPivHouseholderQR<Eigen::MatrixXd>(columns).rank());
}

TEST(ClosedForms, AreClosedByIntegersAndNoGradients)
{
  for (const Case& surface : Cases())
  {
    SCOPED_TRACE(surface.Name);
    const TriangleMesh mesh = surface.Shape.Mesh();
    const Eigen::MatrixXd forms = ClosedForms(mesh);
    ASSERT_EQ(forms.rows(), mesh.NumberOfEdges());
    ASSERT_EQ(forms.cols(), surface.Dimension);
    if (surface.Dimension == 0)
    {
      continue;
    }
    EXPECT_EQ(forms, forms.array().round().matrix());
    EXPECT_EQ((D1(mesh, SerialContext()) * forms).cwiseAbs().maxCoeff(), 0.0);
    const Eigen::MatrixXd gradients(D0(mesh, SerialContext()));
    Eigen::MatrixXd both(mesh.NumberOfEdges(), gradients.cols() + forms.cols());
    both << gradients, forms;
    EXPECT_EQ(Rank(both), Rank(gradients) + surface.Dimension);
  }
}

/// Surfaces that two levels of edge collapses leave enough of.
std::vector<Case> CasesWithLevels()
{
  const Vector3 aside(6.0, 0.0, 0.0);
  return {
    { "torus", IrregularTorus(18, 10, 3), 2 },
    { "double torus", DoubleTorus(3), 4 },
    { "annulus", Annulus(20, 6), 1 },
    { "torus with two holes", WithoutFaces(IrregularTorus(18, 10, 3), 0, 200), 3 },
    { "torus and annulus", Union(IrregularTorus(14, 8, 4), Annulus(20, 5), aside), 3 },
    { "sphere", IrregularSphere(2, 2), 0 },
  };
}

ProlongationOperators OperatorsWithLevels(const TriangleMesh& mesh, ProlongationConstruction construction)
{
  HierarchyOptions options;
  options.MinimumNumberOfFaces = 30;
  options.MaximumNumberOfCoarseLevels = 2;
  options.Construction = construction;
  ProlongationOperators operators =
    BuildSurfaceHierarchy(mesh, options, SerialContext(), { false, false, true }).Operators;
  EXPECT_EQ(operators.NumberOfLevels(), 3);
  return operators;
}

TEST(ProlongedClosedForms, HaveTheClassesOfTheCoarsestLevel)
{
  // Closed forms by integers have integers for integrals around the loops of their level. S1 keeps these, and the
  // forms of either level have all of them: what is prolonged is, up to gradients, an integer combination
  // of the fine level's own, and the other way around.
  for (const auto construction : { ProlongationConstruction::TrackedPaths, ProlongationConstruction::ExactOverlay })
  {
    for (const Case& surface : CasesWithLevels())
    {
      SCOPED_TRACE(surface.Name);
      const TriangleMesh mesh = surface.Shape.Mesh();
      const ProlongationOperators operators = OperatorsWithLevels(mesh, construction);
      const Eigen::MatrixXd forms = ProlongedClosedForms(operators, SerialContext());
      ASSERT_EQ(forms.rows(), mesh.NumberOfEdges());
      ASSERT_EQ(forms.cols(), surface.Dimension);
      if (surface.Dimension == 0)
      {
        continue;
      }
      EXPECT_LE((D1(mesh, SerialContext()) * forms).cwiseAbs().maxCoeff(), 1e-12);
      const Eigen::MatrixXd gradients(D0(mesh, SerialContext()));
      Eigen::MatrixXd both(mesh.NumberOfEdges(), gradients.cols() + forms.cols());
      both << gradients, ClosedForms(mesh);
      const Eigen::MatrixXd parts = Eigen::CompleteOrthogonalDecomposition<Eigen::MatrixXd>(both).solve(forms);
      EXPECT_LE((both * parts - forms).cwiseAbs().maxCoeff(), 1e-11);
      const Eigen::MatrixXd combination = parts.bottomRows(surface.Dimension);
      EXPECT_LE((combination - combination.array().round().matrix()).cwiseAbs().maxCoeff(), 1e-10);
      EXPECT_NEAR(std::abs(combination.determinant()), 1.0, 1e-9);
    }
  }
}

TEST(HarmonicForms, OfTheCoarsestLevelAreThoseOfTheSurface)
{
  for (const Case& surface : CasesWithLevels())
  {
    SCOPED_TRACE(surface.Name);
    const TriangleMesh mesh = surface.Shape.Mesh();
    const ProlongationOperators operators = OperatorsWithLevels(mesh, ProlongationConstruction::TrackedPaths);
    const Eigen::MatrixXd prolonged = HarmonicForms(mesh, SerialContext(), &operators);
    const Eigen::MatrixXd own = HarmonicForms(mesh, SerialContext());
    ASSERT_EQ(prolonged.cols(), surface.Dimension);
    if (surface.Dimension == 0)
    {
      continue;
    }
    ExpectOrthonormal(prolonged);
    EXPECT_LE((prolonged - own * (own.transpose() * prolonged)).norm(), 1e-10);
  }
}

TEST(HarmonicForms, AreAsManyAsTheHierarchyHas)
{
  // It is asked where it has any: what it lacks is missed.
  const TriangleMesh mesh = IrregularTorus(18, 10, 3).Mesh();
  ProlongationOperators operators = OperatorsWithLevels(mesh, ProlongationConstruction::TrackedPaths);
  operators.ClosedForms = SparseMatrix<double>(operators.ClosedForms.leftCols(1));
  EXPECT_EQ(HarmonicForms(mesh, SerialContext(), &operators).cols(), 1);
  EXPECT_EQ(HarmonicFaceFields(mesh, FaceFrames(mesh), SerialContext(), &operators).cols(), 1);
  operators.ClosedForms.resize(0, 0); // stored operators
  EXPECT_EQ(HarmonicForms(mesh, SerialContext(), &operators).cols(), 2);
}

TEST(HarmonicForms, HaveNeitherCurlNorDivergence)
{
  for (const Case& surface : Cases())
  {
    SCOPED_TRACE(surface.Name);
    const TriangleMesh mesh = surface.Shape.Mesh();
    const Eigen::MatrixXd forms = HarmonicForms(mesh, SerialContext());
    ASSERT_EQ(forms.rows(), mesh.NumberOfEdges());
    ASSERT_EQ(forms.cols(), surface.Dimension);
    if (surface.Dimension == 0)
    {
      continue;
    }
    ExpectOrthonormal(forms);
    EXPECT_LE((D1(mesh, SerialContext()) * forms).cwiseAbs().maxCoeff(), 1e-13);
    const Vector<double> star1 = Star1(mesh);
    const Eigen::MatrixXd divergence = D0(mesh, SerialContext()).transpose() * (star1.asDiagonal() * forms);
    EXPECT_LE(divergence.cwiseAbs().maxCoeff(), 1e-11 * star1.cwiseAbs().maxCoeff());
    const SparseMatrix<double> L1 = OneFormLaplacian(mesh, SerialContext());
    EXPECT_LE((L1 * forms).norm(), 1e-10 * L1.norm());
  }
}

TEST(HarmonicForms, AreTheKernelOfTheLaplacian)
{
  // The dimension by a second method: the spectrum.
  for (const Surface& surface : { IrregularTorus(10, 6, 3), Annulus(10, 3), DoubleTorus(2) })
  {
    const TriangleMesh mesh = surface.Mesh();
    const Vector<double> eigenvalues = SymmetricEigenvalues(OneFormLaplacian(mesh, SerialContext()));
    const auto dimension = (eigenvalues.array() < 1e-11 * eigenvalues[eigenvalues.size() - 1]).count();
    EXPECT_EQ(HarmonicForms(mesh, SerialContext()).cols(), dimension);
  }
}

TEST(HarmonicFaceFields, AreTheKernelOfTheirSmoothness)
{
  for (const Case& surface : Cases())
  {
    SCOPED_TRACE(surface.Name);
    const TriangleMesh mesh = surface.Shape.Mesh();
    const TangentFrames frames = FaceFrames(mesh);
    const Eigen::MatrixXd fields = HarmonicFaceFields(mesh, frames, SerialContext());
    ASSERT_EQ(fields.rows(), 2 * mesh.NumberOfFaces());
    ASSERT_EQ(fields.cols(), surface.Dimension);
    if (surface.Dimension == 0)
    {
      continue;
    }
    ExpectOrthonormal(fields);
    const SparseMatrix<double> A = FaceFieldSmoothness(mesh, frames);
    EXPECT_LE((A * fields).norm(), 1e-10 * A.norm());
  }
}

/// The surface with one triangle flattened: a corner comes as near to the middle of the opposite side as gives that area.
Surface WithFlatTriangle(Surface surface, int face, double area)
{
  const auto corner = [&](int k) { return Vector3(surface.V.row(surface.F(face, k))); };
  const Vector3 side = corner(1) - corner(0);
  const Vector3 middle = 0.5 * (corner(0) + corner(1));
  const Vector3 away = (corner(2) - middle) - (corner(2) - middle).dot(side) / side.squaredNorm() * side;
  surface.V.row(surface.F(face, 2)) = middle + 2.0 * area / side.norm() * away.normalized();
  return surface;
}

TEST(HarmonicFaceFields, HaveNoEnergyOnSurfacesWithAFlatTriangle)
{
  for (const double area : { 1e-3, 1e-5, 1e-7, 1e-9, 1e-11, 1e-13, 0.0 })
  {
    SCOPED_TRACE(area);
    const TriangleMesh mesh = WithFlatTriangle(DoubleTorus(2), 7, area).Mesh();
    const TangentFrames frames = FaceFrames(mesh);
    const Eigen::MatrixXd fields = HarmonicFaceFields(mesh, frames, SerialContext());
    ASSERT_EQ(fields.cols(), 4);
    const Eigen::MatrixXd energies = fields.transpose() * (FaceFieldSmoothness(mesh, frames) * fields);
    EXPECT_LE(energies.cwiseAbs().maxCoeff(), 1e-9);
  }
}

TEST(HarmonicFaceFields, OfAFlatTorusAreParallel)
{
  // All vectors of a parallel field have the same length, also in a sum of two.
  const TriangleMesh mesh = FlatTorus(12, 1).Mesh();
  const Eigen::MatrixXd fields = HarmonicFaceFields(mesh, FaceFrames(mesh), SerialContext());
  ASSERT_EQ(fields.cols(), 2);
  for (const Vector2& factors : { Vector2(1.0, 0.0), Vector2(0.0, 1.0), Vector2(0.6, -0.8) })
  {
    const Vector<double> field = fields * factors;
    for (int face = 0; face < mesh.NumberOfFaces(); ++face)
    {
      EXPECT_NEAR(field.segment<2>(2 * face).squaredNorm() * mesh.NumberOfFaces(), 1.0, 1e-10);
    }
  }
}

TEST(HarmonicForms, OfAnAnnulusRunAround)
{
  // The harmonic field of a ring is that of a vortex, d(angle): the same along each chord of a
  // circle, nothing across the regular rings of this annulus.
  const int around = 24;
  const TriangleMesh mesh = Annulus(around, 6).Mesh();
  const Eigen::MatrixXd forms = HarmonicForms(mesh, SerialContext());
  ASSERT_EQ(forms.cols(), 1);
  // Around either boundary the form has the same integral.
  double inner = 0.0;
  double outer = 0.0;
  for (int h = 0; h < 3 * mesh.NumberOfFaces(); ++h)
  {
    if (mesh.Twin(h) < 0)
    {
      const bool isInner = mesh.VertexPositions().row(mesh.Tail(h)).norm() < 1.5;
      (isInner ? inner : outer) += mesh.EdgeSign(h) * forms(mesh.EdgeOf(h), 0);
    }
  }
  EXPECT_NEAR(inner + outer, 0.0, 1e-13); // they run in opposite directions
  EXPECT_GT(std::abs(outer), 0.1);
}

TEST(HarmonicForms, AreTheSameForAnyNumberOfThreads)
{
  const TriangleMesh mesh = IrregularTorus(60, 24, 3).Mesh();
  const TangentFrames frames = FaceFrames(mesh);
  const Eigen::MatrixXd expected = HarmonicFaceFields(mesh, frames, TbbContext(1));
  for (const int threads : { 2, 5 })
  {
    EXPECT_EQ(HarmonicFaceFields(mesh, frames, TbbContext(threads)), expected);
  }
}

}
