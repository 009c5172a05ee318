#ifndef dmgFactorChoice_h
#define dmgFactorChoice_h

#include "Mesh/TriangleMesh.h"
#include "Support/ExecutionContext.h"

#include <string>

/// Whether a sparse factor of the whole system is better than multigrid's cycles, by what the surface looks like.
/// Size is another matter (SolverTuning::LargestForCholesky).
///
/// Cycles slow down on thin triangles, whose smoothest fields have no place in coarse spaces and are too many for patches.
/// They also slow down on surfaces of many handles and holes, as deflation holds, and multiplies by, each harmonic field. A factor
/// (ShiftedFactor) minds neither. Testing/Benchmarks/README.md has times and memory of both.
namespace dmg
{

/// The properties of a surface that slow cycles down.
struct CycleObstacles
{
  double ShareOfNeedles = 0.0; ///< of the faces, those of a quality below NeedleQuality
  int Loops = 0;               ///< with a harmonic field each
};

/// Below it a triangle is a needle; see TriangleQuality.
constexpr double NeedleQuality = 0.1;
/// Up to so many needles cycles take at most 13 iterations; no surface that was measured lies between 0.01 and 0.07.
constexpr double LargestShareOfNeedles = 0.03;
/// With so many, both ways take about the same time, or the same memory.
constexpr int LargestNumberOfLoops = 40;

/// \param hasHarmonicFields whether fields without roughness belong to the loops of the surface: those of 1-forms and of
///   face fields do, power fields have none; then loops do not count.
/// Cost: linear in the number of faces.
CycleObstacles ObstaclesOf(const TriangleMesh& mesh, bool hasHarmonicFields, const ExecutionContext& context);

bool IsFactorBetter(const CycleObstacles& obstacles);

/// For reports, the rest of a sentence; empty where a factor is not better.
std::string WhyFactorIsBetter(const CycleObstacles& obstacles);

}

#endif
