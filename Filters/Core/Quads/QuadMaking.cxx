#include "Quads/QuadMaking.h"

#include "Constraints/NearestPlaces.h"
#include "Quads/Crosses/AlignedEdges.h"
#include "Quads/Crosses/CrossField.h"
#include "Quads/Crosses/CutSurface.h"
#include "Quads/Crosses/LinesOfEdges.h"
#include "Quads/Crosses/PathsAlongEdges.h"
#include "Quads/Isolines/CellPlaces.h"
#include "Quads/Isolines/IndexedQuads.h"
#include "Quads/Isolines/IsolineArrangement.h"
#include "Quads/Isolines/IsolineCells.h"
#include "Quads/Isolines/QuadDefects.h"
#include "Quads/Isolines/QuadSmoothing.h"
#include "Quads/Isolines/SplitTriangles.h"
#include "Quads/Map/SeamlessVariables.h"
#include "Support/ShortText.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <optional>
#include <utility>

namespace dmg
{

namespace
{

constexpr int MostRounds = 6;
/// Singularities are split at this distance, in edges of quads.
constexpr double DistanceOfSplitting = 1.5;
/// A limit of the triangles that are split where other quads do not fit, if there shall not be more quads.
constexpr double MostSplitTriangles = 4000.0;
/// Edges are this much shorter at most where they were halved.
constexpr double SmallestScale = 1.0 / 64.0;
/// More quads would take gigabytes.
constexpr double MostQuads = 1e7;
/// Halving edges goes on until there are this many times more quads than at first.
constexpr double LargestGrowth = 40.0;

/// The quads of one round, with all that they were made of.
struct Round
{
  MapOfCorners Map;
  IsolineArrangement Isolines;
  IsolineCells Cells;
  CellPlaces Places;
  IndexedQuads Quads;
  QuadDefects Defects;
};

class QuadMaking
{
public:
  QuadMaking(const FramedMesh& surface, const Vector<Complex>& powers, const LengthsOfEdges& lengths,
    const QuadOptions& options, const ElementNames& names, const ExecutionContext& context)
    : Surface(surface)
    , Mesh(surface.Mesh)
    , Options(options)
    , Names(names)
    , Angles(surface, context)
    , Field(MatchCrosses(surface, this->Angles, powers, context))
    , Components(FaceComponents(surface.Mesh))
    , Places(surface)
    , Lengths(lengths.OnFaces)
  {
    this->Report.LengthOfEdges = lengths.Mean;
  }

  QuadMesh Make(const ExecutionContext& context)
  {
    context.Checkpoint(0.02);
    this->Report.SplitSingularities =
      SplitSingularities(this->Surface, this->Angles, DistanceOfSplitting * this->Report.LengthOfEdges, this->Field);
    this->Cut = CutAlongSeams(this->Mesh, this->Field);
    const std::vector<char> isAligned = FindAlignedEdges(this->Surface, this->Angles, this->Field, this->Options);
    this->Lines.emplace(this->Mesh, isAligned);
    context.Checkpoint(0.1);
    this->Map.emplace(this->Surface, this->Field,
      MakeSeamlessVariables(this->Mesh, this->Angles, this->Field, this->Cut, isAligned),
      PartOfContext(context, 0.15, 0.6));
    this->FitLengths(PartOfContext(context, 0.6, 0.65));
    Round best = this->BestRound(PartOfContext(context, 0.65, 0.9));
    return this->Result(std::move(best), PartOfContext(context, 0.9, 1.0));
  }

private:
  /// Scales all lengths so that the real map gives the number of quads.
  void FitLengths(const ExecutionContext& context)
  {
    if (this->Options.EdgeLength > 0.0)
    {
      return;
    }
    constexpr double LargestFactor = 2.0;
    const double area = this->Map->AreaOfRealMap(this->Lengths, context);
    const double factor = std::sqrt(std::max(area, 1e-9) / this->Options.NumberOfQuads);
    const double limited = std::clamp(factor, 1.0 / LargestFactor, LargestFactor);
    this->Lengths *= limited;
    this->Fit = limited;
    this->Report.LengthOfEdges *= limited;
  }

  double ExpectedQuads(const Vector<double>& lengths) const { return ExpectedOnFaces(this->Mesh, lengths).sum(); }

