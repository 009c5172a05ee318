#ifndef dmgTestExamples_h
#define dmgTestExamples_h

#include "Discretisations/Constraints/FieldConstraints.h"
#include "Support/Random.h"

#include <complex>
#include <vector>

/// What the tests of the three systems prescribe.
namespace dmg::test
{

inline FieldWeights Weights(ConstraintKind kind, double smoothness = 1.0, double alignment = 1.0)
{
  return { smoothness, alignment, kind };
}

/// Directions of random length, weight and place, some of them on one face perhaps; as vectors in
/// space, for comparisons that do not depend on frames.
inline std::vector<Constraint> RandomDirections(
  const TriangleMesh& mesh, const TangentFrames& frames, int count, unsigned seed)
{
  Random random(seed);
  std::vector<Constraint> directions;
  for (int i = 0; i < count; ++i)
  {
    const int face = random.Index(mesh.NumberOfFaces());
    directions.push_back({ face, frames.ToVector(face, std::polar(random.Uniform(0.5, 2.0), random.Uniform(-3.0, 3.0))),
      random.Uniform(0.5, 2.0) });
  }
  return directions;
}

}

#endif
