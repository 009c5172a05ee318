#ifndef dmgSingularitiesOnSurface_h
#define dmgSingularitiesOnSurface_h

#include "Places/NearestPlaces.h"
#include "Singularities/PrescribedSingularities.h"

#include <string>
#include <vector>

class vtkDataObject;

namespace dmg
{

/// Datasets whose points are singularities, and how they are read; the rules are those of vtkHarmonicFieldSolver.h.
struct Singularities
{
  std::vector<vtkDataObject*> Data; ///< datasets, or composite ones
  std::string IndexArray;           ///< of their points; empty: "Index" where there is one, else 1 / N each
  double MaximumDistance = 0.1;     ///< from the surface, relative to the diagonal of its bounding box
};

/// Brings each singularity to the nearest vertex inside the surface.
/// \throw InvalidInput something is no dataset, has no such array, or an index that is no multiple of 1 / N; a point is not
///   finite, too far from the surface, or nearest to a triangle whose points are all on the boundary.
/// Cost: logarithmic time for each point.
std::vector<PrescribedSingularity> BringToSurface(
  const Singularities& singularities, int N, const NearestPlaces& surface);

}

#endif
