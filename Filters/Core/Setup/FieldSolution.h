#ifndef dmgFieldSolution_h
#define dmgFieldSolution_h

#include "Discretisations/Discretisation.h"
#include "Solvers/Krylov/SolveReport.h"
#include "Support/Types.h"

#include <memory>

namespace dmg
{

struct SingularField;

/// The numbers that a field consists of, and their meaning.
struct FieldSolution
{
  std::shared_ptr<const dmg::Discretisation> Discretisation;
  FieldConstraints Constraints; ///< on the elements that unknowns stand on
  Vector<double> Unknowns;      ///< Discretisation::UnknownsPerElement for each element
  SolveReport Report;
  double SetupSeconds = 0.0;                       ///< of the set-up in use
  std::shared_ptr<const SingularField> Connection; ///< of prescribed singularities, or null
};

}

#endif
