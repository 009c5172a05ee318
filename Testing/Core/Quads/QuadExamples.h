#ifndef dmgQuadExamples_h
#define dmgQuadExamples_h

#include "FieldSolver.h"
#include "Quads/QuadMesh.h"
#include "Support/MeshFactory.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <map>
#include <set>
#include <utility>
#include <vector>

/// Fields on small surfaces, and a check of quad meshes that shares no code with what made them.
namespace dmg::test
{

/// The smoothest cross field on faces; along the boundary and sharp edges where there are some.
inline Vector<Complex> CrossesOf(const FramedMesh& surface, bool followsFeatures = true)
{
  FieldSolver solver(TriangleMesh(surface.Mesh.VertexPositions(), surface.Mesh.FaceCorners()));
  FieldProblem problem;
  problem.Options.Field.Kind = DiscretisationKind::PowerField;
  problem.Stop = { 1e-8, 100 };
  problem.Features.BoundaryWeight = followsFeatures ? 1000.0 : 0.0;
  problem.Features.SharpEdgesWeight = followsFeatures ? 1000.0 : 0.0;
  return solver.Solve(problem).Powers.Faces;
}

/// The field of a trivial connection with these singularities alone.
inline Vector<Complex> CrossesOf(const FramedMesh& surface, const std::vector<PrescribedSingularity>& singularities)
{
  FieldSolver solver(TriangleMesh(surface.Mesh.VertexPositions(), surface.Mesh.FaceCorners()));
  FieldProblem problem;
  problem.Options.Field.Kind = DiscretisationKind::PowerField;
  problem.Singularities = singularities;
  return solver.Solve(problem).Powers.Faces;
}

inline QuadOptions NumberOfQuads(double number)
{
  QuadOptions options;
  options.NumberOfQuads = number;
  return options;
}

/// Numbers of vertices by their number of quads.
using Valences = std::map<int, int>;

/// What a quad mesh is, counted from its indices alone.
struct CountedMesh
{
  Valences Inner, Boundary;
  int EulerNumber = 0;
  int BoundaryEdges = 0;
  bool IsManifold = true; ///< directed edges are there once, and quads around each vertex are one fan

  explicit CountedMesh(const std::vector<std::array<int, 4>>& quads)
  {
    std::map<std::pair<int, int>, int> sides;               // the quad to the left
    std::map<int, std::vector<std::pair<int, int>>> around; // by vertex: next and previous one in each quad
    for (int q = 0; q < static_cast<int>(quads.size()); ++q)
    {
      for (int k = 0; k < 4; ++k)
      {
        const int a = quads[q][k], b = quads[q][(k + 1) % 4];
        this->IsManifold =
          sides.emplace(std::make_pair(a, b), q).second && a != b && a != quads[q][(k + 2) % 4] && this->IsManifold;
        around[a].emplace_back(b, quads[q][(k + 3) % 4]);
      }
    }
    std::set<std::pair<int, int>> edges;
    std::set<int> onBoundary;
    for (const auto& [side, quad] : sides)
    {
      edges.insert(std::minmax(side.first, side.second));
      if (sides.count({ side.second, side.first }) == 0)
      {
        ++this->BoundaryEdges;
        onBoundary.insert({ side.first, side.second });
      }
    }
    for (const auto& [vertex, corners] : around)
    {
      ++(onBoundary.count(vertex) > 0 ? this->Boundary : this->Inner)[static_cast<int>(corners.size())];
      this->IsManifold = IsOneFan(corners) && this->IsManifold;
    }
    this->EulerNumber =
      static_cast<int>(around.size()) - static_cast<int>(edges.size()) + static_cast<int>(quads.size());
  }

private:
  /// Whether corners, as (next, previous) vertices, follow each other as one open or closed fan.
  static bool IsOneFan(const std::vector<std::pair<int, int>>& corners)
  {
    std::map<int, int> previousOf;
    std::set<int> targets;
    for (const auto& [next, previous] : corners)
    {
      previousOf[next] = previous;
      targets.insert(previous);
    }
    int start = corners.front().first;
    for (const auto& [next, previous] : corners)
    {
      start = targets.count(next) == 0 ? next : start;
    }
    std::size_t length = 0;
    for (int at = start; previousOf.count(at) > 0 && length < corners.size(); at = previousOf[at])
    {
      ++length;
    }
    return length == corners.size() && previousOf.size() == corners.size();
  }
};

/// Expects a mesh without errors: manifold, of the Euler number of the surface, no inner vertex of fewer than three quads, no two vertices
/// in one place, and places that are on the surface.
inline void ExpectGoodMesh(const FramedMesh& surface, const QuadMesh& mesh)
{
  ASSERT_EQ(mesh.Report.Error, "");
  const CountedMesh counted(mesh.Quads);
  EXPECT_TRUE(counted.IsManifold);
  EXPECT_EQ(counted.EulerNumber, surface.Mesh.EulerCharacteristic());
  EXPECT_EQ(mesh.Report.EulerOfMesh, counted.EulerNumber);
  for (const auto& [valence, count] : counted.Inner)
  {
    EXPECT_GE(valence, 3) << count << " vertices";
  }
  std::set<std::array<double, 3>> places;
  for (int vertex = 0; vertex < mesh.Positions.rows(); ++vertex)
  {
    places.insert({ mesh.Positions(vertex, 0), mesh.Positions(vertex, 1), mesh.Positions(vertex, 2) });
    EXPECT_NEAR(mesh.Places[vertex].Weights.sum(), 1.0, 1e-12);
    EXPECT_GE(mesh.Places[vertex].Weights.minCoeff(), 0.0);
  }
  EXPECT_EQ(static_cast<Eigen::Index>(places.size()), mesh.Positions.rows());
}

}

#endif
