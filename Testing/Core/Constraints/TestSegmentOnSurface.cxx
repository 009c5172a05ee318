#include "Constraints/SegmentOnSurface.h"

#include "Constraints/Guides.h"
#include "Support/MeshFactory.h"
#include "Support/TbbContext.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <random>

using namespace dmg;
using namespace dmg::test;

namespace
{

constexpr double Everywhere = std::numeric_limits<double>::infinity();
using Lengths = std::map<int, double>; // by face

/// A surface and the parts of segments on it.
class Setting
{
public:
  explicit Setting(const Surface& surface, double maximumDistance = Everywhere)
    : Framed(surface.Mesh())
    , Nearest(this->Framed)
    , Segments(this->Nearest, maximumDistance)
  {
  }

  Lengths LengthsOf(const Vector3& start, const Vector3& end, SegmentPart::Kinds kind) const
  {
    Lengths lengths;
    for (const SegmentPart& part : this->Segments.PartsOf(start, end))
    {
      if (part.Kind == kind)
      {
        lengths[part.Face] += part.Length;
      }
    }
    return lengths;
  }

  FramedMesh Framed;
  NearestPlaces Nearest;
  SegmentOnSurface Segments;
};

/// Which fraction of a segment is where functions that are linear along it are not negative.
/// \param ends their values at the start and the end.
double FractionInside(const std::vector<std::pair<double, double>>& ends)
{
  double from = 0.0, to = 1.0;
  for (const auto& [atStart, atEnd] : ends)
  {
    const double root = atStart / (atStart - atEnd);
    if (atStart < 0.0)
    {
      from = atEnd < 0.0 ? 1.0 : std::max(from, root);
    }
    else if (atEnd < 0.0)
    {
      to = std::min(to, root);
    }
  }
  return std::max(0.0, to - from);
}

/// On which length a segment is above or below the faces of a plane with z constant.
Lengths LengthsAbovePlane(const Surface& plane, const Vector3& start, const Vector3& end)
{
  Lengths lengths;
  for (int f = 0; f < plane.F.rows(); ++f)
  {
    std::vector<std::pair<double, double>> ends;
    for (int k = 0; k < 3; ++k)
    {
      const Vector3 tail = plane.V.row(plane.F(f, k));
      const Vector3 side = Vector3(plane.V.row(plane.F(f, (k + 1) % 3))) - tail;
      ends.push_back({ side.cross(start - tail).z(), side.cross(end - tail).z() });
    }
    const double length = FractionInside(ends) * (end - start).norm();
    if (length > 0.0)
    {
      lengths[f] = length;
    }
  }
  return lengths;
}

void ExpectSame(const Lengths& lengths, const Lengths& expected, double tolerance)
{
  const auto difference = [tolerance](const Lengths& all, const Lengths& others)
  {
    for (const auto& [cell, length] : all)
    {
      const auto other = others.find(cell);
      EXPECT_NEAR(length, other == others.end() ? 0.0 : other->second, tolerance) << "cell " << cell;
    }
  };
  difference(lengths, expected);
  difference(expected, lengths);
}

}

// A segment with two ends touches each triangle below it, with the length that it has there.
TEST(SegmentOnSurface, HasAPartForEachTriangleOfAPlane)
{
  constexpr int Seed = 5281;
  SCOPED_TRACE(Seed);
  std::mt19937 random(Seed);
  std::uniform_real_distribution<double> fraction(0.01, 0.99);
  for (const Surface& plane : { PlaneGrid(9, 7), IrregularPlane(12, 9, 7) })
  {
    const Setting setting(plane);
    const Vector3 lower = plane.V.colwise().minCoeff(), upper = plane.V.colwise().maxCoeff();
    const auto anywhere = [&](double z)
    {
      return Vector3(lower.x() + fraction(random) * (upper.x() - lower.x()),
        lower.y() + fraction(random) * (upper.y() - lower.y()), lower.z() + z);
    };
    const double smallest = 4e-6 * (upper - lower).norm(); // twice two smallest parts
    for (double z : { 0.0, 0.4, -1.5 })
    {
      for (int i = 0; i < 30; ++i)
      {
        const Vector3 start = anywhere(z), end = anywhere(z);
        ExpectSame(
          setting.LengthsOf(start, end, SegmentPart::OnSurface), LengthsAbovePlane(plane, start, end), smallest);
      }
    }
  }
}

