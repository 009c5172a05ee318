#include "Mesh/NeedleRegions.h"

#include <algorithm>
#include <cassert>
#include <cmath>
#include <utility>

namespace dmg
{
namespace
{

// Modes of needles decay slowly, and three rings are no wider than a quadrilateral cut into four.
constexpr int RingsOfPiece = 6;
constexpr int LargestPiece = 4000; // faces without its rings

}

std::vector<char> AreUneven(const TriangleMesh& mesh, double fraction)
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
    areUneven[face] = areas[face] <= fraction * std::sqrt(3.0) / 4.0 * longest;
  }
  return areUneven;
}

NeedleRegions::NeedleRegions(const TriangleMesh& mesh, const Rule& rule)
  : Mesh(mesh)
  , IsInRegion(AreUneven(mesh, rule.Fraction))
{
  assert(rule.RingsBetween <= rule.Rings);
  const std::vector<char> isNeedle = this->IsInRegion;
  this->Grow(rule.RingsBetween);
  this->LeaveOutSmallRegions(isNeedle, rule.Fewest);
  this->Grow(rule.Rings - rule.RingsBetween);
}

template <class Enter>
void NeedleRegions::AddRings(int rings, std::vector<int>& faces, const Enter& enter) const
{
  std::size_t begin = 0;
  for (int ring = 0; ring < rings; ++ring)
  {
    const std::size_t end = faces.size();
    for (; begin < end; ++begin)
    {
      this->Mesh.VisitNeighbours(faces[begin], [&](int face) {
        if (enter(face))
        {
          faces.push_back(face);
        }
      });
    }
  }
}

void NeedleRegions::Grow(int rings)
{
  std::vector<int> faces;
  for (int face = 0; face < this->Mesh.NumberOfFaces(); ++face)
  {
    if (this->IsInRegion[face])
    {
      faces.push_back(face);
    }
  }
  this->AddRings(rings, faces, [this](int face) { return !std::exchange(this->IsInRegion[face], 1); });
}

std::vector<int> NeedleRegions::Connected(int seed, int largest, std::vector<char>& isTaken) const
{
  std::vector<int> faces = { seed };
  isTaken[seed] = 1;
  for (std::size_t k = 0; k < faces.size(); ++k)
  {
    this->Mesh.VisitNeighbours(faces[k], [&](int face) {
      if (this->IsInRegion[face] && !isTaken[face] && static_cast<int>(faces.size()) < largest)
      {
        isTaken[face] = 1;
        faces.push_back(face);
      }
    });
  }
  return faces;
}

void NeedleRegions::LeaveOutSmallRegions(const std::vector<char>& isNeedle, int fewest)
{
  for (const std::vector<int>& region : this->Components())
  {
    const auto needles = std::count_if(
      region.begin(), region.end(), [&isNeedle](int face) { return isNeedle[face] != 0; });
    if (needles < fewest)
    {
      for (const int face : region)
      {
        this->IsInRegion[face] = 0;
      }
    }
  }
}

std::vector<std::vector<int>> NeedleRegions::Components() const
{
  std::vector<std::vector<int>> components;
  std::vector<char> isTaken(this->Mesh.NumberOfFaces(), 0);
  for (int seed = 0; seed < this->Mesh.NumberOfFaces(); ++seed)
  {
    if (this->IsInRegion[seed] && !isTaken[seed])
    {
      components.push_back(this->Connected(seed, this->Mesh.NumberOfFaces(), isTaken));
    }
  }
  return components;
}

std::vector<std::vector<int>> NeedleRegions::Pieces() const
{
  std::vector<std::vector<int>> pieces;
  std::vector<char> isTaken(this->Mesh.NumberOfFaces(), 0);
  std::vector<int> pieceOf(this->Mesh.NumberOfFaces(), -1); // the last one that a face has been in
  for (int seed = 0; seed < this->Mesh.NumberOfFaces(); ++seed)
  {
    if (!this->IsInRegion[seed] || isTaken[seed])
    {
      continue;
    }
    const auto piece = static_cast<int>(pieces.size());
    std::vector<int>& faces = pieces.emplace_back(this->Connected(seed, LargestPiece, isTaken));
    for (const int face : faces)
    {
      pieceOf[face] = piece;
    }
    this->AddRings(
      RingsOfPiece, faces, [&](int face) { return std::exchange(pieceOf[face], piece) != piece; });
  }
  return pieces;
}

}
