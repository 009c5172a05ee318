#include "HarmonicField.h"

#include "FactorChoice.h"
#include "HarmonicForms.h"
#include "NodalLevels.h"
#include "Operators/FaceFieldOperators.h"
#include "Operators/PowerFieldDirections.h"
#include "Operators/PowerFieldOperators.h"
#include "Solvers/LaplacianHierarchy.h"
#include "Solvers/LeastSquaresHierarchy.h"
#include "Support/Errors.h"
#include "Support/FreedMemory.h"
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
// smoothed, and the finest level gets more sweeps: all that sweeps gain, they gain there.
constexpr int PowerProlongationSteps = 2;
constexpr int FinestSweepsFactorOfPowers = 3;

// Blocks on the finest level do not overlap, and sweeps over them follow each other in the caches: for what
// they do, they are cheap.
constexpr int FinestSweepsFactorOfSquares = 3;
// Below the finest level, interpolations are not smoothed. A second cycle costs little on so few
// unknowns, and makes up.
constexpr int CoarseCycles = 2;
constexpr int LargestCoarseFactorOfSquares = 10000;

/// Complex numbers are pairs of real ones in memory, by the standard.
Vector<double> AsPairs(const Vector<Complex>& numbers)
{
  return Eigen::Map<const Vector<double>>(
    reinterpret_cast<const double*>(numbers.data()), 2 * numbers.size());
}

