#include "Geodesics/SurfaceDistance.h"

#include "Constraints/NearestPlaces.h"
#include "Constraints/SegmentOnSurface.h"
#include "Constraints/SurfaceFeatures.h"
#include "Drawing/UnfoldedSurface.h"
#include "Geodesics/EdgePath.h"
#include "Geodesics/HalfedgeFans.h"
#include "Geodesics/IntrinsicTriangulation.h"
#include "Geodesics/ShortestPaths.h"
#include "Geodesics/SplitSurface.h"
#include "Mesh/PositiveSide.h"
#include "Mesh/VertexConnection.h"
#include "Support/DisjointSets.h"
#include "Support/Errors.h"
#include "Support/Remedy.h"
#include "Support/ShortText.h"

#include <algorithm>
#include <cmath>
#include <optional>
#include <utility>

namespace dmg
{
namespace
{

void RequireElement(int element, int size, const std::string& name)
{
  if (element < 0 || element >= size)
  {
    throw InvalidInput("there is no " + name + " " + std::to_string(element) + ", but there are " +
      std::to_string(size) + ", from 0 on; leave it out");
  }
}

void CheckPosition(const Vector3& position, const std::string& name)
{
  if (!position.allFinite())
  {
    throw InvalidInput("a coordinate of " + name + " is not finite; leave the point out");
  }
}

void Check(const FramedMesh& surface, const DistanceSources& sources, const DistanceOptions& options)
{
  for (const int vertex : sources.Vertices)
  {
    RequireElement(vertex, surface.Mesh.NumberOfVertices(), "vertex");
  }
  for (std::size_t k = 0; k < sources.Points.size(); ++k)
  {
    CheckPosition(sources.Points[k], "source point " + std::to_string(k));
  }
  for (std::size_t k = 0; k < sources.Lines.size(); ++k)
  {
    for (const Vector3& point : sources.Lines[k])
    {
      CheckPosition(point, "source line " + std::to_string(k));
    }
  }
  for (std::size_t k = 0; k < options.Targets.size(); ++k)
  {
    CheckPosition(options.Targets[k], "target " + std::to_string(k));
  }
  if (!sources.Region.empty() && static_cast<int>(sources.Region.size()) != surface.Mesh.NumberOfFaces())
  {
    throw InvalidInput("the region has " + std::to_string(sources.Region.size()) + " entries for " +
      std::to_string(surface.Mesh.NumberOfFaces()) + " faces; give one for each face, or none");
  }
  if (!(options.MaximumDistance >= 0.0) || !(options.MaximumSourceDistance >= 0.0) || !(sources.FeatureAngle >= 0.0))
  {
    throw InvalidInput("a maximum distance or the feature angle is negative or not a number; give 0 or more");
  }
}

/// Sources as lines and vertices of a surface that is split for them.
class PlacedSources
{
public:
  PlacedSources(const FramedMesh& surface, const DistanceSources& sources, const DistanceOptions& options,
    const ExecutionContext& context)
    : Split(surface)
    , Surface(surface)
    , Sources(sources)
    , Options(options)
  {
    this->AddElements();
    context.Checkpoint(0.1);
    if (!sources.Points.empty() || !sources.Lines.empty() || !options.Targets.empty())
    {
      this->AddPlaces(context);
    }
  }

  /// The vertices at distance 0; those of lines are among them.
  std::vector<PathStart> StartsOn(const TriangleMesh& split) const
  {
    std::vector<PathStart> starts = this->Starts;
    for (int h = 0; h < 3 * split.NumberOfFaces(); ++h)
    {
      if (const int line = this->Split.Lines()[h]; line >= 0)
      {
        starts.push_back({ split.Tail(h), line });
        starts.push_back({ split.Head(h), line });
      }
    }
    return starts;
  }

  SplitSurface Split;
  std::vector<int> Targets; ///< vertices; -1 where one is too far away
  int Taken = 0;
  int TooFar = 0;
  int Interrupted = 0;
  bool HasPoints = false;

private:
  using Line = SplitSurface::Line;
  using InsideOfLine = SplitSurface::InsideOfLine;

