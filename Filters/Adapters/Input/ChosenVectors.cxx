#include "Adapters/Input/ChosenVectors.h"

#include "Adapters/Pipeline/FilterOutputs.h"
#include "Adapters/Surface/ArrayNames.h"
#include "Drawing/DirectionsOnFaces.h"
#include "Support/Errors.h"

#include "vtkAlgorithm.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkInformationIntegerKey.h"
#include "vtkInformationStringKey.h"
#include "vtkPointData.h"

namespace dmg
{

namespace
{

ChosenArray Found(vtkDataArray* array, int association)
{
  return { "", -1, association, array };
}

ChosenArray DefaultVectors(vtkDataSet* surface)
{
  vtkDataSetAttributes* const cells = surface->GetCellData();
  vtkDataSetAttributes* const points = surface->GetPointData();
  const std::string name = ArrayNames::Direction(0);
  for (vtkDataArray* array :
    { cells->GetArray(name.c_str()), points->GetArray(name.c_str()), cells->GetVectors(), points->GetVectors() })
  {
    if (array)
    {
      const bool isOnPoints = points->HasArray(NameOf(array).c_str()) && !cells->HasArray(NameOf(array).c_str());
      return Found(array, isOnPoints ? vtkDataObject::POINT : vtkDataObject::CELL);
    }
  }
  throw WrongChoice("the surface has no field: neither an array Direction0 nor active vectors; apply "
                    "Harmonic Field Solver (vtkHarmonicFieldSolver) first, or choose an array of vectors");
}

ChosenArray FindVectors(vtkAlgorithm* algorithm, vtkDataSet* surface)
{
  vtkInformation* const choice = algorithm->GetInputArrayInformation(0);
  const bool byName = choice->Has(vtkDataObject::FIELD_NAME());
  const std::string name = byName ? choice->Get(vtkDataObject::FIELD_NAME()) : "";
  if (byName ? name.empty() : !choice->Has(vtkDataObject::FIELD_ATTRIBUTE_TYPE()))
  {
    return DefaultVectors(surface);
  }
  const int wanted = choice->Get(vtkDataObject::FIELD_ASSOCIATION());
  for (const int association : { vtkDataObject::FIELD_ASSOCIATION_POINTS, vtkDataObject::FIELD_ASSOCIATION_CELLS })
  {
    if (wanted != association && wanted != vtkDataObject::FIELD_ASSOCIATION_POINTS_THEN_CELLS)
    {
      continue;
    }
    vtkDataSetAttributes* const attributes = surface->GetAttributes(association);
    vtkAbstractArray* const found = byName
      ? attributes->GetAbstractArray(name.c_str())
      : attributes->GetAbstractAttribute(choice->Get(vtkDataObject::FIELD_ATTRIBUTE_TYPE()));
    vtkDataArray* const ofCells = surface->GetCellData()->GetArray(ArrayNames::Direction(0).c_str());
    if (found && name == ArrayNames::Direction(0) && ofCells)
    {
      return Found(ofCells, vtkDataObject::CELL);
    }
    if (found)
    {
      return Found(vtkDataArray::SafeDownCast(found), association);
    }
  }
  if (name == "None") // how menus say that nothing is chosen
  {
    return DefaultVectors(surface);
  }
  throw WrongChoice("array '" + name +
    "', chosen for the directions, is not among the surface's point or cell arrays; choose one of "
    "those, or none");
}

}

std::string NameOf(vtkDataArray* array)
{
  return array->GetName() ? array->GetName() : "(without a name)";
}

void CheckTuples(vtkDataArray* array, vtkDataSet* surface, int association)
{
  const vtkIdType elements = surface->GetNumberOfElements(association);
  if (array->GetNumberOfTuples() < elements)
  {
    throw InvalidInput("array '" + NameOf(array) + "' has " + std::to_string(array->GetNumberOfTuples()) +
      " tuples for " + std::to_string(elements) + (association == vtkDataObject::POINT ? " points" : " cells") +
      "; choose another, or have its source write one for each");
  }
}

ChosenArray ChooseVectors(vtkAlgorithm* algorithm, vtkDataSet* surface)
{
  const ChosenArray chosen = FindVectors(algorithm, surface);
  const int components = chosen.Array ? chosen.Array->GetNumberOfComponents() : 0;
  if (components != 2 && components != 3 && !HoldsTensors(chosen.Array))
  {
    const std::string name = chosen.Array ? NameOf(chosen.Array) : "that was chosen";
    throw WrongChoice("array '" + name +
      "' holds neither vectors nor tensors; choose an array of vectors (3 numbers, or 2 in a plane) or of tensors (6 "
      "or 9, or 4 in a plane)");
  }
  if (components == 2 && NameOf(chosen.Array) == "PowerField")
  {
    throw WrongChoice("array 'PowerField' holds the powers of a field in frames of its solver, which are no directions "
                      "of the surface; choose Direction0");
  }
  for (vtkDataSetAttributes* const attributes : { static_cast<vtkDataSetAttributes*>(surface->GetPointData()),
         static_cast<vtkDataSetAttributes*>(surface->GetCellData()) })
  {
    if (attributes->GetNormals() == chosen.Array) // the first vectors of many surfaces, which menus choose
    {
      throw WrongChoice("array '" + NameOf(chosen.Array) +
        "' holds the normals of the surface, which are no field on it; apply "
        "Harmonic Field Solver (vtkHarmonicFieldSolver) first, or choose another array of vectors");
    }
  }
  CheckTuples(chosen.Array, surface, chosen.Association);
  return chosen;
}

int NumberOfDirections(vtkDataSet* surface, const ChosenArray& chosen)
{
  const std::string name = NameOf(chosen.Array);
  if (name == ArrayNames::MaximumDirection || name == ArrayNames::MinimumDirection || HoldsTensors(chosen.Array))
  {
    return 2;
  }
  if (name != ArrayNames::Direction(0))
  {
    return 1;
  }
  constexpr int Largest = DirectionsOnFaces::LargestN;
  vtkDataArray* const reported = surface->GetFieldData()->GetArray(ArrayNames::NumberOfDirections);
  if (reported && reported->GetNumberOfValues() == 1 && reported->GetTuple1(0) >= 1 &&
    reported->GetTuple1(0) <= Largest)
  {
    return static_cast<int>(reported->GetTuple1(0));
  }
  vtkDataSetAttributes* const attributes = surface->GetAttributes(chosen.Association);
  int number = 1;
  while (number < Largest && attributes->GetArray(ArrayNames::Direction(number).c_str()))
  {
    ++number;
  }
  return number;
}

bool IsFieldAtPoints(vtkDataSet* surface, const ChosenArray& chosen)
{
  vtkDataArray* const atPoints = surface->GetPointData()->GetArray(ArrayNames::Direction(0).c_str());
  return NameOf(chosen.Array) == ArrayNames::Direction(0) && atPoints && atPoints->GetNumberOfComponents() == 3 &&
    surface->GetCellData()->HasArray(ArrayNames::SingularityIndex);
}

}
