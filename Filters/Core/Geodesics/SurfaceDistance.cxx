#include "Geodesics/SurfaceDistance.h"

#include "Geodesics/EdgePath.h"
#include "Geodesics/IntrinsicPlaces.h"
#include "Geodesics/IntrinsicTriangulation.h"
#include "Geodesics/LineStarts.h"
#include "Geodesics/PlacedSources.h"
#include "Geodesics/ShortestPaths.h"
#include "Geodesics/SignsOfLines.h"
#include "Geodesics/WavefrontPaths.h"
#include "Mesh/PositiveSide.h"
#include "Mesh/VertexConnection.h"
#include "Places/NearestPlaces.h"
#include "Support/Errors.h"
#include "Support/Remedy.h"
#include "Support/ShortText.h"

#include <algorithm>
#include <cmath>
#include <mutex>
#include <optional>
#include <utility>

namespace dmg
{
namespace
{

std::vector<char> AreHeld(const std::vector<int>& lines)
{
  std::vector<char> held(lines.size());
  std::transform(lines.begin(), lines.end(), held.begin(), [](int line) { return line >= 0 ? 1 : 0; });
  return held;
}

}

class SurfaceDistance::Internals
{
public:
  Internals(const FramedMesh& surface, const DistanceSources& sources, const DistanceOptions& options,
    const ExecutionContext& context)
    : Surface(surface)
    , Options(options)
  {
    PlacedSources placed(surface, sources, options, PartOfContext(context, 0.0, 0.3));
    if (placed.Split.IsSplit())
    {
      this->Split = std::make_unique<FramedMesh>(placed.Split.Make(context));
    }
    const FramedMesh& on = this->On();
    this->Connection = std::make_unique<VertexConnection>(on, context);
    this->Delaunay = std::make_unique<IntrinsicTriangulation>(
      on, *this->Connection, AreHeld(placed.Split.Lines()), PartOfContext(context, 0.4, 0.6));
    const std::vector<PathStart> starts = placed.StartsOn(on.Mesh);
    this->Result.Taken = placed.Taken;
    this->Result.TooFar = placed.TooFar;
    this->Result.Interrupted = placed.Interrupted;
    if (placed.Interrupted > 0)
    {
      this->Result.Warnings.push_back("lines have " + std::to_string(placed.Interrupted) +
        " gaps where they leap from one part of the surface to another; draw them nearer to it, with more points");
    }
    if (starts.empty() && !options.MayMiss)
    {
      throw InvalidInput(placed.TooFar > 0
          ? "all sources are too far from the surface; move them nearer, or raise " +
            TextOf(Remedy::MaximumSourceDistance)
          : std::string("there is no source of distances; give a point, a line, a region or the boundary"));
    }
    this->Paths = FindShortestPaths(*this->Delaunay, starts, options.MaximumDistance, PartOfContext(context, 0.6, 1.0));
    this->SetSigns(placed);
    this->SetRegion(placed.Split, sources.Region);
    this->SetField();
    context.Checkpoint(1.0);
  }

  const FramedMesh& On() const { return this->Split ? *this->Split : this->Surface; }
  bool IsReached(const ShortestPath& path) const
  {
    return path.IsAny() && path.Length <= this->Options.MaximumDistance;
  }
  double SignOfFace(int face) const { return this->Signs ? (*this->Signs)[face] : 1.0; }
  double Sign(int vertex) const
  {
    return this->SignOfFace(TriangleMesh::FaceOf(this->On().Mesh.OutgoingHalfedge(vertex)));
  }

  SurfacePath PathToVertex(int vertex, const ExecutionContext& context) const
  {
    IntrinsicTriangulation flipped = *this->Delaunay;
    return this->PathTo(vertex, this->Sign(vertex), this->Paths, flipped, {}, context);
  }

