#include "Adapters/Input/CrossesOfSurface.h"

#include "Adapters/Input/FieldFromArrays.h"
#include "Adapters/Surface/ArrayNames.h"
#include "Adapters/Surface/PreparationToFieldData.h"
#include "Adapters/View/ChosenArrays.h"
#include "FieldSolver.h"
#include "Quads/Crosses/AlignedEdges.h"

#include "vtkCellData.h"
#include "vtkDataSet.h"
#include "vtkPointData.h"

#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace dmg
{

namespace
{

/// The weight of features that edges of quads shall run along.
constexpr double WeightOfAligned = 1000.0;

/// Whether a field of a solver is there.
bool HasField(vtkDataSet* surface)
{
  const std::string name = ArrayNames::Direction(0);
  return surface->GetCellData()->HasArray(name.c_str()) || surface->GetPointData()->HasArray(name.c_str());
}

/// Whether the user means an array: menus say None where nothing is chosen.
bool IsFieldChosen(vtkAlgorithm* algorithm, vtkDataSet* surface)
{
  const ChosenArray choice = ChoiceOf(algorithm, 0);
  return HasField(surface) || (choice.IsMade() && (choice.Name != "None" || HasArray(choice, surface)));
}

/// The fourth power of each direction, unit; zero where there is none.
Vector<Complex> FourthPowers(const Vector<Complex>& directions)
{
  Vector<Complex> powers(directions.size());
  for (Eigen::Index face = 0; face < directions.size(); ++face)
  {
    const double length = std::abs(directions[face]);
    powers[face] = length > 0.0 ? std::pow(directions[face] / length, 4) : Complex(0.0);
  }
  return powers;
}

/// Fourth powers of the smoothest crosses that follow constraints on faces and the features of the options.
Vector<Complex> SmoothestThatFollow(std::vector<Constraint>&& onFaces, const SurfaceView& view,
  const QuadOptions& options, const ExecutionContext& context)
{
  FieldSolver solver(std::shared_ptr<const FramedMesh>(view.Prepared(), &view.Prepared()->Geometry));
  FieldProblem problem;
  problem.Features.BoundaryWeight = options.AlignBoundary ? WeightOfAligned : 0.0;
  problem.Constraints.OnFaces = std::move(onFaces);
  problem.UnitLengthWhileSmoothing = true;
  return FourthPowers(solver.Solve(problem, context, view.Relation().Names()).OnFaces);
}

/// Gives the faces without a power those of the smoothest crosses that follow the others.
void FillGaps(
  Vector<Complex>& powers, const SurfaceView& view, const QuadOptions& options, const ExecutionContext& context)
{
  std::vector<Constraint> given;
  for (int face = 0; face < powers.size(); ++face)
  {
    if (powers[face] != 0.0)
    {
      const Complex direction = std::polar(1.0, 0.25 * std::arg(powers[face]));
      given.push_back({ face, view.Surface().Geometry.Faces.ToVector(face, direction), WeightOfAligned });
    }
  }
  if (static_cast<Eigen::Index>(given.size()) == powers.size())
  {
    return;
  }
  const Vector<Complex> smoothest = SmoothestThatFollow(std::move(given), view, options, context);
  for (Eigen::Index face = 0; face < powers.size(); ++face)
  {
    powers[face] = powers[face] != 0.0 ? powers[face] : smoothest[face];
  }
}

Vector<Complex> FromArrays(
  vtkAlgorithm* algorithm, SurfaceView& view, int N, const QuadOptions& options, const ExecutionContext& context)
{
  const SurfaceWithField given = ReadField(algorithm, view, N, PartOfContext(context, 0.0, 0.3));
  if (4 % given.Field.N() != 0)
  {
    throw WrongChoice("quads have no edges along a field of " + std::to_string(given.Field.N()) +
      " directions; choose one of 4, or of 1 or 2, whose lines are one of both");
  }
  Vector<Complex> powers = FourthPowers(given.Field.First());
  FillGaps(powers, view, options, PartOfContext(context, 0.3, 1.0));
  return powers;
}

Vector<Complex> Smoothest(
  vtkAlgorithm* algorithm, SurfaceView& view, const QuadOptions& options, const ExecutionContext& context)
{
  view.Prepare(PreparationOf(view.Data()), PartOfContext(context, 0.0, 0.2));
  WarnOfPreparation(algorithm, view.Repair());
  return SmoothestThatFollow(options.AlignSharpEdges
      ? AlongSharpLines(view.Surface().Geometry, options, WeightOfAligned)
      : std::vector<Constraint>(),
    view, options, PartOfContext(context, 0.2, 1.0));
}

}

Vector<Complex> CrossesOf(
  vtkAlgorithm* algorithm, SurfaceView& view, int N, const QuadOptions& options, const ExecutionContext& context)
{
  return IsFieldChosen(algorithm, view.Given()) ? FromArrays(algorithm, view, N, options, context)
                                                : Smoothest(algorithm, view, options, context);
}

}
