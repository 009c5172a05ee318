#include "Discretisations/ScalarFunction.h"

#include "FieldSolver.h"
#include "Operators/FaceFieldOperators.h"
#include "Support/Errors.h"
#include "Support/MeshFactory.h"
#include "Support/ReferenceOperators.h"
#include "Support/SolverOfUnknowns.h"
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

FieldOptions Functions(SolverKind solver = SolverKind::ConjugateGradients)
{
  FieldOptions options;
  options.Field.Kind = DiscretisationKind::ScalarFunction;
  options.Constraints = ConstraintKind::Hard;
  options.Solver.Kind = solver;
  return options;
}

/// The values of a function at the boundary.
template <class Function>
Constraints OnBoundary(const TriangleMesh& mesh, const Function& function)
{
  Constraints prescribed;
  for (int vertex = 0; vertex < mesh.NumberOfVertices(); ++vertex)
  {
    if (mesh.IsBoundaryVertex(vertex))
    {
      prescribed.Values.push_back({ vertex, function(Vector3(mesh.Position(vertex))), 1.0 });
    }
  }
  return prescribed;
}

Constraints SomeValues(const TriangleMesh& mesh)
{
  Constraints prescribed;
  for (int vertex = 0; vertex < mesh.NumberOfVertices(); vertex += 97)
  {
    prescribed.Values.push_back({ vertex, std::sin(0.1 * vertex), 1.0 });
  }
  return prescribed;
}

}

// Linear functions are discrete harmonic on any plane mesh, and their gradient is exact.
TEST(ScalarFunction, LinearFunctionsAreReproduced)
{
  const TriangleMesh mesh = IrregularPlane(40, 30, 9).Mesh();
  const Vector3 slope(0.7, -1.3, 0.0);
  const auto linear = [&slope](const Vector3& p) { return 2.0 + slope.dot(p); };
  for (const SolverKind solver : { SolverKind::ConjugateGradients, SolverKind::Cholesky, SolverKind::VCycles })
  {
    SolverOfUnknowns fields(mesh);
    const Vector<double> u = fields.Solve(OnBoundary(mesh, linear), Functions(solver), { 1e-12, 200 });
    EXPECT_TRUE(fields.Report().Converged);
    for (int vertex = 0; vertex < mesh.NumberOfVertices(); ++vertex)
    {
      EXPECT_NEAR(u[vertex], linear(mesh.Position(vertex)), 1e-8);
    }
    const Points gradient = fields.Directions(0);
    for (int face = 0; face < mesh.NumberOfFaces(); ++face)
    {
      EXPECT_LE((Vector3(gradient.row(face)) - slope).norm(), 1e-6);
    }
  }
}

// On a tube between two circles at different values, the function is that of the height.
TEST(ScalarFunction, APotentialRunsAlongATube)
{
  const TriangleMesh mesh = IrregularPlane(64, 20, 3).Mesh();
  const double left = mesh.VertexPositions().col(0).minCoeff();
  const double right = mesh.VertexPositions().col(0).maxCoeff();
  Constraints prescribed;
  for (int vertex = 0; vertex < mesh.NumberOfVertices(); ++vertex)
  {
    const double x = mesh.Position(vertex)[0];
    if (x == left || x == right)
    {
      prescribed.Values.push_back({ vertex, x == left ? -1.0 : 3.0, 1.0 });
    }
  }
  ASSERT_GE(prescribed.Values.size(), 40u);
  SolverOfUnknowns fields(mesh);
  const Vector<double> u = fields.Solve(prescribed, Functions(), { 1e-12, 200 });
  // Natural conditions above and below: nothing crosses them.
  for (int vertex = 0; vertex < mesh.NumberOfVertices(); ++vertex)
  {
    const double x = mesh.Position(vertex)[0];
    EXPECT_NEAR(u[vertex], -1.0 + 4.0 * (x - left) / (right - left), 1e-8);
  }
}

// L0 = - D_V G, a second way to the cotangent Laplacian, and the mean value property that comes with it.
TEST(ScalarFunction, MinimisesTheDirichletEnergy)
{
  const TriangleMesh mesh = IrregularTorus(48, 24, 4).Mesh();
  const TangentFrames frames = FaceFrames(mesh);
  const Constraints prescribed = SomeValues(mesh);
  SolverOfUnknowns fields(mesh);
  const Vector<double> u = fields.Solve(prescribed, Functions(), { 1e-13, 200 });
  Vector<double> residual = FaceDivergence(mesh, frames) * (FaceGradient(mesh, frames) * u);
  for (const ValueConstraint& value : prescribed.Values)
  {
    EXPECT_EQ(u[value.Vertex], value.Value);
    residual[value.Vertex] = 0.0;
  }
  EXPECT_LE(residual.cwiseAbs().maxCoeff(), 1e-8 * u.cwiseAbs().maxCoeff());
}

