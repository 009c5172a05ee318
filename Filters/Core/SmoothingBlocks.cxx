#include "SmoothingBlocks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <vector>

namespace dmg
{
namespace
{

/// Appends the unknowns of faces around a vertex as a block; where there are many, as arcs, each half of
/// which the next one shares.
void AppendStar(const std::vector<int>& faces, bool isClosed, UnknownBlocks& blocks)
{
  constexpr int largestArc = SchwarzBlocks::LargestBlock / 2;
  const int size = static_cast<int>(faces.size());
  for (int begin = 0; begin < size; begin += largestArc / 2)
  {
    const int length = std::min(largestArc, isClosed ? size : size - begin);
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

/// Whether each face has less than so many times the area of an equilateral triangle with its longest
/// side.
std::vector<char> AreUneven(const TriangleMesh& mesh, double evenFraction)
{
  std::vector<char> areUneven(mesh.NumberOfFaces(), 0);
  const Vector<double> areas = mesh.FaceAreas();
  for (int face = 0; face < mesh.NumberOfFaces(); ++face)
  {
    double longest = 0.0;
    for (int h = 3 * face; h < 3 * face + 3; ++h)
    {
      longest =
        std::max(longest, (mesh.Position(mesh.Head(h)) - mesh.Position(mesh.Tail(h))).squaredNorm());
    }
    areUneven[face] = areas[face] <= evenFraction * std::sqrt(3.0) / 4.0 * longest;
  }
  return areUneven;
}

/// Appends patches: connected uneven faces and Rings rings of faces around them, as far as a block has
/// room. Every uneven face is in the core of one patch.
/// \param unknownsOf(face) an array of the unknowns of a face.
template <class UnknownsOf>
void AppendPatches(const TriangleMesh& mesh, double evenFraction, const UnknownsOf& unknownsOf,
  UnknownBlocks& blocks)
{
  constexpr int rings = 2;
  constexpr std::size_t largestCore = 3 * SchwarzBlocks::LargestBlock / 4;
  const std::vector<char> areUneven = AreUneven(mesh, evenFraction);
  std::vector<char> isInCore(mesh.NumberOfFaces(), 0);
  std::vector<int> faces;
  std::vector<int> unknowns;
  const auto add = [&](int face, std::size_t largest) {
    if (std::find(faces.begin(), faces.end(), face) != faces.end())
    {
      return false;
    }
    const std::size_t before = unknowns.size();
    for (const int unknown : unknownsOf(face))
    {
      if (std::find(unknowns.begin(), unknowns.begin() + before, unknown) ==
        unknowns.begin() + before)
      {
        unknowns.push_back(unknown);
      }
    }
    if (unknowns.size() > largest)
    {
      unknowns.resize(before);
      return false;
    }
    faces.push_back(face);
    return true;
  };
  const auto forNeighbours = [&](int face, const auto& visit) {
    for (int h = 3 * face; h < 3 * face + 3; ++h)
    {
      if (const int twin = mesh.Twin(h); twin >= 0)
      {
        visit(TriangleMesh::FaceOf(twin));
      }
    }
  };
  for (int seed = 0; seed < mesh.NumberOfFaces(); ++seed)
  {
    if (!areUneven[seed] || isInCore[seed])
    {
      continue;
    }
    faces.clear();
    unknowns.clear();
    add(seed, largestCore);
    isInCore[seed] = 1;
    for (std::size_t k = 0; k < faces.size(); ++k)
    {
      forNeighbours(faces[k], [&](int face) {
        if (areUneven[face] && !isInCore[face] && add(face, largestCore))
        {
          isInCore[face] = 1;
        }
      });
    }
    for (int ring = 0; ring < rings; ++ring)
    {
      const std::size_t size = faces.size();
      for (std::size_t k = 0; k < size; ++k)
      {
        forNeighbours(faces[k], [&](int face) { add(face, SchwarzBlocks::LargestBlock); });
      }
    }
    blocks.Unknowns.insert(blocks.Unknowns.end(), unknowns.begin(), unknowns.end());
    blocks.EndBlock();
  }
}

}

UnknownBlocks BlocksOfFaceFields(const TriangleMesh& mesh)
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
    AppendStar(faces, h == first, blocks);
  }
  AppendPatches(
    mesh, 0.1, [](int face) { return std::array<int, 2>{ 2 * face, 2 * face + 1 }; }, blocks);
  return blocks;
}

UnknownBlocks BlocksOfOneForms(const TriangleMesh& mesh)
{
  const auto sides = [&mesh](int face) {
    return std::array<int, 3>{ mesh.EdgeOf(3 * face), mesh.EdgeOf(3 * face + 1),
      mesh.EdgeOf(3 * face + 2) };
  };
  UnknownBlocks blocks;
  blocks.Unknowns.reserve(3 * mesh.NumberOfFaces());
  for (int face = 0; face < mesh.NumberOfFaces(); ++face)
  {
    for (const int edge : sides(face))
    {
      blocks.Unknowns.push_back(edge);
    }
    blocks.EndBlock();
  }
  AppendPatches(mesh, 0.3, sides, blocks);
  return blocks;
}

}
