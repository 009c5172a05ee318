#include "Operators/PrincipalDirections.h"

#include "Operators/PowerFieldDirections.h"
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

/// The shape operator, symmetric in space, integrated over a part of the surface.
struct BendOfPart
{
  Eigen::Matrix3d Bend = Eigen::Matrix3d::Zero();
  double Area = 0.0;

  BendOfPart& operator+=(const BendOfPart& other)
  {
    this->Bend += other.Bend;
    this->Area += other.Area;
    return *this;
  }
};

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

/// A third of each face around a vertex.
std::vector<BendOfPart> BendsOfVertices(const FramedMesh& surface, const ExecutionContext& context)
{
  const TriangleMesh& mesh = surface.Mesh;
  Points normals(mesh.NumberOfVertices(), 3);
  context.ParallelFor(0, mesh.NumberOfVertices(), Grain,
    [&](int first, int last)
    {
      for (int vertex = first; vertex < last; ++vertex)
      {
        normals.row(vertex) = surface.Vertices.Normal(vertex).transpose();
      }
    });
  std::vector<BendOfPart> ofVertices(mesh.NumberOfVertices());
  context.ParallelFor(0, mesh.NumberOfVertices(), Grain,
    [&](int first, int last)
    {
      for (int vertex = first; vertex < last; ++vertex)
      {
        BendOfPart& sum = ofVertices[vertex];
        mesh.VisitFan(
          vertex, [&](int halfedge) { sum += BendOfFace(surface, normals, TriangleMesh::FaceOf(halfedge)); });
        sum.Bend /= 3.0;
        sum.Area /= 3.0;
      }
    });
  return ofVertices;
}

template <class Visit>
void VisitNeighbours(const TriangleMesh& mesh, int vertex, const Visit& visit)
{
  mesh.VisitFan(vertex,
    [&](int halfedge)
    {
      visit(mesh.Head(halfedge));
      const int previous = TriangleMesh::Previous(halfedge);
      if (mesh.Twin(previous) < 0)
      {
        visit(mesh.Tail(previous));
      }
    });
}

/// Sums over the regions of vertices, for one piece of a loop over them.
class SumsOverRegions
{
public:
  SumsOverRegions(const TriangleMesh& mesh, const std::vector<BendOfPart>& parts, double radius, std::size_t limit)
    : Mesh(mesh)
    , Parts(parts)
    , SquaredRadius(radius * radius)
    , Limit(limit)
    , RegionOf(mesh.NumberOfVertices(), -1)
  {
  }

  BendOfPart Around(int centre)
  {
    const Vector3 position = this->Mesh.Position(centre);
    BendOfPart sum;
    this->Region.assign(1, centre);
    this->RegionOf[centre] = centre;
    for (std::size_t i = 0; i < this->Region.size(); ++i) // grows meanwhile
    {
      sum += this->Parts[this->Region[i]];
      VisitNeighbours(this->Mesh, this->Region[i],
        [&](int vertex)
        {
          const bool isInside = i == 0 ||
            (this->Region.size() < this->Limit &&
              (this->Mesh.Position(vertex) - position).squaredNorm() < this->SquaredRadius);
          if (isInside && this->RegionOf[vertex] != centre)
          {
            this->RegionOf[vertex] = centre;
            this->Region.push_back(vertex);
          }
        });
    }
    return sum;
  }

private:
  const TriangleMesh& Mesh;
  const std::vector<BendOfPart>& Parts;
  const double SquaredRadius;
  const std::size_t Limit;
  std::vector<int> RegionOf; ///< the last one that a vertex was in
  std::vector<int> Region;
};

double MeanEdge(const TriangleMesh& mesh)
{
  double sum = 0.0;
  for (int edge = 0; edge < mesh.NumberOfEdges(); ++edge)
  {
    const auto [tail, head] = mesh.EdgeVertices(edge);
    sum += (mesh.Position(head) - mesh.Position(tail)).norm();
  }
  return sum / mesh.NumberOfEdges();
}

std::vector<BendOfPart> BendsOfRegions(const FramedMesh& surface, double scale, const ExecutionContext& context)
{
  const TriangleMesh& mesh = surface.Mesh;
  const std::vector<BendOfPart> parts = BendsOfVertices(surface, context);
  const double radius = scale * MeanEdge(mesh);
  std::vector<BendOfPart> ofRegions(mesh.NumberOfVertices());
  const int size = mesh.NumberOfVertices();
  // A region has 3.6 scale^2 vertices on an even surface; a batch visits some million.
  const double expected = 4.0 * scale * scale + 4.0;
  const auto limit = static_cast<std::size_t>(std::min(4.0 * expected, 1.0 * size));
  const int batch = std::max(256, static_cast<int>(1e6 / expected));
  for (int start = 0; start < size; start += batch)
  {
    context.Checkpoint(static_cast<double>(start) / size);
    const int end = std::min(size, start + batch);
    context.ParallelFor(start, end, std::max(64, batch / 8),
      [&](int first, int last)
      {
        SumsOverRegions sums(mesh, parts, radius, limit);
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

PrincipalDirections FindPrincipalDirections(const FramedMesh& surface, double scale, const ExecutionContext& context)
{
  assert(scale >= 0.0 && std::isfinite(scale));
  const TriangleMesh& mesh = surface.Mesh;
  const std::vector<BendOfPart> regions = BendsOfRegions(surface, scale, PartOfContext(context, 0.0, 0.9));
  const Points& points = mesh.VertexPositions();
  const double diagonal = (points.colwise().maxCoeff() - points.colwise().minCoeff()).norm();
  const auto ofFace = [&](int face)
  {
    BendOfPart sum;
    for (int k = 0; k < 3; ++k)
    {
      sum += regions[mesh.FaceCorners()(face, k)];
    }
    return sum;
  };
  PrincipalDirections found{ CurvaturesOf(surface.Faces, 1.0 / diagonal, ofFace, context),
    CurvaturesOf(
      surface.Vertices, 1.0 / diagonal, [&regions](int vertex) { return regions[vertex]; }, context) };
  context.Checkpoint(1.0);
  return found;
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
  directions.Vertices.MaximumDirections =
    FirstDirectionsAtVertices(mesh, corners, directions.Faces.MaximumDirections, ofVertices, N, context);
}

}
