#include "NodalLevels.h"

#include "Operators/ExteriorCalculus.h"
#include "Support/SparseKernels.h"

#include <algorithm>
#include <cassert>
#include <cmath>

namespace dmg
{

namespace
{

/// Appends the unknowns of elements around a vertex as a block; where there are many, as arcs, each half
/// of which the next one shares.
/// \param unknownsPerElement element i has the unknowns n i to n i + n - 1.
void AppendAround(const std::vector<int>& elements, bool isClosed, int unknownsPerElement,
  UnknownBlocks& blocks)
{
  const int largestArc = SchwarzBlocks::LargestBlock / unknownsPerElement;
  const int size = static_cast<int>(elements.size());
  for (int begin = 0; begin < size; begin += largestArc / 2)
  {
    const int length = std::min(largestArc, isClosed ? size : size - begin);
    for (int k = begin; k < begin + length; ++k)
    {
      for (int n = 0; n < unknownsPerElement; ++n)
      {
        blocks.Unknowns.push_back(unknownsPerElement * elements[k % size] + n);
      }
    }
    blocks.EndBlock();
    if (length == size || (!isClosed && begin + length == size))
    {
      break;
    }
  }
}

/// The unknowns of the faces around each vertex.
UnknownBlocks Stars(const TriangleMesh& mesh)
{
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
    AppendAround(faces, h == first, 2, blocks);
  }
  return blocks;
}

/// The sides of each face.
UnknownBlocks Sides(const TriangleMesh& mesh)
{
  UnknownBlocks blocks;
  blocks.Unknowns.reserve(3 * mesh.NumberOfFaces());
  for (int face = 0; face < mesh.NumberOfFaces(); ++face)
  {
    for (int h = 3 * face; h < 3 * face + 3; ++h)
    {
      blocks.Unknowns.push_back(mesh.EdgeOf(h));
    }
    blocks.EndBlock();
  }
  return blocks;
}

/// Whether each vertex is a corner of a face that is far from equilateral.
std::vector<char> AreCornersOfUnevenFaces(const TriangleMesh& mesh)
{
  // Of the area of an equilateral triangle with the longest side.
  constexpr double EvenFraction = 0.2;
  std::vector<char> areUneven(mesh.NumberOfVertices(), 0);
  const Vector<double> areas = mesh.FaceAreas();
  for (int face = 0; face < mesh.NumberOfFaces(); ++face)
  {
    const Eigen::Vector3i corners = mesh.FaceCorners().row(face);
    double longest = 0.0;
    for (int k = 0; k < 3; ++k)
    {
      longest = std::max(longest,
        (mesh.VertexPositions().row(corners[k]) - mesh.VertexPositions().row(corners[(k + 1) % 3]))
          .squaredNorm());
    }
    if (areas[face] <= EvenFraction * std::sqrt(3.0) / 4.0 * longest)
    {
      for (const int corner : corners)
      {
        areUneven[corner] = 1;
      }
    }
  }
  return areUneven;
}

/// The edges at each of some vertices: gradients of functions that live on one vertex, which the sides of
/// faces do not hold.
void AppendSpokes(
  const TriangleMesh& mesh, const std::vector<char>& isChosen, UnknownBlocks& blocks)
{
  std::vector<int> edges;
  for (int vertex = 0; vertex < mesh.NumberOfVertices(); ++vertex)
  {
    if (!isChosen[vertex])
    {
      continue;
    }
    edges.clear();
    const int first = mesh.OutgoingHalfedge(vertex);
    int h = first;
    do
    {
      edges.push_back(mesh.EdgeOf(h));
      const int incoming = TriangleMesh::Previous(h);
      h = mesh.Twin(incoming);
      if (h < 0)
      {
        edges.push_back(mesh.EdgeOf(incoming));
      }
    } while (h >= 0 && h != first);
    AppendAround(edges, h == first, 1, blocks);
  }
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
  levels.Blocks = Sides(mesh);
  AppendSpokes(mesh, AreCornersOfUnevenFaces(mesh), levels.Blocks);
  return levels;
}

}