// From vertex to vertex, through others.
TEST(SegmentOnSurface, TouchesNoFaceBesideItsWay)
{
  const Surface plane = PlaneGrid(9, 7);
  const Setting setting(plane);
  for (const auto& [start, end] : { std::pair(Vector3(1.0, 1.0, 0.0), Vector3(5.0, 3.0, 0.0)),
         std::pair(Vector3(2.0, 5.0, 0.5), Vector3(8.0, 2.0, 0.5)),
         std::pair(Vector3(3.0, 1.0, 0.0), Vector3(4.0, 6.0, 0.0)) })
  {
    ExpectSame(setting.LengthsOf(start, end, SegmentPart::OnSurface), LengthsAbovePlane(plane, start, end), 1e-4);
  }
}

// Each face beside an edge has half of the edge.
TEST(SegmentOnSurface, AlongAnEdgeTouchesTheFacesBesideIt)
{
  const Setting setting(PlaneGrid(4, 4));
  const Vector3 start(1.0, 2.0, 0.0), end(3.0, 2.0, 0.0);
  const Lengths lengths = setting.LengthsOf(start, end, SegmentPart::OnSurface);
  double sum = 0.0;
  for (const auto& [cell, length] : lengths)
  {
    int ofSegment = 0; // corners of the face
    for (int k = 0; k < 3; ++k)
    {
      const Vector3 corner = setting.Framed.Mesh.Position(setting.Framed.Mesh.FaceCorners()(cell, k));
      ofSegment += corner.y() == 2.0 && corner.x() >= 1.0 && corner.x() <= 3.0;
    }
    EXPECT_EQ(ofSegment, 2) << "cell " << cell;
    EXPECT_NEAR(length, 0.5, 1e-4) << "cell " << cell;
    sum += length;
  }
  EXPECT_NEAR(sum, 2.0, 1e-4);
}

// A roof whose sides are turned against each other: a line along the ridge, or above it, belongs to both sides alike, whatever
// rounding says, and neither of them is far.
TEST(SegmentOnSurface, AlongASharpRidgeBelongsToBothSides)
{
  for (double scale : { 1.0, 3.0, 1000.0, 1e-3 })
  {
    Surface roof = PlaneGrid(2, 6);
    for (int point = 0; point < roof.V.rows(); ++point)
    {
      const double beside = roof.V(point, 0) - 1.0; // of the ridge
      const Vector3 position(0.2 * beside, roof.V(point, 1) + 0.1, -std::abs(beside) + 0.3);
      roof.V.row(point) = scale * position;
    }
    const Setting setting(roof);
    for (double height : { 0.0, 0.01 })
    {
      for (double step : { 4.0, 0.1 })
      {
        double sides[2] = { 0.0, 0.0 };
        for (double y = 1.3; y < 5.2; y += step)
        {
          const Vector3 start = scale * Vector3(0.0, y, 0.3 + height), along = scale * Vector3(0.0, step, 0.0);
          EXPECT_TRUE(setting.LengthsOf(start, start + along, SegmentPart::OnFarSide).empty());
          for (const auto& [cell, length] : setting.LengthsOf(start, start + along, SegmentPart::OnSurface))
          {
            double least = 0.0;
            for (int k = 0; k < 3; ++k)
            {
              least = std::min(least, setting.Framed.Mesh.Position(setting.Framed.Mesh.FaceCorners()(cell, k))[0]);
            }
            sides[least < -1e-9 * scale ? 0 : 1] += length / scale;
          }
        }
        EXPECT_NEAR(sides[0], sides[1], 1e-3);
        EXPECT_NEAR(sides[0] + sides[1], 4.0, 0.11);
      }
    }
  }
}

// A chord of a sphere touches what lies along the great circle.
TEST(SegmentOnSurface, HasAPartForEachFaceAlongAChordOfASphere)
{
  const Surface sphere = Icosphere(3);
  const Setting setting(sphere);
  const Vector3 start = Vector3(0.3, -0.2, 0.9).normalized();
  const Vector3 end = Vector3(0.9, 0.4, 0.3).normalized();
  const Lengths lengths = setting.LengthsOf(start, end, SegmentPart::OnSurface);
  // The nearest face is not quite the one that is seen from the center.
  const double margin = 0.02;
  for (int f = 0; f < sphere.F.rows(); ++f)
  {
    std::vector<std::pair<double, double>> within, around;
    for (int k = 0; k < 3; ++k)
    {
      const Vector3 tail = sphere.V.row(sphere.F(f, k)), head = sphere.V.row(sphere.F(f, (k + 1) % 3));
      const Vector3 inwards = tail.cross(head).normalized();
      within.push_back({ inwards.dot(start), inwards.dot(end) });
      around.push_back({ inwards.dot(start) + margin, inwards.dot(end) + margin });
    }
    const bool isTouched = lengths.count(f) > 0;
    if (FractionInside(within) * (end - start).norm() > 2.0 * margin)
    {
      EXPECT_TRUE(isTouched) << "cell " << f;
    }
    if (isTouched)
    {
      EXPECT_GT(FractionInside(around), 0.0) << "cell " << f;
    }
  }
  EXPECT_TRUE(setting.LengthsOf(start, end, SegmentPart::OnFarSide).empty());
}

