#include "vtkParallelTransport.h"

#include "Adapters/Input/ConstraintsFromArrays.h"
#include "Adapters/Input/PlacedDirection.h"
#include "Adapters/Output/TransportToArrays.h"
#include "Adapters/Pipeline/ChosenPoint.h"
#include "Adapters/Pipeline/FilterOutputs.h"
#include "Adapters/Pipeline/InnerFilter.h"
#include "Adapters/Pipeline/PanelWords.h"
#include "Adapters/Pipeline/PropertyTable.h"
#include "Adapters/Surface/ArrayNames.h"
#include "Adapters/Surface/Kept.h"
#include "Adapters/Surface/PolygonsFromDataSet.h"
#include "Adapters/Surface/PreparationToFieldData.h"
#include "Adapters/View/SurfaceView.h"
#include "Support/Errors.h"

#include "vtkDataSet.h"
#include "vtkDataSetAttributes.h"
#include "vtkFieldGlyphs.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <optional>

vtkStandardNewMacro(vtkParallelTransport);

class vtkParallelTransport::vtkInternals
{
public:
  explicit vtkInternals(vtkParallelTransport* filter)
    : Engines(filter)
    , Point(filter, filter->PointOnSurface)
  {
  }

  dmg::Kept<dmg::EngineOfSurface<dmg::ParallelTransport, dmg::TransportOptions>> Engines;

  static dmg::PropertyTable PropertiesOf(const vtkParallelTransport& filter)
  {
    dmg::PropertyTable table;
    table.Vector("Point", filter.Point);
    table.Switch("UsePoint", filter.UsePoint);
    table.Vector("Direction", filter.Direction);
    table.Vector("Axis", filter.Axis);
    table.Switch("AddPoint", filter.AddPoint);
    table.Switch("LogarithmicMap", filter.LogarithmicMap);
    table.Number("TextureSize", filter.TextureSize, 0, 1e40);
    table.Number("TimeStep", filter.TimeStep, 0.01, 1000);
    table.Number("ArrowDistance", filter.ArrowDistance, 0.0005, 1);
    table.Number("NumberOfCircles", filter.NumberOfCircles, 0, 1000);
    return table;
  }

  /// Direction at the point of the map, which becomes PointOnSurface in the first leaf.
  dmg::PlacedDirection Place(vtkParallelTransport& filter, const dmg::FramedMesh& surface)
  {
    const auto place = filter.UsePoint ? std::make_optional<dmg::Vector3>(filter.Point) : std::nullopt;
    const dmg::PlacedDirection point = dmg::PlaceDirection(surface, place, dmg::Vector3(filter.Direction));
    this->Point.Add(point.Position);
    if (!point.IsGiven)
    {
      dmg::Warn(&filter,
        { "Direction is perpendicular to the surface at the point of the map; another direction takes its place." });
    }
    return point;
  }

  /// The logarithmic map at a point, as texture coordinates of the surface and as circles.
  static void WriteMapAt(const dmg::PlacedDirection& point, const vtkParallelTransport& filter,
    dmg::ParallelTransport& transport, const dmg::SurfaceView& view, vtkPolyData* circles,
    const dmg::ExecutionContext& context)
  {
    const dmg::FramedMesh& surface = view.Surface().Geometry;
    const dmg::Complex direction = surface.Vertices.ToComplex(point.Vertex, point.Direction);
    dmg::WriteMap(transport.Map(point.Vertex, direction, context), point.Vertex, transport.Sides(), filter.TextureSize,
      filter.NumberOfCircles, view, circles, context);
  }

private:
  dmg::ChosenPoint Point;
};

namespace
{

/// The vectors of the chosen arrays that count as sources; none where no array is chosen.
/// \throw dmg::InvalidInput as dmg::VectorArrays, or none of the vectors counts.
dmg::Constraints SourcesFromArrays(vtkAlgorithm* algorithm, const dmg::Vector3& axis, const dmg::SurfaceView& view)
{
  dmg::ConstraintArrays choices;
  choices.Vectors = dmg::ChoiceOf(algorithm, 0);
  choices.Eastward = dmg::ChoiceOf(algorithm, 1);
  choices.Northward = dmg::ChoiceOf(algorithm, 2);
  choices.Axis = axis;
  const dmg::VectorArrays arrays(
    { choices.Vectors, choices.Eastward, choices.Northward, axis }, view.Given(), "vectors", "the surface");
  if (arrays.AreNone())
  {
    return {};
  }
  dmg::UnusableDirections unusable;
  dmg::Constraints sources = dmg::ConstraintsFromArrays(choices, view.Given(), view.Surface(), unusable);
  if (sources.AreEmpty())
  {
    throw dmg::InvalidInput("no vector of the array '" + arrays.Name() +
      "' is finite, not zero and along the surface; give one, or choose no array to carry Direction from Point");
  }
  unusable.NotFinite = 0; // as where nothing is given
  dmg::Warn(algorithm, { unusable.AreNone() ? "" : dmg::TextOf(unusable) });
  return sources;
}

/// Draws the vectors that were carried.
void DrawArrows(vtkAlgorithm* algorithm, vtkDataSet* surface, double distance, vtkPolyData* output,
  const dmg::ExecutionContext& context)
{
  const auto carried = vtk::TakeSmartPointer(surface->NewInstance());
  carried->ShallowCopy(surface); // the pipeline of the glyphs writes into the data what was asked for
  vtkNew<vtkFieldGlyphs> arrows;
  arrows->SetInputData(carried);
  arrows->SetInputArrayToProcess(0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, dmg::ArrayNames::TransportedVectors);
  arrows->SetSeparatingDistance(distance);
  if (!dmg::UpdateInside(algorithm, arrows, context))
  {
    throw dmg::InvalidInput("the arrows could not be drawn, as the warning before says; raise Arrow Distance");
  }
  output->ShallowCopy(arrows->GetOutput());
}

}

