#include "Adapters/Input/GuidesOnSurface.h"

#include "Adapters/Input/GuideDataSets.h"
#include "Adapters/Surface/ArrayNames.h"
#include "Adapters/Surface/ElementArrays.h"
#include "Constraints/WeightsOfFaces.h"
#include "Support/Errors.h"
#include "Support/ShortText.h"

#include "vtkCellData.h"
#include "vtkDataSet.h"
#include "vtkDataSetAttributes.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkIdList.h"
#include "vtkInformationVector.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkPointData.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <sstream>

namespace dmg
{

namespace
{

/// The sine of 5 degrees: a direction that is nearer to the normal says nothing about directions in the surface.
constexpr double SmallestTangentialPart = 0.087155742747658;

bool IsPerpendicular(Complex tangential, const Vector3& direction)
{
  return std::abs(tangential) < SmallestTangentialPart * direction.stableNorm();
}

/// Brings one dataset after the other to a surface.
class Projection
{
public:
  Projection(const Guides& guides, const NearestPlaces& surface, const ExecutionContext& context)
    : Choices(guides.Choices)
    , Framed(surface.Framed)
    , Context(context)
    , MaximumDistance(guides.MaximumDistance * surface.Size)
    , Nearest(surface)
    , Segments(this->Nearest, this->MaximumDistance)
    , WeightsOfLines(surface.Framed.On.Mesh)
  {
    this->Result.Report.MaximumDistance = this->MaximumDistance;
  }

  /// \return whether it has anything to follow.
  bool Add(const GuideDataSet& dataset);

  GuidesOnSurface Result;

private:
  void AddVectors(const GuideDataSet& dataset, const ConstraintArrays& arrays);
  void AddVector(const Vector3& position, const Vector3& vector, double weight, const std::string& name);
  void AddLines(const GuideDataSet& dataset, const ConstraintChoices& choices);

  void AddSegment(const Vector3& start, const Vector3& end, const Vector3* vector, double weight);
  void CountElement();

  const ConstraintChoices& Choices;
  const FramedSurface Framed;
  const ExecutionContext& Context;
  const double MaximumDistance;
  const NearestPlaces& Nearest;
  const SegmentOnSurface Segments;
  const WeightsOfFaces WeightsOfLines;
  double OfWhole = 1.0; ///< the weight of the dataset
  long long Elements = 0;
};

void Projection::CountElement()
{
  if (++this->Elements % 100 == 0)
  {
    this->Context.Checkpoint(0.0);
  }
}

bool Projection::Add(const GuideDataSet& dataset)
{
  ConstraintChoices choices = ChoicesFor(this->Choices, dataset.Data);
  this->OfWhole = WholeWeight(this->Choices.Weights, dataset);
  if (this->OfWhole == 0.0)
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

void Projection::AddVectors(const GuideDataSet& dataset, const ConstraintArrays& arrays)
{
  vtkNew<vtkIdList> points;
  VisitPrescribed(
    arrays, [](vtkIdType) { return true; },
    [&](const ElementDirection& given)
    {
      const double weight = this->OfWhole * given.Weight;
      if (arrays.OnPoints)
      {
        this->AddVector(PositionOf(dataset, given.Element), given.Vector, weight, arrays.NameOf(given.Element));
        return;
      }
      dataset.Data->GetCellPoints(given.Element, points);
      const vtkIdType size = points->GetNumberOfIds();
      if (IsLine(dataset.Data, given.Element))
      {
        for (vtkIdType i = 0; i + 1 < size; ++i)
        {
          this->AddSegment(
            PositionOf(dataset, points->GetId(i)), PositionOf(dataset, points->GetId(i + 1)), &given.Vector, weight);
        }
      }
      else if (size > 0)
      {
        Vector3 center = Vector3::Zero();
        for (vtkIdType i = 0; i < size; ++i)
        {
          center += PositionOf(dataset, points->GetId(i)) / static_cast<double>(size);
        }
        this->AddVector(center, given.Vector, weight, arrays.NameOf(given.Element));
      }
    });
}

void Projection::AddVector(const Vector3& position, const Vector3& vector, double weight, const std::string& name)
{
  this->CountElement();
  GuidesReport& report = this->Result.Report;
  const NearestPlace place = this->Nearest(position);
  if (place.Face < 0 || place.Distance > this->MaximumDistance)
  {
    ++report.TooFar;
    return;
  }
  if (vector.isZero(0.0))
  {
    throw InvalidInput("the direction prescribed at " + name + " is zero; take it out of the mask");
  }
  if (IsPerpendicular(this->Framed.On.Faces.ToComplex(place.Face, vector), vector))
  {
    ++report.Perpendicular;
    return;
  }
  ++report.Taken;
  report.Farthest = std::max(report.Farthest, place.Distance);
  this->Result.Directions.push_back({ place.Face, vector, weight });
}

void Projection::AddLines(const GuideDataSet& dataset, const ConstraintChoices& choices)
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
    for (vtkIdType i = 0; i + 1 < points->GetNumberOfIds(); ++i)
    {
      const vtkIdType start = points->GetId(i), end = points->GetId(i + 1);
      const Vector3 from = PositionOf(dataset, start), to = PositionOf(dataset, end);
      const double weight = arrays.Weight(cell, start, end);
      if (weight > 0.0)
      {
        this->AddSegment(from, to, nullptr, this->OfWhole * weight);
      }
    }
  }
}

/// \param vector what the segment prescribes; null for its own direction, of unit length.
void Projection::AddSegment(const Vector3& start, const Vector3& end, const Vector3* vector, double weight)
{
  this->CountElement();
  GuidesReport& report = this->Result.Report;
  bool isTaken = false, isTooFar = false, isOnFarSide = false, isPerpendicular = false;
  const Vector3 given = vector ? *vector : Vector3((end - start).stableNormalized());
  for (const SegmentPart& part : this->Segments.PartsOf(start, end))
  {
    isTooFar |= part.Kind == SegmentPart::TooFar;
    isOnFarSide |= part.Kind == SegmentPart::OnFarSide;
    if (part.Kind != SegmentPart::OnSurface)
    {
      continue;
    }
    const Complex tangential = this->Framed.On.Faces.ToComplex(part.Face, given);
    if (IsPerpendicular(tangential, given))
    {
      isPerpendicular = true;
      continue;
    }
    // A chord leans into the surface; that says nothing about how strong the field shall be.
    const double length = vector ? 1.0 : std::abs(tangential);
    this->Result.Directions.push_back({ part.Face, this->Framed.On.Faces.ToVector(part.Face, tangential / length),
      weight * this->WeightsOfLines.OfLine(part.Face, part.Length) });
    isTaken = true;
    report.Farthest = std::max(report.Farthest, part.Distance);
  }
  report.Taken += isTaken;
  report.TooFar += isTooFar;
  report.OnFarSide += isOnFarSide;
  report.Perpendicular += isPerpendicular;
}

std::string Elements(long long number)
{
  return std::to_string(number) + (number == 1 ? " element" : " elements");
}

/// An array of a guide that holds three numbers for each point or cell; empty where there is none.
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
        if (array && array->GetName() && array->GetNumberOfComponents() == 3)
        {
          return array->GetName();
        }
      }
    }
  }
  return "";
}

}

