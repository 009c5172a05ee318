#include "Analysis/HarmonicBasis.h"

#include "Analysis/HarmonicForms.h"
#include "Operators/ExteriorCalculus.h"
#include "Operators/FaceFieldOperators.h"
#include "Support/Errors.h"
#include "Support/Identities.h"
#include "Support/MeshFactory.h"
#include "Support/ReferenceOperators.h"
#include "Support/TbbContext.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
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

std::vector<Case> Cases()
{
  const Vector3 aside(6.0, 0.0, 0.0);
  return {
    { "sphere", IrregularSphere(2, 2), 0 },
    { "disk", Disk(4), 0 },
    { "torus", IrregularTorus(14, 8, 3), 2 },
    { "smallest torus", Torus(3, 3), 2 },
    { "thin torus", Torus(40, 6, 1.0, 0.01), 2 },
    { "large torus", RotatedAndScaled(IrregularTorus(14, 8, 3), 0.7, 1e5), 2 },
    { "double torus", DoubleTorus(3), 4 },
    { "annulus", Annulus(10, 3), 1 },
    { "cylinder", Prism(7, 5), 1 },
    { "torus and annulus", Union(Torus(8, 6), Annulus(9, 2), aside), 3 },
    { "large and small torus", Union(RotatedAndScaled(Torus(8, 6), 0.3, 1e4), IrregularTorus(12, 6, 4), 1e5 * aside),
      4 },
    { "relabelled double torus", Relabel(DoubleTorus(2), 5).Result, 4 },
  };
}

Eigen::MatrixXd BasisOfForms(const TriangleMesh& mesh, const TangentFrames& frames, const ExecutionContext& context)
{
  return HarmonicBasisOfForms(
    mesh, frames, HarmonicForms(mesh, PartOfContext(context, 0.0, 0.5)), PartOfContext(context, 0.5, 1.0));
}

Eigen::MatrixXd BasisOfFaceFields(
  const TriangleMesh& mesh, const TangentFrames& frames, const ExecutionContext& context)
{
  return HarmonicBasisOfFaceFields(
    mesh, HarmonicFaceFields(mesh, frames, PartOfContext(context, 0.0, 0.5)), PartOfContext(context, 0.5, 1.0));
}

/// Areas, twice per face.
Vector<double> Areas(const TriangleMesh& mesh)
{
  Vector<double> areas(2 * mesh.NumberOfFaces());
  for (int face = 0; face < mesh.NumberOfFaces(); ++face)
  {
    areas.segment<2>(2 * face).setConstant(mesh.FaceArea(face));
  }
  return areas;
}

/// The vectors of 1-forms at the faces, as face fields.
Eigen::MatrixXd FieldsOfForms(const TriangleMesh& mesh, const TangentFrames& frames, const Eigen::MatrixXd& forms)
{
  Eigen::MatrixXd fields(2 * mesh.NumberOfFaces(), forms.cols());
  for (int k = 0; k < forms.cols(); ++k)
  {
    fields.col(k) = FaceFieldFromVectors(frames, WhitneyAtFaces(mesh, forms.col(k)));
  }
  return fields;
}

double DistanceFromIdentity(const Eigen::MatrixXd& matrix)
{
  return (matrix - Eigen::MatrixXd::Identity(matrix.rows(), matrix.cols())).norm();
}

TEST(HarmonicBasis, OfFormsIsOrthonormalAndHarmonic)
{
  for (const Case& surface : Cases())
  {
    SCOPED_TRACE(surface.Name);
    const TriangleMesh mesh = surface.Shape.Mesh();
    const TangentFrames frames = FaceFrames(mesh);
    const Eigen::MatrixXd basis = BasisOfForms(mesh, frames, SerialContext());
    ASSERT_EQ(basis.rows(), mesh.NumberOfEdges());
    ASSERT_EQ(basis.cols(), surface.Dimension);
    if (surface.Dimension == 0)
    {
      continue;
    }
    const Eigen::MatrixXd fields = FieldsOfForms(mesh, frames, basis);
    EXPECT_LE(DistanceFromIdentity(fields.transpose() * Areas(mesh).asDiagonal() * fields), 1e-13);
    // The integral of the product of two gradients by cotangents: a second method.
    const Vector<double> star1 = Star1(mesh);
    EXPECT_LE(DistanceFromIdentity(basis.transpose() * star1.asDiagonal() * basis), 1e-12);

    const double size = basis.cwiseAbs().maxCoeff();
    EXPECT_LE((D1(mesh) * basis).cwiseAbs().maxCoeff(), 1e-13 * size);
    EXPECT_LE((D0(mesh).transpose() * (star1.asDiagonal() * basis)).cwiseAbs().maxCoeff(),
      1e-11 * size * star1.cwiseAbs().maxCoeff());
  }
}

