#ifndef dmgTransportOperator_h
#define dmgTransportOperator_h

#include "Support/ExecutionContext.h"
#include "Support/Types.h"

#include <vector>

namespace dmg
{

/// A sparse operator between tangent spaces: entry (i, j) carries a direction from the frame of
/// element j into the frame of element i, weighting it by |entry| and turning it by arg(entry). The
/// weights of a row sum to 1.
///
/// One such operator serves every N: N-power fields are turned N times as far, with the same
/// weight.
using TransportOperator = SparseMatrix<Complex>;

/// The operator on N-power fields: each entry z becomes |z| (z / |z|)^N. \pre N >= 1
SparseMatrix<Complex> OnPowers(
  const TransportOperator& transport, int N, const ExecutionContext& context = SerialContext());

/// The same of several operators.
std::vector<SparseMatrix<Complex>> OnPowers(
  const std::vector<TransportOperator>& transports, int N, const ExecutionContext& context);

/// The components of what the operator makes of vectors: rows (2 i, 2 i + 1) hold the vectors whose
/// products with the coarse ones sum up to the two components; see PlanarProlongation.
SparseMatrix<Complex> RowsOfComponents(
  const TransportOperator& transport, const ExecutionContext& context = SerialContext());

/// The operator on vectors, each a pair of components (2 i, 2 i + 1): entries become 2 x 2 blocks.
SparseMatrix<double> OnComponents(
  const TransportOperator& transport, const ExecutionContext& context = SerialContext());

/// The same of several operators.
std::vector<SparseMatrix<double>> OnComponents(
  const std::vector<TransportOperator>& transports, const ExecutionContext& context);

}

#endif
