#ifndef dmgNeedleRegions_h
#define dmgNeedleRegions_h

#include "Mesh/TriangleMesh.h"

#include <vector>

/// Where triangles are far from equilateral, fields exist that small blocks cannot tell from rough ones and
/// coarse levels cannot represent.
namespace dmg
{

/// Whether each face has at most so many times the area of an equilateral triangle with its longest side.
std::vector<char> AreUneven(const TriangleMesh& mesh, double fraction);

/// Where many needles, very uneven faces, are together, and what is near them. Cost: linear in the number of faces.
class NeedleRegions
{
public:
  static constexpr int FewestNeedles = 24;
  static constexpr int RingsOfRegion = 3;

  /// What a region is.
  struct Rule
  {
    double Fraction;            ///< of needles; see AreUneven
    int RingsBetween;           ///< how many rings of faces around each may part needles, <= Rings; 0: they share sides
    int Rings = RingsOfRegion;  ///< of faces around the needles
    int Fewest = FewestNeedles; ///< needles
  };

  NeedleRegions(const TriangleMesh& mesh, const Rule& rule);

  /// Whether a face is a needle of a region, or in the rings around them.
  bool Contains(int face) const { return this->IsInRegion[face] != 0; }

  /// The faces of each region; regions share no sides.
  std::vector<std::vector<int>> Components() const;

  /// The faces of the regions in pieces of at most four thousand and the rings around them, so that they overlap.
  std::vector<std::vector<int>> Pieces() const;

private:
  /// Appends faces around those given. \param enter(face) whether a face is new.
  template <class Enter>
  void AddRings(int rings, std::vector<int>& faces, const Enter& enter) const;
  void Grow(int rings);
  /// Faces of the region that are connected with a seed and not taken yet; the nearest so many.
  std::vector<int> Connected(int seed, int largest, std::vector<char>& isTaken) const;
  void LeaveOutSmallRegions(const std::vector<char>& isNeedle, int fewest);

  const TriangleMesh& Mesh;
  std::vector<char> IsInRegion;
};

}

#endif
