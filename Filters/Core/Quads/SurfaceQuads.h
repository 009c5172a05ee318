#ifndef dmgSurfaceQuads_h
#define dmgSurfaceQuads_h

#include "Mesh/FramedMesh.h"
#include "Quads/QuadMesh.h"
#include "Support/ExecutionContext.h"

namespace dmg
{

/// Makes a pure quad mesh of a bare surface: MakeQuads with the smoothest cross field of unit length, which follows the boundary, borders of regions and sharp
/// edges as far as the options align edges to these. The field is found on the surface that quads are made of (SurfaceForQuads).
/// \throw InvalidInput as MakeQuads. \throw SolverFailure as FieldSolver::Solve.
QuadMesh MakeQuadsAlongFeatures(const FramedMesh& surface, const QuadOptions& options = {},
  const ExecutionContext& context = SerialContext(), const ElementNames& names = {});

/// Makes a pure quad mesh along a field with gaps: MakeQuads with the field where it is given, and the smoothest one in between. A gap is one of the field, not
/// of the surface; drawings, which show what is known, hide it as a hole (CellsWithoutDirection).
/// \param powers as MakeQuads; 0 in gaps.
QuadMesh MakeQuadsAcrossGaps(const FramedMesh& surface, const Vector<Complex>& powers, const QuadOptions& options = {},
  const ExecutionContext& context = SerialContext(), const ElementNames& names = {});

/// The fourth power of each direction, unit; zero where there is none.
Vector<Complex> FourthPowers(const Vector<Complex>& directions);

}

#endif
