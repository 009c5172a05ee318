#ifndef dmgFactorChoice_h
#define dmgFactorChoice_h

#include "Mesh/TriangleMesh.h"
#include "Support/ExecutionContext.h"

#include <string>

/// Whether a sparse factor of the whole system is better than multigrid's cycles, by what the surface looks like.
/// Size is another matter (SolverTuning::LargestForCholesky).
///
/// Cycles slow down on needles, whose smoothest fields have no place in coarse spaces and are too many for patches; and
/// with loops, as deflation holds, and multiplies by, each harmonic field. A factor (ShiftedFactor) minds neither. Seconds
/// of CPU and MB from the bare mesh, 20 prescribed, one thread, cycles / factor:
///
///   surface                   needles  loops  face fields           1-forms              power fields
///   bnd_blade_thin            24 %       1    0.5, 62 / 0.2, 90     0.5, 51 / 0.1, 34    0.04, 10 / 0.04, 20
///   genus133_cheese_thin      21 %     266    16, 2163 / 0.2, 73    12, 1920 / 0.1, 29   0.07, 25 / 0.04, 16
///   cad_cessna_11comp         16 %       0    2.0, 264 / 0.1, 57    2.5, 303 / 0.1, 23   0.07, 15 / 0.03, 12
///   cad_crank_genus12_thin    11 %      24    4.3, 469 / 0.6, 172   3.5, 422 / 0.3, 67   0.13, 22 / 0.08, 35
///   genus11_wheel_thin        12 %      22    3.8, 281 / 0.8, 245   3.2, 272 / 0.3, 95   0.21, 30 / 0.12, 50
///   cad_thin_77k              94 %      26    fails / 1.3, 476      fails / 0.5, 160     0.30, 35 / 0.15, 67
///   bnd_camelhead             1.0 %      0    0.4, 39 / 0.3, 121    0.3, 34 / 0.1, 45    0.06, 13 / 0.05, 26
///   t05_chair                 0.3 %      6    2.1, 165 / 2.0, 546   1.7, 159 / 0.6, 196  0.30, 46 / 0.35, 108
///   slab of genus 9, 29k      0         18    0.6, 69 / 0.6, 188    0.4, 54 / 0.2, 71    0.07, 15 / 0.07, 35
///   slab of genus 36, 45k     0         72    2.5, 315 / 1.0, 323   1.7, 270 / 0.3, 116  0.13, 23 / 0.12, 54
///   slab of genus 100, 58k    0        200    14, 1133 / 1.3, 440   8.4, 923 / 0.4, 155  0.17, 33 / 0.16, 70
namespace dmg
{

/// What of a surface slows cycles down.
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
