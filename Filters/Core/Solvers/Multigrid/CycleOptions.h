#ifndef dmgCycleOptions_h
#define dmgCycleOptions_h

#include "Solvers/Multigrid/Smoother.h"

namespace dmg
{

/// The precision of the numbers inside a cycle. The solvers around it work in double precision, correct its
/// rounding errors and reach any tolerance that double precision allows.
enum class CyclePrecision
{
  /// Single, unless the coarsest matrix is nearly singular (reciprocal condition below 2e-5), as under
  /// very weak constraints: rounding errors would then swamp the smoothest part of the solution. Repetitions depend on the
  /// condition of the finest matrix, which is estimated from that of the coarsest.
  Automatic,
  Single, ///< half the memory traffic
  Double,
};

struct CycleOptions
{
  SmootherOptions Smoothing;
  /// Sweeps on level 0 over sweeps on a coarse level, >= 1.
  int FinestFactor = 1;
  /// V-cycles x += s B (b - A x) that count as one; >= 1. Several replace an exact solution. Their steps s are Chebyshev's, for
  /// eigenvalues of B A from 1/2 to 1 (Saad, Iterative Methods for Sparse Linear Systems, 2003, section 12.3). A single one has
  /// a step of 1.
  int Repetitions = 1;
  CyclePrecision Precision = CyclePrecision::Automatic;
};

}

#endif
