// Fields whose singularities are prescribed.

#include "Singularities/SingularFieldSolver.h"

#include "Analysis/TreeCotree.h"
#include "Directions/FieldTopology.h"
#include "Directions/PowerFieldDirections.h"
#include "Operators/ExteriorCalculus.h"
#include "Support/AllIndices.h"
#include "Support/ComplexPairs.h"
#include "Support/Errors.h"
#include "Support/MeshFactory.h"
#include "Support/SolverOfUnknowns.h"
#include "Support/TbbContext.h"

#include <Eigen/QR>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
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
    const bool isNearer =
      nearest < 0 || (mesh.Position(vertex) - place).norm() < (mesh.Position(nearest) - place).norm();
    nearest = isNearer && !mesh.IsBoundaryVertex(vertex) ? vertex : nearest;
  }
  return nearest;
}

/// A singularity wherever a place is given, its index times / N.
std::vector<PrescribedSingularity> At(const TriangleMesh& mesh, const std::vector<Vector3>& places, int times)
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

const std::vector<Vector3> EndsOfAxes{ { 1, 0, 0 }, { -1, 0, 0 }, { 0, 1, 0 }, { 0, -1, 0 }, { 0, 0, 1 },
  { 0, 0, -1 } };

std::vector<PrescribedSingularity> Joined(
  std::vector<PrescribedSingularity> a, const std::vector<PrescribedSingularity>& b)
{
  a.insert(a.end(), b.begin(), b.end());
  return a;
}

FieldTopology TopologyOf(const SolverOfUnknowns& solver)
{
  const auto& [mesh, faces, vertices] = solver.Surface();
  const int N = solver.Field().DirectionsPerPoint();
  return TopologyOfField(mesh, faces, FirstDirections(AsComplex(solver.Unknowns()), N), N);
}

/// Expects the singularities that are prescribed, to the vertex, no others, and a field of magnitude 1.
void ExpectPrescribed(
  const SolverOfUnknowns& solver, const std::vector<PrescribedSingularity>& singularities, const std::string& name)
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
  // The field goes on across every edge as the connection says, also where it was not carried: around all loops.
  EXPECT_LT((TopologyOf(solver).Rotation - solver.Rotation()).cwiseAbs().maxCoeff(), 1e-6) << name;
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
    { "more and less on an ellipsoid", Ellipsoid(3), 4, { { CornersOfCube(), 2 }, { EndsOfAxes, -1 }, { poles, -1 } } },
    { "nothing on a torus", IrregularTorus(40, 20, 5), 4, {} },
    { "vectors on a torus", IrregularTorus(40, 20, 5), 1, {} },
    { "a pair on a torus", IrregularTorus(40, 20, 5), 4, { { { { 1.4, 0, 0 } }, 1 }, { { { -1.4, 0, 0 } }, -1 } } },
    { "a pair around a tube", IrregularTorus(40, 20, 5), 6, { { { { 1.4, 0, 0 } }, 1 }, { { { 0.6, 0, 0 } }, -1 } } },
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
    SolverOfUnknowns solver(surface.Mesh);
    solver.Solve(singularities, {}, OptionsOf(example.N));
    ExpectPrescribed(solver, singularities, example.Name);
  }
}

TEST(SingularFieldSolver, CyclesFindTheFieldOfAFactor)
{
  for (const Case& example : { Case{ "ellipsoid", Ellipsoid(5), 4, { { CornersOfCube(), 1 } } },
         Case{ "torus", IrregularTorus(80, 40, 5), 4, { { { { 1.4, 0, 0 } }, 1 }, { { { -0.6, 0, 0 } }, -1 } } },
         Case{ "annulus", Annulus(150, 30), 2, { { { { 0, 1.5, 0 } }, 1 } } } })
  {
    const FramedMesh surface(example.Shape.Mesh());
    const auto singularities = SingularitiesOf(example, surface.Mesh);
    SolverOfUnknowns factored(surface.Mesh), byCycles(surface.Mesh);
    factored.Solve(singularities, {}, OptionsOf(example.N, SolverKind::Cholesky));
    byCycles.Solve(singularities, {}, OptionsOf(example.N, SolverKind::ConjugateGradients), { 1e-10, 60 });
    ExpectPrescribed(byCycles, singularities, example.Name);
    EXPECT_NE(byCycles.Report().Solver.find("trivial connection by conjugate gradients"), std::string::npos);
    EXPECT_LT((factored.Rotation() - byCycles.Rotation()).cwiseAbs().maxCoeff(), 1e-6) << example.Name;
  }
}

