#include "Mesh/VertexConnection.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace dmg
{

namespace
{

constexpr int Grain = 4096;

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

}
