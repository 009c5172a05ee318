#ifndef dmgSeamlessVariables_h
#define dmgSeamlessVariables_h

#include "Quads/Crosses/AlignedEdges.h"
#include "Quads/Crosses/CrossField.h"
#include "Quads/Crosses/CutSurface.h"
#include "Quads/Map/IntegerTerms.h"
#include "Support/Types.h"

#include <vector>

namespace dmg
{

/// The unknowns of a seamless map of a surface to the plane.
///
/// Each corner of each face has coordinates w = u + i v. Across a seam of matching m, from a face f to a face g, they go on as
///
///   w_g = i^m w_f + t,   t = t_u + i t_v,
///
/// with two integers per seam. So all corners around a vertex are those of its first face, turned and moved. Singular vertices have
/// integer coordinates. An aligned edge along u has the same v at both ends, which is an integer, and the other way round. What is left
/// are real and integer unknowns r and z: coordinate c of the corner of halfedge h is row 2 h + c of Reals r + Integers z.
/// Bommes, Zimmer and Kobbelt 2009.
struct SeamlessVariables
{
  SparseMatrix<double> Reals;    ///< 6 #F x #r, at most one entry per row, 1 or -1
  SparseMatrix<double> Integers; ///< 6 #F x #z, integer entries
  std::vector<IntegerTerms>
    Conditions; ///< sums of z that are zero: maps close around vertices, and stand at one of all shifts
};

/// \param isAligned by edge.
SeamlessVariables MakeSeamlessVariables(const TriangleMesh& mesh, const SurfaceAngles& angles, const CrossField& field,
  const CutSurface& cut, const std::vector<char>& isAligned);

}

#endif
