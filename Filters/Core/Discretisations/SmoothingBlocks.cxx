#include "Discretisations/SmoothingBlocks.h"

#include "Mesh/FaceFans.h"
#include "Mesh/NeedleRegions.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>
#include <vector>

namespace dmg
{
namespace
{

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
      this->Mesh.VisitNeighbours(this->Faces[k], [this](int face) {
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
      this->Mesh.VisitNeighbours(this->Faces[k],
        [this](int face) { this->Add(face, SchwarzBlocks::LargestBlock); });
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

// Forms run along chains of needles that hang together loosely. Vectors do not: patches are enough for them, but where
// needles that share sides are more than a patch has room for, as those of a needle that was cut into 64.
constexpr NeedleRegions::Rule NeedlesForSides = { 0.1, NeedleRegions::RingsOfRegion };
constexpr NeedleRegions::Rule NeedlesForFans = { 0.05, 0 };
// Sweeps and coarse levels deal with a few.
constexpr NeedleRegions::Rule NeedlesForPowers = { 0.1, NeedleRegions::RingsOfRegion, NeedleRegions::RingsOfRegion, 8 };
// Coarse functions do not fit into any needle.
constexpr NeedleRegions::Rule NeedlesOfCoarseFunctions = { 0.05, 1, 1, 1 };
// A region of n unknowns takes about n^2 operations, and all of them at most so many per unknown of the surface.
constexpr double WorkOnNeedles = 300.0;

/// \param unknownsOf(face) an array of the unknowns of a face.
template <class UnknownsOf>
std::vector<int> UnknownsOfFaces(const std::vector<int>& faces, const UnknownsOf& unknownsOf)
{
  std::vector<int> unknowns;
  for (const int face : faces)
  {
    const auto own = unknownsOf(face);
    unknowns.insert(unknowns.end(), own.begin(), own.end());
  }
  std::sort(unknowns.begin(), unknowns.end());
  unknowns.erase(std::unique(unknowns.begin(), unknowns.end()), unknowns.end());
  return unknowns;
}

void Append(const std::vector<int>& unknowns, UnknownBlocks& blocks)
{
  blocks.Unknowns.insert(blocks.Unknowns.end(), unknowns.begin(), unknowns.end());
  blocks.EndBlock();
}

/// Patches where a region has no subdomains, and subdomains where it has.
/// \param unknownsOf(face) an array of the unknowns of a face.
template <class UnknownsOf>
void AppendLarge(const TriangleMesh& mesh, double evenFraction, const NeedleRegions& regions,
  const UnknownsOf& unknownsOf, SmoothingBlocks& blocks)
{
  std::vector<char> areUneven = AreUneven(mesh, evenFraction);
  for (int face = 0; face < mesh.NumberOfFaces(); ++face)
  {
    areUneven[face] &= !regions.Contains(face);
  }
  PatchGrower<UnknownsOf>(mesh, std::move(areUneven), unknownsOf).AppendTo(blocks.Small);
  for (const std::vector<int>& piece : regions.Pieces())
  {
    Append(UnknownsOfFaces(piece, unknownsOf), blocks.Subdomains);
  }
}

/// The smaller ones first.
template <class UnknownsOf>
UnknownBlocks NeedlesOf(const TriangleMesh& mesh, const UnknownsOf& unknownsOf, int numberOfUnknowns)
{
  std::vector<std::vector<int>> regions;
  for (const std::vector<int>& faces : NeedleRegions(mesh, NeedlesOfCoarseFunctions).Components())
  {
    regions.push_back(UnknownsOfFaces(faces, unknownsOf));
  }
  std::stable_sort(regions.begin(), regions.end(),
    [](const std::vector<int>& a, const std::vector<int>& b) { return a.size() < b.size(); });
  UnknownBlocks needles;
  double work = 0.0;
  for (const std::vector<int>& unknowns : regions)
  {
    work += std::pow(static_cast<double>(unknowns.size()), 2);
    if (work > WorkOnNeedles * numberOfUnknowns)
    {
      break;
    }
    Append(unknowns, needles);
  }
  return needles;
}

}

SmoothingBlocks BlocksOfFaceFields(const TriangleMesh& mesh)
{
  constexpr int largestFan = SchwarzBlocks::LargestBlock / 4; // inverses grow by the square
  const auto components = [](int face) { return std::array<int, 2>{ 2 * face, 2 * face + 1 }; };
  SmoothingBlocks blocks;
  blocks.Small.Unknowns.reserve(2 * mesh.NumberOfFaces());
  const FaceFans fans = PackFans(mesh, largestFan);
  for (int fan = 0; fan < fans.Size(); ++fan)
  {
    for (int k = fans.Offsets[fan]; k < fans.Offsets[fan + 1]; ++k)
    {
      const auto unknowns = components(fans.Faces[k]);
      blocks.Small.Unknowns.insert(
        blocks.Small.Unknowns.end(), unknowns.begin(), unknowns.end());
    }
    blocks.Small.EndBlock();
  }
  AppendLarge(mesh, EvenFractionForFans, NeedleRegions(mesh, NeedlesForFans), components, blocks);
  blocks.Needles = NeedlesOf(mesh, components, 2 * mesh.NumberOfFaces());
  return blocks;
}

SmoothingBlocks BlocksOfOneForms(const TriangleMesh& mesh)
{
  const auto sides = [&mesh](int face) {
    return std::array<int, 3>{ mesh.EdgeOf(3 * face), mesh.EdgeOf(3 * face + 1),
      mesh.EdgeOf(3 * face + 2) };
  };
  SmoothingBlocks blocks;
  UnknownBlocks& small = blocks.Small;
  small.Unknowns.reserve(mesh.NumberOfEdges());
  std::vector<char> isTaken(mesh.NumberOfEdges(), 0);
  const auto take = [&](int face) {
    for (const int edge : sides(face))
    {
      if (!std::exchange(isTaken[edge], 1))
      {
        small.Unknowns.push_back(edge);
      }
    }
    if (small.Offsets.back() < static_cast<int>(small.Unknowns.size()))
    {
      small.EndBlock();
    }
  };
  for (const int face : PackFaces(mesh))
  {
    take(face);
  }
  // What is left over, two sides of a face before single ones.
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
  AppendLarge(mesh, EvenFractionForSides, NeedleRegions(mesh, NeedlesForSides), sides, blocks);
  blocks.Needles = NeedlesOf(mesh, sides, mesh.NumberOfEdges());
  return blocks;
}

UnknownBlocks RegionsOfPowerFields(const TriangleMesh& mesh)
{
  constexpr std::size_t largest = 5000; // a factor of so many is ready sooner than levels of as many
  UnknownBlocks regions;
  for (const std::vector<int>& faces : NeedleRegions(mesh, NeedlesForPowers).Components())
  {
    if (faces.size() <= largest)
    {
      Append(faces, regions);
    }
  }
  return regions;
}

}
