#include "Adapters/Input/GuidesFromDataSets.h"

#include "Adapters/Input/GuideDataSets.h"
#include "Support/Errors.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkDataSetAttributes.h"
#include "vtkExecutive.h"
#include "vtkFieldData.h"
#include "vtkIdList.h"
#include "vtkInformation.h"
#include "vtkInformationExecutivePortKey.h"
#include "vtkInformationVector.h"
#include "vtkNew.h"
#include "vtkPointData.h"

#include <algorithm>
#include <map>
#include <set>
#include <utility>

namespace dmg
{

namespace
{

/// Reads one dataset after the other.
class Reader
{
public:
  /// \param weightsOfGuides TypedWeights.
  Reader(const ConstraintArrays& choices, const std::vector<double>& weightsOfGuides)
    : Choices(choices)
    , WeightsOfGuides(weightsOfGuides)
  {
  }

  /// \return whether it has anything to follow.
  bool Add(const GuideDataSet& dataset);

  Guides Result;
  UnusableDirections Unusable;

private:
  void AddVectors(const GuideDataSet& dataset, const ConstraintArrays& arrays);
  void AddLines(const GuideDataSet& dataset, const ConstraintArrays& choices);

  const ConstraintArrays& Choices;
  const std::vector<double>& WeightsOfGuides;
  double WeightOfWhole = 1.0; ///< the weight of the dataset
};

bool Reader::Add(const GuideDataSet& dataset)
{
  ConstraintArrays choices = ChoicesFor(this->Choices, dataset.Data);
  this->WeightOfWhole =
    this->WeightsOfGuides.empty() ? WholeWeight(this->Choices.Weights, dataset) : this->WeightsOfGuides[dataset.Guide];
  if (this->WeightOfWhole == 0.0)
  {
    return true;
  }
  if (!choices.Vectors.IsMade() && HasLines(dataset.Data))
  {
    this->AddLines(dataset, choices);
    return true;
  }
  if (!choices.Vectors.IsMade())
  {
    choices.Vectors.Attribute = vtkDataSetAttributes::VECTORS;
    choices.Vectors.Association = vtkDataObject::FIELD_ASSOCIATION_POINTS_THEN_CELLS;
  }
  if (!HasArray(choices.Vectors, dataset.Data))
  {
    return false;
  }
  this->AddVectors(dataset, FindArrays(choices, dataset.Data, dataset.Name));
  return true;
}

void Reader::AddVectors(const GuideDataSet& dataset, const ConstraintArrays& arrays)
{
  vtkNew<vtkIdList> points;
  const UnusableDirections passedOver = VisitPrescribed(
    arrays, dataset.Data, dataset.Name, {}, [](vtkIdType) { return true; },
    [&](const ElementDirection& given)
    {
      const double weight = this->WeightOfWhole * given.Weight;
      if (arrays.Vectors.OnPoints())
      {
        this->Result.Vectors.push_back({ PositionOf(dataset, given.Element), given.Vector, weight });
        return;
      }
      dataset.Data->GetCellPoints(given.Element, points);
      std::vector<Vector3> positions;
      for (vtkIdType i = 0; i < points->GetNumberOfIds(); ++i)
      {
        positions.push_back(PositionOf(dataset, points->GetId(i)));
      }
      if (IsLine(dataset.Data, given.Element))
      {
        this->Result.Lines.push_back({ std::move(positions), { weight }, given.Vector });
      }
      else if (!positions.empty())
      {
        Vector3 center = Vector3::Zero();
        for (const Vector3& position : positions)
        {
          center += position / static_cast<double>(positions.size());
        }
        this->Result.Vectors.push_back({ center, given.Vector, weight });
      }
    });
  this->Unusable.NotFinite += passedOver.NotFinite;
  this->Unusable.Zero += passedOver.Zero;
  this->Unusable.FillValues += this->Unusable.FillValues.empty() ? passedOver.FillValues : "";
}

void Reader::AddLines(const GuideDataSet& dataset, const ConstraintArrays& choices)
{
  const LineArrays arrays(choices, dataset);
  vtkNew<vtkIdList> points;
  for (vtkIdType cell = 0; cell < dataset.Data->GetNumberOfCells(); ++cell)
  {
    if (!IsLine(dataset.Data, cell))
    {
      continue;
    }
    dataset.Data->GetCellPoints(cell, points);
    GuideLine line;
    for (vtkIdType i = 0; i < points->GetNumberOfIds(); ++i)
    {
      line.Points.push_back(PositionOf(dataset, points->GetId(i)));
      if (i > 0)
      {
        line.Weights.push_back(this->WeightOfWhole * arrays.Weight(cell, points->GetId(i - 1), points->GetId(i)));
      }
    }
    this->Result.Lines.push_back(std::move(line));
  }
}

/// The output that data come from, also where they are copied on their way.
using Source = std::pair<const void*, int>;

Source SourceOf(vtkInformation* connection, vtkDataObject* data)
{
  vtkExecutive* const executive = vtkExecutive::PRODUCER()->GetExecutive(connection);
  return executive ? Source(executive, vtkExecutive::PRODUCER()->GetPort(connection)) : Source(data, 0);
}

/// An array of a guide that holds three numbers for each point or cell, neither normals nor colours; empty where there is none.
std::string NameOfVectors(const std::vector<GuideDataSet>& datasets, std::size_t guide)
{
  for (const GuideDataSet& dataset : datasets)
  {
    for (vtkFieldData* const arrays : { static_cast<vtkFieldData*>(dataset.Data->GetPointData()),
           static_cast<vtkFieldData*>(dataset.Data->GetCellData()) })
    {
      for (int k = 0; dataset.Guide == guide && k < arrays->GetNumberOfArrays(); ++k)
      {
        vtkDataArray* const array = arrays->GetArray(k);
        if (array && array->GetName() && array->GetNumberOfComponents() == 3 &&
          array->GetName() != std::string("Normals") && array->GetDataType() != VTK_UNSIGNED_CHAR)
        {
          return array->GetName();
        }
      }
    }
  }
  return "";
}

}

std::vector<vtkDataObject*> DataOf(vtkInformationVector* port)
{
  std::vector<vtkDataObject*> all;
  for (int i = 0; i < port->GetNumberOfInformationObjects(); ++i)
  {
    if (vtkDataObject* const data = vtkDataObject::GetData(port, i))
    {
      all.push_back(data);
    }
  }
  return all;
}

GuideInput GuidesOf(
  vtkInformationVector** inputs, const std::vector<int>& ports, const ConstraintArrays& choices, double maximumDistance)
{
  GuideInput guides{ {}, {}, 0, 0, choices, maximumDistance };
  std::set<Source> sources;
  int slot = 0;
  for (const int port : ports)
  {
    const int connections = inputs[port]->GetNumberOfInformationObjects();
    for (int i = 0; i < connections; ++i)
    {
      vtkDataObject* const data = vtkDataObject::GetData(inputs[port], i);
      const bool isNew = data && sources.insert(SourceOf(inputs[port]->GetInformationObject(i), data)).second;
      guides.Repeated += data && !isNew;
      guides.UsedSlots = data ? slot + i + 1 : guides.UsedSlots;
      if (isNew)
      {
        guides.Data.push_back(data);
        guides.Slots.push_back(slot + i);
      }
    }
    slot += std::max(connections, 1);
  }
  return guides;
}

std::vector<std::string> WarningsOf(const GuideInput& input)
{
  std::vector<std::string> warnings;
  if (input.Repeated > 0)
  {
    warnings.emplace_back("the same guide is chosen more than once; it is followed once, with its first weight");
  }
  const std::size_t numbers = TypedNumbers(input.Choices.Weights, DataSetsOf(input.Data)).size();
  if (input.UsedSlots > 0 && numbers > input.UsedSlots)
  {
    warnings.push_back("Guide Weights has " + std::to_string(numbers) + " numbers, and the last guide takes number " +
      std::to_string(input.UsedSlots) + "; those after it are not used");
  }
  return warnings;
}

Guides GuidesFrom(const GuideInput& input, UnusableDirections& unusable)
{
  const std::vector<GuideDataSet> datasets = DataSetsOf(input.Data);
  ConstraintArrays choices = input.Choices;
  const std::vector<double> typed = TypedWeights(TypedNumbers(choices.Weights, datasets), input.Slots);
  if (!typed.empty())
  {
    choices.Weights = {};
  }
  CheckChoices(choices, datasets);
  Reader reader(choices, typed);
  std::map<std::size_t, bool> isFollowed; // by guide
  for (const GuideDataSet& dataset : datasets)
  {
    isFollowed[dataset.Guide] |= reader.Add(dataset);
  }
  for (const auto& [guide, something] : isFollowed)
  {
    if (!something)
    {
      const std::string vectors = NameOfVectors(datasets, guide);
      throw InvalidInput(NameOfGuide(guide, input.Data.size()) +
        (vectors.empty() ? " has neither lines nor vectors to follow; add vectors to its points or cells, as "
                           "Calculator (vtkArrayCalculator) does, or take it out of Guides"
                         : " has no lines, and none of its arrays is marked as its vectors; choose '" + vectors +
              "', for example, as Guide Directions, or take the guide out of Guides"));
    }
  }
  unusable.NotFinite += reader.Unusable.NotFinite;
  unusable.Zero += reader.Unusable.Zero;
  unusable.FillValues += unusable.FillValues.empty() ? reader.Unusable.FillValues : "";
  reader.Result.MaximumDistance = input.MaximumDistance;
  return std::move(reader.Result);
}

}
