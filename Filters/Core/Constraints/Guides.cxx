#include "Constraints/Guides.h"

#include "Constraints/SegmentOnSurface.h"
#include "Constraints/WeightsOfFaces.h"
#include "Support/Errors.h"
#include "Support/Remedy.h"
#include "Support/ShortText.h"

#include <algorithm>
#include <cmath>
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

/// A segment of a line, or a vector at its start.
struct Element
{
  Vector3 Start, End;
  const Vector3* Direction; ///< null: that of the segment
  double Weight;
  bool IsVector;
};

void CheckNumbers(bool areFinite, double weight, const std::string& name)
{
  if (!areFinite)
  {
    throw InvalidInput(name + " is not finite; repair it, or leave it out");
  }
  if (!(weight >= 0.0) || !std::isfinite(weight))
  {
    throw InvalidInput("the weight of " + name + " is " + ShortText(weight) + "; make it a positive number");
  }
}

double WeightOf(const GuideLine& line, std::size_t segment)
{
  return line.Weights.empty() ? 1.0 : line.Weights.size() == 1 ? line.Weights[0] : line.Weights[segment];
}

void AddLine(const GuideLine& line, std::size_t number, std::vector<Element>& elements)
{
  const std::size_t segments = line.Points.empty() ? 0 : line.Points.size() - 1;
  const auto name = [number](const char* what, std::size_t i)
  { return what + std::to_string(i) + " of guide line " + std::to_string(number); };
  if (line.Weights.size() > 1 && line.Weights.size() != segments)
  {
    throw InvalidInput("guide line " + std::to_string(number) + " has " + std::to_string(segments) + " segments and " +
      std::to_string(line.Weights.size()) + " weights; give one for each, or one for all");
  }
  for (std::size_t i = 0; i < line.Points.size(); ++i)
  {
    CheckNumbers(line.Points[i].allFinite(), 1.0, name("point ", i));
  }
  const Vector3* const direction = line.Direction ? &*line.Direction : nullptr;
  for (std::size_t i = 0; i < segments; ++i)
  {
    const double weight = WeightOf(line, i);
    CheckNumbers(!direction || direction->allFinite(), weight, name("segment ", i));
    if (weight > 0.0)
    {
      elements.push_back({ line.Points[i], line.Points[i + 1], direction, weight, false });
    }
  }
}

std::vector<Element> ElementsOf(const Guides& guides)
{
  std::vector<Element> elements;
  for (std::size_t i = 0; i < guides.Lines.size(); ++i)
  {
    AddLine(guides.Lines[i], i, elements);
  }
  for (std::size_t i = 0; i < guides.Vectors.size(); ++i)
  {
    const GuideVector& vector = guides.Vectors[i];
    const std::string name = "guide vector " + std::to_string(i);
    CheckNumbers(vector.Position.allFinite() && vector.Direction.allFinite(), vector.Weight, name);
    if (vector.Direction.isZero(0.0))
    {
      throw InvalidInput(name + " is zero; leave it out");
    }
    if (vector.Weight > 0.0)
    {
      elements.push_back({ vector.Position, vector.Position, &vector.Direction, vector.Weight, true });
    }
  }
  return elements;
}

/// Brings one element after the other to a surface.
class Projection
{
public:
  Projection(const NearestPlaces& surface, const WeightsOfFaces& weights, double maximumDistance)
    : Nearest(surface)
    , Weights(weights)
    , Segments(surface, maximumDistance)
  {
    this->Result.Report.MaximumDistance = maximumDistance;
  }

  void Add(const Element& element) { element.IsVector ? this->AddVector(element) : this->AddSegment(element); }

  FollowedGuides Result;

private:
  void AddVector(const Element& element);
  void AddSegment(const Element& element);

  const NearestPlaces& Nearest;
  const WeightsOfFaces& Weights;
  const SegmentOnSurface Segments;
};

