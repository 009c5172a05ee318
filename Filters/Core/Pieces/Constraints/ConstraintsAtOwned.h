#ifndef dmgConstraintsAtOwned_h
#define dmgConstraintsAtOwned_h

#include "Discretisations/VertexDiscretisation.h"
#include "Pieces/Surface/PieceOfSurface.h"

#include <vector>

namespace dmg
{

/// The constraints of all ranks at the vertices that this rank owns.
///
/// A direction on a face is given by the rank that has the face. At a point that several ranks have, each may give what its arrays
/// hold there; what the lowest of these ranks gives counts.
/// Collective. \param fields on piece.Surface().
/// \param constraints on own triangles, counted from 0, and at points of the piece.
/// \param names how messages call those.
/// \throw InvalidInput as Discretisation::Prescribe, or a constraint is at a point without triangles.
std::vector<PowerAtVertex> ConstraintsAtOwned(const PieceOfSurface& piece, const VertexDiscretisation& fields,
  const Constraints& constraints, const ElementNames& names);

/// The integrals of a function's source at the vertices that this rank owns; empty where no rank has a source. Collective.
/// \param source of the points of the piece; what the rank says that owns a point counts.
/// \throw InvalidInput as CheckSource.
Vector<double> SourceAtOwned(const PieceOfSurface& piece, const Vector<double>& source, const ElementNames& names);

}

#endif
