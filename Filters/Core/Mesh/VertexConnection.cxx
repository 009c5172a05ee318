#include "Mesh/VertexConnection.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>

namespace dmg
{

namespace
{

constexpr int Grain = 4096;
/// Faces of less height, over their side, have no derivative across it.
constexpr double ThinnestFace = 1e-6;

}

VertexConnection::VertexConnection(const FramedMesh& surface, const ExecutionContext& context)
{
  this->SetCorners(surface, context);
  context.ParallelFor(0, surface.Mesh.NumberOfVertices(), Grain,
    [&](int first, int last)
    {
      for (int vertex = first; vertex < last; ++vertex)
      {
        this->SetPolarAngles(surface, vertex);
      }
    });
}

/// Stores angles before they are stretched, and the bisectors of corners, in the frames of their faces, in the place of turns.
void VertexConnection::SetCorners(const FramedMesh& surface, const ExecutionContext& context)
{
  const int halfedges = 3 * surface.Mesh.NumberOfFaces();
  this->PolarAngles.resize(halfedges);
  this->CornerAngles.resize(halfedges);
  this->TurnsFromFaces.resize(halfedges);
  context.ParallelFor(0, surface.Mesh.NumberOfFaces(), Grain,
    [&](int first, int last)
    {
      for (int face = first; face < last; ++face)
      {
        const std::array<Complex, 3> sides = SideDirections(surface.Mesh, surface.Faces, face);
        const auto angleAt = [&sides](int k) { return std::abs(std::arg(-sides[(k + 2) % 3] * std::conj(sides[k]))); };
        const std::array<double, 2> angles = { angleAt(0), angleAt(1) };
        for (int k = 0; k < 3; ++k)
        {
          const double angle = k < 2 ? angles[k] : std::max(Pi - angles[0] - angles[1], 0.0);
          this->CornerAngles[3 * face + k] = angle;
          this->TurnsFromFaces[3 * face + k] = sides[k] * std::polar(1.0, 0.5 * angle);
        }
      }
    });
}

void VertexConnection::SetPolarAngles(const FramedMesh& surface, int vertex)
{
  const TriangleMesh& mesh = surface.Mesh;
  double sum = 0.0;
  mesh.VisitFan(vertex, [&](int h) { sum += this->CornerAngles[h]; });
  const double stretch = mesh.IsBoundaryVertex(vertex) || sum == 0.0 ? 1.0 : 2.0 * Pi / sum;
  double polar = 0.0;
  Complex mean = 0.0;
  mesh.VisitFan(vertex,
    [&](int h)
    {
      const double angle = this->CornerAngles[h];
      this->PolarAngles[h] = polar;
      this->CornerAngles[h] = stretch * angle;
      const Complex turn = std::polar(1.0, polar + 0.5 * stretch * angle) * std::conj(this->TurnsFromFaces[h]);
      this->TurnsFromFaces[h] = turn;
      mean += angle * TransportTurn(surface.Faces, TriangleMesh::FaceOf(h), surface.Vertices, vertex) * std::conj(turn);
      polar += stretch * angle;
    });
  const double zero = mean == 0.0 ? 0.0 : std::arg(mean);
  const Complex turnOfZero = std::polar(1.0, zero);
  mesh.VisitFan(vertex,
    [&](int h)
    {
      this->PolarAngles[h] += zero;
      this->TurnsFromFaces[h] *= turnOfZero;
    });
}

void VertexConnection::SetLengths(const TriangleMesh& mesh, const std::vector<double>& lengths)
{
  this->Turns.assign(this->PolarAngles.size(), 0.0);
  for (int h = 0; h < 3 * mesh.NumberOfFaces(); ++h)
  {
    const int next = TriangleMesh::Next(h), twin = mesh.Twin(h);
    const Vector3 side = mesh.Position(mesh.Head(h)) - mesh.Position(mesh.Tail(h));
    const Vector3 toApex = mesh.Position(mesh.Head(next)) - mesh.Position(mesh.Tail(h));
    const double height = side.cross(toApex).norm() / std::max(side.squaredNorm(), std::numeric_limits<double>::min());
    if (!(height > ThinnestFace))
    {
      continue;
    }
    const double along = side.dot(toApex) / side.squaredNorm(); // the foot of the apex, over the side
    const double atTail = std::log(lengths[mesh.Tail(h)]), atHead = std::log(lengths[mesh.Head(h)]);
    // The derivative to the left of the linear function on this face, times the length of the side.
    const double toTheLeft = (std::log(lengths[mesh.Head(next)]) - atTail - along * (atHead - atTail)) / height;
    this->Turns[h] -= (twin >= 0 ? 0.5 : 1.0) * toTheLeft;
    if (twin >= 0)
    {
      this->Turns[twin] += 0.5 * toTheLeft;
    }
  }
}

}
