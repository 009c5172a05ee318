// Derivatives of flows, and the loops of boundaries.

#include "Flows/FlowOperators.h"

#include "Analysis/BoundaryLoops.h"
#include "Operators/ExteriorCalculus.h"
#include "Operators/FaceFieldOperators.h"
#include "Support/ComplexPairs.h"
#include "Support/MeshFactory.h"
#include "Support/NamedSurfaces.h"
#include "Support/ReferenceOperators.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace dmg;
using namespace dmg::test;

TEST(FlowOperators, GradientAndDivergenceAreTheMatrices)
{
  for (const NamedSurface& named : SmallSurfaces())
  {
    SCOPED_TRACE(named.Name);
    const FramedMesh surface(named.Shape.Mesh());
    const Vector<double> u = Vector<double>::Random(surface.Mesh.NumberOfVertices());
    const Vector<Complex> gradient = GradientOnFaces(surface, u);
    const Vector<double> expected = FaceGradient(surface.Mesh, surface.Faces) * u;
    EXPECT_LT((AsPairs(gradient) - expected).norm(), 1e-12 * expected.norm());
    const Vector<double> divergence = IntegratedDerivatives(surface, gradient).Divergence;
    const Vector<double> vorticity = IntegratedDerivatives(surface, Complex(0.0, 1.0) * gradient).Vorticity;
    EXPECT_LT((vorticity - divergence).norm(), 1e-14 * divergence.norm());
    const Vector<double> ofMatrix = FaceDivergence(surface.Mesh, surface.Faces) * expected;
    EXPECT_LT((divergence - ofMatrix).norm(), 1e-12 * ofMatrix.norm());
    EXPECT_NEAR(divergence.sum(), 0.0, 1e-12 * divergence.cwiseAbs().sum());
    EXPECT_NEAR(FlowProduct(surface.Mesh.FaceAreas(), gradient, gradient), -u.dot(divergence),
      1e-12 * std::abs(u.dot(divergence)));
  }
}

TEST(FlowOperators, DifferencesOfAFunctionAreItsGradient)
{
  for (const NamedSurface& named : SmallSurfaces())
  {
    SCOPED_TRACE(named.Name);
    const FramedMesh surface(named.Shape.Mesh());
    const Vector<double> u = Vector<double>::Random(surface.Mesh.NumberOfVertices());
    const Vector<Complex> flow = FlowOfForm(surface, D0(surface.Mesh) * u);
    const Vector<Complex> gradient = GradientOnFaces(surface, u);
    EXPECT_LT((flow - gradient).norm(), 1e-13 * gradient.norm());
    const FlowDerivatives derivatives = IntegratedDerivatives(surface, flow);
    for (int vertex = 0; vertex < u.size(); ++vertex)
    {
      if (!surface.Mesh.IsBoundaryVertex(vertex))
      {
        EXPECT_NEAR(derivatives.Vorticity[vertex], 0.0, 1e-12 * derivatives.Divergence.cwiseAbs().maxCoeff());
      }
    }
  }
}

TEST(FlowOperators, AFormOfARotationAndAConstantHasItsVectors)
{
  const FramedMesh plane(IrregularPlane(12, 9, 5).Mesh());
  const auto field = [](const Vector3& p) { return Vector3(1.0 - 3.0 * p[1], 2.0 + 3.0 * p[0], 0.0); };
  Vector<double> form(plane.Mesh.NumberOfEdges());
  for (int edge = 0; edge < form.size(); ++edge)
  {
    const auto [a, b] = plane.Mesh.EdgeVertices(edge);
    const Vector3 middle = 0.5 * (plane.Mesh.Position(a) + plane.Mesh.Position(b));
    form[edge] = field(middle).dot(plane.Mesh.Position(b) - plane.Mesh.Position(a)); // exact, as the field is linear
  }
  const Vector<Complex> flow = FlowOfForm(plane, form);
  for (int face = 0; face < flow.size(); ++face)
  {
    Vector3 centre = Vector3::Zero();
    for (int k = 0; k < 3; ++k)
    {
      centre += plane.Mesh.Position(plane.Mesh.FaceCorners()(face, k)) / 3.0;
    }
    EXPECT_LT(std::abs(flow[face] - plane.Faces.ToComplex(face, field(centre))), 1e-11);
  }
}

TEST(BoundaryLoops, HaveTheSurfaceToTheirLeftAndTheLongestFirst)
{
  const TriangleMesh mesh = Union(Annulus(40, 3), Union(Disk(4), Icosphere(1), { 5, 0, 0 }), { 5, 0, 0 }).Mesh();
  const std::vector<BoundaryLoop> loops = FindBoundaryLoops(mesh);
  ASSERT_EQ(loops.size(), 3u);
  EXPECT_EQ(loops[0].Component, 0);
  EXPECT_EQ(loops[1].Component, 0);
  EXPECT_EQ(loops[2].Component, 1);
  EXPECT_NEAR(loops[0].Length, 80.0 * 2.0 * std::sin(Pi / 40.0), 1e-12); // radius 2
  EXPECT_NEAR(loops[1].Length, 40.0 * 2.0 * std::sin(Pi / 40.0), 1e-12);
  EXPECT_NEAR(loops[2].Length, 24.0 * 2.0 * std::sin(Pi / 24.0), 1e-12);
  const Vector3 a = mesh.Position(loops[0].Vertices[0]);
  const Vector3 b = mesh.Position(loops[0].Vertices[1]);
  EXPECT_GT(a.cross(b)[2], 0.0); // counter-clockwise around the outer circle
  const Vector3 c = mesh.Position(loops[1].Vertices[0]);
  const Vector3 d = mesh.Position(loops[1].Vertices[1]);
  EXPECT_LT(c.cross(d)[2], 0.0);
}
