#include "Directions/ShapeOfSingularity.h"

#include "Support/MeshFactory.h"

#include <gtest/gtest.h>

#include <cmath>

using namespace dmg;
using namespace dmg::test;

namespace
{

/// Directions of the angle s phi + theta on the faces of a plane, phi around a place.
Vector<Complex> FieldAround(const FramedMesh& surface, const Vector3& place, double index, double theta)
{
  Vector<Complex> first(surface.Mesh.NumberOfFaces());
  for (int face = 0; face < surface.Mesh.NumberOfFaces(); ++face)
  {
    Vector3 radius = -place;
    for (int k = 0; k < 3; ++k)
    {
      radius += surface.Mesh.Position(surface.Mesh.FaceCorners()(face, k)) / 3.0;
    }
    const double angle = index * std::atan2(radius.y(), radius.x()) + theta;
    first[face] = surface.Faces.ToComplex(face, Vector3(std::cos(angle), std::sin(angle), 0.0));
  }
  return first;
}

/// A vertex inside of a plane, and a face.
SingularElement ElementOf(bool isFace, double index)
{
  return { isFace ? 61 : 40, isFace, index };
}

Vector3 PlaceOf(const TriangleMesh& mesh, const SingularElement& singularity)
{
  const auto corner = [&](int k) { return Vector3(mesh.Position(mesh.FaceCorners()(singularity.Element, k))); };
  return singularity.IsFace ? Vector3((corner(0) + corner(1) + corner(2)) / 3.0)
                            : Vector3(mesh.Position(singularity.Element));
}

}

/// A field of the angle s phi + theta is radial where phi = (theta + 2 pi k / N) / (1 - s).
TEST(ShapeOfSingularity, HasAnAxisInEachDirectionInWhichTheFieldIsRadial)
{
  const FramedMesh surface(IrregularPlane(8, 8, 3).Mesh());
  struct Case
  {
    int N;
    double Index;
    int Axes;
  };
  for (const Case& given : { Case{ 2, 0.5, 1 }, Case{ 2, -0.5, 3 }, Case{ 1, -1.0, 2 }, Case{ 4, 0.25, 3 },
         Case{ 4, -0.25, 5 }, Case{ 1, 2.0, 1 } })
  {
    for (const bool isFace : { false, true })
    {
      constexpr double Theta = 0.3;
      const SingularElement element = ElementOf(isFace, given.Index);
      const Vector<Complex> first = FieldAround(surface, PlaceOf(surface.Mesh, element), given.Index, Theta);
      const ShapeOfSingularity shape = ShapeAt(surface, first, given.N, element);
      ASSERT_EQ(static_cast<int>(shape.Axes.size()), given.Axes);
      EXPECT_TRUE(std::isnan(shape.SpiralAngle));
      for (int k = 0; k < given.Axes; ++k)
      {
        const double phi = std::atan2(shape.Axes[k].y(), shape.Axes[k].x());
        const double field = given.Index * phi + Theta;
        EXPECT_NEAR(std::remainder(given.N * (field - phi), 2.0 * Pi), 0.0, 1e-9);
        EXPECT_NEAR(shape.Axes[k].norm(), 1.0, 1e-12);
        EXPECT_GT((shape.Axes[k] - shape.Axes[(k + 1) % given.Axes]).norm() + (given.Axes == 1 ? 1.0 : 0.0), 0.5);
      }
    }
  }
}

TEST(ShapeOfSingularity, IsAsterVortexOrSpiralOfIndexOne)
{
  const FramedMesh surface(IrregularPlane(8, 8, 3).Mesh());
  for (const int N : { 1, 2 })
  {
    for (const double angle : { 0.0, 0.5 * Pi - 1e-6, 0.4, -0.7 })
    {
      const SingularElement element = ElementOf(false, 1.0);
      const Vector<Complex> first = FieldAround(surface, PlaceOf(surface.Mesh, element), 1.0, angle);
      const ShapeOfSingularity shape = ShapeAt(surface, first, N, element);
      EXPECT_TRUE(shape.Axes.empty());
      EXPECT_NEAR(shape.SpiralAngle, angle, 1e-9);
    }
  }
}
