#ifndef dmgSubdomain_h
#define dmgSubdomain_h

#include "Support/Types.h"

#include <vector>

namespace dmg
{

/// Some unknowns of a sum of squares |B x|^2, and what B knows of them.
struct Subdomain
{
  /// \param Bt B^T, a row per unknown.
  /// \param unknowns in any order; each once.
  Subdomain(const SparseMatrix<double>& Bt, std::vector<int> unknowns);

  std::vector<int> Unknowns;    ///< ascending
  std::vector<int> Rows;        ///< of B that they touch, ascending
  SparseMatrix<double> Columns; ///< B^T there: a row per unknown, a column per row of B

  /// B^T B there, and a ridge of 1e-12, which a subdomain with a harmonic field of its own needs. Every diagonal entry
  /// is in the pattern.
  SparseMatrix<double> Matrix() const;
  long long Bytes() const;
};

}

#endif
