#include "Quads/MirrorPlane.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <cmath>
#include <vector>

namespace dmg
{

namespace
{

constexpr int MostSamples = 5000;
constexpr int MostSteps = 20;
/// Rounding of the axes of surfaces that are symmetric but for rounding.
constexpr double RoundingOfAxes = 1e-7;

std::vector<Vector3> SamplesOf(const TriangleMesh& mesh)
{
  const int count = std::min(MostSamples, mesh.NumberOfVertices());
  std::vector<Vector3> samples;
  for (int k = 0; k < count; ++k)
  {
    samples.push_back(mesh.Position(static_cast<int>(static_cast<long long>(k) * mesh.NumberOfVertices() / count)));
  }
  return samples;
}

double LargestDistance(const NearestPlaces& places, const std::vector<Vector3>& samples, const MirrorPlane& plane)
{
  double largest = 0.0;
  for (const Vector3& sample : samples)
  {
    largest = std::max(largest, places(plane.Mirrored(sample)).Distance);
  }
  return largest;
}

/// The centroid of the area, and the principal axes around it.
struct PrincipalAxes
{
  Vector3 Centroid = Vector3::Zero();
  Eigen::Matrix3d Axes;
};

PrincipalAxes AxesOf(const TriangleMesh& mesh)
{
  PrincipalAxes axes;
  Eigen::Matrix3d moments = Eigen::Matrix3d::Zero();
  const auto middle = [&mesh](int h)
  { return Vector3(0.5 * (mesh.Position(mesh.Tail(h)) + mesh.Position(mesh.Head(h)))); };
  double area = 0.0;
  for (int h = 0; h < 3 * mesh.NumberOfFaces(); ++h)
  {
    const double weight = mesh.FaceArea(TriangleMesh::FaceOf(h)) / 3.0;
    area += weight;
    axes.Centroid += weight * middle(h);
  }
  axes.Centroid /= area;
  // The middles of the sides of a triangle integrate squares exactly.
  for (int h = 0; h < 3 * mesh.NumberOfFaces(); ++h)
  {
    const Vector3 arm = middle(h) - axes.Centroid;
    moments += mesh.FaceArea(TriangleMesh::FaceOf(h)) / 3.0 * arm * arm.transpose();
  }
  axes.Axes = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(moments).eigenvectors();
  return axes;
}

/// The plane whose mirror images of the samples are nearest, in the mean square, to the places of the surface that are nearest to their images
/// about the former plane. About the middle of both, the sum of |p - 2 (p n) n - q|^2 is one of 4 (p n) (q n) but for a constant.
MirrorPlane Improved(const NearestPlaces& places, const std::vector<Vector3>& samples, const MirrorPlane& plane)
{
  std::vector<Vector3> nearest;
  Vector3 middle = Vector3::Zero();
  for (const Vector3& sample : samples)
  {
    nearest.push_back(places(plane.Mirrored(sample)).Position);
    middle += 0.5 * (sample + nearest.back()) / static_cast<double>(samples.size());
  }
  Eigen::Matrix3d products = Eigen::Matrix3d::Zero();
  for (std::size_t k = 0; k < samples.size(); ++k)
  {
    const Vector3 p = samples[k] - middle, q = nearest[k] - middle;
    products += p * q.transpose() + q * p.transpose();
  }
  const Vector3 normal = Eigen::SelfAdjointEigenSolver<Eigen::Matrix3d>(products).eigenvectors().col(0);
  return { middle, normal.dot(plane.Normal) < 0.0 ? Vector3(-normal) : normal };
}

/// The direction whose largest number is positive; a coordinate axis where it is one but for rounding.
Vector3 Straightened(const Vector3& normal)
{
  int largest = 0;
  normal.cwiseAbs().maxCoeff(&largest);
  const Vector3 forward = normal[largest] < 0.0 ? Vector3(-normal) : normal;
  const Vector3 axis = Vector3::Unit(largest);
  return (forward - axis).norm() <= RoundingOfAxes ? axis : forward;
}

}

double AsymmetryOf(const NearestPlaces& places, const MirrorPlane& plane)
{
  return LargestDistance(places, SamplesOf(places.Surface.Mesh), plane) / places.Sizes.Diagonal();
}

MirrorPlane FindMirrorPlane(const NearestPlaces& places)
{
  const std::vector<Vector3> samples = SamplesOf(places.Surface.Mesh);
  const PrincipalAxes axes = AxesOf(places.Surface.Mesh);
  MirrorPlane best;
  double least = std::numeric_limits<double>::infinity();
  for (int k = 0; k < 6; ++k)
  {
    MirrorPlane plane{ axes.Centroid, Straightened(k < 3 ? Vector3::Unit(k) : Vector3(axes.Axes.col(k - 3))) };
    double distance = LargestDistance(places, samples, plane);
    for (int step = 0; step < MostSteps; ++step)
    {
      MirrorPlane next = Improved(places, samples, plane);
      next.Normal = Straightened(next.Normal);
      const double nextDistance = LargestDistance(places, samples, next);
      if (!(nextDistance < 0.99 * distance))
      {
        break;
      }
      plane = next;
      distance = nextDistance;
    }
    if (distance < 0.9 * least) // of planes that are about as good, the first: a coordinate plane
    {
      least = distance;
      best = plane;
    }
  }
  return best;
}

}
