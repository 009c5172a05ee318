#include "vtkSurfaceDistance.h"

#include "Adapters/Input/DistanceInputs.h"
#include "Adapters/Input/GuidesFromDataSets.h"
#include "Adapters/Output/DistanceToArrays.h"
#include "Adapters/Pipeline/ChosenPoint.h"
#include "Adapters/Pipeline/FilterOutputs.h"
#include "Adapters/Pipeline/FilterRequests.h"
#include "Adapters/Pipeline/PanelWords.h"
#include "Adapters/Pipeline/PropertyTable.h"
#include "Adapters/Surface/Kept.h"
#include "Adapters/Surface/PolygonsFromDataSet.h"
#include "Adapters/Surface/PreparationToFieldData.h"
#include "Adapters/View/FlatMap.h"
#include "Adapters/View/GlobeLayout.h"
#include "Adapters/View/HiddenGaps.h"
#include "Adapters/View/SurfaceView.h"
#include "Geodesics/SurfaceDistance.h"
#include "Geodesics/VertexInFront.h"

#include "vtkDataSet.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkTable.h"

#include <algorithm>
#include <limits>
#include <string>
#include <utility>

vtkStandardNewMacro(vtkSurfaceDistance);

namespace
{

/// All that distances depend on, besides the surface.
struct DistanceKey
{
  dmg::DistanceSources Sources;
  dmg::DistanceOptions Options;

  friend bool operator==(const DistanceKey& a, const DistanceKey& b)
  {
    return a.Sources == b.Sources && a.Options == b.Options;
  }
};

/// Distances, from which any offset lines and paths come.
class KeptDistance : public dmg::SurfaceDistance
{
public:
  using SurfaceDistance::SurfaceDistance;

  int Counts() const { return 1; }
};

}

class vtkSurfaceDistance::vtkInternals
{
public:
  explicit vtkInternals(vtkSurfaceDistance* filter)
    : Engines(filter)
    , Filter(filter)
    , Point(filter, filter->PointOnSurface)
  {
  }

  dmg::Kept<dmg::EngineOfSurface<KeptDistance, DistanceKey>> Engines;

  dmg::DistanceOptions Options() const
  {
    dmg::DistanceOptions options;
    if (this->Filter->MaximumDistance > 0.0)
    {
      options.MaximumDistance = this->Filter->MaximumDistance / this->Filter->LengthScale;
    }
    options.Signed = this->Filter->Signed;
    options.MaximumSourceDistance = this->Filter->MaximumSourceDistance;
    options.MayMiss = this->Point.IsInLeaf();
    return options;
  }

  dmg::DistanceSources Sources(vtkInformationVector* port, const dmg::SurfaceView& view)
  {
    const std::vector<vtkDataObject*> datasets = dmg::DataOf(port);
    dmg::DistanceSources sources;
    dmg::AddSourcesFrom(datasets, view, sources);
    const bool isMasked = dmg::AddMaskedSources(dmg::ChoiceOf(this->Filter, 0), view, sources);
    sources.Boundary = this->Filter->Boundary;
    sources.FeatureAngle = this->Filter->SharpEdges ? this->Filter->FeatureAngle : 0.0;
    const bool areAsked = !datasets.empty() || isMasked || this->Filter->Boundary || this->Filter->SharpEdges;
    if (this->Filter->UsePoint && (this->Filter->AddPoint || !areAsked))
    {
      dmg::AddNearestSource(dmg::Vector3(this->Filter->Point), view, sources);
    }
    else if (this->Filter->AddPoint || !areAsked)
    {
      dmg::Vector3 position;
      view.Given()->GetPoint(view.Relation().PointOf(dmg::VertexInFront(view.Mesh())), position.data());
      dmg::AddNearestSource(position, view, sources);
      this->Point.Add(position);
    }
    return sources;
  }

  const dmg::SurfaceDistance& Distance(
    const dmg::SurfaceView& view, const DistanceKey& key, const dmg::ExecutionContext& context)
  {
    const auto make = [&] { return KeptDistance(view.Surface().Geometry, key.Sources, key.Options, context); };
    return this->Engines.Of(view.Prepared()->Digest).Take(view.Prepared(), key, make);
  }

  void WarnOf(const dmg::DistanceField& field) const
  {
    dmg::Warn(this->Filter, field.Warnings);
    if (field.TooFar > 0)
    {
      dmg::Warn(this->Filter,
        { std::to_string(field.TooFar) +
          " points, or segments of lines, of Sources are left out: they are too far from the surface, or on the far "
          "side of a thin wall; move them nearer, or raise Maximum Source Distance" });
    }
  }

private:
  vtkSurfaceDistance* const Filter;
  dmg::ChosenPoint Point;
};

//------------------------------------------------------------------------------
vtkSurfaceDistance::vtkSurfaceDistance()
  : Internals(new vtkInternals(this))
{
  this->SetNumberOfInputPorts(3);
  this->SetNumberOfOutputPorts(4);
}

//------------------------------------------------------------------------------
vtkSurfaceDistance::~vtkSurfaceDistance() = default;

//------------------------------------------------------------------------------
void vtkSurfaceDistance::SetPoint(double x, double y, double z)
{
  this->SetPointOfPanel(x, y, z);
  this->UsePointOn();
}

