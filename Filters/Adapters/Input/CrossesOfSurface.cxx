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

Vector<Complex> FromArrays(vtkAlgorithm* algorithm, SurfaceView& view, int N, const ExecutionContext& context)
{
  const SurfaceWithField given = ReadField(algorithm, view, N, context);
  if (4 % given.Field.N() != 0)
  {
    throw WrongChoice("quads have no edges along a field of " + std::to_string(given.Field.N()) +
      " directions; choose one of 4, or of 1 or 2, whose lines are one of both");
  }
  return FourthPowers(given.Field.First());
}

Vector<Complex> Smoothest(
  vtkAlgorithm* algorithm, SurfaceView& view, const QuadOptions& options, const ExecutionContext& context)
{
  view.Prepare(PreparationOf(view.Data()), PartOfContext(context, 0.0, 0.2));
  WarnOfPreparation(algorithm, view.Repair());
  FieldSolver solver(std::shared_ptr<const FramedMesh>(view.Prepared(), &view.Prepared()->Geometry));
  FieldProblem problem;
  problem.Features.BoundaryWeight = options.AlignBoundary ? WeightOfAligned : 0.0;
  if (options.AlignSharpEdges)
  {
    problem.Constraints.OnFaces = AlongSharpLines(solver.Surface(), options, WeightOfAligned);
  }
  problem.UnitLengthWhileSmoothing = true;
  const Field& field = solver.Solve(problem, PartOfContext(context, 0.2, 1.0), view.Relation().Names());
  return FourthPowers(field.OnFaces);
}

}

Vector<Complex> CrossesOf(
  vtkAlgorithm* algorithm, SurfaceView& view, int N, const QuadOptions& options, const ExecutionContext& context)
{
  return IsFieldChosen(algorithm, view.Given()) ? FromArrays(algorithm, view, N, context)
                                                : Smoothest(algorithm, view, options, context);
}

}
