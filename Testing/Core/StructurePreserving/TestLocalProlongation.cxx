#include "Derivatives.h"
#include "StructurePreserving/Decimation/EdgeCollapse.h"
#include "StructurePreserving/Decimation/MeshHierarchy.h"
#include "StructurePreserving/Overlay/LocalProlongation.h"
#include "StructurePreserving/Overlay/OverlayProlongation.h"
#include "StructurePreserving/Transfers/FineEdgePaths.h"
#include "StructurePreserving/Transfers/ScalarProlongation.h"
#include "Support/Identities.h"
#include "Support/MeshFactory.h"
#include "Support/Random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>

using namespace dmg;
using namespace dmg::test;

namespace
{

/// Calls visit(transition) for single collapses of edges all over the mesh, each from the mesh as
/// it was, by the conformal flattening or into the circle.
template <class Visit>
void VisitSingleCollapses(const TriangleMesh& mesh, Visit visit)
{
  constexpr int step = 7;
  const CollapsibleMesh start(mesh);
  for (int h = 0; h < 3 * mesh.NumberOfFaces(); h += step)
  {
    CollapsibleMesh shrinking = start;
    SurfaceTracking tracking(mesh);
    EdgeCollapse collapse(shrinking, tracking);
    const auto done = collapse.Try(h, CollapseLimits::Step(h % 3));
    if (done)
    {
      shrinking.FinishCollapse(*done);
      const std::vector<CollapseRecord> collapses = { collapse.Record() };
      const CollapsibleMesh::Compacted coarse = shrinking.Compact();
      visit(LevelTransition{ mesh, coarse.Mesh, tracking, coarse.VertexNumber, coarse.FaceNumber, &collapses });
    }
  }
}

std::vector<TriangleMesh> SmallMeshes()
{
  return { IrregularSphere(2, 7).Mesh(), IrregularTorus(16, 8, 3).Mesh(), DoubleTorus(3).Mesh(),
    IrregularPlane(10, 8, 5).Mesh(), Disk(5).Mesh(), PlaneGrid(8, 6).Mesh() };
}

OverlayProlongation Overlay(const LevelTransition& transition)
{
  return OverlayProlongation(transition, FaceFrames(transition.Fine), FaceFrames(transition.Coarse), SerialContext());
}

/// S1 from the tracked paths.
SparseMatrix<double> TrackedOneForms(const LevelTransition& transition)
{
  const FineEdgePaths paths(transition);
  const TriangleMesh& fine = transition.Fine;
  const TriangleMesh& coarse = transition.Coarse;
  std::vector<Eigen::Triplet<double>> triplets;
  for (int e = 0; e < fine.NumberOfEdges(); ++e)
  {
    const int halfedge = fine.HalfedgeOf(e);
    paths.VisitPieces(halfedge,
      [&](int face, const std::array<double, 3>& from, const std::array<double, 3>& to)
      {
        for (int j = 0; j < 3; ++j)
        {
          const int k = (j + 1) % 3;
          const int h = 3 * face + j;
          triplets.emplace_back(
            e, coarse.EdgeOf(h), fine.EdgeSign(halfedge) * coarse.EdgeSign(h) * (from[j] * to[k] - from[k] * to[j]));
        }
      });
  }
  return FromTriplets(fine.NumberOfEdges(), coarse.NumberOfEdges(), triplets);
}

using Polygon = std::vector<Complex>;

double Cross(Complex a, Complex b)
{
  return a.real() * b.imag() - a.imag() * b.real();
}

double AreaOf(const Polygon& polygon)
{
  double area = 0.0;
  for (std::size_t i = 0; i < polygon.size(); ++i)
  {
    area += 0.5 * Cross(polygon[i], polygon[(i + 1) % polygon.size()]);
  }
  return area;
}

/// The part of a convex polygon inside a counter-clockwise triangle. Sutherland and Hodgman 1974.
Polygon ClippedTo(Polygon polygon, const Polygon& triangle)
{
  for (int side = 0; side < 3; ++side)
  {
    const Complex start = triangle[side];
    const Complex along = triangle[(side + 1) % 3] - start;
    Polygon clipped;
    for (std::size_t i = 0; i < polygon.size(); ++i)
    {
      const Complex a = polygon[i];
      const Complex b = polygon[(i + 1) % polygon.size()];
      const double atA = Cross(along, a - start);
      const double atB = Cross(along, b - start);
      if (atA >= 0.0)
      {
        clipped.push_back(a);
      }
      if (atA * atB < 0.0)
      {
        clipped.push_back(a + atA / (atA - atB) * (b - a));
      }
    }
    polygon = clipped;
  }
  return polygon;
}

/// S2, #F x #F: the share of the coarse face that the fine face covers in the plane of the
/// collapse.
SparseMatrix<double> OverlapShares(const LevelTransition& transition)
{
  const CollapseRecord& collapse = transition.Collapses->front();
  const OneRing& ring = collapse.Ring;
  const auto triangle = [&](const std::array<int, 3>& corners) {
    return Polygon{ collapse.Plane[corners[0]], collapse.Plane[corners[1]], collapse.Plane[corners[2]] };
  };
  std::map<int, Polygon> fine;
  for (int k = 0; k < ring.NumberOfSectors(); ++k)
  {
    fine[ring.Sectors[k].Face] = triangle(ring.SectorBefore(k));
  }
  for (int d = 0; d < ring.NumberOfDead; ++d)
  {
    fine[ring.Dead[d].Face] = triangle(ring.Dead[d].Corners);
  }
  std::vector<Eigen::Triplet<double>> triplets;
  for (const auto& [face, polygon] : fine)
  {
    for (int k = 0; k < ring.NumberOfSectors(); ++k)
    {
      const Polygon sector = triangle(ring.SectorAfter(k));
      triplets.emplace_back(
        face, transition.CoarseFace[ring.Sectors[k].Face], AreaOf(ClippedTo(polygon, sector)) / AreaOf(sector));
    }
  }
  for (int face = 0; face < transition.Fine.NumberOfFaces(); ++face)
  {
    if (fine.count(face) == 0)
    {
      triplets.emplace_back(face, transition.CoarseFace[face], 1.0);
    }
  }
  return FromTriplets(transition.Fine.NumberOfFaces(), transition.Coarse.NumberOfFaces(), triplets);
}

/// Applies local rows to values by slot.
Vector<double> Applied(const std::vector<LocalRow<double>>& rows, const Vector<double>& after)
{
  Vector<double> before = after;
  for (const LocalRow<double>& row : rows)
  {
    before[row.Before] = 0.0;
    for (const auto& [slot, coefficient] : row.Entries)
    {
      before[row.Before] += coefficient * after[slot];
    }
  }
  return before;
}

}