TEST(SingularFieldSolver, ARoughToleranceStillGivesThePrescribedSingularities)
{
  const FramedMesh surface(IrregularTorus(80, 40, 5).Mesh());
  const auto singularities = Joined(At(surface.Mesh, { { 1.4, 0, 0 } }, 1), At(surface.Mesh, { { -1.4, 0, 0 } }, -1));
  SolverOfUnknowns solver(surface.Mesh);
  solver.Solve(singularities, {}, OptionsOf(4, SolverKind::ConjugateGradients), { 0.5, 100 });
  EXPECT_LT((TopologyOf(solver).Rotation - solver.Rotation()).cwiseAbs().maxCoeff(), 1e-3);
  EXPECT_EQ(solver.Counts().Solves, 1);
}

// Least squares by a dense decomposition, with the sums around inner vertices and along loops as constraints: those of
// the loops are as the solver chose them, which the test above has found right.
TEST(SingularFieldSolver, FieldsTurnLeast)
{
  for (const Case& example : { Case{ "sphere", Icosphere(2), 4, { { CornersOfCube(), 1 } } },
         Case{ "torus", Torus(18, 9), 6, { { { { 1.4, 0, 0 } }, 1 }, { { { -0.6, 0, 0 } }, -1 } } },
         Case{ "annulus", Annulus(18, 4), 4, { { { { 0, 1.5, 0 } }, 1 } } } })
  {
    const FramedMesh surface(example.Shape.Mesh());
    const TriangleMesh& mesh = surface.Mesh;
    SolverOfUnknowns solver(surface.Mesh);
    solver.Solve(SingularitiesOf(example, mesh), {}, OptionsOf(example.N));
    const Eigen::MatrixXd loops(GeneratorsOverFaces(mesh, MakeTreeCotree(mesh, BoundaryAs::Vertex)));
    std::vector<int> inside;
    for (int vertex = 0; vertex < mesh.NumberOfVertices(); ++vertex)
    {
      if (!mesh.IsBoundaryVertex(vertex))
      {
        inside.push_back(vertex);
      }
    }
    const Vector<double> star = Star1(mesh);
    ASSERT_GT(star.minCoeff(), -1e-12) << example.Name; // else there is no norm; where it is zero, t is
    Eigen::MatrixXd C(mesh.NumberOfEdges(), inside.size() + loops.cols());
    C << Eigen::MatrixXd(D0(mesh))(All, inside), loops;
    // t = star1 C (C^T star1 C)^+ C^T t
    const Eigen::MatrixXd gram = C.transpose() * star.asDiagonal() * C;
    const Vector<double> expected = star.asDiagonal() *
      (C * gram.completeOrthogonalDecomposition().solve(Vector<double>(C.transpose() * solver.Rotation())));
    EXPECT_LT((expected - solver.Rotation()).cwiseAbs().maxCoeff(), 1e-9) << example.Name;
  }
}

