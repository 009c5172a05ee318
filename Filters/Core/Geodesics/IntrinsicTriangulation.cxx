#include "Geodesics/IntrinsicTriangulation.h"

#include <algorithm>
#include <cmath>
#include <deque>
#include <utility>

namespace dmg
{

namespace
{

/// The least excess of two sides over the third, relative to the mean edge.
constexpr double SmallestExcess = 1e-8;

/// Sums of cotangents above this are not negative but for rounding.
constexpr double Rounding = -1e-9;

/// The largest number of flips per edge, in the mean. Rounding could flip some edges for ever.
constexpr long long LargestFlipsPerEdge = 100;

/// Heron's formula in Kahan's order, which keeps all digits of thin triangles.
double AreaOfSides(double a, double b, double c)
{
  if (a < b)
  {
    std::swap(a, b);
  }
  if (b < c)
  {
    std::swap(b, c);
  }
  if (a < b)
  {
    std::swap(a, b);
  }
  return 0.25 * std::sqrt(std::max((a + (b + c)) * (c - (a - b)) * (c + (a - b)) * (a + (b - c)), 0.0));
}

}

IntrinsicTriangulation::IntrinsicTriangulation(
  const FramedMesh& surface, const VertexConnection& connection, const ExecutionContext& context)
  : IntrinsicTriangulation(surface, connection, {}, context)
{
}

IntrinsicTriangulation::IntrinsicTriangulation(const FramedMesh& surface, const VertexConnection& connection,
  std::vector<char> held, const ExecutionContext& context)
  : Twins(surface.Mesh.HalfedgeTwins())
  , Held(std::move(held))
{
  const int halfedges = 3 * surface.Mesh.NumberOfFaces();
  this->Tails.resize(halfedges);
  for (int h = 0; h < halfedges; ++h)
  {
    this->Tails[h] = surface.Mesh.Tail(h);
  }
  this->SetLengths(surface.Mesh);
  this->SetDirections(surface.Mesh, connection);
  this->MakeDelaunay(context);
}

void IntrinsicTriangulation::SetLengths(const TriangleMesh& mesh)
{
  this->Lengths.resize(this->Tails.size());
  double sum = 0.0;
  for (int h = 0; h < this->NumberOfHalfedges(); ++h)
  {
    this->Lengths[h] = (mesh.Position(mesh.Head(h)) - mesh.Position(mesh.Tail(h))).norm();
    sum += this->Lengths[h];
  }
  const double wanted = SmallestExcess * sum / static_cast<double>(this->Lengths.size());
  double missing = 0.0;
  for (int h = 0; h < this->NumberOfHalfedges(); ++h)
  {
    const double others =
      this->Lengths[TriangleMesh::Next(h)] + this->Lengths[TriangleMesh::Previous(h)] - this->Lengths[h];
    missing = std::max(missing, wanted - others);
  }
  for (double& length : this->Lengths)
  {
    length += missing;
  }
}

void IntrinsicTriangulation::SetDirections(const TriangleMesh& mesh, const VertexConnection& connection)
{
  this->Directions.resize(this->Tails.size());
  this->Stretches.resize(mesh.NumberOfVertices());
  for (int vertex = 0; vertex < mesh.NumberOfVertices(); ++vertex)
  {
    double sum = 0.0;
    mesh.VisitFan(vertex, [&](int h) { sum += this->CornerAngle(h); });
    const double stretch = mesh.IsBoundaryVertex(vertex) || sum == 0.0 ? 1.0 : 2.0 * Pi / sum;
    double direction = connection.PolarAngle(mesh.OutgoingHalfedge(vertex));
    mesh.VisitFan(vertex,
      [&](int h)
      {
        this->Directions[h] = direction;
        direction += stretch * this->CornerAngle(h);
      });
    this->Stretches[vertex] = stretch;
  }
}

void IntrinsicTriangulation::MakeDelaunay(const ExecutionContext& context)
{
  constexpr int Interval = 16384;
  std::deque<int> queue;
  for (int h = 0; h < this->NumberOfHalfedges(); ++h)
  {
    if (this->Twin(h) > h)
    {
      queue.push_back(h);
    }
  }
  const long long limit = LargestFlipsPerEdge * this->NumberOfHalfedges();
  double done = 0.0; // flips make more to do
  for (long long step = 0; !queue.empty() && step < limit; ++step)
  {
    if (step % Interval == 0)
    {
      done = std::max(done, static_cast<double>(step) / static_cast<double>(step + queue.size()));
      context.Checkpoint(done);
    }
    const int h = queue.front();
    queue.pop_front();
    if (!this->IsDelaunay(h) && this->HasOtherDiagonal(h))
    {
      for (const int side : this->Flip(h))
      {
        queue.push_back(side);
      }
    }
  }
}

bool IntrinsicTriangulation::IsDelaunay(int halfedge) const
{
  const int twin = this->Twin(halfedge);
  if (twin < 0)
  {
    return true;
  }
  const double first = this->Cotangent(halfedge);
  const double second = this->Cotangent(twin);
  return first + second >= Rounding * (1.0 + std::abs(first) + std::abs(second));
}

bool IntrinsicTriangulation::HasOtherDiagonal(int halfedge) const
{
  const int twin = this->Twin(halfedge);
  return twin >= 0 && TriangleMesh::FaceOf(twin) != TriangleMesh::FaceOf(halfedge) && !this->IsHeld(halfedge) &&
    this->CornerAngle(halfedge) + this->CornerAngle(TriangleMesh::Next(twin)) < Pi &&
    this->CornerAngle(TriangleMesh::Next(halfedge)) + this->CornerAngle(twin) < Pi;
}

double IntrinsicTriangulation::OtherDiagonal(int halfedge) const
{
  const int beside = TriangleMesh::Next(this->Twin(halfedge));
  const double ac = this->Length(TriangleMesh::Previous(halfedge));
  const double ad = this->Length(beside);
  const double halfOfAngle = 0.5 * (this->CornerAngle(halfedge) + this->CornerAngle(beside));
  return std::hypot((ac - ad) * std::cos(halfOfAngle), (ac + ad) * std::sin(halfOfAngle));
}

void IntrinsicTriangulation::Permute(const std::array<int, 4>& from, const std::array<int, 4>& to)
{
  std::array<Side, 4> sides{};
  std::array<int, 4> twins{};
  std::array<char, 4> held{};
  for (int k = 0; k < 4; ++k)
  {
    sides[k] = { this->Tails[from[k]], this->Lengths[from[k]], this->Directions[from[k]] };
    twins[k] = this->Twins[from[k]];
    held[k] = this->IsHeld(from[k]) ? 1 : 0;
  }
  const auto placeOf = [&](int h)
  {
    const auto found = std::find(from.begin(), from.end(), h);
    return found == from.end() ? h : to[found - from.begin()];
  };
  for (int k = 0; k < 4; ++k)
  {
    this->Set(to[k], sides[k]);
    this->Join(to[k], placeOf(twins[k]));
    if (!this->Held.empty())
    {
      this->Held[to[k]] = held[k];
    }
  }
}

std::array<int, 4> IntrinsicTriangulation::Flip(int halfedge)
{
  const int twin = this->Twin(halfedge);
  const int f = 3 * TriangleMesh::FaceOf(halfedge);
  const int g = 3 * TriangleMesh::FaceOf(twin);
  const double length = this->OtherDiagonal(halfedge);
  // The faces abc and bad of edge ab become cad and dbc.
  const std::array<int, 4> sides = { f, f + 1, g, g + 1 }; // ca, ad, db, bc
  this->Permute({ TriangleMesh::Previous(halfedge), TriangleMesh::Next(twin), TriangleMesh::Previous(twin),
                  TriangleMesh::Next(halfedge) },
    sides);
  const int c = this->Tails[f], d = this->Tails[g];
  this->Lengths[f + 2] = this->Lengths[g + 2] = length; // which the angles of both faces need
  this->Set(f + 2, { d, length, this->Directions[g] + this->Stretches[d] * this->CornerAngle(g) });
  this->Set(g + 2, { c, length, this->Directions[f] + this->Stretches[c] * this->CornerAngle(f) });
  this->Join(f + 2, g + 2);
  if (!this->Held.empty())
  {
    this->Held[f + 2] = this->Held[g + 2] = 0;
  }
  return sides;
}

double IntrinsicTriangulation::Arrival(int halfedge) const
{
  const int next = TriangleMesh::Next(halfedge);
  return this->Directions[next] + this->Stretches[this->Tails[next]] * this->CornerAngle(next) + Pi;
}

double IntrinsicTriangulation::Area(int face) const
{
  return AreaOfSides(this->Lengths[3 * face], this->Lengths[3 * face + 1], this->Lengths[3 * face + 2]);
}

double IntrinsicTriangulation::Weight(int halfedge) const
{
  const int twin = this->Twin(halfedge);
  return std::max(0.5 * (this->Cotangent(halfedge) + (twin < 0 ? 0.0 : this->Cotangent(twin))), 0.0);
}

double IntrinsicTriangulation::CornerAngle(int halfedge) const
{
  const double a = this->Lengths[halfedge];
  const double b = this->Lengths[TriangleMesh::Previous(halfedge)];
  const double c = this->Lengths[TriangleMesh::Next(halfedge)];
  return std::atan2(4.0 * AreaOfSides(a, b, c), a * a + b * b - c * c);
}

double IntrinsicTriangulation::Cotangent(int halfedge) const
{
  const double a = this->Lengths[halfedge];
  const double b = this->Lengths[TriangleMesh::Previous(halfedge)];
  const double c = this->Lengths[TriangleMesh::Next(halfedge)];
  const double area = std::max(AreaOfSides(a, b, c), 1e-12 * std::max({ a * a, b * b, c * c }));
  return (b * b + c * c - a * a) / (4.0 * area);
}

}
