#include "Adapters/Output/ScalesOfPieces.h"

#include "Adapters/Pipeline/FilterOutputs.h"
#include "Adapters/Pipeline/PanelWords.h"
#include "Adapters/View/FillValues.h"
#include "Adapters/View/HiddenGaps.h"
#include "Adapters/View/SurfaceView.h"
#include "Mesh/NormalParts.h"
#include "Pieces/ScaleFilterInPieces.h"
#include "Support/ComplexPairs.h"

#include "vtkAlgorithm.h"
#include "vtkDataSet.h"
#include "vtkInformationVector.h"
#include "vtkTable.h"

#include <algorithm>
#include <optional>
#include <sstream>
#include <utility>

namespace dmg
{

namespace
{

/// The reason why these quantities are not filtered in pieces; empty where they are.
std::string ReasonOf(const QuantityArrays& quantities, const ScaleOptions& options, vtkDataSet* piece)
{
  if (quantities.AreComponents())
  {
    return "eastward and northward components are read on one process";
  }
  if (!quantities.Flows.empty() && !options.AreWholes)
  {
    return "the parts of flows are found on one process";
  }
  if (quantities.RelativeWavelengths.Array)
  {
    return "wavelengths that vary are those of one process";
  }
  for (const ArraysWithGaps& each : quantities.WithGaps())
  {
    if (!each.AreOnPoints)
    {
      return "quantities of cells are filtered on one process";
    }
    if (MayHaveGaps(each.Arrays, piece->GetNumberOfPoints()))
    {
      return "gaps and fill values are found on one process";
    }
  }
  return "";
}

/// The names of functions and flows, a line each, as all ranks have them that have a part of the surface.
std::string NamesOf(const QuantityArrays& quantities)
{
  std::string names;
  for (const ChosenArray& function : quantities.Functions)
  {
    names += "function " + function.Name + "\n";
  }
  for (const NamedFlowArrays& flow : quantities.Flows)
  {
    names += "flow " + flow.Name + "\n";
  }
  return names;
}

/// Quantities of these names, which are zero.
ReadQuantities ZerosOf(const std::string& names, int numberOfVertices)
{
  ReadQuantities zeros;
  std::istringstream lines(names);
  std::string kind, name;
  while (lines >> kind && std::getline(lines.ignore(), name))
  {
    if (kind == "function")
    {
      const Vector<double> zero = Vector<double>::Zero(numberOfVertices);
      zeros.Functions.push_back({ name, true, zero, zero });
    }
    else
    {
      zeros.Flows.push_back(
        { name, true, Vector<Complex>::Zero(numberOfVertices), Vector<double>::Zero(2 * numberOfVertices), {} });
    }
  }
  return zeros;
}

/// Reads quantities by the triangles of this rank alone, and places them at the vertices of its part of the surface. \param all zeros.
void Read(const QuantityArrays& quantities, const SurfaceView& own, const PieceOfSurface& piece, ReadQuantities& all)
{
  const std::vector<int>& vertices = piece.VerticesOfPoints();
  for (std::size_t k = 0; k < quantities.Functions.size(); ++k)
  {
    const Vector<double> numbers = own.Numbers(quantities.Functions[k]);
    for (int here = 0; here < numbers.size(); ++here)
    {
      all.Functions[k].AtVertices[vertices[here]] = numbers[here];
    }
    all.Functions[k].Given = all.Functions[k].AtVertices;
  }
  for (std::size_t k = 0; k < quantities.Flows.size(); ++k)
  {
    const Points vectors = own.Vectors(quantities.Flows[k].Arrays).Values;
    ReadFlow& flow = all.Flows[k];
    for (int here = 0; here < vectors.rows(); ++here)
    {
      // The rank's own triangles alone would not tell the normals at seams.
      const int vertex = vertices[here];
      flow.Given[vertex] = piece.Surface().Vertices.ToComplex(
        vertex, WithoutNormalPart(piece.Surface().Mesh, vertex, vectors.row(here).transpose()));
    }
    flow.AtVertices = AsPairs(flow.Given);
  }
}

/// The quantities that the ranks filter: all have the same names, or there is a reason why they do not filter where they are.
struct FoundQuantities
{
  std::optional<QuantityArrays> Own; ///< of the piece of this rank; none where it has no cells
  std::string Names;                 ///< of all ranks
  std::string Reason;                ///< a clause for the user
};

/// The quantities, found by all ranks together.
FoundQuantities FindOnRanks(const ScalesOfPieces::FindFunction& find, const ScaleSurface::Settings& settings,
  const ScaleOptions& options, const RanksOfPipeline& ranks, vtkDataSet* piece)
{
  FoundQuantities found;
  std::string names;
  ranks.Together(
    [&]
    {
      ScaleFilterOptions solver;
      solver.Solver.Kind = settings.Solver;
      found.Reason = ReasonToGather(solver);
      if (piece->GetNumberOfCells() > 0 && found.Reason.empty())
      {
        try
        {
          found.Own.emplace(find(piece));
          found.Reason = ReasonOf(*found.Own, options, piece);
          names = NamesOf(*found.Own);
        }
        catch (const WrongChoice&)
        {
          found.Reason = "there is no choice of arrays"; // one process says more
        }
      }
    });
  found.Names = ranks.FirstText(names);
  if (found.Reason.empty() && found.Own && names != found.Names)
  {
    found.Reason = "pieces have different arrays";
  }
  found.Reason = ranks.FirstText(found.Reason);
  return found;
}

}

std::string ScalesOfPieces::Filter(vtkAlgorithm* filter, const FindFunction& find,
  const ScaleSurface::Settings& settings, const ScaleOptions& options, const PreparationOptions& preparation,
  const RanksOfPipeline& ranks, vtkInformationVector** inputs, vtkInformationVector* outputs,
  const ExecutionContext& context)
{
  vtkDataSet* const piece = vtkDataSet::GetData(inputs[0]);
  const FoundQuantities found = FindOnRanks(find, settings, options, ranks, piece);
  if (!found.Reason.empty())
  {
    return found.Reason;
  }
  std::string reason = this->Pieces.SetSurface(ranks, piece, preparation, PartOfContext(context, 0.0, 0.2));
  if (!reason.empty())
  {
    return reason;
  }
  if (std::exchange(this->SurfaceOfScales, this->Pieces.NumberOfSurfaces()) != this->Pieces.NumberOfSurfaces())
  {
    this->Scales.Forget();
  }
  const PieceOfSurface& part = this->Pieces.Solver().Piece();
  this->Scales.SetFilters(part.Surface(), settings,
    [&part](const ScaleFilterOptions& asked, const ExecutionContext& now)
    { return ScaleFilterInPieces(part, asked, now); });
  ReadQuantities read = ZerosOf(found.Names, part.NumberOfVertices());
  SurfaceView view(piece);
  ranks.Together(
    [&]
    {
      if (found.Own)
      {
        SurfaceView own(piece);
        own.Prepare(preparation, *this->Pieces.Own(), this->Pieces.Preparation());
        Read(*found.Own, own, part, read);
        view.TakeIf<HiddenGaps>(true, found.Own->WithGaps(), "data");
      }
      view.Prepare(preparation, this->Pieces.Surface(), this->Pieces.Preparation());
      view.StartOutput(vtkDataSet::GetData(outputs, 0), filter->GetClassName());
    });
  vtkTable* const spectrum = vtkTable::GetData(outputs, 1);
  std::vector<std::string> warnings =
    AddScales(this->Scales, std::move(read), options, view, spectrum, PartOfContext(context, 0.2, 1.0));
  if (ranks.Rank() > 0)
  {
    spectrum->Initialize();
    warnings.clear();
  }
  Warn(filter, warnings);
  return "";
}

}
