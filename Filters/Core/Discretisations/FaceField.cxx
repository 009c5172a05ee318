#include "Discretisations/FaceField.h"

#include "Analysis/HarmonicBasis.h"
#include "Analysis/HarmonicForms.h"
#include "Discretisations/LeastSquaresLevels.h"
#include "Operators/FaceFieldOperators.h"
#include "Operators/PowerFieldDirections.h"
#include "Solvers/LeastSquares/LeastSquaresHierarchy.h"
#include "Solvers/Multigrid/AssembledHierarchy.h"
#include "Support/ComplexPairs.h"
#include "Support/SparseKernels.h"

#include <utility>

namespace dmg
{
namespace
{

// Blocks on the finest level do not overlap, and sweeps over them follow each other in the caches: for what
// they do, they are cheap.
constexpr int FinestSweepsFactor = 3;
constexpr int CoarseCycles = 2;
constexpr int LargestCoarseFactor = 10000;
// The distance that a smoothed interpolation reaches.
constexpr double DistanceOfSamples = 7.0;
// Face fields leave more to the interpolation than 1-forms do; but smaller entries do not help them.
constexpr int ProlongationDegree = 9;
constexpr double DroppedEntries = 0.001;

// The number of unknowns up to which a factor is ready before multigrid, from the bare mesh.
constexpr int LargestForCholesky = 30000;
// The number of solves from which a factor is worth its time: the extra time that it takes, over the time that a
// back-substitution saves against a second solve by cycles, on surfaces of some 100,000 vertices.
constexpr int SolvesForCholesky = 400;

}

Vector<double> FaceField::Mass(const ExecutionContext&) const
{
  const Vector<double> mass = MassesOfFaceFields(this->Surface.Mesh).Faces;
  const double meanArea = mass.mean();
  // Every face counts alike where the whole surface has no area.
  return meanArea > 0.0 ? Vector<double>(mass / meanArea) : Vector<double>::Ones(mass.size());
}

std::unique_ptr<const StiffnessHierarchy> FaceField::Coarsen(
  const LinearProlongations& linear, const ExecutionContext& context) const
{
  LeastSquaresHierarchyOptions coarsening;
  coarsening.ProlongationDegree = ProlongationDegree;
  coarsening.Dropped = DroppedEntries;
  const auto takeLevels = [&]
  {
    LeastSquaresLevels levels = LinearLevelsOfFaceFields(this->Surface.Mesh, linear.All(), context);
    linear.Forget();
    return levels; // handed on as it is: Eigen 3.4 would copy what is moved
  };
  return std::make_unique<LeastSquaresHierarchy>(
    CoarsenLeastSquares(FaceFieldSmoothnessFactor(this->Surface.Mesh, this->Surface.Faces, context), takeLevels(),
      coarsening, PartOfContext(context, 0.2, 1.0)));
}

std::unique_ptr<const StiffnessHierarchy> FaceField::Assemble(
  const ProlongationOperators* operators, CoarseSpaceKind space, const ExecutionContext& context) const
{
  std::vector<SparseMatrix<double>> prolongations;
  if (operators && space == CoarseSpaceKind::LinearInterpolation)
  {
    CheckOperators(!operators->Linear.empty(), Remedy::FaceFieldOperators);
    prolongations = OnComponents(operators->Linear, context);
  }
  else if (operators)
  {
    CheckOperators(!operators->SX.empty(), Remedy::FaceFieldOperators);
    prolongations = operators->SX;
  }
  SparseMatrix<double> B = FaceFieldSmoothnessFactor(this->Surface.Mesh, this->Surface.Faces, context);
  SparseMatrix<double> A = NormalMatrix(B, context);
  return std::make_unique<AssembledHierarchy<double>>(A, std::move(prolongations), std::move(B));
}

double FaceField::SampleDistance() const
{
  return DistanceOfSamples;
}

SolverTuning FaceField::Tuning() const
{
  SolverTuning tuning;
  tuning.LargestForCholesky = LargestForCholesky;
  tuning.SolvesForCholesky = SolvesForCholesky;
  tuning.FinestSweepsFactor = FinestSweepsFactor;
  tuning.CoarseCycles = CoarseCycles;
  tuning.LargestCoarseFactor = LargestCoarseFactor;
  return tuning;
}

int FaceField::NumberOfHarmonicFields() const
{
  return NumberOfGenerators(this->Surface.Mesh);
}

Eigen::MatrixXd FaceField::HarmonicFields(const ProlongationOperators* operators, const ExecutionContext& context) const
{
  return HarmonicFaceFields(this->Surface.Mesh, this->Surface.Faces, context, operators);
}

Eigen::MatrixXd FaceField::HarmonicBasis(Eigen::MatrixXd basis, const ExecutionContext& context) const
{
  return HarmonicBasisOfFaceFields(this->Surface.Mesh, std::move(basis), context);
}

FieldConstraints FaceField::Prescribe(const Constraints& constraints, const ElementNames& names) const
{
  constexpr int OneDirection = 1;
  return MakePowerConstraints(
    this->Surface.Mesh, this->Surface.Faces, OneDirection, DirectionsOnFaces(this->Surface, constraints, names), names);
}

Discretisation::IntegralWeights FaceField::WeightsOfIntegral() const
{
  // A face gets the weights of its three corners.
  const double meanArea = this->Surface.Mesh.FaceAreas().mean();
  return { meanArea, meanArea / 3.0 };
}

Vector<double> FaceField::PenaltiesOfElements(const std::vector<int>& faces, const ExecutionContext& context) const
{
  const Vector<double> mass = this->Mass(context);
  Vector<double> penalties(faces.size());
  for (std::size_t b = 0; b < faces.size(); ++b)
  {
    penalties[b] = mass[2 * faces[b]];
  }
  return penalties;
}

FieldPowers FaceField::Powers(
  const Vector<double>& unknowns, const Unfilled<Corner>& corners, const ExecutionContext& context) const
{
  Vector<Complex> faces = AsComplex(unknowns);
  Vector<Complex> vertices = PowersAtVertices(this->Surface.Mesh, corners, faces, 1, context);
  return { std::move(faces), std::move(vertices) };
}

std::vector<ElementValues> FaceField::Values(const Vector<double>& unknowns, const FieldPowers&) const
{
  Vector<double> vectors(3 * this->Surface.Mesh.NumberOfFaces());
  Eigen::Map<Points>(vectors.data(), vectors.size() / 3, 3) = VectorsFromFaceField(this->Surface.Faces, unknowns);
  std::vector<ElementValues> values;
  values.push_back({ "FaceField", ElementKind::Faces, 3, std::move(vectors) });
  return values;
}

Points FaceField::VectorsOnFaces(const Vector<double>& unknowns, const ExecutionContext&) const
{
  return VectorsFromFaceField(this->Surface.Faces, unknowns);
}

}
