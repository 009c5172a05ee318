#include "Quads/QuadRounds.h"

#include "Quads/Crosses/AlignedEdges.h"
#include "Quads/Crosses/PathsAlongEdges.h"
#include "Quads/Isolines/IsolineArrangement.h"
#include "Quads/Isolines/IsolineCells.h"
#include "Quads/Isolines/QuadDistances.h"
#include "Quads/Map/SeamlessVariables.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace dmg
{

namespace
{

/// Necks of scans are as thin as a five-hundredth of a quad, and each round halves edges once.
constexpr int MostRounds = 14, MostWideRounds = 6;
/// Rounds for what may be missing, though the mesh is good, end after so many that are no better.
constexpr int MostIdleRounds = 2;
/// Singularities are split at this distance, in edges of quads.
constexpr double DistanceOfSplitting = 1.5;
/// Edges are this much shorter at most where they were halved.
constexpr double SmallestScale = 1.0 / 1024.0;
/// More quads would take gigabytes.
constexpr double MostQuads = 1e7;
/// Halving edges goes on until there are this many times more quads than at first: to make a mesh of the surface, and to miss nothing of it.
constexpr double LargestGrowth = 40.0, LargestGrowthOfGood = 1.25;

std::vector<int> Ranks(const CellPlaces& places)
{
  std::vector<int> ranks(places.Holds.size());
  for (std::size_t cell = 0; cell < ranks.size(); ++cell)
  {
    ranks[cell] = 2 * static_cast<int>(places.Holds[cell]) + (places.Singularities[cell] > 0 ? 1 : 0);
  }
  return ranks;
}

}

QuadRounds::QuadRounds(const FramedMesh& surface, const Vector<Complex>& powers, const LengthsOfEdges& lengths,
  const QuadOptions& options, const ExecutionContext& context)
  : Surface(surface)
  , Options(options)
  , Angles(surface, context)
  , Field(MatchCrosses(surface, this->Angles, powers, context))
  , Components(FaceComponents(surface.Mesh))
  , Places(surface)
  , Lengths(lengths)
{
  context.Checkpoint(0.05);
  this->SplitSingularities =
    dmg::SplitSingularities(surface, this->Angles, DistanceOfSplitting * lengths.Mean, this->Field);
  this->Cut = CutAlongSeams(surface.Mesh, this->Field);
  const std::vector<char> isAligned = FindAlignedEdges(surface, this->Angles, this->Field, options);
  this->Lines.emplace(surface.Mesh, isAligned);
  context.Checkpoint(0.15);
  this->Map.emplace(surface, this->Field,
    MakeSeamlessVariables(surface.Mesh, this->Angles, this->Field, this->Cut, isAligned),
    PartOfContext(context, 0.2, 0.9));
  this->FitLengths(PartOfContext(context, 0.9, 1.0));
}

void QuadRounds::FitLengths(const ExecutionContext& context)
{
  if (this->Options.EdgeLength > 0.0)
  {
    return;
  }
  constexpr double LargestFactor = 2.0;
  const double area = this->Map->AreaOfRealMap(this->Lengths.OnFaces, context);
  this->Fit =
    std::clamp(std::sqrt(std::max(area, 1e-9) / this->Options.NumberOfQuads), 1.0 / LargestFactor, LargestFactor);
  this->Lengths.OnFaces *= this->Fit;
  this->Lengths.Mean *= this->Fit;
}

QuadRound QuadRounds::Refine(double scale, Refinement refinement, const ExecutionContext& context)
{
  return this->Refine(scale, refinement, Vector<double>::Ones(this->Surface.Mesh.NumberOfFaces()), context);
}

QuadRound QuadRounds::RefineAgain(
  const QuadRound& before, double scaleBefore, double scale, const ExecutionContext& context)
{
  const auto sameLength = [&](double ofFace)
  { return ofFace < 1.0 ? std::min(ofFace * scaleBefore / scale, 1.0) : 1.0; };
  QuadRound round = this->Refine(scale, Refinement::Narrow, before.Scales.unaryExpr(sameLength), context);
  round.Number += before.Number;
  return round;
}

QuadRound QuadRounds::Refine(
  double scale, Refinement refinement, Vector<double> scales, const ExecutionContext& context)
{
  const TriangleMesh& mesh = this->Surface.Mesh;
  const bool isWide = refinement == Refinement::Wide;
  const int rounds = isWide ? MostWideRounds : MostRounds;
  std::optional<QuadRound> best;
  const auto expected = [&] { return ExpectedOnFaces(mesh, scale * this->Lengths.OnFaces.cwiseProduct(scales)).sum(); };
  const double atFirst = expected();
  int idle = 0;
  for (int number = 0; number <= rounds; ++number)
  {
    const auto part = [number, rounds](int k) { return static_cast<double>(number + k) / (rounds + 1); };
    QuadRound made =
      this->Make(scale * this->Lengths.OnFaces.cwiseProduct(scales), PartOfContext(context, part(0), part(1)));
    made.Scales = scales;
    made.Number = number;
    std::vector<char> areBad = made.Defects.AreBad;
    const bool isMesh = made.Defects.Number == 0, isGood = made.Badness() == std::make_tuple(0, 0, 0);
    const bool isBetter = !best || made.Badness() < best->Badness();
    idle = isBetter ? 0 : idle + 1;
    if (isBetter)
    {
      best = std::move(made);
    }
    if (isGood || (best->Defects.Number == 0 && idle >= MostIdleRounds))
    {
      break;
    }
    const Vector<double> lengths = scale * this->Lengths.OnFaces.cwiseProduct(scales);
    GrowMarks(mesh, isWide ? Vector<double>::Constant(lengths.size(), scale * this->Lengths.Mean) : lengths, areBad);
    for (int face = 0; face < scales.size(); ++face)
    {
      scales[face] = areBad[face] ? std::max(0.5 * scales[face], SmallestScale) : scales[face];
    }
    if (expected() > std::min(MostQuads, (isMesh ? LargestGrowthOfGood : LargestGrowth) * atFirst))
    {
      break;
    }
  }
  return std::move(*best);
}

QuadRound QuadRounds::Make(const Vector<double>& lengths, const ExecutionContext& context)
{
  const TriangleMesh& mesh = this->Surface.Mesh;
  QuadRound round;
  round.Map = this->Map->Map(lengths, PartOfContext(context, 0.0, 0.7));
  const IsolineArrangement isolines = ArrangeIsolines(mesh, this->Cut, round.Map, PartOfContext(context, 0.7, 0.85));
  const IsolineCells cells = FindCells(mesh, isolines);
  round.Places = PlaceCells(this->Places, this->Angles, this->Field, *this->Lines, round.Map, isolines, cells);
  const IndexedQuads before = QuadsOfCells(isolines, cells);
  round.Quads = before;
  CleanUp(round.Quads, Ranks(round.Places));
  if (!this->Options.AlignBoundary)
  {
    DropLooseQuads(this->Components, round.Quads);
  }
  round.Defects = FindDefects(mesh, this->Components, isolines, cells, before, round.Quads, QuadTopology(round.Quads),
    this->Options.AlignBoundary);
  context.Checkpoint(0.9);
  if (round.Defects.Number == 0)
  {
    this->MarkFar(lengths, cells, round, PartOfContext(context, 0.9, 1.0));
  }
  return round;
}

void QuadRounds::MarkFar(
  const Vector<double>& lengths, const IsolineCells& cells, QuadRound& round, const ExecutionContext& context) const
{
  const TriangleMesh& mesh = this->Surface.Mesh;
  const Vector<double> distances =
    DistancesFromQuads(mesh, round.Quads.Corners, PositionsOf(mesh, round.Places), context);
  std::vector<char> isFar(distances.size(), 0);
  for (int h = 0; h < 3 * mesh.NumberOfFaces() && distances.size() > 0; ++h)
  {
    const int face = TriangleMesh::FaceOf(h), vertex = mesh.Tail(h);
    if (distances[vertex] > lengths[face])
    {
      isFar[vertex] = round.Defects.AreBad[face] = 1;
    }
  }
  round.Far = static_cast<int>(std::count(isFar.begin(), isFar.end(), 1));
  std::vector<int> farthest(cells.Size(), -1); // by cell
  for (int vertex = 0; vertex < static_cast<int>(isFar.size()); ++vertex)
  {
    const int cell = isFar[vertex] ? cells.OfVertices[vertex] : -1;
    if (cell >= 0 && (farthest[cell] < 0 || distances[vertex] > distances[farthest[cell]]))
    {
      farthest[cell] = vertex;
    }
  }
  for (int cell = 0; cell < cells.Size(); ++cell)
  {
    if (farthest[cell] >= 0 && round.Places.Holds[cell] == Hold::Free)
    {
      round.Tips.emplace_back(cell, farthest[cell]);
    }
  }
}

}
