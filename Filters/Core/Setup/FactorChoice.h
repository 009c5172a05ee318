#ifndef dmgFactorChoice_h
#define dmgFactorChoice_h

#include "Mesh/TriangleMesh.h"
#include "Support/ExecutionContext.h"

#include <string>

/// The choice between a sparse factor of the whole system and multigrid's cycles, by the shape of the surface. Its size is
/// another matter (SolverTuning::LargestForCholesky).
///
/// Cycles slow down on thin triangles, whose smoothest fields have no place in coarse spaces and are too many for patches.
/// They also slow down on surfaces of many handles and holes, as deflation holds, and multiplies by, each harmonic field. A factor
/// (ShiftedFactor) minds neither. Testing/Benchmarks/README.md has times and memory of both.
namespace dmg
{

/// The properties of a surface that slow cycles down.
struct CycleObstacles
{
  double ShareOfThinTriangles = 0.0; ///< of the faces, those of a quality below ThinTriangleQuality
  int Loops = 0;                     ///< independent loops around handles and holes, with a harmonic field each
};

/// A triangle of a lower quality is thin; see TriangleQuality.
constexpr double ThinTriangleQuality = 0.1;
/// Cycles need few iterations up to this share, and many from twice as much on.
constexpr double LargestShareOfThinTriangles = 0.03;
/// Both ways take about the same time, or the same memory, with so many loops.
constexpr int LargestNumberOfGenerators = 40;

/// \param hasHarmonicFields whether fields without energy belong to the loops of the surface: those of 1-forms and of
///   face fields do, power fields have none; then loops do not count.
/// Cost: linear in the number of faces.
CycleObstacles ObstaclesOf(const TriangleMesh& mesh, bool hasHarmonicFields, const ExecutionContext& context);

/// For reports, the rest of a sentence; empty where a factor is not better.
std::string WhyFactorIsBetter(const CycleObstacles& obstacles);

}

#endif
