#ifndef dmgBenchmarksSystems_h
#define dmgBenchmarksSystems_h

#include "Operators/ConnectionLaplacian.h"
#include "Operators/ExteriorCalculus.h"
#include "Operators/FaceFieldOperators.h"
#include "Operators/PowerFieldOperators.h"
#include "Setup/FieldOptions.h"
#include "Support/HarmonicSystem.h"
#include "Support/ReferenceOperators.h"

#include <type_traits>
#include <utility>

namespace dmg::benchmarks
{

/// d0^T star1 d0: the smoothness energy of functions.
inline SparseMatrix<double> CotangentLaplacian(const TriangleMesh& mesh, const ExecutionContext& context)
{
  const SparseMatrix<double> d0 = D0(mesh, context);
  return SparseMatrix<double>(d0.transpose()) * Star1(mesh).asDiagonal() * d0;
}

/// The smoothness energy of a field as a matrix, with the angles of its connection.
/// \tparam Scalar Complex for power fields, else double.
template <class Scalar>
SparseMatrix<Scalar> MakeStiffness(
  const FramedMesh& surface, const DiscretisationOptions& options, const ExecutionContext& context)
{
  const auto& [mesh, frames, vertexFrames] = surface;
  if constexpr (std::is_same<Scalar, Complex>::value)
  {
    return options.Kind == DiscretisationKind::VertexPowerField
      ? ConnectionLaplacian(mesh, VertexConnection(surface, context), options.N, context)
      : PowerLaplacian(mesh, frames, options.N, context);
  }
  else
  {
    switch (options.Kind)
    {
      case DiscretisationKind::OneForm:
        return test::OneFormLaplacian(mesh, context, options.Areas);
      case DiscretisationKind::FaceField:
        return test::FaceFieldSmoothness(mesh, frames, context);
      default:
        return CotangentLaplacian(mesh, context);
    }
  }
}

/// Complex unknowns instead of the pairs of their parts.
inline Penalties OfPairs(const Penalties& pairs)
{
  Penalties powers{ pairs.Kind, {}, Vector<double>(pairs.Alignment.size() / 2) };
  for (std::size_t b = 0; b < pairs.Unknowns.size(); b += 2)
  {
    powers.Unknowns.push_back(pairs.Unknowns[b] / 2);
  }
  for (Eigen::Index b = 0; b < powers.Alignment.size(); ++b)
  {
    powers.Alignment[b] = pairs.Alignment[2 * b];
  }
  return powers;
}

/// The system that FieldProblem solves, for who solves it otherwise.
/// \tparam Scalar Complex for power fields, else double.
/// \param field, options on this surface.
template <class Scalar>
HarmonicSystem<Scalar> MakeSystem(const FramedMesh& surface, const Discretisation& field,
  const FieldConstraints& constraints, const FieldOptions& options, const ExecutionContext& context)
{
  SparseMatrix<Scalar> stiffness = MakeStiffness<Scalar>(surface, options.Field, context);
  if (options.Constraints == ConstraintKind::Soft)
  {
    stiffness *= options.Smoothness;
  }
  Penalties prescribed = field.PenaltiesOf(constraints, options.Weights(), context);
  if constexpr (std::is_same<Scalar, Complex>::value)
  {
    prescribed = OfPairs(prescribed);
  }
  return HarmonicSystem<Scalar>::Make(std::move(stiffness), field.Mass(context), std::move(prescribed));
}

}

#endif
