#ifndef dmgUnitLengthDiffusion_h
#define dmgUnitLengthDiffusion_h

#include "Setup/FieldOptions.h"
#include "Setup/FieldSolution.h"
#include "Setup/SetupCache.h"
#include "Solvers/Krylov/StoppingCriteria.h"
#include "Support/ExecutionContext.h"

#include <vector>

namespace dmg
{

/// Whether such fields have a length on each element: pairs of numbers have one, integrals over edges and functions have none.
bool HaveLengths(const Discretisation& discretisation);

/// Constraints by their directions alone: the parts in the tangent planes get the length 1. Directions that have none stay as they are.
Constraints AtUnitLength(Constraints constraints, const FramedMesh& surface);

/// A field that was diffused at unit length, and how its energy fell.
struct DiffusedField
{
  FieldSolution Solution;
  /// For each length of diffusion: the energy of the field at its start and after each step (UnitLengthEnergy). It never grows.
  std::vector<std::vector<double>> Energies;
};

/// The smoothest field nearby among those of unit length, from the smoothest field of any length.
///
/// A smoothest field may be short, and is, far from what it follows: its singularities meet where it is shortest, as those of z^4 do in
/// the middle of a disk whose boundary it follows. Among fields of unit length, singularities of the same sign repel each other. The
/// method diffuses the field over a short length and divides it by its own length, in turn (Merriman, Bence and Osher 1994; for crosses
/// Viertel and Osting 2019). Such a step minimises the integral of |grad X|^2 + |X - Y|^2 / length^2, where Y is the field before, divided
/// by its length. That is a preconditioned step of steepest descent of an energy (UnitLengthEnergy). Nonlinear conjugate gradients
/// (Polak and Ribiere, with restarts and a line search) go on with such steps until the energy stands still: over five steps it falls by
/// less than 1e-6 of itself. The lengths become shorter, so that singularities first move far and then find their places: from 0.32
/// down to 0.02 of the root of the area, or 1.5 edges where these are longer. Over less than edges, singularities would not get across them.
///
/// Prescribed values hold on as they did, divided by their lengths: hard ones exactly, and soft ones by their penalties.
/// \param start of the same set-up and options. \pre HaveLengths
/// \param surface of the set-up.
/// \return a field of nearly unit length, shorter around singularities; its report is that of the start with the seconds and warnings of
///   these solves.
/// \throw SolverFailure, Cancelled
/// Cost: up to five systems and about seventy solves, which take few iterations, as all elements are held.
DiffusedField DiffusedAtUnitLength(const FieldSolution& start, const PlannedSetup& setup, const FieldOptions& options,
  const TriangleMesh& surface, const StoppingCriteria& stop, const ExecutionContext& context);

}

#endif
