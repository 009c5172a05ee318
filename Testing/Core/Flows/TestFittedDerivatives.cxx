// Divergence and vorticity at vertices: exact for linear flows in a plane, convergent on the sphere.

#include "Flows/FittedDerivatives.h"

#include "Flows/FormOnPolygons.h"
#include "Mesh/NormalParts.h"
#include "Preparation/PreparedSurface.h"
#include "Support/AllIndices.h"
#include "Support/MeshFactory.h"
#include "Support/Random.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

using namespace dmg;
using namespace dmg::test;

namespace
{

PreparedSurface PreparedFrom(const Surface& surface)
{
  return PrepareSurface(CellTriangles{ surface.V, surface.F, 0, static_cast<int>(surface.F.rows()), {}, {} }, {});
}

PreparedSurface Quads(int columns, int rows, double shake)
{
  PolygonSurface quads;
  quads.Positions = PlaneGrid(columns, rows).V;
  for (int point = 0; point < quads.Positions.rows() && shake > 0.0; ++point)
  {
    quads.Positions(point, 0) += shake * std::sin(12.9 * point);
    quads.Positions(point, 1) += shake * std::cos(78.2 * point);
  }
  for (int j = 0; j < rows; ++j)
  {
    for (int i = 0; i < columns; ++i)
    {
      const int a = j * (columns + 1) + i, b = a + columns + 1;
      quads.Corners.insert(quads.Corners.end(), { a, a + 1, b + 1, b });
      quads.Offsets.push_back(static_cast<int>(quads.Corners.size()));
    }
  }
  return PrepareSurface(std::move(quads), {});
}

/// Regular hexagons whose corners are moved by a shear.
PreparedSurface Hexagons(int columns, int rows)
{
  PolygonSurface hexagons;
  std::map<std::pair<int, int>, int> numbers;
  std::vector<Vector3> points;
  const int dx[] = { 1, 1, 0, -1, -1, 0 }, dy[] = { -1, 1, 2, 1, -1, -2 };
  for (int j = 0; j < rows; ++j)
  {
    for (int i = 0; i < columns; ++i)
    {
      for (int k = 0; k < 6; ++k)
      {
        const int x = 2 * i + j % 2 + dx[k], y = 3 * j + dy[k];
        const auto [found, isNew] = numbers.emplace(std::make_pair(x, y), static_cast<int>(points.size()));
        if (isNew)
        {
          points.emplace_back(0.5 * std::sqrt(3.0) * x + 0.2 * y, 0.5 * y, 0.0);
        }
        hexagons.Corners.push_back(found->second);
      }
      hexagons.Offsets.push_back(static_cast<int>(hexagons.Corners.size()));
    }
  }
  hexagons.Positions.resize(static_cast<Eigen::Index>(points.size()), 3);
  for (std::size_t point = 0; point < points.size(); ++point)
  {
    hexagons.Positions.row(static_cast<Eigen::Index>(point)) = points[point].transpose();
  }
  return PrepareSurface(std::move(hexagons), {});
}

std::vector<std::pair<std::string, PreparedSurface>> PlanarMeshes()
{
  std::vector<std::pair<std::string, PreparedSurface>> meshes;
  meshes.emplace_back("triangles", PreparedFrom(IrregularPlane(9, 7, 5)));
  meshes.emplace_back("thin triangles", PreparedFrom(PlaneWithThinTriangles(6, 5)));
  meshes.emplace_back("squares", Quads(8, 6, 0.0));
  meshes.emplace_back("quadrilaterals", Quads(8, 6, 0.15));
  meshes.emplace_back("hexagons", Hexagons(5, 4));
  return meshes;
}

using Flow = std::function<Vector3(const Vector3&)>;

Points Sampled(const Points& places, const Flow& flow)
{
  Points vectors(places.rows(), 3);
  for (int k = 0; k < places.rows(); ++k)
  {
    vectors.row(k) = flow(places.row(k).transpose()).transpose();
  }
  return vectors;
}

/// Of divergence 5 and vorticity 7, and with a shear.
Vector3 Linear(const Vector3& p)
{
  return { 1.0 + 2.0 * p.x() - 3.0 * p.y(), -2.0 + 4.0 * p.x() + 3.0 * p.y(), 0.0 };
}

void ExpectConstant(const DerivativesAtVertices& derivatives)
{
  for (int vertex = 0; vertex < derivatives.Divergence.size(); ++vertex)
  {
    EXPECT_NEAR(derivatives.Divergence[vertex], 5.0, 1e-8) << vertex;
    EXPECT_NEAR(derivatives.Vorticity[vertex], 7.0, 1e-8) << vertex;
  }
}

/// The derivatives of the linear flow by its integrals along the edges of cells.
DerivativesAtVertices DerivativesByEdges(const FramedMesh& surface, const SurfaceRelation& relation)
{
  const TriangleMesh& mesh = surface.Mesh;
  Vector<double> form = Vector<double>::Zero(mesh.NumberOfEdges());
  std::vector<char> isKnown(form.size(), 0);
  for (const int edge : relation.Edges())
  {
    const auto [a, b] = mesh.EdgeVertices(edge);
    form[edge] = Linear(0.5 * (mesh.Position(a) + mesh.Position(b))).dot(mesh.Position(b) - mesh.Position(a));
    isKnown[edge] = 1;
  }
  const std::vector<char> isGiven = isKnown;
  EXPECT_EQ(FillDiagonals(mesh, relation, form, isKnown), -1);
  return DerivativesOfForm(surface, relation, form, isGiven);
}

/// A disc of rings and spokes, whose innermost quadrilaterals have the middle as two corners.
PolygonSurface PolarDisc(int rings, int spokes)
{
  PolygonSurface disc;
  disc.Positions.setZero(1 + rings * spokes, 3);
  const auto at = [spokes](int ring, int spoke) { return ring == 0 ? 0 : 1 + (ring - 1) * spokes + spoke % spokes; };
  for (int ring = 0; ring < rings; ++ring)
  {
    for (int spoke = 0; spoke < spokes; ++spoke)
    {
      const double angle = 2.0 * Pi * spoke / spokes;
      disc.Positions.row(at(ring + 1, spoke)) << (ring + 1) * std::cos(angle), (ring + 1) * std::sin(angle), 0.0;
      disc.Corners.insert(
        disc.Corners.end(), { at(ring, spoke), at(ring + 1, spoke), at(ring + 1, spoke + 1), at(ring, spoke + 1) });
      disc.Offsets.push_back(static_cast<int>(disc.Corners.size()));
    }
  }
  return disc;
}

/// A flow along the unit sphere without divergence.
struct SphereFlow
{
  std::string Name;
  Flow Vector;
  std::function<double(const Vector3&)> Vorticity;
};

SphereFlow Rotation()
{
  const Vector3 axis(0.3, -0.5, 0.8);
  return { "rotation", [axis](const Vector3& p) { return axis.cross(p); },
    [axis](const Vector3& p) { return 2.0 * axis.dot(p); } };
}

/// A wave of Rossby and Haurwitz, n x grad psi: psi = z (x^3 - 3 x y^2) is a spherical harmonic of degree 4, and its Laplacian is -20 psi.
SphereFlow Wave()
{
  return { "wave",
    [](const Vector3& p)
    {
      const double x = p.x(), y = p.y(), z = p.z();
      return p.cross(Vector3(3.0 * z * (x * x - y * y), -6.0 * x * y * z, x * x * x - 3.0 * x * y * y)).eval();
    },
    [](const Vector3& p) { return -20.0 * p.z() * p.x() * (p.x() * p.x() - 3.0 * p.y() * p.y()); } };
}

/// The errors of the derivatives of a flow relative to its vorticity, roots of mean squares, sampled at vertices and in cells.
/// \param part of the vectors at vertices along the normal.
std::pair<double, double> ErrorsOf(const SphereFlow& flow, double part, const PreparedSurface& sphere)
{
  const FramedMesh surface(TriangleMesh(sphere.Mesh));
  const Flow onSphere = [&flow, part](const Vector3& p)
  { return Vector3(flow.Vector(p.normalized()) + part * p.normalized()); };
  const Points& places = surface.Mesh.VertexPositions();
  Vector<double> exact(places.rows());
  for (int vertex = 0; vertex < exact.size(); ++vertex)
  {
    exact[vertex] = flow.Vorticity(places.row(vertex).transpose());
  }
  const Points centres = CellCentres(surface.Mesh, sphere.Relation);
  const auto errorOf = [&exact](const DerivativesAtVertices& derivatives)
  { return std::max((derivatives.Vorticity - exact).norm(), derivatives.Divergence.norm()) / exact.norm(); };
  const Points atVertices = WithoutNormalParts(surface.Mesh, Sampled(places, onSphere), {}).Tangential;
  const Points inCells = Sampled(centres, [&flow](const Vector3& p) { return flow.Vector(p.normalized()); });
  return { errorOf(DerivativesOfVertexVectors(surface, sphere.Relation, atVertices)),
    errorOf(DerivativesOfCellVectors(surface, sphere.Relation, inCells, centres)) };
}

/// The dual of an icosphere: hexagons and twelve pentagons.
PreparedSurface HexagonsOnSphere(int subdivisions)
{
  const TriangleMesh triangles = Icosphere(subdivisions).Mesh();
  PolygonSurface hexagons;
  hexagons.Positions.resize(triangles.NumberOfFaces(), 3);
  for (int face = 0; face < triangles.NumberOfFaces(); ++face)
  {
    hexagons.Positions.row(face) =
      triangles.VertexPositions()(triangles.FaceCorners().row(face), All).colwise().mean().normalized();
  }
  for (int vertex = 0; vertex < triangles.NumberOfVertices(); ++vertex)
  {
    triangles.VisitFan(vertex, [&hexagons](int h) { hexagons.Corners.push_back(TriangleMesh::FaceOf(h)); });
    hexagons.Offsets.push_back(static_cast<int>(hexagons.Corners.size()));
  }
  return PrepareSurface(std::move(hexagons), {});
}

/// Six faces of n by n quadrilaterals.
PreparedSurface CubedSphere(int n)
{
  PolygonSurface cube;
  cube.Positions.resize(6 * (n + 1) * (n + 1), 3);
  for (int side = 0, point = 0; side < 6; ++side)
  {
    for (int j = 0; j <= n; ++j)
    {
      for (int i = 0; i <= n; ++i, ++point)
      {
        const double a = std::tan(0.25 * Pi * (2.0 * i / n - 1.0)), b = std::tan(0.25 * Pi * (2.0 * j / n - 1.0));
        const Vector3 corners[] = { { 1, a, b }, { -a, 1, b }, { -1, -a, b }, { a, -1, b }, { -b, a, 1 },
          { b, a, -1 } };
        cube.Positions.row(point) = corners[side].normalized().transpose();
        if (i < n && j < n)
        {
          cube.Corners.insert(cube.Corners.end(), { point, point + 1, point + n + 2, point + n + 1 });
          cube.Offsets.push_back(static_cast<int>(cube.Corners.size()));
        }
      }
    }
  }
  return PrepareSurface(std::move(cube), {});
}

/// Quadrilaterals between circles of latitude, whose first and last row reach the poles.
PreparedSurface LatitudesAndLongitudes(int rows)
{
  const int columns = 2 * rows;
  PolygonSurface grid;
  grid.Positions.resize((rows + 1) * (columns + 1), 3);
  for (int j = 0; j <= rows; ++j)
  {
    for (int i = 0; i <= columns; ++i)
    {
      const double latitude = Pi * j / rows - 0.5 * Pi, longitude = 2.0 * Pi * i / columns;
      const int point = j * (columns + 1) + i;
      grid.Positions.row(point) << std::cos(latitude) * std::cos(longitude), std::cos(latitude) * std::sin(longitude),
        std::sin(latitude);
      if (i < columns && j < rows)
      {
        grid.Corners.insert(grid.Corners.end(), { point, point + 1, point + columns + 2, point + columns + 1 });
        grid.Offsets.push_back(static_cast<int>(grid.Corners.size()));
      }
    }
  }
  return PrepareSurface(std::move(grid), {});
}

}

