#include "vtkFieldQuads.h"

#include "Adapters/Input/CrossesOfSurface.h"
#include "Adapters/Output/QuadsToPolyData.h"
#include "Adapters/Output/WarningsOfQuads.h"
#include "Adapters/Pipeline/FilterOutputs.h"
#include "Adapters/Pipeline/PanelWords.h"
#include "Adapters/Pipeline/PropertyRanges.h"
#include "Adapters/Pipeline/PropertyTable.h"
#include "Adapters/Surface/PolygonsFromDataSet.h"
#include "Adapters/View/ChosenArrays.h"
#include "Quads/QuadMesh.h"
#include "Quads/SurfaceQuads.h"
#include "Quads/SymmetricQuads.h"
#include "Support/Errors.h"

#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"

#include <cmath>
#include <map>
#include <optional>
#include <string>
#include <utility>
#include <vector>

vtkStandardNewMacro(vtkFieldQuads);

namespace
{

/// The chosen relative lengths of edges, by face; empty where none are chosen.
dmg::Vector<double> SizesOf(const dmg::ChosenArray& choice, const dmg::SurfaceView& view)
{
  const dmg::ChosenArray chosen = dmg::FindArray(choice, view.Given(), 1, "sizes", "the surface");
  const dmg::TriangleMesh& mesh = view.Mesh();
  dmg::Vector<double> sizes(chosen.Array ? mesh.NumberOfFaces() : 0);
  for (int face = 0; face < sizes.size(); ++face)
  {
    double sum = 0.0;
    for (int h = 3 * face; h < 3 * face + 3; ++h)
    {
      sum += chosen.Array->GetComponent(
        chosen.OnPoints() ? view.Relation().PointOf(mesh.Tail(h)) : view.Relation().CellOf(face), 0);
    }
    sizes[face] = sum / 3.0;
  }
  return sizes;
}

/// The numbers of the chosen regions, by face; empty where none are chosen.
std::vector<int> RegionsOf(const dmg::ChosenArray& choice, const dmg::SurfaceView& view)
{
  const dmg::ChosenArray chosen = dmg::FindArray(choice, view.Given(), 1, "regions", "the surface");
  std::vector<int> regions;
  if (chosen.Array && chosen.OnPoints())
  {
    throw dmg::InvalidInput("the array of regions is one of points; choose one of cells");
  }
  std::map<std::pair<bool, double>, int> numbers; // what is not a number is one region
  for (int face = 0; chosen.Array && face < view.Mesh().NumberOfFaces(); ++face)
  {
    const double label = chosen.Array->GetComponent(view.Relation().CellOf(face), 0);
    const auto key = std::isnan(label) ? std::make_pair(true, 0.0) : std::make_pair(false, label);
    regions.push_back(numbers.emplace(key, static_cast<int>(numbers.size())).first->second);
  }
  return regions;
}

std::string SummaryOf(const dmg::QuadMesh& mesh)
{
  return std::to_string(mesh.Quads.size()) + " quads, " + std::to_string(mesh.Report.IrregularVertices) +
    " irregular vertices, " + std::to_string(mesh.Report.InvertedQuads) + " inverted";
}

/// The plane of symmetry that was chosen; none: one is to be found.
std::optional<dmg::MirrorPlane> PlaneOf(vtkFieldQuads& filter)
{
  if (filter.GetSymmetry() == vtkFieldQuads::Automatic)
  {
    return {};
  }
  const dmg::Vector3 normal(filter.GetSymmetryNormal());
  if (!(normal.norm() > 0.0) || !std::isfinite(normal.norm()))
  {
    throw dmg::InvalidInput("Symmetry Normal has no direction; give it one");
  }
  return dmg::MirrorPlane{ dmg::Vector3(filter.GetSymmetryOrigin()), normal.normalized() };
}

/// Quads along the crosses of a surface; along its features, where it has none.
dmg::QuadMesh MakeQuadsOf(vtkFieldQuads& filter, const dmg::SurfaceView& view,
  const std::optional<dmg::Vector<dmg::Complex>>& crosses, const dmg::QuadOptions& options,
  const dmg::ExecutionContext& context)
{
  const dmg::ElementNames names = view.Relation().Names();
  const dmg::FramedMesh& surface = view.Surface().Geometry;
  if (filter.GetSymmetry() != vtkFieldQuads::NoSymmetry)
  {
    return dmg::MakeSymmetricQuads(surface, crosses, PlaneOf(filter), options, context, names);
  }
  return crosses ? dmg::MakeQuadsAcrossGaps(surface, *crosses, options, context, names)
                 : dmg::MakeQuadsAlongFeatures(surface, options, context, names);
}

}

