#include "Discretisations/PowerField.h"

#include "Directions/PowerFieldDirections.h"
#include "Operators/FaceFieldOperators.h"
#include "Operators/PowerFieldOperators.h"
#include "Solvers/Laplacian/LaplacianHierarchy.h"
#include "Solvers/Multigrid/AssembledHierarchy.h"
#include "Support/ComplexPairs.h"
#include "Support/Errors.h"

#include <utility>

namespace dmg
{
namespace
{

constexpr int LargestN = 8;

// The couplings between the powers of faces are far from those of a linear function where triangles
// are uneven; the coarse levels, linear by nature, are not. So the interpolation to the faces is
// smoothed, and the finest level gets more sweeps: all that sweeps gain, they gain there.
constexpr int ProlongationSteps = 2;
constexpr int FinestSweepsFactor = 3;
// Below the finest level, interpolations are not smoothed. A second cycle costs little on so few
// unknowns, and makes up.
constexpr int CoarseCycles = 2;

// The number of unknowns up to which a factor is ready before multigrid, from the bare mesh.
constexpr int LargestForCholesky = 20000;
// SolverTuning says what these are; they were measured on surfaces of some 100,000 vertices.
constexpr double SolvesForFactor = 0.06;
constexpr double BytesOfFactor = 60.0;

}

void CheckNumberOfDirections(int N)
{
  if (N < 1 || N > LargestN)
  {
    throw InvalidInput("fields of " + std::to_string(N) +
      " directions per point are not supported; choose N from 1 to " + std::to_string(LargestN));
  }
}

PowerField::PowerField(const FramedMesh& surface, int directions)
  : Discretisation(surface)
  , N(directions)
{
  CheckNumberOfDirections(directions);
}

std::string PowerField::Name() const
{
  return "power fields with N = " + std::to_string(this->N);
}

Vector<double> PowerField::Mass(const ExecutionContext& context) const
{
  const Vector<double> areas = this->Surface.Mesh.FaceAreas(context);
  const double meanArea = areas.mean();
  return meanArea > 0.0 ? Vector<double>(areas / meanArea) : Vector<double>::Ones(areas.size());
}

std::unique_ptr<const StiffnessHierarchy> PowerField::Coarsen(
  const LinearProlongations& linear, const ExecutionContext& context) const
{
  std::vector<SparseMatrix<Complex>> onPowers = OnPowers(linear.All(), this->N, context);
  linear.Forget();
  return std::make_unique<LaplacianHierarchy>(CoarsenLaplacian(
    [&surface = this->Surface, N = this->N](const std::vector<int>& order, const ExecutionContext& part)
    { return PowerLaplacian(surface.Mesh, surface.Faces, N, order, part); },
    std::move(onPowers), ProlongationSteps, context));
}

std::unique_ptr<const StiffnessHierarchy> PowerField::Assemble(
  const ProlongationOperators* operators, CoarseSpaceKind space, const ExecutionContext& context) const
{
  std::vector<SparseMatrix<Complex>> prolongations;
  if (operators)
  {
    const auto& transports = space == CoarseSpaceKind::LinearInterpolation ? operators->Linear : operators->SP;
    CheckOperators(!transports.empty(), Remedy::PowerFieldOperators);
    prolongations = OnPowers(transports, this->N, context);
  }
  SparseMatrix<Complex> L = PowerLaplacian(this->Surface.Mesh, this->Surface.Faces, this->N, context);
  return std::make_unique<AssembledHierarchy<Complex>>(L, std::move(prolongations));
}

SolverTuning PowerField::Tuning() const
{
  SolverTuning tuning;
  tuning.LargestForCholesky = LargestForCholesky;
  tuning.SolvesForFactor = SolvesForFactor;
  tuning.BytesOfFactor = BytesOfFactor;
  tuning.FinestSweepsFactor = FinestSweepsFactor;
  tuning.CoarseCycles = CoarseCycles;
  tuning.FinestProlongationSteps = ProlongationSteps;
  return tuning;
}

FieldConstraints PowerField::Prescribe(const Constraints& constraints, const ElementNames& names) const
{
  return MakePowerConstraints(
    this->Surface.Mesh, this->Surface.Faces, this->N, DirectionsOnFaces(this->Surface, constraints, names), names);
}

Discretisation::IntegralWeights PowerField::WeightsOfIntegral() const
{
  // Stiffness is twice the integral, and a face gets the weights of its three corners.
  const double meanArea = this->Surface.Mesh.FaceAreas().mean();
  return { 2.0 * meanArea, 2.0 / 3.0 * meanArea };
}

Vector<double> PowerField::PenaltiesOfElements(const std::vector<int>& faces, const ExecutionContext& context) const
{
  return this->Mass(context)(faces);
}

FieldPowers PowerField::Powers(
  const Vector<double>& unknowns, const Unfilled<Corner>& corners, const ExecutionContext& context) const
{
  Vector<Complex> faces = AsComplex(unknowns);
  Vector<Complex> vertices = PowersAtVertices(this->Surface.Mesh, corners, faces, this->N, context);
  return { std::move(faces), std::move(vertices) };
}

std::vector<ElementValues> PowerField::Values(const Vector<double>& unknowns, const FieldPowers& powers) const
{
  std::vector<ElementValues> values; // not from a list in braces, which copies all numbers once more
  values.push_back({ "PowerField", ElementKind::Faces, 2, unknowns });
  values.push_back({ "PowerField", ElementKind::Vertices, 2, AsPairs(powers.Vertices) });
  return values;
}

Points PowerField::VectorsOnFaces(const Vector<double>& unknowns, const ExecutionContext&) const
{
  return VectorsFromFaceField(this->Surface.Faces, unknowns);
}

}
