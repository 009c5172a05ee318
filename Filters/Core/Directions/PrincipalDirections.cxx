#include "Directions/PrincipalDirections.h"

#include "Directions/BendOfRegions.h"
#include "Directions/PowerFieldDirections.h"
#include "Operators/PowerFieldOperators.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <vector>

namespace dmg
{

namespace
{

constexpr int Grain = 4096;

/// Ratios of curvatures below this are rounding errors.
constexpr double SmallestRatio = 1e-6;

/// The weight of faces that touch the boundary, against that of others.
constexpr double WeightAtBoundary = 1e-6;

/// With normals that are interpolated between the corners, whose derivative is constant: the sum over the corners of
/// their normals times the gradients of their hat functions.
BendOfPart BendOfFace(const FramedMesh& surface, const Points& normals, int face)
{
  const TriangleMesh& mesh = surface.Mesh;
  const Vector3 normal = surface.Faces.Normal(face);
  Eigen::Matrix3d derivative = Eigen::Matrix3d::Zero();
  for (int h = 3 * face; h < 3 * face + 3; ++h)
  {
    const Vector3 opposite = mesh.Position(mesh.Head(h)) - mesh.Position(mesh.Tail(h));
    const Vector3 gradient = 0.5 * normal.cross(opposite); // times the area
    derivative += normals.row(mesh.Tail(TriangleMesh::Previous(h))).transpose() * gradient.transpose();
  }
  return { 0.5 * (derivative + derivative.transpose()), mesh.FaceArea(face) };
}

/// The vertices of a mesh.
class BendsOnMesh
{
public:
  BendsOnMesh(const TriangleMesh& mesh, const std::vector<BendOfPart>& parts)
    : Mesh(mesh)
    , Parts(parts)
  {
  }