// The nearest faces of very many points say the same. (Inside of a convex surface, where a point has one.)
TEST(SegmentOnSurface, HasPartsAsLongAsManySamplesSay)
{
  constexpr int Seed = 917, Samples = 1000;
  SCOPED_TRACE(Seed);
  std::mt19937 random(Seed);
  std::normal_distribution<double> coordinate;
  const Setting setting(IrregularSphere(3, 11, 0.1));
  const auto inside = [&random, &coordinate]
  {
    const Vector3 position(coordinate(random), coordinate(random), coordinate(random));
    return Vector3(0.98 * position.normalized());
  };
  for (int i = 0; i < 30; ++i)
  {
    const Vector3 start = inside(), other = inside();
    const double length = std::min(0.8, (other - start).norm());
    const Vector3 end = start + length * (other - start).normalized();
    Lengths expected;
    for (int k = 0; k < Samples; ++k)
    {
      const NearestPlace place = setting.Nearest(start + (k + 0.5) / Samples * (end - start));
      expected[place.Face] += length / Samples;
    }
    Lengths lengths = setting.LengthsOf(start, end, SegmentPart::OnSurface);
    const Lengths onFarSide = setting.LengthsOf(start, end, SegmentPart::OnFarSide);
    lengths.insert(onFarSide.begin(), onFarSide.end());
    // Two ends, each off by a sample or by what a crossing may be.
    ExpectSame(lengths, expected, 4.0 * length / Samples);
  }
}

TEST(SegmentOnSurface, EndsWhereItIsTooFar)
{
  const Setting setting(PlaneGrid(8, 8), 2.0);
  const Vector3 start(1.1, 1.2, 0.0), end(6.3, 1.3, 6.5);
  double onSurface = 0.0, tooFar = 0.0;
  for (const SegmentPart& part : setting.Segments.PartsOf(start, end))
  {
    (part.Kind == SegmentPart::OnSurface ? onSurface : tooFar) += part.Length;
    if (part.Kind == SegmentPart::OnSurface)
    {
      EXPECT_LE(part.Distance, 2.0);
    }
  }
  const double length = (end - start).norm();
  EXPECT_NEAR(onSurface, length * 2.0 / 6.5, 1e-4);
  EXPECT_NEAR(tooFar, length * 4.5 / 6.5, 1e-4);
}

TEST(SegmentOnSurface, MayBeVeryLong)
{
  const Surface plane = PlaneGrid(8, 8);
  const Setting setting(plane, 1.0);
  const Lengths lengths = setting.LengthsOf({ -1e7, 2.3, 0.5 }, { 1e7, 2.3, 0.5 }, SegmentPart::OnSurface);
  const Lengths expected = LengthsAbovePlane(plane, { 0.0, 2.3, 0.5 }, { 8.0, 2.3, 0.5 });
  EXPECT_EQ(lengths.size(), expected.size());
  for (const auto& [cell, length] : expected)
  {
    EXPECT_EQ(lengths.count(cell), 1u) << "cell " << cell;
  }
}

TEST(SegmentOnSurface, WithoutLengthHasNoParts)
{
  const Setting setting(PlaneGrid(4, 4));
  EXPECT_TRUE(setting.Segments.PartsOf({ 1.1, 1.2, 0.0 }, { 1.1, 1.2, 0.0 }).empty());
}

