#include "Drawing/DirectionsOnFaces.h"

#include "Operators/PowerFieldOperators.h"

#include <cmath>

namespace dmg
{

namespace
{

constexpr int Grain = 4096;

/// The N-th power of a direction, with the modulus of the direction itself.
Complex PowerOfLength(Complex direction, double length, int N)
{
  return length > 0.0 ? length * Power(direction / length, N) : Complex(0.0);
}

}

DirectionsOnFaces::DirectionsOnFaces(int N, const Vector<Complex>& first, const ExecutionContext& context)
  : Number(N)
  , Units(first.size())
  , Magnitudes(first.size())
  , FamilyCosine(std::cos(Pi / (N % 2 == 0 ? N : 2 * N)))
{
  for (int k = 0; k < N; ++k)
  {
    this->Turns[k] = std::polar(1.0, 2.0 * Pi * k / N);
  }
  context.ParallelFor(0, static_cast<int>(first.size()), Grain,
    [&](int begin, int end)
    {
      for (int face = begin; face < end; ++face)
      {
        const double magnitude = std::abs(first[face]);
        this->Magnitudes[face] = magnitude;
        this->Units[face] = magnitude > 0.0 ? first[face] / magnitude : Complex(0.0);
      }
    });
}

Vector<Complex> FirstDirectionsOfFaces(const TriangleMesh& mesh, const TangentFrames& faceFrames,
  const TangentFrames& vertexFrames, const Vector<Complex>& ofVertices, int N, const ExecutionContext& context)
{
  Vector<Complex> ofFaces(mesh.NumberOfFaces());
  context.ParallelFor(0, mesh.NumberOfFaces(), Grain,
    [&](int begin, int end)
    {
      for (int face = begin; face < end; ++face)
      {
        Complex sum = 0.0;
        Complex guide = 0.0;
        for (int k = 0; k < 3; ++k)
        {
          const int vertex = mesh.FaceCorners()(face, k);
          const Complex carried = TransportTurn(vertexFrames, vertex, faceFrames, face) * ofVertices[vertex];
          guide = guide == 0.0 ? carried : guide;
          sum += PowerOfLength(carried, std::abs(carried), N) / 3.0;
        }
        if (sum == 0.0)
        {
          ofFaces[face] = 0.0;
          continue;
        }
        const double root = std::arg(sum) / N;
        const double turns = std::round((std::arg(guide) - root) * N / (2.0 * Pi));
        ofFaces[face] = std::polar(std::abs(sum), root + 2.0 * Pi * turns / N);
      }
    });
  return ofFaces;
}

}