//------------------------------------------------------------------------------
vtkParallelTransport::vtkParallelTransport()
  : Internals(new vtkInternals(this))
{
  this->SetNumberOfOutputPorts(3);
}

//------------------------------------------------------------------------------
vtkParallelTransport::~vtkParallelTransport() = default;

//------------------------------------------------------------------------------
void vtkParallelTransport::SetPoint(double x, double y, double z)
{
  this->SetPointOfPanel(x, y, z);
  this->UsePointOn();
}

//------------------------------------------------------------------------------
void vtkParallelTransport::SetPointOfPanel(double x, double y, double z)
{
  const double point[] = { x, y, z };
  if (!std::equal(point, point + 3, this->Point))
  {
    std::copy_n(point, 3, this->Point);
    this->Modified();
  }
}

//------------------------------------------------------------------------------
int vtkParallelTransport::GetNumberOfSetups() const
{
  return this->Internals->Engines.Counts().Setups;
}

//------------------------------------------------------------------------------
int vtkParallelTransport::GetNumberOfSolves() const
{
  return this->Internals->Engines.Counts().Solves;
}

//------------------------------------------------------------------------------
int vtkParallelTransport::FillOutputPortInformation(int port, vtkInformation* information)
{
  information->Set(vtkDataObject::DATA_TYPE_NAME(), port == 0 ? "vtkDataSet" : "vtkPolyData");
  return 1;
}

//------------------------------------------------------------------------------
int vtkParallelTransport::RequestData(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  const auto make = [&](vtkInformationVector** whole, const dmg::ExecutionContext& context)
  {
    vtkInternals::PropertiesOf(*this).Check();
    dmg::SurfaceView view(dmg::SurfaceOf(whole[0]));
    view.Prepare({ dmg::Numbering::Spatial, this->JoinPoints, this->Strict }, dmg::PartOfContext(context, 0.0, 0.1));
    const dmg::FramedMesh& surface = view.Surface().Geometry;
    const dmg::TransportOptions options{ this->TimeStep };
    dmg::ParallelTransport& transport =
      this->Internals->Engines.Of(view.Prepared()->Digest)
        .Take(view.Prepared(), options,
          [&] { return dmg::ParallelTransport(surface, options, dmg::PartOfContext(context, 0.1, 0.2)); });
    dmg::WarnOfPreparation(this, view.Repair());
    view.StartOutput(vtkDataSet::GetData(outputVector, 0), this->GetClassName());

    dmg::Constraints sources = SourcesFromArrays(this, dmg::Vector3(this->Axis), view);
    const bool isPointSource = this->AddPoint || sources.AreEmpty();
    if (isPointSource || this->LogarithmicMap)
    {
      const dmg::PlacedDirection point = this->Internals->Place(*this, surface);
      if (isPointSource)
      {
        sources.AtVertices.push_back({ point.Vertex, point.Direction, 1.0 });
      }
      if (this->LogarithmicMap)
      {
        vtkInternals::WriteMapAt(
          point, *this, transport, view, vtkPolyData::GetData(outputVector, 2), dmg::PartOfContext(context, 0.2, 0.7));
      }
    }
    dmg::CheckSizes(sources, view.Relation().Names());
    const dmg::TransportedField field = transport.Carry(sources, dmg::PartOfContext(context, 0.7, 0.9));
    dmg::WriteTransported(field, view, context);
    dmg::Warn(this, field.Warnings);
    DrawArrows(this, view.Output(), this->ArrowDistance, vtkPolyData::GetData(outputVector, 1),
      dmg::PartOfContext(context, 0.9, 1.0));
  };
  return dmg::MakeOutputs(this, request, inputVector, outputVector, make);
}

//------------------------------------------------------------------------------
void vtkParallelTransport::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  vtkInternals::PropertiesOf(*this).Print(os, indent);
  os << indent << "PointOnSurface: " << this->PointOnSurface[0] << " " << this->PointOnSurface[1] << " "
     << this->PointOnSurface[2] << "\n";
}
