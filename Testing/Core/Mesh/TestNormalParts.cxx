#include "Mesh/NormalParts.h"

#include "Support/MeshFactory.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace dmg;
using namespace dmg::test;

namespace
{

/// A part of a cylinder around z, of radius 1.
Surface PartOfTube(int columns, int rows)
{
  Surface tube = PlaneGrid(columns, rows);
  for (int point = 0; point < tube.V.rows(); ++point)
  {
    const double angle = 0.5 * Pi * tube.V(point, 0) / columns, height = tube.V(point, 1) / rows;
    tube.V.row(point) << std::cos(angle), std::sin(angle), height;
  }
  return tube;
}

}

// Max: the normals of vertices of any polyhedron in a sphere, whose corners each see all sides from one point of it.
TEST(NormalParts, NormalsAreExactOnSpheres)
{
  const TriangleMesh sphere = IrregularSphere(3, 5).Mesh();
  const Points normals = NormalsOfVertices(sphere);
  for (int vertex = 0; vertex < sphere.NumberOfVertices(); ++vertex)
  {
    EXPECT_LT((normals.row(vertex).transpose() - sphere.Position(vertex).normalized()).norm(), 1e-10);
  }
}

TEST(NormalParts, AreTakenOutOnSpheres)
{
  const TriangleMesh sphere = IrregularSphere(3, 5).Mesh();
  const Vector3 axis(0.0, 0.0, 1.0);
  Points vectors(sphere.NumberOfVertices(), 3), tangential = vectors;
  for (int vertex = 0; vertex < sphere.NumberOfVertices(); ++vertex)
  {
    const Vector3 at = sphere.Position(vertex).normalized();
    tangential.row(vertex) = axis.cross(at).transpose();
    vectors.row(vertex) = tangential.row(vertex) + 100.0 * at.transpose();
  }
  const SplitVectors split = WithoutNormalParts(sphere, vectors, {});
  EXPECT_LT((split.Tangential - tangential).cwiseAbs().maxCoeff(), 1e-10);
  EXPECT_EQ(split.RatioAtRim, 0.0);
}

TEST(NormalParts, VectorsInThePlaneOfTheirCellStay)
{
  const TriangleMesh sphere = IrregularSphere(2, 5).Mesh();
  const SurfaceRelation relation = SurfaceRelation::OneToOne(sphere);
  Points vectors(sphere.NumberOfFaces(), 3);
  for (int face = 0; face < sphere.NumberOfFaces(); ++face)
  {
    vectors.row(face) = (sphere.Position(sphere.Head(3 * face)) - sphere.Position(sphere.Tail(3 * face))).transpose();
  }
  EXPECT_EQ(WithoutNormalPartsOfCells(sphere, relation, vectors), vectors);
}

// Pressure on facets of a tube, whose two triangles of each square lie in one plane.
TEST(NormalParts, OfCellsAreThoseAlongTheirOwnNormals)
{
  const TriangleMesh tube = PartOfTube(12, 12).Mesh();
  Points vectors(tube.NumberOfFaces(), 3);
  for (int face = 0; face < tube.NumberOfFaces(); ++face)
  {
    vectors.row(face) = (Vector3::UnitZ() + 100.0 * tube.FaceAreaVector(face).normalized()).transpose();
  }
  const Points tangential = WithoutNormalPartsOfCells(tube, SurfaceRelation::OneToOne(tube), vectors);
  EXPECT_LT((tangential.rowwise() - Eigen::RowVector3d(0.0, 0.0, 1.0)).cwiseAbs().maxCoeff(), 1e-11);
}

TEST(NormalParts, AreToldAtBoundariesThatBend)
{
  for (const double part : { 0.0, 3.0 })
  {
    const TriangleMesh tube = PartOfTube(12, 12).Mesh(), plane = PlaneGrid(4, 4).Mesh();
    Points vectors(tube.NumberOfVertices(), 3);
    for (int vertex = 0; vertex < tube.NumberOfVertices(); ++vertex)
    {
      const Vector3 at = tube.Position(vertex);
      vectors.row(vertex) << part * at.x(), part * at.y(), 1.0;
    }
    EXPECT_NEAR(WithoutNormalParts(tube, vectors, {}).RatioAtRim, part, 0.1);
    vectors.resize(plane.NumberOfVertices(), 3);
    vectors.rowwise() = Eigen::RowVector3d(1.0, 0.0, part);
    const SplitVectors split = WithoutNormalParts(plane, vectors, {});
    EXPECT_EQ(split.RatioAtRim, 0.0);
    EXPECT_EQ(split.Tangential.col(2).cwiseAbs().maxCoeff(), 0.0);
  }
}

// Two squares at a right angle: a vector at their edge lies in one of them.
TEST(NormalParts, StayAtSharpEdges)
{
  Surface corner = PlaneGrid(2, 1);
  for (int point = 0; point < corner.V.rows(); ++point)
  {
    if (corner.V(point, 0) > 1.5)
    {
      corner.V(point, 0) = 1.0;
      corner.V(point, 2) = 1.0;
    }
  }
  const TriangleMesh mesh = corner.Mesh();
  Points vectors(mesh.NumberOfVertices(), 3);
  vectors.rowwise() = Eigen::RowVector3d(1.0, 0.0, 0.0);
  const SplitVectors split = WithoutNormalParts(mesh, vectors, {});
  for (int vertex = 0; vertex < mesh.NumberOfVertices(); ++vertex)
  {
    if (std::abs(mesh.Position(vertex).x() - 1.0) < 1e-9 && mesh.Position(vertex).z() == 0.0)
    {
      EXPECT_EQ(split.Tangential(vertex, 0), 1.0);
    }
  }
}
