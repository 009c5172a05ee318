#ifndef dmgScaleFilterInPieces_h
#define dmgScaleFilterInPieces_h

#include "Pieces/Surface/PieceOfSurface.h"
#include "Scales/ScaleFilter.h"
#include "Support/ExecutionContext.h"

#include <string>

namespace dmg
{

/// The reason why ScaleFilterInPieces does not take these options, as ReasonToGather of fields; empty where it takes them. It takes functions and
/// vectors by conjugate gradients, neither with fixed vertices nor at wavelengths that vary.
std::string ReasonToGather(const ScaleFilterOptions& options);

/// A ScaleFilter for a surface of which each rank has a piece: the same parts as on one process, up to the tolerance, by the same equations, and no
/// rank ever has more than its piece and the triangles around it. FindSpectra takes it, too.
///
///   const dmg::Ranks ranks(MPI_COMM_WORLD);
///   const dmg::PieceOfSurface piece(ranks, points and triangles of this rank);
///   dmg::ScaleFilter filter = dmg::ScaleFilterInPieces(piece);
///   const dmg::SplitScales eddies = filter.Split(height, 200.0);
///
/// Quantities have numbers for each vertex of piece.Surface(), of which those of owned vertices count; results are those of the whole surface at the
/// vertices of own triangles. Vectors stand in its VertexFrames. All functions of the filter are collective, those that return references
/// excepted, and all ranks give the same wavelengths and options. Ranks without triangles call them, too.
/// \param piece is borrowed.
/// \throw InvalidInput as ScaleFilter; there is a ReasonToGather; ranks differ in the options.
/// \throw SolverFailure, Cancelled on all ranks
ScaleFilter ScaleFilterInPieces(const PieceOfSurface& piece, const ScaleFilterOptions& options = {},
  const ExecutionContext& context = SerialContext());

}

#endif