// On a torus of revolution fields at a constant angle to the meridians turn least, by symmetry.
TEST(SingularFieldSolver, WithoutSingularitiesATorusHasTheFieldOfItsCircles)
{
  const FramedMesh surface(Torus(60, 30).Mesh());
  for (const int N : { 1, 4 })
  {
    SolverOfUnknowns solver(surface.Mesh);
    const Vector<Complex> powers = AsComplex(solver.Solve({}, {}, OptionsOf(N)));
    Complex mean = 0.0;
    double largest = 0.0;
    Vector<Complex> against(powers.size());
    for (int face = 0; face < powers.size(); ++face)
    {
      const Vector3 centre = (surface.Mesh.Position(surface.Mesh.FaceCorners()(face, 0)) +
                               surface.Mesh.Position(surface.Mesh.FaceCorners()(face, 1)) +
                               surface.Mesh.Position(surface.Mesh.FaceCorners()(face, 2))) /
        3.0;
      const Complex circle = surface.Faces.ToComplex(face, Vector3(-centre.y(), centre.x(), 0.0).normalized());
      against[face] = powers[face] / std::pow(circle / std::abs(circle), N);
      mean += against[face];
    }
    mean /= std::abs(mean);
    for (const Complex power : against)
    {
      largest = std::max(largest, std::abs(std::arg(power / mean)) / N);
    }
    EXPECT_LT(largest, 0.03) << N; // triangles of 6 and 12 degrees
  }
}

// In the plane, the field that turns least around one point is z^(k / N). On a square grid mapped to a disc, whose triangles are
// sheared, the directions of faces are those of their centres to a share of the width of a cell.
TEST(SingularFieldSolver, IsRightOnShearedTriangles)
{
  std::vector<double> errors;
  for (const int cells : { 20, 40, 80 })
  {
    const double half = 0.5 * cells;
    Surface disc = PlaneGrid(cells, cells);
    for (int vertex = 0; vertex < disc.V.rows(); ++vertex)
    {
      const double x = disc.V(vertex, 0) / half - 1.0;
      const double y = disc.V(vertex, 1) / half - 1.0;
      disc.V.row(vertex) << x * std::sqrt(1.0 - y * y / 2.0), y * std::sqrt(1.0 - x * x / 2.0), 0.0;
    }
    const FramedMesh surface(disc.Mesh());
    SolverOfUnknowns solver(surface.Mesh);
    const Vector<Complex> powers =
      AsComplex(solver.Solve(At(surface.Mesh, { { 0, 0, 0 } }, 1), {}, OptionsOf(4, SolverKind::Cholesky)));
    Vector<Complex> against(powers.size());
    for (int face = 0; face < powers.size(); ++face)
    {
      const Vector3 centre = surface.Mesh.VertexPositions()(surface.Mesh.FaceCorners().row(face), All).colwise().mean();
      const Complex direction = surface.Faces.ToComplex(face, Vector3(1.0, 0.0, 0.0));
      against[face] = powers[face] / std::pow(direction, 4) / (Complex(centre.x(), centre.y()) / centre.norm());
    }
    const Complex mean = against.mean() / std::abs(against.mean());
    errors.push_back(
      (against / mean).unaryExpr([](Complex z) { return std::arg(z); }).real().norm() / std::sqrt(powers.size()));
  }
  EXPECT_LT(errors.back(), 0.02);
  EXPECT_GT(errors[0] / errors[1], 1.7);
  EXPECT_GT(errors[1] / errors[2], 1.7);
}

TEST(SingularFieldSolver, BitsDoNotDependOnThreads)
{
  for (const SolverKind kind : { SolverKind::ConjugateGradients, SolverKind::VCycles })
  {
    const FramedMesh surface(IrregularTorus(80, 40, 5).Mesh());
    const auto singularities = Joined(At(surface.Mesh, { { 1.4, 0, 0 } }, 1), At(surface.Mesh, { { -1.4, 0, 0 } }, -1));
    SolverOfUnknowns serial(surface.Mesh), threaded(surface.Mesh);
    const TbbContext threads(3);
    const Vector<double> expected = serial.Solve(singularities, {}, OptionsOf(4, kind), { 1e-8, 60 });
    EXPECT_EQ(threaded.Solve(singularities, {}, OptionsOf(4, kind), { 1e-8, 60 }, threads), expected);
  }
}

