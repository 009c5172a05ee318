#ifndef dmgSmoothingBlocks_h
#define dmgSmoothingBlocks_h

#include "Mesh/TriangleMesh.h"
#include "Solvers/LeastSquares/UnknownBlocks.h"

/// Unknowns of a surface that multigrid smooths together. Small blocks partition the unknowns. Where faces are far
/// from equilateral, patches of many faces are added: fields exist there that the small blocks cannot tell from
/// rough ones and coarse levels cannot represent. Patches gain iterations rather than time: see the section on
/// what each part of the solvers gains in Testing/Benchmarks/README.md.
namespace dmg
{

/// Blocks of face fields, with unknowns 2 f and 2 f + 1: fans of faces (PackFans), most of them whole stars of a vertex.
/// Cost: linear in the number of faces.
UnknownBlocks BlocksOfFaceFields(const TriangleMesh& mesh);

/// Blocks of 1-forms, with an unknown per edge: the sides of faces that have none in common (PackFaces), and what
/// these leave of others. Cost as above.
UnknownBlocks BlocksOfOneForms(const TriangleMesh& mesh);

}

#endif
