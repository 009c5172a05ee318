#include "Directions/PrincipalDirections.h"

#include "Directions/BendOfRegions.h"
#include "Support/Errors.h"
#include "Support/NamedSurfaces.h"
#include "Support/Random.h"
#include "Support/TbbContext.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <utility>

namespace
{

using namespace dmg;
using namespace dmg::test;

/// Most of a cylinder of radius 1 around the z-axis, 2.5 long, its points and diagonals at random.
Surface Cylinder(int across, unsigned seed)
{
  const int around = across * 5 / 2;
  Surface surface = IrregularPlane(around, across, seed);
  for (int i = 0; i < surface.V.rows(); ++i)
  {
    const double angle = 2.0 * Pi * 0.95 * surface.V(i, 0) / around;
    const double z = 2.5 * surface.V(i, 1) / across;
    surface.V.row(i) << std::cos(angle), std::sin(angle), z;
  }
  return surface;
}

Surface InsideOut(Surface surface)
{
  surface.F.col(1).swap(surface.F.col(2));
  return surface;
}

Surface WithNoise(const Surface& surface, double amount, unsigned seed)
{
  Surface noisy = surface;
  const FramedMesh framed(surface.Mesh());
  Random random(seed);
  for (int i = 0; i < noisy.V.rows(); ++i)
  {
    noisy.V.row(i) += random.Uniform(-amount, amount) * framed.Vertices.Normal(i).transpose();
  }
  return noisy;
}

/// What geometry says at a place.
struct Exact
{
  Vector3 MaximumDirection;
  double Maximum, Minimum;
};

Exact OfTorus(const Vector3& p)
{
  const double minor = 0.4, fromAxis = std::hypot(p[0], p[1]);
  const Vector3 outward(p[0] / fromAxis, p[1] / fromAxis, 0.0);
  const double angle = std::atan2(p[2], fromAxis - 1.0);
  return { -std::sin(angle) * outward + std::cos(angle) * Vector3::UnitZ(), 1.0 / minor,
    std::cos(angle) / (1.0 + minor * std::cos(angle)) };
}

/// Of the ellipsoid with half axes 1, 1.5 and 2: the shape operator is the projected Hessian over the gradient's length.
const Vector3 HalfAxes(1.0, 1.5, 2.0);
Exact OfEllipsoid(const Vector3& p)
{
  const Vector3 inverse = HalfAxes.cwiseAbs2().cwiseInverse();
  const Vector3 gradient = 2.0 * inverse.cwiseProduct(p);
  const Vector3 x = gradient.normalized().unitOrthogonal();
  const Vector3 y = gradient.normalized().cross(x);
  const auto shape = [&](const Vector3& a, const Vector3& b)
  { return 2.0 * a.dot(inverse.cwiseProduct(b)) / gradient.norm(); };
  const Complex difference(0.5 * (shape(x, x) - shape(y, y)), shape(x, y));
  const Complex direction = std::sqrt(difference / std::abs(difference));
  const double mean = 0.5 * (shape(x, x) + shape(y, y));
  return { direction.real() * x + direction.imag() * y, mean + std::abs(difference), mean - std::abs(difference) };
}

Surface Ellipsoid(int subdivisions)
{
  Surface surface = IrregularSphere(subdivisions, 2);
  surface.V = surface.V * HalfAxes.asDiagonal();
  return surface;
}

/// Root mean squares over the vertices where the curvatures differ by more than 30 % of the larger one.
struct Errors
{
  double Degrees;
  double Curvature; ///< relative
};

Errors ErrorsOf(const Surface& surface, const Surface& exactSurface, double scale,
  const std::function<Exact(const Vector3&)>& exactAt)
{
  const FramedMesh framed(surface.Mesh());
  const PrincipalCurvatures found = FindPrincipalDirections(framed, scale).Vertices;
  double degrees = 0.0, squares = 0.0, scales = 0.0;
  int count = 0;
  for (int v = 0; v < framed.Mesh.NumberOfVertices(); ++v)
  {
    const Exact exact = exactAt(exactSurface.V.row(v).transpose());
    if (exact.Maximum - exact.Minimum < 0.3 * std::abs(exact.Maximum))
    {
      continue;
    }
    const Complex expected = framed.Vertices.ToComplex(v, exact.MaximumDirection);
    const Complex ratio = found.MaximumDirections[v] / expected;
    const double angle = 0.5 * std::arg(ratio * ratio) * 180.0 / Pi; // lines
    degrees += angle * angle;
    squares += std::pow(found.Maximum[v] - exact.Maximum, 2) + std::pow(found.Minimum[v] - exact.Minimum, 2);
    scales += std::pow(exact.Maximum, 2) + std::pow(exact.Minimum, 2);
    ++count;
  }
  return { std::sqrt(degrees / count), std::sqrt(squares / scales) };
}

TEST(PrincipalDirections, AreThoseOfTheTorusAndTheEllipsoid)
{
  const Surface torus = IrregularTorus(120, 48, 3), ellipsoid = Ellipsoid(5);
  const Errors ofTorus = ErrorsOf(torus, torus, 3.0, OfTorus);
  EXPECT_LT(ofTorus.Degrees, 1.0);
  EXPECT_LT(ofTorus.Curvature, 0.1);
  const Errors ofEllipsoid = ErrorsOf(ellipsoid, ellipsoid, 3.0, OfEllipsoid);
  EXPECT_LT(ofEllipsoid.Degrees, 1.0);
  EXPECT_LT(ofEllipsoid.Curvature, 0.1);
}

TEST(PrincipalDirections, ConvergeWithTheSquareOfTheEdges)
{
  std::vector<Errors> errors;
  for (const int n : { 1, 2, 4 })
  {
    const Surface torus = IrregularTorus(50 * n, 20 * n, 3);
    errors.push_back(ErrorsOf(torus, torus, 3.0, OfTorus));
  }
  EXPECT_LT(errors[1].Curvature, 0.35 * errors[0].Curvature);
  EXPECT_LT(errors[2].Curvature, 0.35 * errors[1].Curvature);
  EXPECT_LT(errors[2].Degrees, errors[1].Degrees);
}

// Of the saddle z = (x^2 - y^2) / 2, by the first and second fundamental forms of a graph.
TEST(PrincipalDirections, ConvergeAtTheBoundary)
{
  const auto exactAt = [](double x, double y)
  {
    Eigen::Matrix2d first, second;
    first << 1.0 + x * x, -x * y, -x * y, 1.0 + y * y;
    second << -1.0, 0.0, 0.0, 1.0; // positive where it bends away from the normal
    const Eigen::Matrix2d shape = first.inverse() * second / std::sqrt(1.0 + x * x + y * y);
    const double mean = 0.5 * shape.trace(), half = std::sqrt(mean * mean - shape.determinant());
    return std::array<double, 2>{ mean + half, mean - half };
  };
  const auto errorOf = [&](int n, double scale)
  {
    Surface saddle = IrregularPlane(n, n, 3);
    for (int i = 0; i < saddle.V.rows(); ++i)
    {
      const double x = 2.0 * saddle.V(i, 0) / n - 1.0, y = 2.0 * saddle.V(i, 1) / n - 1.0;
      saddle.V.row(i) << x, y, 0.5 * (x * x - y * y);
    }
    const FramedMesh framed(saddle.Mesh());
    const PrincipalCurvatures found = FindPrincipalDirections(framed, scale).Vertices;
    double squares = 0.0, sizes = 0.0;
    for (int v = 0; v < framed.Mesh.NumberOfVertices(); ++v)
    {
      if (framed.Mesh.IsBoundaryVertex(v))
      {
        const auto [maximum, minimum] = exactAt(saddle.V(v, 0), saddle.V(v, 1));
        squares += std::pow(found.Maximum[v] - maximum, 2) + std::pow(found.Minimum[v] - minimum, 2);
        sizes += maximum * maximum + minimum * minimum;
      }
    }
    return std::sqrt(squares / sizes);
  };
  const double coarse = errorOf(32, 3.0);
  EXPECT_LT(coarse, 0.15);
  EXPECT_LT(errorOf(128, 3.0), 0.45 * coarse); // the regions are a quarter as large
}

TEST(PrincipalDirections, WithstandNoiseWhichALargerScaleWithstandsBetter)
{
  const Surface torus = IrregularTorus(120, 48, 3);
  const double edge = 0.05; // about
  double former = 45.0;
  for (const double scale : { 1.0, 2.0, 4.0 })
  {
    const double degrees = ErrorsOf(WithNoise(torus, 0.1 * edge, 11), torus, scale, OfTorus).Degrees;
    EXPECT_LT(degrees, 0.6 * former);
    former = degrees;
  }
  EXPECT_LT(former, 2.0);
}

TEST(PrincipalDirections, GoAroundACylinderAndInsideAlongIt)
{
  const FramedMesh outside(Cylinder(30, 5).Mesh()), inside(InsideOut(Cylinder(30, 5)).Mesh());
  for (const FramedMesh* surface : { &outside, &inside })
  {
    const bool isInside = surface == &inside;
    const PrincipalDirections found = FindPrincipalDirections(*surface, 3.0);
    for (int face = 0; face < surface->Mesh.NumberOfFaces(); ++face)
    {
      const Vector3 direction = surface->Faces.ToVector(face, found.Faces.MaximumDirections[face]);
      EXPECT_NEAR(std::abs(direction[2]), isInside ? 1.0 : 0.0, isInside ? 0.01 : 0.1) << face;
      EXPECT_NEAR(found.Faces.Maximum[face], isInside ? 0.0 : 1.0, 0.3) << face;
      EXPECT_NEAR(found.Faces.Minimum[face], isInside ? -1.0 : 0.0, 0.3) << face;
      EXPECT_GT(found.Faces.Confidence[face], 0.4) << face;
    }
    EXPECT_NEAR(found.Faces.Maximum.mean(), isInside ? 0.0 : 1.0, 0.05); // less at the boundary
    EXPECT_NEAR(found.Faces.Minimum.mean(), isInside ? -1.0 : 0.0, 0.05);
    EXPECT_GT(found.Faces.Confidence.mean(), 0.5);
  }
}

TEST(PrincipalDirections, AreNotClearOnASphereAndNoneOnAPlane)
{
  const FramedMesh sphere(IrregularSphere(4, 7).Mesh());
  const PrincipalDirections round = FindPrincipalDirections(sphere, 3.0);
  EXPECT_LT(round.Faces.Confidence.maxCoeff(), 0.01);
  EXPECT_LT((round.Vertices.Maximum.array() - 1.0).abs().maxCoeff(), 0.1);
  EXPECT_LT((round.Vertices.Minimum.array() - 1.0).abs().maxCoeff(), 0.1);

  const FramedMesh plane(RotatedAndScaled(IrregularPlane(20, 20, 3), 0.7, 3.0).Mesh());
  const PrincipalDirections flat = FindPrincipalDirections(plane, 3.0);
  EXPECT_EQ(flat.Faces.Confidence.maxCoeff(), 0.0);
  EXPECT_TRUE(flat.Faces.MaximumDirections.isZero(0.0));
  EXPECT_TRUE(flat.Vertices.MaximumDirections.isZero(0.0));
}

TEST(PrincipalDirections, MoveWithTheSurface)
{
  const Surface torus = IrregularTorus(40, 20, 3);
  Eigen::Matrix3d rotation;
  const FramedMesh one(torus.Mesh()), other(RotatedAndScaled(torus, 1.1, 1000.0, &rotation).Mesh());
  const PrincipalCurvatures a = FindPrincipalDirections(one, 3.0).Faces;
  const PrincipalCurvatures b = FindPrincipalDirections(other, 3.0).Faces;
  EXPECT_LT((a.Maximum - 1000.0 * b.Maximum).cwiseAbs().maxCoeff(), 1e-9);
  EXPECT_LT((a.Minimum - 1000.0 * b.Minimum).cwiseAbs().maxCoeff(), 1e-9);
  for (int face = 0; face < one.Mesh.NumberOfFaces(); ++face)
  {
    const Vector3 moved = rotation * one.Faces.ToVector(face, a.MaximumDirections[face]);
    const Vector3 found = other.Faces.ToVector(face, b.MaximumDirections[face]);
    EXPECT_LT(moved.cross(found).norm(), 1e-7);
    EXPECT_NEAR(a.Confidence[face], b.Confidence[face], 1e-2); // the box turns as well
  }
}

TEST(PrincipalDirections, DoNotSeeWhatIsNearButElsewhere)
{
  const Surface cylinder = Cylinder(16, 5);
  const FramedMesh one(cylinder.Mesh());
  const FramedMesh two(Union(cylinder, IrregularSphere(3, 2), Vector3(1.5, 0.0, 1.0)).Mesh());
  const auto alone = FindPrincipalDirections(one, 0.0), beside = FindPrincipalDirections(two, 0.0);
  const int size = one.Mesh.NumberOfVertices();
  EXPECT_EQ(alone.Vertices.Maximum, beside.Vertices.Maximum.head(size));
  const auto far = FindPrincipalDirections(two, 4.0);
  EXPECT_LT((far.Vertices.Maximum.head(size).array() - 1.0).abs().maxCoeff(), 0.3);
}

/// A fan of triangles around vertex 0, which counts how often a neighbour is looked at.
class CountingFan
{
public:
  explicit CountingFan(int triangles)
    : Size(triangles)
  {
  }