  int NumberOfRegion() const
  {
    return static_cast<int>(this->Sources.Vertices.size() + this->Sources.Points.size() + this->Sources.Lines.size());
  }

  void AddStart(int vertex, int source)
  {
    this->Starts.push_back({ vertex, source });
    this->HasPoints = true;
    ++this->Taken;
  }

  /// Vertices, the region, the boundary and sharp edges: no face is split for them.
  void AddElements()
  {
    for (std::size_t k = 0; k < this->Sources.Vertices.size(); ++k)
    {
      this->AddStart(this->Sources.Vertices[k], static_cast<int>(k));
    }
    this->AddRegion(this->NumberOfRegion());
    const TriangleMesh& mesh = this->Surface.Mesh;
    const auto addLine = [&](int h, int number) { this->Split.AddLine(h, { number }); };
    int sides = 0;
    for (int h = 0; this->Sources.Boundary && h < 3 * mesh.NumberOfFaces(); ++h)
    {
      if (mesh.Twin(h) < 0)
      {
        addLine(h, this->NumberOfRegion() + 1);
        ++sides;
      }
    }
    this->Taken += sides > 0 ? 1 : 0;
    if (this->Sources.FeatureAngle > 0.0)
    {
      const WeightsOfFaces weights(mesh, SizesOf(mesh));
      const auto sharp = AlongSharpEdges(this->Surface, weights, this->Sources.FeatureAngle, 1.0);
      for (const Constraint& edge : sharp)
      {
        addLine(3 * edge.Element + edge.Side, this->NumberOfRegion() + 2);
      }
      this->Taken += sharp.empty() ? 0 : 1;
    }
  }

  /// Its outline is a line; with signs, distances inside count from there, and else they are 0.
  void AddRegion(int number)
  {
    const TriangleMesh& mesh = this->Surface.Mesh;
    const std::vector<char>& region = this->Sources.Region;
    int faces = 0;
    for (int face = 0; face < static_cast<int>(region.size()); ++face)
    {
      for (int h = 3 * face; region[face] != 0 && h < 3 * face + 3; ++h)
      {
        const int twin = mesh.Twin(h);
        if (twin >= 0 && region[TriangleMesh::FaceOf(twin)] == 0)
        {
          this->Split.AddLine(h, { number, InsideOfLine::Left });
        }
        if (!this->Options.Signed)
        {
          this->Starts.push_back({ mesh.Tail(h), number });
        }
      }
      faces += region[face] != 0 ? 1 : 0;
    }
    this->Taken += faces > 0 ? 1 : 0;
  }

  void AddPlaces(const ExecutionContext& context)
  {
    const NearestPlaces nearest(this->Surface);
    const double maximum = this->Options.MaximumSourceDistance * nearest.Sizes.Diagonal();
    const auto vertexOf = [&](const Vector3& point)
    {
      const NearestPlace place = nearest(point);
      return place.Face >= 0 && place.Distance <= maximum ? this->Split.AddPoint(place.Face, place.Position) : -1;
    };
    int number = static_cast<int>(this->Sources.Vertices.size());
    constexpr int Interval = 1024;
    for (const Vector3& point : this->Sources.Points)
    {
      if (number % Interval == 0)
      {
        context.Checkpoint(0.1);
      }
      const int vertex = vertexOf(point);
      if (vertex >= 0)
      {
        this->AddStart(vertex, number);
      }
      this->TooFar += vertex < 0 ? 1 : 0;
      ++number;
    }
    for (const Vector3& point : this->Options.Targets)
    {
      if (this->Targets.size() % Interval == 0)
      {
        context.Checkpoint(0.2);
      }
      this->Targets.push_back(vertexOf(point));
    }
    const SegmentOnSurface segments(nearest, maximum);
    const SidesOfSurface sides = this->Options.Signed ? FindSides(this->Surface.Mesh) : SidesOfSurface();
    for (const std::vector<Vector3>& line : this->Sources.Lines)
    {
      this->AddLine(line, number++, segments, sides, context);
    }
  }

