#include "Constraints/Guides.h"

#include "Constraints/SegmentOnSurface.h"
#include "Constraints/WeightsOfFaces.h"
#include "Mesh/NormalParts.h"
#include "Mesh/SpatialOrder.h"
#include "Support/Errors.h"
#include "Support/Remedy.h"
#include "Support/ShortText.h"

#include <algorithm>
#include <cmath>
#include <numeric>
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

  void Add(const Element& element)
  {
    element.IsVector ? this->AddVector(element) : this->AddSegment(element);
    this->Ends.push_back(static_cast<int>(this->Result.Directions.size()));
  }

  FollowedGuides Result;
  std::vector<int> Ends; ///< of each element: the number of directions up to it

private:
  void AddVector(const Element& element);
  void AddSegment(const Element& element);
  bool AddPart(const SegmentPart& part, const Element& element);
  void AddToPath(const SegmentPart& part, const SegmentPart* before);
  void Prescribe(const Constraint& direction, const Vector3& place)
  {
    this->Result.Directions.push_back(direction);
    this->Result.Places.push_back(place);
  }

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
  this->Prescribe({ place.Face, *element.Direction, element.Weight }, place.Position);
}

void Projection::AddSegment(const Element& element)
{
  GuidesReport& report = this->Result.Report;
  bool isTaken = false, isTooFar = false, isOnFarSide = false, isPerpendicular = false;
  const SegmentPart* before = nullptr; // where the path goes on from it
  const std::vector<SegmentPart> parts = this->Segments.PartsOf(element.Start, element.End);
  for (const SegmentPart& part : parts)
  {
    isTooFar |= part.Kind == SegmentPart::TooFar;
    isOnFarSide |= part.Kind == SegmentPart::OnFarSide;
    const bool isHere = part.Kind == SegmentPart::OnSurface && this->AddPart(part, element);
    isPerpendicular |= part.Kind == SegmentPart::OnSurface && !isHere;
    isTaken |= isHere;
    if (isHere)
    {
      report.Farthest = std::max(report.Farthest, part.Distance);
      this->AddToPath(part, before);
    }
    before = isHere ? &part : nullptr;
  }
  report.Taken += isTaken;
  report.TooFar += isTooFar;
  report.OnFarSide += isOnFarSide;
  report.Perpendicular += isPerpendicular;
}

/// \return whether it prescribes something: the direction is not perpendicular to the face.
bool Projection::AddPart(const SegmentPart& part, const Element& element)
{
  const TangentFrames& frames = this->Nearest.Surface.Faces;
  const Vector3 given =
    element.Direction ? *element.Direction : Vector3((element.End - element.Start).stableNormalized());
  const Complex tangential = frames.ToComplex(part.Face, given);
  if (IsPerpendicular(tangential, given))
  {
    return false;
  }
  // A chord leans into the surface; that says nothing about how strong the field shall be.
  const double length = element.Direction ? 1.0 : std::abs(tangential);
  const double weight = element.Weight * this->Weights.OfLine(part.Face, part.Length);
  const Vector3 middle = 0.5 * part.Start + 0.5 * part.End;
  this->Prescribe(
    { part.Face, element.Direction ? given : frames.ToVector(part.Face, tangential / length), weight, -2 }, middle);
  return true;
}

/// Goes on with the last path, or begins one. \param before the part that it goes on from, or null.
void Projection::AddToPath(const SegmentPart& part, const SegmentPart* before)
{
  GuidePaths& paths = this->Result.Report.Paths;
  if (before && before->Start == part.Start)
  {
    return; // along an edge, whose other face has it
  }
  const auto add = [&](const Vector3& position)
  {
    const Vector3 place = ClosestOnFace(this->Nearest.Surface.Mesh, part.Face, position).Position;
    if (!before || place != paths.Positions.back())
    {
      paths.Positions.push_back(place);
    }
  };
  add(part.Start);
  add(part.End);
  if (before)
  {
    paths.Ends.pop_back();
  }
  paths.Ends.push_back(static_cast<int>(paths.Positions.size()));
}

void Append(const GuidePaths& part, GuidePaths& all)
{
  const int first = static_cast<int>(all.Positions.size());
  all.Positions.insert(all.Positions.end(), part.Positions.begin(), part.Positions.end());
  for (const int end : part.Ends)
  {
    all.Ends.push_back(first + end);
  }
}

