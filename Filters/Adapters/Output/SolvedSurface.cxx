#include "Adapters/Output/SolvedSurface.h"

#include "Adapters/Output/ReportToArrays.h"
#include "Adapters/Surface/ArrayNames.h"
#include "FieldSetup.h"
#include "Support/Errors.h"

#include "vtkPolyData.h"

#include <chrono>
#include <utility>

namespace dmg
{
namespace
{

using Clock = std::chrono::steady_clock;

double SecondsSince(Clock::time_point start)
{
  return std::chrono::duration<double>(Clock::now() - start).count();
}

}

void SolvedSurface::SetSurface(vtkPolyData* input, const FieldOptions& options, const ExecutionContext& context)
{
  const std::string digest = ContentDigest(input);
  const auto stored = WantsDecimation(options) ? OperatorsOriginOf(input->GetFieldData()) : std::nullopt;
  if (stored && stored->Digest != digest)
  {
    throw InvalidInput("the surface is another than the one its operators were built for "
                       "(field array '" +
      std::string(ArrayNames::ProlongationDigest) + "' says " + stored->Digest + ", the points and triangles give " +
      digest +
      "); apply Directional Prolongation (vtkDirectionalProlongation) after the last filter that changes the surface");
  }
  // Operators that are stored number the elements as the input does.
  const dmg::Numbering order = stored ? dmg::Numbering::OfPolyData : dmg::Numbering::Spatial;
  if (!this->Solver || this->Digest != digest || this->Order != order)
  {
    const auto start = Clock::now();
    SurfaceMesh surface = MeshFromPolyData(input, order, context);
    auto solver = std::make_unique<FieldSolver>(std::move(surface.Mesh), context);
    this->OfFormerSurfaces = this->Counts();
    this->Digest.clear(); // until all that follows is made
    this->PlacesOfSurface.reset();
    this->Solved = nullptr;
    this->WithSingularities.reset(); // it refers to the former surface
    this->Arrays.reset();
    this->Shown.reset();
    this->CurvaturesAtScale.reset();
    this->BasisOfSurface.reset();
    this->Read.clear();
    this->OperatorsSeconds = 0.0;
    this->Solver = std::move(solver);
    this->Numbers = std::move(static_cast<SurfaceNumbering&>(surface));
    this->Digest = digest;
    this->Order = order;
    this->SurfaceSeconds = SecondsSince(start);
  }
  this->Solver->SetOperators(stored ? this->Operators(input, *stored) : nullptr);
}

/// The operators that the input brings along.
std::shared_ptr<const ProlongationOperators> SolvedSurface::Operators(vtkPolyData* input, const OperatorsOrigin& origin)
{
  for (const auto& [known, operators] : this->Read)
  {
    if (known == origin)
    {
      return operators;
    }
  }
  const auto start = Clock::now();
  const bool isFirst = this->Solver->Counts().Setups == 0; // then the solver counts it
  this->Read.emplace_back(origin,
    std::make_shared<const ProlongationOperators>(
      OperatorsFromFieldData(input->GetFieldData(), this->Solver->Surface().Mesh)));
  this->OperatorsSeconds = SecondsSince(start);
  this->OfFormerSurfaces.Setups += isFirst ? 0 : 1;
  return this->Read.back().second;
}

std::vector<std::string> SolvedSurface::Update(SolvedField& solver, const std::function<void()>& solve)
{
  const SolvedField* const former = std::exchange(this->Solved, nullptr);
  const int solves = solver.Counts().Solves;
  solve();
  this->Solved = &solver;
  if (former == &solver && solver.Counts().Solves == solves)
  {
    return {};
  }
  this->Arrays.reset();
  this->IsShownCurrent = false;
  return this->Report().Warnings;
}

const NearestPlaces& SolvedSurface::Places()
{
  if (!this->PlacesOfSurface)
  {
    this->PlacesOfSurface = std::make_unique<NearestPlaces>(this->Solver->Surface());
  }
  return *this->PlacesOfSurface;
}

const PrincipalCurvatures& SolvedSurface::Curvatures(double scale, const ExecutionContext& context)
{
  if (!this->CurvaturesAtScale || this->CurvaturesAtScale->first != scale)
  {
    this->CurvaturesAtScale.emplace(scale, FindPrincipalDirections(this->Solver->Surface(), scale, context).Faces);
  }
  return this->CurvaturesAtScale->second;
}

std::vector<std::string> SolvedSurface::Solve(const Constraints& directions, const FieldOptions& options,
  const StoppingCriteria& stop, const ExecutionContext& context)
{
  return this->Update(
    *this->Solver, [&] { this->Solver->Solve(directions, options, stop, context, this->Numbers.Names()); });
}

std::vector<std::string> SolvedSurface::Solve(const std::vector<PrescribedSingularity>& singularities,
  const Constraints& directions, const FieldOptions& options, const StoppingCriteria& stop,
  const ExecutionContext& context)
{
  if (!this->WithSingularities)
  {
    this->WithSingularities = std::make_unique<SingularFieldSolver>(this->Solver->Surface());
  }
  return this->Update(*this->WithSingularities,
    [&] { this->WithSingularities->Solve(singularities, directions, options, stop, context, this->Numbers.Names()); });
}

void SolvedSurface::MakeArrays(vtkPolyData* input, bool unitLength, bool combing, const ExecutionContext& context)
{
  if (!this->Shown || !this->IsShownCurrent || this->Shown->Combing != combing)
  {
    this->Arrays.reset();
    this->Shown = ShowField(this->Solver->Surface(), this->Numbers, this->Field(), this->Solved->Unknowns(), combing,
      this->Shown ? &*this->Shown : nullptr, PartOfContext(context, 0.0, 0.6));
    this->IsShownCurrent = true;
  }
  if (!this->Arrays || this->Arrays->UnitLength != unitLength)
  {
    this->Arrays = MakeFieldArrays(this->Solver->Surface(), this->Numbers, this->Field(), this->Solved->Unknowns(),
      *this->Shown, unitLength, input, PartOfContext(context, 0.6, 1.0));
  }
}

void SolvedSurface::AddArraysTo(vtkPolyData* surface, vtkPolyData* edges, bool hasBasis) const
{
  AddFieldArrays(*this->Arrays, surface, edges);
  AddPrescribed(this->Numbers, this->Solved->Constraints(), this->Field().Elements(), surface, edges);
  if (hasBasis)
  {
    AddBasisArrays(this->Basis(), surface, edges);
  }
}

void SolvedSurface::AddReportTo(vtkFieldData* data, bool hasBasis) const
{
  AddReport(this->Report(), this->Field().DirectionsPerPoint(), this->SetupSeconds(), data);
  if (hasBasis)
  {
    AddBasisSize(this->Basis(), data);
  }
}

bool SolvedSurface::MakeBasis(vtkPolyData* input, const ExecutionContext& context)
{
  if (this->BasisOfSurface && this->BasisOfSurface->Fields == this->Field().Name())
  {
    return false;
  }
  this->BasisOfSurface.reset(); // the memory of another discretisation first
  this->BasisOfSurface = MakeBasisArrays(
    this->Solver->Surface(), this->Numbers, this->Field(), this->Solved->HarmonicFields(), input, context);
  return true;
}

FieldSolver::StageCounts SolvedSurface::Counts() const
{
  FieldSolver::StageCounts counts = this->OfFormerSurfaces;
  for (const SolvedField* const solver : { static_cast<const SolvedField*>(this->Solver.get()),
         static_cast<const SolvedField*>(this->WithSingularities.get()) })
  {
    if (solver)
    {
      const SolvedField::StageCounts& now = solver->Counts();
      counts.Setups += now.Setups;
      counts.Systems += now.Systems;
      counts.Solves += now.Solves;
    }
  }
  return counts;
}

double SolvedSurface::SetupSeconds() const
{
  return this->SurfaceSeconds + this->OperatorsSeconds + this->Solved->SetupSeconds();
}

}
