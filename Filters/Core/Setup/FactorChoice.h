#ifndef dmgFactorChoice_h
#define dmgFactorChoice_h

#include "Mesh/TriangleMesh.h"
#include "Support/ExecutionContext.h"

#include <string>

/// The choice between a sparse factor of the whole system and multigrid's cycles, by the shape of the surface. Its size is
/// another matter (SolverTuning::LargestForCholesky).
///
/// Thin triangles have low-energy modes that coarse levels do not represent, so V-cycles converge slowly. On surfaces of many handles
/// and holes, deflation stores each harmonic field and multiplies by it. A factor (ShiftedFactor) depends on neither.
/// Testing/Benchmarks/README.md has times and memory of both.
namespace dmg
{

/// The properties of a surface that slow V-cycles down.
struct CycleObstacles
{
  double ShareOfThinTriangles = 0.0; ///< of the faces, those of a quality below ThinTriangleQuality
  int Loops = 0;                     ///< homology generators, with a harmonic field each
};

/// A triangle of a lower quality is thin; see TriangleQuality.
constexpr double ThinTriangleQuality = 0.1;
/// Cycles need few iterations up to this share, and many from twice as much on.
constexpr double LargestShareOfThinTriangles = 0.03;
/// The number of generators at which V-cycles and factors take about the same time, or the same memory.
constexpr int LargestNumberOfGenerators = 40;

/// \param hasHarmonicFields whether the field has a harmonic field for each generator, as 1-forms and face fields have; else generators
///   do not count.
/// Cost: linear in the number of faces.
CycleObstacles ObstaclesOf(const TriangleMesh& mesh, bool hasHarmonicFields, const ExecutionContext& context);

/// The reason as the rest of a sentence, for reports; empty where a factor is not better.
std::string WhyFactorIsBetter(const CycleObstacles& obstacles);

}

#endif
