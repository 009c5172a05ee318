#ifndef dmgSmoothingBlocks_h
#define dmgSmoothingBlocks_h

#include "Mesh/TriangleMesh.h"
#include "Solvers/SchwarzBlocks.h"

/// Unknowns of a surface that multigrid smooths together. Blocks cover all unknowns and overlap; where
/// faces are far from equilateral, patches of many faces are added. On those, fields exist that the
/// small blocks cannot tell from rough ones and coarse levels cannot represent.
namespace dmg
{

/// Of face fields, unknowns 2 f and 2 f + 1: the faces around each vertex.
UnknownBlocks BlocksOfFaceFields(const TriangleMesh& mesh);

/// Of 1-forms, an unknown per edge: the sides of each face.
UnknownBlocks BlocksOfOneForms(const TriangleMesh& mesh);

}

#endif