  Vector3 Position(int vertex) const { return this->Mesh.Position(vertex); }
  const BendOfPart& Part(int vertex) const { return this->Parts[vertex]; }
  template <class Visit>
  void VisitNeighbours(int vertex, const Visit& visit) const
  {
    VisitVerticesAround(this->Mesh, vertex, visit);
  }

private:
  const TriangleMesh& Mesh;
  const std::vector<BendOfPart>& Parts;
};

std::vector<BendOfPart> BendsOfRegions(
  const FramedMesh& surface, const RegionSize& region, const ExecutionContext& context)
{
  const std::vector<BendOfPart> parts =
    BendsOfVertices(surface, NormalsOfVertices(surface, context), AreOnBoundary(surface.Mesh), context);
  const BendsOnMesh graph(surface.Mesh, parts);
  const int size = surface.Mesh.NumberOfVertices();
  std::vector<BendOfPart> ofRegions(size);
  const int batch = std::max(256, static_cast<int>(1e6 / region.Expected)); // visits some million
  for (int start = 0; start < size; start += batch)
  {
    context.Checkpoint(static_cast<double>(start) / size);
    const int end = std::min(size, start + batch);
    context.ParallelFor(start, end, std::max(64, batch / 8),
      [&](int first, int last)
      {
        SumsOverRegions<BendsOnMesh> sums(graph, size, region);
        for (int vertex = first; vertex < last; ++vertex)
        {
          ofRegions[vertex] = sums.Around(vertex);
        }
      });
  }
  return ofRegions;
}

/// The curvatures of the elements of one kind, from the sums over their regions.
/// \param flat the curvature below which the surface counts as flat.
/// \param bendOf (element) the sum over its region.
template <class BendOf>
PrincipalCurvatures CurvaturesOf(
  const TangentFrames& frames, double flat, const BendOf& bendOf, const ExecutionContext& context)
{
  const int size = static_cast<int>(frames.X.rows());
  PrincipalCurvatures found{ Vector<Complex>(size), Vector<double>(size), Vector<double>(size), Vector<double>(size) };
  context.ParallelFor(0, size, Grain,
    [&](int first, int last)
    {
      for (int element = first; element < last; ++element)
      {
        const BendOfPart part = bendOf(element);
        const Vector3 x = frames.X.row(element).transpose(), y = frames.Y.row(element).transpose();
        const Eigen::Matrix3d shape =
          part.Area > 0.0 ? Eigen::Matrix3d(part.Bend / part.Area) : Eigen::Matrix3d::Zero();
        const double xx = x.dot(shape * x), yy = y.dot(shape * y), xy = x.dot(shape * y);
        const double mean = 0.5 * (xx + yy);
        // Directions of half its angle bend most.
        const Complex difference(0.5 * (xx - yy), xy);
        const double half = std::abs(difference);
        const double ratio = 2.0 * half / (std::abs(mean + half) + std::abs(mean - half) + flat);
        const bool isClear = ratio > SmallestRatio;
        found.MaximumDirections[element] = isClear ? std::sqrt(difference / half) : Complex(0.0);
        found.Maximum[element] = mean + half;
        found.Minimum[element] = mean - half;
        found.Confidence[element] = isClear ? ratio * ratio : 0.0;
      }
    });
  return found;
}

}

Points NormalsOfVertices(const FramedMesh& surface, const ExecutionContext& context)
{
  Points normals(surface.Mesh.NumberOfVertices(), 3);
  context.ParallelFor(0, surface.Mesh.NumberOfVertices(), Grain,
    [&](int first, int last)
    {
      for (int vertex = first; vertex < last; ++vertex)
      {
        normals.row(vertex) = surface.Vertices.Normal(vertex).transpose();
      }
    });
  return normals;
}

std::vector<char> AreOnBoundary(const TriangleMesh& mesh)
{
  std::vector<char> are(mesh.NumberOfVertices());
  for (int vertex = 0; vertex < mesh.NumberOfVertices(); ++vertex)
  {
    are[vertex] = mesh.IsBoundaryVertex(vertex) ? 1 : 0;
  }
  return are;
}

std::vector<BendOfPart> BendsOfVertices(const FramedMesh& surface, const Points& normals,
  const std::vector<char>& isOnBoundary, const ExecutionContext& context)
{
  const TriangleMesh& mesh = surface.Mesh;
  const auto weightOf = [&](int face)
  {
    const auto corners = mesh.FaceCorners().row(face);
    const bool touches = isOnBoundary[corners[0]] || isOnBoundary[corners[1]] || isOnBoundary[corners[2]];
    return (touches ? WeightAtBoundary : 1.0) / 3.0;
  };
  std::vector<BendOfPart> ofVertices(mesh.NumberOfVertices());
  context.ParallelFor(0, mesh.NumberOfVertices(), Grain,
    [&](int first, int last)
    {
      for (int vertex = first; vertex < last; ++vertex)
      {
        BendOfPart& sum = ofVertices[vertex];
        mesh.VisitFan(vertex,
          [&](int halfedge)
          {
            const int face = TriangleMesh::FaceOf(halfedge);
            BendOfPart part = BendOfFace(surface, normals, face);
            part.Bend *= weightOf(face);
            part.Area *= weightOf(face);
            sum += part;
          });
      }
    });
  return ofVertices;
}

// A region has 3.6 scale^2 vertices on an even surface.
RegionSize::RegionSize(double scale, const SurfaceSizes& sizes)
  : Expected(4.0 * scale * scale + 4.0)
  , SquaredRadius(scale * sizes.MeanEdge * (scale * sizes.MeanEdge))
  , Limit(static_cast<std::size_t>(std::min(4.0 * this->Expected, 1.0 * static_cast<double>(sizes.NumberOfVertices))))
{
}

PrincipalCurvatures CurvaturesOfFaces(
  const FramedMesh& surface, const std::vector<BendOfPart>& ofRegions, double diagonal, const ExecutionContext& context)
{
  const auto ofFace = [&](int face)
  {
    BendOfPart sum;
    for (int k = 0; k < 3; ++k)
    {
      sum += ofRegions[surface.Mesh.FaceCorners()(face, k)];
    }
    return sum;
  };
  return CurvaturesOf(surface.Faces, 1.0 / diagonal, ofFace, context);
}

PrincipalDirections FindPrincipalDirections(const FramedMesh& surface, double scale, const ExecutionContext& context)
{
  assert(scale >= 0.0 && std::isfinite(scale));
  const SurfaceSizes sizes = SizesOf(surface.Mesh);
  const std::vector<BendOfPart> regions =
    BendsOfRegions(surface, RegionSize(scale, sizes), PartOfContext(context, 0.0, 0.9));
  PrincipalDirections found{ CurvaturesOfFaces(surface, regions, sizes.Diagonal(), context),
    CurvaturesOf(
      surface.Vertices, 1.0 / sizes.Diagonal(), [&regions](int vertex) { return regions[vertex]; }, context) };
  context.Checkpoint(1.0);
  return found;
}

double ShareBentWithinScale(const FramedMesh& surface, const PrincipalDirections& directions, double scale)
{
  constexpr double LargestBend = 0.7;  // of a region, in radians
  constexpr double SmallestBend = 0.1; // of a face
  const TriangleMesh& mesh = surface.Mesh;
  const SurfaceSizes sizes = SizesOf(mesh);
  double bent = 0.0;
  for (int face = 0; face < mesh.NumberOfFaces(); ++face)
  {
    const double curvature =
      std::max(std::abs(directions.Faces.Maximum[face]), std::abs(directions.Faces.Minimum[face]));
    double longest = 0.0;
    for (int h = 3 * face; h < 3 * face + 3; ++h)
    {
      longest = std::max(longest, (mesh.Position(mesh.Head(h)) - mesh.Position(mesh.Tail(h))).norm());
    }
    const double area = mesh.FaceArea(face);
    const bool isBent = curvature * scale * sizes.MeanEdge > LargestBend;
    const bool isResolved = curvature * 2.0 * area < SmallestBend * longest;
    bent += isBent && isResolved ? area : 0.0;
  }
  return sizes.Area > 0.0 ? bent / sizes.Area : 0.0;
}

std::string WarningOfScale(const FramedMesh& surface, const PrincipalDirections& directions, double scale)
{
  constexpr double NotableShare = 0.2;
  const double share = ShareBentWithinScale(surface, directions, scale);
  return share < NotableShare ? ""
                              : "on " + std::to_string(std::lround(100.0 * share)) +
      " % of the surface, Scale reaches around bends that the triangles resolve, and curvatures are too small by a "
      "sixth or more; choose a smaller Scale, down to 0";
}

void CombSigns(const FramedMesh& surface, PrincipalDirections& directions, const ExecutionContext& context)
{
  constexpr int N = 2;
  const TriangleMesh& mesh = surface.Mesh;
  const auto square = [](const Vector<Complex>& units) { return Vector<Complex>(units.cwiseProduct(units)); };
  const Vector<Complex> ofFaces = square(directions.Faces.MaximumDirections);
  const Vector<Complex> ofVertices = square(directions.Vertices.MaximumDirections);
  const Unfilled<Complex> sides = SideDirections(mesh, surface.Faces, context);
  const std::vector<int> labels =
    CombingLabels(mesh, ofFaces, MatchDirections(mesh, sides, ofFaces, N, context), N, context);
  directions.Faces.MaximumDirections = FirstDirections(ofFaces, N, labels, context);
  const Unfilled<Corner> corners = Corners(mesh, sides, surface.Faces, surface.Vertices, context);
  directions.Vertices.MaximumDirections = FirstDirectionsAtVertices(
    mesh, [&corners](int h) { return corners[h].Turn; }, directions.Faces.MaximumDirections, ofVertices, N, context);
}

}
