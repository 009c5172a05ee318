#include "Quads/Isolines/QuadSmoothing.h"

#include <algorithm>
#include <cmath>

namespace dmg
{

namespace
{

constexpr int Grain = 256;

/// \param corners counter-clockwise.
double ScaledJacobian(const std::array<Vector3, 4>& corners)
{
  const Vector3 normal = (corners[2] - corners[0]).cross(corners[3] - corners[1]).normalized();
  double least = 1.0;
  for (int k = 0; k < 4; ++k)
  {
    const Vector3 next = corners[(k + 1) % 4] - corners[k], previous = corners[(k + 3) % 4] - corners[k];
    const double lengths = next.norm() * previous.norm();
    least = std::min(least, lengths > 0.0 ? normal.dot(next.cross(previous)) / lengths : 0.0);
  }
  return least;
}

std::array<Vector3, 4> CornersOf(const std::array<int, 4>& quad, const Points& positions)
{
  return { positions.row(quad[0]).transpose(), positions.row(quad[1]).transpose(), positions.row(quad[2]).transpose(),
    positions.row(quad[3]).transpose() };
}

/// The quads around each vertex.
std::vector<std::vector<int>> QuadsAround(const IndexedQuads& quads)
{
  std::vector<std::vector<int>> around(quads.NumberOfVertices());
  for (int q = 0; q < quads.Size(); ++q)
  {
    for (const int vertex : quads.Corners[q])
    {
      around[vertex].push_back(q);
    }
  }
  return around;
}

int CornerOf(const std::array<int, 4>& quad, int vertex)
{
  return static_cast<int>(std::find(quad.begin(), quad.end(), vertex) - quad.begin());
}

/// The mean of the ends of all sides at a vertex.
Vector3 MeanOfNeighbours(const IndexedQuads& quads, const std::vector<int>& around, int vertex, const Points& positions)
{
  Vector3 sum = Vector3::Zero();
  for (const int q : around)
  {
    const auto& corners = quads.Corners[q];
    const int k = CornerOf(corners, vertex);
    sum += (positions.row(corners[(k + 1) % 4]) + positions.row(corners[(k + 3) % 4])).transpose();
  }
  return sum / (2.0 * around.size());
}

/// The place of the surface, or of the line that holds a vertex, that is near to a position. At a vertex of the surface there may be another
/// one already, so none moves there.
SurfacePlace PlaceNear(const NearestPlaces& surface, const LinesOfEdges& lines, const CellPlaces& places, int vertex,
  const Vector3& position)
{
  const SurfacePlace& from = places.Places[vertex];
  if (places.Holds[vertex] == Hold::OnLine)
  {
    return lines.From(from, position);
  }
  const NearestPlace nearest = surface.From(from.Face, position);
  const SurfacePlace place = PlaceInFace(surface.Surface.Mesh, nearest.Face, nearest.Position);
  return place.Weights.maxCoeff() < 1.0 ? place : from;
}

/// The square of any size that is nearest to a quad: its corner 0 is at Middle + Half, and the others follow counter-clockwise.
struct NearestSquare
{
  Vector3 Middle, Half, Normal;

  /// \param outside the normal of the surface.
  NearestSquare(const std::array<Vector3, 4>& corners, const Vector3& outside)
    : Middle((corners[0] + corners[1] + corners[2] + corners[3]) / 4.0)
    , Normal((corners[2] - corners[0]).cross(corners[3] - corners[1]).normalized())
  {
    if (!(this->Normal.dot(outside) > 0.0)) // folded
    {
      this->Normal = outside;
    }
    const auto inPlane = [this](const Vector3& way) -> Vector3 { return way - way.dot(this->Normal) * this->Normal; };
    const Vector3 first = inPlane(corners[0] - corners[2]), second = inPlane(corners[1] - corners[3]);
    this->Half = (first + second.cross(this->Normal)) / 4.0;
  }

  Vector3 Corner(int k) const
  {
    const Vector3 way = k % 2 == 0 ? this->Half : Vector3(this->Normal.cross(this->Half));
    return this->Middle + (k < 2 ? 1.0 : -1.0) * way;
  }
};

/// A search for places of one vertex after the other at which the worst quad around it is better.
class Untangling
{
public:
  Untangling(const NearestPlaces& surface, const LinesOfEdges& lines, const IndexedQuads& quads, CellPlaces& places)
    : Surface(surface)
    , Lines(lines)
    , Quads(quads)
    , Places(places)
    , Around(QuadsAround(quads))
    , Positions(PositionsOf(surface.Surface.Mesh, places))
  {
  }