namespace
{

/// A wall: the outside of a half cylinder of radius 1 and, turned inwards, that of another radius.
/// The first half of the faces is outside.
Surface HalfPipe(double innerRadius)
{
  const Surface flat = PlaneGrid(60, 6);
  const int points = static_cast<int>(flat.V.rows()), faces = static_cast<int>(flat.F.rows());
  Surface wall{ Points(2 * points, 3), Triangles(2 * faces, 3) };
  for (int i = 0; i < points; ++i)
  {
    const double angle = Pi * (1.0 - flat.V(i, 0) / 60.0);
    const Vector3 outside(std::cos(angle), 0.2 * flat.V(i, 1), std::sin(angle));
    wall.V.row(i) = outside;
    wall.V.row(points + i) = Vector3(innerRadius * outside.x(), outside.y(), innerRadius * outside.z());
  }
  for (int f = 0; f < faces; ++f)
  {
    wall.F.row(f) = flat.F.row(f);
    wall.F.row(faces + f) << flat.F(f, 0) + points, flat.F(f, 2) + points, flat.F(f, 1) + points;
  }
  return wall;
}

Vector3 OnPipe(double angle, double y)
{
  return { std::cos(angle), y, std::sin(angle) };
}

}

// The middle of the chord is inside the pipe, 0.11 below the outside and 0.05 below the inside.
TEST(SegmentOnSurface, DoesNotTouchTheFarSideOfAThinWall)
{
  const Setting setting(HalfPipe(0.94));
  const int outside = setting.Framed.Mesh.NumberOfFaces() / 2;
  const double half = std::acos(0.89);
  const Vector3 start = OnPipe(1.5 - half, 0.53), end = OnPipe(1.5 + half, 0.67);
  for (const auto& [cell, length] : setting.LengthsOf(start, end, SegmentPart::OnSurface))
  {
    EXPECT_LT(cell, outside);
  }
  double onFarSide = 0.0;
  for (const auto& [cell, length] : setting.LengthsOf(start, end, SegmentPart::OnFarSide))
  {
    EXPECT_GE(cell, outside);
    onFarSide += length;
  }
  // It is nearer to the inside where it is less than 0.97 from the axis.
  const double across = std::sqrt(0.97 * 0.97 - 0.89 * 0.89), chord = std::sin(half);
  EXPECT_NEAR(onFarSide / (end - start).norm(), across / chord, 0.02);
}

TEST(SegmentOnSurface, TouchesTheNearSideOfAThinWallOnly)
{
  const Setting setting(HalfPipe(0.94));
  const int outside = setting.Framed.Mesh.NumberOfFaces() / 2;
  // The first is drawn on the outside, the second on the inside.
  for (double radius : { 1.0, 0.94 })
  {
    const Vector3 start(radius * OnPipe(1.4, 0.0)), end(radius * OnPipe(1.7, 0.0));
    const Vector3 y(0.0, 0.61, 0.0);
    const Lengths lengths = setting.LengthsOf(start + y, end + y, SegmentPart::OnSurface);
    EXPECT_GE(lengths.size(), 5u); // a face is 0.05 wide
    for (const auto& [cell, length] : lengths)
    {
      EXPECT_EQ(cell < outside, radius == 1.0) << "cell " << cell;
    }
    EXPECT_TRUE(setting.LengthsOf(start + y, end + y, SegmentPart::OnFarSide).empty());
  }
}

// Only what is near counts: a ray says the same wherever it ends.
TEST(SegmentOnSurface, SaysTheSameWhereverARayEnds)
{
  const Surface plane = PlaneGrid(8, 8);
  const Setting setting(plane, 1.0);
  const Vector3 start(1.3, 2.3, 0.5), along(1.0, 0.0, 0.0);
  const Lengths expected = LengthsAbovePlane(plane, start, { 8.0, 2.3, 0.5 });
  for (double reach : { 20.0, 1e3, 1e6, 1e12, 1e20, 1e100 })
  {
    const Lengths lengths = setting.LengthsOf(start, start + reach * along, SegmentPart::OnSurface);
    const Lengths back = setting.LengthsOf(start + reach * along, start, SegmentPart::OnSurface);
    EXPECT_EQ(lengths.size(), expected.size()) << reach;
    EXPECT_EQ(back.size(), expected.size()) << reach;
    double sum = 0.0;
    for (const auto& [face, length] : lengths)
    {
      EXPECT_EQ(expected.count(face), 1u) << reach;
      sum += length;
    }
    // The part beyond the rim that is within a distance of 1 of it is nearest to the rim.
    const double beyond = std::sqrt(1.0 - 0.25);
    EXPECT_NEAR(sum, 8.0 - 1.3 + beyond, 1e-3) << reach;
  }
}

