#include "Systems/AlignmentConstraints.h"

#include "Support/Errors.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace dmg
{

namespace
{

/// A direction leaning less than this (as a sine) out of the normal has no part in the plane.
constexpr double SmallestTangentialPart = 1e-6;

Complex TangentialPart(const TriangleMesh& mesh, const TangentFrames& faceFrames,
  const PrescribedDirection& prescribed, const ElementNames& names)
{
  if (prescribed.Face < 0 || prescribed.Face >= mesh.NumberOfFaces())
  {
    throw InvalidInput("a direction is prescribed on face " + std::to_string(prescribed.Face) +
      ", but there are " + std::to_string(mesh.NumberOfFaces()) + " faces; leave it out");
  }
  const std::string where = " prescribed on " + names.Face(prescribed.Face);
  if (!prescribed.Direction.allFinite())
  {
    throw InvalidInput(
      "the direction" + where + " is not finite; repair it or take the cell out of the mask");
  }
  if (!(prescribed.Weight > 0.0) || !std::isfinite(prescribed.Weight))
  {
    throw InvalidInput("the weight of the direction" + where + " is " +
      std::to_string(prescribed.Weight) +
      "; make it positive and finite or take the cell out of the mask");
  }
  const Complex tangential = faceFrames.ToComplex(prescribed.Face, prescribed.Direction);
  if (!(std::abs(tangential) > SmallestTangentialPart * prescribed.Direction.norm()))
  {
    throw InvalidInput("the direction" + where +
      (prescribed.Direction.norm() > 0.0 ? " is perpendicular to it" : " is zero") +
      "; give it a part in the plane of the cell or take the cell out of the mask");
  }
  return tangential;
}

void CheckWeight(const char* name, double weight)
{
  if (!(weight > 0.0) || !std::isfinite(weight))
  {
    throw InvalidInput(std::string("the ") + name + " weight is " + std::to_string(weight) +
      "; make it positive and finite");
  }
}

}

void CheckWeights(const FieldWeights& weights)
{
  CheckWeight("smoothness", weights.Smoothness);
  CheckWeight("alignment", weights.Alignment);
}

PowerConstraints MakePowerConstraints(const TriangleMesh& mesh, const TangentFrames& faceFrames,
  int N, const std::vector<PrescribedDirection>& directions, const ElementNames& names)
{
  std::vector<int> order(directions.size());
  std::iota(order.begin(), order.end(), 0);
  std::stable_sort(order.begin(), order.end(),
    [&directions](int a, int b) { return directions[a].Face < directions[b].Face; });

  PowerConstraints constraints;
  PrescribedFaces& prescribed = constraints.Prescribed;
  std::vector<Complex> sums;
  for (int i : order)
  {
    const Complex v = TangentialPart(mesh, faceFrames, directions[i], names);
    if (prescribed.Faces.empty() || prescribed.Faces.back() != directions[i].Face)
    {
      prescribed.Faces.push_back(directions[i].Face);
      prescribed.Weights.push_back(0.0);
      sums.emplace_back(0.0);
    }
    prescribed.Weights.back() += directions[i].Weight;
    sums.back() += directions[i].Weight * std::polar(std::abs(v), N * std::arg(v));
  }

  constraints.Values.resize(sums.size());
  for (std::size_t b = 0; b < sums.size(); ++b)
  {
    constraints.Values[b] = sums[b] / prescribed.Weights[b];
  }
  return constraints;
}

}
