#ifndef dmgUnitLengthDiffusion_h
#define dmgUnitLengthDiffusion_h

#include "Setup/FieldOptions.h"
#include "Setup/FieldSolution.h"
#include "Setup/SetupCache.h"
#include "Solvers/Krylov/StoppingCriteria.h"
#include "Support/ExecutionContext.h"

namespace dmg
{

/// Whether such fields have a length on each element: pairs of numbers have one, integrals over edges and functions have none.
bool HaveLengths(const Discretisation& discretisation);

/// The smoothest field nearby among those of unit length, from the smoothest field of any length.
///
/// A smoothest field may be short, and is, far from what it follows: its singularities meet where it is shortest, as those of z^4 do in
/// the middle of a disk whose boundary it follows. Among fields of unit length, singularities of the same sign repel each other. The
/// method diffuses the field for a short time and divides it by its length, in turn (Merriman, Bence and Osher 1994; for crosses
/// Viertel and Osting 2019). A step of diffusion minimises the integral of |grad X|^2 + |X - Y|^2 / length^2, where Y is the field
/// before, divided by its length. The times become shorter, so that singularities first move far and then find their places.
///
/// Prescribed values hold on as they did, divided by their lengths: hard ones exactly, and soft ones by their penalties.
/// \param start of the same set-up and options. \pre HaveLengths
/// \param area of the surface.
/// \return a field of nearly unit length, shorter around singularities; its report is that of the start with the seconds and warnings of
///   these solves.
/// \throw SolverFailure, Cancelled
/// Cost: four systems and twenty solves, which take few iterations, as all elements are held.
FieldSolution DiffusedAtUnitLength(const FieldSolution& start, const PlannedSetup& setup, const FieldOptions& options,
  double area, const StoppingCriteria& stop, const ExecutionContext& context);

}

#endif
