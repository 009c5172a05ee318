#include "Geodesics/PlacedSources.h"

#include "Constraints/SurfaceFeatures.h"
#include "Places/NearestPlaces.h"
#include "Support/Errors.h"

#include <algorithm>
#include <cmath>

namespace dmg
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

void CheckSources(const FramedMesh& surface, const DistanceSources& sources, const DistanceOptions& options)
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

PlacedSources::PlacedSources(const FramedMesh& surface, const DistanceSources& sources, const DistanceOptions& options,
  const ExecutionContext& context)
  : Split(surface)
  , Surface(surface)
  , Sources(sources)
  , Options(options)
{
  this->AddElements();
  context.Checkpoint(0.1);
  if (!sources.Points.empty() || !sources.Lines.empty())
  {
    this->AddPlaces(PartOfContext(context, 0.1, 1.0));
  }
}

std::vector<PathStart> PlacedSources::StartsOn(const TriangleMesh& split) const
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

int PlacedSources::NumberOfRegion() const
{
  return static_cast<int>(this->Sources.Vertices.size() + this->Sources.Points.size() + this->Sources.Lines.size());
}

void PlacedSources::AddStart(int vertex, int source)
{
  this->Starts.push_back({ vertex, source });
  this->HasPoints = true;
  ++this->Taken;
}

/// Vertices, the region, the boundary and sharp edges: no face is split for them.
void PlacedSources::AddElements()
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
void PlacedSources::AddRegion(int number)
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

void PlacedSources::AddPlaces(const ExecutionContext& context)
{
  const NearestPlaces nearest(this->Surface);
  const double maximum = this->Options.MaximumSourceDistance * nearest.Sizes.Diagonal();
  const auto vertexOf = [&](const Vector3& point)
  {
    const NearestPlace place = nearest(point);
    return place.Face >= 0 && place.Distance <= maximum ? this->Split.AddPoint(place.Face, place.Position) : -1;
  };
  this->All = this->Sources.Points.size();
  for (const std::vector<Vector3>& line : this->Sources.Lines)
  {
    this->All += line.size();
  }
  int number = static_cast<int>(this->Sources.Vertices.size());
  for (const Vector3& point : this->Sources.Points)
  {
    const int vertex = vertexOf(point);
    if (vertex >= 0)
    {
      this->AddStart(vertex, number);
    }
    this->TooFar += vertex < 0 ? 1 : 0;
    ++number;
    this->Advance(1.0, context);
  }
  const SegmentOnSurface segments(nearest, maximum);
  const SidesOfSurface sides = this->Options.Signed ? FindSides(this->Surface.Mesh) : SidesOfSurface();
  for (const std::vector<Vector3>& line : this->Sources.Lines)
  {
    this->AddLine(line, number++, segments, sides, context);
  }
}

/// Places, and sides of lines, are done, or a part of one.
void PlacedSources::Advance(double places, const ExecutionContext& context)
{
  constexpr int Interval = 16;
  this->Done += places;
  if (this->Steps++ % Interval == 0)
  {
    context.Checkpoint(std::min(this->Done / static_cast<double>(this->All), 1.0));
  }
}

void PlacedSources::AddLine(const std::vector<Vector3>& points, int number, const SegmentOnSurface& segments,
  const SidesOfSurface& sides, const ExecutionContext& context)
{
  End end;
  bool isTaken = false;
  for (std::size_t k = 0; k + 1 < points.size(); ++k)
  {
    int missed = 0;
    const std::vector<SegmentPart> parts = segments.PartsOf(points[k], points[k + 1]);
    for (const SegmentPart& part : parts)
    {
      this->Advance(1.0 / static_cast<double>(parts.size()), context);
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
bool PlacedSources::AddPart(const SegmentPart& part, const Line& line, End& end)
{
  const auto add = [&](const Vector3& position)
  {
    const Vector3 place = ClosestOnFace(this->Surface.Mesh, part.Face, position).Position;
    return this->Split.AddPoint(part.Face, place);
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

}
