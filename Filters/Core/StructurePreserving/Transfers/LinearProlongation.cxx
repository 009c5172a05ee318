#include "StructurePreserving/Transfers/LinearProlongation.h"

#include "Support/SparseAssembly.h"

#include <cmath>
#include <utility>

namespace dmg
{

namespace
{

constexpr int Grain = 4096;

using Row = RowEntries<Complex>;

/// Barycentric weights of the mean of the midpoints of a face's sides, each by its squared length.
/// The energy of power fields binds faces by the squared length of the side between them, however
/// far apart their centres lie along it; sampled at the centres, a linear function would have many
/// times its energy on thin faces. Sampled here, both faces of a long side take it from nearly the
/// same place.
std::array<double, 3> WeightsByLongSides(const TriangleMesh& mesh, int face)
{
  std::array<double, 3> weights{ 0.0, 0.0, 0.0 };
  double sum = 0.0;
  for (int k = 0; k < 3; ++k)
  {
    const int h = 3 * face + k;
    const double squared = (mesh.Position(mesh.Head(h)) - mesh.Position(mesh.Tail(h))).squaredNorm();
    weights[k] += squared;
    weights[(k + 1) % 3] += squared;
    sum += 2.0 * squared;
  }
  for (double& weight : weights)
  {
    weight /= sum;
  }
  return weights;
}

/// The turns from coarse vertices to a fine face, by every coarse face that it overlaps; each with the
/// weight of the overlap.
void AddTurns(Row& turns, Complex factor, int fineFace, const TransportOperator& SP, const TriangleMesh& coarse,
  const std::vector<Complex>& coarseCornerTurns)
{
  for (TransportOperator::InnerIterator entry(SP, fineFace); entry; ++entry)
  {
    for (int k = 0; k < 3; ++k)
    {
      const int h = 3 * static_cast<int>(entry.col()) + k;
      AddTo(turns, coarse.Tail(h), factor * entry.value() * coarseCornerTurns[h]);
    }
  }
}

/// Replaces real weights by weights times turns.
void Turn(Row& row, const Row& turns)
{
  for (auto& [column, entry] : row)
  {
    const int wanted = column;
    const auto found = std::find_if(turns.begin(), turns.end(), [wanted](const auto& t) { return t.first == wanted; });
    const double length = found == turns.end() ? 0.0 : std::sqrt(std::norm(found->second));
    if (length > 0.0) // else the turns contradict each other, and any will do
    {
      entry *= found->second / length;
    }
  }
}

}

std::vector<Complex> CornerTurns(
  const TriangleMesh& mesh, const TangentFrames& faceFrames, const ExecutionContext& context)
{
  std::vector<Complex> directions(3 * mesh.NumberOfFaces());
  std::vector<double> angles(3 * mesh.NumberOfFaces());
  context.ParallelFor(0, mesh.NumberOfFaces(), Grain,
    [&](int firstFace, int lastFace)
    {
      for (int face = firstFace; face < lastFace; ++face)
      {
        const std::array<Complex, 3> sides = SideDirections(mesh, faceFrames, face);
        for (int k = 0; k < 3; ++k)
        {
          directions[3 * face + k] = sides[k];
          angles[3 * face + k] = std::abs(std::arg(-sides[(k + 2) % 3] * std::conj(sides[k])));
        }
      }
    });
  std::vector<Complex> turns(3 * mesh.NumberOfFaces());
  const auto turnAround = [&](int vertex)
  {
    double sum = 0.0;
    mesh.VisitFan(vertex, [&](int h) { sum += angles[h]; });
    const double stretch = mesh.IsBoundaryVertex(vertex) || sum == 0.0 ? 1.0 : 2.0 * Pi / sum;
    double polar = 0.0;
    mesh.VisitFan(vertex,
      [&](int h)
      {
        // The bisectors of the corner coincide.
        turns[h] = directions[h] * std::polar(1.0, 0.5 * angles[h] - (polar + 0.5 * stretch * angles[h]));
        polar += stretch * angles[h];
      });
  };
  context.ParallelFor(0, mesh.NumberOfVertices(), Grain,
    [&](int firstVertex, int lastVertex)
    {
      for (int vertex = firstVertex; vertex < lastVertex; ++vertex)
      {
        turnAround(vertex);
      }
    });
  return turns;
}

TransportOperator FacesFromVertices(const TriangleMesh& fine, const SparseMatrix<double>& S0,
  const TransportOperator& SP, const TriangleMesh& coarse, const std::vector<Complex>& coarseCornerTurns,
  const ExecutionContext& context)
{
  const auto appendRow = [&](int face, Row& row)
  {
    const std::array<double, 3> weights = WeightsByLongSides(fine, face);
    for (int k = 0; k < 3; ++k)
    {
      for (SparseMatrix<double>::InnerIterator entry(S0, fine.FaceCorners()(face, k)); entry; ++entry)
      {
        AddTo<Complex>(row, static_cast<int>(entry.col()), weights[k] * entry.value());
      }
    }
    thread_local Row turns;
    turns.clear();
    AddTurns(turns, 1.0, face, SP, coarse, coarseCornerTurns);
    Turn(row, turns);
  };
  return AssembleMatrix<Complex>(fine.NumberOfFaces(), coarse.NumberOfVertices(), context, appendRow);
}

TransportOperator VerticesFromVertices(const TriangleMesh& fine, const std::vector<Complex>& fineCornerTurns,
  const SparseMatrix<double>& S0, const TransportOperator& SP, const TriangleMesh& coarse,
  const std::vector<Complex>& coarseCornerTurns, const ExecutionContext& context)
{
  const auto appendRow = [&](int vertex, Row& row)
  {
    for (SparseMatrix<double>::InnerIterator entry(S0, vertex); entry; ++entry)
    {
      row.emplace_back(static_cast<int>(entry.col()), entry.value());
    }
    thread_local Row turns;
    turns.clear();
    fine.VisitFan(vertex,
      [&](int h)
      { AddTurns(turns, std::conj(fineCornerTurns[h]), TriangleMesh::FaceOf(h), SP, coarse, coarseCornerTurns); });
    Turn(row, turns);
  };
  return AssembleMatrix<Complex>(fine.NumberOfVertices(), coarse.NumberOfVertices(), context, appendRow);
}

}
