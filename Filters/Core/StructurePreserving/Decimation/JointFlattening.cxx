#include "StructurePreserving/Decimation/JointFlattening.h"

#include <algorithm>
#include <cmath>

namespace dmg
{

namespace
{

// A sliver would outweigh all other faces of its ring; its area counts as at least this part of its
// squared size.
constexpr double LeastRelativeArea = 1e-4;

double Cross(Complex a, Complex b)
{
  return a.real() * b.imag() - a.imag() * b.real();
}

double OrientedArea(const std::vector<Complex>& plane, const std::array<int, 3>& t)
{
  return Cross(plane[t[1]] - plane[t[0]], plane[t[2]] - plane[t[0]]);
}

}

bool JointFlattening::Flatten(const OneRing& ring, Method method)
{
  this->Positions.assign(ring.NumberOfVertices(), Complex(0.0, 0.0));
  if (method == Method::Conformal)
  {
    this->FlattenConformally(ring);
  }
  else
  {
    this->FlattenIntoCircle(ring);
  }
  return this->IsOneToOne(ring);
}

// The energy of a triangle is |sum_k W_k u_k|^2 / (4 area), W_k the side opposite corner k laid
// into a plane: zero exactly for similarities. Levy et al. 2002.
void JointFlattening::AddTriangle(const OneRing& ring, const std::array<int, 3>& corners)
{
  const Vector3 e1 = ring.Positions[corners[1]] - ring.Positions[corners[0]];
  const Vector3 e2 = ring.Positions[corners[2]] - ring.Positions[corners[0]];
  const double length = e1.norm();
  const double doubleArea = e1.cross(e2).norm();
  const double size = std::max(e1.squaredNorm(), e2.squaredNorm());
  if (size == 0.0)
  {
    return;
  }
  const Complex p1(length, 0.0);
  const Complex p2 = length > 0.0 ? Complex(e1.dot(e2), doubleArea) / length : Complex(e2.norm(), 0.0);
  const std::array<Complex, 3> w = { p2 - p1, -p2, p1 };
  const double weight = 1.0 / std::max(doubleArea, LeastRelativeArea * size);

  const int n = static_cast<int>(this->Vertex.size());
  for (int i = 0; i < 3; ++i)
  {
    const int row = this->Unknown[corners[i]];
    if (row < 0)
    {
      continue;
    }
    const Complex wi = weight * std::conj(w[i]);
    for (int j = 0; j < 3; ++j)
    {
      const int column = this->Unknown[corners[j]];
      if (column < 0)
      {
        this->Positions[corners[i]] -= wi * w[j] * this->Positions[corners[j]]; // right-hand side
      }
      else if (column <= row)
      {
        this->A[row * n + column] += wi * w[j];
      }
    }
  }
}

// Cholesky in place; the right-hand side stands in Positions.
void JointFlattening::SolveForFree()
{
  const int n = static_cast<int>(this->Vertex.size());
  Complex* const a = this->A.data();
  for (int j = 0; j < n; ++j)
  {
    double pivot = a[j * n + j].real();
    for (int k = 0; k < j; ++k)
    {
      pivot -= std::norm(a[j * n + k]);
    }
    const double inverse = pivot > 0.0 ? 1.0 / std::sqrt(pivot) : 0.0;
    a[j * n + j] = inverse;
    for (int i = j + 1; i < n; ++i)
    {
      Complex sum = a[i * n + j];
      for (int k = 0; k < j; ++k)
      {
        sum -= a[i * n + k] * std::conj(a[j * n + k]);
      }
      a[i * n + j] = sum * inverse;
    }
  }
  for (int i = 0; i < n; ++i)
  {
    Complex sum = this->Positions[this->Vertex[i]];
    for (int k = 0; k < i; ++k)
    {
      sum -= a[i * n + k] * this->Positions[this->Vertex[k]];
    }
    this->Positions[this->Vertex[i]] = sum * a[i * n + i].real();
  }
  for (int i = n - 1; i >= 0; --i)
  {
    Complex sum = this->Positions[this->Vertex[i]];
    for (int k = i + 1; k < n; ++k)
    {
      sum -= std::conj(a[k * n + i]) * this->Positions[this->Vertex[k]];
    }
    this->Positions[this->Vertex[i]] = sum * a[i * n + i].real();
  }
}

// The boundary goes onto a straight line with its lengths kept, so that the polygon is the same
// before and after the collapse.
void JointFlattening::PinBoundary(const OneRing& ring)
{
  const int last = ring.LoopSize() - 1;
  const auto length = [&](int a, int b) { return (ring.Positions[a] - ring.Positions[b]).norm(); };
  const double edge = length(ring.TargetIndex(), ring.RemovedIndex());
  this->Positions[ring.TargetIndex()] = 0.0;
  this->Positions[ring.RemovedIndex()] = edge;
  this->Positions[ring.HubIndex()] = 0.5 * edge;
  this->Positions[0] = edge + length(0, ring.RemovedIndex());
  this->Positions[last] = -length(last, ring.TargetIndex());
}

void JointFlattening::FlattenConformally(const OneRing& ring)
{
  const int numberOfVertices = ring.NumberOfVertices();
  this->Unknown.assign(numberOfVertices, 0);
  this->Unknown[ring.TargetIndex()] = -1;
  this->Unknown[ring.RemovedIndex()] = -1;
  if (ring.Kind == CollapseKind::AlongBoundary)
  {
    this->PinBoundary(ring);
    this->Unknown[ring.HubIndex()] = -1;
    this->Unknown[0] = -1;
    this->Unknown[ring.LoopSize() - 1] = -1;
  }
  else
  {
    const double edge = (ring.Positions[ring.RemovedIndex()] - ring.Positions[ring.TargetIndex()]).norm();
    this->Positions[ring.RemovedIndex()] = edge > 0.0 ? edge : 1.0;
  }
  this->Vertex.clear();
  for (int v = 0; v < numberOfVertices; ++v)
  {
    if (this->Unknown[v] >= 0)
    {
      this->Unknown[v] = static_cast<int>(this->Vertex.size());
      this->Vertex.push_back(v);
    }
  }
  this->A.assign(this->Vertex.size() * this->Vertex.size(), Complex(0.0, 0.0));

  for (int k = 0; k < ring.NumberOfSectors(); ++k)
  {
    this->AddTriangle(ring, ring.SectorBefore(k));
    this->AddTriangle(ring, ring.SectorAfter(k));
  }
  for (int d = 0; d < ring.NumberOfDead; ++d)
  {
    this->AddTriangle(ring, ring.Dead[d].Corners);
  }
  this->SolveForFree();
}

void JointFlattening::FlattenIntoCircle(const OneRing& ring)
{
  const int size = ring.LoopSize();
  if (ring.Kind == CollapseKind::AlongBoundary)
  {
    // A half circle over the boundary; the hub and both ends sit on its diameter.
    for (int k = 0; k < size; ++k)
    {
      this->Positions[k] = std::polar(1.0, Pi * k / (size - 1));
    }
    this->Positions[size - 1] = -1.0; // without rounding, so that the boundary is exactly straight
    this->Positions[ring.RemovedIndex()] = 1.0 / 3.0;
    this->Positions[ring.TargetIndex()] = -1.0 / 3.0;
    return; // and the hub at zero
  }
  const bool hubOnLoop = ring.Kind == CollapseKind::OntoBoundary;
  const int corners = size + (hubOnLoop ? 1 : 0);
  Complex mean = 0.0;
  for (int k = 0; k < size; ++k)
  {
    this->Positions[k] = std::polar(1.0, 2.0 * Pi * k / corners);
    mean += this->Positions[k];
  }
  if (hubOnLoop)
  {
    this->Positions[ring.TargetIndex()] = std::polar(1.0, 2.0 * Pi * size / corners);
    this->Positions[ring.RemovedIndex()] = 0.0; // the mean of a regular polygon
    return;
  }
  this->Positions[ring.HubIndex()] = mean / static_cast<double>(size);
  // Kept and removed at the mean of their neighbours, one of which is the other.
  std::array<Complex, 2> sum{ 0.0, 0.0 };
  std::array<double, 2> count{ 0.0, 0.0 };
  for (int k = 0; k < size; ++k)
  {
    for (int end : { 0, 1 })
    {
      const int center = end == 0 ? ring.TargetIndex() : ring.RemovedIndex();
      const int previous = k == 0 ? size - 1 : k - 1;
      if (ring.Sectors[k].CenterBefore == center || ring.Sectors[previous].CenterBefore == center)
      {
        sum[end] += this->Positions[k];
        count[end] += 1.0;
      }
    }
  }
  const double determinant = (count[0] + 1.0) * (count[1] + 1.0) - 1.0;
  this->Positions[ring.TargetIndex()] = ((count[1] + 1.0) * sum[0] + sum[1]) / determinant;
  this->Positions[ring.RemovedIndex()] = ((count[0] + 1.0) * sum[1] + sum[0]) / determinant;
}

bool JointFlattening::IsOneToOne(const OneRing& ring) const
{
  const Complex hub = this->Positions[ring.HubIndex()];
  const Complex start = this->Positions[0] - hub;
  int turns = 0;
  for (int k = 0; k < ring.NumberOfSectors(); ++k)
  {
    const int next = ring.NextOnLoop(k);
    const Complex from = this->Positions[k] - hub;
    const Complex to = this->Positions[next] - hub;
    const double area = Cross(from, to);
    if (!(area > 1e-10 * (std::norm(from) + std::norm(to))))
    {
      return false;
    }
    // Counts how often the fan passes the direction of x_0.
    const bool below = Cross(start, from) < 0.0;
    const bool above = next == 0 || !(Cross(start, to) < 0.0);
    turns += k > 0 && below && above ? 1 : 0;

    const std::array<int, 3> before = ring.SectorBefore(k);
    const Vector3& p = ring.Positions[before[0]];
    if (!(OrientedArea(this->Positions, before) > 0.0) &&
      (ring.Positions[before[1]] - p).cross(ring.Positions[before[2]] - p).squaredNorm() > 0.0)
    {
      return false;
    }
  }
  for (int d = 0; d < ring.NumberOfDead; ++d)
  {
    const std::array<int, 3>& before = ring.Dead[d].Corners;
    const Vector3& p = ring.Positions[before[0]];
    const double area = OrientedArea(this->Positions, before);
    if (!(area > 0.0) && (ring.Positions[before[1]] - p).cross(ring.Positions[before[2]] - p).squaredNorm() > 0.0)
    {
      return false;
    }
  }
  return turns == (ring.IsClosed() ? 1 : 0);
}

}
