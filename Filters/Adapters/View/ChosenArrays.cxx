#include "Adapters/View/ChosenArrays.h"

#include "Adapters/Surface/ArrayNames.h"
#include "Adapters/View/EastAndNorth.h"
#include "Adapters/View/FillValues.h"
#include "Mesh/PositiveSide.h"
#include "Support/Errors.h"
#include "Support/ShortText.h"

#include "vtkAlgorithm.h"
#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkDataSetAttributes.h"
#include "vtkInformation.h"
#include "vtkInformationIntegerKey.h"
#include "vtkInformationStringKey.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace dmg
{

namespace
{

struct FoundArray
{
  vtkAbstractArray* Array = nullptr;
  int Association = vtkDataObject::FIELD_ASSOCIATION_NONE;
};

FoundArray Find(const ChosenArray& choice, vtkDataSet* dataset)
{
  if (!choice.IsMade())
  {
    return {};
  }
  for (int association : { vtkDataObject::FIELD_ASSOCIATION_POINTS, vtkDataObject::FIELD_ASSOCIATION_CELLS })
  {
    if (choice.Association == association || choice.Association == vtkDataObject::FIELD_ASSOCIATION_POINTS_THEN_CELLS)
    {
      vtkDataSetAttributes* const attributes = dataset->GetAttributes(association);
      vtkAbstractArray* const array = choice.Name.empty() ? attributes->GetAbstractAttribute(choice.Attribute)
                                                          : attributes->GetAbstractArray(choice.Name.c_str());
      if (array)
      {
        return { array, association };
      }
    }
  }
  return {};
}

std::string NameOf(vtkAbstractArray* array)
{
  return array->GetName() ? std::string("array '") + array->GetName() + "'" : std::string("the array without a name");
}

/// \throw InvalidInput the array has not a tuple of so many components for every element.
ChosenArray Checked(
  const FoundArray& found, vtkDataSet* dataset, int components, const std::string& what, const std::string& whose)
{
  const std::string called = NameOf(found.Array) + ", chosen for the " + what + " of " + whose + ",";
  vtkDataArray* const array = vtkDataArray::SafeDownCast(found.Array);
  if (!array || array->GetNumberOfComponents() != components)
  {
    throw InvalidInput(called + " does not hold " + std::to_string(components) +
      (components == 1 ? " number" : " numbers") + " per element; choose another");
  }
  const vtkIdType elements = dataset->GetNumberOfElements(found.Association);
  if (array->GetNumberOfTuples() < elements)
  {
    throw InvalidInput(called + " has " + std::to_string(array->GetNumberOfTuples()) + " tuples for " +
      std::to_string(elements) + (found.Association == vtkDataObject::FIELD_ASSOCIATION_POINTS ? " points" : " cells") +
      "; choose another, or have its source write one for each");
  }
  return { array->GetName() ? array->GetName() : "", -1, found.Association, array };
}

/// The words that offer to do without an element.
std::string WayOut(const ConstraintArrays& arrays)
{
  return arrays.Mask.Array ? "take it out of the mask" : "make the direction zero";
}

}

ChosenArray ChoiceOf(vtkAlgorithm* algorithm, int index)
{
  vtkInformation* const information = algorithm->GetInputArrayInformation(index);
  ChosenArray choice;
  if (const char* const name = information->Get(vtkDataObject::FIELD_NAME()))
  {
    choice.Name = name;
  }
  else if (information->Has(vtkDataObject::FIELD_ATTRIBUTE_TYPE()))
  {
    choice.Attribute = information->Get(vtkDataObject::FIELD_ATTRIBUTE_TYPE());
  }
  if (choice.Name == "Active Vectors") // of menus, which know names alone
  {
    return { "", vtkDataSetAttributes::VECTORS, vtkDataObject::FIELD_ASSOCIATION_POINTS_THEN_CELLS };
  }
  if (choice.IsMade())
  {
    choice.Association = information->Get(vtkDataObject::FIELD_ASSOCIATION());
  }
  return choice;
}

ConstraintArrays ChoicesOf(vtkAlgorithm* algorithm)
{
  ConstraintArrays choices{ ChoiceOf(algorithm, 0), ChoiceOf(algorithm, 1), ChoiceOf(algorithm, 2),
    ChoiceOf(algorithm, 3), ChoiceOf(algorithm, 4), ChoiceOf(algorithm, 5), ChoiceOf(algorithm, 6) };
  choices.Source = ChoiceOf(algorithm, 7);
  return choices;
}

ConstraintArrays WithoutFormerField(ConstraintArrays choices, vtkDataSet* surface)
{
  const bool isActive = choices.Vectors.Name.empty();
  vtkAbstractArray* const vectors = isActive ? Find(choices.Vectors, surface).Array : nullptr;
  if (vectors && vectors->GetName() && vectors->GetName() == ArrayNames::Direction(0))
  {
    choices.Vectors = {};
  }
  return choices;
}

bool HasArray(const ChosenArray& choice, vtkDataSet* dataset)
{
  return Find(choice, dataset).Array != nullptr;
}

ChosenArray FindArray(
  const ChosenArray& choice, vtkDataSet* dataset, int components, const std::string& what, const std::string& whose)
{
  const FoundArray found = Find(choice, dataset);
  if (found.Array)
  {
    return Checked(found, dataset, components, what, whose);
  }
  // "None" is how menus say that nothing is chosen.
  if (choice.Name.empty() || choice.Name == "None")
  {
    return {};
  }
  throw InvalidInput("array '" + choice.Name + "', chosen for the " + what + " of " + whose +
    ", is not among its point or cell arrays; choose one of those, or none");
}

int ComponentsOf(const ChosenArray& choice, vtkDataSet* dataset)
{
  vtkDataArray* const array = vtkDataArray::SafeDownCast(Find(choice, dataset).Array);
  return array ? array->GetNumberOfComponents() : 0;
}

ChosenArray FindVectors(
  const ChosenArray& choice, vtkDataSet* dataset, const std::string& what, const std::string& whose)
{
  return FindArray(choice, dataset, ComponentsOf(choice, dataset) == 2 ? 2 : 3, what, whose);
}

std::string ProblemOfPlaneVectors(vtkDataArray* vectors, const Points& positions)
{
  const int components = vectors->GetNumberOfComponents();
  if ((components != 2 && components != 4) || positions.rows() == 0 || HaveConstantZ(positions))
  {
    return "";
  }
  const std::string found = components == 2 ? "vectors of 2 numbers" : "tensors of 4 numbers (XX XY YX YY)";
  return NameOf(vectors) + " holds " + found + ", and the surface is not in a plane of constant z; make " +
    (components == 2 ? "vectors of 3 numbers" : "tensors of 6 or 9 numbers") +
    ", with Calculator (vtkArrayCalculator) for example";
}

Eigen::Matrix3d TensorOf(const double* numbers, int components)
{
  Eigen::Matrix3d tensor;
  if (components == 4)
  {
    const auto& [xx, xy, yx, yy] = *reinterpret_cast<const double(*)[4]>(numbers);
    tensor << xx, xy, 0.0, yx, yy, 0.0, 0.0, 0.0, 0.0;
  }
  else if (components == 6)
  {
    const auto& [xx, yy, zz, xy, yz, xz] = *reinterpret_cast<const double(*)[6]>(numbers);
    tensor << xx, xy, xz, xy, yy, yz, xz, yz, zz;
  }
  else
  {
    tensor = Eigen::Map<const Eigen::Matrix<double, 3, 3, Eigen::RowMajor>>(numbers);
  }
  return tensor;
}

bool HoldsTensors(vtkDataArray* array)
{
  const int components = array ? array->GetNumberOfComponents() : 0;
  const bool isColor = components == 4 && array->GetDataType() == VTK_UNSIGNED_CHAR; // with an opacity
  return (components == 4 && !isColor) || components == 6 || components == 9;
}

namespace
{

/// Three, unless an array of two numbers, or of a tensor, may be taken as well.
int ComponentsOfDirections(const ChosenArray& choice, vtkDataSet* dataset, bool takesTensors)
{
  vtkDataArray* const array = takesTensors ? vtkDataArray::SafeDownCast(Find(choice, dataset).Array) : nullptr;
  return HoldsTensors(array) || (array && array->GetNumberOfComponents() == 2) ? array->GetNumberOfComponents() : 3;
}

}

ConstraintArrays FindArrays(
  const ConstraintArrays& choices, vtkDataSet* dataset, const std::string& whose, bool takesTensors)
{
  const EastAndNorth components =
    takesTensors ? FindEastAndNorth(choices.Eastward, choices.Northward, choices.Axis, dataset, whose) : EastAndNorth();
  const ChosenArray vectors = components.Eastward.Array
    ? components.Eastward
    : FindArray(
        choices.Vectors, dataset, ComponentsOfDirections(choices.Vectors, dataset, takesTensors), "directions", whose);
  const auto beside = [&](const ChosenArray& choice)
  {
    // A name alone means the array beside the directions, if there is one.
    ChosenArray there = choice;
    there.Association = vectors.Association;
    const bool isByName = choice.Association == vtkDataObject::FIELD_ASSOCIATION_POINTS_THEN_CELLS;
    return vectors.Array && isByName && HasArray(there, dataset) ? there : choice;
  };
  const ChosenArray mask = FindArray(beside(choices.Mask), dataset, 1, "mask", whose);
  const ChosenArray weights = FindArray(beside(choices.Weights), dataset, 1, "weights", whose);
  for (const ChosenArray& other : { mask, weights })
  {
    if (other.Array && !vectors.Array)
    {
      // Guides have no values, and take no tensors.
      throw InvalidInput(NameOf(other.Array) + " is chosen as mask or weights of " + whose +
        (takesTensors ? ", and neither directions nor values are" : ", and no directions are") +
        "; choose an array of vectors as well" + (takesTensors ? ", or one of numbers for Values of a function" : ""));
    }
    if (other.Array && other.Association != vectors.Association)
    {
      throw InvalidInput(NameOf(other.Array) + " of " + whose + " and " + NameOf(vectors.Array) +
        " of its directions are not both on points or both on cells; choose arrays of one kind");
    }
  }
  ConstraintArrays found{ mask, vectors, weights };
  found.Northward = components.Northward;
  return found;
}

UnusableDirections VisitPrescribed(const ConstraintArrays& arrays, vtkDataSet* dataset, const std::string& whose,
  const DirectionReader& directionOf, const std::function<bool(vtkIdType)>& takesPart,
  const std::function<void(const ElementDirection&)>& visit)
{
  UnusableDirections unusable;
  vtkDataArray* const vectors = arrays.Vectors.Array;
  const auto valueOf = [](const ChosenArray& chosen, vtkIdType element, double otherwise)
  { return chosen.Array ? chosen.Array->GetComponent(element, 0) : otherwise; };
  const vtkIdType size = vectors ? dataset->GetNumberOfElements(arrays.Vectors.Association) : 0;
  std::vector<double> numbers(vectors ? vectors->GetNumberOfComponents() : 0);
  std::vector<char> isLeftOut(size, 1);
  for (vtkIdType element = 0; element < size; ++element)
  {
    vectors->GetTuple(element, numbers.data());
    const Vector3 vector =
      directionOf ? directionOf(element, numbers.data()) : Vector3(numbers[0], numbers[1], numbers[2]);
    const double weight = valueOf(arrays.Weights, element, 1.0);
    const double mask = valueOf(arrays.Mask, element, vector.isZero(0.0) ? 0.0 : 1.0);
    if (mask == 0.0 || weight == 0.0 || !takesPart(element))
    {
      continue;
    }
    if (!vector.allFinite() || std::isnan(weight) || std::isnan(mask))
    {
      ++unusable.NotFinite;
    }
    else if (vector.isZero(0.0))
    {
      ++unusable.Zero;
    }
    else if (!(weight > 0.0) || !std::isfinite(weight))
    {
      throw InvalidInput("the weight of the direction prescribed at " +
        std::string(arrays.Vectors.OnPoints() ? "point " : "cell ") + std::to_string(element) + " of " + whose +
        " is " + ShortText(weight) + "; make it a positive number or " + WayOut(arrays));
    }
    else
    {
      isLeftOut[element] = 0;
      visit({ element, vector, weight });
    }
  }
  std::vector<vtkDataArray*> read{ vectors, arrays.Northward.Array };
  read.erase(std::remove(read.begin(), read.end(), nullptr), read.end());
  unusable.FillValues = SuspectedFillValues(read, isLeftOut, "directions of " + whose);
  return unusable;
}

}