TEST(SingularFieldSolver, AMovedSingularitySolvesAgainOnly)
{
  const FramedMesh surface(IrregularTorus(40, 20, 5).Mesh());
  const auto from = Joined(At(surface.Mesh, { { 1.4, 0, 0 } }, 1), At(surface.Mesh, { { -1.4, 0, 0 } }, -1));
  const auto to = Joined(At(surface.Mesh, { { 1.0, 0, 0.4 } }, 1), At(surface.Mesh, { { -1.4, 0, 0 } }, -1));
  SolverOfUnknowns solver(surface.Mesh);
  const auto expectCounts = [&solver](int setups, int systems, int solves)
  {
    EXPECT_EQ(solver.Counts().Setups, setups);
    EXPECT_EQ(solver.Counts().Systems, systems);
    EXPECT_EQ(solver.Counts().Solves, solves);
  };
  solver.Solve(from, {}, OptionsOf(4));
  expectCounts(1, 1, 1);
  solver.Solve(from, {}, OptionsOf(4));
  expectCounts(1, 1, 1);
  solver.Solve(to, {}, OptionsOf(4));
  expectCounts(1, 1, 2);
  ExpectPrescribed(solver, to, "moved");
  solver.Solve(to, {}, OptionsOf(6)); // sixths now
  expectCounts(1, 1, 3);
  ExpectPrescribed(solver, to, "of other directions");
  solver.Solve(to, { { { 7, Vector3(0.1, 1.0, 0.3), 1.0 } }, {} }, OptionsOf(6));
  expectCounts(1, 1, 4);
  solver.Solve(to, {}, OptionsOf(6, SolverKind::ConjugateGradients));
  expectCounts(2, 2, 5);
}

// One direction on a component holds there exactly, and turns all others by the same angle.
TEST(SingularFieldSolver, PrescribedDirectionsTurnTheField)
{
  const FramedMesh surface(Union(IrregularSphere(3, 3), Disk(6), { 5, 0, 0 }).Mesh());
  const auto singularities = At(surface.Mesh, CornersOfCube(), 1);
  SolverOfUnknowns solver(surface.Mesh);
  const Vector<Complex> before = AsComplex(solver.Solve(singularities, {}, OptionsOf(4)));
  constexpr int Face = 100;
  const Vector3 direction = surface.Faces.ToVector(Face, std::polar(2.0, 0.7));
  const Vector<Complex> after =
    AsComplex(solver.Solve(singularities, { { { Face, direction, 3.0 } }, {} }, OptionsOf(4)));
  EXPECT_LT(std::abs(after[Face] - std::polar(1.0, 4.0 * 0.7)), 1e-12);
  const int ofSphere = Icosphere(3).F.rows();
  const Complex turn = after[Face] / before[Face];
  for (int face = 0; face < after.size(); ++face)
  {
    EXPECT_LT(std::abs(after[face] - (face < ofSphere ? turn : 1.0) * before[face]), 1e-12);
  }
  // Two directions that disagree by 2 d, of the same weight on faces of about the same area, meet half-way; a heavier one
  // gets more.
  const Vector3 other =
    surface.Faces.ToVector(Face, std::polar(2.0, 0.7 + 0.2)); // powers are averaged on the same face: half-way there
  const Vector<Complex> between =
    AsComplex(solver.Solve(singularities, { { { Face, direction, 1.0 }, { Face, other, 1.0 } }, {} }, OptionsOf(4)));
  EXPECT_LT(std::abs(between[Face] - std::polar(1.0, 4.0 * 0.8)), 1e-12);
}

