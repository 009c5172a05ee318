// Functions with given sources and values.

#include "Setup/PoissonSolver.h"

#include "Analysis/BoundaryLoops.h"
#include "Operators/ExteriorCalculus.h"
#include "Operators/FaceFieldOperators.h"
#include "Setup/SetupCache.h"
#include "Support/Errors.h"
#include "Support/MeshFactory.h"
#include "Support/NamedSurfaces.h"
#include "Support/ReferenceOperators.h"
#include "Support/TbbContext.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <string>
#include <vector>

using namespace dmg;
using namespace dmg::test;

namespace
{

const StoppingCriteria Tight{ 1e-12, 200 };

SolverOptions OptionsOf(SolverKind kind)
{
  SolverOptions options;
  options.Kind = kind;
  return options;
}

Vector<double> AtVertices(const std::vector<int>& vertices, const Vector<double>& u)
{
  return u(vertices);
}

/// Any smooth function of the place.
Vector<double> SmoothFunction(const TriangleMesh& mesh)
{
  const Points& V = mesh.VertexPositions();
  return (1.3 * V.col(0)).array().sin() + V.col(1).array() * V.col(0).array() - (0.7 * V.col(2)).array().cos();
}

/// The integral of <grad u, grad lambda_v> for each vertex v, by gradients on faces instead of cotangents.
Vector<double> SourceOf(const FramedMesh& surface, const Vector<double>& u)
{
  return -(FaceDivergence(surface.Mesh, surface.Faces) * (FaceGradient(surface.Mesh, surface.Faces) * u));
}

Vector<double> Centred(const TriangleMesh& mesh, const Vector<double>& u)
{
  const Vector<double> areas = IntegratedSource(mesh);
  return u.array() - areas.dot(u) / areas.sum();
}

std::string MessageOf(const std::function<void()>& work)
{
  try
  {
    work();
  }
  catch (const InvalidInput& error)
  {
    return error.what();
  }
  return {};
}

/// On the unit sphere -Laplace z = 2 z.
double ErrorOnSphere(int subdivisions)
{
  const FramedMesh sphere(IrregularSphere(subdivisions, 11).Mesh());
  const Vector<double> z = sphere.Mesh.VertexPositions().col(2);
  PoissonSolver solver(sphere, {});
  const Vector<double> source = Star0(sphere.Mesh).cwiseProduct(2.0 * z);
  const Vector<double> u = solver.Solve(source, {}, Tight, SerialContext(), NetSource::TakeOut);
  return (u - z).norm() / z.norm();
}

/// Each triangle a hundred times as long as it is high.
Surface PlaneOfThinTriangles()
{
  Surface plane = IrregularPlane(24, 24, 7);
  plane.V.col(1) *= 0.01;
  return plane;
}

}

TEST(PoissonSolver, LinearFunctionsAreReproducedOnBadTriangles)
{
  for (const Surface& shape : { IrregularPlane(30, 20, 7), PlaneOfThinTriangles() })
  {
    const FramedMesh plane(shape.Mesh());
    const Vector<double> linear = 2.0 * plane.Mesh.VertexPositions().col(0) - plane.Mesh.VertexPositions().col(1);
    const std::vector<int> boundary = BoundaryVertices(plane.Mesh);
    for (const SolverKind kind : { SolverKind::Cholesky, SolverKind::ConjugateGradients })
    {
      PoissonSolver solver(plane, boundary, OptionsOf(kind));
      const Vector<double> u = solver.Solve({}, AtVertices(boundary, linear), Tight);
      EXPECT_TRUE(solver.Report().Converged);
      EXPECT_LT((u - linear).cwiseAbs().maxCoeff(), 1e-9 * linear.cwiseAbs().maxCoeff());
    }
  }
}

TEST(PoissonSolver, FunctionsAreFoundFromTheirSourcesOnEveryKindOfSurface)
{
  const TbbContext context(2);
  for (const NamedSurface& named : SurfacesToDecimate())
  {
    SCOPED_TRACE(named.Name);
    const FramedMesh surface(named.Shape.Mesh());
    if (FaceComponents(surface.Mesh).back() > 0)
    {
      continue; // components have a test of their own
    }
    const Vector<double> u0 = SmoothFunction(surface.Mesh);
    const Vector<double> source = SourceOf(surface, u0);
    for (const SolverKind kind : { SolverKind::Cholesky, SolverKind::ConjugateGradients })
    {
      PoissonSolver solver(surface, {}, OptionsOf(kind), context);
      const Vector<double> u = solver.Solve(source, {}, Tight, context);
      EXPECT_LT((u - Centred(surface.Mesh, u0)).norm(), 1e-7 * u0.norm());
      PoissonSolver fixed(surface, { 3, 5 }, OptionsOf(kind), context);
      const Vector<double> h = fixed.Solve(source, AtVertices({ 3, 5 }, u0), Tight, context);
      EXPECT_LT((h - u0).norm(), 1e-7 * u0.norm());
    }
  }
}

TEST(PoissonSolver, ConstantSourceOnADiscHasItsExactSolution)
{
  const FramedMesh disc(Disk(20).Mesh()); // each ring of vertices sees the same triangles
  PoissonSolver solver(disc, BoundaryVertices(disc.Mesh));
  const Vector<double> u = solver.Solve(Star0(disc.Mesh), {}, Tight);
  const Vector<double> exact = 0.25 * (1.0 - disc.Mesh.VertexPositions().rowwise().squaredNorm().array());
  EXPECT_LT((u - exact).cwiseAbs().maxCoeff(), 1e-11);
}

