#include "Quads/SymmetricQuads.h"

#include "Places/NearestPlaces.h"
#include "Quads/Isolines/CellPlaces.h"
#include "Quads/LengthsOfEdges.h"
#include "Quads/QuadMeasures.h"
#include "Quads/SizesOfQuads.h"
#include "Quads/SurfaceQuads.h"
#include "Support/Errors.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <map>
#include <utility>

namespace dmg
{

namespace
{

/// Vertices that are nearer to the plane, relative to the shortest edge around them, are moved into it, so that the cut leaves no slivers.
constexpr double NearInEdges = 0.02;

/// The distance of each vertex from the plane, 0 for those that are moved into it.
Vector<double> DistancesFrom(const TriangleMesh& mesh, const MirrorPlane& plane)
{
  Vector<double> shortest = Vector<double>::Constant(mesh.NumberOfVertices(), std::numeric_limits<double>::infinity());
  for (int edge = 0; edge < mesh.NumberOfEdges(); ++edge)
  {
    const auto [a, b] = mesh.EdgeVertices(edge);
    const double length = (mesh.Position(a) - mesh.Position(b)).norm();
    shortest[a] = std::min(shortest[a], length);
    shortest[b] = std::min(shortest[b], length);
  }
  Vector<double> distances(mesh.NumberOfVertices());
  for (int vertex = 0; vertex < distances.size(); ++vertex)
  {
    const double distance = plane.DistanceOf(mesh.Position(vertex));
    distances[vertex] = std::abs(distance) <= NearInEdges * shortest[vertex] ? 0.0 : distance;
  }
  return distances;
}

/// Cuts the faces of a surface at a plane, and keeps the parts on the side of its normal.
class Cutting
{
public:
  Cutting(const TriangleMesh& mesh, const MirrorPlane& plane)
    : Mesh(mesh)
    , Plane(plane)
    , Distances(DistancesFrom(mesh, plane))
    , NumbersOfVertices(mesh.NumberOfVertices(), -1)
    , NumbersOfEdges(mesh.NumberOfEdges(), -1)
  {
  }

  /// \return whether no face lies in the plane.
  bool Cut()
  {
    for (int face = 0; face < this->Mesh.NumberOfFaces(); ++face)
    {
      const auto distance = [this, face](int k) { return this->Distances[this->Mesh.Tail(3 * face + k)]; };
      const double largest = std::max({ distance(0), distance(1), distance(2) });
      if (largest > 0.0)
      {
        this->Keep(face);
      }
      else if (distance(0) == 0.0 && distance(1) == 0.0 && distance(2) == 0.0)
      {
        return false;
      }
    }
    return true;
  }

  bool IsEmpty() const { return this->Parts.empty(); }

  std::shared_ptr<const FinerSurface> Result(const ExecutionContext& context) const
  {
    return SurfaceOfParts(this->Positions, this->NearVertices, this->Parts, context);
  }

private:
  /// A corner of the part of a face.
  struct Corner
  {
    int Vertex;
    Vector3 Weights;
  };

  int Add(const Vector3& position, int near)
  {
    this->Positions.push_back(position);
    this->NearVertices.push_back(near);
    return static_cast<int>(this->Positions.size()) - 1;
  }

  Corner AtVertex(int h)
  {
    const int vertex = this->Mesh.Tail(h);
    int& number = this->NumbersOfVertices[vertex];
    if (number < 0)
    {
      const Vector3 position = this->Mesh.Position(vertex);
      const bool isInPlane = this->Distances[vertex] == 0.0;
      number = this->Add(
        isInPlane ? Vector3(position - this->Plane.DistanceOf(position) * this->Plane.Normal) : position, vertex);
    }
    return { number, Vector3::Unit(h % 3) };
  }

  Corner OnEdge(int h)
  {
    const int edge = this->Mesh.EdgeOf(h), tail = this->Mesh.Tail(h), head = this->Mesh.Head(h);
    const double t = this->Distances[tail] / (this->Distances[tail] - this->Distances[head]);
    int& number = this->NumbersOfEdges[edge];
    if (number < 0)
    {
      const Vector3 position = (1.0 - t) * this->Mesh.Position(tail) + t * this->Mesh.Position(head);
      number = this->Add(position - this->Plane.DistanceOf(position) * this->Plane.Normal, std::min(tail, head));
    }
    return { number, (1.0 - t) * Vector3::Unit(h % 3) + t * Vector3::Unit((h + 1) % 3) };
  }

