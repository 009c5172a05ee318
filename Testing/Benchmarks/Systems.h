#ifndef dmgBenchmarksSystems_h
#define dmgBenchmarksSystems_h

#include "HarmonicField.h"
#include "Systems/FaceFieldSystem.h"
#include "Systems/OneFormSystem.h"
#include "Systems/PowerFieldSystem.h"

#include <type_traits>

namespace dmg::benchmarks
{

/// The system that FieldProblem solves, for who solves it otherwise.
/// \tparam Scalar Complex for power fields, else double.
template <class Scalar>
HarmonicSystem<Scalar> MakeSystem(const TriangleMesh& mesh, const TangentFrames& frames,
  const FieldConstraints& constraints, const FieldOptions& options, const ExecutionContext& context)
{
  const FieldWeights weights = { options.Smoothness, options.Alignment, options.Constraints };
  const auto& [elements, elementWeights, values] = constraints;
  if constexpr (std::is_same<Scalar, Complex>::value)
  {
    return MakePowerFieldSystem(
      mesh, frames, options.N, { elements, elementWeights }, weights, context);
  }
  else if (options.Kind == Discretisation::OneForm)
  {
    return MakeOneFormSystem(mesh, { elements, elementWeights }, weights, context, options.Areas);
  }
  else
  {
    return MakeFaceFieldSystem(mesh, frames, { elements, elementWeights }, weights, context);
  }
}

}

#endif
