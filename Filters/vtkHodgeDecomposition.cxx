#include "vtkHodgeDecomposition.h"

#include "Adapters/Input/FlowFromArrays.h"
#include "Adapters/Input/FlowFromEdges.h"
#include "Adapters/Input/OpenBoundary.h"
#include "Adapters/Output/FlowToArrays.h"
#include "Adapters/Pipeline/FilterOutputs.h"
#include "Adapters/Pipeline/FilterRequests.h"
#include "Adapters/Pipeline/PanelWords.h"
#include "Adapters/Pipeline/PropertyRanges.h"
#include "Adapters/Surface/FlatMap.h"
#include "Adapters/Surface/GlobeLayout.h"
#include "Adapters/Surface/PolygonsFromDataSet.h"
#include "Adapters/Surface/PreparationToFieldData.h"
#include "Flows/PeriodicSurfaces.h"

#include "vtkDataSet.h"
#include "vtkDataSetAttributes.h"
#include "vtkInformation.h"
#include "vtkInformationDoubleVectorKey.h"
#include "vtkInformationStringKey.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPolyData.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>
#include <optional>
#include <string>
#include <vector>

vtkStandardNewMacro(vtkHodgeDecomposition);

class vtkHodgeDecomposition::vtkInternals
{
public:
  dmg::FlowSurface Surface;
};

namespace
{

constexpr double DefaultAxis[3] = { 0.0, 0.0, 1.0 }; // of maps

}

//------------------------------------------------------------------------------
vtkHodgeDecomposition::vtkHodgeDecomposition()
  : Internals(new vtkInternals)
{
  this->SetNumberOfInputPorts(2);
  this->SetNumberOfOutputPorts(3);
  this->SetInputArrayToProcess(
    0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS_THEN_CELLS, vtkDataSetAttributes::VECTORS);
}

//------------------------------------------------------------------------------
vtkHodgeDecomposition::~vtkHodgeDecomposition() = default;

//------------------------------------------------------------------------------
int vtkHodgeDecomposition::GetNumberOfSetups() const
{
  return this->Internals->Surface.Counts().Setups;
}

//------------------------------------------------------------------------------
int vtkHodgeDecomposition::GetNumberOfBases() const
{
  return this->Internals->Surface.Counts().Bases;
}

//------------------------------------------------------------------------------
int vtkHodgeDecomposition::GetNumberOfSolves() const
{
  return this->Internals->Surface.Counts().Solves;
}

//------------------------------------------------------------------------------
int vtkHodgeDecomposition::FillInputPortInformation(int port, vtkInformation* information)
{
  if (port == 1)
  {
    information->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  }
  return dmg::TakeAnyDataSet(information);
}

//------------------------------------------------------------------------------
int vtkHodgeDecomposition::FillOutputPortInformation(int port, vtkInformation* information)
{
  information->Set(vtkDataObject::DATA_TYPE_NAME(), port == 0 ? "vtkDataSet" : "vtkPolyData");
  return 1;
}