void Projection::AddVector(const Element& element)
{
  GuidesReport& report = this->Result.Report;
  const NearestPlace place = this->Nearest(element.Start);
  if (place.Face < 0 || place.Distance > report.MaximumDistance)
  {
    ++report.TooFar;
    return;
  }
  if (IsPerpendicular(this->Nearest.Surface.Faces.ToComplex(place.Face, *element.Direction), *element.Direction))
  {
    ++report.Perpendicular;
    return;
  }
  ++report.Taken;
  report.Farthest = std::max(report.Farthest, place.Distance);
  this->Result.Directions.push_back({ place.Face, *element.Direction, element.Weight });
}

void Projection::AddSegment(const Element& element)
{
  const TangentFrames& frames = this->Nearest.Surface.Faces;
  GuidesReport& report = this->Result.Report;
  bool isTaken = false, isTooFar = false, isOnFarSide = false, isPerpendicular = false;
  const Vector3 given =
    element.Direction ? *element.Direction : Vector3((element.End - element.Start).stableNormalized());
  for (const SegmentPart& part : this->Segments.PartsOf(element.Start, element.End))
  {
    isTooFar |= part.Kind == SegmentPart::TooFar;
    isOnFarSide |= part.Kind == SegmentPart::OnFarSide;
    if (part.Kind != SegmentPart::OnSurface)
    {
      continue;
    }
    const Complex tangential = frames.ToComplex(part.Face, given);
    if (IsPerpendicular(tangential, given))
    {
      isPerpendicular = true;
      continue;
    }
    // A chord leans into the surface; that says nothing about how strong the field shall be.
    const double length = element.Direction ? 1.0 : std::abs(tangential);
    this->Result.Directions.push_back({ part.Face, frames.ToVector(part.Face, tangential / length),
      element.Weight * this->Weights.OfLine(part.Face, part.Length) });
    isTaken = true;
    report.Farthest = std::max(report.Farthest, part.Distance);
  }
  report.Taken += isTaken;
  report.TooFar += isTooFar;
  report.OnFarSide += isOnFarSide;
  report.Perpendicular += isPerpendicular;
}

void Append(FollowedGuides& all, const FollowedGuides& part)
{
  all.Directions.insert(all.Directions.end(), part.Directions.begin(), part.Directions.end());
  all.Report.Taken += part.Report.Taken;
  all.Report.TooFar += part.Report.TooFar;
  all.Report.OnFarSide += part.Report.OnFarSide;
  all.Report.Perpendicular += part.Report.Perpendicular;
  all.Report.Farthest = std::max(all.Report.Farthest, part.Report.Farthest);
}

std::string Elements(long long number)
{
  return std::to_string(number) + (number == 1 ? " element" : " elements");
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
  text << "; "
       << (this->TooFar > 0 ? "move them nearer to the surface, raise " + TextOf(Remedy::MaximumDistance) + ", " : "")
       << (this->OnFarSide > 0 ? "give their lines more points, " : "")
       << (this->Perpendicular > 0 ? "turn them along the surface, " : "") << "or take them out of "
       << TextOf(Remedy::Guides);
  return text.str();
}

FollowedGuides FollowGuides(const Guides& guides, const NearestPlaces& surface, const ExecutionContext& context)
{
  constexpr int Block = 64, BlocksAtATime = 64; // small enough for checkpoints in between
  const std::vector<Element> elements = ElementsOf(guides);
  const int size = static_cast<int>(elements.size());
  const WeightsOfFaces weights(surface.Surface.Mesh);
  FollowedGuides all;
  all.Report.MaximumDistance = guides.MaximumDistance * surface.Size;
  for (int start = 0; start < size; start += Block * BlocksAtATime)
  {
    context.Checkpoint(static_cast<double>(start) / size);
    const int blocks = std::min(BlocksAtATime, (size - start + Block - 1) / Block);
    std::vector<FollowedGuides> parts(blocks);
    context.ParallelFor(0, blocks, 1,
      [&](int firstBlock, int lastBlock)
      {
        for (int block = firstBlock; block < lastBlock; ++block)
        {
          Projection projection(surface, weights, all.Report.MaximumDistance);
          const int first = start + Block * block, last = std::min(first + Block, size);
          for (int i = first; i < last; ++i)
          {
            projection.Add(elements[i]);
          }
          parts[block] = std::move(projection.Result);
        }
      });
    for (const FollowedGuides& part : parts)
    {
      Append(all, part);
    }
  }
  return all;
}

}