  /// Makes quads, with shorter edges where they do not fit, until they do.
  Round BestRound(const ExecutionContext& context)
  {
    std::optional<Round> best;
    Vector<double> scales = Vector<double>::Ones(this->Mesh.NumberOfFaces());
    for (int round = 0; round <= MostRounds; ++round)
    {
      const auto part = [round](int k) { return static_cast<double>(round + k) / (MostRounds + 1); };
      Round made = this->MakeRound(this->Lengths.cwiseProduct(scales), PartOfContext(context, part(0), part(1)));
      std::vector<char> areBad = made.Defects.AreBad;
      const auto badness = [](const QuadDefects& defects) { return std::make_pair(defects.Number, defects.CutOff); };
      const bool isGood = badness(made.Defects) == std::make_pair(0, 0);
      if (!best || badness(made.Defects) < badness(best->Defects))
      {
        this->Report.Refinements = round;
        this->BestScales = scales;
        best = std::move(made);
      }
      if (isGood)
      {
        break;
      }
      GrowMarks(this->Mesh, this->Report.LengthOfEdges, areBad);
      for (int face = 0; face < scales.size(); ++face)
      {
        scales[face] = areBad[face] ? std::max(0.5 * scales[face], SmallestScale) : scales[face];
      }
      const double expected = this->ExpectedQuads(this->Lengths.cwiseProduct(scales));
      if (expected > std::min(MostQuads, LargestGrowth * this->ExpectedQuads(this->Lengths)))
      {
        break;
      }
    }
    return std::move(*best);
  }

  Round MakeRound(const Vector<double>& lengths, const ExecutionContext& context)
  {
    Round round;
    round.Map = this->Map->Map(lengths, PartOfContext(context, 0.0, 0.7));
    round.Isolines = ArrangeIsolines(this->Mesh, this->Cut, round.Map, PartOfContext(context, 0.7, 0.9));
    round.Cells = FindCells(this->Mesh, round.Isolines);
    round.Places =
      PlaceCells(this->Places, this->Angles, this->Field, *this->Lines, round.Map, round.Isolines, round.Cells);
    const IndexedQuads before = QuadsOfCells(round.Isolines, round.Cells);
    round.Quads = before;
    CleanUp(round.Quads, Ranks(round.Places));
    if (!this->Options.AlignBoundary)
    {
      DropLooseQuads(this->Components, round.Quads);
    }
    round.Defects = FindDefects(this->Mesh, this->Components, round.Isolines, round.Cells, before, round.Quads,
      QuadTopology(round.Quads), this->Options.AlignBoundary);
    context.Checkpoint(1.0);
    return round;
  }

  static std::vector<int> Ranks(const CellPlaces& places)
  {
    std::vector<int> ranks(places.Holds.size());
    for (std::size_t cell = 0; cell < ranks.size(); ++cell)
    {
      ranks[cell] = 2 * static_cast<int>(places.Holds[cell]) + (places.Singularities[cell] > 0 ? 1 : 0);
    }
    return ranks;
  }

  QuadMesh Result(Round round, const ExecutionContext& context)
  {
    QuadMesh mesh;
    mesh.Map = std::move(round.Map);
    mesh.IsCut = this->Cut.IsCut;
    this->Report.FlippedFaces = NumberOfFlippedFaces(mesh.Map);
    this->Report.Singularities = static_cast<int>(
      std::count_if(this->Field.Indices.begin(), this->Field.Indices.end(), [](int index) { return index != 0; }));
    this->Report.EulerOfSurface = this->Mesh.EulerCharacteristic();
    for (int face = 0; face < this->BestScales.size(); ++face)
    {
      if (this->BestScales[face] < 1.0)
      {
        this->Report.RefinedFaces.push_back(face);
      }
    }
    this->Report.CutOff = round.Defects.CutOff;
    if (round.Defects.Number > 0 && !this->SplitBadComponents(round))
    {
      this->Report.Error = this->Explained(round.Defects, round.Quads.Size());
    }
    else
    {
      this->FillQuads(round, mesh, context);
    }
    mesh.Report = std::move(this->Report);
    return mesh;
  }

  /// Splits the triangles of components with defects, if there are few. Two triangles back to back enclose nothing, and are left out.
  /// \return whether that is done.
  bool SplitBadComponents(Round& round)
  {
    const std::vector<char>& areBad = round.Defects.AreComponentsBad;
    const Vector<double> quads = this->Fit * this->Fit * ExpectedOnFaces(this->Mesh, this->Lengths);
    std::vector<double> wanted(areBad.size(), 0.0);
    std::vector<int> triangles(areBad.size(), 0), sides(areBad.size(), 0);
    for (int h = 0; h < 3 * this->Mesh.NumberOfFaces(); ++h)
    {
      const int face = TriangleMesh::FaceOf(h), component = this->Components[face];
      if (areBad[component])
      {
        triangles[component] += h % 3 == 0 ? 1 : 0;
        sides[component] += this->Mesh.Twin(h) >= 0 ? 1 : 0;
        wanted[component] += std::max(quads[face], 1e-9) / 3.0;
      }
    }
    for (std::size_t component = 0; component < wanted.size(); ++component)
    {
      if (triangles[component] == 2 && sides[component] == 6)
      {
        wanted[component] = -1.0;
        ++this->Report.LeftOut;
      }
    }
    this->Report.EulerOfSurface -= 2 * this->Report.LeftOut;
    if (std::accumulate(triangles.begin(), triangles.end(), 0) > std::max(quads.sum(), MostSplitTriangles))
    {
      return false;
    }
    this->Report.SplitFaces = SplitTriangles(this->Mesh, this->Components, wanted, round.Quads, round.Places);
    return true;
  }

