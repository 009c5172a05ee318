#ifndef dmgIntegerLattice_h
#define dmgIntegerLattice_h

#include "Quads/Map/IntegerTerms.h"

#include <vector>

namespace dmg
{

/// All integer vectors z that satisfy linear equations: z = B y for any integers y.
struct IntegerLattice
{
  std::vector<IntegerTerms> Rows; ///< of B: each z as a sum of the y
  int Dimension = 0;              ///< number of the y
};

/// Solves homogeneous equations over the integers by unimodular elimination (as for Hermite's normal form): an unknown whose coefficient
/// is 1 or -1 is expressed by the others; where there is none, unknowns are exchanged for y_p + q y_j, as in Euclid's algorithm, until
/// there is one. No solution is lost, and none is added: conditions as "this sum is even" are exact.
/// \param size number of the unknowns z.
/// \param equations sums that are zero.
/// Cost: that of sparse elimination.
IntegerLattice SolveOverIntegers(int size, std::vector<IntegerTerms> equations);

}

#endif
