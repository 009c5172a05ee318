#include "Drawing/EvenlySpacedLines.h"

#include "Fields.h"
#include "Support/Errors.h"
#include "Support/NamedSurfaces.h"
#include "Support/TbbContext.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <map>

namespace
{

using namespace dmg;
using namespace dmg::test;

LinesOnSurface Draw(
  const DrawnField& field, const LineOptions& options, const ExecutionContext& context = SerialContext())
{
  return EvenlySpacedLines(field.Unfolded, field.Field, options, context);
}

Vector3 Cosines(double angle)
{
  return { std::cos(angle), std::sin(angle), 0.0 };
}

double SumOfLengths(const LinesOnSurface& lines)
{
  double sum = 0.0;
  for (const double length : lines.Lengths)
  {
    sum += length;
  }
  return sum;
}

/// The length of the polyline itself.
double LengthOf(const LinesOnSurface& lines, int line)
{
  double length = 0.0;
  for (int i = lines.Offsets[line] + 1; i < lines.Offsets[line + 1]; ++i)
  {
    length += (lines.Positions[i] - lines.Positions[i - 1]).norm();
  }
  return lines.IsClosed[line]
    ? length + (lines.Positions[lines.Offsets[line]] - lines.Positions[lines.Offsets[line + 1] - 1]).norm()
    : length;
}

double DistanceToSegment(const Vector3& point, const Vector3& a, const Vector3& b)
{
  const Vector3 way = b - a;
  const double part = std::clamp((point - a).dot(way) / std::max(way.squaredNorm(), 1e-300), 0.0, 1.0);
  return (a + part * way - point).norm();
}

/// The least distance between points of lines and other lines that run nearly the same way, in a plane.
double LeastDistance(const LinesOnSurface& lines)
{
  double least = 1e300;
  for (int a = 0; a < lines.NumberOfLines(); ++a)
  {
    for (int i = lines.Offsets[a] + 1; i < lines.Offsets[a + 1]; ++i)
    {
      const Vector3 along = (lines.Positions[i] - lines.Positions[i - 1]).normalized();
      for (int b = 0; b < lines.NumberOfLines(); ++b)
      {
        for (int j = lines.Offsets[b] + 1; a != b && j < lines.Offsets[b + 1]; ++j)
        {
          const Vector3 other = lines.Positions[j] - lines.Positions[j - 1];
          if (std::abs(other.dot(along)) > 0.9 * other.norm())
          {
            least = std::min(least, DistanceToSegment(lines.Positions[i], lines.Positions[j - 1], lines.Positions[j]));
          }
        }
      }
    }
  }
  return least;
}

TEST(EvenlySpacedLines, OfAParallelFieldAreStraightAtEvenDistances)
{
  const double angle = 0.3;
  for (const Surface& surface : { PlaneGrid(40, 30), IrregularPlane(40, 30, 5) })
  {
    for (const int N : { 1, 2 })
    {
      const DrawnField field(surface, N, [&](const Vector3&) { return Cosines(angle); });
      const LinesOnSurface lines = Draw(field, { 2.0, 0.5, 0.0 });
      std::vector<double> offsets;
      for (int line = 0; line < lines.NumberOfLines(); ++line)
      {
        const Vector3 normal = Cosines(angle + 0.5 * Pi);
        offsets.push_back(lines.Positions[lines.Offsets[line]].dot(normal));
        for (int i = lines.Offsets[line]; i < lines.Offsets[line + 1]; ++i)
        {
          EXPECT_NEAR(lines.Positions[i].dot(normal), offsets.back(), 1e-10);
        }
        for (const int end : { lines.Offsets[line], lines.Offsets[line + 1] - 1 })
        {
          const Vector3 p = lines.Positions[end];
          EXPECT_LT(std::min({ p[0], p[1], 40.0 - p[0], 30.0 - p[1] }), 1e-10) << "ends at the boundary";
        }
        EXPECT_NEAR(lines.Lengths[line], LengthOf(lines, line), 1e-9);
        EXPECT_FALSE(lines.IsClosed[line]);
        EXPECT_EQ(lines.Families[line], 0);
      }
      std::sort(offsets.begin(), offsets.end());
      ASSERT_GT(offsets.size(), 10u);
      for (std::size_t i = 1; i < offsets.size(); ++i)
      {
        EXPECT_GE(offsets[i] - offsets[i - 1], 0.95 * 2.0 - 1e-9);
        EXPECT_LE(offsets[i] - offsets[i - 1], 2.0 * 2.0);
      }
    }
  }
}

TEST(EvenlySpacedLines, CrossABandOfThinTriangles)
{
  constexpr int Thin = 400;
  constexpr double Width = 1e-4;
  Surface surface = PlaneGrid(Thin + 40, 30);
  for (int i = 0; i < surface.V.rows(); ++i)
  {
    const double column = surface.V(i, 0);
    surface.V(i, 0) =
      std::min(column, 20.0) + Width * std::clamp(column - 20.0, 0.0, 1.0 * Thin) + std::max(column - 20.0 - Thin, 0.0);
  }
  const DrawnField field(surface, 1, [](const Vector3&) { return Cosines(0.3); });
  const LinesOnSurface lines = Draw(field, { 2.0, 0.5, 0.0 });
  ASSERT_GT(lines.NumberOfLines(), 10);
  for (int line = 0; line < lines.NumberOfLines(); ++line)
  {
    for (const int end : { lines.Offsets[line], lines.Offsets[line + 1] - 1 })
    {
      const Vector3 p = lines.Positions[end];
      EXPECT_LT(std::min({ p[0], p[1], 40.0 + Thin * Width - p[0], 30.0 - p[1] }), 1e-9) << "ends at the boundary";
    }
  }
}

TEST(EvenlySpacedLines, RunAlongAllFamiliesOfAField)
{
  for (const int N : { 3, 4, 6, 8 })
  {
    const double angle = 0.2;
    const DrawnField field(IrregularPlane(30, 30, 7), N, [&](const Vector3&) { return Cosines(angle); });
    const LinesOnSurface lines = Draw(field, { 2.0, 0.5, 0.0 });
    std::map<int, double> lengths;
    for (int line = 0; line < lines.NumberOfLines(); ++line)
    {
      const int family = lines.Families[line];
      lengths[family] += lines.Lengths[line];
      const Vector3 normal = Cosines(angle + 2.0 * Pi * family / N + 0.5 * Pi);
      for (int i = lines.Offsets[line]; i < lines.Offsets[line + 1]; ++i)
      {
        EXPECT_NEAR((lines.Positions[i] - lines.Positions[lines.Offsets[line]]).dot(normal), 0.0, 1e-9)
          << "N " << N << ", family " << family;
      }
    }
    ASSERT_EQ(static_cast<int>(lengths.size()), N % 2 == 0 ? N / 2 : N);
    for (const auto& [family, length] : lengths)
    {
      // Lines 2 apart have half the area for their length; they end at the boundary and leave out corners.
      EXPECT_NEAR(length, 450.0, 0.12 * 450.0) << "N " << N << ", family " << family;
    }
  }
}

TEST(EvenlySpacedLines, OfOneFamilyKeepTheirDistance)
{
  const auto waves = [](const Vector3& p)
  { return Cosines(0.8 * std::sin(0.21 * p[0]) + 0.9 * std::cos(0.17 * p[1])); };
  for (const int N : { 1, 4 })
  {
    for (const double ratio : { 0.3, 0.6, 0.9 })
    {
      const DrawnField field(IrregularPlane(40, 40, 3), N, waves);
      const LinesOnSurface lines = Draw(field, { 2.5, ratio, 5.0 });
      EXPECT_GE(LeastDistance(lines), (ratio - 0.021) * 2.5) << "N " << N;
      EXPECT_GT(SumOfLengths(lines), 0.6 * field.Field.NumberOfFamilies() * 1600.0 / 2.5);
      EXPECT_GE(*std::min_element(lines.Lengths.begin(), lines.Lengths.end()), 5.0);
    }
  }
}

TEST(EvenlySpacedLines, KeepTheirDistanceOnFacesThatAreMuchLarger)
{
  const auto waves = [](const Vector3& p) { return Cosines(0.3 * std::sin(p[0]) + 0.2 * p[1]); };
  for (const int N : { 1, 3, 4 })
  {
    const DrawnField field(IrregularPlane(4, 4, 3), N, waves);
    const LinesOnSurface lines = Draw(field, { 0.1, 0.5, 0.2 });
    EXPECT_GE(LeastDistance(lines), (0.5 - 0.021) * 0.1) << "N " << N;
    EXPECT_GT(SumOfLengths(lines), 0.7 * field.Field.NumberOfFamilies() * 16.0 / 0.1);
  }
}

TEST(EvenlySpacedLines, CloseAroundATorus)
{
  const double R = 1.0, r = 0.4;
  // Along the edges that go around, in all faces between two circles across.
  const DrawnField field(Torus(90, 40, R, r), 2,
    [](const Vector3& p)
    {
      const double step = 2.0 * Pi / 90.0;
      const double angle = step * (std::floor(std::atan2(p[1], p[0]) / step) + 0.5);
      return Vector3(-std::sin(angle), std::cos(angle), 0.0);
    });
  const LinesOnSurface lines = Draw(field, { 0.1, 0.6, 0.3 });
  EXPECT_GT(lines.NumberOfLines(), 2.0 * Pi * r / 0.2);
  for (int line = 0; line < lines.NumberOfLines(); ++line)
  {
    EXPECT_TRUE(lines.IsClosed[line]);
    EXPECT_GT(lines.Lengths[line], 0.99 * 2.0 * Pi * (R - r));
    EXPECT_LT(lines.Lengths[line], 1.01 * 2.0 * Pi * (R + r));
    EXPECT_NEAR(lines.Lengths[line], LengthOf(lines, line), 0.01);
  }
}

TEST(EvenlySpacedLines, CloseAroundAPrismUnlessTheyAreHelices)
{
  const auto around = [](const Vector3& p) { return Vector3(-p[1], p[0], 0.0).normalized(); };
  for (const auto& [slope, distance] :
    std::vector<std::pair<double, double>>{ { 0.0, 0.1 }, { 0.0, 0.07 }, { 0.0, 0.05 }, { 0.02, 0.1 }, { 0.3, 0.1 } })
  {
    const DrawnField field(
      Prism(12, 6), 1, [&, rise = slope](const Vector3& p) { return Vector3(around(p) + rise * Vector3::UnitZ()); });
    const double height = field.Mesh.VertexPositions().col(2).maxCoeff();
    const double perimeter = 12.0 * 2.0 * std::sin(Pi / 12.0);
    const LinesOnSurface lines = Draw(field, { distance * height, 0.6, 0.0 });
    ASSERT_GT(lines.NumberOfLines(), slope > 0.1 ? 2 : 5);
    for (int line = 0; line < lines.NumberOfLines(); ++line)
    {
      EXPECT_EQ(lines.IsClosed[line], slope == 0.0);
      if (slope == 0.0)
      {
        EXPECT_NEAR(lines.Lengths[line], perimeter, 1e-9);
      }
    }
  }
}

TEST(EvenlySpacedLines, DoNotWindAroundASpikeForEver)
{
  Surface prism = Prism(12, 6);
  prism.V.col(2) *= 1e6;
  const auto helix = [](const Vector3& p)
  { return Vector3(Vector3(-p[1], p[0], 0.0).normalized() + Vector3::UnitZ()); };
  const DrawnField field(prism, 1, helix);
  const LinesOnSurface lines = Draw(field, { 1e5, 0.5, 0.0 });
  EXPECT_LT(lines.Positions.size(), 100'000u * static_cast<std::size_t>(lines.NumberOfLines() + 1));
}

TEST(EvenlySpacedLines, StayOnTheSurface)
{
  const DrawnField field(Annulus(60, 12), 2, [](const Vector3&) { return Vector3(1.0, 0.3, 0.0); });
  const LinesOnSurface lines = Draw(field, { 0.1, 0.5, 0.0 });
  const double hole = std::cos(Pi / 60.0); // of the polygon inside the unit circle
  for (int line = 0; line < lines.NumberOfLines(); ++line)
  {
    for (int i = lines.Offsets[line] + 1; i < lines.Offsets[line + 1]; ++i)
    {
      for (const Vector3& p : { lines.Positions[i], Vector3(0.5 * (lines.Positions[i] + lines.Positions[i - 1])) })
      {
        EXPECT_GT(p.norm(), hole - 1e-12);
        EXPECT_LT(p.norm(), 2.0 + 1e-12);
      }
    }
  }
  EXPECT_GT(SumOfLengths(lines), 0.85 * 3.0 * Pi / 0.1);
}

TEST(EvenlySpacedLines, OnBothSidesOfAThinPlateDoNotSeeEachOther)
{
  const double distance = 0.1;
  const DrawnField field(Flattened(Icosphere(4), 0.01), 2, [](const Vector3&) { return Vector3(1.0, 0.0, 0.0); });
  const LinesOnSurface lines = Draw(field, { distance, 0.5, 0.2 });
  double above = 0.0, below = 0.0;
  for (int line = 0; line < lines.NumberOfLines(); ++line)
  {
    for (int i = lines.Offsets[line] + 1; i < lines.Offsets[line + 1]; ++i)
    {
      const double length = (lines.Positions[i] - lines.Positions[i - 1]).norm();
      (lines.Positions[i][2] > 0.0 ? above : below) += length;
    }
  }
  EXPECT_GT(above, 0.8 * Pi / distance);
  EXPECT_GT(below, 0.8 * Pi / distance);
}

TEST(EvenlySpacedLines, EndWhereTheFieldDoes)
{
  const DrawnField field(PlaneGrid(20, 10), 1,
    [](const Vector3& p) { return p[0] > 12.0 ? Vector3(0.0, 0.0, 0.0) : Vector3(2.0, 0.0, 0.0); });
  const LinesOnSurface lines = Draw(field, { 1.0, 0.5, 0.0 });
  ASSERT_GT(lines.NumberOfLines(), 5);
  for (std::size_t i = 0; i < lines.Positions.size(); ++i)
  {
    EXPECT_LT(lines.Positions[i][0], 13.0);
    EXPECT_NEAR(lines.Magnitudes[i], 2.0, 1e-15);
  }
}

/// Left and right of the edges x = 1, 2, ... the field leads to them: a line cannot cross, and goes along.
TEST(EvenlySpacedLines, GoAlongEdgesToWhichTheFieldLeads)
{
  const DrawnField field(
    PlaneGrid(2, 30), 1, [](const Vector3& p) { return Vector3(p[0] < 1.0 ? 1.0 : -1.0, 1.0, 0.0); });
  const LinesOnSurface lines = Draw(field, { 0.5, 0.5, 4.0 });
  ASSERT_GE(lines.NumberOfLines(), 1);
  double highest = 0.0;
  for (const Vector3& p : lines.Positions)
  {
    highest = std::max(highest, std::abs(p[0] - 1.0) < 1e-9 ? p[1] : 0.0);
  }
  EXPECT_EQ(highest, 30.0) << "along the edges, through their vertices, to the boundary";
}

TEST(EvenlySpacedLines, AreTheSameForAnyNumberOfThreads)
{
  const Surface surface = IrregularSphere(4, 2);
  const TriangleMesh mesh = surface.Mesh();
  std::vector<LinesOnSurface> drawn;
  for (const int threads : { 1, 2 })
  {
    const TbbContext context(threads);
    const TangentFrames frames = FaceFrames(mesh, context);
    const UnfoldedSurface unfolded(mesh, frames, context);
    Vector<Complex> first(mesh.NumberOfFaces());
    for (int face = 0; face < mesh.NumberOfFaces(); ++face)
    {
      first[face] = frames.ToComplex(face, Vector3(0.3, 1.0, 0.2));
    }
    drawn.push_back(EvenlySpacedLines(unfolded, DirectionsOnFaces(4, first, context), { 0.05, 0.5, 0.1 }, context));
    EXPECT_EQ(context.Progress().back(), 1.0);
    EXPECT_TRUE(std::is_sorted(context.Progress().begin(), context.Progress().end()));
  }
  EXPECT_EQ(drawn[0].Positions, drawn[1].Positions);
  EXPECT_EQ(drawn[0].Offsets, drawn[1].Offsets);
  EXPECT_EQ(drawn[0].Families, drawn[1].Families);
}

TEST(EvenlySpacedLines, OfAnyFieldOnAnySurfaceAreFinite)
{
  std::vector<NamedSurface> surfaces = SmallSurfaces();
  surfaces.push_back({ "zero-area faces", SphereWithZeroAreaFaces(3, 10) });
  surfaces.push_back({ "capsule", CapsuleFromRectangle(16, 12) });
  surfaces.push_back({ "needle", Needle(3, 1000.0) });
  surfaces.push_back({ "thin triangles", PlaneWithThinTriangles(12, 12) });
  for (const NamedSurface& surface : surfaces)
  {
    for (const int N : { 1, 2, 3, 4, 8 })
    {
      SCOPED_TRACE(surface.Name + ", N " + std::to_string(N));
      const DrawnField rough(surface.Shape, N, 17u);
      const DrawnField smooth(surface.Shape, N, [](const Vector3& p) { return Vector3(p[1], 1.0, -p[0]); });
      const Vector3 size =
        (rough.Mesh.VertexPositions().colwise().maxCoeff() - rough.Mesh.VertexPositions().colwise().minCoeff())
          .transpose();
      for (const DrawnField* field : { &rough, &smooth })
      {
        const LinesOnSurface lines = Draw(*field, { 0.02 * size.norm(), 0.5, 0.0 });
        EXPECT_GT(lines.NumberOfLines(), 0);
        EXPECT_EQ(lines.Offsets.back(), static_cast<int>(lines.Positions.size()));
        for (const Vector3& p : lines.Positions)
        {
          ASSERT_TRUE(p.allFinite());
        }
        for (int line = 0; line < lines.NumberOfLines(); ++line)
        {
          EXPECT_GE(lines.Offsets[line + 1] - lines.Offsets[line], 2);
        }
      }
    }
  }
}

// The remedies of the message work.
TEST(EvenlySpacedLines, AreRefusedWhereThereAreTooManyAndFewerOrLargerTrianglesHelp)
{
  const DrawnField fine(PlaneGrid(40, 30), 1, [](const Vector3&) { return Cosines(0.3); });
  const DrawnField coarse(PlaneGrid(8, 6), 1, [](const Vector3&) { return Cosines(0.3); });
  LineOptions options{ 2.0, 0.5, 0.0 };
  options.MostSegments = 500;
  EXPECT_THROW(Draw(fine, options), InvalidInput);
  options.Separation = 10.0;
  EXPECT_GT(Draw(fine, options).NumberOfLines(), 0);
  options.Separation = 0.4; // as many as with 2 on the plane that is five times as wide
  EXPECT_GT(Draw(coarse, options).NumberOfLines(), 10);
}

// An attempt is remembered along its way, and not made again from there.
TEST(EvenlySpacedLines, ThatAreAllTooShortAreTriedOnce)
{
  const DrawnField field(Icosphere(6), 4, [](const Vector3& p) { return Vector3(p[1], 1.0, -p[0]); });
  std::vector<std::size_t> work;
  for (const double minimumLength : { 0.2, 1000.0 })
  {
    const TbbContext context(1);
    const LinesOnSurface lines = Draw(field, { 0.05, 0.5, minimumLength }, context);
    work.push_back(context.Progress().size());
    EXPECT_EQ(lines.NumberOfLines() == 0, minimumLength > 1.0);
  }
  EXPECT_LT(work[1], 8 * work[0]);
}

// Many triangles to each line, and many lines to each triangle.
TEST(EvenlySpacedLines, TellHowFarTheyAreInSmallSteps)
{
  const DrawnField field(Icosphere(6), 4, [](const Vector3& p) { return Vector3(p[1], 1.0, -p[0]); });
  for (const double separation : { 0.5, 0.02 })
  {
    TbbContext context(1);
    Draw(field, { separation, 0.5, 0.0 }, context);
    const std::vector<double>& progress = context.Progress();
    EXPECT_TRUE(std::is_sorted(progress.begin(), progress.end()));
    EXPECT_GE(progress.size(), 100U) << separation; // each of them for at most 512 of 82 thousand triangles
  }
}

TEST(EvenlySpacedLines, CanBeCancelled)
{
  const DrawnField field(Icosphere(5), 4, [](const Vector3& p) { return Vector3(p[1], 1.0, -p[0]); });
  TbbContext context(1);
  context.CancelAfter(2);
  EXPECT_THROW(Draw(field, { 0.01, 0.5, 0.0 }, context), Cancelled);
}

}
