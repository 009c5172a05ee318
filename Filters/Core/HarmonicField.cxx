#include "HarmonicField.h"

#include "HarmonicForms.h"
#include "Hierarchy/MeshHierarchy.h"
#include "Hierarchy/PointSampling.h"
#include "Hierarchy/TangentGraph.h"
#include "Mesh/SpatialOrder.h"
#include "NodalLevels.h"
#include "Operators/PowerFieldOperators.h"
#include "Prolongation/FaceFieldProlongation.h"
#include "Prolongation/NodalProlongation.h"
#include "Prolongation/OneFormProlongation.h"
#include "Prolongation/OverlayProlongation.h"
#include "Prolongation/PowerFieldProlongation.h"
#include "Prolongation/SampledProlongation.h"
#include "Prolongation/ScalarProlongation.h"
#include "Support/Errors.h"
#include "Support/SparseAssembly.h"
#include "Systems/FaceFieldSystem.h"
#include "Systems/OneFormSystem.h"
#include "Systems/PowerFieldSystem.h"

#include <utility>

namespace dmg
{

namespace
{

// The couplings between the powers of faces are far from those of a linear function where triangles
// are uneven; the coarse levels, nodal by nature, are not. So the interpolation to the faces is
// smoothed, and the finest level gets more sweeps: all that sweeps gain, they gain there. (Smoothing
// makes the coarse spaces of face fields and 1-forms worse, whose roughness is of second order.)
constexpr int PowerProlongationSteps = 2;
constexpr int FinestSweepsFactor = 2;

/// Complex numbers are pairs of real ones in memory, by the standard.
Vector<double> AsPairs(const Vector<Complex>& numbers)
{
  return Eigen::Map<const Vector<double>>(
    reinterpret_cast<const double*>(numbers.data()), 2 * numbers.size());
}

Vector<Complex> AsComplex(const Vector<double>& pairs)
{
  return Eigen::Map<const Vector<Complex>>(
    reinterpret_cast<const Complex*>(pairs.data()), pairs.size() / 2);
}

Vector<Complex> InFrames(const TangentFrames& frames, const Points& vectors)
{
  Vector<Complex> result(vectors.rows());
  for (int i = 0; i < static_cast<int>(result.size()); ++i)
  {
    result[i] = frames.ToComplex(i, vectors.row(i).transpose());
  }
  return result;
}

FieldWeights WeightsOf(const FieldOptions& options)
{
  return { options.Smoothness, options.Alignment, options.Constraints };
}

/// The operators between two levels; S1 and SX are empty where nobody asked for them.
struct LevelOperators
{
  SparseMatrix<double> S0;
  SparseMatrix<double> S1;
  SparseMatrix<double> SX;
  TransportOperator SP;
};

LevelOperators OperatorsFromPaths(const LevelTransition& transition,
  const TangentFrames& fineFrames, const TangentFrames& coarseFrames,
  const OperatorSelection& selection, const ExecutionContext& context)
{
  LevelOperators operators;
  operators.S0 = ScalarProlongation(transition, context);
  const FineEdgePaths paths(transition, context);
  if (selection.OneForms)
  {
    operators.S1 = OneFormProlongation(paths, context);
  }
  if (selection.FaceFields)
  {
    operators.SX = FaceFieldProlongation(paths, fineFrames, coarseFrames, context);
  }
  operators.SP = PowerFieldProlongation(paths, fineFrames, coarseFrames, context);
  return operators;
}

LevelOperators OperatorsFromOverlay(const LevelTransition& transition,
  const TangentFrames& fineFrames, const TangentFrames& coarseFrames,
  const ExecutionContext& context)
{
  OverlayProlongation overlay(transition, fineFrames, coarseFrames, context);
  return { std::move(overlay.S0), std::move(overlay.S1), std::move(overlay.SX),
    std::move(overlay.SP) };
}

// Samples of the faces are farther apart, in units of their spacing, than those of samples: a face has
// three neighbours where a sample has six.
constexpr double RadiusOfFaceSamples = 2.8;
constexpr double RadiusOfSamples = 1.8;
// So few are factored at once, and every level less keeps more of what has nearly no energy.
constexpr int FewestSamplesToSample = 1500;
// A level that keeps more of the points than this is not worth its cost.
constexpr double LargestUsefulRatio = 0.5;

ProlongationOperators OperatorsFromSamples(
  const TriangleMesh& mesh, const ExecutionContext& context)
{
  ProlongationOperators operators;
  operators.NumbersOfVertices.push_back(mesh.NumberOfVertices());
  operators.NumbersOfEdges.push_back(mesh.NumberOfEdges());
  operators.NumbersOfFaces.push_back(mesh.NumberOfFaces());
  context.Checkpoint(0.0);
  const std::vector<int> order = SpatialOrder(mesh, context).Faces();
  TangentGraph points = FaceGraph(mesh, order, context);
  while (points.NumberOfPoints() > FewestSamplesToSample)
  {
    // Most of the work is in the finest level.
    context.Checkpoint(operators.Nodal.empty() ? 0.3 : 0.9);
    const PointSampling sampling = SamplePoints(
      points, operators.Nodal.empty() ? RadiusOfFaceSamples : RadiusOfSamples, context);
    const int numberOfSamples = static_cast<int>(sampling.Samples.size());
    if (numberOfSamples > LargestUsefulRatio * points.NumberOfPoints())
    {
      break; // so many pieces of surface, of few faces each
    }
    TangentGraph samples = GraphOfSamples(points, sampling, context);
    operators.Nodal.push_back(SampledProlongation(sampling, samples, context));
    operators.NumbersOfVertices.push_back(numberOfSamples);
    operators.NumbersOfEdges.push_back(samples.NumberOfLinks() / 2);
    operators.NumbersOfFaces.push_back(numberOfSamples);
    points = std::move(samples);
  }
  if (!operators.Nodal.empty())
  {
    operators.Nodal[0] = RenumberRows(operators.Nodal[0], order, context);
  }
  context.Checkpoint(1.0);
  return operators;
}

/// Operators on N-powers.
std::vector<SparseMatrix<Complex>> OnPowers(
  const std::vector<TransportOperator>& transports, int N, const ExecutionContext& context)
{
  std::vector<SparseMatrix<Complex>> result;
  for (const TransportOperator& transport : transports)
  {
    result.push_back(dmg::OnPowers(transport, N, context));
  }
  return result;
}

/// Operators on vectors as pairs of components.
std::vector<SparseMatrix<double>> OnComponents(
  const std::vector<TransportOperator>& transports, const ExecutionContext& context)
{
  std::vector<SparseMatrix<double>> result;
  for (const TransportOperator& transport : transports)
  {
    result.push_back(dmg::OnComponents(transport, context));
  }
  return result;
}

const std::vector<TransportOperator>& CoarseSpaceOf(
  const ProlongationOperators& operators, const FieldOptions& options)
{
  return options.CoarseSpace == CoarseSpaceKind::Nodal ? operators.Nodal : operators.SP;
}

/// Where the problem takes its prolongations from; empty where the surface has one level.
template <class Scalar>
typename HarmonicProblem<Scalar>::MakeProlongations Prolongations(
  const ProlongationOperators* operators, const FieldOptions& options,
  typename HarmonicProblem<Scalar>::MakeProlongations make)
{
  const SolverKind solver = options.Solver.Kind;
  if (!operators && solver != SolverKind::Automatic && solver != SolverKind::Cholesky)
  {
    throw InvalidInput("multigrid needs the prolongation operators of the surface");
  }
  if (!operators || operators->NumberOfLevels() < 2)
  {
    return {};
  }
  return [=](const ExecutionContext& context) {
    const bool isNodal = options.CoarseSpace == CoarseSpaceKind::Nodal;
    const bool isOneForm = options.Kind == Discretisation::OneForm;
    const bool isFaceField = options.Kind == Discretisation::FaceField;
    if (isNodal ? operators->Nodal.empty()
        : isOneForm   ? operators->S1.empty()
        : isFaceField ? operators->SX.empty()
                      : operators->SP.empty())
    {
      throw InvalidInput("the operators of the surface do not include those that are needed; apply "
                         "vtkDirectionalProlongation with " +
        std::string(isOneForm ? "OneForms" : isFaceField ? "FaceFields" : "PowerFields") + " on");
    }
    return make(context);
  };
}

/// Scans have handles by the hundred where they are noisy; what all of them have to say is not worth
/// gigabytes.
bool CanHoldHarmonicFields(const TriangleMesh& mesh)
{
  constexpr double LargestNumberOfValues = 5e7;
  return static_cast<double>(NumberOfLoops(mesh)) * mesh.NumberOfFaces() < LargestNumberOfValues;
}

SolverOptions SolverFor(const FieldOptions& options)
{
  SolverOptions solver = options.Solver;
  if (options.CoarseSpace == CoarseSpaceKind::Nodal)
  {
    // Blocks of stars cost three times as much as those of sides, and do more. Cycles that start on
    // a chosen level have no blocks.
    const bool hasStars =
      options.Kind == Discretisation::FaceField && options.Solver.StartingLevel < 0;
    solver.FinestSweepsFactor = hasStars ? 1 : FinestSweepsFactor;
    solver.FinestProlongationSteps =
      options.Kind == Discretisation::PowerField ? PowerProlongationSteps : 0;
  }
  return solver;
}

/// What the coarse levels hold, for the report.
std::string NameOf(const FieldOptions& options)
{
  if (options.CoarseSpace == CoarseSpaceKind::Nodal)
  {
    return "nodal levels";
  }
  switch (options.Kind)
  {
    case Discretisation::OneForm:
      return "levels of 1-forms";
    case Discretisation::FaceField:
      return "levels of face fields";
    default:
      return "levels of face powers";
  }
}

}

SurfaceHierarchy BuildSurfaceHierarchy(const TriangleMesh& mesh, const HierarchyOptions& options,
  const ExecutionContext& context, const OperatorSelection& selection)
{
  if (options.Levels == LevelConstruction::Sampling)
  {
    if (selection.PowerFields || selection.FaceFields || selection.OneForms)
    {
      throw InvalidInput("structure-preserving operators need levels from edge collapses");
    }
    return { {}, OperatorsFromSamples(mesh, context) };
  }
  SurfaceHierarchy result;
  ProlongationOperators& operators = result.Operators;
  operators.NumbersOfVertices.push_back(mesh.NumberOfVertices());
  operators.NumbersOfEdges.push_back(mesh.NumberOfEdges());
  operators.NumbersOfFaces.push_back(mesh.NumberOfFaces());

  // The work is done in an order that is kind to the caches; coarse levels inherit it.
  const SpatialOrder order(mesh, context);
  const TriangleMesh sorted = order.Apply(mesh);
  TangentFrames fineFrames = order.ApplyToFaces(FaceFrames(mesh, context), context);
  std::vector<Complex> fineCornerTurns; // from level 1 on
  result.CoarseLevels =
    BuildMeshHierarchy(sorted, options, context,
      [&](const LevelTransition& transition, const ExecutionContext& part) {
      const TriangleMesh& coarse = transition.Coarse;
      TangentFrames coarseFrames = FaceFrames(coarse, context);
      LevelOperators level = options.Construction == ProlongationConstruction::ExactOverlay
        ? OperatorsFromOverlay(transition, fineFrames, coarseFrames, part)
        : OperatorsFromPaths(transition, fineFrames, coarseFrames, selection, context);
      std::vector<Complex> coarseCornerTurns = CornerTurns(coarse, coarseFrames, context);
      operators.Nodal.push_back(operators.Nodal.empty()
          ? FacesFromVertices(sorted, level.S0, level.SP, coarse, coarseCornerTurns, context)
          : VerticesFromVertices(transition.Fine, fineCornerTurns, level.S0, level.SP, coarse,
              coarseCornerTurns, context));
      if (selection.PowerFields)
      {
        operators.SP.push_back(std::move(level.SP));
      }
      if (selection.FaceFields)
      {
        operators.SX.push_back(std::move(level.SX));
      }
      if (selection.OneForms)
      {
        operators.S1.push_back(std::move(level.S1));
      }
      operators.S0.push_back(std::move(level.S0));
      operators.NumbersOfVertices.push_back(coarse.NumberOfVertices());
      operators.NumbersOfEdges.push_back(coarse.NumberOfEdges());
      operators.NumbersOfFaces.push_back(coarse.NumberOfFaces());
      fineFrames = std::move(coarseFrames);
      fineCornerTurns = std::move(coarseCornerTurns);
    });

  // Level 0 goes back into the caller's order.
  const auto renumber = [&](auto& matrices, const std::vector<int>& numbers) {
    if (!matrices.empty())
    {
      matrices[0] = RenumberRows(matrices[0], numbers, context);
    }
  };
  renumber(operators.S0, order.Vertices());
  renumber(operators.SX, PairsOf(order.Faces()));
  renumber(operators.SP, order.Faces());
  renumber(operators.Nodal, order.Faces());
  if (!operators.S1.empty())
  {
    const SpatialOrder::SignedEdges edges = order.Edges(mesh, sorted);
    operators.S1[0] = edges.Signs.asDiagonal() * operators.S1[0];
    renumber(operators.S1, edges.Numbers);
  }
  return result;
}

HarmonicProblem<Complex> MakePowerFieldProblem(const TriangleMesh& mesh,
  const TangentFrames& faceFrames, const ProlongationOperators* operators,
  const PrescribedFaces& prescribed, const FieldOptions& options,
  const ExecutionContext& context)
{
  HarmonicProblem<Complex>::CoarseSpaces spaces;
  spaces.Name = NameOf(options);
  spaces.Prolongations =
    Prolongations<Complex>(operators, options, [&](const ExecutionContext& part) {
      return OnPowers(CoarseSpaceOf(*operators, options), options.N, part);
    });
  return HarmonicProblem<Complex>(
    [&](const ExecutionContext& part) {
      return MakePowerFieldSystem(mesh, faceFrames, options.N, prescribed, WeightsOf(options), part);
    },
    spaces, SolverFor(options), context);
}

HarmonicProblem<double> MakeFaceFieldProblem(const TriangleMesh& mesh,
  const TangentFrames& faceFrames, const ProlongationOperators* operators,
  const PrescribedFaces& prescribed, const FieldOptions& options,
  const ExecutionContext& context)
{
  const bool isNodal = options.CoarseSpace == CoarseSpaceKind::Nodal;
  HarmonicProblem<double>::CoarseSpaces spaces;
  spaces.Name = NameOf(options);
  spaces.Prolongations =
    Prolongations<double>(operators, options, [&, isNodal](const ExecutionContext& part) {
      return isNodal ? OnComponents(operators->Nodal, part) : operators->SX;
    });
  if (isNodal && operators && !operators->Nodal.empty())
  {
    spaces.LeastSquares = [&](const ExecutionContext& part) {
      return NodalLevelsOfFaceFields(mesh, operators->Nodal, part);
    };
    if (CanHoldHarmonicFields(mesh))
    {
      spaces.Kernel = [&](const ExecutionContext& part) {
        return HarmonicFaceFields(mesh, faceFrames, part);
      };
    }
  }
  return HarmonicProblem<double>(
    [&](const ExecutionContext& part) {
      return MakeFaceFieldSystem(mesh, faceFrames, prescribed, WeightsOf(options), part);
    },
    spaces, SolverFor(options), context);
}

HarmonicProblem<double> MakeOneFormProblem(const TriangleMesh& mesh,
  const ProlongationOperators* operators, const PrescribedEdges& prescribed,
  const FieldOptions& options, const ExecutionContext& context)
{
  const bool isNodal = options.CoarseSpace == CoarseSpaceKind::Nodal;
  HarmonicProblem<double>::CoarseSpaces spaces;
  spaces.Name = NameOf(options);
  spaces.Prolongations =
    Prolongations<double>(operators, options, [&, isNodal](const ExecutionContext& part) {
      if (!isNodal)
      {
        return operators->S1;
      }
      std::vector<SparseMatrix<double>> nodal = OnComponents(operators->Nodal, part);
      nodal[0] =
        SparseMatrix<double>(FormFromFaceField(mesh, FaceFrames(mesh, part), part) * nodal[0]);
      return nodal;
    });
  if (isNodal && operators && !operators->Nodal.empty())
  {
    spaces.LeastSquares = [&](const ExecutionContext& part) {
      return NodalLevelsOfOneForms(mesh, FaceFrames(mesh, part), operators->Nodal, part);
    };
    if (CanHoldHarmonicFields(mesh))
    {
      spaces.Kernel = [&](const ExecutionContext& part) { return HarmonicForms(mesh, part); };
    }
  }
  return HarmonicProblem<double>(
    [&](const ExecutionContext& part) {
      return MakeOneFormSystem(mesh, prescribed, WeightsOf(options), part, options.Areas);
    },
    spaces, SolverFor(options), context);
}

namespace
{

FieldConstraints AsFieldConstraints(OneFormConstraints constraints)
{
  return { std::move(constraints.Prescribed.Edges), std::move(constraints.Prescribed.Weights),
    std::move(constraints.Values) };
}

}

FieldConstraints MakeFieldConstraints(const TriangleMesh& mesh, const TangentFrames& faceFrames,
  const std::vector<PrescribedDirection>& directions, const FieldOptions& options,
  const ElementNames& names)
{
  if (options.Kind == Discretisation::OneForm)
  {
    return AsFieldConstraints(OneFormConstraintsOnFaces(mesh, faceFrames, directions, names));
  }
  PowerConstraints constraints =
    MakePowerConstraints(mesh, faceFrames, options.NumberOfDirections(), directions, names);
  return { std::move(constraints.Prescribed.Faces), std::move(constraints.Prescribed.Weights),
    AsPairs(constraints.Values) };
}

FieldConstraints MakeFieldConstraints(const TriangleMesh& mesh, const TangentFrames& faceFrames,
  const TangentFrames& vertexFrames, const PrescribedDirections& directions,
  const FieldOptions& options, const ElementNames& names)
{
  if (options.Kind == Discretisation::OneForm)
  {
    return AsFieldConstraints(
      Joined(OneFormConstraintsOnFaces(mesh, faceFrames, directions.OnFaces, names),
        OneFormConstraintsAtVertices(
          mesh, faceFrames, vertexFrames, directions.AtVertices, names)));
  }
  std::vector<PrescribedDirection> onFaces = directions.OnFaces;
  for (const PrescribedVertexDirection& prescribed : directions.AtVertices)
  {
    for (const auto& [halfedge, direction] :
      CarriedIntoFaces(mesh, faceFrames, vertexFrames, prescribed, names))
    {
      onFaces.push_back({ TriangleMesh::FaceOf(halfedge), direction, prescribed.Weight });
    }
  }
  return MakeFieldConstraints(mesh, faceFrames, onFaces, options, names);
}

namespace
{

std::variant<HarmonicProblem<Complex>, HarmonicProblem<double>> MakeProblem(
  const TriangleMesh& mesh, const TangentFrames& faceFrames,
  const ProlongationOperators* operators, const FieldConstraints& constraints,
  const FieldOptions& options, const ExecutionContext& context)
{
  const auto& [elements, weights, values] = constraints;
  switch (options.Kind)
  {
    case Discretisation::OneForm:
      return MakeOneFormProblem(mesh, operators, { elements, weights }, options, context);
    case Discretisation::FaceField:
      return MakeFaceFieldProblem(
        mesh, faceFrames, operators, { elements, weights }, options, context);
    default:
      return MakePowerFieldProblem(
        mesh, faceFrames, operators, { elements, weights }, options, context);
  }
}

}

FieldProblem::FieldProblem(const TriangleMesh& mesh, const TangentFrames& faceFrames,
  const ProlongationOperators* operators, const FieldConstraints& constraints,
  const FieldOptions& options, const ExecutionContext& context)
  : Problem(MakeProblem(mesh, faceFrames, operators, constraints, options, context))
{
}

Vector<double> FieldProblem::Solve(const Vector<double>& values, const Vector<double>& start,
  const StoppingCriteria& stop, const ExecutionContext& context)
{
  if (auto* const problem = std::get_if<HarmonicProblem<double>>(&this->Problem))
  {
    return problem->Solve(values, start, stop, context);
  }
  return AsPairs(std::get<HarmonicProblem<Complex>>(this->Problem)
                   .Solve(AsComplex(values), AsComplex(start), stop, context));
}

const SolveReport& FieldProblem::Report() const
{
  return std::visit(
    [](const auto& problem) -> const SolveReport& { return problem.Report(); }, this->Problem);
}

FieldPowers PowersOfField(const TriangleMesh& mesh, const TangentFrames& faceFrames,
  const TangentFrames& vertexFrames, const Vector<double>& unknowns, const FieldOptions& options)
{
  if (options.Kind == Discretisation::OneForm)
  {
    return { InFrames(faceFrames, WhitneyAtFaces(mesh, unknowns)),
      InFrames(vertexFrames, WhitneyAtVertices(mesh, faceFrames, vertexFrames, unknowns)) };
  }
  Vector<Complex> faces = AsComplex(unknowns);
  Vector<Complex> vertices =
    PowersAtVertices(mesh, faceFrames, vertexFrames, faces, options.NumberOfDirections());
  return { std::move(faces), std::move(vertices) };
}

}
