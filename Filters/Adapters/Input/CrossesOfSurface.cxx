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

#include <string>
#include <utility>

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

CrossesOfSurface FromArrays(vtkAlgorithm* algorithm, vtkDataSet* input, int N, const ExecutionContext& context)
{
  SurfaceWithField given = ReadField(algorithm, input, N, context);
  if (4 % given.Field.N() != 0)
  {
    throw WrongChoice("quads have no edges along a field of " + std::to_string(given.Field.N()) +
      " directions; choose one of 4, or of 1 or 2, whose lines are one of both");
  }
  CrossesOfSurface crosses;
  crosses.Powers = FourthPowers(given.Field.First());
  crosses.Surface = given.Surface;
  return crosses;
}

CrossesOfSurface Smoothest(
  vtkAlgorithm* algorithm, vtkDataSet* input, const QuadOptions& options, const ExecutionContext& context)
{
  CrossesOfSurface crosses;
  crosses.Surface = PrepareDataSet(input, PreparationOf(input), PartOfContext(context, 0.0, 0.2));
  WarnOfPreparation(algorithm, crosses.Surface->Report);
  FieldSolver solver(std::shared_ptr<const FramedMesh>(crosses.Surface, &crosses.Surface->Geometry));
  FieldProblem problem;
  problem.Features.BoundaryWeight = options.AlignBoundary ? WeightOfAligned : 0.0;
  if (options.AlignSharpEdges)
  {
    problem.Constraints.OnFaces = AlongSharpLines(solver.Surface(), options, WeightOfAligned);
  }
  problem.UnitLengthWhileSmoothing = true;
  const Field& field = solver.Solve(problem, PartOfContext(context, 0.2, 1.0), crosses.Surface->Relation.Names());
  crosses.Powers = FourthPowers(field.OnFaces);
  return crosses;
}

}

CrossesOfSurface CrossesOf(
  vtkAlgorithm* algorithm, vtkDataSet* surface, int N, const QuadOptions& options, const ExecutionContext& context)
{
  return IsFieldChosen(algorithm, surface) ? FromArrays(algorithm, surface, N, context)
                                           : Smoothest(algorithm, surface, options, context);
}

}