//------------------------------------------------------------------------------
vtkFieldQuads::vtkFieldQuads()
{
  this->SetNumberOfOutputPorts(3);
}

//------------------------------------------------------------------------------
dmg::PropertyTable vtkFieldQuads::Properties() const
{
  dmg::PropertyTable table;
  table.Number("NumberOfQuads", this->NumberOfQuads, 1, 900000);
  table.Number("EdgeLength", this->EdgeLength, 0, 1e40);
  table.Number("Adaptivity", this->Adaptivity, 0, 1);
  table.Switch("AlignBoundary", this->AlignBoundary);
  table.Switch("AlignSharpEdges", this->AlignSharpEdges);
  table.Number("FeatureAngle", this->FeatureAngle, 0, 180);
  table.Choice("Symmetry", this->Symmetry, { "NoSymmetry", "Automatic", "Plane" });
  table.Vector("SymmetryOrigin", this->SymmetryOrigin);
  table.Vector("SymmetryNormal", this->SymmetryNormal);
  table.Number("SmoothingSteps", this->SmoothingSteps, 0, 1000);
  table.Switch("CutForTextures", this->CutForTextures);
  table.Number("BallRadius", this->BallRadius, 0, 10);
  return table;
}

//------------------------------------------------------------------------------
dmg::QuadOptions vtkFieldQuads::Options() const
{
  dmg::QuadOptions options;
  options.NumberOfQuads = this->NumberOfQuads;
  options.EdgeLength = this->EdgeLength;
  options.Adaptivity = this->Adaptivity;
  options.AlignBoundary = this->AlignBoundary;
  options.AlignSharpEdges = this->AlignSharpEdges;
  options.FeatureAngle = this->FeatureAngle;
  options.SmoothingSteps = this->SmoothingSteps;
  return options;
}

//------------------------------------------------------------------------------
int vtkFieldQuads::RequestData(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  const auto output = [outputVector](int port) { return vtkPolyData::GetData(outputVector, port); };
  this->Summary.clear();
  const auto make = [&](vtkInformationVector** whole, const dmg::ExecutionContext& context)
  {
    dmg::CheckRanges({ { "Number Of Directions", this->NumberOfDirections, 0, 8 } });
    this->Properties().Check();
    dmg::QuadOptions options = this->Options();
    dmg::SurfaceView view(dmg::SurfaceOf(whole[0]));
    const std::optional<dmg::Vector<dmg::Complex>> crosses =
      dmg::CrossesOf(this, view, this->NumberOfDirections, dmg::PartOfContext(context, 0.0, 0.1));
    options.Sizes = SizesOf(dmg::ChoiceOf(this, 1), view);
    options.Regions = RegionsOf(dmg::ChoiceOf(this, 2), view);
    const dmg::QuadMesh quads = MakeQuadsOf(*this, view, crosses, options, dmg::PartOfContext(context, 0.1, 0.95));
    dmg::MapToPolyData(quads, view, output(1));
    context.Checkpoint(0.97);
    if (!quads.Report.Error.empty())
    {
      vtkErrorMacro(<< dmg::InPanelWords(quads.Report.Error));
      return;
    }
    this->Summary = SummaryOf(quads);
    dmg::QuadsToPolyData(quads, view, this->CutForTextures, output(0));
    context.Checkpoint(0.99);
    dmg::IrregularToPolyData(quads, this->BallRadius, output(2));
    dmg::Warn(this, dmg::WarningsOf(quads, options, crosses.has_value(), view.Relation().Names()));
  };
  return dmg::MakeOutputs(this, request, inputVector, outputVector, make);
}

//------------------------------------------------------------------------------
const char* vtkFieldQuads::GetSummary() const
{
  return this->Summary.c_str();
}

//------------------------------------------------------------------------------
void vtkFieldQuads::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  this->Properties().Print(os, indent);
}