// Five edges meet at the points of the icosahedron, and crosses turn by less than 45 degrees across each: by 5/8 of a turn in
// all, less than an index of 1 takes.
TEST(SingularFieldSolver, MoreThanTheEdgesAtAPointCanShowIsAWarning)
{
  const FramedMesh surface(Icosphere(3).Mesh());
  SolverOfUnknowns solver(surface.Mesh);
  solver.Solve({ { 0, 4 }, { 3, 4 } }, {}, OptionsOf(4));
  ASSERT_EQ(solver.Report().Warnings.size(), 1u);
  EXPECT_NE(solver.Report().Warnings[0].find("45 degrees"), std::string::npos);
  EXPECT_TRUE(solver.Report().Converged);
  EXPECT_DOUBLE_EQ(TopologyOf(solver).Indices.sum(), 2.0);
  solver.Solve({ { 0, 2 }, { 3, 2 } }, {}, OptionsOf(2)); // up to 90 degrees
  ExpectPrescribed(solver, { { 0, 2 }, { 3, 2 } }, "lines");
}

TEST(SingularFieldSolver, SurfacesWithoutInnerPointsHaveFields)
{
  for (const Surface& shape : { Annulus(24, 1), Strip({ 1.0, 2.0, 1.0 }), PlaneGrid(1, 1) })
  {
    const FramedMesh surface(shape.Mesh());
    SolverOfUnknowns solver(surface.Mesh);
    solver.Solve({}, {}, OptionsOf(4));
    ExpectPrescribed(solver, {}, "all on the boundary");
  }
}

namespace
{

std::string ErrorOf(
  const Surface& shape, const std::vector<PrescribedSingularity>& singularities, const FieldOptions& options)
{
  const FramedMesh surface(shape.Mesh());
  SolverOfUnknowns solver(surface.Mesh);
  try
  {
    solver.Solve(singularities, {}, options);
  }
  catch (const InvalidInput& error)
  {
    return error.what();
  }
  return "none";
}

void ExpectWords(const std::string& message, const std::vector<std::string>& words)
{
  for (const std::string& word : words)
  {
    EXPECT_NE(message.find(word), std::string::npos) << "'" << word << "' is not in: " << message;
  }
}

}

TEST(SingularFieldSolver, WrongSumsAreErrorsThatSayWhatIsMissing)
{
  const Surface sphere = Icosphere(2);
  ExpectWords(ErrorOf(sphere, { { 0, 4 }, { 1, 1 }, { 2, 1 } }, OptionsOf(4)),
    { "sum to 1.5", "Euler characteristic is 2", "add singularities of 0.5" });
  ExpectWords(ErrorOf(sphere, {}, OptionsOf(1)), { "sum to 0", "add singularities of 2 " });
  ExpectWords(ErrorOf(sphere, { { 3, 9 } }, OptionsOf(4)), { "take away 0.25" });
  ExpectWords(ErrorOf(Union(Disk(3), sphere, { 5, 0, 0 }), {}, OptionsOf(4)),
    { "the component of point 37" }); // a disc of 1 + 6 + 12 + 18 points before it
  EXPECT_EQ(ErrorOf(Torus(12, 6), { { 3, 1 }, { 40, -1 } }, OptionsOf(4)), "none");
}

TEST(SingularFieldSolver, WhatIsNoSingularityOfAPowerFieldIsAnError)
{
  ExpectWords(ErrorOf(Disk(3), { { 36, 1 } }, OptionsOf(4)), { "point 36", "boundary", "move it inside" });
  ExpectWords(ErrorOf(Disk(3), { { 37, 1 } }, OptionsOf(4)), { "vertex 37", "37 vertices" });
  FieldOptions faceField;
  faceField.Field.Kind = DiscretisationKind::FaceField;
  ExpectWords(ErrorOf(Torus(12, 6), {}, faceField), { "VertexPowerField", "Singularities" });
  EXPECT_EQ(TimesOfIndex(static_cast<float>(1.0 / 3.0), 6, "it"), 2);
  EXPECT_EQ(TimesOfIndex(-1.0, 1, "it"), -1);
  for (const double index : { 0.3, std::nan("none"), 1e300 })
  {
    EXPECT_THROW(TimesOfIndex(index, 4, "it"), InvalidInput);
  }
}
