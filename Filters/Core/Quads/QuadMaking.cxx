#include "Quads/QuadMaking.h"

#include "Quads/Crosses/AlignedEdges.h"
#include "Quads/Isolines/QuadSmoothing.h"
#include "Quads/Isolines/SplitTriangles.h"
#include "Quads/QuadMeasures.h"
#include "Quads/QuadRounds.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace dmg
{

namespace
{

/// A limit of the triangles that are split where other quads do not fit, if there shall not be more quads.
constexpr double MostSplitTriangles = 4000.0;
/// More quads would take gigabytes.
constexpr double MostQuads = 1e7;
/// Lengths are scaled once more where the number of quads is off by more than this part.
constexpr double ToleranceOfNumber = 0.05;

constexpr int MostTries = 2;
/// There are no more tries for the number where halved edges make so many times the quads that are wanted: longer ones would be halved, too.
constexpr double LargestExcess = 1.5;

double PartOf(int attempt)
{
  return static_cast<double>(attempt) / MostTries;
}

class QuadMaking
{
public:
  QuadMaking(const FramedMesh& surface, const Vector<Complex>& powers, const LengthsOfEdges& lengths,
    const QuadOptions& options, const ElementNames& names, const ExecutionContext& context)
    : Mesh(surface.Mesh)
    , Options(options)
    , Names(names)
    , Rounds(surface, powers, lengths, options, context)
  {
  }

  QuadMesh Make(const ExecutionContext& context)
  {
    QuadRound best = this->Rounds.Refine(1.0, Refinement::Narrow, PartOfContext(context, 0.0, 0.3));
    if (best.Defects.Number > 0)
    {
      QuadRound wide = this->Rounds.Refine(1.0, Refinement::Wide, PartOfContext(context, 0.3, 0.4));
      if (wide.Badness() < best.Badness())
      {
        best = std::move(wide);
      }
    }
    if (best.Defects.Number > 0 && !this->CanSplit(best))
    {
      this->TryShorterEdges(best, PartOfContext(context, 0.4, 0.8));
    }
    else if (this->Options.EdgeLength == 0.0 && !(best.Number > 0 && this->RatioToWanted(best) > LargestExcess))
    {
      this->TryForNumber(best, PartOfContext(context, 0.4, 0.8));
    }
    return this->Result(std::move(best), PartOfContext(context, 0.8, 1.0));
  }

private:
  /// Halves all edges, twice at most, until quads fit the surface.
  void TryShorterEdges(QuadRound& best, const ExecutionContext& context)
  {
    double scale = 1.0;
    for (int attempt = 0; attempt < MostTries && best.Defects.Number > 0; ++attempt)
    {
      scale *= 0.5;
      if (ExpectedOnFaces(this->Mesh, scale * this->Rounds.Lengths.OnFaces).sum() > MostQuads)
      {
        return;
      }
      QuadRound made =
        this->Rounds.Refine(scale, Refinement::Wide, PartOfContext(context, PartOf(attempt), PartOf(attempt + 1)));
      if (made.Badness() < best.Badness())
      {
        best = std::move(made);
        this->Report.LengthScale = scale;
        this->Report.IsShortened = true;
      }
    }
  }

  /// Scales all lengths, twice at most, until there are about as many quads as wanted.
  void TryForNumber(QuadRound& best, const ExecutionContext& context)
  {
    double scale = 1.0;
    const auto error = [this](const QuadRound& round) { return std::abs(this->RatioToWanted(round) - 1.0); };
    QuadRound last = best;
    for (int attempt = 0; attempt < MostTries && error(last) > ToleranceOfNumber; ++attempt)
    {
      const double before = scale;
      scale *= std::clamp(std::sqrt(this->RatioToWanted(last)), 0.5, 2.0);
      last =
        this->Rounds.RefineAgain(last, before, scale, PartOfContext(context, PartOf(attempt), PartOf(attempt + 1)));
      if (last.IsAsGoodAs(best) && error(last) < error(best))
      {
        best = last;
        this->Report.LengthScale = scale;
      }
    }
  }

  double RatioToWanted(const QuadRound& round) const
  {
    return std::max(round.Quads.Size(), 1) / this->Options.NumberOfQuads;
  }

  QuadMesh Result(QuadRound round, const ExecutionContext& context)
  {
    const std::vector<int>& indices = this->Rounds.Field.Indices;
    QuadMesh mesh;
    mesh.Map = std::move(round.Map);
    mesh.IsCut = this->Rounds.Cut.IsCut;
    this->Report.LengthOfEdges = this->Report.LengthScale * this->Rounds.Lengths.Mean;
    this->Report.SplitSingularities = this->Rounds.SplitSingularities;
    this->Report.AgainstField = LinesAgainstField(this->Mesh, this->Rounds.Angles, this->Rounds.Field, this->Options);
    this->Report.FlippedFaces = NumberOfFaces(mesh.Map, -1);
    this->Report.FacesWithoutArea = NumberOfFaces(mesh.Map, 0);
    this->Report.Singularities =
      static_cast<int>(std::count_if(indices.begin(), indices.end(), [](int index) { return index != 0; }));
    this->Report.EulerOfSurface = this->Mesh.EulerCharacteristic();
    this->Report.Refinements = round.Number;
    for (int face = 0; face < round.Scales.size(); ++face)
    {
      if (round.Scales[face] < 1.0)
      {
        this->Report.RefinedFaces.push_back(face);
      }
    }
    this->Report.CutOff = round.Defects.CutOff;
    if (round.Defects.Number > 0 && !this->SplitBadComponents(round))
    {
      this->Report.Error = this->Explained(round.Defects);
      mesh.Report = std::move(this->Report);
    }
    else
    {
      this->FillQuads(round, mesh, context);
    }
    return mesh;
  }

  /// Whether the triangles of components with defects are few.
  bool CanSplit(const QuadRound& round) const
  {
    const Vector<double> quads = ExpectedOnFaces(this->Mesh, this->Rounds.Lengths.OnFaces);
    double triangles = 0.0;
    for (const int component : this->Rounds.Components)
    {
      triangles += round.Defects.AreComponentsBad[component] ? 1.0 : 0.0;
    }
    return triangles <= std::max(this->Rounds.Fit * this->Rounds.Fit * quads.sum(), MostSplitTriangles);
  }

  /// Splits the triangles of components with defects, if there are few. Two triangles back to back enclose nothing, and are left out.
  /// \return whether that is done.
  bool SplitBadComponents(QuadRound& round)
  {
    const std::vector<char>& areBad = round.Defects.AreComponentsBad;
    const Vector<double> quads =
      this->Rounds.Fit * this->Rounds.Fit * ExpectedOnFaces(this->Mesh, this->Rounds.Lengths.OnFaces);
    std::vector<double> wanted(areBad.size(), 0.0);
    std::vector<int> triangles(areBad.size(), 0), sides(areBad.size(), 0);
    for (int h = 0; h < 3 * this->Mesh.NumberOfFaces(); ++h)
    {
      const int face = TriangleMesh::FaceOf(h), component = this->Rounds.Components[face];
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
    if (!this->CanSplit(round))
    {
      return false;
    }
    this->Report.SplitFaces = SplitTriangles(this->Mesh, this->Rounds.Components, wanted, round.Quads, round.Places);
    return true;
  }

  std::string Explained(const QuadDefects& defects) const
  {
    const std::string remedy = "quads of a quarter of the length do not fit, either";
    if (defects.LostComponent >= 0)
    {
      const bool isAlone = defects.AreComponentsBad.size() == 1;
      return "quads lose the component of " + this->Names.Face(defects.LostComponent) + "; " + remedy +
        (isAlone ? "; cut its triangles finer" : "; leave it out");
    }
    if (defects.SmallHole >= 0)
    {
      return "quads lose the hole at " + this->Names.Vertex(defects.SmallHole) + "; " + remedy + "; fill it";
    }
    return "quads do not fit the surface at " + this->Names.Vertex(defects.Handle) + ", a handle or a thin part; " +
      remedy + "; remove it";
  }

  void FillQuads(QuadRound& round, QuadMesh& mesh, const ExecutionContext& context)
  {
    for (const auto& [vertex, tip] : round.Tips)
    {
      round.Places.Places[vertex] = AtTail(this->Mesh.OutgoingHalfedge(tip));
      round.Places.Holds[vertex] = Hold::AtPoint;
    }
    SmoothQuads(this->Rounds.Places, *this->Rounds.Lines, round.Quads, this->Options.SmoothingSteps, round.Places,
      PartOfContext(context, 0.0, 0.4));
    if (this->Options.SmoothingSteps > 0)
    {
      Untangle(this->Rounds.Places, *this->Rounds.Lines, round.Quads, round.Places, PartOfContext(context, 0.4, 0.6));
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
    mesh.Report = this->Report;
    MeasureQuads({ this->Rounds.Surface, this->Rounds.Places, this->Rounds.Components, this->Rounds.Lengths.OnFaces,
                   this->Options.Sizes, this->Options.Regions },
      topology, mesh, PartOfContext(context, 0.6, 1.0));
  }

  const TriangleMesh& Mesh;
  const QuadOptions& Options;
  const ElementNames& Names;
  QuadRounds Rounds;
  QuadReport Report;
};

}

QuadMesh MakeQuadsOfShortEdges(const FramedMesh& surface, const Vector<Complex>& powers, const LengthsOfEdges& lengths,
  const QuadOptions& options, const ExecutionContext& context, const ElementNames& names)
{
  QuadMaking making(surface, powers, lengths, options, names, PartOfContext(context, 0.0, 0.6));
  return making.Make(PartOfContext(context, 0.6, 1.0));
}

}