TEST(FittedDerivatives, AreExactForLinearFlowsOnAnyPlanarMesh)
{
  for (const auto& [name, prepared] : PlanarMeshes())
  {
    SCOPED_TRACE(name);
    const FramedMesh surface(TriangleMesh(prepared.Mesh));
    const TriangleMesh& mesh = surface.Mesh;
    ExpectConstant(DerivativesOfVertexVectors(surface, prepared.Relation, Sampled(mesh.VertexPositions(), Linear)));
    const Points centres = CellCentres(mesh, prepared.Relation);
    ExpectConstant(DerivativesOfCellVectors(surface, prepared.Relation, Sampled(centres, Linear), centres));

    ExpectConstant(DerivativesByEdges(surface, prepared.Relation));
  }
}

// The data of a cell stand at the mean of its corners as they were written: the middle counts twice.
TEST(FittedDerivatives, AreExactWhereCellsHaveACornerTwice)
{
  const PolygonSurface disc = PolarDisc(4, 16);
  const PreparedSurface prepared = PrepareSurface(PolygonSurface(disc), {});
  Points vectors(prepared.Mesh.NumberOfFaces(), 3);
  for (int face = 0; face < vectors.rows(); ++face)
  {
    const int first = 4 * prepared.Relation.CellOf(face);
    Vector3 mean = Vector3::Zero();
    for (int k = 0; k < 4; ++k)
    {
      mean += 0.25 * disc.Positions.row(disc.Corners[first + k]).transpose();
    }
    vectors.row(face) = Linear(mean).transpose();
  }
  ExpectConstant(DerivativesOfCellVectors(FramedMesh(TriangleMesh(prepared.Mesh)), prepared.Relation, vectors,
    CellCentres(prepared.Mesh, prepared.Relation)));
}

