#include "Levels/SampledProlongation.h"

#include "Support/SparseAssembly.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dmg
{

namespace
{

/// The area, relative to the product of their lengths, below which two steps span no triangle.
constexpr double SmallestSine = 1e-9;

double Cross(Complex a, Complex b)
{
  return a.real() * b.imag() - a.imag() * b.real();
}

/// The parameter in [0, 1] of the point nearest to p on the side from a to b.
double NearestOnSide(Complex a, Complex b, Complex p)
{
  const double squaredLength = std::norm(b - a);
  if (squaredLength == 0.0)
  {
    return 0.0;
  }
  const Complex along = std::conj(b - a) * (p - a);
  return std::clamp(along.real() / squaredLength, 0.0, 1.0);
}

/// Weights of at most two links of a sample; the sample itself has the rest.
struct Weights
{
  int First;
  int Second;
  double OfFirst;
  double OfSecond;
};

/// Barycentric weights of a place in the triangle between two links, or on its far side. \return false if
/// the links span no triangle there.
bool WeightsInTriangle(const TangentGraph& samples, int first, int second, Complex place, Weights& weights)
{
  const Complex a = samples.Steps[first];
  const Complex b = samples.Steps[second];
  const double doubledArea = Cross(a, b);
  const double ofFirst = Cross(place, b);
  const double ofSecond = Cross(a, place);
  if (ofFirst < 0.0 || ofSecond < 0.0 || !(doubledArea > SmallestSine * std::sqrt(std::norm(a) * std::norm(b))))
  {
    return false;
  }
  if (ofFirst + ofSecond <= doubledArea)
  {
    weights = { first, second, ofFirst / doubledArea, ofSecond / doubledArea };
  }
  else
  {
    const double t = NearestOnSide(a, b, place);
    weights = { first, second, 1.0 - t, t };
  }
  return true;
}

/// The weights of the nearest place on the links of a sample.
Weights WeightsOnLink(const TangentGraph& samples, int begin, int end, Complex place)
{
  Weights weights{ begin, begin, 0.0, 0.0 };
  double nearest = std::numeric_limits<double>::infinity();
  for (int link = begin; link < end; ++link)
  {
    const double t = NearestOnSide(0.0, samples.Steps[link], place);
    const double distance = std::norm(place - t * samples.Steps[link]);
    if (distance < nearest)
    {
      nearest = distance;
      weights = { link, link, t, 0.0 };
    }
  }
  return weights;
}

Weights WeightsAround(const TangentGraph& samples, int begin, int end, Complex place)
{
  Weights weights;
  for (int link = begin; link < end; ++link)
  {
    if (WeightsInTriangle(samples, link, link + 1 < end ? link + 1 : begin, place, weights))
    {
      return weights;
    }
  }
  return WeightsOnLink(samples, begin, end, place);
}

void Append(RowEntries<Complex>& row, int sample, Complex entry)
{
  if (entry != 0.0)
  {
    row.emplace_back(sample, entry);
  }
}

AssembledRows<Complex> RowsOfPoints(
  const PointSampling& sampling, const TangentGraph& samples, const ExecutionContext& context)
{
  const auto appendRow = [&](int point, RowEntries<Complex>& row)
  {
    const int owner = sampling.Owners[point];
    const Complex toPoint = std::conj(sampling.Turns[point]);
    const int begin = samples.Offsets[owner];
    const int end = samples.Offsets[owner + 1];
    if (begin == end)
    {
      row.emplace_back(owner, toPoint);
      return;
    }
    const auto [first, second, ofFirst, ofSecond] = WeightsAround(samples, begin, end, sampling.Places[point]);
    Append(row, owner, std::max(0.0, 1.0 - ofFirst - ofSecond) * toPoint);
    Append(row, samples.Neighbours[first], ofFirst * toPoint * samples.Turns[first]);
    Append(row, samples.Neighbours[second], ofSecond * toPoint * samples.Turns[second]);
  };
  return { static_cast<int>(sampling.Owners.size()), context, appendRow };
}

}

TransportOperator SampledProlongation(
  const PointSampling& sampling, const TangentGraph& samples, const ExecutionContext& context)
{
  return MatrixOf(RowsOfPoints(sampling, samples, context), static_cast<int>(sampling.Owners.size()),
    static_cast<int>(sampling.Samples.size()), context, [](int point) { return point; });
}

TransportOperator SampledProlongation(const PointSampling& sampling, const TangentGraph& samples,
  const std::vector<int>& points, const ExecutionContext& context)
{
  return MatrixOf(RowsOfPoints(sampling, samples, context), static_cast<int>(points.size()),
    static_cast<int>(sampling.Samples.size()), context, [&points](int row) { return points[row]; });
}

}