TEST(HarmonicBasis, OfFaceFieldsIsOrthonormalAndHarmonic)
{
  for (const Case& surface : Cases())
  {
    SCOPED_TRACE(surface.Name);
    const TriangleMesh mesh = surface.Shape.Mesh();
    const TangentFrames frames = FaceFrames(mesh);
    const Eigen::MatrixXd basis = BasisOfFaceFields(mesh, frames, SerialContext());
    ASSERT_EQ(basis.rows(), 2 * mesh.NumberOfFaces());
    ASSERT_EQ(basis.cols(), surface.Dimension);
    if (surface.Dimension == 0)
    {
      continue;
    }
    EXPECT_LE(DistanceFromIdentity(basis.transpose() * Areas(mesh).asDiagonal() * basis), 1e-13);
    const double size = basis.cwiseAbs().maxCoeff();
    for (const SparseMatrix<double>& none : { FaceDivergence(mesh, frames), FaceCurl(mesh, frames) })
    {
      EXPECT_LE((none * basis).cwiseAbs().maxCoeff(), 1e-11 * size * LargestEntry(none));
    }
  }
}

// Closed 1-forms are gradients in each face, so that both discretisations have the same harmonic
// fields: either basis is a rotation of the other.
TEST(HarmonicBasis, SpansTheSameFieldsOfBothKinds)
{
  for (const Case& surface : Cases())
  {
    SCOPED_TRACE(surface.Name);
    const TriangleMesh mesh = surface.Shape.Mesh();
    const TangentFrames frames = FaceFrames(mesh);
    const Eigen::MatrixXd ofForms = FieldsOfForms(mesh, frames, BasisOfForms(mesh, frames, SerialContext()));
    const Eigen::MatrixXd ofFields = BasisOfFaceFields(mesh, frames, SerialContext());
    const Eigen::MatrixXd rotation = ofForms.transpose() * Areas(mesh).asDiagonal() * ofFields;
    EXPECT_LE(DistanceFromIdentity(rotation.transpose() * rotation), 1e-11);
  }
}

// Parallel fields, of one length: its square times the area is 1.
TEST(HarmonicBasis, OfAFlatTorusIsParallel)
{
  const TriangleMesh mesh = FlatTorus(12, 1).Mesh();
  const TangentFrames frames = FaceFrames(mesh);
  const double area = 0.5 * Areas(mesh).sum();
  for (const Eigen::MatrixXd& fields : { BasisOfFaceFields(mesh, frames, SerialContext()),
         FieldsOfForms(mesh, frames, BasisOfForms(mesh, frames, SerialContext())) })
  {
    ASSERT_EQ(fields.cols(), 2);
    for (int face = 0; face < mesh.NumberOfFaces(); ++face)
    {
      const Eigen::Matrix2d vectors = fields.middleRows<2>(2 * face);
      EXPECT_LE(DistanceFromIdentity(area * vectors.transpose() * vectors), 1e-9);
    }
  }
}

