#include "vtkHodgeDecomposition.h"

#include "Adapters/Input/FlowFromArrays.h"
#include "Adapters/Input/FlowFromEdges.h"
#include "Adapters/Input/OpenBoundary.h"
#include "Adapters/Output/FlowToArrays.h"
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
#include <string>

vtkStandardNewMacro(vtkHodgeDecomposition);

namespace
{

constexpr double AxisOfMaps[3] = { 0.0, 0.0, 1.0 };

}

class vtkHodgeDecomposition::vtkInternals
{
public:
  /// A decomposition is made with these; all else may change from flow to flow.
  struct Setup
  {
    dmg::SolverOptions Solver;
    bool IsGlobe = false;

    friend bool operator==(const Setup& a, const Setup& b)
    {
      const auto& [solver, isGlobe] = a; // all members
      return solver == b.Solver && isGlobe == b.IsGlobe;
    }
  };

  explicit vtkInternals(vtkAlgorithm* filter)
    : Engines(filter)
  {
  }

  /// The decomposition for a surface.
  dmg::HodgeDecomposition& Of(const dmg::SurfaceView& view, const Setup& setup)
  {
    return this->Engines.Of(view.Prepared()->Digest)
      .Take(view.Prepared(), setup,
        [&] {
          return dmg::HodgeDecomposition(
            view.Surface().Geometry, dmg::FlowBoundary::Closed, setup.Solver, setup.IsGlobe);
        });
  }

  dmg::Kept<dmg::EngineOfSurface<dmg::HodgeDecomposition, Setup>> Engines;

  static dmg::PropertyTable PropertiesOf(const vtkHodgeDecomposition& filter)
  {
    dmg::PropertyTable table;
    table.Text("EdgeArray", filter.EdgeArray);
    table.Choice("Coordinates", filter.Coordinates, { "Space", "LongitudeAndLatitude" });
    table.Choice("Boundary", filter.Boundary, { "Closed", "Open" });
    table.Choice("EdgeValues", filter.EdgeValues, { "Integrals", "Components" });
    table.Choice("Solver", filter.Solver, { "Automatic", "Cholesky", "ConjugateGradients" });
    table.Number("ExpectedSolves", filter.ExpectedSolves, 1);
    table.Number("NumberOfContours", filter.NumberOfContours, 0, 1000);
    table.Number("Lift", filter.Lift, 0, 0.1);
    table.Number("ReferenceBoundary", filter.ReferenceBoundary, 0);
    table.Number("LengthScale", filter.LengthScale, 1e-30, 1e30);
    table.Switch("GradientPart", filter.GradientPart);
    table.Switch("RotationalPart", filter.RotationalPart);
    table.Switch("HarmonicPart", filter.HarmonicPart);
    table.Switch("SteeringFlow", filter.SteeringFlow);
    table.Switch("Derivatives", filter.Derivatives);
    table.Vector("Axis", filter.Axis);
    return table;
  }

  /// Each time of the input is a flow, of two solves.
  static dmg::SolverOptions SolverOf(const vtkHodgeDecomposition& filter, vtkInformation* input)
  {
    dmg::SolverOptions options;
    options.Kind = filter.Solver == Cholesky ? dmg::SolverKind::Cholesky
      : filter.Solver == ConjugateGradients  ? dmg::SolverKind::ConjugateGradients
                                             : dmg::SolverKind::Automatic;
    const int timeSteps = input->Length(vtkStreamingDemandDrivenPipeline::TIME_STEPS());
    options.ExpectedSolves = std::max(filter.ExpectedSolves, 2 * timeSteps);
    return options;
  }

  static dmg::FlowOptions OutputsOf(const vtkHodgeDecomposition& filter, bool isOfEdges)
  {
    return { { filter.GradientPart, filter.RotationalPart, filter.HarmonicPart, filter.SteeringFlow },
      filter.Derivatives, filter.LengthScale, filter.NumberOfContours, filter.ReferenceBoundary, filter.Lift,
      isOfEdges && filter.EdgeValues == Components };
  }
};

//------------------------------------------------------------------------------
vtkHodgeDecomposition::vtkHodgeDecomposition()
  : Internals(new vtkInternals(this))
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
  return this->Internals->Engines.Counts().Setups;
}

//------------------------------------------------------------------------------
int vtkHodgeDecomposition::GetNumberOfBases() const
{
  return this->Internals->Engines.Counts().Bases;
}

//------------------------------------------------------------------------------
int vtkHodgeDecomposition::GetNumberOfSolves() const
{
  return this->Internals->Engines.Counts().Solves;
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
  const auto make = [&](vtkInformationVector** whole, const dmg::ExecutionContext& context)
  {
    vtkInternals::PropertiesOf(*this).Check();
    vtkDataSet* const edges = whole[1]->GetNumberOfInformationObjects() > 0 ? vtkDataSet::GetData(whole[1]) : nullptr;
    const bool isMap = this->Coordinates == LongitudeAndLatitude;
    const dmg::Vector3 axis(isMap ? AxisOfMaps : this->Axis);

    dmg::SurfaceView view(dmg::SurfaceOf(whole[0]));
    const auto arrays = edges ? dmg::VectorArrays() : dmg::ArraysOfFlow(this, view.Given(), axis);
    const bool isGlobe = isMap || arrays.AreComponents();
    view.TakeIf<dmg::FlatMap>(isMap);
    view.TakeIf<dmg::GlobeLayout>(isGlobe, axis);
    view.TakeIf<dmg::HiddenGaps>(!edges, arrays, "flow"); // last: twins of gaps are gaps
    view.Prepare({ dmg::Numbering::Spatial, this->JoinPoints, this->Strict }, dmg::PartOfContext(context, 0.0, 0.05));

    const dmg::SolverOptions solver = vtkInternals::SolverOf(*this, whole[0]->GetInformationObject(0));
    dmg::HodgeDecomposition& decomposition = this->Internals->Of(view, { solver, isGlobe });
    const auto boundary = this->Boundary == Closed ? dmg::FlowBoundary::Closed : dmg::FlowBoundary::Open;
    decomposition.SetBoundary(dmg::OpenEdgesOf(dmg::ChoiceOf(this, 3), boundary, view));
    const dmg::FaceFlow flow = edges
      ? dmg::FlowFromEdges(edges, { this->EdgeArray, this->EdgeValues == Integrals }, view, context)
      : dmg::FlowFromArrays(view, arrays, dmg::PartOfContext(context, 0.08, 0.1));

    dmg::WarnOfPreparation(this, view.Repair());
    view.StartOutput(vtkDataSet::GetData(outputVector, 0), this->GetClassName());
    const dmg::FlowOptions outputs = vtkInternals::OutputsOf(*this, edges != nullptr);
    const dmg::DecomposedFlow parts =
      decomposition.Decompose(flow.Tangential, outputs.Parts, { 1e-11, 200 }, dmg::PartOfContext(context, 0.1, 0.8));
    const std::string ofArrays =
      dmg::WriteFlow(parts, decomposition, flow, outputs, view, vtkPolyData::GetData(outputVector, 1),
        vtkPolyData::GetData(outputVector, 2), dmg::PartOfContext(context, 0.8, 1.0));
    dmg::Warn(this, parts.Warnings);
    dmg::Warn(this, { dmg::WarningOfFoldedBox(view.Mesh()), flow.Warning, ofArrays });
    dmg::Warn(this, view.Warnings());
  };
  return dmg::MakeOutputs(this, request, inputVector, outputVector, make);
}

//------------------------------------------------------------------------------
void vtkHodgeDecomposition::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  vtkInternals::PropertiesOf(*this).Print(os, indent);
}
