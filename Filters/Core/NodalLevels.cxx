#include "NodalLevels.h"

#include "Operators/ExteriorCalculus.h"
#include "Support/SparseKernels.h"

#include <algorithm>
#include <cassert>

namespace dmg
{

namespace
{

/// The unknowns of the faces around each vertex. Where there are many, of arcs of them, each half of
/// which the next one shares.
UnknownBlocks Stars(const TriangleMesh& mesh)
{
  constexpr int LargestArc = 8;
  UnknownBlocks blocks;
  blocks.Unknowns.reserve(6 * mesh.NumberOfFaces());
  std::vector<int> faces;
  for (int vertex = 0; vertex < mesh.NumberOfVertices(); ++vertex)
  {
    faces.clear();
    const int first = mesh.OutgoingHalfedge(vertex);
    int h = first;
    do
    {
      faces.push_back(TriangleMesh::FaceOf(h));
      h = mesh.Twin(TriangleMesh::Previous(h));
    } while (h >= 0 && h != first);
    const bool isClosed = h == first;
    const int size = static_cast<int>(faces.size());
    for (int begin = 0; begin < size; begin += LargestArc / 2)
    {
      const int length = std::min(LargestArc, isClosed ? size : size - begin);
      for (int k = begin; k < begin + length; ++k)
      {
        blocks.Unknowns.push_back(2 * faces[k % size]);
        blocks.Unknowns.push_back(2 * faces[k % size] + 1);
      }
      blocks.EndBlock();
      if (length == size || (!isClosed && begin + length == size))
      {
        break;
      }
    }
  }
  return blocks;
}

LeastSquaresLevels NodalLevels(
  const std::vector<TransportOperator>& nodal, const ExecutionContext& context)
{
  assert(!nodal.empty());
  const std::size_t skipped = nodal.size() > 1 ? 1 : 0;
  LeastSquaresLevels levels;
  levels.Prolongation = RowsOfComponents(
    skipped > 0 ? Product(nodal[0], nodal[1], context) : nodal[0], context);
  for (std::size_t l = skipped + 1; l < nodal.size(); ++l)
  {
    levels.Coarser.push_back(OnComponents(nodal[l], context));
  }
  return levels;
}

}

LeastSquaresLevels NodalLevelsOfFaceFields(const TriangleMesh& mesh,
  const std::vector<TransportOperator>& nodal, const ExecutionContext& context)
{
  LeastSquaresLevels levels = NodalLevels(nodal, context);
  levels.Blocks = Stars(mesh);
  return levels;
}

LeastSquaresLevels NodalLevelsOfOneForms(const TriangleMesh& mesh, const TangentFrames& faceFrames,
  const std::vector<TransportOperator>& nodal, const ExecutionContext& context)
{
  LeastSquaresLevels levels = NodalLevels(nodal, context);
  levels.Prolongation =
    Product(FormFromFaceField(mesh, faceFrames, context), levels.Prolongation, context);
  levels.Blocks.Unknowns.reserve(3 * mesh.NumberOfFaces());
  for (int face = 0; face < mesh.NumberOfFaces(); ++face)
  {
    for (int h = 3 * face; h < 3 * face + 3; ++h)
    {
      levels.Blocks.Unknowns.push_back(mesh.EdgeOf(h));
    }
    levels.Blocks.EndBlock();
  }
  double Q = getenv("STARQ") ? atof(getenv("STARQ")) : 0.0;
  std::vector<char> bad(mesh.NumberOfVertices(), 0);
  const Vector<double> areas = mesh.FaceAreas();
  for (int face = 0; face < mesh.NumberOfFaces(); ++face)
  {
    double l = 0;
    for (int k = 0; k < 3; ++k)
      l = std::max(l, (mesh.VertexPositions().row(mesh.FaceCorners()(face, k)) - mesh.VertexPositions().row(mesh.FaceCorners()(face, (k + 1) % 3))).squaredNorm());
    if (areas[face] / l / 0.433 <= Q) for (int k = 0; k < 3; ++k) bad[mesh.FaceCorners()(face, k)] = 1;
  }
  int stars = 0;
  for (int v = 0; v < mesh.NumberOfVertices(); ++v)
  {
    if (!bad[v]) continue;
    int h = mesh.OutgoingHalfedge(v); const int first = h; int n = 0; std::vector<int> e;
    do { e.push_back(mesh.EdgeOf(h)); int p = TriangleMesh::Previous(h); int t = mesh.Twin(p); if (t < 0) { e.push_back(mesh.EdgeOf(p)); } h = t; } while (h >= 0 && h != first);
    if (e.size() > 16) e.resize(16);
    for (int k : e) levels.Blocks.Unknowns.push_back(k);
    levels.Blocks.EndBlock(); ++stars;
  }
  if (Q > 0) printf("stars %d\n", stars);
  return levels;
}

}