  SurfacePath PathToPlace(const Vector3& point, const ExecutionContext& context) const
  {
    std::call_once(this->HasNearest, [this] { this->Nearest = std::make_unique<NearestPlaces>(this->On()); });
    const NearestPlace place = (*this->Nearest)(point);
    if (place.Face < 0 || place.Distance > this->Options.MaximumSourceDistance * this->Nearest->Sizes.Diagonal())
    {
      return {};
    }
    const TriangleMesh& mesh = this->On().Mesh;
    int nearest = 3 * place.Face; // corner
    double longest = 0.0;
    const auto toCorner = [&](int h) { return (place.Position - mesh.Position(mesh.Tail(h))).norm(); };
    for (int h = 3 * place.Face; h < 3 * place.Face + 3; ++h)
    {
      nearest = toCorner(h) < toCorner(nearest) ? h : nearest;
      longest = std::max(longest, (mesh.Position(mesh.Head(h)) - mesh.Position(mesh.Tail(h))).norm());
    }
    if (toCorner(nearest) <= SplitSurface::Snap * longest)
    {
      return this->PathToVertex(mesh.Tail(nearest), context);
    }
    return this->PathInto(place, nearest, context);
  }

  const FramedMesh& Surface;
  const DistanceOptions Options;
  std::unique_ptr<FramedMesh> Split; ///< where sources are no vertices
  std::unique_ptr<VertexConnection> Connection;
  std::unique_ptr<IntrinsicTriangulation> Delaunay;
  std::vector<ShortestPath> Paths;
  std::optional<Vector<double>> Signs; ///< of faces
  std::vector<char> Zeros;             ///< by face, those of a region without signs; or empty
  DistanceField Result;

private:
  /// To a place in a face, which becomes a vertex. \param corner its nearest halfedge.
  SurfacePath PathInto(const NearestPlace& place, int corner, const ExecutionContext& context) const
  {
    const FramedMesh& on = this->On();
    const int tail = on.Mesh.Tail(corner);
    const Complex way = on.Faces.ToComplex(place.Face, place.Position - on.Mesh.Position(tail));
    const Complex side =
      on.Faces.ToComplex(place.Face, on.Mesh.Position(on.Mesh.Head(corner)) - on.Mesh.Position(tail));
    IntrinsicTriangulation flipped = *this->Delaunay;
    const double direction = this->Connection->PolarAngle(corner) + flipped.Stretch(tail) * std::arg(way / side);
    bool isHeld = false;
    const int target = AddVertex(FindPlace(flipped, tail, direction, std::abs(way)), std::arg(way), flipped, isHeld);
    std::vector<ShortestPath> paths = this->Paths;
    paths.push_back(FindPathTo(target, flipped, this->Paths));
    if (isHeld || (!this->Zeros.empty() && this->Zeros[place.Face] != 0)) // at the source
    {
      const int source = paths[target].Source;
      paths[target] = {};
      paths[target].Length = 0.0;
      paths[target].Source = source;
    }
    const Complex inFace =
      on.Faces.ToComplex(place.Face, place.Position - on.Mesh.Position(on.Mesh.Tail(3 * place.Face)));
    return this->PathTo(
      target, this->SignOfFace(place.Face), paths, flipped, { { place.Position, { place.Face, inFace } } }, context);
  }

  /// \param added vertices of the triangulation, after those of the surface.
  SurfacePath PathTo(int target, double sign, const std::vector<ShortestPath>& paths, IntrinsicTriangulation& flipped,
    std::vector<VertexOfPath> added, const ExecutionContext& context) const
  {
    SurfacePath path;
    if (!this->IsReached(paths[target]))
    {
      return path;
    }
    const TriangleMesh& mesh = this->On().Mesh;
    const auto positionOf = [&](int vertex)
    {
      const int number = vertex - mesh.NumberOfVertices();
      return number < 0 ? mesh.Position(vertex) : added[number].Position;
    };
    EdgePath edges = EdgesBeside(paths, target, flipped);
    MakeShortest(edges, flipped, context);
    for (const VertexOnEdge& vertex : MoveStart(edges, flipped, context))
    {
      added.push_back(
        { (1.0 - vertex.Part) * positionOf(vertex.Tail) + vertex.Part * positionOf(vertex.Head), { -1, 0.0 } });
    }
    path.Length = edges.Length(flipped);
    path.Source = paths[target].Source;
    path.Distance = paths[target].IsAtSource() ? 0.0 : sign * paths[target].Length;
    path.Points = TracePath(edges, target, flipped, this->On(), *this->Connection, added);
    return path;
  }

  void SetRegion(const SplitSurface& split, const std::vector<char>& region)
  {
    for (int part = 0; !this->Options.Signed && !region.empty() && part < this->On().Mesh.NumberOfFaces(); ++part)
    {
      this->Zeros.push_back(region[split.OriginOf(part)]);
    }
  }