  void Keep(int face)
  {
    std::vector<Corner> corners;
    for (int h = 3 * face; h < 3 * face + 3; ++h)
    {
      const double here = this->Distances[this->Mesh.Tail(h)], next = this->Distances[this->Mesh.Head(h)];
      if (here >= 0.0)
      {
        corners.push_back(this->AtVertex(h));
      }
      if ((here > 0.0 && next < 0.0) || (here < 0.0 && next > 0.0))
      {
        corners.push_back(this->OnEdge(h));
      }
    }
    const auto add = [&](int a, int b, int c)
    {
      PartOfFace part{ { corners[a].Vertex, corners[b].Vertex, corners[c].Vertex }, face, {} };
      part.Corners << corners[a].Weights, corners[b].Weights, corners[c].Weights;
      this->Parts.push_back(part);
    };
    const auto length = [&](int a, int b)
    { return (this->Positions[corners[a].Vertex] - this->Positions[corners[b].Vertex]).norm(); };
    if (corners.size() == 3)
    {
      add(0, 1, 2);
    }
    else
    {
      const int first = length(0, 2) <= length(1, 3) ? 0 : 1; // the shorter diagonal starts here
      add(first, first + 1, first + 2);
      add(first, first + 2, (first + 3) % 4);
    }
  }

