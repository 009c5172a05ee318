#include "Discretisations/Levels/SmoothingBlocks.h"

#include "Mesh/FaceFans.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace dmg
{
namespace
{

/// Whether the area of each face is at most a fraction of that of an equilateral triangle with its longest side.
std::vector<char> AreUneven(const TriangleMesh& mesh, double fraction)
{
  std::vector<char> areUneven(mesh.NumberOfFaces(), 0);
  const Vector<double> areas = mesh.FaceAreas();
  for (int face = 0; face < mesh.NumberOfFaces(); ++face)
  {
    double longest = 0.0;
    for (int h = 3 * face; h < 3 * face + 3; ++h)
    {
      longest = std::max(longest, (mesh.Position(mesh.Head(h)) - mesh.Position(mesh.Tail(h))).squaredNorm());
    }
    areUneven[face] = areas[face] <= fraction * std::sqrt(3.0) / 4.0 * longest;
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
      blocks.Unknowns.insert(blocks.Unknowns.end(), this->Unknowns.begin(), this->Unknowns.end());
      blocks.EndBlock();
    }
  }

private:
  void GrowCore(int seed)
  {
    constexpr std::size_t largest = 3 * UnknownBlocks::LargestBlock / 4; // leaves room for rings
    this->Faces.clear();
    this->Unknowns.clear();
    this->IsInCore[seed] = this->Add(seed, largest);
    for (std::size_t k = 0; k < this->Faces.size(); ++k)
    {
      this->Mesh.VisitNeighbours(this->Faces[k],
        [this](int face)
        {
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
      this->Mesh.VisitNeighbours(this->Faces[k], [this](int face) { this->Add(face, UnknownBlocks::LargestBlock); });
    }
  }

  /// \return whether the face is new, and the patch with it has at most \p largest unknowns.
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

  const TriangleMesh& Mesh;
  const std::vector<char> AreUneven;
  const UnknownsOf& Of;
  std::vector<char> IsInCore;
  std::vector<int> Faces; ///< of the patch
  std::vector<int> Unknowns;
};

// Fans tell smooth fields from rough ones even where faces are rather uneven; sides need help a little
// earlier. From 0.3 on, patches are most of the work on some surfaces, and save two iterations of ten.
constexpr double EvenFractionForFans = 0.1;
constexpr double EvenFractionForSides = 0.2;

/// \param unknownsOf(face) an array of the unknowns of a face.
template <class UnknownsOf>
void AppendPatches(const TriangleMesh& mesh, double evenFraction, const UnknownsOf& unknownsOf, UnknownBlocks& blocks)
{
  PatchGrower<UnknownsOf>(mesh, AreUneven(mesh, evenFraction), unknownsOf).AppendTo(blocks);
}

}

UnknownBlocks BlocksOfFaceFields(const TriangleMesh& mesh)
{
  constexpr int largestFan = UnknownBlocks::LargestBlock / 4; // inverses grow by the square
  const auto components = [](int face) { return std::array<int, 2>{ 2 * face, 2 * face + 1 }; };
  UnknownBlocks blocks;
  blocks.Unknowns.reserve(2 * mesh.NumberOfFaces());
  const FaceFans fans = PackFans(mesh, largestFan);
  for (int fan = 0; fan < fans.Size(); ++fan)
  {
    for (int k = fans.Offsets[fan]; k < fans.Offsets[fan + 1]; ++k)
    {
      const auto unknowns = components(fans.Faces[k]);
      blocks.Unknowns.insert(blocks.Unknowns.end(), unknowns.begin(), unknowns.end());
    }
    blocks.EndBlock();
  }
  AppendPatches(mesh, EvenFractionForFans, components, blocks);
  return blocks;
}

UnknownBlocks BlocksOfOneForms(const TriangleMesh& mesh)
{
  const auto sides = [&mesh](int face) {
    return std::array<int, 3>{ mesh.EdgeOf(3 * face), mesh.EdgeOf(3 * face + 1), mesh.EdgeOf(3 * face + 2) };
  };
  UnknownBlocks blocks;
  blocks.Unknowns.reserve(mesh.NumberOfEdges());
  std::vector<char> isTaken(mesh.NumberOfEdges(), 0);
  const auto take = [&](int face)
  {
    for (const int edge : sides(face))
    {
      if (!std::exchange(isTaken[edge], 1))
      {
        blocks.Unknowns.push_back(edge);
      }
    }
    if (blocks.Offsets.back() < static_cast<int>(blocks.Unknowns.size()))
    {
      blocks.EndBlock();
    }
  };
  for (const int face : PackFaces(mesh))
  {
    take(face);
  }
  // The remaining sides follow, two of a face before single ones.
  for (const int least : { 2, 1 })
  {
    for (int face = 0; face < mesh.NumberOfFaces(); ++face)
    {
      const auto edges = sides(face);
      if (std::count_if(edges.begin(), edges.end(), [&](int edge) { return !isTaken[edge]; }) >= least)
      {
        take(face);
      }
    }
  }
  AppendPatches(mesh, EvenFractionForSides, sides, blocks);
  return blocks;
}

}