TEST(ScalarFunction, SolversAndLevelsAgree)
{
  for (const Surface& surface : { IrregularSphere(4, 3), IrregularTorus(64, 32, 4), IrregularPlane(50, 40, 5) })
  {
    const TriangleMesh mesh = surface.Mesh();
    for (const ConstraintKind constraints : { ConstraintKind::Soft, ConstraintKind::Hard })
    {
      FieldOptions options = Functions(SolverKind::Cholesky);
      options.Constraints = constraints;
      SolverOfUnknowns direct(mesh);
      const Vector<double> expected = direct.Solve(SomeValues(mesh), options, { 1e-12, 200 });
      for (const CoarseSpaceKind space : { CoarseSpaceKind::LinearInterpolation, CoarseSpaceKind::StructurePreserving })
      {
        options.Solver.Kind = SolverKind::ConjugateGradients;
        options.CoarseSpace = space;
        SolverOfUnknowns fields(mesh);
        const Vector<double> u = fields.Solve(SomeValues(mesh), options, { 1e-12, 200 });
        EXPECT_LE((u - expected).norm(), 1e-9 * expected.norm()) << fields.Report().Solver;
        EXPECT_LE(fields.Report().Iterations.size(), 26u) << fields.Report().Solver;
      }
    }
  }
}

TEST(ScalarFunction, HasTheSameBitsForAnyNumberOfThreads)
{
  const TriangleMesh mesh = IrregularTorus(64, 32, 4).Mesh();
  const auto solve = [&mesh](const ExecutionContext& context)
  {
    SolverOfUnknowns fields(mesh, context);
    return fields.Solve(SomeValues(mesh), Functions(), {}, context);
  };
  const Vector<double> expected = solve(SerialContext());
  EXPECT_EQ(solve(TbbContext(2)), expected);
  EXPECT_EQ(solve(TbbContext(3)), expected);
}

TEST(ScalarFunction, ValuesAtOneVertexAreAveraged)
{
  const FramedMesh surface(IrregularSphere(2, 3).Mesh());
  const ScalarFunction functions(surface, VertexAreas::MixedVoronoi);
  const FieldConstraints constraints =
    functions.Prescribe({ {}, {}, { { 9, 1.0, 3.0 }, { 4, 2.0, 1.0 }, { 9, 5.0, 1.0 } } }, {});
  EXPECT_EQ(constraints.Elements, (std::vector<int>{ 4, 9 }));
  EXPECT_EQ(constraints.Weights, (std::vector<double>{ 1.0, 4.0 }));
  EXPECT_EQ(constraints.Values[0], 2.0);
  EXPECT_EQ(constraints.Values[1], 2.0);
}

TEST(ScalarFunction, RefusesWhatIsNoValue)
{
  const FramedMesh surface(IrregularSphere(2, 3).Mesh());
  const ScalarFunction functions(surface, VertexAreas::MixedVoronoi);
  const std::vector<std::vector<ValueConstraint>> wrong = { {}, { { -1, 1.0, 1.0 } }, { { 4, std::nan(""), 1.0 } },
    { { 4, 1.0, 0.0 } } };
  for (const std::vector<ValueConstraint>& values : wrong)
  {
    EXPECT_THROW(functions.Prescribe({ {}, {}, values }, {}), InvalidInput);
  }
}

namespace
{

Vector<double> AtVertices(const TriangleMesh& mesh, const std::function<double(const Vector3&)>& function)
{
  Vector<double> values(mesh.NumberOfVertices());
  for (int vertex = 0; vertex < values.size(); ++vertex)
  {
    values[vertex] = function(mesh.Position(vertex));
  }
  return values;
}

/// Of a function with a source on a plane with its values at the boundary.
double ErrorOnPlane(int n, SolverKind solver)
{
  const auto exact = [](const Vector3& p) { return std::exp(p[0]) * std::sin(p[1]) + p[0] * p[0]; };
  Surface shape = IrregularPlane(n, n, 7);
  shape.V /= n;
  SolverOfUnknowns stages(shape.Mesh());
  const TriangleMesh& mesh = stages.Surface().Mesh;
  Constraints constraints = OnBoundary(mesh, exact);
  constraints.Source = Vector<double>::Constant(mesh.NumberOfVertices(), -2.0);
  const Vector<double>& u = stages.Solve(constraints, Functions(solver), { 1e-10, 100 });
  const Vector<double> expected = AtVertices(mesh, exact);
  return (u - expected).norm() / expected.norm();
}

/// Of x y, with -Laplace x y = 6 x y, on the unit sphere.
double ErrorOnSphere(int subdivisions, ConstraintKind kind)
{
  SolverOfUnknowns stages(IrregularSphere(subdivisions, 4, 0.15).Mesh());
  const TriangleMesh& mesh = stages.Surface().Mesh;
  const Vector<double> expected = AtVertices(mesh, [](const Vector3& p) { return p[0] * p[1]; });
  Constraints constraints;
  constraints.Source = 6.0 * expected;
  constraints.Net = NetSource::TakeOut; // what the triangulation adds
  FieldOptions options = Functions();
  options.Constraints = kind;
  const Vector<double> u = stages.Solve(constraints, options, { 1e-10, 100 });
  EXPECT_NEAR(u.dot(IntegratedSource(mesh)), 0.0, 1e-12);
  return (u - expected).norm() / expected.norm();
}

}