// For one collapse, the tracked operators are the exact ones: a point lies where it lies, and a
// path is straight in the one plane that there is.
TEST(LocalProlongation, EqualsTheTrackedOperatorsEntryByEntry)
{
  std::map<CollapseKind, int> kinds;
  for (const TriangleMesh& mesh : SmallMeshes())
  {
    VisitSingleCollapses(mesh,
      [&](const LevelTransition& transition)
      {
        ++kinds[transition.Collapses->front().Ring.Kind];
        const OverlayProlongation exact = Overlay(transition);
        EXPECT_LT(LargestDifference(exact.S0, ScalarProlongation(transition, SerialContext())), 1e-12);
        EXPECT_LT(LargestDifference(exact.S1, TrackedOneForms(transition)), 1e-12);
      });
  }
  EXPECT_GT(kinds[CollapseKind::Interior], 100);
  EXPECT_GT(kinds[CollapseKind::OntoBoundary], 10);
  EXPECT_GT(kinds[CollapseKind::AlongBoundary], 5);
}

// d1 S1 = S2 d1: the curl of a fine face is that of the coarse faces over the overlaps, here
// measured by clipping triangles. This knows nothing of edges and their pieces.
TEST(LocalProlongation, BringsTheCurlOfTheOverlaps)
{
  for (const TriangleMesh& mesh : SmallMeshes())
  {
    const SparseMatrix<double> fineCurl = SumsAroundFaces(mesh);
    VisitSingleCollapses(mesh,
      [&](const LevelTransition& transition)
      {
        const SparseMatrix<double> S1 = Overlay(transition).S1;
        const SparseMatrix<double> S2 = OverlapShares(transition);
        const SparseMatrix<double> curl = fineCurl * S1;
        const SparseMatrix<double> expected = S2 * SumsAroundFaces(transition.Coarse);
        EXPECT_LT(LargestDifference(curl, expected), 1e-12);
      });
  }
}

