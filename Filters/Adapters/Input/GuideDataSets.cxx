#include "Adapters/Input/GuideDataSets.h"

#include "Adapters/Data/CellChecks.h"
#include "Adapters/Data/NumberedCells.h"
#include "Support/Errors.h"
#include "Support/ShortText.h"

#include "vtkCellType.h"
#include "vtkCompositeDataIterator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkFieldData.h"
#include "vtkPolyData.h"
#include "vtkSmartPointer.h"

#include <algorithm>
#include <cmath>
#include <locale>
#include <sstream>

namespace dmg
{

namespace
{

/// The array of field data that is chosen, or null.
vtkDataArray* FieldArray(const ChosenArray& choice, vtkDataSet* dataset)
{
  const bool isAllowed = choice.Association == vtkDataObject::FIELD_ASSOCIATION_NONE ||
    (choice.Association == vtkDataObject::FIELD_ASSOCIATION_POINTS_THEN_CELLS && !HasArray(choice, dataset));
  return isAllowed && !choice.Name.empty() ? dataset->GetFieldData()->GetArray(choice.Name.c_str()) : nullptr;
}

/// All of a text as numbers, which blanks, commas or semicolons part; empty where something else stands there. Numbers have a point in any
/// locale.
std::vector<double> NumbersIn(std::string text)
{
  std::replace_if(
    text.begin(), text.end(), [](char c) { return c == ',' || c == ';'; }, ' ');
  std::istringstream words(text);
  std::vector<double> numbers;
  for (std::string word; words >> word;)
  {
    std::istringstream characters(word);
    characters.imbue(std::locale::classic());
    double number = 0.0;
    if (!(characters >> number) || characters.peek() != std::istringstream::traits_type::eof())
    {
      return {};
    }
    numbers.push_back(number);
  }
  return numbers;
}

double Value(const ChosenArray& array, vtkIdType cell, vtkIdType point)
{
  return array.Array->GetComponent(array.OnPoints() ? point : cell, 0);
}

}

std::string NameOfGuide(std::size_t guide, std::size_t guides, const std::string& kind)
{
  return guides == 1 ? "the " + kind : kind + " " + std::to_string(guide);
}

std::vector<GuideDataSet> DataSetsOf(const std::vector<vtkDataObject*>& guides, const InputWords& words)
{
  std::vector<GuideDataSet> datasets;
  const auto add = [&datasets](vtkDataObject* data, std::size_t guide, const std::string& name)
  {
    auto* const dataset = vtkDataSet::SafeDownCast(data);
    if (dataset && dataset->GetNumberOfPoints() > 0)
    {
      CheckCells(dataset, name);
      datasets.push_back({ WithNumberedCells(dataset), guide, name });
    }
    return dataset != nullptr;
  };
  for (std::size_t guide = 0; guide < guides.size(); ++guide)
  {
    const std::string name = NameOfGuide(guide, guides.size(), words.Kind);
    if (auto* const composite = vtkCompositeDataSet::SafeDownCast(guides[guide]))
    {
      const auto parts = vtk::TakeSmartPointer(composite->NewIterator());
      for (parts->InitTraversal(); !parts->IsDoneWithTraversal(); parts->GoToNextItem())
      {
        add(parts->GetCurrentDataObject(), guide,
          "block " + std::to_string(parts->GetCurrentFlatIndex()) + " of " + name);
      }
    }
    else if (!add(guides[guide], guide, name))
    {
      throw InvalidInput(name + " is a " + guides[guide]->GetClassName() + ", which is no dataset; connect " +
        words.Takes + ", as Table To Points (vtkTableToPolyData) makes of a table");
    }
  }
  return datasets;
}

bool IsLine(vtkDataSet* dataset, vtkIdType cell)
{
  const int type = dataset->GetCellType(cell);
  return type == VTK_LINE || type == VTK_POLY_LINE;
}

bool HasLines(vtkDataSet* dataset)
{
  if (auto* const polyData = vtkPolyData::SafeDownCast(dataset))
  {
    return polyData->GetNumberOfLines() > 0;
  }
  for (vtkIdType cell = 0; cell < dataset->GetNumberOfCells(); ++cell)
  {
    if (IsLine(dataset, cell))
    {
      return true;
    }
  }
  return false;
}

Vector3 PositionOf(const GuideDataSet& dataset, vtkIdType point)
{
  Vector3 position;
  dataset.Data->GetPoint(point, position.data());
  if (!position.allFinite())
  {
    std::ostringstream message;
    message << "point " << point << " of " << dataset.Name << " lies at (" << position.x() << ", " << position.y()
            << ", " << position.z() << "); move the point or remove it";
    throw InvalidInput(message.str());
  }
  return position;
}

double WholeWeight(const ChosenArray& choice, const GuideDataSet& dataset)
{
  vtkDataArray* const array = FieldArray(choice, dataset.Data);
  if (!array)
  {
    return 1.0;
  }
  const double weight = array->GetNumberOfValues() > 0 ? array->GetComponent(0, 0) : std::nan("no value");
  if (!(weight >= 0.0) || !std::isfinite(weight))
  {
    throw InvalidInput("the weight of " + dataset.Name + ", in its field array '" + choice.Name + "', is " +
      ShortText(weight) + "; make it a positive number, or take the guide out of Guides");
  }
  return weight;
}

std::vector<double> TypedNumbers(const ChosenArray& choice, const std::vector<GuideDataSet>& datasets)
{
  const auto has = [&choice](const GuideDataSet& dataset)
  { return HasArray(choice, dataset.Data) || FieldArray(choice, dataset.Data); };
  return std::any_of(datasets.begin(), datasets.end(), has) ? std::vector<double>() : NumbersIn(choice.Name);
}

std::vector<double> TypedWeights(const std::vector<double>& numbers, const std::vector<int>& slots)
{
  std::vector<double> weights;
  for (std::size_t guide = 0; !numbers.empty() && guide < slots.size(); ++guide)
  {
    const std::size_t slot = numbers.size() == 1 ? 0 : static_cast<std::size_t>(slots[guide]);
    weights.push_back(slot < numbers.size() ? numbers[slot] : 1.0);
    if (!(weights[guide] >= 0.0) || !std::isfinite(weights[guide]))
    {
      throw InvalidInput("the weight of " + NameOfGuide(guide, slots.size()) + ", typed in Guide Weights, is " +
        ShortText(weights[guide]) + "; make it a positive number, or 0 where the guide is not to be followed");
    }
  }
  return weights;
}

ConstraintArrays ChoicesFor(const ConstraintArrays& choices, vtkDataSet* dataset)
{
  const auto own = [dataset](const ChosenArray& choice) { return HasArray(choice, dataset) ? choice : ChosenArray(); };
  return { own(choices.Mask), own(choices.Vectors), own(choices.Weights) };
}

void CheckChoices(const ConstraintArrays& choices, const std::vector<GuideDataSet>& datasets)
{
  const auto check = [&datasets](const ChosenArray& choice, const std::string& what, bool mayBeInFieldData)
  {
    const std::string kinds = mayBeInFieldData ? "point, cell or field" : "point or cell";
    const auto has = [&choice, mayBeInFieldData](const GuideDataSet& dataset)
    { return HasArray(choice, dataset.Data) || (mayBeInFieldData && FieldArray(choice, dataset.Data)); };
    const bool isMade = choice.IsMade() && choice.Name != "None"; // as menus say
    if (isMade && !datasets.empty() && std::none_of(datasets.begin(), datasets.end(), has))
    {
      throw InvalidInput("array '" + choice.Name + "', chosen for the " + what + " of the guides, is not among the " +
        kinds + " arrays of " + (datasets.size() == 1 ? datasets[0].Name : std::string("any of them")) +
        "; choose one of those, or none");
    }
  };
  check(choices.Mask, "mask", false);
  check(choices.Vectors, "directions", false);
  check(choices.Weights, "weights", true);
}

LineArrays::LineArrays(const ConstraintArrays& choices, const GuideDataSet& dataset)
  : Mask(FindArray(choices.Mask, dataset.Data, 1, "mask", dataset.Name))
  , Weights(FindArray(choices.Weights, dataset.Data, 1, "weights", dataset.Name))
  , Name(dataset.Name)
{
}

double LineArrays::Weight(vtkIdType cell, vtkIdType start, vtkIdType end) const
{
  if (this->Mask.Array && (Value(this->Mask, cell, start) == 0.0 || Value(this->Mask, cell, end) == 0.0))
  {
    return 0.0;
  }
  if (!this->Weights.Array)
  {
    return 1.0;
  }
  double mean = 0.0;
  for (const vtkIdType point : { start, end })
  {
    const double weight = Value(this->Weights, cell, point);
    if (!(weight >= 0.0) || !std::isfinite(weight))
    {
      throw InvalidInput("the weight of cell " + std::to_string(cell) + " of " + this->Name + ", at its point " +
        std::to_string(point) + ", is " + ShortText(weight) + "; make it a positive number, or remove the line");
    }
    mean += 0.5 * weight;
  }
  return mean;
}

}