  /// \return whether a vertex moved.
  bool Sweep()
  {
    constexpr double Good = 0.2; // quads below are looked after
    bool hasMoved = false;
    for (int q = 0; q < this->Quads.Size(); ++q)
    {
      if (ScaledJacobian(CornersOf(this->Quads.Corners[q], this->Positions)) < Good)
      {
        for (const int vertex : this->Quads.Corners[q])
        {
          hasMoved = (this->Places.Holds[vertex] != Hold::AtPoint && this->Improve(vertex)) || hasMoved;
        }
      }
    }
    return hasMoved;
  }

private:
  double Worst(int vertex) const
  {
    double worst = 1.0;
    for (const int q : this->Around[vertex])
    {
      worst = std::min(worst, ScaledJacobian(CornersOf(this->Quads.Corners[q], this->Positions)));
    }
    return worst;
  }

  bool Improve(int vertex)
  {
    const Vector3 start = this->Positions.row(vertex).transpose();
    const Vector3 mean = MeanOfNeighbours(this->Quads, this->Around[vertex], vertex, this->Positions);
    const double size = this->MeanSide(vertex, start);
    bool hasMoved = this->TryPlace(vertex, mean);
    const TangentFrames& frames = this->Surface.Surface.Faces;
    for (double step = 0.4 * size; step > 0.02 * size; step *= 0.5)
    {
      const Vector3 from = this->Positions.row(vertex).transpose();
      for (int k = 0; k < 8; ++k)
      {
        const Complex way = std::polar(step, k * Pi / 4.0);
        hasMoved = this->TryPlace(vertex, from + frames.ToVector(this->Places.Places[vertex].Face, way)) || hasMoved;
      }
    }
    return hasMoved;
  }

  double MeanSide(int vertex, const Vector3& position) const
  {
    double sum = 0.0;
    for (const int q : this->Around[vertex])
    {
      sum += (this->Positions.row(this->Quads.Corners[q][0]).transpose() - position).norm() +
        (this->Positions.row(this->Quads.Corners[q][2]).transpose() - position).norm();
    }
    return sum / (2.0 * this->Around[vertex].size());
  }

  /// Moves a vertex to the place of the surface near to a position, if that is better.
  bool TryPlace(int vertex, const Vector3& position)
  {
    constexpr double LeastGain = 1e-3;
    const double worst = this->Worst(vertex);
    const Vector3 former = this->Positions.row(vertex).transpose();
    const SurfacePlace place = PlaceNear(this->Surface, this->Lines, this->Places, vertex, position);
    this->Positions.row(vertex) = PositionOf(this->Surface.Surface.Mesh, place).transpose();
    if (this->Worst(vertex) > worst + LeastGain)
    {
      this->Places.Places[vertex] = place;
      return true;
    }
    this->Positions.row(vertex) = former.transpose();
    return false;
  }

  const NearestPlaces& Surface;
  const LinesOfEdges& Lines;
  const IndexedQuads& Quads;
  CellPlaces& Places;
  const std::vector<std::vector<int>> Around;
  Points Positions;
};

}

Vector<double> ScaledJacobians(const std::vector<std::array<int, 4>>& quads, const Points& positions)
{
  Vector<double> jacobians(static_cast<int>(quads.size()));
  for (int q = 0; q < jacobians.size(); ++q)
  {
    jacobians[q] = ScaledJacobian(CornersOf(quads[q], positions));
  }
  return jacobians;
}

void SmoothQuads(const NearestPlaces& surface, const LinesOfEdges& lines, const IndexedQuads& quads, int steps,
  CellPlaces& places, const ExecutionContext& context)
{
  const TriangleMesh& mesh = surface.Surface.Mesh;
  const std::vector<std::vector<int>> around = QuadsAround(quads);
  for (int step = 0; step < steps; ++step)
  {
    context.Checkpoint(static_cast<double>(step) / steps);
    const Points positions = PositionsOf(mesh, places);
    std::vector<NearestSquare> squares;
    squares.reserve(quads.Size());
    for (int q = 0; q < quads.Size(); ++q)
    {
      squares.emplace_back(CornersOf(quads.Corners[q], positions), surface.Surface.Faces.Normal(quads.Faces[q]));
    }
    context.ParallelFor(0, quads.NumberOfVertices(), Grain,
      [&](int begin, int end)
      {
        for (int vertex = begin; vertex < end; ++vertex)
        {
          if (!around[vertex].empty() && places.Holds[vertex] != Hold::AtPoint)
          {
            Vector3 sum = Vector3::Zero();
            for (const int q : around[vertex])
            {
              sum += squares[q].Corner(CornerOf(quads.Corners[q], vertex));
            }
            places.Places[vertex] = PlaceNear(surface, lines, places, vertex, sum / around[vertex].size());
          }
        }
      });
  }
}

void Untangle(const NearestPlaces& surface, const LinesOfEdges& lines, const IndexedQuads& quads, CellPlaces& places,
  const ExecutionContext& context)
{
  constexpr int MostSweeps = 8;
  Untangling untangling(surface, lines, quads, places);
  for (int sweep = 0; sweep < MostSweeps && untangling.Sweep(); ++sweep)
  {
    context.Checkpoint(static_cast<double>(sweep) / MostSweeps);
  }
}

}