TEST(FittedDerivatives, OfVectorsAtTheCornersOfAStripOfOneCellAreExact)
{
  const PreparedSurface strip = Quads(10, 1, 0.0);
  const FramedMesh surface(TriangleMesh(strip.Mesh));
  ExpectConstant(DerivativesOfVertexVectors(surface, strip.Relation, Sampled(surface.Mesh.VertexPositions(), Linear)));
}

TEST(FittedDerivatives, OfIntegralsAlongEdgesAreExactOnThinAndOnShearedTriangles)
{
  for (const auto& [stretch, shear] : { std::pair{ 50.0, 0.0 }, { 1.0, 10.0 }, { 20.0, 7.0 } })
  {
    SCOPED_TRACE(std::to_string(stretch) + ", sheared by " + std::to_string(shear));
    for (Surface surface : { PlaneGrid(8, 8), IrregularPlane(8, 8, 5) })
    {
      surface.V.col(0) = stretch * surface.V.col(0) + shear * surface.V.col(1);
      const PreparedSurface prepared = PreparedFrom(surface);
      ExpectConstant(DerivativesByEdges(FramedMesh(TriangleMesh(prepared.Mesh)), prepared.Relation));
    }
  }
}

// Cells in a row know nothing of the derivatives across. Neither do integrals along edges, but for the vorticity.
TEST(FittedDerivatives, AreNaNWhereTheDataDoNotDetermineThem)
{
  for (const PreparedSurface& strip : { Quads(10, 1, 0.0), PreparedFrom(PlaneGrid(10, 1)) })
  {
    const FramedMesh surface(TriangleMesh(strip.Mesh));
    const bool areQuads = strip.Relation.FacesOf(0).size() == 2;
    if (areQuads)
    {
      const Points centres = CellCentres(surface.Mesh, strip.Relation);
      const DerivativesAtVertices ofCells =
        DerivativesOfCellVectors(surface, strip.Relation, Sampled(centres, Linear), centres);
      EXPECT_TRUE(ofCells.Divergence.array().isNaN().all());
      EXPECT_TRUE(ofCells.Vorticity.array().isNaN().all());
      EXPECT_NE(
        WarningOfUndetermined(ofCells).find("Divergence and vorticity are NaN at 22 points"), std::string::npos);
    }
    const DerivativesAtVertices ofEdges = DerivativesByEdges(surface, strip.Relation);
    EXPECT_TRUE(ofEdges.Divergence.array().isNaN().all());
    EXPECT_NEAR(ofEdges.Vorticity.minCoeff(), 7.0, 1e-12);
    EXPECT_NEAR(ofEdges.Vorticity.maxCoeff(), 7.0, 1e-12);
    EXPECT_NE(WarningOfUndetermined(ofEdges).find("Divergence is NaN at 22 points"), std::string::npos);
  }
}

