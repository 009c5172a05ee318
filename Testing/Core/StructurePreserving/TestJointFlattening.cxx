#include "StructurePreserving/Decimation/JointFlattening.h"

#include "StructurePreserving/Decimation/CollapsibleMesh.h"
#include "Support/MeshFactory.h"

#include <gtest/gtest.h>

using namespace dmg;
using namespace dmg::test;

namespace
{

double OrientedArea(const std::vector<Complex>& plane, const std::array<int, 3>& t)
{
  return std::imag(std::conj(plane[t[1]] - plane[t[0]]) * (plane[t[2]] - plane[t[0]])) / 2.0;
}

/// Calls visit(ring) for every edge of a mesh that may be collapsed.
template <class Visit>
int VisitRings(const CollapsibleMesh& mesh, Visit visit)
{
  OneRing ring;
  int count = 0;
  for (int h = 0; h < mesh.NumberOfHalfedgeSlots(); ++h)
  {
    if ((mesh.Twin(h) < 0 || h < mesh.Twin(h)) && GatherOneRing(mesh, h, ring))
    {
      visit(ring);
      ++count;
    }
  }
  return count;
}

}

// A planar ring whose new vertex stays in the plane is its own flattening, up to a similarity: every
// triangle then has its true angles.
TEST(JointFlattening, IsASimilarityOnPlanarRings)
{
  const CollapsibleMesh mesh(IrregularPlane(12, 10, 3, 0.2).Mesh());
  JointFlattening flattening;
  int checked = 0;
  VisitRings(mesh,
    [&](const OneRing& ring)
    {
      if (ring.Kind == CollapseKind::AlongBoundary)
      {
        return; // its boundary is pulled straight, which at the corners of the square it is not
      }
      for (int k = 0; k < ring.NumberOfSectors(); ++k)
      {
        const std::array<int, 3> t = ring.SectorAfter(k);
        const Vector3 normal =
          (ring.Positions[t[1]] - ring.Positions[t[0]]).cross(ring.Positions[t[2]] - ring.Positions[t[0]]);
        if (normal[2] <= 0.0)
        {
          return; // the midpoint turns a face over, so no flattening is a similarity
        }
      }
      ASSERT_TRUE(flattening.Flatten(ring, JointFlattening::Method::Conformal));
      ++checked;
      for (int k = 0; k < ring.NumberOfSectors(); ++k)
      {
        for (const std::array<int, 3>& t : { ring.SectorBefore(k), ring.SectorAfter(k) })
        {
          for (int c = 0; c < 3; ++c)
          {
            const int a = t[c];
            const int b = t[(c + 1) % 3];
            EXPECT_NEAR(std::abs(flattening.Plane()[a] - flattening.Plane()[b]),
              (ring.Positions[a] - ring.Positions[b]).norm(), 1e-11); // the edge keeps its length
          }
        }
      }
    });
  EXPECT_GT(checked, 200);
}

// Both fill the same polygon exactly if their areas agree, given that no face is turned over.
TEST(JointFlattening, FillsOnePolygonBeforeAndAfter)
{
  for (const Surface& surface :
    { IrregularSphere(3, 5), IrregularTorus(30, 12, 6), IrregularPlane(16, 12, 7), Disk(8) })
  {
    const CollapsibleMesh mesh(surface.Mesh());
    JointFlattening flattening;
    int flattened = 0;
    const int rings = VisitRings(mesh,
      [&](const OneRing& ring)
      {
        for (auto method : { JointFlattening::Method::Conformal, JointFlattening::Method::ConvexPolygon })
        {
          if (!flattening.Flatten(ring, method))
          {
            EXPECT_NE(method, JointFlattening::Method::ConvexPolygon);
            continue;
          }
          ++flattened;
          double before = 0.0;
          double after = 0.0;
          for (int k = 0; k < ring.NumberOfSectors(); ++k)
          {
            EXPECT_GT(OrientedArea(flattening.Plane(), ring.SectorBefore(k)), 0.0);
            EXPECT_GT(OrientedArea(flattening.Plane(), ring.SectorAfter(k)), 0.0);
            before += OrientedArea(flattening.Plane(), ring.SectorBefore(k));
            after += OrientedArea(flattening.Plane(), ring.SectorAfter(k));
          }
          for (int d = 0; d < ring.NumberOfDead; ++d)
          {
            before += OrientedArea(flattening.Plane(), ring.Dead[d].Corners);
          }
          EXPECT_NEAR(before, after, 1e-12 * before);
        }
      });
    EXPECT_GT(rings, 100);
    EXPECT_GT(flattened, 1.9 * rings); // the conformal map hardly ever folds
  }
}

TEST(CollapsibleMesh, KeepsTheLinkCondition)
{
  // No edge of a tetrahedron may be collapsed, and none of an octahedron makes more than two faces
  // vanish.
  Surface tetrahedron;
  tetrahedron.V.resize(4, 3);
  tetrahedron.V << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, 0, 1;
  tetrahedron.F.resize(4, 3);
  tetrahedron.F << 0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3;
  EXPECT_EQ(VisitRings(CollapsibleMesh(tetrahedron.Mesh()), [](const OneRing&) {}), 0);

  // A torus of 3 x 3 points is all triangles without faces inside: collapsing would pinch it.
  EXPECT_EQ(VisitRings(CollapsibleMesh(Torus(3, 3).Mesh()), [](const OneRing&) {}), 0);

  EXPECT_EQ(VisitRings(CollapsibleMesh(Icosphere(0).Mesh()),
              [](const OneRing& ring)
              {
                EXPECT_EQ(ring.LoopSize(), 6); // 5 + 5 neighbours, less each other and the two shared
                EXPECT_EQ(ring.NumberOfDead, 2);
              }),
    30);
}