TEST(ScalarFunction, SourcesGiveASolutionOfOrderTwo)
{
  for (const SolverKind solver : { SolverKind::ConjugateGradients, SolverKind::Cholesky })
  {
    const double coarse = ErrorOnPlane(12, solver);
    const double fine = ErrorOnPlane(48, solver);
    EXPECT_GT(0.5 * std::log2(coarse / fine), 1.8) << coarse << " " << fine;
  }
}

TEST(ScalarFunction, SourcesOnAClosedSurfaceNeedNoValues)
{
  for (const ConstraintKind kind : { ConstraintKind::Hard, ConstraintKind::Soft })
  {
    const double coarse = ErrorOnSphere(2, kind);
    const double fine = ErrorOnSphere(4, kind);
    EXPECT_GT(0.5 * std::log2(coarse / fine), 1.8) << coarse << " " << fine;
  }
}

TEST(ScalarFunction, NetSourcesAreNamedByTheirIntegral)
{
  // The sphere has a value and may have any source; the plane, of area 1, has none.
  const Surface shape = Union(Icosphere(2), IrregularPlane(9, 9, 3), { 4, 0, 0 });
  SolverOfUnknowns stages(shape.Mesh());
  const TriangleMesh& mesh = stages.Surface().Mesh;
  const double area = mesh.FaceAreas().sum() - Icosphere(2).Mesh().FaceAreas().sum();
  Constraints constraints;
  constraints.Values = { { 0, 1.0, 1.0 } };
  constraints.Source = Vector<double>::Constant(mesh.NumberOfVertices(), 3.0);
  try
  {
    stages.Solve(constraints, Functions());
    FAIL();
  }
  catch (const InvalidInput& error)
  {
    const std::string text = error.what();
    const std::size_t place = text.find("sums to ");
    ASSERT_NE(place, std::string::npos) << text;
    EXPECT_NEAR(std::stod(text.substr(place + 8)), 3.0 * area, 1e-3 * area);
    EXPECT_NE(text.find("component 1"), std::string::npos);
  }
  constraints.Net = NetSource::TakeOut;
  const Vector<double> u = stages.Solve(constraints, Functions(), { 1e-10, 100 });
  EXPECT_EQ(u[0], 1.0);
  EXPECT_LT(u.tail(100).cwiseAbs().maxCoeff(), 1e-9); // a constant source, taken out
  EXPECT_TRUE(stages.Report().Warnings.empty());
}

TEST(ScalarFunction, AChangedSourceRepeatsTheSolveAlone)
{
  SolverOfUnknowns stages(IrregularTorus(40, 20, 3).Mesh());
  const TriangleMesh& mesh = stages.Surface().Mesh;
  Constraints constraints;
  constraints.Net = NetSource::TakeOut;
  constraints.Source = AtVertices(mesh, [](const Vector3& p) { return p[0]; });
  const Vector<double> first = stages.Solve(constraints, Functions(SolverKind::Cholesky));
  constraints.Source *= 2.0;
  const Vector<double> second = stages.Solve(constraints, Functions(SolverKind::Cholesky));
  EXPECT_LT((second - 2.0 * first).norm(), 1e-10 * second.norm());
  EXPECT_EQ(stages.Counts().Setups, 1);
  EXPECT_EQ(stages.Counts().Systems, 1);
  EXPECT_EQ(stages.Counts().Solves, 2);
  stages.Solve(constraints, Functions(SolverKind::Cholesky));
  EXPECT_EQ(stages.Counts().Solves, 2);

  // The equations for somebody else's solver have the source, too.
  const LinearSystem equations = stages.Equations();
  const int grounded = 0; // where this solution is not zero, but for its mean
  Vector<double> shifted = second;
  shifted.array() -= second[grounded];
  EXPECT_LT((equations.Matrix * shifted - equations.RightHandSide).norm(), 1e-9 * equations.RightHandSide.norm());
}

TEST(ScalarFunction, SourcesOfAnySizeAreSolvedForAndWrongOnesNamed)
{
  SolverOfUnknowns stages(IrregularTorus(40, 20, 3).Mesh());
  const TriangleMesh& mesh = stages.Surface().Mesh;
  Constraints constraints;
  constraints.Net = NetSource::TakeOut;
  constraints.Source = AtVertices(mesh, [](const Vector3& p) { return p[0]; });
  const Vector<double> one = stages.Solve(constraints, Functions(), { 1e-9, 100 });
  constraints.Source *= 1e30;
  const Vector<double> large = stages.Solve(constraints, Functions(), { 1e-9, 100 });
  EXPECT_LT((1e-30 * large - one).norm(), 1e-7 * one.norm());
  constraints.Source[5] = std::nan("");
  EXPECT_THROW(stages.Solve(constraints, Functions()), InvalidInput);
  constraints.Source.conservativeResize(3);
  EXPECT_THROW(stages.Solve(constraints, Functions()), InvalidInput);
}
