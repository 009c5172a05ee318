// Fields whose singularities are prescribed.

#include "SingularFieldSolver.h"

#include "Operators/ExteriorCalculus.h"
#include "Operators/FieldTopology.h"
#include "Operators/PowerFieldDirections.h"
#include "Support/ComplexPairs.h"
#include "Support/Errors.h"
#include "Support/MeshFactory.h"
#include "Support/TbbContext.h"

#include <Eigen/QR>
#include <gtest/gtest.h>

#include <map>
#include <string>
#include <vector>

using namespace dmg;
using namespace dmg::test;

namespace
{

FieldOptions OptionsOf(int N, SolverKind solver = SolverKind::Automatic)
{
  FieldOptions options;
  options.Field.N = N;
  options.Solver.Kind = solver;
  return options;
}

int VertexNearTo(const TriangleMesh& mesh, const Vector3& place)
{
  int nearest = -1;
  for (int vertex = 0; vertex < mesh.NumberOfVertices(); ++vertex)
  {
    const bool isNearer = nearest < 0 ||
      (mesh.Position(vertex) - place).norm() < (mesh.Position(nearest) - place).norm();
    nearest = isNearer && !mesh.IsBoundaryVertex(vertex) ? vertex : nearest;
  }
  return nearest;
}

/// A singularity wherever a place is given, its index times / N.
std::vector<PrescribedSingularity> At(
  const TriangleMesh& mesh, const std::vector<Vector3>& places, int times)
{
  std::vector<PrescribedSingularity> singularities;
  for (const Vector3& place : places)
  {
    singularities.push_back({ VertexNearTo(mesh, place), times });
  }
  return singularities;
}

std::vector<Vector3> CornersOfCube()
{
  std::vector<Vector3> corners;
  for (int k = 0; k < 8; ++k)
  {
    corners.emplace_back(k & 1 ? 1.0 : -1.0, k & 2 ? 1.0 : -1.0, k & 4 ? 1.0 : -1.0);
  }
  return corners;
}

const std::vector<Vector3> EndsOfAxes{ { 1, 0, 0 }, { -1, 0, 0 }, { 0, 1, 0 }, { 0, -1, 0 },
  { 0, 0, 1 }, { 0, 0, -1 } };

std::vector<PrescribedSingularity> Joined(
  std::vector<PrescribedSingularity> a, const std::vector<PrescribedSingularity>& b)
{
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

FieldTopology TopologyOf(const SingularFieldSolver& solver)
{
  const auto& [mesh, faces, vertices] = solver.Surface();
  const int N = solver.Field().DirectionsPerPoint();
  return TopologyOfField(
    mesh, faces, FirstDirections(AsComplex(solver.Unknowns()), N), N);
}

/// Expects the singularities that are prescribed, to the vertex, no others, and a field of magnitude 1.
void ExpectPrescribed(const SingularFieldSolver& solver,
  const std::vector<PrescribedSingularity>& singularities, const std::string& name)
{
  const TriangleMesh& mesh = solver.Surface().Mesh;
  const int N = solver.Field().DirectionsPerPoint();
  std::map<int, int> expected, found;
  for (const auto& [vertex, times] : singularities)
  {
    expected[vertex] += times;
  }
  const Vector<double> indices = TopologyOf(solver).Indices;
  for (int vertex = 0; vertex < mesh.NumberOfVertices(); ++vertex)
  {
    const auto times = static_cast<int>(std::lround(N * indices[vertex]));
    if (times != 0)
    {
      found[vertex] = times;
    }
  }
  for (auto it = expected.begin(); it != expected.end();)
  {
    it = it->second == 0 ? expected.erase(it) : std::next(it);
  }
  EXPECT_EQ(found, expected) << name;
  EXPECT_TRUE(solver.Report().Converged) << name;
  EXPECT_TRUE(solver.Report().Warnings.empty()) << name << ": " << solver.Report().Warnings[0];
  const Vector<Complex> powers = AsComplex(solver.Unknowns());
  EXPECT_LT((powers.cwiseAbs().array() - 1.0).abs().maxCoeff(), 1e-14) << name;
}

struct Case
{
  std::string Name;
  Surface Shape;
  int N;
  std::vector<std::pair<std::vector<Vector3>, int>> Places;
};

Surface Ellipsoid(int subdivisions)
{
  Surface surface = IrregularSphere(subdivisions, 7);
  surface.V = surface.V * Vector3(1.0, 1.3, 2.0).asDiagonal();
  return surface;
}

std::vector<Case> Cases()
{
  const std::vector<Vector3> poles{ { 0, 0, 1 }, { 0, 0, -1 } };
  return {
    { "crosses on a sphere", IrregularSphere(3, 3), 4, { { CornersOfCube(), 1 } } },
    { "vectors on a sphere", IrregularSphere(3, 3), 1, { { poles, 1 } } },
    { "lines on a sphere", IrregularSphere(3, 3), 2, { { poles, 2 } } },
    { "thirds on a sphere", IrregularSphere(3, 3), 3, { { EndsOfAxes, 1 } } },
    { "crosses on an ellipsoid", Ellipsoid(3), 4, { { CornersOfCube(), 1 } } },
    { "more and less on an ellipsoid", Ellipsoid(3), 4,
      { { CornersOfCube(), 2 }, { EndsOfAxes, -1 }, { poles, -1 } } },
    { "nothing on a torus", IrregularTorus(40, 20, 5), 4, {} },
    { "vectors on a torus", IrregularTorus(40, 20, 5), 1, {} },
    { "a pair on a torus", IrregularTorus(40, 20, 5), 4,
      { { { { 1.4, 0, 0 } }, 1 }, { { { -1.4, 0, 0 } }, -1 } } },
    { "a pair around a tube", IrregularTorus(40, 20, 5), 6,
      { { { { 1.4, 0, 0 } }, 1 }, { { { 0.6, 0, 0 } }, -1 } } },
    { "genus 2", DoubleTorus(4), 4, { { CornersOfCube(), -1 } } },
    { "nothing on a disc", Disk(8), 4, {} },
    { "one on a disc", Disk(8), 4, { { { { 0.3, 0.2, 0 } }, 1 } } },
    { "nothing on an annulus", Annulus(30, 6), 4, {} },
    { "three on an annulus", Annulus(30, 6), 6,
      { { { { 1.5, 0, 0 }, { -1.5, 0, 0 } }, 1 }, { { { 0, 1.5, 0 } }, -1 } } },
    { "a disc and a sphere", Union(Disk(6), IrregularSphere(3, 2), { 5, 0, 0 }), 2,
      { { { { 0, 0, 0 }, { 6, 0, 0 }, { 4, 0, 0 }, { 5, 1, 0 }, { 5, -1, 0 } }, 1 } } },
  };
}

std::vector<PrescribedSingularity> SingularitiesOf(const Case& example, const TriangleMesh& mesh)
{
  std::vector<PrescribedSingularity> all;
  for (const auto& [places, times] : example.Places)
  {
    all = Joined(std::move(all), At(mesh, places, times));
  }
  return all;
}

}

TEST(SingularFieldSolver, FieldsHaveThePrescribedSingularitiesAndNoOthers)
{
  for (const Case& example : Cases())
  {
    const FramedMesh surface(example.Shape.Mesh());
    const auto singularities = SingularitiesOf(example, surface.Mesh);
    SingularFieldSolver solver(surface);
    solver.Solve(singularities, {}, OptionsOf(example.N));
    ExpectPrescribed(solver, singularities, example.Name);
  }
}