TEST(FittedDerivatives, ConvergeOnTheSphere)
{
  const std::vector<std::pair<std::string, std::function<PreparedSurface(int)>>> families = {
    { "hexagons", [](int level) { return HexagonsOnSphere(level + 2); } },
    { "uneven triangles", [](int level) { return PreparedFrom(IrregularSphere(level + 2, 4, 0.2)); } },
    { "cubed sphere", [](int level) { return CubedSphere(6 << level); } },
    { "latitudes and longitudes", [](int level) { return LatitudesAndLongitudes(12 << level); } }
  };
  for (const auto& [name, make] : families)
  {
    for (const auto& [flow, part] : { std::pair{ Rotation(), 0.0 }, { Wave(), 0.0 }, { Wave(), 10.0 } })
    {
      SCOPED_TRACE(name + ", " + flow.Name + ", along the normal " + std::to_string(part));
      std::pair<double, double> coarse;
      for (const int level : { 0, 1, 2 })
      {
        const auto [atVertices, inCells] = ErrorsOf(flow, part, make(level));
        if (level > 0)
        {
          EXPECT_GT(std::log2(coarse.first / atVertices), 0.8) << level;
          EXPECT_GT(std::log2(coarse.second / inCells), 0.8) << level;
        }
        coarse = { atVertices, inCells };
      }
      EXPECT_LT(coarse.first, 0.1);
      EXPECT_LT(coarse.second, 0.1);
    }
  }
}

TEST(FittedDerivatives, OfAClosedFormHaveNoVorticity)
{
  const PreparedSurface torus = PreparedFrom(IrregularTorus(20, 12, 3));
  const FramedMesh surface(TriangleMesh(torus.Mesh));
  Vector<double> form(surface.Mesh.NumberOfEdges());
  for (int edge = 0; edge < form.size(); ++edge)
  {
    const auto [a, b] = surface.Mesh.EdgeVertices(edge);
    form[edge] = std::sin(surface.Mesh.Position(b).x()) - std::sin(surface.Mesh.Position(a).x());
  }
  const std::vector<char> isGiven(form.size(), 1);
  EXPECT_LT(DerivativesOfForm(surface, torus.Relation, form, isGiven).Vorticity.cwiseAbs().maxCoeff(), 1e-12);
}