PrescribedUnknowns AsPairs(const PrescribedUnknowns& powers)
{
  PrescribedUnknowns pairs{ powers.Kind, PairsOf(powers.Unknowns), {} };
  pairs.Alignment.resize(2 * powers.Alignment.size());
  for (Eigen::Index b = 0; b < pairs.Alignment.size(); ++b)
  {
    pairs.Alignment[b] = powers.Alignment[b / 2];
  }
  return pairs;
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

/// Operators on N-powers.
std::vector<SparseMatrix<Complex>> OnPowers(
  const std::vector<TransportOperator>& transports, int N, const ExecutionContext& context)
{
  std::vector<SparseMatrix<Complex>> result(transports.size());
  for (std::size_t level = 0; level < transports.size(); ++level)
  {
    SparseMatrix<Complex> powers = dmg::OnPowers(transports[level], N, context);
    result[level].swap(powers); // an assignment would copy
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

bool TakesSamples(const FieldOptions& options)
{
  return LevelsFor(options).Levels == LevelConstruction::Sampling;
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

// Up to so many unknowns a factorisation is ready before multigrid, from the bare mesh (Benchmarks).
// Squares take longer to set up; a 1-form's matrix is easily factored, a face field's is not.
constexpr int LargestPowerSystemForCholesky = 20000;
constexpr int LargestFaceSystemForCholesky = 30000;
constexpr int LargestOneFormSystemForCholesky = 400000;

// What a factorisation of t01 takes more, over what its back-substitution takes less than a second solve by cycles
// (Benchmarks, "Second solves"): 2.5 s / 0.07 s, 7.5 s / 0.02 s, 1.2 s / 0.04 s. At 1.1M faces these are fewer.
constexpr int SolvesOfOneFormsForCholesky = 40;
constexpr int SolvesOfFaceFieldsForCholesky = 400;
constexpr int SolvesOfPowerFieldsForCholesky = 30;

SolverOptions SolverFor(const TriangleMesh& mesh, const FieldOptions& options)
{
  SolverOptions solver = options.Solver;
  if (solver.Kind == SolverKind::Automatic)
  {
    solver.WhyFactor = WhyFactorIsBetter(
      ObstaclesOf(mesh, options.Kind != Discretisation::PowerField, SerialContext()));
  }
  solver.SolvesForCholesky = options.Kind == Discretisation::PowerField
    ? SolvesOfPowerFieldsForCholesky
    : options.Kind == Discretisation::FaceField ? SolvesOfFaceFieldsForCholesky
                                                : SolvesOfOneFormsForCholesky;
  solver.LargestForCholesky = options.Kind == Discretisation::PowerField
    ? LargestPowerSystemForCholesky
    : options.Kind == Discretisation::FaceField ? LargestFaceSystemForCholesky
                                                : LargestOneFormSystemForCholesky;
  if (options.CoarseSpace == CoarseSpaceKind::Nodal)
  {
    solver.CoarseCycles = CoarseCycles;
    switch (options.Kind)
    {
      case Discretisation::OneForm:
      case Discretisation::FaceField:
        solver.FinestSweepsFactor = FinestSweepsFactorOfSquares;
        solver.LargestCoarseFactor = LargestCoarseFactorOfSquares;
        break;
      default:
        solver.FinestSweepsFactor = FinestSweepsFactorOfPowers;
        solver.FinestProlongationSteps = PowerProlongationSteps;
        break;
    }
  }
  return solver;
}

std::string NamesOfFields(const FieldOptions& options)
{
  switch (options.Kind)
  {
    case Discretisation::OneForm:
      return "1-forms";
    case Discretisation::FaceField:
      return "face fields";
    default:
      return "power fields with N = " + std::to_string(options.N);
  }
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

namespace
{

/// Arguments but the prescribed faces are borrowed.
HarmonicProblem<Complex>::MakeSystem PowerFieldSystemMaker(const TriangleMesh& mesh,
  const TangentFrames& faceFrames, PrescribedFaces prescribed, const FieldOptions& options)
{
  return [&, prescribed = std::move(prescribed)](const ExecutionContext& context) {
    return MakePowerFieldSystem(
      mesh, faceFrames, options.N, prescribed, WeightsOf(options), context);
  };
}

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
  return HarmonicProblem<Complex>(PowerFieldSystemMaker(mesh, faceFrames, prescribed, options),
    spaces, SolverFor(mesh, options), context);
}

namespace
{

/// The harmonic fields of face fields or 1-forms, the kernel of their roughness; no columns where there are
/// none, or too many to hold.
/// \param operators as for HarmonicForms.
/// \param loops of the mesh.
Eigen::MatrixXd KernelOf(const TriangleMesh& mesh, const TangentFrames& faceFrames,
  const ProlongationOperators* operators, Discretisation kind, int loops,
  const ExecutionContext& context)
{
  if (loops == 0 || AreTooManyToHold(loops, mesh))
  {
    return {};
  }
  return kind == Discretisation::OneForm
    ? HarmonicForms(mesh, context, operators)
    : HarmonicFaceFields(mesh, faceFrames, context, operators);
}

/// Of face fields or 1-forms. Arguments but the prescribed elements are borrowed.
/// \param kernel is computed if it is not there, with \p operators where they do.
HarmonicProblem<double>::MakeSystem SystemMaker(const TriangleMesh& mesh,
  const TangentFrames& faceFrames, const ProlongationOperators* operators,
  std::vector<int> elements, std::vector<double> weights, const FieldOptions& options,
  std::optional<Eigen::MatrixXd>& kernel)
{
  return [&, operators, elements = std::move(elements), weights = std::move(weights)](
           const ExecutionContext& context) {
    const PartOfContext first(context, 0.0, 0.5);
    HarmonicSystem<double> system = options.Kind == Discretisation::OneForm
      ? MakeOneFormSystem(mesh, { elements, weights }, WeightsOf(options), first, options.Areas)
      : MakeFaceFieldSystem(mesh, faceFrames, { elements, weights }, WeightsOf(options), first);
    if (!kernel)
    {
      kernel = KernelOf(mesh, faceFrames, operators, options.Kind, NumberOfLoops(mesh),
        PartOfContext(context, 0.5, 1.0));
    }
    if (kernel->cols() > 0)
    {
      system.LeaveOutUndetermined(*kernel);
    }
    return system;
  };
}

HarmonicProblem<double> MakeFaceFieldProblem(const TriangleMesh& mesh,
  const TangentFrames& faceFrames, const ProlongationOperators* operators,
  const PrescribedFaces& prescribed, const FieldOptions& options,
  std::optional<Eigen::MatrixXd>& kernel, const ExecutionContext& context)
{
  HarmonicProblem<double>::CoarseSpaces spaces;
  spaces.Name = NameOf(options);
  spaces.Prolongations =
    Prolongations<double>(operators, options, [&](const ExecutionContext& part) {
      return options.CoarseSpace == CoarseSpaceKind::Nodal ? OnComponents(operators->Nodal, part)
                                                           : operators->SX;
    });
  return HarmonicProblem<double>(
    SystemMaker(
      mesh, faceFrames, operators, prescribed.Faces, prescribed.Weights, options, kernel),
    spaces, SolverFor(mesh, options), context);
}

HarmonicProblem<double> MakeOneFormProblem(const TriangleMesh& mesh,
  const TangentFrames& faceFrames, const ProlongationOperators* operators,
  const PrescribedEdges& prescribed, const FieldOptions& options,
  std::optional<Eigen::MatrixXd>& kernel, const ExecutionContext& context)
{
  HarmonicProblem<double>::CoarseSpaces spaces;
  spaces.Name = NameOf(options);
  spaces.Prolongations =
    Prolongations<double>(operators, options, [&](const ExecutionContext& part) {
      if (options.CoarseSpace != CoarseSpaceKind::Nodal)
      {
        return operators->S1;
      }
      std::vector<SparseMatrix<double>> nodal = OnComponents(operators->Nodal, part);
      nodal[0] = SparseMatrix<double>(FormFromFaceField(mesh, faceFrames, part) * nodal[0]);
      return nodal;
    });
  return HarmonicProblem<double>(
    SystemMaker(
      mesh, faceFrames, operators, prescribed.Edges, prescribed.Weights, options, kernel),
    spaces, SolverFor(mesh, options), context);
}

int NumberOfUnknowns(const TriangleMesh& mesh, const FieldOptions& options)
{
  switch (options.Kind)
  {
    case Discretisation::OneForm:
      return mesh.NumberOfEdges();
    case Discretisation::FaceField:
      return 2 * mesh.NumberOfFaces();
    default:
      return mesh.NumberOfFaces();
  }
}

/// Whether cycles that keep roughness and prescriptions apart solve this, and which.
std::optional<SolverChoice> ChooseCycle(
  const TriangleMesh& mesh, bool hasNodalLevels, const FieldOptions& options)
{
  if (options.CoarseSpace != CoarseSpaceKind::Nodal || options.Solver.StartingLevel >= 0 ||
    !hasNodalLevels)
  {
    return std::nullopt;
  }
  const SolverChoice choice =
    ChooseSolver(SolverFor(mesh, options), NumberOfUnknowns(mesh, options), true);
  const bool isCycle =
    choice.Kind == SolverKind::VCycles || choice.Kind == SolverKind::ConjugateGradients;
  return isCycle ? std::optional<SolverChoice>(choice) : std::nullopt;
}

/// Or will have, where there are no operators yet.
bool HasNodalLevels(const ProlongationOperators* operators, const FieldOptions& options)
{
  return operators ? !operators->Nodal.empty() : TakesSamples(options);
}

}

bool UsesRoughnessSurface(
  const TriangleMesh& mesh, const ProlongationOperators* operators, const FieldOptions& options)
{
  return ChooseCycle(mesh, HasNodalLevels(operators, options), options).has_value();
}

bool NeedsLevels(const TriangleMesh& mesh, const FieldOptions& options)
{
  return ChooseSolver(SolverFor(mesh, options), NumberOfUnknowns(mesh, options), true).Kind !=
    SolverKind::Cholesky;
}

HierarchyOptions LevelsFor(const FieldOptions& options)
{
  HierarchyOptions levels;
  const SolverKind solver = options.Solver.Kind;
  const bool isCycle = solver == SolverKind::Automatic ||
    solver == SolverKind::ConjugateGradients || solver == SolverKind::VCycles;
  if (isCycle && options.CoarseSpace == CoarseSpaceKind::Nodal && options.Solver.StartingLevel < 0)
  {
    levels.Levels = LevelConstruction::Sampling;
    if (options.Kind != Discretisation::PowerField)
    {
      levels.SampleDistance = 7.0; // as far as a smoothed interpolation reaches
    }
  }
  return levels;
}

namespace
{

/// Operators whose nodal levels may be forgotten as soon as they have been read.
struct NodalLevels
{
  const ProlongationOperators& Operators;
  ProlongationOperators* Own; ///< the same, or null

  const std::vector<TransportOperator>& Prolongations() const { return this->Operators.Nodal; }

  void Forget() const
  {
    if (this->Own)
    {
      this->Own->Nodal.clear();
    }
  }
};

std::unique_ptr<const RoughnessHierarchy> HierarchyOfSquares(const TriangleMesh& mesh,
  const TangentFrames& faceFrames, const NodalLevels& nodal, const FieldOptions& options,
  const ExecutionContext& context)
{
  const bool isOneForm = options.Kind == Discretisation::OneForm;
  LeastSquaresHierarchyOptions coarsening;
  if (!isOneForm)
  {
    // Face fields leave more to the interpolation; but smaller entries do not help them.
    coarsening.ProlongationDegree = 9;
    coarsening.Dropped = 0.001;
  }
  const auto takeLevels = [&] {
    LeastSquaresLevels levels = isOneForm
      ? NodalLevelsOfOneForms(mesh, faceFrames, nodal.Prolongations(), context)
      : NodalLevelsOfFaceFields(mesh, nodal.Prolongations(), context);
    nodal.Forget();
    return levels; // handed on as it is: Eigen 3.4 would copy what is moved
  };
  return std::make_unique<LeastSquaresHierarchy>(
    CoarsenLeastSquares(isOneForm ? OneFormLaplacianFactor(mesh, context, options.Areas)
                                  : FaceFieldSmoothnessFactor(mesh, faceFrames, context),
      takeLevels(), coarsening, PartOfContext(context, 0.2, 1.0)));
}

std::unique_ptr<const RoughnessHierarchy> HierarchyOfPowers(const TriangleMesh& mesh,
  const TangentFrames& faceFrames, const NodalLevels& nodal, const FieldOptions& options,
  const ExecutionContext& context)
{
  CheckNumberOfDirections(options.N);
  std::vector<SparseMatrix<Complex>> onPowers = OnPowers(nodal.Prolongations(), options.N, context);
  nodal.Forget();
  return std::make_unique<LaplacianHierarchy>(
    CoarsenLaplacian([&](const std::vector<int>& order, const ExecutionContext& part)
      { return PowerLaplacian(mesh, faceFrames, options.N, order, part); },
      std::move(onPowers), PowerProlongationSteps, context));
}

/// The harmonic fields of face fields and 1-forms, in the order of the hierarchy. Power fields have none
/// but on flat surfaces, where one prescribed direction determines them.
void AddKernel(const TriangleMesh& mesh, const TangentFrames& faceFrames,
  const ProlongationOperators& operators, const FieldOptions& options, RoughnessSurface& surface,
  const ExecutionContext& context)
{
  const int loops = NumberOfLoops(mesh);
  const Eigen::MatrixXd kernel =
    KernelOf(mesh, faceFrames, &operators, options.Kind, loops, context);
  if (kernel.cols() > 0)
  {
    surface.Kernel = kernel(surface.Hierarchy->Order, Eigen::all);
  }
  else if (loops > 0)
  {
    surface.KernelNote =
      ", without its " + std::to_string(loops) + " harmonic fields, which are too many to hold";
  }
}

std::shared_ptr<const RoughnessSurface> MakeRoughnessSurface(const TriangleMesh& mesh,
  const TangentFrames& faceFrames, const NodalLevels& nodal, const FieldOptions& options,
  const ExecutionContext& context)
{
  const bool isPower = options.Kind == Discretisation::PowerField;
  context.Checkpoint(0.0);
  const auto surface = std::make_shared<RoughnessSurface>();
  surface->Fields = NamesOfFields(options);
  surface->Name = NameOf(options);
  surface->Hierarchy = (isPower ? HierarchyOfPowers : HierarchyOfSquares)(
    mesh, faceFrames, nodal, options, PartOfContext(context, 0.0, isPower ? 1.0 : 0.8));
  const std::vector<int>& order = surface->Hierarchy->Order;
  if (isPower)
  {
    const Vector<double> mass = MassOfPowerFields(mesh, context);
    constexpr int Grain = 8192;
    surface->Mass.resize(mass.size());
    context.ParallelFor(0, static_cast<int>(mass.size()), Grain, [&](int first, int last) {
      for (int k = first; k < last; ++k)
      {
        surface->Mass[k] = mass[order[2 * k] / 2];
      }
    });
  }
  else
  {
    const bool isOneForm = options.Kind == Discretisation::OneForm;
    surface->Mass = (isOneForm ? PositiveStar1(mesh, context) : MassOfFaceFields(mesh))(order);
  }
  if (!isPower)
  {
    AddKernel(
      mesh, faceFrames, nodal.Operators, options, *surface, PartOfContext(context, 0.8, 1.0));
  }
  GiveBackFreedMemory();
  context.Checkpoint(1.0);
  return surface;
}

}

std::shared_ptr<const RoughnessSurface> MakeRoughnessSurface(const TriangleMesh& mesh,
  const TangentFrames& faceFrames, const ProlongationOperators* operators,
  const FieldOptions& options, const ExecutionContext& context)
{
  if (!UsesRoughnessSurface(mesh, operators, options))
  {
    return nullptr;
  }
  if (operators)
  {
    return MakeRoughnessSurface(
      mesh, faceFrames, NodalLevels{ *operators, nullptr }, options, context);
  }
  context.Checkpoint(0.0);
  ProlongationOperators samples = BuildSurfaceHierarchy(mesh, LevelsFor(options),
    PartOfContext(context, 0.0, 0.3), { false, false, false })
                                    .Operators;
  if (samples.Nodal.empty())
  {
    return nullptr;
  }
  GiveBackFreedMemory();
  return MakeRoughnessSurface(mesh, faceFrames, NodalLevels{ samples, &samples }, options,
    PartOfContext(context, 0.3, 1.0));
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

/// Of real unknowns: complex ones are pairs.
PrescribedUnknowns PrescribedIn(const TriangleMesh& mesh, const FieldConstraints& constraints,
  const FieldOptions& options, const ExecutionContext& context)
{
  const auto& [elements, weights, values] = constraints;
  switch (options.Kind)
  {
    case Discretisation::OneForm:
      return PrescribedUnknownsOf(mesh, PrescribedEdges{ elements, weights }, WeightsOf(options));
    case Discretisation::FaceField:
      return PrescribedUnknownsOf(mesh, PrescribedFaces{ elements, weights }, WeightsOf(options));
    default:
      CheckNumberOfDirections(options.N);
      return AsPairs(PrescribedPowersOf(
        mesh, PrescribedFaces{ elements, weights }, WeightsOf(options), context));
  }
}

using AnyProblem =
  std::variant<HarmonicProblem<Complex>, HarmonicProblem<double>, RoughnessProblem>;

/// Without cycles that keep roughness and prescriptions apart.
AnyProblem MakeAssembledProblem(
  const TriangleMesh& mesh, const TangentFrames& faceFrames,
  const ProlongationOperators* operators, const FieldConstraints& constraints,
  const FieldOptions& options, std::optional<Eigen::MatrixXd>& kernel,
  const ExecutionContext& context)
{
  const auto& [elements, weights, values] = constraints;
  switch (options.Kind)
  {
    case Discretisation::OneForm:
      return MakeOneFormProblem(
        mesh, faceFrames, operators, { elements, weights }, options, kernel, context);
    case Discretisation::FaceField:
      return MakeFaceFieldProblem(
        mesh, faceFrames, operators, { elements, weights }, options, kernel, context);
    default:
      return MakePowerFieldProblem(
        mesh, faceFrames, operators, { elements, weights }, options, context);
  }
}

void CheckFields(const RoughnessSurface& surface, const FieldOptions& options)
{
  if (surface.Fields != NamesOfFields(options))
  {
    throw InvalidInput("the surface was set up for " + surface.Fields + "; set it up for " +
      NamesOfFields(options));
  }
}

void CheckFree(const RoughnessProblem& problem, const FieldOptions& options)
{
  CheckAnyIsFree(problem.NumberOfFree(), options.Constraints,
    options.Kind == Discretisation::OneForm ? "edge" : "cell");
}

/// By cycles from a surface, which is made if it is null and they can be.
AnyProblem MakeProblem(const TriangleMesh& mesh, const TangentFrames& faceFrames,
  const ProlongationOperators* operators, const FieldConstraints& constraints,
  const FieldOptions& options, std::shared_ptr<const RoughnessSurface> surface,
  std::optional<Eigen::MatrixXd>& kernel, const ExecutionContext& context)
{
  const auto choice = ChooseCycle(mesh, surface || HasNodalLevels(operators, options), options);
  if (!choice)
  {
    return MakeAssembledProblem(mesh, faceFrames, operators, constraints, options, kernel, context);
  }
  if (surface)
  {
    CheckFields(*surface, options);
  }
  PrescribedUnknowns prescribed = PrescribedIn(mesh, constraints, options, context);
  const double half = surface ? 0.0 : 0.6;
  if (!surface)
  {
    surface = MakeRoughnessSurface(
      mesh, faceFrames, operators, options, PartOfContext(context, 0.0, half));
  }
  const PartOfContext rest(context, half, 1.0);
  if (!surface)
  {
    const ProlongationOperators oneLevel;
    return MakeAssembledProblem(mesh, faceFrames, &oneLevel, constraints, options, kernel, rest);
  }
  RoughnessProblem problem(std::move(surface), std::move(prescribed), options.Smoothness,
    SolverFor(mesh, options), *choice, rest);
  CheckFree(problem, options);
  return problem;
}

}

FieldProblem::FieldProblem(const TriangleMesh& mesh, const TangentFrames& faceFrames,
  const ProlongationOperators* operators, const FieldConstraints& constraints,
  const FieldOptions& options, const ExecutionContext& context,
  std::shared_ptr<const RoughnessSurface> surface)
  : Problem(MakeProblem(mesh, faceFrames, operators, constraints, options, std::move(surface),
      this->Kernel,
      PartOfContext(context, 0.0,
        options.Solver.CompareWithCholesky && UsesRoughnessSurface(mesh, operators, options) ? 0.5
                                                                                             : 1.0)))
{
  if (options.Solver.CompareWithCholesky && std::holds_alternative<RoughnessProblem>(this->Problem))
  {
    FieldOptions direct = options;
    direct.Solver.Kind = SolverKind::Cholesky;
    direct.Solver.CompareWithCholesky = false;
    this->Reference = std::make_unique<FieldProblem>(
      mesh, faceFrames, operators, constraints, direct, PartOfContext(context, 0.5, 1.0));
  }
}

bool FieldProblem::Update(const TriangleMesh& mesh, const TangentFrames& faceFrames,
  const FieldConstraints& constraints, const FieldOptions& options,
  const ExecutionContext& context)
{
  const auto& [elements, weights, values] = constraints;
  if (auto* const problem = std::get_if<HarmonicProblem<Complex>>(&this->Problem))
  {
    return problem->Update(
      PowerFieldSystemMaker(mesh, faceFrames, { elements, weights }, options), context);
  }
  if (auto* const problem = std::get_if<HarmonicProblem<double>>(&this->Problem))
  {
    return problem->Update(
      SystemMaker(mesh, faceFrames, nullptr, elements, weights, options, this->Kernel), context);
  }
  auto* const problem = std::get_if<RoughnessProblem>(&this->Problem);
  if (this->Reference)
  {
    return false;
  }
  problem->Update(PrescribedIn(mesh, constraints, options, context), options.Smoothness, context);
  CheckFree(*problem, options);
  return true;
}

Vector<double> FieldProblem::Solve(const Vector<double>& values, const Vector<double>& start,
  const StoppingCriteria& stop, const ExecutionContext& context)
{
  if (auto* const problem = std::get_if<RoughnessProblem>(&this->Problem))
  {
    const Vector<double> reference =
      this->Reference ? this->Reference->Solve(values, {}, stop, context) : Vector<double>();
    return problem->Solve(values, start, reference, stop, context);
  }
  if (auto* const problem = std::get_if<HarmonicProblem<double>>(&this->Problem))
  {
    return problem->Solve(values, start, stop, context);
  }
  return AsPairs(std::get<HarmonicProblem<Complex>>(this->Problem)
                   .Solve(AsComplex(values), AsComplex(start), stop, context));
}

Eigen::MatrixXd FieldProblem::HarmonicFields() const
{
  const auto* const problem = std::get_if<RoughnessProblem>(&this->Problem);
  return problem ? problem->Surface().HarmonicFields()
                 : this->Kernel.value_or(Eigen::MatrixXd());
}

const SolveReport& FieldProblem::Report() const
{
  return std::visit(
    [](const auto& problem) -> const SolveReport& { return problem.Report(); }, this->Problem);
}

FieldPowers PowersOfField(const TriangleMesh& mesh, const TangentFrames& faceFrames,
  const TangentFrames& vertexFrames, const Unfilled<Corner>& corners,
  const Vector<double>& unknowns, const FieldOptions& options, const ExecutionContext& context)
{
  if (options.Kind == Discretisation::OneForm)
  {
    return { InFrames(faceFrames, WhitneyAtFaces(mesh, unknowns, context)),
      InFrames(vertexFrames,
        WhitneyAtVertices(mesh, faceFrames, vertexFrames, corners, unknowns, context)) };
  }
  Vector<Complex> faces = AsComplex(unknowns);
  Vector<Complex> vertices =
    PowersAtVertices(mesh, corners, faces, options.NumberOfDirections(), context);
  return { std::move(faces), std::move(vertices) };
}

}