TEST(PoissonSolver, EigenfunctionsOfTheSphereConvergeWithOrderTwo)
{
  const double coarse = ErrorOnSphere(2);
  const double middle = ErrorOnSphere(3);
  const double fine = ErrorOnSphere(4);
  EXPECT_LT(coarse, 0.01);
  EXPECT_GT(std::log2(coarse / fine), 2.0 * 1.8) << coarse << " " << middle << " " << fine;
}

TEST(PoissonSolver, ComponentsAreFixedOneByOne)
{
  const Surface sphere = Icosphere(2);
  const Surface ring = Annulus(20, 5);
  const FramedMesh both(Union(sphere, ring, { 5.0, 0.0, 0.0 }).Mesh());
  const FramedMesh first(sphere.Mesh());
  const int onSphere = first.Mesh.NumberOfVertices();
  const Vector<double> u0 = SmoothFunction(both.Mesh);
  const Vector<double> source = SourceOf(both, u0);

  PoissonSolver solver(both, { onSphere + 2 }); // on the ring alone
  const Vector<double> u = solver.Solve(source, Vector<double>::Constant(1, u0[onSphere + 2]), Tight);
  EXPECT_LT((u.head(onSphere) - Centred(first.Mesh, u0.head(onSphere))).norm(), 1e-9 * u0.norm());
  EXPECT_LT((u.tail(u.size() - onSphere) - u0.tail(u.size() - onSphere)).norm(), 1e-9 * u0.norm());
}

TEST(PoissonSolver, NetSourceIsNamedOrTakenOut)
{
  const FramedMesh sphere(IrregularSphere(2, 3).Mesh());
  const Vector<double> areas = IntegratedSource(sphere.Mesh);
  const Vector<double> balanced = SourceOf(sphere, SmoothFunction(sphere.Mesh));
  const Vector<double> source = balanced + areas * (2.5 / areas.sum());
  PoissonSolver solver(sphere, {});
  const std::string message = MessageOf([&] { solver.Solve(source); });
  EXPECT_NE(message.find("sums to 2.5,"), std::string::npos) << message;
  const Vector<double> u = solver.Solve(source, {}, Tight, SerialContext(), NetSource::TakeOut);
  EXPECT_LT((u - solver.Solve(balanced, {}, Tight)).norm(), 1e-10 * u.norm());
  EXPECT_NEAR(areas.dot(u), 0.0, 1e-12 * areas.dot(u.cwiseAbs()));
  PoissonSolver fixed(sphere, { 0 }); // takes the rest up
  EXPECT_TRUE(fixed.Solve(source).allFinite());
}

TEST(PoissonSolver, ManySolversAndSourcesShareOneSetup)
{
  const FramedMesh torus(IrregularTorus(60, 30, 5).Mesh());
  for (const SolverKind kind : { SolverKind::Cholesky, SolverKind::ConjugateGradients })
  {
    SetupCache setups(torus);
    PoissonSolver closed(setups, {}, OptionsOf(kind));
    PoissonSolver fixed(setups, { 7, 90 }, OptionsOf(kind));
    PoissonSolver fresh(torus, { 7, 90 }, OptionsOf(kind));
    const Vector<double> values = Vector2(1.0, -2.0);
    const Vector<double> source = SourceOf(torus, SmoothFunction(torus.Mesh));
    EXPECT_EQ(fixed.Solve(source, values), fresh.Solve(source, values));
    EXPECT_EQ(fixed.Solve({}, values), fresh.Solve({}, values));
    closed.Solve(source);
    EXPECT_TRUE(closed.HasNewSetup());
    EXPECT_FALSE(fixed.HasNewSetup());
    EXPECT_EQ(fixed.Fixed(), (std::vector<int>{ 7, 90 }));
  }
}

TEST(PoissonSolver, TheLastSolutionIsAGoodStart)
{
  const FramedMesh torus(IrregularTorus(60, 30, 5).Mesh());
  const Vector<double> source = SourceOf(torus, SmoothFunction(torus.Mesh));
  PoissonSolver solver(torus, {}, OptionsOf(SolverKind::ConjugateGradients));
  const Vector<double> u = solver.Solve(source);
  const std::size_t iterations = solver.Report().Iterations.size();
  solver.Solve(1.0001 * source, {}, {}, SerialContext(), NetSource::Refuse, u);
  EXPECT_LT(solver.Report().Iterations.size(), iterations);
}

TEST(PoissonSolver, WhereAllValuesAreFixedTheyAreTheSolution)
{
  const FramedMesh strip(Strip({ 1.0, 2.0, 0.5 }).Mesh());
  const std::vector<int> all = BoundaryVertices(strip.Mesh);
  ASSERT_EQ(static_cast<int>(all.size()), strip.Mesh.NumberOfVertices());
  PoissonSolver solver(strip, all);
  const Vector<double> values = SmoothFunction(strip.Mesh);
  EXPECT_EQ(solver.Solve(values, values), values);
  EXPECT_TRUE(solver.Report().Converged);
}

TEST(PoissonSolver, WrongNumbersAreNamed)
{
  const FramedMesh sphere(Icosphere(1).Mesh());
  EXPECT_NE(
    MessageOf([&] { PoissonSolver(sphere, { 42 }); }).find("vertex 42 is not one of the 42"), std::string::npos);
  EXPECT_NE(MessageOf([&] { PoissonSolver(sphere, { 3, 3 }); }).find("vertex 3 does not follow"), std::string::npos);
  PoissonSolver solver(sphere, { 3 });
  Vector<double> source = Vector<double>::Zero(42);
  source[5] = std::nan("");
  EXPECT_NE(MessageOf([&] { solver.Solve(source); }).find("number 5 of the source"), std::string::npos);
  EXPECT_NE(
    MessageOf([&] { solver.Solve(Vector<double>::Zero(3)); }).find("has 3 numbers in place of 42"), std::string::npos);
}
