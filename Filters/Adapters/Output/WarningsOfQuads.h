#ifndef dmgWarningsOfQuads_h
#define dmgWarningsOfQuads_h

#include "Mesh/MeshChecks.h"
#include "Quads/QuadMesh.h"

#include <string>
#include <vector>

namespace dmg
{

/// The ways in which a quad mesh is other than its user asked for, with the reason and a remedy.
/// \param isFieldGiven whether the field is the user's, which is kept as it is.
/// \param names of the surface's elements.
std::vector<std::string> WarningsOf(
  const QuadMesh& mesh, const QuadOptions& options, bool isFieldGiven, const ElementNames& names);

}

#endif
