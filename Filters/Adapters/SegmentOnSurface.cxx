#include "Adapters/SegmentOnSurface.h"

#include "vtkGenericCell.h"
#include "vtkPolyData.h"
#include "vtkStaticCellLocator.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dmg
{

namespace
{

/// Parts shorter than this, relative to the surface and to the segment, are due to rounding.
constexpr double SmallestOfSurface = 1e-6;
constexpr double SmallestOfSegment = 1e-3;

/// A segment often starts on an edge, whose two faces are both nearest. So its ends are looked at
/// this far inside.
constexpr double NearEnd = 1e-3;

/// Normals that are perpendicular to each other are not against each other.
constexpr double LeastAgainst = -1e-3;

constexpr int MaximumDepth = 50; // beyond which parameters in double precision are too coarse

double MeanEdgeOf(const TriangleMesh& mesh)
{
  double sum = 0.0;
  for (int edge = 0; edge < mesh.NumberOfEdges(); ++edge)
  {
    const auto [a, b] = mesh.EdgeVertices(edge);
    sum += (mesh.Position(a) - mesh.Position(b)).norm();
  }
  return sum / mesh.NumberOfEdges();
}

/// Adds a part, or lengthens the last one if that is of the same face.
void Append(std::vector<SegmentPart>& parts, const NearestPlace& place, double length)
{
  if (!parts.empty() && parts.back().Face == place.Face)
  {
    parts.back().Length += length;
    parts.back().Distance = std::max(parts.back().Distance, place.Distance);
  }
  else
  {
    const auto kind = place.Face < 0 ? SegmentPart::TooFar : SegmentPart::OnSurface;
    parts.push_back({ kind, place.Face, length, place.Distance });
  }
}

}

double SizeOf(const TriangleMesh& mesh)
{
  const Points& points = mesh.VertexPositions();
  return (points.colwise().maxCoeff() - points.colwise().minCoeff()).norm();
}

//------------------------------------------------------------------------------
NearestPlaces::NearestPlaces(
  vtkPolyData* surface, const FramedSurface& framed, double maximumDistance)
  : Framed(framed)
  , MaximumDistance(maximumDistance)
{
  vtkNew<vtkPolyData> triangles; // its cells are the polygons
  triangles->SetPoints(surface->GetPoints());
  triangles->SetPolys(surface->GetPolys());
  this->Locator->SetDataSet(triangles);
  this->Locator->BuildLocator();
}

NearestPlaces::~NearestPlaces() = default;

NearestPlace NearestPlaces::operator()(const Vector3& position) const
{
  NearestPlace place;
  vtkIdType polygon = -1;
  double squaredDistance = std::numeric_limits<double>::infinity();
  if (std::isfinite(position.squaredNorm())) // which the locator needs
  {
    int subId;
    this->Locator->FindClosestPoint(
      position.data(), place.Position.data(), this->Cell, polygon, subId, squaredDistance);
  }
  place.Distance = std::sqrt(squaredDistance);
  if (polygon >= 0 && place.Distance <= this->MaximumDistance)
  {
    place.Face = this->Framed.Surface.Faces[polygon];
  }
  return place;
}

//------------------------------------------------------------------------------
struct SegmentOnSurface::Segment
{
  Vector3 Start, Direction;
  double Length;
  double Smallest; ///< length that counts
};

struct SegmentOnSurface::Sample
{
  double Parameter; ///< in [0, 1]
  NearestPlace Place;
};

SegmentOnSurface::SegmentOnSurface(const NearestPlaces& nearest)
  : Nearest(nearest)
  , MeanEdge(MeanEdgeOf(nearest.Framed.Surface.Mesh))
  , Size(SizeOf(nearest.Framed.Surface.Mesh))
{
}

SegmentOnSurface::Sample SegmentOnSurface::At(const Segment& segment, double parameter) const
{
  return { parameter, this->Nearest(segment.Start + parameter * segment.Direction) };
}

std::vector<SegmentPart> SegmentOnSurface::PartsOf(const Vector3& start, const Vector3& end) const
{
  std::vector<SegmentPart> parts;
  const double length = (end - start).stableNorm();
  if (length > 0.0)
  {
    const Segment segment{ start, end - start, length,
      std::min(SmallestOfSurface * this->Size, SmallestOfSegment * length) };
    this->Split(segment, this->At(segment, 0.0), this->At(segment, 1.0), 0, parts);
    const auto isSmall = [&segment](const SegmentPart& part)
    { return part.Length <= 2.0 * segment.Smallest; };
    parts.erase(std::remove_if(parts.begin(), parts.end(), isSmall), parts.end());
    this->MarkFarSide(segment, parts);
  }
  return parts;
}

void SegmentOnSurface::Split(const Segment& segment, const Sample& a, const Sample& b, int depth,
  std::vector<SegmentPart>& parts) const
{
  const double length = (b.Parameter - a.Parameter) * segment.Length;
  const double nearer = std::min(a.Place.Distance, b.Place.Distance);
  if (length <= std::max(this->MeanEdge, 0.5 * nearer) || depth == MaximumDepth)
  {
    const bool isEnd = length <= segment.Smallest || depth == MaximumDepth;
    const double crossing = a.Place.Face == b.Place.Face ? 0.5
      : isEnd                                            ? 0.5
                                                         : this->Crossing(a.Place, b.Place);
    if (crossing >= 0.0)
    {
      Append(parts, a.Place, crossing * length);
      Append(parts, b.Place, (1.0 - crossing) * length);
      return;
    }
  }
  const Sample middle = this->At(segment, 0.5 * (a.Parameter + b.Parameter));
  this->Split(segment, a, middle, depth + 1, parts);
  this->Split(segment, middle, b, depth + 1, parts);
}

/// Where the way between two places on faces that share an edge crosses it, as a fraction of the
/// way, in the plane into which both unfold; -1 where it does not, or there is no such edge.
double SegmentOnSurface::Crossing(const NearestPlace& a, const NearestPlace& b) const
{
  const TriangleMesh& mesh = this->Nearest.Framed.Surface.Mesh;
  for (int h = 3 * a.Face; a.Face >= 0 && b.Face >= 0 && h < 3 * a.Face + 3; ++h)
  {
    const int twin = mesh.Twin(h);
    if (twin < 0 || TriangleMesh::FaceOf(twin) != b.Face)
    {
      continue;
    }
    const Vector3 tail = mesh.Position(mesh.Tail(h));
    const Vector3 side = mesh.Position(mesh.Head(h)) - tail;
    const double length = side.norm();
    const Vector3 along = side / length;
    const double xOfA = along.dot(a.Position - tail), xOfB = along.dot(b.Position - tail);
    const double yOfA = (a.Position - tail - xOfA * along).norm();
    const double yOfB = (b.Position - tail - xOfB * along).norm();
    // Both on the edge: either face will do.
    const double crossing = yOfA + yOfB > 0.0 ? yOfA / (yOfA + yOfB) : 0.5;
    const double x = xOfA + crossing * (xOfB - xOfA);
    if (length > 0.0 && x >= 0.0 && x <= length)
    {
      return crossing;
    }
  }
  return -1.0;
}

void SegmentOnSurface::MarkFarSide(const Segment& segment, std::vector<SegmentPart>& parts) const
{
  const auto normalAt = [this](int face)
  { return face < 0 ? Vector3(0.0, 0.0, 0.0) : this->Nearest.Framed.Faces.Normal(face); };
  const Vector3 atStart = normalAt(this->At(segment, NearEnd).Place.Face);
  const Vector3 atEnd = normalAt(this->At(segment, 1.0 - NearEnd).Place.Face);
  double before = 0.0;
  for (SegmentPart& part : parts)
  {
    const double middle = (before + 0.5 * part.Length) / segment.Length;
    const Vector3 meant = (1.0 - middle) * atStart + middle * atEnd;
    if (part.Face >= 0 && normalAt(part.Face).dot(meant) < LeastAgainst)
    {
      part.Kind = SegmentPart::OnFarSide;
    }
    before += part.Length;
  }
}

}