//------------------------------------------------------------------------------
void vtkSurfaceDistance::SetPointOfPanel(double x, double y, double z)
{
  const double point[] = { x, y, z };
  if (!std::equal(point, point + 3, this->Point))
  {
    std::copy_n(point, 3, this->Point);
    this->Modified();
  }
}

//------------------------------------------------------------------------------
void vtkSurfaceDistance::AddOffsetDistance(double distance)
{
  this->OffsetDistances.push_back(distance);
  this->Modified();
}

//------------------------------------------------------------------------------
void vtkSurfaceDistance::RemoveAllOffsetDistances()
{
  if (!this->OffsetDistances.empty())
  {
    this->OffsetDistances.clear();
    this->Modified();
  }
}

//------------------------------------------------------------------------------
double vtkSurfaceDistance::GetOffsetDistance(int index) const
{
  return index >= 0 && index < this->GetNumberOfOffsetDistances() ? this->OffsetDistances[index]
                                                                  : std::numeric_limits<double>::quiet_NaN();
}

//------------------------------------------------------------------------------
int vtkSurfaceDistance::GetNumberOfSetups() const
{
  return this->Internals->Engines.Counts();
}

//------------------------------------------------------------------------------
int vtkSurfaceDistance::FillInputPortInformation(int port, vtkInformation* information)
{
  if (port == 0)
  {
    return this->Superclass::FillInputPortInformation(port, information);
  }
  information->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkDataObject");
  information->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  information->Set(vtkAlgorithm::INPUT_IS_REPEATABLE(), 1);
  return 1;
}

//------------------------------------------------------------------------------
int vtkSurfaceDistance::FillOutputPortInformation(int port, vtkInformation* information)
{
  const char* const types[] = { "vtkDataSet", "vtkPolyData", "vtkPolyData", "vtkTable" };
  information->Set(vtkDataObject::DATA_TYPE_NAME(), types[port]);
  return 1;
}

//------------------------------------------------------------------------------
dmg::PropertyTable vtkSurfaceDistance::Properties() const
{
  dmg::PropertyTable table;
  table.Switch("Boundary", this->Boundary);
  table.Switch("SharpEdges", this->SharpEdges);
  table.Number("FeatureAngle", this->FeatureAngle, 0.001, 180);
  table.Vector("Point", this->Point);
  table.Switch("UsePoint", this->UsePoint);
  table.Switch("AddPoint", this->AddPoint);
  table.Switch("Signed", this->Signed);
  table.Number("MaximumDistance", this->MaximumDistance, 0);
  table.Number("MaximumSourceDistance", this->MaximumSourceDistance, 0);
  table.List("OffsetDistances", this->OffsetDistances);
  table.Number("NumberOfLevels", this->NumberOfLevels, 0, 1000);
  table.Choice("Coordinates", this->Coordinates, { "Space", "LongitudeAndLatitude" });
  table.Number("LengthScale", this->LengthScale, 1e-30, 1e30);
  return table;
}

//------------------------------------------------------------------------------
int vtkSurfaceDistance::RequestData(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  const auto make = [&](vtkInformationVector** whole, const dmg::ExecutionContext& context)
  {
    this->Properties().Check();
    dmg::SurfaceView view(dmg::SurfaceOf(whole[0]));
    const dmg::ChosenArray gaps = dmg::FindArray(dmg::ChoiceOf(this, 1), view.Given(), 1, "gaps", "the surface");
    const bool isMap = this->Coordinates == LongitudeAndLatitude;
    view.TakeIf<dmg::FlatMap>(isMap);
    view.TakeIf<dmg::GlobeLayout>(isMap, dmg::Vector3::UnitZ());
    view.TakeIf<dmg::HiddenGaps>(gaps.Array != nullptr, gaps, "data"); // last: twins of gaps are gaps
    view.Prepare({ dmg::Numbering::Spatial, this->JoinPoints, this->Strict }, dmg::PartOfContext(context, 0.0, 0.1));
    dmg::WarnOfPreparation(this, view.Repair());

    const DistanceKey key{ this->Internals->Sources(whole[1], view), this->Internals->Options() };
    const std::vector<dmg::Vector3> targets = dmg::TargetsFrom(dmg::DataOf(whole[2]), view);
    const dmg::SurfaceDistance& distance = this->Internals->Distance(view, key, dmg::PartOfContext(context, 0.1, 0.6));
    this->Internals->WarnOf(distance.Field());

    view.StartOutput(vtkDataSet::GetData(outputVector, 0), this->GetClassName());
    const auto output = [&](double from, double to)
    { return dmg::DistanceOutput(distance, this->LengthScale, view, dmg::PartOfContext(context, from, to)); };
    output(0.6, 0.65).AddArrays();
    output(0.65, 0.7).MakeOffsetLines(
      this->OffsetDistances, this->NumberOfLevels, vtkPolyData::GetData(outputVector, 1));
    output(0.7, 1.0).MakePaths(targets, vtkPolyData::GetData(outputVector, 2), vtkTable::GetData(outputVector, 3));
    dmg::Warn(this, view.Warnings());
  };
  return dmg::MakeOutputs(this, request, inputVector, outputVector, make);
}

//------------------------------------------------------------------------------
void vtkSurfaceDistance::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  this->Properties().Print(os, indent);
  os << indent << "PointOnSurface: " << this->PointOnSurface[0] << " " << this->PointOnSurface[1] << " "
     << this->PointOnSurface[2] << "\n";
}