//------------------------------------------------------------------------------
int vtkHodgeDecomposition::RequestData(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  vtkDataSet* const output = vtkDataSet::GetData(outputVector, 0);
  const auto make = [&](vtkInformationVector** whole, const dmg::ExecutionContext& context)
  {
    dmg::CheckRanges({ { "Coordinates", this->Coordinates, Space, LongitudeAndLatitude },
      { "Boundary", this->Boundary, Closed, Open }, { "Edge Values", this->EdgeValues, Integrals, Components },
      { "Solver", this->Solver, Automatic, ConjugateGradients }, { "Expected Solves", this->ExpectedSolves, 1 },
      { "Number Of Contours", this->NumberOfContours, 0, 1000 }, { "Lift", this->Lift, 0, 0.1 },
      { "Reference Boundary", this->ReferenceBoundary, 0 }, { "Length Scale", this->LengthScale, 1e-30, 1e30 } });
    dmg::SolverOptions options;
    options.Kind = this->Solver == Cholesky ? dmg::SolverKind::Cholesky
      : this->Solver == ConjugateGradients  ? dmg::SolverKind::ConjugateGradients
                                            : dmg::SolverKind::Automatic;
    const int timeSteps = whole[0]->GetInformationObject(0)->Length(vtkStreamingDemandDrivenPipeline::TIME_STEPS());
    options.ExpectedSolves = std::max(this->ExpectedSolves, 2 * timeSteps);
    const vtkSmartPointer<vtkDataSet> input = dmg::SurfaceOf(whole[0]);
    const bool isMap = this->Coordinates == LongitudeAndLatitude;
    const vtkSmartPointer<vtkDataSet> inSpace = isMap ? dmg::GlobeOfMap(input) : input;
    vtkDataSet* const edges = whole[1]->GetNumberOfInformationObjects() > 0 ? vtkDataSet::GetData(whole[1]) : nullptr;
    std::optional<dmg::ChosenFlow> chosen;
    if (!edges)
    {
      chosen.emplace(this, inSpace, dmg::Vector3(isMap ? DefaultAxis : this->Axis), isMap);
    }
    const bool isGlobe = isMap || (chosen && chosen->IsOnGlobe());
    const dmg::Vector3 axis(isMap ? DefaultAxis : this->Axis);
    std::optional<dmg::GlobeLayout> layout;
    if (isGlobe)
    {
      layout.emplace(inSpace, axis);
    }
    const vtkSmartPointer<vtkDataSet> laidOut = layout ? layout->Globe() : inSpace.Get();
    const vtkSmartPointer<vtkDataSet> withFlow = chosen ? chosen->WithFlow(laidOut) : laidOut;
    const dmg::PreparationOptions preparation{ dmg::Numbering::Spatial, this->JoinPoints, this->Strict };
    dmg::FlowSurface& surface = this->Internals->Surface;
    surface.SetSurface(withFlow, preparation, options, isGlobe, dmg::PartOfContext(context, 0.0, 0.1));
    const std::vector<char> isOpen = dmg::OpenEdgesOf(dmg::ChoiceOf(this, 3), input, surface.Surface());
    const dmg::FlowBoundary kind = this->Boundary == Closed ? dmg::FlowBoundary::Closed : dmg::FlowBoundary::Open;
    surface.SetBoundary(isOpen.empty() ? dmg::OpenEdges(surface.Surface().Geometry.Mesh, kind) : isOpen);
    const dmg::FaceFlow flow = chosen ? chosen->On(surface.Surface(), dmg::PartOfContext(context, 0.05, 0.1))
                                      : dmg::FlowFromEdges(edges, { this->EdgeArray, this->EdgeValues == Integrals },
                                          input, surface.Surface(), context);
    const dmg::FlowOptions wanted{ { this->GradientPart, this->RotationalPart, this->HarmonicPart, this->SteeringFlow },
      this->Derivatives, this->LengthScale, this->NumberOfContours, this->ReferenceBoundary, this->Lift,
      edges && this->EdgeValues == Components };
    dmg::WarnOfPreparation(this, surface.Preparation());
    output->ShallowCopy(input);
    dmg::AddPreparation(surface.Preparation(), preparation, output->GetFieldData());
    vtkPolyData* const streamlines = vtkPolyData::GetData(outputVector, 1);
    vtkPolyData* const boundaries = vtkPolyData::GetData(outputVector, 2);
    std::vector<std::string> warnings =
      surface.Decompose(flow, wanted, withFlow, output, streamlines, boundaries, dmg::PartOfContext(context, 0.1, 1.0));
    const dmg::TriangleMesh& mesh = surface.Surface().Geometry.Mesh;
    warnings.push_back(dmg::WarningOfFoldedBox(mesh));
    if (isGlobe)
    {
      layout->CopyToTwins(output, dmg::NamesOfFlowArrays());
      warnings.push_back(dmg::WarningOfSlit(mesh, axis));
    }
    if (isMap)
    {
      dmg::TurnToMap(input, output, dmg::NamesOfParts());
      dmg::TakeLinesToMap(input, streamlines);
      dmg::TakeLinesToMap(input, boundaries);
    }
    if (chosen)
    {
      chosen->MarkCellsWithoutFlow(output, surface.Surface().Relation, dmg::NamesOfFlowArrays());
      warnings.push_back(chosen->Warning());
    }
    for (const std::string& warning : warnings)
    {
      if (!warning.empty())
      {
        vtkWarningMacro(<< dmg::InPanelWords(warning));
      }
    }
  };
  return dmg::MakeOutputs(this, request, inputVector, outputVector, make);
}

//------------------------------------------------------------------------------
void vtkHodgeDecomposition::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  const char* const boundaries[] = { "Closed", "Open" };
  const char* const solvers[] = { "Automatic", "Cholesky", "ConjugateGradients" };
  os << indent << "EdgeArray: " << this->EdgeArray << "\n";
  os << indent << "EdgeValues: " << (this->EdgeValues == Integrals ? "Integrals" : "Components") << "\n";
  os << indent << "Boundary: " << dmg::NameOf(boundaries, this->Boundary) << "\n";
  os << indent << "GradientPart: " << this->GradientPart << "\n";
  os << indent << "RotationalPart: " << this->RotationalPart << "\n";
  os << indent << "HarmonicPart: " << this->HarmonicPart << "\n";
  os << indent << "SteeringFlow: " << this->SteeringFlow << "\n";
  os << indent << "Derivatives: " << this->Derivatives << "\n";
  os << indent << "NumberOfContours: " << this->NumberOfContours << "\n";
  os << indent << "ReferenceBoundary: " << this->ReferenceBoundary << "\n";
  os << indent << "Lift: " << this->Lift << "\n";
  os << indent << "LengthScale: " << this->LengthScale << "\n";
  os << indent << "Coordinates: " << (this->Coordinates == Space ? "Space" : "LongitudeAndLatitude") << "\n";
  os << indent << "Axis: " << this->Axis[0] << " " << this->Axis[1] << " " << this->Axis[2] << "\n";
  os << indent << "Solver: " << dmg::NameOf(solvers, this->Solver) << "\n";
  os << indent << "ExpectedSolves: " << this->ExpectedSolves << "\n";
}