void Add(const GuidesReport& part, GuidesReport& all)
{
  all.Taken += part.Taken;
  all.TooFar += part.TooFar;
  all.OnFarSide += part.OnFarSide;
  all.Perpendicular += part.Perpendicular;
  all.Farthest = std::max(all.Farthest, part.Farthest);
  Append(part.Paths, all.Paths);
}

/// The directions and the report of a run of elements.
struct FollowedRun
{
  FollowedGuides Guides;
  std::vector<int> Ends;
};

/// The directions of all elements one after the other, or their places, from runs of them in another order.
template <class Item>
std::vector<Item> InOrderOfElements(
  const std::vector<FollowedRun>& runs, const std::vector<int>& order, std::vector<Item> FollowedGuides::*items)
{
  std::vector<int> starts(order.size() + 1, 0);
  const auto visit = [&](const auto& each)
  {
    std::size_t next = 0;
    for (const FollowedRun& run : runs)
    {
      for (std::size_t i = 0; i < run.Ends.size(); ++i)
      {
        const Item* const first = (run.Guides.*items).data();
        each(order[next++], first + (i == 0 ? 0 : run.Ends[i - 1]), first + run.Ends[i]);
      }
    }
  };
  visit([&starts](int element, const Item* first, const Item* last)
    { starts[element + 1] = static_cast<int>(last - first); });
  std::partial_sum(starts.begin(), starts.end(), starts.begin());
  std::vector<Item> all(starts.back());
  visit([&starts, &all](int element, const Item* first, const Item* last)
    { std::copy(first, last, all.begin() + starts[element]); });
  return all;
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

void CheckGuides(const Guides& guides)
{
  static_cast<void>(ElementsOf(guides));
}

FollowedGuides FollowGuides(const Guides& guides, const NearestPlaces& surface, const ExecutionContext& context)
{
  constexpr int Block = 64, BlocksAtATime = 64; // small enough for checkpoints in between
  const std::vector<Element> elements = ElementsOf(guides);
  const int size = static_cast<int>(elements.size());
  const SurfaceSizes& sizes = surface.Sizes;
  const WeightsOfFaces weights(surface.Surface.Mesh, sizes);
  FollowedGuides all;
  all.Report.MaximumDistance = guides.MaximumDistance * sizes.Diagonal();
  // Elements that are near each other follow each other, so that the tree of boxes stays in the cache.
  const std::vector<int> order = InSpatialOrder(
    size, [&elements](int i) { return elements[i].Start; }, sizes.Lower, (sizes.Upper - sizes.Lower).maxCoeff(),
    context);
  std::vector<FollowedRun> runs((size + Block - 1) / Block);
  for (int start = 0; start < static_cast<int>(runs.size()); start += BlocksAtATime)
  {
    context.Checkpoint(static_cast<double>(start) / runs.size());
    context.ParallelFor(start, std::min(start + BlocksAtATime, static_cast<int>(runs.size())), 1,
      [&](int firstRun, int lastRun)
      {
        for (int run = firstRun; run < lastRun; ++run)
        {
          Projection projection(surface, weights, all.Report.MaximumDistance);
          for (int i = Block * run; i < std::min(Block * (run + 1), size); ++i)
          {
            projection.Add(elements[order[i]]);
          }
          runs[run] = { std::move(projection.Result), std::move(projection.Ends) };
        }
      });
  }
  for (const FollowedRun& run : runs)
  {
    Add(run.Guides.Report, all.Report);
  }
  all.Directions = InOrderOfElements(runs, order, &FollowedGuides::Directions);
  all.Places = InOrderOfElements(runs, order, &FollowedGuides::Places);
  return all;
}

void TakeOutNormalParts(FollowedGuides& guides, const TriangleMesh& mesh, int firstFace)
{
  for (std::size_t i = 0; i < guides.Directions.size(); ++i)
  {
    Constraint& on = guides.Directions[i];
    const Vector3 tangential = WithoutNormalPartAt(mesh, firstFace + on.Element, guides.Places[i], on.Direction);
    on.Direction = tangential.isZero(0.0) ? on.Direction : tangential; // it was not perpendicular to the face
  }
}

}