// An oblique ray, far beyond what numbers resolve there.
TEST(SegmentOnSurface, FollowsAnObliqueRay)
{
  const Surface plane = PlaneGrid(8, 8);
  const Setting setting(plane, 0.5);
  const Vector3 start(1.3, 2.3, 0.0), along = Vector3(1.0, 0.5, 0.1);
  const Lengths near = setting.LengthsOf(start, start + 20.0 * along, SegmentPart::OnSurface);
  const Lengths far = setting.LengthsOf(start, start + 1e20 * along, SegmentPart::OnSurface);
  ExpectSame(far, near, 1e-3);
}

// The boxes say what a look at all faces says.
TEST(NearestPlaces, AreThoseOfAllFaces)
{
  constexpr int Seed = 4711;
  SCOPED_TRACE(Seed);
  std::mt19937 random(Seed);
  std::normal_distribution<double> coordinate;
  for (const Surface& surface : { IrregularSphere(3, 11, 0.1), PlaneGrid(5, 3), PlaneGrid(1, 1) })
  {
    const FramedMesh framed(surface.Mesh());
    const NearestPlaces nearest(framed);
    for (int i = 0; i < 300; ++i)
    {
      const Vector3 position(2.0 * coordinate(random), 2.0 * coordinate(random), 2.0 * coordinate(random));
      double least = Everywhere;
      for (int face = 0; face < framed.Mesh.NumberOfFaces(); ++face)
      {
        least = std::min(least, ClosestOnFace(framed.Mesh, face, position).Distance);
      }
      EXPECT_EQ(nearest(position).Distance, least);
      EXPECT_EQ(nearest(position, i % framed.Mesh.NumberOfFaces()).Distance, least);
    }
  }
}

// One thread or several: the same bits, in the same order.
TEST(Guides, AreTheSameForAnyNumberOfThreads)
{
  constexpr int Seed = 815;
  SCOPED_TRACE(Seed);
  std::mt19937 random(Seed);
  std::normal_distribution<double> coordinate;
  const FramedMesh surface(IrregularSphere(4, 11, 0.1).Mesh());
  const NearestPlaces nearest(surface);
  Guides guides;
  GuideLine walk;
  for (int i = 0; i < 6000; ++i)
  {
    const Vector3 position(coordinate(random), coordinate(random), coordinate(random));
    walk.Points.push_back(Vector3(std::cos(0.01 * i), std::sin(0.01 * i), 0.0001 * i));
    guides.Vectors.push_back({ position.normalized(), { 1.0, 2.0, 3.0 }, 1.0 });
  }
  guides.Lines.push_back(walk);
  const FollowedGuides one = FollowGuides(guides, nearest);
  EXPECT_GT(one.Directions.size(), 6000u);
  for (int threads : { 2, 5 })
  {
    const FollowedGuides many = FollowGuides(guides, nearest, TbbContext(threads));
    ASSERT_EQ(many.Directions.size(), one.Directions.size());
    EXPECT_EQ(many.Report.Taken, one.Report.Taken);
    EXPECT_EQ(many.Report.Farthest, one.Report.Farthest);
    EXPECT_EQ(many.Report.Paths.Positions, one.Report.Paths.Positions);
    EXPECT_EQ(many.Report.Paths.Ends, one.Report.Paths.Ends);
    for (std::size_t i = 0; i < one.Directions.size(); ++i)
    {
      EXPECT_EQ(many.Directions[i].Element, one.Directions[i].Element);
      EXPECT_EQ(many.Directions[i].Direction, one.Directions[i].Direction);
      EXPECT_EQ(many.Directions[i].Weight, one.Directions[i].Weight);
    }
  }
}

// Each guide has a weight of its own: the directions of all come in the order of the guides, those of each along its line.
TEST(Guides, GiveDirectionsInTheirOrder)
{
  constexpr int Seed = 2718;
  SCOPED_TRACE(Seed);
  std::mt19937 random(Seed);
  std::normal_distribution<double> coordinate;
  const FramedMesh surface(Icosphere(3).Mesh());
  const NearestPlaces nearest(surface);
  Guides guides;
  for (int i = 1; i <= 300; ++i)
  {
    const Vector3 position(coordinate(random), coordinate(random), coordinate(random));
    guides.Vectors.push_back({ position.normalized(), position.unitOrthogonal(), static_cast<double>(i) });
  }
  const FollowedGuides followed = FollowGuides(guides, nearest);
  ASSERT_EQ(followed.Directions.size(), 300u);
  for (int i = 0; i < 300; ++i)
  {
    EXPECT_EQ(followed.Directions[i].Weight, i + 1.0);
    EXPECT_EQ(followed.Directions[i].Element, nearest(guides.Vectors[i].Position).Face);
  }
}