// Zero-sum in, zero-sum out; the sides of the polygon keep their values (Q_B); and a form of
// gradients, equal on both sides of each edge, comes back as S1 brings it, since Q has nothing to
// do.
TEST(LocalProlongation, KeepsHalfedgeFormsAtZeroSum)
{
  Random random(23);
  for (const TriangleMesh& mesh : SmallMeshes())
  {
    VisitSingleCollapses(mesh,
      [&](const LevelTransition& transition)
      {
        const OneRing& ring = transition.Collapses->front().Ring;
        const LocalProlongation local(transition.Collapses->front());

        Vector<double> after = Vector<double>::Zero(3 * mesh.NumberOfFaces());
        for (const OneRing::Sector& sector : ring.Sectors)
        {
          const double a = random.Uniform(-1.0, 1.0);
          const double b = random.Uniform(-1.0, 1.0);
          after[3 * sector.Face] = a;
          after[3 * sector.Face + 1] = b;
          after[3 * sector.Face + 2] = -a - b;
        }
        const Vector<double> before = Applied(local.ZeroSumHalfedges, after);
        for (int f = 0; f < mesh.NumberOfFaces(); ++f)
        {
          EXPECT_NEAR(before.segment<3>(3 * f).sum(), 0.0, 1e-13);
        }
        for (const OneRing::Sector& sector : ring.Sectors)
        {
          EXPECT_EQ(before[sector.OuterHalfedge()], after[sector.OuterHalfedge()]);
        }
        if (ring.Kind == CollapseKind::OntoBoundary)
        {
          EXPECT_EQ(before[ring.Dead[0].BorderHalfedge], after[ring.Sectors.front().LeavingSpoke()]);
          EXPECT_EQ(before[ring.Dead[1].BorderHalfedge], after[ring.Sectors.back().ReturningSpoke()]);
        }

        std::vector<double> u(ring.NumberOfVertices());
        std::generate(u.begin(), u.end(), [&] { return random.Uniform(-1.0, 1.0); });
        for (int k = 0; k < ring.NumberOfSectors(); ++k)
        {
          const OneRing::Sector& sector = ring.Sectors[k];
          const std::array<int, 3> corners = ring.SectorAfter(k);
          after[sector.LeavingSpoke()] = u[corners[1]] - u[corners[0]];
          after[sector.OuterHalfedge()] = u[corners[2]] - u[corners[1]];
          after[sector.ReturningSpoke()] = u[corners[0]] - u[corners[2]];
        }
        EXPECT_LT(
          (Applied(local.ZeroSumHalfedges, after) - Applied(local.Halfedges, after)).cwiseAbs().maxCoeff(), 1e-13);
      });
  }
}

// What the tracked SX does otherwise, already for one collapse: it fits each fine face to all three
// of its sides (Q_I), the thesis's keeps the side at the polygon and fits the other two (Q_B). So
// they agree on the faces that have no such side, the dead ones of collapses inside, and at
// gradients.
TEST(LocalProlongation, ProjectsFacesAtThePolygonOtherThanAllAtOnce)
{
  const TriangleMesh mesh = IrregularSphere(2, 7).Mesh();
  double largestAtPolygon = 0.0;
  VisitSingleCollapses(mesh,
    [&](const LevelTransition& transition)
    {
      const CollapseRecord& collapse = transition.Collapses->front();
      const LocalProlongation local(collapse);
      std::map<int, std::map<int, double>> rows;
      for (const LocalRow<double>& row : local.Halfedges)
      {
        rows[row.Before] = { row.Entries.begin(), row.Entries.end() };
      }
      std::map<int, std::map<int, double>> zeroSum;
      for (const LocalRow<double>& row : local.ZeroSumHalfedges)
      {
        zeroSum[row.Before] = { row.Entries.begin(), row.Entries.end() };
      }
      const auto differenceFromMean = [&](int face)
      {
        double largest = 0.0;
        for (const OneRing::Sector& sector : collapse.Ring.Sectors)
        {
          for (int column = 3 * sector.Face; column < 3 * sector.Face + 3; ++column)
          {
            double sum = 0.0;
            for (int k = 0; k < 3; ++k)
            {
              sum += rows[3 * face + k][column];
            }
            for (int k = 0; k < 3; ++k)
            {
              largest =
                std::max(largest, std::abs(rows[3 * face + k][column] - sum / 3.0 - zeroSum[3 * face + k][column]));
            }
          }
        }
        return largest;
      };
      EXPECT_LT(differenceFromMean(collapse.Ring.Dead[0].Face), 1e-13);
      EXPECT_LT(differenceFromMean(collapse.Ring.Dead[1].Face), 1e-13);
      for (const OneRing::Sector& sector : collapse.Ring.Sectors)
      {
        largestAtPolygon = std::max(largestAtPolygon, differenceFromMean(sector.Face));
      }
    });
  EXPECT_GT(largestAtPolygon, 0.01);
}
