#ifndef dmgCotangentLaplacian_h
#define dmgCotangentLaplacian_h

#include "Mesh/TriangleMesh.h"
#include "Support/ExecutionContext.h"
#include "Support/Types.h"

#include <vector>

namespace dmg
{

/// The stiffness matrix of functions, d0^T star1 d0 (ExteriorCalculus.h): u^T L u is the Dirichlet energy of the function that is
/// linear on the faces, with values u at the vertices. #V x #V, dimensionless, symmetric, positive semi-definite; rows sum to 0.
/// \param conductivity one per vertex, > 0: the energy counts each edge times the mean of its ends. Empty: 1.
/// Cost: O(#F).
SparseMatrix<double> CotangentLaplacian(
  const TriangleMesh& mesh, const ExecutionContext& context, const std::vector<double>& conductivity = {});

}

#endif