// A vector that leans out of an ellipsoid, as the velocity of a particle over it: errors of its direction by the surface's normal are of second
// order, whatever its part along the normal is. By the normals of faces they would be of first order.
TEST(Guides, CountWithoutTheirPartsAlongTheNormal)
{
  const Vector3 axes(1.0, 0.8, 0.6);
  const auto meanError = [&axes](int subdivisions, double part)
  {
    Surface ellipsoid = IrregularSphere(subdivisions, 7, 0.1);
    ellipsoid.V = ellipsoid.V * axes.asDiagonal();
    const FramedMesh surface(ellipsoid.Mesh());
    Guides guides;
    std::vector<Vector3> tangents;
    for (int i = 0; i < 500; ++i)
    {
      const Vector3 at(std::sin(1.7 * i), std::sin(2.9 * i + 1.0), std::cos(4.3 * i));
      const Vector3 place = at.normalized().cwiseProduct(axes);
      const Vector3 normal = place.cwiseQuotient(axes.cwiseAbs2()).normalized();
      tangents.push_back(normal.cross(Vector3::UnitX()).normalized());
      guides.Vectors.push_back({ place, tangents.back() + part * normal });
      guides.Lines.push_back({ { place, place + 1e-3 * tangents.back() }, {}, tangents.back() + part * normal });
    }
    FollowedGuides followed = FollowGuides(guides, NearestPlaces(surface));
    TakeOutNormalParts(followed, surface.Mesh);
    double sum = 0.0;
    int number = 0;
    for (std::size_t i = 0; i < followed.Directions.size(); ++i)
    {
      const Constraint& on = followed.Directions[i];
      const bool isOfVector = i + tangents.size() >= followed.Directions.size();
      const Vector3 at = followed.Places[i].cwiseQuotient(axes.cwiseAbs2()).normalized();
      const Vector3 right = isOfVector ? tangents[i + tangents.size() - followed.Directions.size()]
                                       : Vector3(at.cross(Vector3::UnitX()).normalized());
      const Complex z = surface.Faces.ToComplex(on.Element, on.Direction);
      const bool isAtPole = std::abs(at.x()) > 0.9; // where the right direction turns quickly
      sum += isAtPole ? 0.0 : std::abs(std::arg(z / surface.Faces.ToComplex(on.Element, right)));
      number += isAtPole ? 0 : 1;
    }
    return sum / number;
  };
  for (const double part : { 1.0, 5.0 })
  {
    const double coarse = meanError(3, part), fine = meanError(4, part);
    EXPECT_LT(coarse, 0.01 * part);
    EXPECT_LT(fine, 0.35 * coarse) << part;
  }
}

// One path for each segment, from below its start to below its end, without gaps.
TEST(Guides, HavePathsOnTheSurfaceBelowTheirLines)
{
  const FramedMesh plane(PlaneGrid(8, 8).Mesh());
  const NearestPlaces nearest(plane);
  Guides guides;
  guides.MaximumDistance = 1.0;
  guides.Lines.push_back({ { { 0.1, 3.3, 0.5 }, { 7.9, 3.3, 0.5 }, { 7.9, 6.2, 0.5 } } });
  GuidePaths paths = FollowGuides(guides, nearest).Report.Paths;
  ASSERT_EQ(paths.Ends.size(), 2u);
  EXPECT_EQ(paths.Ends.back(), static_cast<int>(paths.Positions.size()));
  double length = 0.0;
  int first = 0;
  for (const int end : paths.Ends)
  {
    for (int i = first + 1; i < end; ++i)
    {
      length += (paths.Positions[i] - paths.Positions[i - 1]).norm();
      EXPECT_EQ(paths.Positions[i].z(), 0.0);
    }
    first = end;
  }
  EXPECT_NEAR(length, 7.8 + 2.9, 1e-9);
  // Where a line is too far, there is none.
  guides.MaximumDistance = 0.01;
  guides.Lines[0].Points = { { 0.1, 3.3, 0.0 }, { 2.0, 3.3, 0.0 }, { 6.0, 3.3, 4.0 } };
  paths = FollowGuides(guides, nearest).Report.Paths;
  for (const Vector3& position : paths.Positions)
  {
    EXPECT_LT(position.x(), 2.2);
  }
  EXPECT_GE(paths.Ends.size(), 1u);
}
