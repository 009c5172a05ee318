#include "vtkScaleFilter.h"

#include "Adapters/Input/QuantitiesFromArrays.h"
#include "Adapters/Output/ScalesToArrays.h"
#include "Adapters/Pipeline/FilterOutputs.h"
#include "Adapters/Pipeline/PanelWords.h"
#include "Adapters/Pipeline/PropertyTable.h"
#include "Adapters/Surface/PolygonsFromDataSet.h"
#include "Adapters/Surface/PreparationToFieldData.h"
#include "Adapters/View/FlatMap.h"
#include "Adapters/View/GlobeLayout.h"
#include "Adapters/View/HiddenGaps.h"
#include "Adapters/View/SurfaceView.h"
#include "Flows/PeriodicSurfaces.h"
#ifdef DMG_PETSC
#include "Adapters/Output/ScalesOfPieces.h"
#endif

#include "vtkDataSet.h"
#include "vtkDataSetAttributes.h"
#include "vtkInformation.h"
#include "vtkInformationStringKey.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkTable.h"

#include <algorithm>
#include <string>
#include <vector>

vtkStandardNewMacro(vtkScaleFilter);

namespace
{

constexpr double AxisOfMaps[3] = { 0.0, 0.0, 1.0 };

}

class vtkScaleFilter::vtkInternals
{
public:
  std::vector<std::string> Arrays;
  std::vector<double> Wavelengths;
  dmg::ScaleSurface Surface;
#ifdef DMG_PETSC
  dmg::ScalesOfPieces Pieces;
#endif

  dmg::ScaleSurface::StageCounts Counts() const
  {
    dmg::ScaleSurface::StageCounts counts = this->Surface.Counts();
#ifdef DMG_PETSC
    counts.Setups += this->Pieces.Counts().Setups;
    counts.Splits += this->Pieces.Counts().Splits;
#endif
    return counts;
  }

  dmg::PropertyTable PropertiesOf(const vtkScaleFilter& filter) const
  {
    dmg::PropertyTable table;
    std::string arrays;
    for (const std::string& name : this->Arrays)
    {
      arrays += (arrays.empty() ? "'" : " '") + name + "'";
    }
    table.Text("Arrays", arrays);
    table.List("Wavelengths", this->Wavelengths);
    table.Number("Order", filter.Order, 1, 2);
    table.Choice("FlowKind", filter.FlowKind, { "Parts", "Wholes" });
    table.Switch("PartsApart", filter.PartsApart);
    table.Choice("Boundary", filter.Boundary, { "Closed", "Open" });
    table.Choice("Coordinates", filter.Coordinates, { "Space", "LongitudeAndLatitude" });
    table.Number("LengthScale", filter.LengthScale, 1e-30, 1e30);
    table.Vector("Axis", filter.Axis);
    table.Switch("Spectrum", filter.Spectrum);
    table.Number("SpectrumFrom", filter.SpectrumFrom, 0);
    table.Number("SpectrumTo", filter.SpectrumTo, 0);
    table.Number("SpectrumRows", filter.SpectrumRows, 1, 1000);
    table.Number("Tolerance", filter.Tolerance, 1e-14, 0.1);
    table.Choice("Solver", filter.Solver, { "Automatic", "Cholesky", "ConjugateGradients" });
    return table;
  }

  static dmg::ScaleSurface::Settings SettingsOf(const vtkScaleFilter& filter, bool isGlobe)
  {
    const auto solver = filter.Solver == Cholesky ? dmg::SolverKind::Cholesky
      : filter.Solver == ConjugateGradients       ? dmg::SolverKind::ConjugateGradients
                                                  : dmg::SolverKind::Automatic;
    const auto boundary = filter.Boundary == Closed ? dmg::FlowBoundary::Closed : dmg::FlowBoundary::Open;
    return { filter.Order, filter.LengthScale, solver, boundary, isGlobe, {} };
  }

  dmg::ScaleOptions OptionsOf(const vtkScaleFilter& filter) const
  {
    return { this->Wavelengths, filter.FlowKind == Wholes, filter.PartsApart, filter.Tolerance, filter.Spectrum,
      filter.SpectrumFrom, filter.SpectrumTo, filter.SpectrumRows };
  }

  static dmg::PreparationOptions PreparationOf(const vtkScaleFilter& filter)
  {
    return { dmg::Numbering::Spatial, filter.JoinPoints, filter.Strict };
  }

  dmg::QuantityArrays Quantities(vtkScaleFilter* filter, vtkDataSet* dataset) const
  {
    const dmg::Vector3 axis(filter->Coordinates == Space ? filter->Axis : AxisOfMaps);
    return dmg::FindQuantities(filter, this->Arrays, dataset, axis);
  }

  /// Collective. \return the reason why the outputs are not made in pieces; empty where they are.
  std::string MakeInPieces(vtkScaleFilter* filter, const dmg::RanksOfPipeline& ranks, vtkInformationVector** inputs,
    vtkInformationVector* outputs, const dmg::ExecutionContext& context)
  {
    ranks.Together([&] { this->PropertiesOf(*filter).Check(); });
    if (filter->Coordinates != Space)
    {
      return "maps are taken to the sphere on one process";
    }
#ifdef DMG_PETSC
    return this->Pieces.Filter(
      filter, [&](vtkDataSet* piece) { return this->Quantities(filter, piece); }, SettingsOf(*filter, false),
      this->OptionsOf(*filter), PreparationOf(*filter), ranks, inputs, outputs, context);
#else
    (void)inputs, (void)outputs, (void)context;
    return "the filters were built without DMG_PETSC, by which functions and vectors at points stay in pieces";
#endif
  }
};

