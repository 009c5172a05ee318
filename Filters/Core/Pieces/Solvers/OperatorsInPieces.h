#ifndef dmgOperatorsInPieces_h
#define dmgOperatorsInPieces_h

#include "Pieces/Solvers/PetscMultigrid.h"
#include "Pieces/Surface/Ranks.h"
#include "Solvers/Krylov/Preconditioner.h"
#include "Support/ExecutionContext.h"
#include "Support/SumOverProcesses.h"
#include "Support/Types.h"

namespace dmg
{

inline SumOverProcesses SumOf(const Ranks& ranks)
{
  return [&ranks](double* numbers, int size) { ranks.Sum(numbers, size); };
}

/// All ranks stop as soon as one of them was asked to.
class ContextOfRanks : public PartOfContext
{
public:
  ContextOfRanks(const Ranks& ranks, const ExecutionContext& context)
    : PartOfContext(context, 0.0, 1.0)
    , All(ranks)
  {
  }
  bool IsCancelled() const override { return this->All.Any(this->PartOfContext::IsCancelled()); }

private:
  const Ranks& All;
};

/// Owned unknowns of a PetscMultigrid, complex numbers, from so many real numbers each, one or two, and back.
Vector<Complex> AsUnknowns(const Vector<double>& numbers, int numbersPerUnknown);
Vector<double> AsNumbers(const Vector<Complex>& unknowns, int numbersPerUnknown);

/// One V-cycle for R + D.
class CycleInPieces : public Preconditioner<double>
{
public:
  /// \param multigrid is borrowed.
  CycleInPieces(PetscMultigrid& multigrid, int numbersPerUnknown)
    : Multigrid(multigrid)
    , NumbersPerUnknown(numbersPerUnknown)
  {
  }

  void Apply(const Vector<double>& r, Vector<double>& z, const ExecutionContext&) override
  {
    z = AsNumbers(this->Multigrid.Precondition(AsUnknowns(r, this->NumbersPerUnknown)), this->NumbersPerUnknown);
  }

private:
  PetscMultigrid& Multigrid;
  const int NumbersPerUnknown;
};

}

#endif
