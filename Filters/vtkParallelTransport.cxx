#include "vtkParallelTransport.h"

#include "Adapters/Input/ConstraintsFromArrays.h"
#include "Adapters/Output/TransportToArrays.h"
#include "Adapters/Pipeline/FilterOutputs.h"
#include "Adapters/Pipeline/InnerFilter.h"
#include "Adapters/Pipeline/PanelWords.h"
#include "Adapters/Pipeline/PropertyRanges.h"
#include "Adapters/Surface/ArrayNames.h"
#include "Adapters/Surface/PolygonsFromDataSet.h"
#include "Adapters/Surface/PreparationToFieldData.h"
#include "Support/Errors.h"

#include "vtkCommand.h"
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
#include <limits>
#include <optional>
#include <string>

vtkStandardNewMacro(vtkParallelTransport);

class vtkParallelTransport::vtkInternals
{
public:
  dmg::TransportSurface Surface;
  int Places = 0; ///< of maps in this execution: one for each leaf of a composite dataset

  /// The executions of leaves begin and end within that of their composite dataset.
  void BeginExecution()
  {
    if (this->OpenExecutions++ == 0)
    {
      this->Places = 0;
    }
  }
  void EndExecution() { this->OpenExecutions = std::max(0, this->OpenExecutions - 1); }

private:
  int OpenExecutions = 0;
};

namespace
{

constexpr double NotANumber = std::numeric_limits<double>::quiet_NaN();

/// The vectors of an array that count as sources; none where no array is chosen.
/// \param warnings for the user.
/// \throw dmg::InvalidInput there is no such array, or none of its vectors counts.
dmg::Constraints SourcesFromArray(
  const dmg::ChosenArray& choice, vtkDataSet* input, const dmg::FramedSurface& surface, std::string& warning)
{
  dmg::ConstraintArrays choices;
  choices.Vectors = choice;
  if (!dmg::FindArray(choice, input, 3, "vectors", "the surface").Array)
  {
    return {};
  }
  dmg::UnusableDirections unusable;
  dmg::Constraints sources = dmg::ConstraintsFromArrays(choices, input, surface, unusable);
  if (sources.AreEmpty())
  {
    throw dmg::InvalidInput("no vector of the array '" + choice.Name +
      "' is finite, not zero and along the surface; give one, or choose no array to carry Direction from Point");
  }
  unusable.NotFinite = 0; // as where nothing is given
  warning = unusable.AreNone() ? "" : dmg::TextOf(unusable);
  return sources;
}

}

//------------------------------------------------------------------------------
vtkParallelTransport::vtkParallelTransport()
  : Internals(new vtkInternals)
{
  std::fill_n(this->PointOnSurface, 3, NotANumber);
  this->SetNumberOfOutputPorts(3);
  this->AddObserver(vtkCommand::StartEvent, this->Internals.get(), &vtkInternals::BeginExecution);
  this->AddObserver(vtkCommand::EndEvent, this->Internals.get(), &vtkInternals::EndExecution);
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
  return this->Internals->Surface.Counts().Setups;
}

