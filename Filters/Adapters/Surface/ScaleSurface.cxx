#include "Adapters/Surface/ScaleSurface.h"

#include <utility>

namespace dmg
{

void ScaleSurface::SetSurface(
  const std::shared_ptr<const PreparedDataSet>& surface, const Settings& settings, const ExecutionContext& context)
{
  if (this->Prepared == surface && this->SettingsOfFilters.IsEqual(settings) && this->PartsOfFlows)
  {
    return;
  }
  if (this->OfOthers)
  {
    this->Forget();
  }
  this->Functions.reset();
  this->Vectors.reset();
  this->Flows.reset();
  const bool isSameSurface = this->Prepared == surface && this->PartsOfFlows &&
    this->SettingsOfFilters.IsGlobe == settings.IsGlobe && this->SettingsOfFilters.Solver == settings.Solver;
  if (!isSameSurface)
  {
    const FramedMesh& on = surface->Geometry;
    auto corners = Corners(on.Mesh, SideDirections(on.Mesh, on.Faces, context), on.Faces, on.Vertices, context);
    this->PartsOfFlows.reset();
    this->Prepared = surface;
    this->CornersOfFaces = std::move(corners);
    SolverOptions solver;
    solver.Kind = settings.Solver;
    this->PartsOfFlows.emplace(on, settings.Boundary, solver, settings.IsGlobe);
  }
  this->PartsOfFlows->SetBoundary(settings.Boundary);
  this->SettingsOfFilters = settings;
}

ScaleFilterOptions ScaleSurface::OptionsOf(ScaledQuantity quantity) const
{
  ScaleFilterOptions options;
  options.Quantity = quantity;
  options.Order = this->SettingsOfFilters.Order;
  options.LengthScale = this->SettingsOfFilters.LengthScale;
  options.Solver.Kind = this->SettingsOfFilters.Solver;
  options.RelativeWavelengths = this->SettingsOfFilters.RelativeWavelengths;
  return options;
}

void ScaleSurface::SetFilters(const FramedMesh& surface, const Settings& settings, MakeFilter make)
{
  if (!this->OfOthers || !this->SettingsOfFilters.IsEqual(settings))
  {
    this->Forget();
    this->OfOthers = &surface;
    this->Make = std::move(make);
    this->SettingsOfFilters = settings;
  }
}

void ScaleSurface::Forget()
{
  this->Functions.reset();
  this->Vectors.reset();
  this->Flows.reset();
  this->PartsOfFlows.reset();
  this->Prepared.reset();
  this->Make = nullptr;
  this->OfOthers = nullptr;
}

ScaleFilter& ScaleSurface::Take(
  std::optional<ScaleFilter>& filter, ScaledQuantity quantity, const ExecutionContext& context)
{
  if (!filter)
  {
    const ScaleFilterOptions options = this->OptionsOf(quantity);
    filter.emplace(
      this->Make ? this->Make(options, context) : ScaleFilter(this->PartsOfFlows->Setups(), options, context));
    this->CountsOfStages.Setups += filter->HasNewSetup() ? 1 : 0;
  }
  return *filter;
}

FlowScales& ScaleSurface::OfFlows(const ExecutionContext& context)
{
  if (!this->Flows)
  {
    this->Flows.emplace(*this->PartsOfFlows, this->OptionsOf(ScaledQuantity::Function), context);
    this->CountsOfStages.Setups += this->Flows->HasNewSetup() ? 1 : 0;
  }
  return *this->Flows;
}

}
