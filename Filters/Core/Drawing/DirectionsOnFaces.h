#ifndef dmgDirectionsOnFaces_h
#define dmgDirectionsOnFaces_h

#include "Mesh/TangentFrames.h"
#include "Mesh/TriangleMesh.h"
#include "Support/ExecutionContext.h"
#include "Support/Types.h"

#include <array>
#include <cmath>

namespace dmg
{

/// A field of N directions, constant on each face, as it is drawn: direction k of a face is its first one, turned by
/// 2 pi k / N.
class DirectionsOnFaces
{
public:
  static constexpr int LargestN = 8;

  /// \param first direction 0 of each face in FaceFrames; its modulus is the magnitude of the field, 0 where it has
  /// no direction.
  /// \pre 1 <= N <= LargestN.
  DirectionsOnFaces(int N, const Vector<Complex>& first, const ExecutionContext& context = SerialContext());

  int N() const { return this->Number; }
  double Magnitude(int face) const { return this->Magnitudes[face]; }
  bool HasDirection(int face) const { return this->Magnitudes[face] > 0.0; }

  /// Direction 0 of all faces with its magnitude, as given.
  Vector<Complex> First() const { return this->Units.cwiseProduct(this->Magnitudes.cast<Complex>()); }
  /// Direction k, unit; zero where there is none. k in [0, N).
  Complex Direction(int face, int k) const { return this->Units[face] * this->Turns[k]; }
  /// The direction of a face at the smallest angle to a given one.
  int Nearest(int face, Complex direction) const
  {
    int nearest = 0;
    double largest = -2.0;
    for (int k = 0; k < this->Number; ++k)
    {
      const Complex candidate = this->Direction(face, k);
      const double cosine = candidate.real() * direction.real() + candidate.imag() * direction.imag();
      if (cosine > largest)
      {
        largest = cosine;
        nearest = k;
      }
    }
    return nearest;
  }

  /// Lines do not tell a direction from its opposite. Those along directions k and k + N / 2 are one family, so that
  /// an even N has N / 2 families through each point and an odd one has N.
  int NumberOfFamilies() const { return this->Number % 2 == 0 ? this->Number / 2 : this->Number; }
  int FamilyOf(int k) const { return k % this->NumberOfFamilies(); }
  /// Among the first directions of the families, the one at the smallest angle to a line without a sign.
  int NearestFamily(int face, Complex direction) const
  {
    int nearest = 0;
    double largest = -1.0;
    for (int k = 0; k < this->NumberOfFamilies(); ++k)
    {
      const Complex candidate = this->Direction(face, k);
      const double cosine = std::abs(candidate.real() * direction.real() + candidate.imag() * direction.imag());
      if (cosine > largest)
      {
        largest = cosine;
        nearest = k;
      }
    }
    return nearest;
  }
  /// Two lines at an angle with at least this cosine, whichever way they run, are of the same family: the cosine of
  /// half the angle between families.
  double CosineOfFamily() const { return this->FamilyCosine; }

private:
  int Number;
  std::array<Complex, LargestN> Turns;
  Vector<Complex> Units;
  Vector<double> Magnitudes;
  double FamilyCosine;
};

/// First directions of faces from those of vertices: the mean of the N-th powers of a face's corners, each carried
/// into its plane by the shortest rotation between normals. Of the N roots it is the one nearest to the first
/// corner that has a direction. Cost: O(#F).
Vector<Complex> FirstDirectionsOfFaces(const TriangleMesh& mesh, const TangentFrames& faceFrames,
  const TangentFrames& vertexFrames, const Vector<Complex>& ofVertices, int N,
  const ExecutionContext& context = SerialContext());

}

#endif