//------------------------------------------------------------------------------
int vtkParallelTransport::GetNumberOfSolves() const
{
  return this->Internals->Surface.Counts().Solves;
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
  std::fill_n(this->PointOnSurface, 3, NotANumber);
  vtkDataSet* const output = vtkDataSet::GetData(outputVector, 0);
  const auto make = [&](vtkInformationVector** whole, const dmg::ExecutionContext& context)
  {
    dmg::CheckRanges({ { "Texture Size", this->TextureSize, 0, 1e40 }, { "Time Step", this->TimeStep, 0.01, 1000 },
      { "Arrow Distance", this->ArrowDistance, 0.0005, 1 }, { "Number Of Circles", this->NumberOfCircles, 0, 1000 } });
    const vtkSmartPointer<vtkDataSet> input = dmg::SurfaceOf(whole[0]);
    const dmg::PreparationOptions preparation{ dmg::Numbering::Spatial, this->JoinPoints, this->Strict };
    dmg::TransportSurface& surface = this->Internals->Surface;
    surface.SetSurface(input, preparation, { this->TimeStep }, dmg::PartOfContext(context, 0.0, 0.2));
    dmg::WarnOfPreparation(this, surface.Preparation());
    output->ShallowCopy(input);
    dmg::RemoveTransportArrays(output);
    dmg::AddPreparation(surface.Preparation(), preparation, output->GetFieldData());
    const auto warn = [this](const std::string& warning) { vtkWarningMacro(<< dmg::InPanelWords(warning)); };

    std::string warning;
    dmg::Constraints sources = SourcesFromArray(dmg::ChoiceOf(this, 0), input, surface.Surface(), warning);
    if (!warning.empty())
    {
      warn(warning);
    }
    const bool isPointSource = this->AddPoint || sources.AreEmpty();
    if (isPointSource || this->LogarithmicMap)
    {
      const std::optional<dmg::Vector3> place =
        this->UsePoint ? std::make_optional<dmg::Vector3>(this->Point) : std::nullopt;
      const dmg::PlacedDirection point = surface.Place(place, dmg::Vector3(this->Direction));
      if (this->Internals->Places++ == 0)
      {
        std::copy_n(point.Position.data(), 3, this->PointOnSurface);
      }
      if (!point.IsGiven)
      {
        warn("Direction is perpendicular to the surface at the point of the map; another direction takes its place.");
      }
      if (isPointSource)
      {
        sources.AtVertices.push_back({ point.Vertex, point.Direction, 1.0 });
      }
      if (this->LogarithmicMap)
      {
        surface.AddMap(point, this->TextureSize, this->NumberOfCircles, input, output,
          vtkPolyData::GetData(outputVector, 2), dmg::PartOfContext(context, 0.2, 0.7));
      }
    }
    for (const std::string& text : surface.AddVectors(sources, input, output, dmg::PartOfContext(context, 0.7, 0.9)))
    {
      warn(text);
    }
    // A copy: the pipeline of the glyphs writes into the data what was asked for.
    const auto carried = vtk::TakeSmartPointer(output->NewInstance());
    carried->ShallowCopy(output);
    vtkNew<vtkFieldGlyphs> arrows;
    arrows->SetInputData(carried);
    arrows->SetInputArrayToProcess(
      0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_CELLS, dmg::ArrayNames::TransportedVectors);
    arrows->SetSeparatingDistance(this->ArrowDistance);
    if (!dmg::UpdateInside(this, arrows, dmg::PartOfContext(context, 0.9, 1.0)))
    {
      throw dmg::InvalidInput("the arrows could not be drawn, as the warning before says; raise Arrow Distance");
    }
    vtkPolyData::GetData(outputVector, 1)->ShallowCopy(arrows->GetOutput());
  };
  return dmg::MakeOutputs(this, request, inputVector, outputVector, make);
}

//------------------------------------------------------------------------------
void vtkParallelTransport::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Point: " << this->Point[0] << " " << this->Point[1] << " " << this->Point[2] << "\n";
  os << indent << "UsePoint: " << (this->UsePoint ? "On" : "Off") << "\n";
  os << indent << "PointOnSurface: " << this->PointOnSurface[0] << " " << this->PointOnSurface[1] << " "
     << this->PointOnSurface[2] << "\n";
  os << indent << "Direction: " << this->Direction[0] << " " << this->Direction[1] << " " << this->Direction[2] << "\n";
  os << indent << "AddPoint: " << (this->AddPoint ? "On" : "Off") << "\n";
  os << indent << "LogarithmicMap: " << (this->LogarithmicMap ? "On" : "Off") << "\n";
  os << indent << "TextureSize: " << this->TextureSize << "\n";
  os << indent << "ArrowDistance: " << this->ArrowDistance << "\n";
  os << indent << "NumberOfCircles: " << this->NumberOfCircles << "\n";
  os << indent << "TimeStep: " << this->TimeStep << "\n";
}