  /// The end of what has been added of a line.
  struct End
  {
    int Vertex = -1;
    int Face = -1;
    Vector3 PartStart = Vector3::Zero(); ///< of the last part
  };

  void AddLine(const std::vector<Vector3>& points, int number, const SegmentOnSurface& segments,
    const SidesOfSurface& sides, const ExecutionContext& context)
  {
    End end;
    bool isTaken = false;
    for (std::size_t k = 0; k + 1 < points.size(); ++k)
    {
      context.Checkpoint(0.3);
      int missed = 0;
      for (const SegmentPart& part : segments.PartsOf(points[k], points[k + 1]))
      {
        // A part along an edge comes twice, for both of its faces.
        if (part.Kind == SegmentPart::OnSurface && !(end.Face >= 0 && part.Start == end.PartStart))
        {
          const bool isLeft = sides.OfFaces.size() == 0 || sides.OfFaces[part.Face] > 0.0;
          isTaken |= this->AddPart(part, { number, isLeft ? InsideOfLine::Left : InsideOfLine::Right }, end);
        }
        else if (part.Kind != SegmentPart::OnSurface)
        {
          end = {};
          missed = 1;
        }
      }
      this->TooFar += missed;
    }
    this->Taken += isTaken ? 1 : 0;
  }

  /// \return whether it has a length.
  bool AddPart(const SegmentPart& part, const Line& line, End& end)
  {
    const auto add = [&](const Vector3& position)
    {
      const Vector3 place = ClosestOnFace(this->Surface.Mesh, part.Face, position).Position;
      return this->Split.AddPoint(part.Face, place, SplitSurface::SnapOfLines);
    };
    const int start = add(part.Start);
    const int last = add(part.End);
    if (end.Vertex >= 0 && end.Vertex != start)
    {
      this->Interrupted += this->Split.AddLine(end.Vertex, end.Face, start, part.Face, line) ? 0 : 1;
    }
    this->Interrupted += this->Split.AddLine(start, part.Face, last, part.Face, line) ? 0 : 1;
    end = { last, part.Face, part.Start };
    return start != last;
  }

  const FramedMesh& Surface;
  const DistanceSources& Sources;
  const DistanceOptions& Options;
  std::vector<PathStart> Starts; ///< but for those of lines
};

/// The sign of each vertex: -1 inside of the lines, 1 elsewhere; nothing where lines do not part the surface, or where there are none.
std::optional<Vector<double>> SignsOf(const TriangleMesh& mesh, const SplitSurface& split)
{
  const int faces = mesh.NumberOfFaces();
  DisjointSets parts(faces);
  for (int h = 0; h < 3 * faces; ++h)
  {
    if (mesh.Twin(h) >= 0 && split.SideOf(h) == SplitSurface::Unknown)
    {
      parts.Unite(TriangleMesh::FaceOf(h), TriangleMesh::FaceOf(mesh.Twin(h)));
    }
  }
  std::vector<char> sides(faces, SplitSurface::Unknown); // by part
  bool isAny = false;
  for (int h = 0; h < 3 * faces; ++h)
  {
    sides[parts.Smallest(TriangleMesh::FaceOf(h))] |= split.SideOf(h);
    isAny |= split.SideOf(h) != SplitSurface::Unknown;
  }
  if (!isAny || std::count(sides.begin(), sides.end(), SplitSurface::Both) > 0)
  {
    return {};
  }
  Vector<double> signs(mesh.NumberOfVertices());
  for (int vertex = 0; vertex < signs.size(); ++vertex)
  {
    const int part = parts.Smallest(TriangleMesh::FaceOf(mesh.OutgoingHalfedge(vertex)));
    signs[vertex] = sides[part] == SplitSurface::Inside ? -1.0 : 1.0;
  }
  return signs;
}

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
    , MaximumDistance(options.MaximumDistance)
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
    this->Targets = placed.Targets;
    this->Result.Taken = placed.Taken;
    this->Result.TooFar = placed.TooFar;
    this->Result.Interrupted = placed.Interrupted;
    if (placed.Interrupted > 0)
    {
      this->Result.Warnings.push_back("lines have " + std::to_string(placed.Interrupted) +
        " gaps where they leap from one part of the surface to another; draw them nearer to it, with more points");
    }
    if (starts.empty())
    {
      throw InvalidInput(placed.TooFar > 0
          ? "all sources are too far from the surface; move them nearer, or raise " + TextOf(Remedy::MaximumDistance)
          : std::string("there is no source of distances; give a point, a line, a region or the boundary"));
    }
    this->Paths = FindShortestPaths(*this->Delaunay, starts, options.MaximumDistance, PartOfContext(context, 0.6, 1.0));
    this->SetSigns(placed, options);
    this->SetField();
    context.Checkpoint(1.0);
  }

