#ifndef dmgMakeDiscretisation_h
#define dmgMakeDiscretisation_h

#include "Discretisations/Discretisation.h"

#include <memory>
#include <string>
#include <vector>

namespace dmg
{

/// The only place that knows which discretisations there are.
/// \param surface is borrowed.
/// \param connection of the surface, borrowed by discretisations that need one; null: they make it.
/// \throw InvalidInput options out of range.
std::unique_ptr<const Discretisation> MakeDiscretisation(
  const DiscretisationOptions& options, const FramedMesh& surface, const VertexConnection* connection = nullptr);

/// The reason why fields of this kind are found on one process alone: a clause for a user. Empty where they are found in pieces, too
/// (Discretisation::AtVertices).
std::string ReasonForOneProcess(const DiscretisationOptions& options);

/// The options with all that this kind does not look at as they are by default: equal where the discretisations are the same.
DiscretisationOptions OptionsThatCount(const DiscretisationOptions& options);

/// The discretisation of the same directions that has its singularities at vertices, where they can be prescribed: a vertex that has
/// a direction cannot be singular.
/// \throw InvalidInput fields of this kind have no singularities: all but power fields.
DiscretisationOptions WithSingularitiesAtVertices(const DiscretisationOptions& options);

/// The names of the Values of all discretisations.
std::vector<std::string> NamesOfValues();

}

#endif
