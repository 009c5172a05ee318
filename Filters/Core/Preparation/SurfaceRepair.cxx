#include "Preparation/SurfaceRepair.h"

#include "Mesh/PointChecks.h"
#include "Preparation/CoincidingPoints.h"
#include "Preparation/DoubledTriangles.h"
#include "Preparation/PartsWithoutArea.h"
#include "Preparation/RepairRelation.h"
#include "Support/CountingSort.h"
#include "Support/DisjointSets.h"
#include "Support/Errors.h"

#include <algorithm>
#include <array>
#include <string>
#include <utility>

namespace dmg
{

namespace
{

class Repairer
{
public:
  Repairer(const CellTriangles& given, const UsedPoints& used, bool joinPoints, const ExecutionContext& context)
    : Input(given)
    , PointsInUse(used)
    , JoinsPoints(joinPoints)
    , Context(context)
    , Size(static_cast<int>(given.Corners.rows()))
    , JoinedPoints(static_cast<int>(given.Positions.rows()))
    , Corners(given.Corners)
    , Twins(this->Size)
    , TakesPart(this->Size, 1)
  {
  }

  RepairedSurface Run()
  {
    this->CheckPositions();
    this->Equal =
      this->JoinsPoints ? FirstOfCoinciding(this->Input.Positions, this->Input.Corners) : std::vector<int>();
    this->JoinSidesWithoutLength();
    this->LeaveOut();
    this->PairParticipants();
    if (this->JoinsPoints && this->JoinPoints())
    {
      this->LeaveOut();
      this->PairParticipants();
    }
    this->MakeManifold();
    while (this->CollapsePartsWithoutArea())
    {
      this->LeaveOut();
      this->PairParticipants();
      this->MakeManifold();
    }
    return RelateRepaired(this->Input, this->PointsInUse,
      { std::move(this->JoinedPoints), std::move(this->Corners), std::move(this->Places), std::move(this->Twins),
        std::move(this->Participants), std::move(this->CornersOfParticipants), std::move(this->Pairs),
        std::move(this->Sides), std::move(this->Fans) });
  }

private:
  void CheckPositions() const
  {
    ElementNames names;
    names.Vertices.assign(this->PointsInUse.Points.begin(), this->PointsInUse.Points.end());
    CheckPoints(this->Input.Positions, names);
  }

  void RefuseWithoutParticipants() const
  {
    if (this->Participants.empty())
    {
      this->RefuseDuplicatesOnly();
      RefuseSurfaceWithoutArea();
    }
  }

  void RefuseDuplicatesOnly() const
  {
    for (int t = 0; t < this->Size; ++t)
    {
      if (!this->Input.IsLeftOut(t))
      {
        return;
      }
    }
    throw InvalidInput("all cells of the surface are marked as duplicates of other ones; take the surface that has "
                       "these, or remove the marks");
  }

  /// Corners become the first of the points that they were joined with.
  void RenumberCorners()
  {
    const std::vector<int> first = this->JoinedPoints.AllSmallest();
    for (int i = 0; i < 3 * this->Size; ++i)
    {
      this->Corners.data()[i] = first[this->Input.Corners.data()[i]];
    }
  }

  /// Joins the ends of sides that are as short as rounding, so that no triangle lies in one place.
  void JoinSidesWithoutLength()
  {
    constexpr double Smallest = 1e-60;
    const double rounding = this->JoinsPoints ? RoundingOf(this->Input.Positions) : Smallest;
    std::vector<std::array<int, 2>> near;
    for (int t = 0; t < this->Size; ++t)
    {
      const auto at = [&](int k) { return this->Input.Positions.row(this->Input.Corners(t, k % 3)); };
      const std::array<double, 3> lengths{ (at(1) - at(0)).stableNorm(), (at(2) - at(1)).stableNorm(),
        (at(0) - at(2)).stableNorm() };
      const double longest = *std::max_element(lengths.begin(), lengths.end());
      for (int k = 0; k < 3; ++k)
      {
        const std::array<int, 2> ends{ this->Input.Corners(t, k), this->Input.Corners(t, (k + 1) % 3) };
        if (lengths[k] <= Smallest)
        {
          this->JoinedPoints.Unite(ends[0], ends[1]);
        }
        else if (lengths[k] <= std::min(rounding, PartOfEdge * longest))
        {
          near.push_back(ends);
        }
      }
    }
    UniteNear(this->Input.Positions, near, rounding, this->JoinedPoints);
    this->RenumberCorners();
  }

