#include "Geodesics/SurfaceDistance.h"

#include "Geodesics/EdgePath.h"
#include "Geodesics/IntrinsicTriangulation.h"
#include "Geodesics/PlacedSources.h"
#include "Geodesics/ShortestPaths.h"
#include "Geodesics/SignsOfLines.h"
#include "Geodesics/WavefrontPaths.h"
#include "Mesh/PositiveSide.h"
#include "Mesh/VertexConnection.h"
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
    EdgePath edges = EdgesBeside(this->Paths, target, *this->Delaunay);
    MakeShortest(edges, flipped, context);
    path.Length = edges.Length(flipped);
    path.Source = this->Paths[target].Source;
    path.Points = TracePath(edges, target, flipped, this->On(), *this->Connection);
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
