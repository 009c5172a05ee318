#ifndef dmgPieceConstraints_h
#define dmgPieceConstraints_h

#include "Constraints/Constraints.h"
#include "Discretisations/DiscretisationOptions.h"
#include "Discretisations/FieldConstraints.h"
#include "Discretisations/VertexConstraints.h"
#include "Pieces/PieceOfSurface.h"

#include <vector>

namespace dmg
{

/// The constraints of all ranks at the vertices that this rank owns: directions as VertexPowerField takes them, values as
/// ScalarFunction does.
///
/// A direction on a face is given by the rank that has the face. At a point that several ranks have, each may give what its arrays
/// hold there; what the lowest of these ranks gives counts.
/// Collective. \param constraints on own triangles, counted from 0, and at points of the piece.
/// \param names how messages call those.
/// \throw InvalidInput as Discretisation::Prescribe, or a constraint is at a point without triangles.
std::vector<PowerAtVertex> ConstraintsAtOwned(const PieceOfSurface& piece, const DiscretisationOptions& field,
  const Constraints& constraints, const ElementNames& names);

/// The constraints of all vertices here, ghosts included, as a discretisation has them. Collective. \param atOwned ConstraintsAtOwned.
FieldConstraints ConstraintsAtVertices(
  const PieceOfSurface& piece, const DiscretisationOptions& field, const std::vector<PowerAtVertex>& atOwned);

}

#endif