  /// Decides which triangles take part. Those of duplicate cells come last, so that they are twins of others.
  void LeaveOut()
  {
    for (int t = 0; t < this->Size; ++t)
    {
      this->TakesPart[t] = !IsCollapsed(this->Corners, t);
    }
    DisjointSets places = this->JoinedPoints;
    for (int row = 0; row < static_cast<int>(this->Equal.size()); ++row)
    {
      places.Unite(row, this->Equal[row]);
    }
    this->Places = places.AllSmallest();
    this->Twins = FirstOfDoubled(this->Corners, this->Places, this->TakesPart, this->Context);
    this->PreferCells();
    for (int t = 0; t < this->Size; ++t)
    {
      this->TakesPart[t] = this->TakesPart[t] && !this->Input.IsLeftOut(t);
    }
    KeepTwinsOfSolids(this->Corners, this->TakesPart, this->Twins, this->Context);
    for (int t = 0; t < this->Size; ++t)
    {
      this->TakesPart[t] = this->TakesPart[t] && this->Twins[t] == t;
    }
  }

  /// The first of doubled triangles shall not be one of a duplicate cell, if there is another.
  void PreferCells()
  {
    std::vector<int> chosen(this->Twins);
    for (int t = 0; t < this->Size; ++t)
    {
      int& first = chosen[this->Twins[t]];
      first = this->Input.IsLeftOut(first) && !this->Input.IsLeftOut(t) ? t : first;
    }
    for (int t = 0; t < this->Size; ++t)
    {
      this->Twins[t] = chosen[this->Twins[t]];
    }
  }

  void PairParticipants()
  {
    this->Participants = Choose(
      this->Size, [this](int t) { return this->TakesPart[t] != 0; }, this->Context);
    this->CornersOfParticipants.resize(static_cast<Eigen::Index>(this->Participants.size()), 3);
    for (std::size_t i = 0; i < this->Participants.size(); ++i)
    {
      this->CornersOfParticipants.row(static_cast<Eigen::Index>(i)) = this->Corners.row(this->Participants[i]);
    }
    this->FindOtherSides();
    this->Pairs = this->PairBy(this->Pairing);
  }

  SheetPairs PairBy(const PairingOptions& options) const
  {
    return PairSheets(this->Input.Positions, this->CornersOfParticipants, options, this->Context);
  }

  /// Finds the twins of triangles that take part which run the other way round.
  void FindOtherSides()
  {
    this->OtherSides.assign(this->Size, -1);
    for (int t = 0; t < this->Size; ++t)
    {
      const int first = this->Twins[t];
      if (first != t && this->TakesPart[first] && !this->Input.IsLeftOut(t))
      {
        const auto at = [this](int triangle, int k) { return this->Places[this->Corners(triangle, k % 3)]; };
        int k = 0;
        while (k < 3 && at(first, k) != at(t, 0))
        {
          ++k;
        }
        if (at(first, k + 1) == at(t, 2) && at(first, k + 2) == at(t, 1))
        {
          this->OtherSides[first] = t;
        }
      }
    }
    this->Pairing.HasBothSides.clear();
    for (const int t : this->Participants)
    {
      this->Pairing.HasBothSides.push_back(this->OtherSides[t] >= 0 ? 1 : 0);
    }
  }

  /// Lets the other side of a triangle take part where the triangle would be turned. \return whether there is one.
  bool TakeOtherSides()
  {
    std::vector<int> chosen = Identity(this->Size);
    bool isAny = false;
    for (std::size_t i = 0; i < this->Participants.size(); ++i)
    {
      const int t = this->Participants[i], other = this->OtherSides[t];
      if (this->Sides.IsTurned[i] && other >= 0)
      {
        std::swap(this->TakesPart[t], this->TakesPart[other]);
        chosen[t] = other;
        isAny = true;
      }
    }
    for (int& first : this->Twins)
    {
      first = chosen[first];
    }
    return isAny;
  }

