#include "Pieces/Solvers/OperatorsInPieces.h"

#include "Support/ComplexPairs.h"

namespace dmg
{

Vector<Complex> AsUnknowns(const Vector<double>& numbers, int numbersPerUnknown)
{
  return numbersPerUnknown == 1 ? Vector<Complex>(numbers.cast<Complex>()) : Vector<Complex>(AsComplex(numbers));
}

Vector<double> AsNumbers(const Vector<Complex>& unknowns, int numbersPerUnknown)
{
  return numbersPerUnknown == 1 ? Vector<double>(unknowns.real()) : Vector<double>(AsPairs(unknowns));
}

}
