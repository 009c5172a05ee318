#include "Adapters/Surface/SolverOfSurface.h"

#include "Adapters/Surface/ArrayNames.h"
#include "Levels/OperatorsFromOtherSide.h"
#include "Setup/FieldSetup.h"
#include "Support/Errors.h"
#include "Support/Stopwatch.h"

#include "vtkDataSet.h"

#include <optional>

namespace dmg
{

void SolverOfSurface::SetSurface(vtkDataSet* input, const std::string& digest, const FieldOptions& options,
  const PreparationOptions& preparation, const ExecutionContext& context)
{
  const auto stored = WantsDecimation(options) ? OperatorsOriginOf(input->GetFieldData()) : std::nullopt;
  if (stored && stored->Digest != digest)
  {
    throw InvalidInput("the surface is another than that of its operators: field array '" +
      std::string(ArrayNames::ProlongationDigest) + "' says " + stored->Digest + ", not " + digest +
      "; apply Directional Prolongation (vtkDirectionalProlongation) after the last filter that changes the surface");
  }
  // Operators that are stored number the elements as the input does.
  const Numbering order = stored ? Numbering::AsGiven : Numbering::Spatial;
  const Stopwatch watch;
  const auto prepared = PrepareDataSet(input, digest, { order, preparation.JoinPoints, preparation.Strict }, context);
  if (!this->Engine.IsOn(prepared))
  {
    this->OperatorsByOrigin.clear();
    this->OperatorsSeconds = 0.0;
    this->Engine.Take(
      prepared, {}, [&] { return FieldSolver(std::shared_ptr<const FramedMesh>(prepared, &prepared->Geometry)); });
    this->SurfaceSeconds = watch.Seconds();
  }
  this->Engine->SetOperators(stored ? this->Operators(input, *stored) : nullptr);
}

/// The operators that the input brings along.
std::shared_ptr<const ProlongationOperators> SolverOfSurface::Operators(
  vtkDataSet* input, const OperatorsOrigin& origin)
{
  for (const auto& [known, operators] : this->OperatorsByOrigin)
  {
    if (known == origin)
    {
      return operators;
    }
  }
  const Stopwatch watch;
  const std::vector<char>& isTurned = this->Engine.Surface().Relation.Turned();
  const bool isFirst = this->Engine->Counts().Setups == 0; // then the solver counts it
  this->OperatorsByOrigin.emplace_back(origin,
    std::make_shared<const ProlongationOperators>(
      SeenFromOtherSide(OperatorsFromFieldData(input->GetFieldData(), this->Engine->Surface().Mesh), isTurned)));
  this->OperatorsSeconds = watch.Seconds();
  this->ReadOperators.Setups += isFirst ? 0 : 1;
  return this->OperatorsByOrigin.back().second;
}

double SolverOfSurface::SetupSeconds(const Field& field) const
{
  return this->SurfaceSeconds + this->OperatorsSeconds + field.Solution->SetupSeconds;
}

}
