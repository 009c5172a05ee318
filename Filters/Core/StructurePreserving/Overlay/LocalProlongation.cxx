#include "StructurePreserving/Overlay/LocalProlongation.h"

#include "StructurePreserving/Overlay/RingOverlay.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace dmg
{

namespace
{

template <class Scalar>
using Combination = std::vector<std::pair<int, Scalar>>; // {after, coefficient}

template <class Scalar>
void AddTo(Combination<Scalar>& combination, int after, const Scalar& coefficient)
{
  const auto found =
    std::find_if(combination.begin(), combination.end(), [after](const auto& entry) { return entry.first == after; });
  if (found == combination.end())
  {
    combination.emplace_back(after, coefficient);
  }
  else
  {
    found->second += coefficient;
  }
}

Combination<double> Rounded(const Combination<Rational>& exact)
{
  Combination<double> rounded;
  for (const auto& [after, coefficient] : exact)
  {
    if (CGAL::sign(coefficient) != 0)
    {
      rounded.emplace_back(after, CGAL::to_double(coefficient));
    }
  }
  return rounded;
}

/// A face of the ring before the collapse: local numbers of its corners in the order of the face,
/// and which of its sides are sides of the polygon that other faces rely on.
struct FaceBefore
{
  int Face;
  std::array<int, 3> Corners;
  std::array<bool, 3> IsFixed{ false, false, false };
};

/// Corners given hub first, in the order of the face.
std::array<int, 3> InOrderOfFace(const OneRing::Sector& sector, const std::array<int, 3>& hubFirst)
{
  std::array<int, 3> corners;
  for (int k = 0; k < 3; ++k)
  {
    corners[(sector.HubCorner + k) % 3] = hubFirst[k];
  }
  return corners;
}

std::vector<FaceBefore> FacesBefore(const OneRing& ring)
{
  std::vector<FaceBefore> faces;
  for (int k = 0; k < ring.NumberOfSectors(); ++k)
  {
    const OneRing::Sector& sector = ring.Sectors[k];
    faces.push_back({ sector.Face, InOrderOfFace(sector, ring.SectorBefore(k)) });
    faces.back().IsFixed[sector.OuterHalfedge() % 3] = true;
  }
  for (int d = 0; d < ring.NumberOfDead; ++d)
  {
    faces.push_back({ ring.Dead[d].Face, ring.Dead[d].Corners });
    if (ring.Dead[d].BorderHalfedge >= 0)
    {
      faces.back().IsFixed[ring.Dead[d].BorderHalfedge % 3] = true;
    }
  }
  return faces;
}

/// A triangle in space laid into the plane, its first side along the real axis. Its directions are
/// those of the limit of a slim triangle where it is degenerate: a side without length is
/// perpendicular to the others.
struct FlatTriangle
{
  std::array<Complex, 3> Directions; ///< of the sides
  std::array<Complex, 3> Corners;

  FlatTriangle(const std::vector<Vector3>& positions, const std::array<int, 3>& corners)
  {
    std::array<Vector3, 3> sides;
    for (int k = 0; k < 3; ++k)
    {
      sides[k] = positions[corners[(k + 1) % 3]] - positions[corners[k]];
    }
    const auto angleBetween = [&](int incoming, int outgoing)
    {
      if (sides[incoming].squaredNorm() == 0.0 || sides[outgoing].squaredNorm() == 0.0)
      {
        return 0.5 * Pi;
      }
      return std::atan2(sides[incoming].cross(sides[outgoing]).norm(), sides[incoming].dot(sides[outgoing]));
    };
    this->Directions[0] = 1.0;
    this->Directions[1] = std::polar(1.0, angleBetween(0, 1));
    this->Directions[2] = std::polar(1.0, -angleBetween(2, 0));
    this->Corners[0] = 0.0;
    this->Corners[1] = sides[0].norm();
    this->Corners[2] = -sides[2].norm() * this->Directions[2];
  }
};

/// The sides of one face before, cut where they cross spokes.
using CutSides = std::array<std::vector<RingOverlay::Piece>, 3>;

/// Integral of the Whitney forms of a sector along a piece, as a combination of the values along
/// the sector's sides: of side jk, lambda_j(from) lambda_k(to) - lambda_k(from) lambda_j(to).
void AddWhitney(const OneRing& ring, const RingOverlay::Piece& piece, Combination<Rational>& sum)
{
  const OneRing::Sector& sector = ring.Sectors[piece.Sector];
  const std::array<int, 3> sides = { sector.LeavingSpoke(), sector.OuterHalfedge(), sector.ReturningSpoke() };
  for (int j = 0; j < 3; ++j)
  {
    const int k = (j + 1) % 3;
    AddTo<Rational>(sum, sides[j], piece.From[j] * piece.To[k] - piece.From[k] * piece.To[j]);
  }
}

/// Takes the sum over the face off its free sides.
std::array<Combination<double>, 3> WithZeroSum(
  const std::array<Combination<double>, 3>& sides, const std::array<bool, 3>& isFixed)
{
  const double free = std::count(isFixed.begin(), isFixed.end(), false);
  std::array<Combination<double>, 3> result = sides;
  for (int k = 0; k < 3; ++k)
  {
    for (int j = 0; j < 3 && !isFixed[k]; ++j)
    {
      for (const auto& [after, coefficient] : sides[j])
      {
        AddTo(result[k], after, -coefficient / free);
      }
    }
  }
  return result;
}

/// Sum over the pieces of the sides of one face on one sector.
struct Overlap
{
  double Length = 0.0;
  Complex Rotation = 0.0; // sum of length e^{i angle}
};

LocalRow<Complex> PowerRow(
  const OneRing& ring, const FaceBefore& face, const CutSides& cutSides, const std::vector<FlatTriangle>& sectors)
{
  const FlatTriangle before(ring.Positions, face.Corners);
  std::vector<Overlap> overlaps(sectors.size());
  double total = 0.0;
  for (int side = 0; side < 3; ++side)
  {
    for (const RingOverlay::Piece& piece : cutSides[side])
    {
      Complex vector = 0.0;
      for (int k = 0; k < 3; ++k)
      {
        const int corner = (ring.Sectors[piece.Sector].HubCorner + k) % 3;
        vector += CGAL::to_double(piece.To[k] - piece.From[k]) * sectors[piece.Sector].Corners[corner];
      }
      const double length = std::abs(vector);
      overlaps[piece.Sector].Length += length;
      overlaps[piece.Sector].Rotation += before.Directions[side] * std::conj(vector);
      total += length;
    }
  }
  LocalRow<Complex> row{ face.Face, {} };
  for (int k = 0; k < ring.NumberOfSectors(); ++k)
  {
    const double rotation = std::abs(overlaps[k].Rotation);
    if (rotation > 0.0)
    {
      row.Entries.emplace_back(ring.Sectors[k].Face, overlaps[k].Length / total * (overlaps[k].Rotation / rotation));
    }
  }
  if (row.Entries.empty())
  {
    // The whole face lies in one point: no piece has a direction, and any will do.
    row.Entries.emplace_back(ring.Sectors[cutSides[0].front().Sector].Face, 1.0);
  }
  return row;
}

}

LocalProlongation::LocalProlongation(const CollapseRecord& collapse)
{
  const OneRing& ring = collapse.Ring;
  const RingOverlay overlay(collapse);

  const auto addVertex = [&](int vertexSlot, int vertex)
  {
    const RingOverlay::Place place = overlay.PlaceOf(vertex);
    const std::array<int, 3> corners = { ring.Target, ring.Loop[place.Sector],
      ring.Loop[ring.NextOnLoop(place.Sector)] };
    Combination<double> row;
    for (int k = 0; k < 3; ++k)
    {
      if (CGAL::sign(place.Weights[k]) != 0)
      {
        row.emplace_back(corners[k], CGAL::to_double(place.Weights[k]));
      }
    }
    this->Vertices.push_back({ vertexSlot, row });
  };
  addVertex(ring.Removed, ring.RemovedIndex());
  if (ring.TargetIndex() != ring.HubIndex())
  {
    addVertex(ring.Target, ring.TargetIndex());
  }

  std::vector<FlatTriangle> sectors;
  for (int k = 0; k < ring.NumberOfSectors(); ++k)
  {
    sectors.emplace_back(ring.Positions, InOrderOfFace(ring.Sectors[k], ring.SectorAfter(k)));
  }
  for (const FaceBefore& face : FacesBefore(ring))
  {
    CutSides cutSides;
    std::array<Combination<double>, 3> sides;
    for (int k = 0; k < 3; ++k)
    {
      cutSides[k] = overlay.PiecesOf(face.Corners[k], face.Corners[(k + 1) % 3]);
      Combination<Rational> integral;
      for (const RingOverlay::Piece& piece : cutSides[k])
      {
        AddWhitney(ring, piece, integral);
      }
      sides[k] = Rounded(integral);
    }
    const std::array<Combination<double>, 3> zeroSum = WithZeroSum(sides, face.IsFixed);
    for (int k = 0; k < 3; ++k)
    {
      this->Halfedges.push_back({ 3 * face.Face + k, sides[k] });
      this->ZeroSumHalfedges.push_back({ 3 * face.Face + k, zeroSum[k] });
    }
    this->Powers.push_back(PowerRow(ring, face, cutSides, sectors));
  }
}

}
