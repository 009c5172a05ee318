#include "Preparation/EarClipping.h"

#include <algorithm>
#include <cmath>

namespace dmg
{

namespace
{

/// 4 sqrt(3) area / sum of squared sides, with the sign of the area against a normal.
double SignedQuality(const Vector3& a, const Vector3& b, const Vector3& c, const Vector3& normal)
{
  const Vector3 area = (b - a).cross(c - a);
  const double sides = (b - a).squaredNorm() + (c - b).squaredNorm() + (a - c).squaredNorm();
  const double sign = area.dot(normal) < 0.0 ? -1.0 : 1.0;
  return sides > 0.0 ? sign * 2.0 * std::sqrt(3.0) * area.norm() / sides : 0.0;
}

/// A choice between two diagonals shall not hang on rounding.
constexpr double SmallestGain = 1e-9;

}

void PolygonCutter::Start(const int* corners, int n)
{
  const int smallest = static_cast<int>(std::min_element(corners, corners + n) - corners);
  this->Ring.clear();
  for (int k = 0; k < n; ++k)
  {
    const int corner = corners[(smallest + k) % n];
    if (this->Ring.empty() || this->Ring.back() != corner)
    {
      this->Ring.push_back(corner);
    }
  }
  while (this->Ring.size() > 1 && this->Ring.back() == this->Ring.front())
  {
    this->Ring.pop_back();
  }
}

void PolygonCutter::Add(int a, int b, int c)
{
  *this->Next++ = a;
  *this->Next++ = b;
  *this->Next++ = c;
}

void PolygonCutter::operator()(const int* corners, int n, int* triangles)
{
  this->Next = triangles;
  if (n == 3)
  {
    this->Add(corners[0], corners[1], corners[2]);
    return;
  }
  if (n == 0)
  {
    return;
  }
  this->Start(corners, n);
  if (this->Ring.size() == 4)
  {
    this->CutQuad();
  }
  else if (this->Ring.size() >= 3)
  {
    this->CutEars();
  }
  // Sides without length stand for the triangles that repeated corners would have had.
  for (int* const end = triangles + 3 * std::max(1, n - 2); this->Next != end;)
  {
    this->Add(this->Ring.front(), this->Ring.back(), this->Ring.back());
  }
}

void PolygonCutter::CutQuad()
{
  const auto at = [this](int k) -> Vector3 { return this->Positions.row(this->Ring[k]); };
  const Vector3 a = at(0), b = at(1), c = at(2), d = at(3);
  const Vector3 normal = (c - a).cross(d - b);
  const double fromFirst = std::min(SignedQuality(a, b, c, normal), SignedQuality(a, c, d, normal));
  const double fromSecond = std::min(SignedQuality(b, c, d, normal), SignedQuality(b, d, a, normal));
  const std::vector<int>& r = this->Ring;
  const bool avoidsFirst = this->Avoids(r[0], r[2]), avoidsSecond = this->Avoids(r[1], r[3]);
  if (avoidsFirst != avoidsSecond ? avoidsFirst : fromSecond > fromFirst + SmallestGain)
  {
    this->Add(r[0], r[1], r[3]);
    this->Add(r[1], r[2], r[3]);
  }
  else
  {
    this->Add(r[0], r[1], r[2]);
    this->Add(r[0], r[2], r[3]);
  }
}

bool PolygonCutter::Project()
{
  const int n = static_cast<int>(this->Ring.size());
  const Vector3 origin = this->Positions.row(this->Ring[0]);
  const auto at = [this, &origin](int k) -> Vector3 { return this->Positions.row(this->Ring[k]).transpose() - origin; };
  Vector3 normal = Vector3::Zero(); // Newell's
  double size = 0.0;
  for (int k = 1; k + 1 < n; ++k)
  {
    normal += at(k).cross(at(k + 1));
    size = std::max(size, at(k).squaredNorm());
  }
  if (!(normal.norm() > 1e-14 * size))
  {
    return false;
  }
  normal.normalize();
  const Vector3 x = normal.unitOrthogonal();
  const Vector3 y = normal.cross(x);
  this->Plane.resize(n);
  for (int k = 0; k < n; ++k)
  {
    this->Plane[k] = { at(k).dot(x), at(k).dot(y) };
  }
  return true;
}

double PolygonCutter::Cross(int a, int b, int c) const
{
  const Vector2 u = this->Plane[b] - this->Plane[a];
  const Vector2 v = this->Plane[c] - this->Plane[a];
  return u[0] * v[1] - u[1] * v[0];
}

int PolygonCutter::Along(int axis, double x) const
{
  const double cell = (x - this->GridOrigin[axis]) / this->GridStep[axis];
  return cell > 0.0 ? std::min(static_cast<int>(cell), this->GridSize - 1) : 0;
}

void PolygonCutter::SortReflex()
{
  constexpr int Few = 32; // that are looked at one by one
  const auto number = std::count(this->IsReflex.begin(), this->IsReflex.end(), 1);
  this->GridSize = number > Few ? static_cast<int>(std::sqrt(static_cast<double>(number))) : 1;
  this->GridOrigin = this->Plane[0];
  Vector2 largest = this->Plane[0];
  for (const Vector2& place : this->Plane)
  {
    this->GridOrigin = this->GridOrigin.cwiseMin(place);
    largest = largest.cwiseMax(place);
  }
  this->GridStep = (largest - this->GridOrigin) / this->GridSize;
  this->GridStep = (this->GridStep.array() > 0.0).select(this->GridStep, 1.0);
  this->Reflex.assign(static_cast<std::size_t>(this->GridSize) * this->GridSize, {});
  for (int k = 0; k < static_cast<int>(this->Ring.size()); ++k)
  {
    if (this->IsReflex[k])
    {
      const Vector2& place = this->Plane[k];
      this->Reflex[this->Along(0, place[0]) * this->GridSize + this->Along(1, place[1])].push_back(k);
    }
  }
}

bool PolygonCutter::HasCornerInside(int a, int b, int c) const
{
  const auto isInside = [&](int p)
  {
    const Vector2& place = this->Plane[p];
    const bool isCorner = place == this->Plane[a] || place == this->Plane[b] || place == this->Plane[c];
    return this->IsReflex[p] && !isCorner && this->Cross(a, b, p) >= 0.0 && this->Cross(b, c, p) >= 0.0 &&
      this->Cross(c, a, p) >= 0.0;
  };
  const Vector2 least = this->Plane[a].cwiseMin(this->Plane[b]).cwiseMin(this->Plane[c]);
  const Vector2 most = this->Plane[a].cwiseMax(this->Plane[b]).cwiseMax(this->Plane[c]);
  for (int x = this->Along(0, least[0]); x <= this->Along(0, most[0]); ++x)
  {
    for (int y = this->Along(1, least[1]); y <= this->Along(1, most[1]); ++y)
    {
      const std::vector<int>& cell = this->Reflex[x * this->GridSize + y];
      if (std::any_of(cell.begin(), cell.end(), isInside))
      {
        return true;
      }
    }
  }
  return false;
}

double PolygonCutter::Quality(int corner) const
{
  const int a = this->Before[corner], c = this->After[corner];
  const double area = this->Cross(a, corner, c);
  const double sides = (this->Plane[corner] - this->Plane[a]).squaredNorm() +
    (this->Plane[c] - this->Plane[corner]).squaredNorm() + (this->Plane[a] - this->Plane[c]).squaredNorm();
  const double quality = sides > 0.0 ? 2.0 * std::sqrt(3.0) * area / sides : 0.0;
  if (this->Avoids(this->Ring[a], this->Ring[c]))
  {
    return -4.0 + quality;
  }
  // Ears that are none come last, the least bad one first.
  return area > 0.0 && !this->HasCornerInside(a, corner, c) ? quality : -2.0 + quality;
}

void PolygonCutter::Rate(int corner)
{
  this->IsReflex[corner] = this->Cross(this->Before[corner], corner, this->After[corner]) <= 0.0;
  this->Ears.erase({ -this->Qualities[corner], corner });
  // Rounded, so that ears of one shape are taken in the order of the ring.
  this->Qualities[corner] = std::round(this->Quality(corner) / SmallestGain) * SmallestGain;
  this->Ears.insert({ -this->Qualities[corner], corner });
}

void PolygonCutter::RateAll()
{
  std::vector<int> left;
  for (const auto& [quality, corner] : this->Ears)
  {
    left.push_back(corner);
  }
  for (std::size_t i = 0; i < left.size(); ++i)
  {
    this->Rate(left[i]);
    if (this->Context && i % 1024 == 1023)
    {
      this->Context->Checkpoint(0.0);
    }
  }
}

void PolygonCutter::CutEars()
{
  const int n = static_cast<int>(this->Ring.size());
  const bool isFlat = n > 3 && this->Project();
  if (n == 3 || !isFlat)
  {
    for (int k = 1; k + 1 < n; ++k)
    {
      this->Add(this->Ring[0], this->Ring[k], this->Ring[k + 1]);
    }
    return;
  }
  this->After.resize(n);
  this->Before.resize(n);
  this->IsReflex.assign(n, 0);
  this->Qualities.assign(n, 0.0);
  this->Ears.clear();
  for (int k = 0; k < n; ++k)
  {
    this->After[k] = (k + 1) % n;
    this->Before[k] = (k + n - 1) % n;
  }
  for (int k = 0; k < n; ++k)
  {
    this->IsReflex[k] = this->Cross(this->Before[k], k, this->After[k]) <= 0.0;
  }
  this->SortReflex();
  for (int k = 0; k < n; ++k)
  {
    this->Ears.insert({ 0.0, k });
  }
  this->RateAll();
  int cutSince = 0; // all were rated
  for (int left = n; left > 3; --left)
  {
    // Corners that were in the way may have gone. Large polygons that cross themselves are not looked through for each ear.
    if (this->Ears.begin()->first > 0.0 && (left <= 64 || 16 * cutSince >= left))
    {
      this->RateAll();
      cutSince = 0;
    }
    ++cutSince;
    if (this->Context && left % 256 == 0)
    {
      this->Context->Checkpoint(1.0 - static_cast<double>(left) / n);
    }
    const int ear = this->Ears.begin()->second;
    const int a = this->Before[ear], c = this->After[ear];
    this->Add(this->Ring[a], this->Ring[ear], this->Ring[c]);
    this->Ears.erase(this->Ears.begin());
    this->IsReflex[ear] = 0;
    this->After[a] = c;
    this->Before[c] = a;
    this->Rate(a);
    this->Rate(c);
  }
  const int last = this->Ears.begin()->second;
  this->Add(this->Ring[this->Before[last]], this->Ring[last], this->Ring[this->After[last]]);
}

}
