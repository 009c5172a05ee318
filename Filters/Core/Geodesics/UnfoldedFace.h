#ifndef dmgUnfoldedFace_h
#define dmgUnfoldedFace_h

#include "Geodesics/IntrinsicTriangulation.h"
#include "Support/Types.h"

#include <algorithm>
#include <array>
#include <cmath>

namespace dmg
{

/// The squared distance along a side of length L, by its values and its derivatives at both ends; s runs from 0 to 1.
class SquaredDistance
{
public:
  /// \param toA, toB distances of the ends; \param alongA, alongB cosines of the wavefront's directions against the side.
  SquaredDistance(double length, double toA, double alongA, double toB, double alongB)
    : Constant(toA * toA)
    , Linear(2.0 * toA * alongA * length)
  {
    const double rise = toB * toB - this->Constant;
    const double slope = 2.0 * toB * alongB * length;
    this->Square = 3.0 * rise - 2.0 * this->Linear - slope;
    this->Cube = this->Linear + slope - 2.0 * rise;
  }

  /// The square of the distance from the point that has given distances from both ends.
  /// \pre they differ by the length at most.
  static SquaredDistance OfPoint(double length, double toA, double toB)
  {
    const double x = 0.5 * (length + (toA - toB) * (toA + toB) / length);
    return { length, toA, -x / toA, toB, (length - x) / toB };
  }

  double At(double s) const { return this->Constant + s * (this->Linear + s * (this->Square + s * this->Cube)); }
  double Slope(double s) const { return this->Linear + s * (2.0 * this->Square + 3.0 * s * this->Cube); }
  double Bend(double s) const { return 2.0 * this->Square + 6.0 * s * this->Cube; }
  /// The change of the second derivative along the side; 0 for one point or straight line in a plane.
  double ChangeOfBend() const { return std::abs(6.0 * this->Cube); }

private:
  double Constant, Linear, Square, Cube;
};

/// A triangle in a plane: the side from A = 0 to B = L, which a wavefront has reached, and C above.
class UnfoldedFace
{
public:
  UnfoldedFace(const IntrinsicTriangulation& surface, int side)
    : L(surface.Length(side))
  {
    const double toA = surface.Length(TriangleMesh::Previous(side));
    const double toB = surface.Length(TriangleMesh::Next(side));
    const double x = 0.5 * (this->L + (toA - toB) * (toA + toB) / this->L);
    this->C = { x, std::sqrt(std::max((toA - x) * (toA + x), 0.0)) };
  }

  /// The part of the side at which the ray from a point below to C crosses it.
  double Crossing(Complex below) const
  {
    return (below.real() - (this->C.real() - below.real()) * below.imag() / (this->C - below).imag()) / this->L;
  }

  /// The place that has given distances from A and B; at infinity where there is none.
  Complex SourceOf(double toA, double toB) const
  {
    const double x = 0.5 * (this->L + (toA - toB) * (toA + toB) / this->L);
    return { x, -std::sqrt(std::max((toA - x) * (toA + x), 0.0)) };
  }

  /// The length up to C across the side at s.
  double LengthAcross(const SquaredDistance& square, double s) const
  {
    return std::sqrt(std::max(square.At(s), 0.0)) + std::abs(this->C - s * this->L);
  }

  /// The part of the side at which the length up to C is least, by Newton's method; negative where that is an end.
  double Shortest(const SquaredDistance& square, double guess) const
  {
    constexpr double Margin = 1e-6; // ends have edges of their own to C
    constexpr double Enough = 1e-13;
    constexpr int MostSteps = 60;
    double low = Margin, high = 1.0 - Margin;
    if (!(this->Derivatives(square, low)[0] < 0.0 && this->Derivatives(square, high)[0] > 0.0))
    {
      return -1.0;
    }
    double s = guess > low && guess < high ? guess : 0.5;
    for (int step = 0; step < MostSteps; ++step)
    {
      const auto [slope, bend] = this->Derivatives(square, s);
      (slope < 0.0 ? low : high) = s;
      const double newton = bend > 0.0 ? s - slope / bend : -1.0;
      const double next = newton > low && newton < high ? newton : 0.5 * (low + high);
      const double change = std::abs(next - s);
      s = next;
      if (change <= Enough)
      {
        break;
      }
    }
    return s;
  }

  const double L;
  Complex C;

private:
  /// The first and the second derivative of the length across the side.
  std::array<double, 2> Derivatives(const SquaredDistance& square, double s) const
  {
    const double root = std::sqrt(std::max(square.At(s), 0.0));
    const Complex ray = this->C - s * this->L;
    const double left = std::abs(ray);
    std::array<double, 2> derivatives = { -this->L * ray.real() / left,
      this->L * this->L * ray.imag() * ray.imag() / (left * left * left) };
    if (root > 0.0)
    {
      const double slope = square.Slope(s) / (2.0 * root);
      derivatives[0] += slope;
      derivatives[1] += (0.5 * square.Bend(s) - slope * slope) / root;
    }
    return derivatives;
  }
};

}

#endif
