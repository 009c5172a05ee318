#ifndef dmgTestMeshFactory_h
#define dmgTestMeshFactory_h

#include "Mesh/TriangleMesh.h"
#include "Support/Types.h"

#include <vector>

/// Small surfaces of known shape and topology, and families of them for scale.
namespace dmg::test
{

/// Points and triangles before any check, so that tests can break them.
struct Surface
{
  Points V;
  Triangles F;

  TriangleMesh Mesh() const { return TriangleMesh(this->V, this->F); }
};

// Planar ------------------------------------------------------------------------------------------

/// [0, columns] x [0, rows] in the plane z = 0 in unit squares, each cut along its rising diagonal;
/// 2 columns rows faces.
Surface PlaneGrid(int columns, int rows);

/// The same outline, with inner points moved by up to \p amount (below 0.3 no face turns over) and
/// diagonals chosen at random.
Surface IrregularPlane(int columns, int rows, unsigned seed, double amount = 0.25);

/// The same with a band of thin triangles: of the points, those from x = columns / 2 to 1 beyond are moved together to a
/// hundredth of that width.
Surface PlaneWithThinTriangles(int columns, int rows);

/// A strip of right triangles, one high, two per column of a given width: column i has faces 2 i and 2 i + 1.
Surface Strip(const std::vector<double>& widths);

/// Unit disc: a centre and \p rings rings of 6, 12, 18 ... points; 6 rings^2 faces.
Surface Disk(int rings);

/// Ring between radii 1 and 2, 2 around rings faces; two boundary loops.
Surface Annulus(int around, int rings);

// Curved ------------------------------------------------------------------------------------------

/// Unit sphere: the icosahedron, cut 1:4 \p subdivisions times; 20 4^subdivisions faces.
Surface Icosphere(int subdivisions);

/// Points moved along the unit sphere by up to \p amount of the edge length (0.3 is safe).
Surface IrregularSphere(int subdivisions, unsigned seed, double amount = 0.25);

/// Torus around the z-axis; \p around points along the circle of radius \p major, \p across along
/// the one of radius \p minor; 2 around across faces. At least 3 of each.
Surface Torus(int around, int across, double major = 1.0, double minor = 0.4);

/// The same torus with points moved along it at random and diagonals chosen at random.
Surface IrregularTorus(int around, int across, unsigned seed, double major = 1.0, double minor = 0.4);

/// Closed surface of genus columns x rows, a slab with so many holes, rounded. Holes, and what is between
/// them, are cubes of side 1.
Surface PerforatedSlab(int columns, int rows, int resolution);

/// That with two holes; 112 resolution^2 faces or so.
Surface DoubleTorus(int resolution);

// Intrinsically flat, though not in a plane -------------------------------------------------------

/// The side of a prism over a regular polygon with \p around corners: an open cylinder, flat
/// inside.
Surface Prism(int around, int along);

/// A flat torus in space, the diplotorus of Brehm: two twisted tubes of 2n congruent triangles
/// each, one inside the other, between the same two regular n-gons. A tube unrolls into a straight
/// strip, so the angles at every vertex sum to pi in either tube and to 2 pi in all; and the strips
/// are glued by translations, so a parallel field closes up. Each triangle is then cut 1:4 in its
/// plane \p subdivisions times; 4 n 4^subdivisions faces.
Surface FlatTorus(int n, int subdivisions);

// Difficult or broken -----------------------------------------------------------------------------

/// A sphere with \p count edges cut on one side only, which leaves a triangle with three corners on
/// a line, and \p count points doubled, which leaves two triangles with a side of no length each.
/// Room for about one of either kind per 40 faces; at least 2 subdivisions.
Surface SphereWithZeroAreaFaces(int subdivisions, int count);

/// A sphere drawn out by \p ratio along z: slivers.
Surface Needle(int subdivisions, double ratio);

/// A capsule as modelling programs write it: a rectangle of \p around by \p along quadrilaterals,
/// rolled up. The seam is not closed, though its points coincide, and each end is a side of the
/// rectangle drawn together into a point: 2 around along faces, 2 around of them without area.
Surface CapsuleFromRectangle(int around, int along);

/// A strip of 2 \p around triangles with a half twist. Not orientable.
Surface MoebiusStrip(int around);

/// Two tetrahedra that share one corner, vertex 0.
Surface PinchedTetrahedra();

// From others -------------------------------------------------------------------------------------

/// Both, as separate components; \p b moved by \p offset.
Surface Union(const Surface& a, const Surface& b, const Vector3& offset);

/// Its z times \p factor: two sheets near each other, of a slab or of anything that is closed.
Surface Flattened(const Surface& surface, double factor);

/// Each triangle into four; new points are midpoints.
Surface Subdivide(const Surface& surface);

/// Each triangle into four; by Loop's rule, whose surfaces become smooth (CGAL). \pre manifold.
Surface SubdivideByLoop(const Surface& surface);

/// Vertices and faces numbered in a random order, the first corner of each face chosen at random.
struct Relabelled
{
  Surface Result;
  std::vector<int> NewVertices; ///< old -> new
  std::vector<int> NewFaces;    ///< old -> new
};
Relabelled Relabel(const Surface& surface, unsigned seed);

/// Rotated about an axis in general position and scaled; \p rotation receives the rotation.
Surface RotatedAndScaled(const Surface& surface, double angle, double scale, Eigen::Matrix3d* rotation = nullptr);

}

#endif
