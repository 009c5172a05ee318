#ifndef dmgSourceInPieces_h
#define dmgSourceInPieces_h

#include "Constraints/Constraints.h"
#include "Pieces/PieceComponents.h"
#include "Pieces/PieceOfSurface.h"
#include "Support/Types.h"

#include <vector>

namespace dmg
{

/// The source of a function on a surface in pieces, as ScalarFunction takes it. All functions are collective, but for IsAny and
/// IntegralsAtOwned.
class SourceInPieces
{
public:
  /// \param piece, components are borrowed.
  /// \param constraints Source, of the points of the piece; what the rank says that owns a point counts.
  /// \throw InvalidInput a number is not finite or too large, or there is not one for each point of each piece.
  SourceInPieces(const PieceOfSurface& piece, const PieceComponents& components, const Constraints& constraints,
    const ElementNames& names);

  /// Whether a rank has a source. All ranks get the same.
  bool IsAny() const { return this->IsGiven; }
  /// Per owned vertex.
  const Vector<double>& IntegralsAtOwned() const { return this->Integrals; }

  /// See FreeComponents. \param isReached by component, whether a value is held there; others are free.
  /// \throw InvalidInput it does not sum to zero on a free component, and is to be refused.
  void Balance(const std::vector<char>& isReached, NetSource net);
  /// Makes the mean of a function zero on each free component.
  void Centre(const std::vector<char>& isReached, Vector<Complex>& owned) const;

private:
  Vector<double> SumsOfComponents(const Vector<double>& owned) const;

  const PieceOfSurface& Piece;
  const PieceComponents& Components;
  bool IsGiven;
  Vector<double> Integrals;
  Vector<double> Areas; ///< a third of those of the triangles around
};

}

#endif
