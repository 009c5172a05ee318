#include "Adapters/Input/CrossesOfSurface.h"

#include "Adapters/Input/FieldFromArrays.h"
#include "Adapters/Surface/ArrayNames.h"
#include "Adapters/Surface/PreparationToFieldData.h"
#include "Adapters/View/ChosenArrays.h"
#include "SurfaceQuads.h"

#include "vtkCellData.h"
#include "vtkDataSet.h"
#include "vtkPointData.h"

#include <string>

namespace dmg
{

namespace
{

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

}

std::optional<Vector<Complex>> CrossesOf(
  vtkAlgorithm* algorithm, SurfaceView& view, int N, const ExecutionContext& context)
{
  if (IsFieldChosen(algorithm, view.Given()))
  {
    return FromArrays(algorithm, view, N, context);
  }
  view.Prepare(PreparationOf(view.Data()), context);
  WarnOfPreparation(algorithm, view.Repair());
  return std::nullopt;
}

}
