// Lines where functions have given values.

#include "Drawing/ContourLines.h"

#include "Support/MeshFactory.h"
#include "Support/TbbContext.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace dmg;
using namespace dmg::test;

namespace
{

Vector<double> Coordinate(const TriangleMesh& mesh, int k)
{
  return mesh.VertexPositions().col(k);
}

double LengthOf(const ContourLines& lines, int line)
{
  double length = 0.0;
  for (int k = lines.Offsets[line]; k + 1 < lines.Offsets[line + 1]; ++k)
  {
    length += (lines.Positions.row(lines.Order[k + 1]) - lines.Positions.row(lines.Order[k])).norm();
  }
  return length;
}

}

TEST(ContourLines, AreCirclesOfLatitudeWithSouthToTheRight)
{
  const TriangleMesh sphere = IrregularSphere(4, 3).Mesh();
  const std::vector<double> values{ -0.5, 0.0, 0.7 };
  const ContourLines lines =
    FindContourLines(sphere, sphere.VertexPositions(), -Coordinate(sphere, 2), values, FindSides(sphere));
  ASSERT_EQ(lines.Offsets.size(), 4u);
  ASSERT_EQ(static_cast<std::size_t>(lines.Offsets.back()), lines.Order.size());
  for (int line = 0; line < 3; ++line)
  {
    const int first = lines.Order[lines.Offsets[line]];
    EXPECT_EQ(first, lines.Order[lines.Offsets[line + 1] - 1]); // closed
    const double z = -values[lines.Values[first]];
    EXPECT_NEAR(LengthOf(lines, line), 2.0 * Pi * std::sqrt(1.0 - z * z), 0.02);
    double turn = 0.0;
    for (int k = lines.Offsets[line]; k + 1 < lines.Offsets[line + 1]; ++k)
    {
      const Vector3 a = lines.Positions.row(lines.Order[k]);
      const Vector3 b = lines.Positions.row(lines.Order[k + 1]);
      EXPECT_NEAR(a[2], z, 1e-12);
      EXPECT_EQ(lines.Values[lines.Order[k]], lines.Values[first]);
      turn += a.cross(b)[2];
    }
    EXPECT_GT(turn, 0.0); // -z grows to the south, which is to the right of a way to the east
  }
}

TEST(ContourLines, EndAtTheBoundary)
{
  const TriangleMesh plane = IrregularPlane(9, 7, 3).Mesh();
  const Vector<double> x = Coordinate(plane, 0);
  const double middle = 0.5 * (x.minCoeff() + x.maxCoeff()) + 1e-3;
  const ContourLines lines = FindContourLines(plane, plane.VertexPositions(), x, { middle }, FindSides(plane));
  ASSERT_EQ(lines.Offsets.size(), 2u);
  EXPECT_NE(lines.Order.front(), lines.Order.back());
  const Vector<double> y = Coordinate(plane, 1);
  EXPECT_NEAR(LengthOf(lines, 0), y.maxCoeff() - y.minCoeff(), 1e-12);
}

TEST(ContourLines, ValuesAtVerticesAndConstantFunctionsAreNoExceptions)
{
  const TriangleMesh sphere = Icosphere(2).Mesh();
  const Vector<double> z = Coordinate(sphere, 2);
  const ContourLines throughVertices =
    FindContourLines(sphere, sphere.VertexPositions(), z, { 0.0 }, FindSides(sphere)); // vertices lie on the equator
  ASSERT_EQ(throughVertices.Offsets.size(), 2u);
  EXPECT_TRUE(throughVertices.Positions.allFinite());
  EXPECT_NEAR(LengthOf(throughVertices, 0), 2.0 * Pi, 0.1);
  EXPECT_TRUE(
    FindContourLines(sphere, sphere.VertexPositions(), Vector<double>::Ones(z.size()), { 1.0 }, FindSides(sphere))
      .Order.empty());
  EXPECT_TRUE(FindContourLines(sphere, sphere.VertexPositions(), z, {}, FindSides(sphere)).Order.empty());
}

TEST(ContourLines, AreDrawnAtOtherPlacesOfTheVertices)
{
  const TriangleMesh sphere = Icosphere(3).Mesh();
  const Vector<double> z = Coordinate(sphere, 2);
  const Points above = 2.0 * sphere.VertexPositions();
  const ContourLines on = FindContourLines(sphere, sphere.VertexPositions(), z, { 0.3 }, FindSides(sphere));
  const ContourLines lifted = FindContourLines(sphere, above, z, { 0.3 }, FindSides(sphere));
  EXPECT_EQ(on.Order, lifted.Order);
  EXPECT_LT((lifted.Positions - 2.0 * on.Positions).cwiseAbs().maxCoeff(), 1e-14);
}

TEST(ContourLines, HaveTheSameBitsForAnyNumberOfThreads)
{
  const TriangleMesh torus = IrregularTorus(120, 60, 3).Mesh();
  const Vector<double> x = Coordinate(torus, 0);
  const std::vector<double> values{ -1.1, -0.3, 0.2, 0.9 };
  const ContourLines one = FindContourLines(torus, torus.VertexPositions(), x, values, FindSides(torus));
  const ContourLines four =
    FindContourLines(torus, torus.VertexPositions(), x, values, FindSides(torus), TbbContext(4));
  EXPECT_EQ(one.Order, four.Order);
  EXPECT_EQ(one.Positions, four.Positions);
}