// The one field of an open cylinder runs around it; along a loop it has the length of the loop over
// the root of the area.
TEST(HarmonicBasis, OfACylinderRunsAround)
{
  const TriangleMesh mesh = Prism(9, 4).Mesh();
  const TangentFrames frames = FaceFrames(mesh);
  const double area = 0.5 * Areas(mesh).sum();
  const Eigen::MatrixXd forms = BasisOfForms(mesh, frames, SerialContext());
  ASSERT_EQ(forms.cols(), 1);
  double circulation = 0.0;
  double circumference = 0.0;
  const double top = mesh.VertexPositions().col(2).maxCoeff();
  for (int h = 0; h < 3 * mesh.NumberOfFaces(); ++h)
  {
    if (mesh.Twin(h) < 0 && mesh.VertexPositions()(mesh.Tail(h), 2) == top)
    {
      circulation += mesh.EdgeSign(h) * forms(mesh.EdgeOf(h), 0);
      circumference += (mesh.VertexPositions().row(mesh.Head(h)) - mesh.VertexPositions().row(mesh.Tail(h))).norm();
    }
  }
  EXPECT_NEAR(std::abs(circulation), circumference / std::sqrt(area), 1e-11 * circumference);
  const Points vectors = WhitneyAtFaces(mesh, forms.col(0));
  EXPECT_LE(vectors.col(2).cwiseAbs().maxCoeff(), 1e-11);
  for (int face = 0; face < mesh.NumberOfFaces(); ++face)
  {
    EXPECT_NEAR(vectors.row(face).norm(), 1.0 / std::sqrt(area), 1e-11);
  }
}

// Faces without area count for nothing and spoil nothing.
TEST(HarmonicBasis, IsFiniteAndOrthonormalBesideFacesWithoutArea)
{
  const TriangleMesh mesh = Union(SphereWithZeroAreaFaces(2, 3), Torus(8, 6), Vector3(6.0, 0.0, 0.0)).Mesh();
  const TangentFrames frames = FaceFrames(mesh);
  for (const Eigen::MatrixXd& fields : { BasisOfFaceFields(mesh, frames, SerialContext()),
         FieldsOfForms(mesh, frames, BasisOfForms(mesh, frames, SerialContext())) })
  {
    ASSERT_EQ(fields.cols(), 2);
    EXPECT_TRUE(fields.allFinite());
    EXPECT_LE(DistanceFromIdentity(fields.transpose() * Areas(mesh).asDiagonal() * fields), 1e-13);
  }
}

TEST(HarmonicBasis, IsTheSameForAnyNumberOfThreads)
{
  const TriangleMesh mesh = IrregularTorus(60, 24, 3).Mesh();
  const TangentFrames frames = FaceFrames(mesh);
  const Eigen::MatrixXd forms = BasisOfForms(mesh, frames, TbbContext(1));
  const Eigen::MatrixXd fields = BasisOfFaceFields(mesh, frames, TbbContext(1));
  for (const int threads : { 2, 5 })
  {
    EXPECT_EQ(BasisOfForms(mesh, frames, TbbContext(threads)), forms);
    EXPECT_EQ(BasisOfFaceFields(mesh, frames, TbbContext(threads)), fields);
  }
}

TEST(HarmonicBasis, ReportsProgressOnceAndStopsWhenAsked)
{
  const TriangleMesh mesh = DoubleTorus(3).Mesh();
  const TangentFrames frames = FaceFrames(mesh);
  for (const auto& make : { BasisOfForms, BasisOfFaceFields })
  {
    TbbContext all(2);
    make(mesh, frames, all);
    const std::vector<double>& progress = all.Progress();
    ASSERT_GE(progress.size(), 10u);
    EXPECT_TRUE(std::is_sorted(progress.begin(), progress.end()));
    EXPECT_EQ(progress.back(), 1.0);
    for (std::size_t count = 1; count <= progress.size(); ++count)
    {
      TbbContext context(2);
      context.CancelAfter(static_cast<int>(count));
      EXPECT_THROW(make(mesh, frames, context), Cancelled);
      EXPECT_EQ(context.Progress().size(), count);
    }
  }
}

TEST(HarmonicForms, AreAsManyAsLoops)
{
  for (const Case& surface : Cases())
  {
    SCOPED_TRACE(surface.Name);
    const TriangleMesh mesh = surface.Shape.Mesh();
    EXPECT_EQ(NumberOfGenerators(mesh), surface.Dimension);
    EXPECT_EQ(ClosedForms(mesh).cols(), surface.Dimension);
  }
}

TEST(HarmonicForms, AreTooManyToHoldBeyondFiftyMillionNumbers)
{
  const TriangleMesh mesh = Torus(50, 10).Mesh(); // 1000 faces
  EXPECT_FALSE(AreTooManyToHold(0, mesh));
  EXPECT_FALSE(AreTooManyToHold(50000, mesh));
  EXPECT_TRUE(AreTooManyToHold(50001, mesh));
  EXPECT_TRUE(AreTooManyToHold(1 << 30, mesh));
}

}
