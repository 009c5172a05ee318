#ifndef dmgSheetsAtEdge_h
#define dmgSheetsAtEdge_h

#include "Preparation/SheetPairs.h"
#include "Support/CountingSort.h"

#include <set>
#include <tuple>
#include <utility>
#include <vector>

namespace dmg
{

/// The triangles at an edge of more than two.
///
/// The surface may be the boundary of solids if as many sides run one way along the edge as the other. Only sides that
/// run in opposite directions are paired then, so nothing is turned and nothing is left open: first the smoothest
/// continuations, within 45 degrees of a plane, then the two sides of each wedge of the inside. Twins, where two solids share a
/// face, leave wedges only.
/// Elsewhere the two triangles nearest to one plane stay joined, whatever their orientation, and so do the nearest of
/// the rest within 45 degrees: a plate goes on under its stiffener. So do triangles that are given with both of their sides, as
/// they have no orientation.
class SheetsAtEdge
{
public:
  SheetsAtEdge(const Points& positions, const Triangles& triangles, const PairingOptions& options);

  /// Pairs the sides of an edge from first to last.
  void Pair(const ItemOfPair* first, const ItemOfPair* last, SheetPairs& pairs);

private:
  struct Sheet
  {
    int Side;
    double Angle;   ///< around the edge, in [0, 2 pi)
    bool IsForward; ///< runs from the smaller point of the edge to the larger
    bool HasArea;   ///< else it has no angle
    bool IsLeft;    ///< is not paired yet
  };
  using Place = std::pair<double, int>; ///< (angle, sheet)
  /// A pair of sheets with the one that looks for the other.
  struct Choice
  {
    double Bend; ///< the angle by which they miss a plane
    int First, Second, Owner;
    bool operator<(const Choice& other) const
    {
      return std::tie(this->Bend, this->First, this->Second, this->Owner) <
        std::tie(other.Bend, other.First, other.Second, other.Owner);
    }
  };

  void Collect(const ItemOfPair* first, const ItemOfPair* last);
  bool HasTwins() const;
  bool HaveBothSides() const;
  /// \param areOpposite whether only sides of opposite directions are paired. \param isBentToo whether the smoothest pair may have any bend.
  void PairSmoothest(bool areOpposite, bool isBentToo, SheetPairs& pairs);
  /// Looks for the smoothest continuation among those that are left.
  void Look(int owner, bool areOpposite);
  void PairWedges(SheetPairs& pairs);
  void Join(int i, int j, SheetPairs& pairs);

  const Points& Positions;
  const int* const Corners;
  const PairingOptions& Options;
  bool IsInsideOut; ///< normals of closed surfaces point inwards
  std::vector<Sheet> Sheets;
  std::set<Place> Left[2]; ///< by direction
  std::set<Choice> Choices;
};

}

#endif
