#ifndef dmgSizesOfQuads_h
#define dmgSizesOfQuads_h

#include "Mesh/FramedMesh.h"
#include "Quads/Crosses/FinerSurface.h"
#include "Quads/QuadOptions.h"
#include "Support/ExecutionContext.h"
#include "Support/Types.h"

#include <vector>

namespace dmg
{

/// The same wishes with QuadOptions::Adaptivity as a part of QuadOptions::Sizes. On each face, with k the larger of the two curvatures without their signs,
/// at the scale of quads, m its mean, and a the adaptivity, sizes are multiplied by
///
///   (1 + min(k / m, 8)^2)^(-a / 2).
///
/// They do not change where all is scaled.
/// \throw InvalidInput an option is out of range, or Sizes is neither empty nor of a positive number for each face.
/// Cost: that of FindPrincipalDirections.
QuadOptions WithSizesAlone(
  const FramedMesh& surface, const QuadOptions& options, const ElementNames& names, const ExecutionContext& context);

/// The wishes for a surface of parts: sizes and regions are those of their parents.
QuadOptions OptionsOf(const QuadOptions& options, const FinerSurface& finer);

/// Shortens lengths so that they grow along the surface by a fifth of the distance at most: faster, quads are no squares.
/// \param lengths by face.
/// Cost: O(#V log #V).
void LimitGrowth(const TriangleMesh& mesh, Vector<double>& lengths);

/// The geometric means of the faces around vertices.
std::vector<double> AtVertices(const TriangleMesh& mesh, const Vector<double>& lengths);

}

#endif
