#ifndef dmgSmoothingBlocks_h
#define dmgSmoothingBlocks_h

#include "Mesh/TriangleMesh.h"
#include "Solvers/SchwarzBlocks.h"

/// Unknowns of a surface that multigrid smooths together. Small blocks part all unknowns. Where faces are far
/// from equilateral, patches of many faces are added; where these are needles and too many for patches
/// (NeedleRegions), there are no patches but overlapping subdomains of up to ten thousand unknowns or so, which are solved
/// for by sparse factors. On uneven faces, fields exist that the small blocks cannot tell from rough ones and coarse levels
/// cannot represent; along needles they have next to no energy, and reach farther than patches.
namespace dmg
{

struct SmoothingBlocks
{
  UnknownBlocks Small;      ///< and patches: for BlockSmoother
  UnknownBlocks Subdomains; ///< for SubdomainSmoother; mostly none
  UnknownBlocks Needles;    ///< for LeastEnergyRegions: needles that hang together, and one ring of faces around them
};

/// Of face fields, unknowns 2 f and 2 f + 1: fans of faces (PackFans), most of them all those around a vertex.
/// Cost: linear in the number of faces.
SmoothingBlocks BlocksOfFaceFields(const TriangleMesh& mesh);

/// Of 1-forms, an unknown per edge: the sides of faces that have none in common (PackFaces), and what
/// these leave of others. Cost as above.
SmoothingBlocks BlocksOfOneForms(const TriangleMesh& mesh);

/// Of power fields, an unknown per face, for RegionSmoother: where needles hang together, unless they are more than a
/// factor should take. No two regions share a side.
UnknownBlocks RegionsOfPowerFields(const TriangleMesh& mesh);

}

#endif