  bool JoinPoints()
  {
    BoundaryPoints boundary;
    for (int side = 0; side < 3 * static_cast<int>(this->Participants.size()); ++side)
    {
      if (this->Pairs.Of(side) < 0)
      {
        const auto& c = this->CornersOfParticipants.row(side / 3);
        const int k = side % 3;
        boundary.Add(this->Input.Positions, c[k], c[(k + 1) % 3], c[(k + 2) % 3]);
      }
    }
    if (!JoinBoundary(this->Input.Positions, boundary.Take(), this->JoinedPoints))
    {
      return false;
    }
    this->RenumberCorners();
    return true;
  }

  /// Turns the participants alike, and gives each of their fans a vertex.
  void MakeManifold()
  {
    this->RefuseWithoutParticipants();
    this->OrientParticipants();
    if (this->TakeOtherSides())
    {
      this->PairParticipants();
      this->OrientParticipants();
    }
    TurnOver(this->CornersOfParticipants, this->Pairs, this->Sides.IsTurned);
    this->Fans = VerticesOfFans(
      static_cast<int>(this->Input.Positions.rows()), this->CornersOfParticipants, this->Pairs, this->Context);
  }

  void OrientParticipants()
  {
    this->Sides = Orient(this->Input.Positions, this->CornersOfParticipants, this->Pairs);
    this->TurnNothingWherePossible();
  }

  /// Triangles that agree with each other at all other edges do so at those of more than two, if no more of them end there.
  void TurnNothingWherePossible()
  {
    if (this->Pairs.Crossed.empty() || !this->Turns(this->Sides))
    {
      return;
    }
    PairingOptions options = this->Pairing;
    options.KeepsDirections = true;
    SheetPairs pairs = this->PairBy(options);
    Orientation sides = Orient(this->Input.Positions, this->CornersOfParticipants, pairs);
    const auto ends = [](const SheetPairs& of) { return std::count(of.Opposite.begin(), of.Opposite.end(), -1); };
    if (ends(pairs) <= ends(this->Pairs) && !this->Turns(sides))
    {
      this->Pairs = std::move(pairs);
      this->Sides = std::move(sides);
    }
  }

  /// Whether some triangle that has one direction is turned, or an edge is cut.
  bool Turns(const Orientation& sides) const
  {
    for (std::size_t i = 0; i < sides.IsTurned.size(); ++i)
    {
      if (sides.IsTurned[i] && !this->Pairing.HasBothSides[i])
      {
        return true;
      }
    }
    return !sides.Cut.empty();
  }

  /// Triangles of parts without area become their longest side, so that they have the faces around it. Flat triangles between others stay,
  /// as the surface hangs together by them.
  bool CollapsePartsWithoutArea()
  {
    const std::vector<char> inPart = InPartsWithoutArea(
      this->Input.Positions, this->CornersOfParticipants, [this](int side) { return this->Pairs.Of(side); });
    for (std::size_t i = 0; i < inPart.size(); ++i)
    {
      if (inPart[i])
      {
        const int triangle = this->Participants[i];
        const int begin = LongestSide(this->Input.Positions, this->Corners, triangle);
        this->Corners(triangle, (begin + 2) % 3) = this->Corners(triangle, begin);
      }
    }
    return !inPart.empty();
  }

  const CellTriangles& Input;
  const UsedPoints& PointsInUse;
  const bool JoinsPoints;
  const ExecutionContext& Context;
  const int Size;
  DisjointSets JoinedPoints;
  std::vector<int> Equal;        ///< the first of the points that coincide; empty where points are not joined
  Triangles Corners;             ///< of all triangles, after points were joined
  std::vector<int> Places;       ///< equal for points at one place
  std::vector<int> Twins;        ///< per triangle: the one that has its place, or itself
  std::vector<char> TakesPart;   ///< per triangle
  std::vector<int> Participants; ///< the triangles that take part
  Triangles CornersOfParticipants;
  std::vector<int> OtherSides; ///< per triangle: a twin of it that runs the other way round, or -1
  PairingOptions Pairing;
  SheetPairs Pairs;  ///< of kept triangles
  Orientation Sides; ///< of kept triangles
  FanVertices Fans;
};

}

RepairedSurface Repair(
  const CellTriangles& given, const UsedPoints& used, bool joinPoints, const ExecutionContext& context)
{
  return Repairer(given, used, joinPoints, context).Run();
}

void RefuseSurfaceWithoutArea()
{
  throw InvalidInput("no triangle of the surface has an area, as the corners of each lie on a line; undo what has "
                     "flattened the surface, or take another");
}

}
