#include "Adapters/Input/QuantitiesFromArrays.h"

#include "Adapters/Pipeline/FilterOutputs.h"
#include "Adapters/View/ChosenArrays.h"
#include "Scales/ScaleFilter.h"
#include "Support/ShortText.h"

#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkDataSetAttributes.h"

#include <algorithm>
#include <cmath>
#include <set>

namespace dmg
{
namespace
{

constexpr int Anywhere = vtkDataObject::FIELD_ASSOCIATION_POINTS_THEN_CELLS;

/// \throw InvalidInput the array is not there, or holds neither numbers nor vectors.
void Add(const ChosenArray& choice, vtkDataSet* dataset, QuantityArrays& quantities)
{
  const int components = ComponentsOf(choice, dataset);
  if (components == 2 || components == 3)
  {
    VectorArrays vectors({ choice }, dataset, "flow", "the surface");
    const std::string name = vectors.Name();
    quantities.Flows.push_back({ name, std::move(vectors) });
  }
  else
  {
    quantities.Functions.push_back(FindArray(choice, dataset, 1, "function", "the surface"));
  }
}

/// \throw InvalidInput a number is zero, negative or infinite; those that are NaN are gaps.
void CheckRelativeWavelengths(const ChosenArray& chosen)
{
  for (vtkIdType k = 0; chosen.Array && k < chosen.Array->GetNumberOfTuples(); ++k)
  {
    const double relative = chosen.Array->GetComponent(k, 0);
    if (relative <= 0.0 || std::isinf(relative))
    {
      throw InvalidInput("the relative wavelength of " + std::string(chosen.OnPoints() ? "point " : "cell ") +
        std::to_string(k) + " is " + ShortText(relative) +
        ", and must be positive; repair it, or make it NaN where nothing is to be filtered");
    }
  }
}

/// The active arrays or, where there are none, the only array of a dataset.
std::vector<ChosenArray> ChoicesOfNoName(const ChosenArray& vectors, vtkDataSet* dataset)
{
  std::vector<ChosenArray> choices;
  const ChosenArray scalars{ "", vtkDataSetAttributes::SCALARS, Anywhere };
  if (ComponentsOf(scalars, dataset) == 1)
  {
    choices.push_back(scalars);
  }
  if (const int components = ComponentsOf(vectors, dataset); components == 2 || components == 3)
  {
    choices.push_back(vectors);
  }
  std::vector<ChosenArray> others;
  for (const int association : { vtkDataObject::FIELD_ASSOCIATION_POINTS, vtkDataObject::FIELD_ASSOCIATION_CELLS })
  {
    vtkDataSetAttributes* const attributes = dataset->GetAttributes(association);
    for (int k = 0; choices.empty() && k < attributes->GetNumberOfArrays(); ++k)
    {
      vtkDataArray* const array = attributes->GetArray(k);
      const int components = array && array != attributes->GetNormals() ? array->GetNumberOfComponents() : 0;
      if (array && array->GetName() && components >= 1 && components <= 3)
      {
        others.push_back({ array->GetName(), -1, association });
      }
    }
  }
  return choices.empty() && others.size() == 1 ? others : choices;
}

}

bool QuantityArrays::AreComponents() const
{
  return std::any_of(
    this->Flows.begin(), this->Flows.end(), [](const NamedFlowArrays& flow) { return flow.Arrays.AreComponents(); });
}

std::vector<ArraysWithGaps> QuantityArrays::WithGaps() const
{
  std::vector<ArraysWithGaps> all;
  for (const ChosenArray& function : this->Functions)
  {
    all.push_back({ { function.Array }, function.OnPoints(), "array '" + function.Name + "'" });
  }
  for (const NamedFlowArrays& flow : this->Flows)
  {
    all.push_back({ flow.Arrays.Arrays(), flow.Arrays.AreOnPoints(), "array '" + flow.Name + "'" });
  }
  if (const ChosenArray& relative = this->RelativeWavelengths; relative.Array)
  {
    all.push_back({ { relative.Array }, relative.OnPoints(), "array '" + relative.Name + "'" });
  }
  return all;
}

std::vector<double> QuantityArrays::RelativeWavelengthsOn(const SurfaceView& view) const
{
  if (!this->RelativeWavelengths.Array)
  {
    return {};
  }
  const Vector<double> given = view.Numbers(this->RelativeWavelengths);
  const Vector<double> atVertices = this->RelativeWavelengths.OnPoints() ? given : FunctionOfFaces(view.Mesh(), given);
  return { atVertices.data(), atVertices.data() + atVertices.size() };
}

QuantityArrays FindQuantities(
  vtkAlgorithm* algorithm, const std::vector<std::string>& names, vtkDataSet* dataset, const Vector3& axis)
{
  QuantityArrays quantities;
  for (const std::string& name : std::set<std::string>(names.begin(), names.end()))
  {
    Add({ name, -1, Anywhere }, dataset, quantities);
  }
  VectorArrays components({ {}, ChoiceOf(algorithm, 1), ChoiceOf(algorithm, 2), axis }, dataset, "flow", "the surface");
  if (components.AreComponents())
  {
    quantities.Flows.push_back({ "Flow", std::move(components) });
  }
  if (names.empty() && quantities.Flows.empty())
  {
    for (const ChosenArray& choice : ChoicesOfNoName(ChoiceOf(algorithm, 0), dataset))
    {
      Add(choice, dataset, quantities);
    }
  }
  if (quantities.Functions.empty() && quantities.Flows.empty())
  {
    throw WrongChoice(
      "there is nothing to filter: no array is chosen, and none is active; choose arrays of numbers or of "
      "vectors, or eastward and northward components");
  }
  quantities.RelativeWavelengths = FindArray(ChoiceOf(algorithm, 3), dataset, 1, "relative wavelengths", "the surface");
  CheckRelativeWavelengths(quantities.RelativeWavelengths);
  return quantities;
}

}