  Vector3 Position(int vertex) const
  {
    const double angle = 2.0 * Pi * vertex / this->Size;
    return vertex == 0 ? Vector3(0.0, 0.0, 0.3) : Vector3(std::cos(angle), std::sin(angle), 0.0);
  }
  BendOfPart Part(int) const { return {}; }
  template <class Visit>
  void VisitNeighbours(int vertex, const Visit& visit) const
  {
    const auto look = [&](int neighbour)
    {
      ++this->Looks;
      return visit(neighbour);
    };
    if (vertex > 0)
    {
      look(0) && look(1 + vertex % this->Size) && look(1 + (vertex + this->Size - 2) % this->Size);
      return;
    }
    for (int rim = 1; rim <= this->Size && look(rim); ++rim)
    {
    }
  }

  const int Size;
  mutable double Looks = 0.0;
};

TEST(PrincipalDirections, LookAtFewNeighboursEachBesideAVertexOfVeryMany)
{
  constexpr int Triangles = 20000;
  const CountingFan fan(Triangles);
  SurfaceSizes sizes;
  sizes.NumberOfVertices = Triangles + 1;
  sizes.MeanEdge = 0.5;
  const RegionSize region(3.0, sizes);
  SumsOverRegions<CountingFan> sums(fan, Triangles + 1, region);
  for (int vertex = 0; vertex <= Triangles; ++vertex)
  {
    sums.Around(vertex);
  }
  // Three at each vertex of the rim, and the limit at the centre; each for all regions. The region of the centre is all.
  EXPECT_LE(fan.Looks, 4.0 * Triangles * static_cast<double>(region.Limit + 2));
}

/// A tube of radius 1 around the z-axis with 60 right triangles around, which are a number of times as long as high.
Surface TubeOfLongTriangles(double ratio)
{
  constexpr int Around = 60;
  Surface tube = Prism(Around, 12);
  const double height = 2.0 * Pi / Around;
  const double length = tube.V.col(2).maxCoeff() - tube.V.col(2).minCoeff();
  for (int i = 0; i < tube.V.rows(); ++i)
  {
    tube.V.row(i).head<2>().normalize();
    tube.V(i, 2) *= 12.0 * ratio * height / length;
  }
  return tube;
}

TEST(PrincipalDirections, OfATubeOfLongTrianglesAreExactAtASmallScaleAndToldAtALargeOne)
{
  const FramedMesh even(TubeOfLongTriangles(1.0).Mesh()), thin(TubeOfLongTriangles(20.0).Mesh());
  for (const auto& [surface, scale] : { std::pair{ &even, 0.0 }, { &even, 3.0 }, { &thin, 0.0 } })
  {
    const PrincipalDirections found = FindPrincipalDirections(*surface, scale);
    EXPECT_EQ(ShareBentWithinScale(*surface, found, scale), 0.0);
    EXPECT_EQ(WarningOfScale(*surface, found, scale), "");
    EXPECT_NEAR(found.Vertices.Maximum.mean(), 1.0, 0.05);
  }
  for (const auto& [surface, scale] : { std::pair{ &even, 15.0 }, { &thin, 3.0 } })
  {
    const PrincipalDirections found = FindPrincipalDirections(*surface, scale);
    EXPECT_LT(found.Vertices.Maximum.mean(), 5.0 / 6.0);
    EXPECT_NEAR(ShareBentWithinScale(*surface, found, scale), 1.0, 1e-12);
    EXPECT_NE(WarningOfScale(*surface, found, scale).find("on 100 % of the surface"), std::string::npos);
  }
}

TEST(PrincipalDirections, OfCoarseSpheresAndOfSharpEdgesAreNotTold)
{
  Surface folded = PlaneGrid(20, 10);
  for (int i = 0; i < folded.V.rows(); ++i)
  {
    folded.V(i, 2) = std::max(folded.V(i, 0) - 10.0, 0.0);
    folded.V(i, 0) = std::min(folded.V(i, 0), 10.0);
  }
  for (const Surface& shape : { Icosphere(0), Icosphere(2), folded })
  {
    const FramedMesh surface(shape.Mesh());
    EXPECT_EQ(WarningOfScale(surface, FindPrincipalDirections(surface, 3.0), 3.0), "");
  }
}

TEST(PrincipalDirections, HaveTheSameBitsForAnyNumberOfThreads)
{
  const FramedMesh surface(IrregularTorus(300, 120, 3).Mesh());
  const PrincipalDirections serial = FindPrincipalDirections(surface, 3.0);
  const PrincipalDirections parallel = FindPrincipalDirections(surface, 3.0, TbbContext(4));
  EXPECT_EQ(serial.Faces.MaximumDirections, parallel.Faces.MaximumDirections);
  EXPECT_EQ(serial.Faces.Confidence, parallel.Faces.Confidence);
  EXPECT_EQ(serial.Vertices.Maximum, parallel.Vertices.Maximum);
}

TEST(PrincipalDirections, StopWhenAsked)
{
  TbbContext context(2);
  context.CancelAfter(1);
  const FramedMesh surface(Icosphere(3).Mesh());
  EXPECT_THROW(FindPrincipalDirections(surface, 3.0, context), Cancelled);
}

TEST(PrincipalDirections, AreSoundOnEverySurface)
{
  std::vector<NamedSurface> surfaces = SmallSurfaces();
  surfaces.push_back({ "zero-area faces", SphereWithZeroAreaFaces(3, 10) });
  surfaces.push_back({ "capsule", CapsuleFromRectangle(16, 12) });
  surfaces.push_back({ "thin triangles", PlaneWithThinTriangles(10, 10) });
  for (const NamedSurface& surface : surfaces)
  {
    const FramedMesh framed(surface.Shape.Mesh());
    for (const double scale : { 0.0, 3.0, 100.0 })
    {
      SCOPED_TRACE(surface.Name + ", scale " + std::to_string(scale));
      const PrincipalDirections found = FindPrincipalDirections(framed, scale);
      for (const PrincipalCurvatures* of : { &found.Faces, &found.Vertices })
      {
        EXPECT_TRUE(of->Maximum.allFinite() && of->Minimum.allFinite());
        EXPECT_TRUE((of->Maximum.array() >= of->Minimum.array()).all());
        EXPECT_TRUE((of->Confidence.array() >= 0.0).all() && (of->Confidence.array() < 1.0).all());
        for (int i = 0; i < of->Confidence.size(); ++i)
        {
          EXPECT_NEAR(std::abs(of->MaximumDirections[i]), of->Confidence[i] > 0.0 ? 1.0 : 0.0, 1e-12);
        }
      }
    }
  }
}

}
