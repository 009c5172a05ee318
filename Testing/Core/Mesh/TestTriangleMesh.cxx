#include "Mesh/TriangleMesh.h"

#include "Support/Errors.h"
#include "Support/MeshFactory.h"
#include "Support/TbbContext.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <map>
#include <set>
#include <utility>

namespace
{

using namespace dmg;
using namespace dmg::test;

struct Sample
{
  const char* Name;
  Surface Shape;
  int Faces;
  int EulerCharacteristic;
  int BoundaryLoops;
  int Components;
};

std::vector<Sample> Samples()
{
  return {
    { "plane", PlaneGrid(4, 3), 24, 1, 1, 1 },
    { "irregular plane", IrregularPlane(5, 4, 1), 40, 1, 1, 1 },
    { "disk", Disk(3), 54, 1, 1, 1 },
    { "annulus", Annulus(7, 2), 28, 0, 2, 1 },
    { "sphere", Icosphere(2), 320, 2, 0, 1 },
    { "irregular sphere", IrregularSphere(2, 5), 320, 2, 0, 1 },
    { "torus", Torus(8, 5), 80, 0, 0, 1 },
    { "smallest torus", Torus(3, 3), 18, 0, 0, 1 },
    { "irregular torus", IrregularTorus(9, 6, 3), 108, 0, 0, 1 },
    { "double torus", DoubleTorus(2), -1, -2, 0, 1 },
    { "prism", Prism(6, 3), 36, 0, 2, 1 },
    { "flat torus", FlatTorus(12, 1), 192, 0, 0, 1 },
    { "zero-area faces", SphereWithZeroAreaFaces(3, 8), 1280 + 2 * 8 + 2 * 8, 2, 0, 1 },
    { "two components", Union(Icosphere(0), Torus(4, 4), Vector3(5.0, 0.0, 0.0)), 20 + 32, 2, 0, 2 },
  };
}

/// Boundary loops, by walking them.
int CountBoundaryLoops(const TriangleMesh& mesh)
{
  std::set<int> left;
  for (int v = 0; v < mesh.NumberOfVertices(); ++v)
  {
    if (mesh.IsBoundaryVertex(v))
    {
      left.insert(v);
    }
  }
  int loops = 0;
  while (!left.empty())
  {
    ++loops;
    const int first = *left.begin();
    int v = first;
    do
    {
      left.erase(v);
      v = mesh.Head(mesh.OutgoingHalfedge(v));
    } while (v != first);
  }
  return loops;
}

TEST(TriangleMesh, HasTheTopologyOfItsShape)
{
  for (const Sample& sample : Samples())
  {
    SCOPED_TRACE(sample.Name);
    const TriangleMesh mesh = sample.Shape.Mesh();
    if (sample.Faces >= 0)
    {
      EXPECT_EQ(mesh.NumberOfFaces(), sample.Faces);
    }
    EXPECT_EQ(mesh.EulerCharacteristic(), sample.EulerCharacteristic);
    EXPECT_EQ(CountBoundaryLoops(mesh), sample.BoundaryLoops);
    const std::vector<int> components = FaceComponents(mesh);
    EXPECT_EQ(*std::max_element(components.begin(), components.end()) + 1, sample.Components);
    EXPECT_EQ(components.front(), 0);
  }
}

TEST(TriangleMesh, ConnectivityAgreesWithAMapOfSides)
{
  for (const Sample& sample : Samples())
  {
    SCOPED_TRACE(sample.Name);
    const TriangleMesh mesh = sample.Shape.Mesh();
    std::map<std::pair<int, int>, int> halfedges;
    std::set<std::pair<int, int>> edges;
    for (int h = 0; h < 3 * mesh.NumberOfFaces(); ++h)
    {
      const int tail = sample.Shape.F(h / 3, h % 3);
      const int head = sample.Shape.F(h / 3, (h + 1) % 3);
      EXPECT_EQ(mesh.Tail(h), tail);
      EXPECT_EQ(mesh.Head(h), head);
      halfedges[{ tail, head }] = h;
      edges.insert(std::minmax(tail, head));
    }
    ASSERT_EQ(mesh.NumberOfEdges(), static_cast<int>(edges.size()));

    int number = 0;
    for (const auto& [smaller, larger] : edges) // ascending, as edges are numbered
    {
      EXPECT_EQ(mesh.EdgeVertices(number)[0], smaller);
      EXPECT_EQ(mesh.EdgeVertices(number)[1], larger);
      const auto along = halfedges.find({ smaller, larger });
      const auto against = halfedges.find({ larger, smaller });
      const int forward = along == halfedges.end() ? -1 : along->second;
      const int backward = against == halfedges.end() ? -1 : against->second;
      EXPECT_EQ(mesh.HalfedgeOf(number), forward >= 0 ? forward : backward);
      if (forward >= 0)
      {
        EXPECT_EQ(mesh.EdgeOf(forward), number);
        EXPECT_EQ(mesh.EdgeSign(forward), 1);
        EXPECT_EQ(mesh.Twin(forward), backward);
      }
      if (backward >= 0)
      {
        EXPECT_EQ(mesh.EdgeOf(backward), number);
        EXPECT_EQ(mesh.EdgeSign(backward), -1);
        EXPECT_EQ(mesh.Twin(backward), forward);
      }
      ++number;
    }
  }
}

TEST(TriangleMesh, FansVisitEveryCornerOnceFromTheBoundary)
{
  for (const Sample& sample : Samples())
  {
    SCOPED_TRACE(sample.Name);
    const TriangleMesh mesh = sample.Shape.Mesh();
    std::vector<int> visits(3 * mesh.NumberOfFaces(), 0);
    for (int v = 0; v < mesh.NumberOfVertices(); ++v)
    {
      const int first = mesh.OutgoingHalfedge(v);
      int h = first;
      do
      {
        ASSERT_EQ(mesh.Tail(h), v);
        ++visits[h];
        h = mesh.Twin(TriangleMesh::Previous(h));
      } while (h >= 0 && h != first);
      EXPECT_EQ(h < 0, mesh.IsBoundaryVertex(v));
    }
    EXPECT_EQ(std::count(visits.begin(), visits.end(), 1), 3 * mesh.NumberOfFaces());
  }
}

TEST(TriangleMesh, IsTheSameForAnyNumberOfThreads)
{
  const Surface shape = Relabel(IrregularSphere(5, 2), 3).Result; // 20480 faces, some grains
  const TriangleMesh mesh = shape.Mesh();
  for (const int threads : { 2, 5 })
  {
    const TriangleMesh other(shape.V, shape.F, {}, TbbContext(threads));
    ASSERT_EQ(other.NumberOfEdges(), mesh.NumberOfEdges());
    for (int h = 0; h < 3 * mesh.NumberOfFaces(); ++h)
    {
      ASSERT_EQ(other.Twin(h), mesh.Twin(h));
      ASSERT_EQ(other.EdgeOf(h), mesh.EdgeOf(h));
    }
    for (int edge = 0; edge < mesh.NumberOfEdges(); ++edge)
    {
      ASSERT_EQ(other.HalfedgeOf(edge), mesh.HalfedgeOf(edge));
    }
    for (int v = 0; v < mesh.NumberOfVertices(); ++v)
    {
      ASSERT_EQ(other.OutgoingHalfedge(v), mesh.OutgoingHalfedge(v));
    }
  }
}

TEST(TriangleMesh, SamplesAreOrientedOutwards)
{
  for (const Sample& sample : Samples())
  {
    SCOPED_TRACE(sample.Name);
    const TriangleMesh mesh = sample.Shape.Mesh();
    double volume = 0.0; // six times the one enclosed, by the divergence theorem
    for (int f = 0; f < mesh.NumberOfFaces(); ++f)
    {
      volume += mesh.FaceAreaVector(f).dot(mesh.Position(mesh.Tail(3 * f)));
      if (sample.BoundaryLoops > 0 && std::string(sample.Name) != "prism")
      {
        EXPECT_GT(mesh.FaceAreaVector(f).z(), 0.0);
      }
    }
    if (sample.BoundaryLoops == 0)
    {
      EXPECT_GT(volume, 0.1);
    }
  }
}

TEST(TriangleMesh, AreasAddUp)
{
  EXPECT_NEAR(IrregularPlane(7, 5, 2).Mesh().FaceAreas().sum(), 35.0, 1e-13 * 35.0);
  const TriangleMesh triangle =
    Surface{ (Points(3, 3) << 0, 0, 0, 2, 0, 0, 0, 3, 0).finished(), Triangles{ { 0, 1, 2 } } }.Mesh();
  EXPECT_EQ(triangle.FaceAreaVector(0), Vector3(0.0, 0.0, 6.0)); // twice the area, upwards
  EXPECT_EQ(triangle.FaceArea(0), 3.0);
}

// Refusals: each names the element, by the caller's number, and the remedy ------------------------

void ExpectRefusal(const Surface& surface, const std::vector<std::string>& words, const ElementNames& names = {},
  const ExecutionContext& context = SerialContext())
{
  try
  {
    const TriangleMesh mesh(surface.V, surface.F, names, context);
    FAIL() << "accepted; expected a refusal with \"" << words.front() << '"';
  }
  catch (const InvalidInput& error)
  {
    const std::string message = error.what();
    for (const std::string& word : words)
    {
      EXPECT_NE(message.find(word), std::string::npos) << message << "\nlacks \"" << word << '"';
    }
  }
}

TEST(MeshChecks, RefuseAnEmptySurface)
{
  ExpectRefusal({ Points(0, 3), Triangles(0, 3) }, { "no triangles", "give it triangles" });
}

TEST(MeshChecks, RefuseACornerOutOfRange)
{
  Surface surface = PlaneGrid(2, 2);
  surface.F(5, 1) = 9;
  ExpectRefusal(surface, { "cell 5", "9", "remove" });
  surface.F(5, 1) = -1;
  ExpectRefusal(surface, { "cell 5", "-1" });
}

TEST(MeshChecks, RefuseARepeatedCorner)
{
  for (int k = 0; k < 3; ++k)
  {
    Surface surface = PlaneGrid(2, 2);
    surface.F(3, k) = surface.F(3, (k + 1) % 3);
    ExpectRefusal(surface, { "cell 3", "point " + std::to_string(surface.F(3, k)) + " twice", "leave the face out" });
  }
}

TEST(MeshChecks, RefuseAPointThatIsNotFinite)
{
  Surface surface = PlaneGrid(2, 2);
  surface.V(4, 2) = std::numeric_limits<double>::quiet_NaN();
  ExpectRefusal(surface, { "point 4", "not finite" });
  surface.V(4, 2) = std::numeric_limits<double>::infinity();
  ExpectRefusal(surface, { "point 4", "not finite" });
}

TEST(MeshChecks, RefuseAFaceInOnePlace)
{
  Surface surface = PlaneGrid(2, 2);
  for (int k = 1; k < 3; ++k)
  {
    surface.V.row(surface.F(6, k)) = surface.V.row(surface.F(6, 0));
  }
  ExpectRefusal(surface, { "cell 6", "one place", "leave out the face" });
}

TEST(MeshChecks, RefuseCoordinatesThatAreTooLargeOrTooSmallToComputeWith)
{
  Surface surface = PlaneGrid(2, 2);
  surface.V *= 1e-45;
  ExpectRefusal(surface, { "surface", "1e-40", "scale it up" });
  surface.V *= 1e90;
  ExpectRefusal(surface, { "point 1", "1e40", "scale the whole surface down" });
  surface = PlaneGrid(2, 2);
  for (int k = 0; k < 3; ++k)
  {
    surface.V.row(surface.F(6, k)) << k * 1e-70, 0.0, 0.0;
  }
  ExpectRefusal(surface, { "cell 6", "one place", "tiny face" });
}

TEST(MeshChecks, RefuseAnUnusedPoint)
{
  Surface surface = PlaneGrid(2, 2);
  surface.V.conservativeResize(10, 3);
  surface.V.row(9).setZero();
  ExpectRefusal(surface, { "point 9", "no triangle", "leave out unused points" });
}

TEST(TriangleMesh, RefusesAnEdgeWithThreeFaces)
{
  Surface surface{ Points(5, 3), Triangles(3, 3) };
  surface.V << 0, 0, 0, 1, 0, 0, 0, 1, 0, 0, -1, 0, 0, 0, 1;
  surface.F << 0, 1, 2, 1, 0, 3, 0, 1, 4;
  ExpectRefusal(surface, { "point 0 and point 1", "3 triangles", "cell 0", "cell 1", "cell 2", "PrepareSurface" });
}

TEST(TriangleMesh, RefusesFacesThatAreOrientedAgainstEachOther)
{
  Surface surface = PlaneGrid(1, 1);
  surface.F.row(1).reverseInPlace();
  ExpectRefusal(surface, { "cell 0 and cell 1", "point 0 and point 3", "turn one of them", "PrepareSurface" });
}

TEST(TriangleMesh, RefusesAMoebiusStrip)
{
  ExpectRefusal(MoebiusStrip(9), { "oriented against each other" });
}

TEST(TriangleMesh, RefusesDuplicateFaces)
{
  Surface surface = PlaneGrid(2, 2);
  surface.F.conservativeResize(9, 3);
  surface.F.row(8) << surface.F(2, 1), surface.F(2, 2), surface.F(2, 0);
  ExpectRefusal(surface, { "cell 2 and cell 8", "same triangle", "remove one of them" });
  surface.F.row(8).reverseInPlace();
  ExpectRefusal(surface, { "cell 2 and cell 8", "same triangle" });
}

TEST(TriangleMesh, RefusesAPinchedVertex)
{
  ExpectRefusal(PinchedTetrahedra(), { "point 0", "more than one fan", "PrepareSurface" });

  // Two open fans: two triangles that share a corner.
  Surface bow{ Points(5, 3), Triangles(2, 3) };
  bow.V << 0, 0, 0, 1, -1, 0, 1, 1, 0, -1, 1, 0, -1, -1, 0;
  bow.F << 0, 1, 2, 0, 3, 4;
  ExpectRefusal(bow, { "point 0", "more than one fan" });
}

TEST(TriangleMesh, RefusalsNameTheFirstElementForAnyNumberOfThreads)
{
  Surface turned = Icosphere(5);
  for (const int face : { 20000, 11000, 300 })
  {
    turned.F.row(face).reverseInPlace();
  }
  const TriangleMesh whole = Icosphere(5).Mesh();
  int first = whole.NumberOfEdges(); // the smallest edge of a turned face
  for (const int face : { 20000, 11000, 300 })
  {
    for (int k = 0; k < 3; ++k)
    {
      first = std::min(first, whole.EdgeOf(3 * face + k));
    }
  }
  const auto [a, b] = whole.EdgeVertices(first);
  const std::string edge = "point " + std::to_string(a) + " and point " + std::to_string(b);

  Surface pinched = Union(Icosphere(5), Icosphere(5), Vector3(3.0, 0.0, 0.0));
  for (const int v : { 10200, 9000, 4500 }) // drawn to the other component's
  {
    const int other = v + static_cast<int>(pinched.V.rows()) / 2;
    pinched.F = (pinched.F.array() == other).select(v, pinched.F);
  }
  std::vector<int> numbers(pinched.V.rows(), -1); // without the three points left over
  int count = 0;
  for (int v = 0; v < pinched.V.rows(); ++v)
  {
    if ((pinched.F.array() == v).any())
    {
      pinched.V.row(count) = pinched.V.row(v);
      numbers[v] = count++;
    }
  }
  pinched.V.conservativeResize(count, 3);
  pinched.F = pinched.F.unaryExpr([&numbers](int v) { return numbers[v]; }).eval();

  for (const int threads : { 1, 2, 5 })
  {
    const TbbContext context(threads);
    ExpectRefusal(turned, { edge, "oriented against each other" }, {}, context);
    ExpectRefusal(pinched, { "point 4500", "more than one fan" }, {}, context);
  }
}

TEST(TriangleMesh, RefusalsUseTheCallersNumbers)
{
  ElementNames names;
  names.Vertices = { 100, 101, 102, 103 };
  names.Faces = { 70, 71 };
  Surface surface = PlaneGrid(1, 1);
  surface.F.row(1).reverseInPlace();
  ExpectRefusal(surface, { "cell 70 and cell 71", "point 100 and point 103" }, names);
}

}
