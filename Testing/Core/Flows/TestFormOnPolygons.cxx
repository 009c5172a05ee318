// 1-forms on the edges of polygons, without their diagonals.

#include "Flows/FormOnPolygons.h"

#include "Preparation/PreparedSurface.h"
#include "Support/MeshFactory.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <utility>
#include <vector>

using namespace dmg;
using namespace dmg::test;

namespace
{

/// Its divergence, curl and shear are constant.
double IntegralAlong(const Vector3& a, const Vector3& b)
{
  const Vector3 middle = 0.5 * (a + b);
  const Vector3 field(1.0 + 2.0 * middle[0] - 5.0 * middle[1], 0.5 + 3.0 * middle[0] + middle[1], 0.0);
  return field.dot(b - a);
}

/// Four quadrilaterals in two rows, without right angles, and beside them a hexagon that is not convex.
PreparedSurface QuadsAndAHexagon()
{
  PolygonSurface polygons;
  polygons.Positions.resize(12, 3);
  polygons.Positions << 0.0, 0.0, 0.0, 1.1, -0.2, 0.0, 2.0, 0.1, 0.0, //
    -0.1, 1.0, 0.0, 0.9, 1.2, 0.0, 2.2, 0.9, 0.0,                     //
    0.1, 2.1, 0.0, 1.2, 1.9, 0.0, 1.9, 2.0, 0.0,                      //
    4.0, 0.3, 0.0, 3.0, 1.0, 0.0, 4.1, 2.2, 0.0;
  polygons.Corners = { 0, 1, 4, 3, 1, 2, 5, 4, 3, 4, 7, 6, 4, 5, 8, 7, 2, 9, 10, 11, 8, 5 };
  polygons.Offsets = { 0, 4, 8, 12, 16, 22 };
  return PrepareSurface(std::move(polygons), {});
}

bool IsDiagonal(const PreparedSurface& surface, int edge)
{
  const int h = surface.Mesh.HalfedgeOf(edge);
  const int twin = surface.Mesh.Twin(h);
  return twin >= 0 &&
    surface.Relation.CellOf(TriangleMesh::FaceOf(h)) == surface.Relation.CellOf(TriangleMesh::FaceOf(twin));
}

}

TEST(FormOnPolygons, DiagonalsHaveTheIntegralsOfALinearField)
{
  const PreparedSurface surface = QuadsAndAHexagon();
  const TriangleMesh& mesh = surface.Mesh;
  Vector<double> exact(mesh.NumberOfEdges());
  Vector<double> form = Vector<double>::Zero(exact.size());
  std::vector<char> isKnown(exact.size(), 0);
  for (int edge = 0; edge < exact.size(); ++edge)
  {
    const auto [a, b] = mesh.EdgeVertices(edge);
    exact[edge] = IntegralAlong(mesh.Position(a), mesh.Position(b));
    if (!IsDiagonal(surface, edge))
    {
      form[edge] = exact[edge];
      isKnown[edge] = 1;
    }
  }
  ASSERT_EQ(std::count(isKnown.begin(), isKnown.end(), 0), 4 + 3);
  EXPECT_EQ(FillDiagonals(mesh, surface.Relation, form, isKnown), -1);
  EXPECT_LT((form - exact).cwiseAbs().maxCoeff(), 1e-13);
  EXPECT_EQ(std::count(isKnown.begin(), isKnown.end(), 0), 0);
}

TEST(FormOnPolygons, OtherEdgesAreNotMadeUp)
{
  const PreparedSurface surface = QuadsAndAHexagon();
  for (int missing = 0; missing < surface.Mesh.NumberOfEdges(); ++missing)
  {
    Vector<double> form = Vector<double>::Ones(surface.Mesh.NumberOfEdges());
    std::vector<char> isKnown(form.size(), 1);
    isKnown[missing] = 0;
    EXPECT_EQ(
      FillDiagonals(surface.Mesh, surface.Relation, form, isKnown), IsDiagonal(surface, missing) ? -1 : missing);
  }
}