  const FramedMesh& On() const { return this->Split ? *this->Split : this->Surface; }
  bool IsReached(int vertex) const
  {
    return this->Paths[vertex].IsAny() && this->Paths[vertex].Length <= this->MaximumDistance;
  }
  double Sign(int vertex) const { return this->Signs ? (*this->Signs)[vertex] : 1.0; }

  SurfacePath PathTo(int target, const ExecutionContext& context) const
  {
    SurfacePath path;
    if (target < 0 || !this->IsReached(target))
    {
      return path;
    }
    IntrinsicTriangulation flipped = *this->Delaunay;
    EdgePath edges = this->EdgesTo(target);
    MakeShortest(edges, flipped, context);
    path.Length = edges.Length(flipped);
    path.Source = this->Paths[target].Source;
    const UnfoldedSurface unfolded(this->On().Mesh, this->On().Faces);
    path.Points.push_back(
      this->On().Mesh.Position(edges.Steps.empty() ? target : TailOf(edges.Steps.front(), flipped)));
    for (const EdgePath::Step& step : edges.Steps)
    {
      this->Trace(step, flipped, unfolded, path.Points);
    }
    return path;
  }

  const FramedMesh& Surface;
  const double MaximumDistance;
  std::unique_ptr<FramedMesh> Split; ///< where sources or targets are no vertices
  std::unique_ptr<VertexConnection> Connection;
  std::unique_ptr<IntrinsicTriangulation> Delaunay;
  std::vector<int> Targets;
  std::vector<ShortestPath> Paths;
  std::optional<Vector<double>> Signs;
  DistanceField Result;

private:
  void SetSigns(const PlacedSources& placed, const DistanceOptions& options)
  {
    if (!options.Signed)
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
      if (!this->IsReached(vertex))
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

  /// The way of the wavefront, along edges beside it.
  EdgePath EdgesTo(int target) const
  {
    const HalfedgeFans fans(*this->Delaunay);
    EdgePath path;
    int vertex = target;
    for (std::size_t step = 0; !this->Paths[vertex].IsAtSource(); ++step)
    {
      const int parent = this->Paths[vertex].Parents[0];
      if (step > this->Paths.size())
      {
        throw UnexpectedFailure("the path to vertex " + std::to_string(target) + " leads in a circle");
      }
      path.Steps.push_back(this->EdgeBetween(parent, vertex, fans));
      vertex = parent;
    }
    std::reverse(path.Steps.begin(), path.Steps.end());
    return path;
  }

  /// The shortest of the edges between two neighbours.
  EdgePath::Step EdgeBetween(int tail, int head, const HalfedgeFans& fans) const
  {
    const IntrinsicTriangulation& surface = *this->Delaunay;
    EdgePath::Step edge{ -1, -1 };
    double shortest = std::numeric_limits<double>::infinity();
    const auto compare = [&](int h, bool isAlong)
    {
      if (surface.Length(h) < shortest)
      {
        shortest = surface.Length(h);
        edge = isAlong ? EdgePath::Step{ h, surface.Twin(h) } : EdgePath::Step{ surface.Twin(h), h };
      }
    };
    fans.VisitFan(tail,
      [&](int h)
      {
        if (surface.Head(h) == head)
        {
          compare(h, true);
        }
        const int back = TriangleMesh::Previous(h);
        if (surface.Tail(back) == head)
        {
          compare(back, false);
        }
      });
    return edge;
  }

  static int TailOf(const EdgePath::Step& step, const IntrinsicTriangulation& surface)
  {
    return step.Along >= 0 ? surface.Tail(step.Along) : surface.Head(step.Against);
  }

  /// Appends the places where an edge crosses those of the surface, and its end.
  void Trace(const EdgePath::Step& step, const IntrinsicTriangulation& flipped, const UnfoldedSurface& unfolded,
    std::vector<Vector3>& points) const
  {
    const int h = step.Along >= 0 ? step.Along : step.Against;
    std::vector<Vector3> crossings = this->Crossings(h, flipped, unfolded);
    if (step.Along < 0)
    {
      std::reverse(crossings.begin(), crossings.end());
    }
    points.insert(points.end(), crossings.begin(), crossings.end());
    points.push_back(this->On().Mesh.Position(step.Along >= 0 ? flipped.Head(h) : flipped.Tail(h)));
  }

  std::vector<Vector3> Crossings(
    int halfedge, const IntrinsicTriangulation& flipped, const UnfoldedSurface& unfolded) const
  {
    constexpr double Rounding = 1e-7;
    const TriangleMesh& mesh = this->On().Mesh;
    const int tail = flipped.Tail(halfedge), head = flipped.Head(halfedge);
    int start = -1;
    double turn = 0.0, leastBeyond = std::numeric_limits<double>::infinity();
    bool isEdge = false;
    mesh.VisitFan(tail,
      [&](int h)
      {
        const double full = 2.0 * Pi;
        const double from = std::fmod(
          std::fmod(flipped.Direction(halfedge) - this->Connection->PolarAngle(h) + Rounding, full) + full, full);
        const double beyond = from - this->Connection->CornerAngle(h);
        if (beyond < leastBeyond)
        {
          leastBeyond = beyond;
          start = h;
          turn = std::clamp(from - Rounding, 0.0, this->Connection->CornerAngle(h));
        }
        isEdge |= mesh.Head(h) == head && from <= 2.0 * Rounding;
        isEdge |= mesh.Tail(TriangleMesh::Previous(h)) == head && std::abs(beyond - Rounding) <= Rounding;
      });
    std::vector<Vector3> crossings;
    if (!isEdge)
    {
      SurfacePoint at{ TriangleMesh::FaceOf(start), unfolded.Corner(start) };
      Complex direction = unfolded.Side(start) * std::polar(1.0, turn / flipped.Stretch(tail));
      const double length = (1.0 - Rounding) * flipped.Length(halfedge); // no side beyond the head is crossed
      unfolded.GoStraight(at, direction, length, &crossings);
    }
    return crossings;
  }
};

SurfaceDistance::SurfaceDistance(const FramedMesh& surface, const DistanceSources& sources,
  const DistanceOptions& options, const ExecutionContext& context)
{
  Check(surface, sources, options);
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
  return this->Internal->PathTo(vertex, context);
}

SurfacePath SurfaceDistance::PathToTarget(int target, const ExecutionContext& context) const
{
  RequireElement(target, static_cast<int>(this->Internal->Targets.size()), "target");
  return this->Internal->PathTo(this->Internal->Targets[target], context);
}

ContourLines SurfaceDistance::OffsetLines(std::vector<double> distances, const ExecutionContext& context) const
{
  const Internals& of = *this->Internal;
  for (const double distance : distances)
  {
    if (!std::isfinite(distance) || std::abs(distance) > of.MaximumDistance)
    {
      throw InvalidInput("there is no offset line at the distance " + ShortText(distance) +
        "; give numbers up to the maximum distance, which is " + ShortText(of.MaximumDistance));
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