  std::string Explained(const QuadDefects& defects, int quads) const
  {
    const std::string remedy = this->Options.EdgeLength > 0.0
      ? "make edges " + ShortText(this->Options.EdgeLength / 2.0) + " long"
      : "ask for " + ShortText(4.0 * std::max<double>(quads, this->Options.NumberOfQuads)) + " quads";
    if (defects.LostComponent >= 0)
    {
      return "quads lose the component of " + this->Names.Face(defects.LostComponent) + "; leave it out, or " + remedy;
    }
    if (defects.SmallHole >= 0)
    {
      return "quads lose the hole at " + this->Names.Vertex(defects.SmallHole) + "; fill it, or " + remedy;
    }
    return "quads do not fit the surface at " + this->Names.Vertex(defects.Handle) + ", a handle or a thin part; " +
      remedy;
  }

  void FillQuads(Round& round, QuadMesh& mesh, const ExecutionContext& context)
  {
    SmoothQuads(this->Places, *this->Lines, round.Quads, this->Options.SmoothingSteps, round.Places,
      PartOfContext(context, 0.0, 0.7));
    if (this->Options.SmoothingSteps > 0)
    {
      Untangle(this->Places, *this->Lines, round.Quads, round.Places, PartOfContext(context, 0.7, 1.0));
    }
    const QuadTopology topology(round.Quads);
    std::vector<int> numbers(round.Quads.NumberOfVertices(), -1);
    for (int cell = 0; cell < round.Quads.NumberOfVertices(); ++cell)
    {
      if (topology.Valences[cell] > 0)
      {
        numbers[cell] = static_cast<int>(mesh.Places.size());
        mesh.Places.push_back(round.Places.Places[cell]);
        mesh.IsOnBoundary.push_back(round.Quads.IsOnBoundary[cell]);
        mesh.Valences.push_back(topology.Valences[cell]);
        mesh.Singularities.push_back(round.Places.Singularities[cell]);
      }
    }
    mesh.Positions.resize(static_cast<int>(mesh.Places.size()), 3);
    for (int vertex = 0; vertex < mesh.Positions.rows(); ++vertex)
    {
      mesh.Positions.row(vertex) = PositionOf(this->Mesh, mesh.Places[vertex]).transpose();
    }
    mesh.Quads = std::move(round.Quads.Corners);
    mesh.Faces = std::move(round.Quads.Faces);
    for (std::array<int, 4>& quad : mesh.Quads)
    {
      std::transform(quad.begin(), quad.end(), quad.begin(), [&numbers](int cell) { return numbers[cell]; });
    }
    this->Measure(mesh, topology);
  }

  void Measure(QuadMesh& mesh, const QuadTopology& topology)
  {
    mesh.ScaledJacobians = ScaledJacobians(mesh.Quads, mesh.Positions);
    this->Report.InvertedQuads = static_cast<int>((mesh.ScaledJacobians.array() <= 0.0).count());
    this->Report.MeanScaledJacobian = mesh.ScaledJacobians.size() > 0 ? mesh.ScaledJacobians.mean() : 0.0;
    this->Report.EulerOfMesh =
      static_cast<int>(mesh.Places.size()) - topology.NumberOfEdges + static_cast<int>(mesh.Quads.size());
    for (std::size_t vertex = 0; vertex < mesh.Places.size(); ++vertex)
    {
      if (!mesh.IsOnBoundary[vertex] && mesh.Valences[vertex] != 4)
      {
        ++this->Report.IrregularVertices;
        this->Report.IrregularWithoutSingularity += mesh.Singularities[vertex] == 0 ? 1 : 0;
      }
    }
  }

  const FramedMesh& Surface;
  const TriangleMesh& Mesh;
  const QuadOptions& Options;
  const ElementNames& Names;
  const SurfaceAngles Angles;
  CrossField Field;
  QuadReport Report;
  const std::vector<int> Components;
  const NearestPlaces Places;
  Vector<double> Lengths;
  double Fit = 1.0; ///< the factor of FitLengths
  CutSurface Cut;
  std::optional<LinesOfEdges> Lines; ///< of aligned edges
  std::optional<SeamlessMap> Map;
  Vector<double> BestScales;
};

}

QuadMesh MakeQuadsOfShortEdges(const FramedMesh& surface, const Vector<Complex>& powers, const LengthsOfEdges& lengths,
  const QuadOptions& options, const ExecutionContext& context, const ElementNames& names)
{
  return QuadMaking(surface, powers, lengths, options, names, context).Make(context);
}

}