std::string GuidesReport::LeftOut() const
{
  if (this->IsAllTaken())
  {
    return "";
  }
  std::ostringstream text;
  text << "parts of the guides are left out: ";
  const char* separator = "";
  const auto say = [&text, &separator](long long number, const std::string& where)
  {
    if (number > 0)
    {
      text << separator << Elements(number) << where;
      separator = ", ";
    }
  };
  say(this->TooFar, " farther from the surface than " + ShortText(this->MaximumDistance));
  say(this->OnFarSide, " nearer to the far side of a thin wall than to the near one");
  say(this->Perpendicular, " within 5 degrees of the normal of the surface");
  text << "; " << (this->TooFar > 0 ? "move them nearer to the surface, raise Maximum Distance, " : "")
       << (this->OnFarSide > 0 ? "give their lines more points, " : "")
       << (this->Perpendicular > 0 ? "turn them along the surface, " : "") << "or take them out of Guides";
  return text.str();
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

GuidesOnSurface BringToSurface(const Guides& guides, const NearestPlaces& surface, const ExecutionContext& context)
{
  const std::vector<GuideDataSet> datasets = DataSetsOf(guides.Data);
  if (datasets.empty())
  {
    return {};
  }
  CheckChoices(guides.Choices, datasets);
  Projection projection(guides, surface, context);
  std::map<std::size_t, bool> isFollowed; // by guide
  for (const GuideDataSet& dataset : datasets)
  {
    isFollowed[dataset.Guide] |= projection.Add(dataset);
  }
  for (const auto& [guide, something] : isFollowed)
  {
    if (!something)
    {
      const std::string vectors = NameOfVectors(datasets, guide);
      throw InvalidInput(NameOfGuide(guide, guides.Data.size()) +
        (vectors.empty() ? " has neither lines nor vectors to follow; add vectors to its points or cells, as "
                           "Calculator (vtkArrayCalculator) does, or take it out of Guides"
                         : " has no lines, and none of its arrays is marked as its vectors; choose '" + vectors +
              "', for example, as Guide Directions, or take the guide out of Guides"));
    }
  }
  projection.Result.AreGiven = true;
  return std::move(projection.Result);
}

void AddGuidesReport(const GuidesReport& report, vtkFieldData* fieldData)
{
  const auto add = [fieldData](const char* name, auto* array, auto value)
  {
    array->SetName(name);
    array->InsertNextValue(value);
    AddHidden(fieldData, array);
  };
  const std::pair<const char*, long long> counts[] = { { ArrayNames::GuidesTaken, report.Taken },
    { ArrayNames::GuidesTooFar, report.TooFar }, { ArrayNames::GuidesOnFarSide, report.OnFarSide },
    { ArrayNames::GuidesPerpendicular, report.Perpendicular } };
  for (const auto& [name, count] : counts)
  {
    add(name, vtkNew<vtkIntArray>().Get(), static_cast<int>(count));
  }
  add(ArrayNames::GuidesFarthest, vtkNew<vtkDoubleArray>().Get(), report.Farthest);
}

}
