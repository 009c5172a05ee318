#include "SmoothingBlocks.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
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

/// Connected uneven faces, and rings of faces around them as far as a block has room.
template <class UnknownsOf>
class PatchGrower
{
public:
  /// \param unknownsOf(face) an array of the unknowns of a face.
  PatchGrower(const TriangleMesh& mesh, std::vector<char> areUneven, const UnknownsOf& unknownsOf)
    : Mesh(mesh)
    , AreUneven(std::move(areUneven))
    , Of(unknownsOf)
    , IsInCore(mesh.NumberOfFaces(), 0)
  {
  }

  /// Every uneven face gets into the core of one patch.
  void AppendTo(UnknownBlocks& blocks)
  {
    constexpr int rings = 2;
    for (int seed = 0; seed < this->Mesh.NumberOfFaces(); ++seed)
    {
      if (!this->AreUneven[seed] || this->IsInCore[seed])
      {
        continue;
      }
      this->GrowCore(seed);
      for (int ring = 0; ring < rings; ++ring)
      {
        this->AddRing();
      }
      blocks.Unknowns.insert(
        blocks.Unknowns.end(), this->Unknowns.begin(), this->Unknowns.end());
      blocks.EndBlock();
    }
  }

private:
  void GrowCore(int seed)
  {
    constexpr std::size_t largest = 3 * SchwarzBlocks::LargestBlock / 4; // leaves room for rings
    this->Faces.clear();
    this->Unknowns.clear();
    this->IsInCore[seed] = this->Add(seed, largest);
    for (std::size_t k = 0; k < this->Faces.size(); ++k)
    {
      this->ForNeighbours(this->Faces[k], [this](int face) {
        if (this->AreUneven[face] && !this->IsInCore[face])
        {
          this->IsInCore[face] = this->Add(face, largest);
        }
      });
    }
  }

  void AddRing()
  {
    const std::size_t size = this->Faces.size();
    for (std::size_t k = 0; k < size; ++k)
    {
      this->ForNeighbours(
        this->Faces[k], [this](int face) { this->Add(face, SchwarzBlocks::LargestBlock); });
    }
  }

  /// \return whether the face is new, and the patch has no more than so many unknowns with it.
  bool Add(int face, std::size_t largest)
  {
    if (std::find(this->Faces.begin(), this->Faces.end(), face) != this->Faces.end())
    {
      return false;
    }
    const std::size_t before = this->Unknowns.size();
    for (const int unknown : this->Of(face))
    {
      if (std::find(this->Unknowns.begin(), this->Unknowns.end(), unknown) == this->Unknowns.end())
      {
        this->Unknowns.push_back(unknown);
      }
    }
    if (this->Unknowns.size() > largest)
    {
      this->Unknowns.resize(before);
      return false;
    }
    this->Faces.push_back(face);
    return true;
  }

  template <class Visit>
  void ForNeighbours(int face, const Visit& visit) const
  {
    for (int h = 3 * face; h < 3 * face + 3; ++h)
    {
      if (const int twin = this->Mesh.Twin(h); twin >= 0)
      {
        visit(TriangleMesh::FaceOf(twin));
      }
    }
  }

  const TriangleMesh& Mesh;
  const std::vector<char> AreUneven;
  const UnknownsOf& Of;
  std::vector<char> IsInCore;
  std::vector<int> Faces; ///< of the patch
  std::vector<int> Unknowns;
};

template <class UnknownsOf>
void AppendPatches(const TriangleMesh& mesh, double evenFraction, const UnknownsOf& unknownsOf,
  UnknownBlocks& blocks)
{
  PatchGrower<UnknownsOf>(mesh, AreUneven(mesh, evenFraction), unknownsOf).AppendTo(blocks);
}

// Stars tell smooth fields from rough ones even where faces are rather uneven; sides need help earlier.
constexpr double EvenFractionForStars = 0.1;
constexpr double EvenFractionForSides = 0.3;

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
    mesh, EvenFractionForStars, [](int face) { return std::array<int, 2>{ 2 * face, 2 * face + 1 }; }, blocks);
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
  AppendPatches(mesh, EvenFractionForSides, sides, blocks);
  return blocks;
}

}