  void SetSigns(const PlacedSources& placed)
  {
    if (!this->Options.Signed || placed.Taken == 0)
    {
      return;
    }
    if (!placed.HasPoints)
    {
      this->Signs = SignsOf(this->On().Mesh, placed.Split);
    }
    this->Result.IsSigned = this->Signs.has_value();
    if (!this->Signs)
    {
      this->Result.Warnings.emplace_back(placed.HasPoints
          ? "points have no inside, so distances have no sign; give lines or a region alone"
          : "the lines do not part the surface, so distances have no sign; close them, or give a region");
    }
  }

  void SetField()
  {
    const int size = this->Surface.Mesh.NumberOfVertices();
    this->Result.Distances.setConstant(size, std::numeric_limits<double>::quiet_NaN());
    this->Result.Sources.assign(size, -1);
    this->Result.Directions.setZero(size, 3);
    for (int vertex = 0; vertex < size; ++vertex)
    {
      const ShortestPath& path = this->Paths[vertex];
      if (!this->IsReached(path))
      {
        ++this->Result.Unreached;
        continue;
      }
      this->Result.Distances[vertex] = path.IsAtSource() ? 0.0 : this->Sign(vertex) * path.Length;
      this->Result.Sources[vertex] = path.Source;
      this->Result.Largest = std::max(this->Result.Largest, path.Length);
      if (!path.IsAtSource())
      {
        this->Result.Directions.row(vertex) =
          this->On().Vertices.ToVector(vertex, std::polar(1.0, path.Arrival)).transpose();
      }
    }
  }

  mutable std::once_flag HasNearest;
  mutable std::unique_ptr<NearestPlaces> Nearest; ///< once a path was asked for
};

SurfaceDistance::SurfaceDistance(const FramedMesh& surface, const DistanceSources& sources,
  const DistanceOptions& options, const ExecutionContext& context)
{
  CheckSources(surface, sources, options);
  this->Internal = std::make_unique<Internals>(surface, sources, options, context);
}

SurfaceDistance::~SurfaceDistance() = default;

SurfaceDistance::SurfaceDistance(SurfaceDistance&&) noexcept = default;

const DistanceField& SurfaceDistance::Field() const
{
  return this->Internal->Result;
}

SurfacePath SurfaceDistance::PathTo(int vertex, const ExecutionContext& context) const
{
  RequireElement(vertex, this->Internal->Surface.Mesh.NumberOfVertices(), "vertex");
  return this->Internal->PathToVertex(vertex, context);
}

SurfacePath SurfaceDistance::PathTo(const Vector3& point, const ExecutionContext& context) const
{
  CheckPosition(point, "a target");
  return this->Internal->PathToPlace(point, context);
}

long long SurfaceDistance::Bytes() const
{
  const Internals& of = *this->Internal;
  constexpr long long OfHalfedge = 2 * sizeof(int) + 2 * sizeof(double) + 1;
  const long long ofMesh = of.Split ? static_cast<long long>(sizeof(double)) * 40 * of.Split->Mesh.NumberOfFaces() : 0;
  return ofMesh + OfHalfedge * of.Delaunay->NumberOfHalfedges() +
    static_cast<long long>(sizeof(ShortestPath) * of.Paths.size());
}

ContourLines SurfaceDistance::OffsetLines(std::vector<double> distances, const ExecutionContext& context) const
{
  const Internals& of = *this->Internal;
  for (const double distance : distances)
  {
    if (!std::isfinite(distance) || std::abs(distance) > of.Options.MaximumDistance)
    {
      throw InvalidInput("there is no offset line at the distance " + ShortText(distance) +
        "; give numbers up to the maximum distance, which is " + ShortText(of.Options.MaximumDistance));
    }
  }
  std::sort(distances.begin(), distances.end());
  const TriangleMesh& mesh = of.On().Mesh;
  Vector<double> lengths(mesh.NumberOfVertices());
  for (int vertex = 0; vertex < lengths.size(); ++vertex)
  {
    lengths[vertex] = of.Sign(vertex) * of.Paths[vertex].Length;
  }
  return FindContourLines(mesh, mesh.VertexPositions(), lengths, distances, FindSides(mesh), context);
}

}