  const TriangleMesh& Mesh;
  const MirrorPlane& Plane;
  const Vector<double> Distances;
  std::vector<int> NumbersOfVertices, NumbersOfEdges; ///< of the half, -1 before there is one
  std::vector<Vector3> Positions;
  std::vector<int> NearVertices;
  std::vector<PartOfFace> Parts;
};

QuadOptions OptionsOfHalf(const QuadOptions& options, const FinerSurface& half)
{
  QuadOptions ofHalf = OptionsOf(options, half);
  ofHalf.NumberOfQuads = std::max(1.0, 0.5 * options.NumberOfQuads);
  ofHalf.AlignBoundary = true;
  return ofHalf;
}

/// A part of a part of the surface as a part of the surface.
std::shared_ptr<const FinerSurface> Composed(
  const std::shared_ptr<const FinerSurface>& half, const std::shared_ptr<const FinerSurface>& finer)
{
  if (!finer)
  {
    return half;
  }
  auto both = std::make_shared<FinerSurface>(*finer);
  for (std::size_t face = 0; face < both->Parents.size(); ++face)
  {
    const int part = both->Parents[face];
    both->Parents[face] = half->Parents[part];
    both->Corners[face] = half->Corners[part] * both->Corners[face];
  }
  for (int& vertex : both->NearVertices)
  {
    vertex = half->NearVertices[vertex];
  }
  return both;
}

/// Joins a mesh of the half and its mirror image at the vertices in the plane.
void AddMirrorImage(const MirrorPlane& plane, const NearestPlaces& surface, QuadMesh& mesh)
{
  const int halfVertices = static_cast<int>(mesh.Places.size()), halfQuads = static_cast<int>(mesh.Quads.size());
  const double tolerance = 1e-7 * surface.Sizes.Diagonal();
  std::vector<int> images(halfVertices);
  int vertices = halfVertices;
  for (int vertex = 0; vertex < halfVertices; ++vertex)
  {
    const Vector3 position = mesh.Positions.row(vertex).transpose();
    const bool isInPlane = mesh.IsOnBoundary[vertex] && std::abs(plane.DistanceOf(position)) <= tolerance;
    images[vertex] = isInPlane ? vertex : vertices++;
    if (isInPlane)
    {
      mesh.Positions.row(vertex) -= plane.DistanceOf(position) * plane.Normal.transpose();
    }
  }
  mesh.Positions.conservativeResize(vertices, 3);
  for (int vertex = 0; vertex < halfVertices; ++vertex)
  {
    if (images[vertex] != vertex)
    {
      const Vector3 position = plane.Mirrored(mesh.Positions.row(vertex).transpose());
      const NearestPlace nearest = surface(position);
      mesh.Positions.row(images[vertex]) = position.transpose();
      mesh.Places.push_back(PlaceInFace(surface.Surface.Mesh, nearest.Face, nearest.Position));
      mesh.Singularities.push_back(mesh.Singularities[vertex]);
    }
  }
  for (int quad = 0; quad < halfQuads; ++quad)
  {
    const std::array<int, 4> given = mesh.Quads[quad];
    mesh.Quads.push_back({ images[given[0]], images[given[3]], images[given[2]], images[given[1]] });
    Vector3 middle = Vector3::Zero();
    for (const int corner : mesh.Quads.back())
    {
      middle += 0.25 * mesh.Positions.row(corner).transpose();
    }
    mesh.Faces.push_back(surface(middle).Face);
  }
}

bool IsManifold(const QuadTopology& topology)
{
  return topology.Repeated.empty() && topology.TwiceInQuad.empty() &&
    std::all_of(topology.Fans.begin(), topology.Fans.end(), [](int fans) { return fans <= 1; });
}

void TakeTopology(const QuadTopology& topology, QuadMesh& mesh)
{
  mesh.Valences = topology.Valences;
  mesh.IsOnBoundary.assign(mesh.Places.size(), 0);
  for (std::size_t side = 0; side < topology.Twins.size(); ++side)
  {
    if (topology.Twins[side] < 0)
    {
      const std::array<int, 4>& quad = mesh.Quads[side / 4];
      mesh.IsOnBoundary[quad[side % 4]] = 1;
      mesh.IsOnBoundary[quad[(side + 1) % 4]] = 1;
    }
  }
}

QuadMesh MadeOf(const FramedMesh& surface, const std::optional<Vector<Complex>>& powers, const QuadOptions& options,
  const ExecutionContext& context, const ElementNames& names)
{
  return powers ? MakeQuadsAcrossGaps(surface, *powers, options, context, names)
                : MakeQuadsAlongFeatures(surface, options, context, names);
}

/// Gives the quads of the half places and faces of the surface.
void TakeToSurface(const std::shared_ptr<const FinerSurface>& half, QuadMesh& mesh)
{
  mesh.Finer = Composed(half, mesh.Finer);
  const auto toParent = [&half](int& face) { face = half->Parents[face]; };
  std::for_each(mesh.Faces.begin(), mesh.Faces.end(), toParent);
  std::for_each(mesh.Report.RefinedFaces.begin(), mesh.Report.RefinedFaces.end(), toParent);
  std::for_each(mesh.Report.AgainstField.begin(), mesh.Report.AgainstField.end(),
    [&half](int& halfedge) { halfedge = half->HalfedgeOfParent(halfedge); });
  for (SurfacePlace& place : mesh.Places)
  {
    place = half->InParent(place);
  }
}

}

std::shared_ptr<const FinerSurface> HalfOf(
  const FramedMesh& surface, const MirrorPlane& plane, const ExecutionContext& context)
{
  Cutting cutting(surface.Mesh, plane);
  if (!cutting.Cut() || cutting.IsEmpty())
  {
    return nullptr;
  }
  try
  {
    return cutting.Result(context);
  }
  catch (const InvalidInput&) // a vertex with two fans
  {
    return nullptr;
  }
}

QuadMesh MakeSymmetricQuads(const FramedMesh& surface, const std::optional<Vector<Complex>>& powers,
  const std::optional<MirrorPlane>& given, const QuadOptions& asked, const ExecutionContext& context,
  const ElementNames& names)
{
  const QuadOptions options = WithSizesAlone(surface, asked, names, PartOfContext(context, 0.0, 0.0));
  const NearestPlaces places(surface);
  const MirrorPlane plane = given ? *given : FindMirrorPlane(places);
  const double asymmetry = AsymmetryOf(places, plane);
  const std::shared_ptr<const FinerSurface> half =
    asymmetry <= LargestAsymmetry ? HalfOf(surface, plane, context) : nullptr;
  QuadMesh mesh = half ? MadeOf(half->Geometry, powers ? half->PowersOf(surface, *powers) : powers,
                           OptionsOfHalf(options, *half), PartOfContext(context, 0.05, 0.9), half->NamesOf(names))
                       : MadeOf(surface, powers, options, PartOfContext(context, 0.05, 1.0), names);
  mesh.Report.Asymmetry = asymmetry;
  if (!half)
  {
    return mesh;
  }
  TakeToSurface(half, mesh);
  if (!mesh.Report.Error.empty())
  {
    return mesh;
  }
  AddMirrorImage(plane, places, mesh);
  const QuadTopology topology({ mesh.Quads, mesh.Faces, std::vector<char>(mesh.Places.size(), 0) });
  if (!IsManifold(topology))
  {
    mesh.Report.Error = "the halves of symmetric quads do not fit each other at the plane; ask for more quads, or for "
                        "none that are symmetric";
    return mesh;
  }
  TakeTopology(topology, mesh);
  QuadReport& report = mesh.Report;
  report.IsSymmetric = true;
  report.Mirror = plane;
  for (int* const number : { &report.Singularities, &report.SplitSingularities, &report.FlippedFaces,
         &report.FacesWithoutArea, &report.SplitFaces, &report.LeftOut })
  {
    *number *= 2;
  }
  report.EulerOfSurface = surface.Mesh.EulerCharacteristic() - 2 * report.LeftOut;
  const std::vector<int> components = FaceComponents(surface.Mesh);
  const LengthsOfEdges lengths = FindLengthsOfEdges(surface.Mesh, components, options);
  MeasureQuads({ surface, places, components, lengths.OnFaces, options.Sizes, options.Regions }, topology, mesh,
    PartOfContext(context, 0.9, 1.0));
  return mesh;
}

}