//------------------------------------------------------------------------------
vtkScaleFilter::vtkScaleFilter()
  : Internals(new vtkInternals)
{
  this->SetNumberOfOutputPorts(2);
  this->SetInputArrayToProcess(
    0, 0, 0, vtkDataObject::FIELD_ASSOCIATION_POINTS_THEN_CELLS, vtkDataSetAttributes::VECTORS);
}

//------------------------------------------------------------------------------
vtkScaleFilter::~vtkScaleFilter() = default;

//------------------------------------------------------------------------------
void vtkScaleFilter::AddArray(const char* name)
{
  std::vector<std::string>& arrays = this->Internals->Arrays;
  if (name && *name && std::find(arrays.begin(), arrays.end(), name) == arrays.end())
  {
    arrays.emplace_back(name);
    this->Modified();
  }
}

//------------------------------------------------------------------------------
void vtkScaleFilter::ClearArrays()
{
  if (!this->Internals->Arrays.empty())
  {
    this->Internals->Arrays.clear();
    this->Modified();
  }
}

//------------------------------------------------------------------------------
int vtkScaleFilter::GetNumberOfArrays() const
{
  return static_cast<int>(this->Internals->Arrays.size());
}

//------------------------------------------------------------------------------
const char* vtkScaleFilter::GetArray(int index) const
{
  return index >= 0 && index < this->GetNumberOfArrays() ? this->Internals->Arrays[index].c_str() : nullptr;
}

//------------------------------------------------------------------------------
void vtkScaleFilter::AddWavelength(double wavelength)
{
  std::vector<double>& wavelengths = this->Internals->Wavelengths;
  if (std::find(wavelengths.begin(), wavelengths.end(), wavelength) == wavelengths.end())
  {
    wavelengths.push_back(wavelength);
    this->Modified();
  }
}

//------------------------------------------------------------------------------
void vtkScaleFilter::ClearWavelengths()
{
  if (!this->Internals->Wavelengths.empty())
  {
    this->Internals->Wavelengths.clear();
    this->Modified();
  }
}

//------------------------------------------------------------------------------
int vtkScaleFilter::GetNumberOfWavelengths() const
{
  return static_cast<int>(this->Internals->Wavelengths.size());
}

//------------------------------------------------------------------------------
double vtkScaleFilter::GetWavelength(int index) const
{
  return index >= 0 && index < this->GetNumberOfWavelengths() ? this->Internals->Wavelengths[index] : 0.0;
}

//------------------------------------------------------------------------------
int vtkScaleFilter::GetNumberOfSetups() const
{
  return this->Internals->Counts().Setups;
}

//------------------------------------------------------------------------------
int vtkScaleFilter::GetNumberOfSplits() const
{
  return this->Internals->Counts().Splits;
}

//------------------------------------------------------------------------------
int vtkScaleFilter::FillOutputPortInformation(int port, vtkInformation* information)
{
  information->Set(vtkDataObject::DATA_TYPE_NAME(), port == 0 ? "vtkDataSet" : "vtkTable");
  return 1;
}

//------------------------------------------------------------------------------
int vtkScaleFilter::RequestData(
  vtkInformation* request, vtkInformationVector** inputVector, vtkInformationVector* outputVector)
{
  const auto make = [&](vtkInformationVector** whole, const dmg::ExecutionContext& context)
  {
    this->Internals->PropertiesOf(*this).Check();
    const bool isMap = this->Coordinates == LongitudeAndLatitude;
    const dmg::Vector3 axis(isMap ? AxisOfMaps : this->Axis);

    dmg::SurfaceView view(dmg::SurfaceOf(whole[0]));
    const dmg::QuantityArrays quantities = this->Internals->Quantities(this, view.Given());
    const bool isGlobe = isMap || quantities.AreComponents();
    view.TakeIf<dmg::FlatMap>(isMap);
    view.TakeIf<dmg::GlobeLayout>(isGlobe, axis);
    view.TakeIf<dmg::HiddenGaps>(true, quantities.WithGaps(), "data"); // last: twins of gaps are gaps
    view.Prepare(vtkInternals::PreparationOf(*this), dmg::PartOfContext(context, 0.0, 0.05));

    dmg::ScaleSurface& surface = this->Internals->Surface;
    dmg::ScaleSurface::Settings settings = vtkInternals::SettingsOf(*this, isGlobe);
    settings.RelativeWavelengths = quantities.RelativeWavelengthsOn(view);
    surface.SetSurface(view.Prepared(), settings, dmg::PartOfContext(context, 0.05, 0.1));
    dmg::WarnOfPreparation(this, view.Repair());
    view.StartOutput(vtkDataSet::GetData(outputVector, 0), this->GetClassName());
    dmg::Warn(this,
      dmg::AddScales(surface, quantities, this->Internals->OptionsOf(*this), view, vtkTable::GetData(outputVector, 1),
        dmg::PartOfContext(context, 0.1, 1.0)));
    dmg::Warn(this, { dmg::WarningOfFoldedBox(view.Mesh()) });
    dmg::Warn(this, view.Warnings());
  };
  const auto makeInPieces =
    [&](const dmg::RanksOfPipeline& ranks, vtkInformationVector** pieces, const dmg::ExecutionContext& context)
  { return this->Internals->MakeInPieces(this, ranks, pieces, outputVector, context); };
  return dmg::MakeOutputs(this, request, inputVector, outputVector, make, makeInPieces);
}

//------------------------------------------------------------------------------
void vtkScaleFilter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  this->Internals->PropertiesOf(*this).Print(os, indent);
}
