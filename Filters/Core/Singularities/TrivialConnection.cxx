#include "Singularities/TrivialConnection.h"

#include "Operators/PowerFieldOperators.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

namespace dmg
{

namespace
{

double SignOf(const TriangleMesh& mesh, int h)
{
  return mesh.HalfedgeOf(mesh.EdgeOf(h)) == h ? 1.0 : -1.0;
}

/// The largest rotation that each edge may have: the limit, or anything on the boundary and at vertices whose edges cannot share
/// their sum within the limit; there nothing is gained by turning others.
Vector<double> LimitsOf(const TriangleMesh& mesh, double limit, const Vector<double>& rotation)
{
  constexpr double Infinity = std::numeric_limits<double>::infinity();
  Vector<double> limits(mesh.NumberOfEdges());
  for (int edge = 0; edge < mesh.NumberOfEdges(); ++edge)
  {
    limits[edge] = mesh.Twin(mesh.HalfedgeOf(edge)) < 0 ? Infinity : limit;
  }
  for (int vertex = 0; vertex < mesh.NumberOfVertices(); ++vertex)
  {
    double sum = 0.0;
    double most = 0.0;
    mesh.VisitFan(vertex,
      [&](int h)
      {
        sum += SignOf(mesh, h) * rotation[mesh.EdgeOf(h)];
        most += limit;
      });
    if (!mesh.IsBoundaryVertex(vertex) && std::abs(sum) > most)
    {
      mesh.VisitFan(vertex, [&](int h) { limits[mesh.EdgeOf(h)] = Infinity; });
    }
  }
  return limits;
}

/// Turns a face by as little as brings the rotation across its sides to their limits or, where that cannot be, by what makes the
/// largest excess least.
void TurnFace(const TriangleMesh& mesh, int face, const Vector<double>& limits, Vector<double>& rotation)
{
  double least = -std::numeric_limits<double>::infinity();
  double most = std::numeric_limits<double>::infinity();
  for (int h = 3 * face; h < 3 * face + 3; ++h)
  {
    const int edge = mesh.EdgeOf(h);
    const double outwards = SignOf(mesh, h) * rotation[edge];
    least = std::max(least, outwards - limits[edge]);
    most = std::min(most, outwards + limits[edge]);
  }
  const double turn = least <= most ? std::clamp(0.0, least, most) : 0.5 * (least + most);
  for (int h = 3 * face; h < 3 * face + 3; ++h)
  {
    if (mesh.Twin(h) >= 0)
    {
      rotation[mesh.EdgeOf(h)] -= SignOf(mesh, h) * turn;
    }
  }
}

}

Vector<double> AngleDefects(const TriangleMesh& mesh, const Unfilled<Corner>& corners, const ExecutionContext& context)
{
  constexpr int Grain = 4096;
  Vector<double> defects(mesh.NumberOfVertices());
  context.ParallelFor(0, mesh.NumberOfVertices(), Grain,
    [&](int first, int last)
    {
      for (int vertex = first; vertex < last; ++vertex)
      {
        double defect = 2.0 * Pi;
        mesh.VisitFan(vertex, [&](int h) { defect -= corners[h].Angle; });
        defects[vertex] = mesh.IsBoundaryVertex(vertex) ? 0.0 : defect;
      }
    });
  return defects;
}

Vector<double> RotationOfTransport(
  const TriangleMesh& mesh, const Unfilled<Complex>& sides, const SparseMatrix<double>& generators)
{
  Vector<double> transports = Vector<double>::Zero(mesh.NumberOfEdges());
  for (int edge = 0; edge < mesh.NumberOfEdges(); ++edge)
  {
    const int h = mesh.HalfedgeOf(edge);
    if (SparseMatrix<double>::InnerIterator(generators, edge) && mesh.Twin(h) >= 0)
    {
      transports[edge] = std::arg(TransportOfSides(sides[h], sides[mesh.Twin(h)]));
    }
  }
  return generators.transpose() * transports;
}

Vector<double> NearestIntegers(const Eigen::MatrixXd& energy, const Vector<double>& x)
{
  // Each step lowers the energy by more than rounding errors, so that there is a last one.
  constexpr double SmallestGain = 1e-9;
  Vector<double> n = x.array().round();
  for (bool isLower = true; isLower;)
  {
    isLower = false;
    for (Eigen::Index k = 0; k < n.size(); ++k)
    {
      const double best = x[k] - (energy.row(k).dot(n - x) - energy(k, k) * (n[k] - x[k])) / energy(k, k);
      if (std::abs(n[k] - best) > std::abs(std::round(best) - best) + SmallestGain)
      {
        n[k] = std::round(best);
        isLower = true;
      }
    }
  }
  return n;
}

void LimitRotation(const TriangleMesh& mesh, double limit, Vector<double>& rotation)
{
  constexpr int MostPasses = 200;
  const double rounding = 1e-12 * limit;
  std::vector<int> edges(mesh.NumberOfEdges());
  std::iota(edges.begin(), edges.end(), 0);
  const auto keepThoseBeyond = [&](const auto& limitOf)
  {
    edges.erase(std::remove_if(edges.begin(), edges.end(),
                  [&](int edge) { return std::abs(rotation[edge]) <= limitOf(edge) + rounding; }),
      edges.end());
  };
  keepThoseBeyond([limit](int) { return limit; });
  if (edges.empty())
  {
    return;
  }
  const Vector<double> limits = LimitsOf(mesh, limit, rotation);
  const auto ownLimit = [&limits](int edge) { return limits[edge]; };
  keepThoseBeyond(ownLimit);
  for (int pass = 0; pass < MostPasses && !edges.empty(); ++pass)
  {
    std::vector<int> touched;
    for (const int edge : edges)
    {
      for (const int h : { mesh.HalfedgeOf(edge), mesh.Twin(mesh.HalfedgeOf(edge)) })
      {
        const int face = TriangleMesh::FaceOf(h);
        TurnFace(mesh, face, limits, rotation);
        touched.insert(touched.end(), { mesh.EdgeOf(3 * face), mesh.EdgeOf(3 * face + 1), mesh.EdgeOf(3 * face + 2) });
      }
    }
    std::sort(touched.begin(), touched.end());
    touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
    edges = std::move(touched);
    keepThoseBeyond(ownLimit);
  }
}

Vector<Complex> PowersOfConnection(const TriangleMesh& mesh, const Unfilled<Complex>& sides, const TreeCotree& trees,
  const Vector<double>& rotation, int N)
{
  Vector<Complex> powers(mesh.NumberOfFaces());
  for (const int face : trees.Faces)
  {
    const int h = trees.ParentHalfedges[face];
    if (h < 0)
    {
      powers[face] = 1.0;
      continue;
    }
    const int edge = mesh.EdgeOf(h);
    const int twin = mesh.Twin(h);
    const double turn = mesh.HalfedgeOf(edge) == twin ? rotation[edge] : -rotation[edge];
    const Complex power =
      powers[TriangleMesh::FaceOf(twin)] * Power(TransportOfSides(sides[twin], sides[h]) * std::polar(1.0, turn), N);
    powers[face] = power / std::abs(power);
  }
  return powers;
}

}
