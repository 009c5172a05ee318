#include "Operators/FluxAnisotropy.h"

#include "Mesh/TangentFrames.h"
#include "Operators/PowerFieldOperators.h"

#include <cmath>
#include <utility>
#include <vector>

namespace dmg
{
namespace
{

constexpr int Grain = 4096;
// Means over the three neighbours, so many times one after the other, reach some ten faces far.
constexpr int NumberOfMeans = 20;
constexpr double LargestAnisotropy = 0.2;

/// A symmetric tensor of the plane: half its trace, and the complex number whose modulus is half the difference of its eigenvalues and
/// whose argument is twice the angle of its first axis.
struct PlaneTensor
{
  double Mean = 0.0;
  Complex Deviator = 0.0;
};

using PlaneTensors = std::vector<PlaneTensor>;

/// The vector between the centroids of the faces of a halfedge and of its twin, unfolded, with the halfedge along the real axis.
Complex BetweenCentroids(const TriangleMesh& mesh, int halfedge)
{
  const Vector3 tail = mesh.Position(mesh.Tail(halfedge));
  const Vector3 along = (mesh.Position(mesh.Head(halfedge)) - tail).normalized();
  const auto centroid = [&](int h)
  {
    const Vector3 apex = mesh.Position(mesh.Tail(TriangleMesh::Previous(h))) - tail;
    const Vector3 center = (apex + mesh.Position(mesh.Head(h)) - tail + mesh.Position(mesh.Tail(h)) - tail) / 3.0;
    return Complex(center.dot(along), center.cross(along).norm());
  };
  return std::conj(centroid(mesh.Twin(halfedge))) - centroid(halfedge);
}

PlaneTensors TensorsOfFaces(const TriangleMesh& mesh, const Unfilled<Complex>& sides, const ExecutionContext& context)
{
  const Vector<double> weights = PowerEdgeWeights(mesh);
  PlaneTensors tensors(mesh.NumberOfFaces());
  context.ParallelFor(0, mesh.NumberOfFaces(), Grain,
    [&](int first, int last)
    {
      for (int h = 3 * first; h < 3 * last; ++h)
      {
        if (mesh.Twin(h) < 0)
        {
          continue;
        }
        PlaneTensor& tensor = tensors[TriangleMesh::FaceOf(h)];
        const Complex between = BetweenCentroids(mesh, h) * sides[h];
        tensor.Mean += weights[mesh.EdgeOf(h)] * std::norm(between);
        tensor.Deviator += weights[mesh.EdgeOf(h)] * between * between;
      }
    });
  return tensors;
}

/// A quarter each of a face and of its neighbours, so that nothing of the sums is lost; of a boundary side the face itself.
PlaneTensor MeanAround(const TriangleMesh& mesh, const Unfilled<Complex>& sides, const PlaneTensors& tensors, int face)
{
  PlaneTensor sum = tensors[face];
  for (int h = 3 * face; h < 3 * face + 3; ++h)
  {
    const int twin = mesh.Twin(h);
    const PlaneTensor& other = tensors[twin >= 0 ? TriangleMesh::FaceOf(twin) : face];
    const Complex turn = twin >= 0 ? TransportOfSides(sides[twin], sides[h]) : Complex(1.0);
    sum.Mean += other.Mean;
    sum.Deviator += turn * turn * other.Deviator;
  }
  return { 0.25 * sum.Mean, 0.25 * sum.Deviator };
}

}

Vector<double> FluxAnisotropy(const FramedMesh& surface, const ExecutionContext& context)
{
  const TriangleMesh& mesh = surface.Mesh;
  const Unfilled<Complex> sides = SideDirections(mesh, surface.Faces, context);
  PlaneTensors tensors = TensorsOfFaces(mesh, sides, context);
  PlaneTensors means(tensors.size());
  for (int i = 0; i < NumberOfMeans; ++i)
  {
    context.ParallelFor(0, mesh.NumberOfFaces(), Grain,
      [&](int first, int last)
      {
        for (int face = first; face < last; ++face)
        {
          means[face] = MeanAround(mesh, sides, tensors, face);
        }
      });
    std::swap(tensors, means);
  }
  Vector<double> anisotropy(mesh.NumberOfFaces());
  for (int face = 0; face < anisotropy.size(); ++face)
  {
    anisotropy[face] = tensors[face].Mean > 0.0 ? std::abs(tensors[face].Deviator) / tensors[face].Mean : 0.0;
  }
  return anisotropy;
}

double ShareOfShearedArea(const FramedMesh& surface, const ExecutionContext& context)
{
  const Vector<double> areas = surface.Mesh.FaceAreas(context);
  const Vector<double> anisotropy = FluxAnisotropy(surface, context);
  const double sheared = (anisotropy.array() > LargestAnisotropy).select(areas, 0.0).sum();
  return areas.sum() > 0.0 ? sheared / areas.sum() : 0.0;
}

}
