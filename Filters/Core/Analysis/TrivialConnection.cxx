#include "Analysis/TrivialConnection.h"

#include "Operators/PowerFieldOperators.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <vector>

namespace dmg
{

namespace
{

/// Turns a face by as little as brings the turning across its sides to the limit or, where that cannot be, by what makes the
/// largest one least.
void TurnFace(const TriangleMesh& mesh, int face, double limit, Vector<double>& turning)
{
  const auto sign = [&mesh](int h) { return mesh.HalfedgeOf(mesh.EdgeOf(h)) == h ? 1.0 : -1.0; };
  double least = -std::numeric_limits<double>::infinity();
  double most = std::numeric_limits<double>::infinity();
  for (int h = 3 * face; h < 3 * face + 3; ++h)
  {
    if (mesh.Twin(h) >= 0)
    {
      const double outwards = sign(h) * turning[mesh.EdgeOf(h)];
      least = std::max(least, outwards - limit);
      most = std::min(most, outwards + limit);
    }
  }
  const double turn = least <= most ? std::clamp(0.0, least, most) : 0.5 * (least + most);
  for (int h = 3 * face; h < 3 * face + 3; ++h)
  {
    if (mesh.Twin(h) >= 0)
    {
      turning[mesh.EdgeOf(h)] -= sign(h) * turn;
    }
  }
}

}

Vector<double> AngleDefects(
  const TriangleMesh& mesh, const Unfilled<Corner>& corners, const ExecutionContext& context)
{
  constexpr int Grain = 4096;
  Vector<double> defects(mesh.NumberOfVertices());
  context.ParallelFor(0, mesh.NumberOfVertices(), Grain, [&](int first, int last) {
    for (int vertex = first; vertex < last; ++vertex)
    {
      double defect = 2.0 * Pi;
      mesh.VisitFan(vertex, [&](int h) { defect -= corners[h].Angle; });
      defects[vertex] = mesh.IsBoundaryVertex(vertex) ? 0.0 : defect;
    }
  });
  return defects;
}

Vector<double> TurningOfTransport(const TriangleMesh& mesh, const Unfilled<Complex>& sides,
  const SparseMatrix<double>& loops)
{
  Vector<double> transports = Vector<double>::Zero(mesh.NumberOfEdges());
  for (int edge = 0; edge < mesh.NumberOfEdges(); ++edge)
  {
    const int h = mesh.HalfedgeOf(edge);
    if (SparseMatrix<double>::InnerIterator(loops, edge) && mesh.Twin(h) >= 0)
    {
      transports[edge] = std::arg(TransportOfSides(sides[h], sides[mesh.Twin(h)]));
    }
  }
  return loops.transpose() * transports;
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

void LimitTurning(const TriangleMesh& mesh, double limit, Vector<double>& turning)
{
  constexpr int MostPasses = 200;
  const double tooMuch = limit * (1.0 + 1e-12); // rounding
  std::vector<int> edges;
  for (int edge = 0; edge < mesh.NumberOfEdges(); ++edge)
  {
    if (std::abs(turning[edge]) > tooMuch)
    {
      edges.push_back(edge);
    }
  }
  for (int pass = 0; pass < MostPasses && !edges.empty(); ++pass)
  {
    std::vector<int> touched;
    for (const int edge : edges)
    {
      for (const int h : { mesh.HalfedgeOf(edge), mesh.Twin(mesh.HalfedgeOf(edge)) })
      {
        const int face = TriangleMesh::FaceOf(h);
        TurnFace(mesh, face, limit, turning);
        touched.insert(touched.end(),
          { mesh.EdgeOf(3 * face), mesh.EdgeOf(3 * face + 1), mesh.EdgeOf(3 * face + 2) });
      }
    }
    std::sort(touched.begin(), touched.end());
    touched.erase(std::unique(touched.begin(), touched.end()), touched.end());
    edges.clear();
    std::copy_if(touched.begin(), touched.end(), std::back_inserter(edges),
      [&](int edge) { return std::abs(turning[edge]) > tooMuch; });
  }
}

Vector<Complex> PowersOfConnection(const TriangleMesh& mesh, const Unfilled<Complex>& sides,
  const TreeCotree& trees, const Vector<double>& turning, int N)
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
    const double turn = mesh.HalfedgeOf(edge) == twin ? turning[edge] : -turning[edge];
    const Complex power = powers[TriangleMesh::FaceOf(twin)] *
      Power(TransportOfSides(sides[twin], sides[h]) * std::polar(1.0, turn), N);
    powers[face] = power / std::abs(power);
  }
  return powers;
}

}
