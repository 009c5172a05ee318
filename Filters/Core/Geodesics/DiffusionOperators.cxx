#include "Geodesics/DiffusionOperators.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace dmg
{

namespace
{

/// \param transportOf gives r of a halfedge.
template <class Scalar, class TransportOf>
SparseMatrix<Scalar> Diffusion(
  const IntrinsicTriangulation& surface, const Vector<double>& times, const TransportOf& transportOf)
{
  const int size = surface.NumberOfVertices();
  std::vector<Eigen::Triplet<Scalar, int>> lower;
  lower.reserve(size + surface.NumberOfHalfedges());
  Vector<double> diagonal = Vector<double>::Zero(size);
  for (int h = 0; h < surface.NumberOfHalfedges(); ++h)
  {
    const int vertex = surface.Tail(h);
    diagonal[vertex] += surface.Area(h / 3) / (3.0 * times[vertex]);
  }
  VisitEdges(surface,
    [&](int h)
    {
      const int i = surface.Tail(h);
      const int j = surface.Head(h);
      const double weight = surface.Weight(h);
      const Scalar r = transportOf(h);
      if (i == j)
      {
        diagonal[i] += weight * std::norm(Scalar(1.0) - r);
        return;
      }
      diagonal[i] += weight;
      diagonal[j] += weight;
      lower.emplace_back(std::max(i, j), std::min(i, j), -weight * (j > i ? r : Eigen::numext::conj(r)));
    });
  for (int i = 0; i < size; ++i)
  {
    lower.emplace_back(i, i, Scalar(diagonal[i]));
  }
  SparseMatrix<Scalar> matrix(size, size);
  matrix.setFromTriplets(lower.begin(), lower.end());
  return matrix;
}

}

SparseMatrix<double> DiffusionOfFunctions(const IntrinsicTriangulation& surface, const Vector<double>& times)
{
  return Diffusion<double>(surface, times, [](int) { return 1.0; });
}

SparseMatrix<Complex> DiffusionOfVectors(const IntrinsicTriangulation& surface, const Vector<double>& times)
{
  return Diffusion<Complex>(surface, times, [&](int h) { return std::polar(1.0, surface.Transport(h)); });
}

Vector<Complex> SourceOfPositions(const IntrinsicTriangulation& surface, const Vector<double>& u)
{
  Vector<Complex> source = Vector<Complex>::Zero(surface.NumberOfVertices());
  VisitEdges(surface,
    [&](int h)
    {
      const int i = surface.Tail(h);
      const int j = surface.Head(h);
      const double weight = surface.Weight(h) * surface.Length(h);
      source[i] += std::polar(weight * u[j], surface.Direction(h));
      source[j] -= std::polar(weight * u[i], surface.Arrival(h));
    });
  return source;
}

}
