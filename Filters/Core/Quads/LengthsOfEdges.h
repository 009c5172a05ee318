#ifndef dmgLengthsOfEdges_h
#define dmgLengthsOfEdges_h

#include "Mesh/TriangleMesh.h"
#include "Quads/QuadOptions.h"
#include "Support/Types.h"

#include <vector>

namespace dmg
{

/// The lengths of edges of quads that are aimed at.
struct LengthsOfEdges
{
  double Mean = 0.0;      ///< the side of a square of the mean area
  Vector<double> OnFaces; ///< by face of the surface; shorter on components that would have hardly any quads
};

/// Lengths that give the number of quads on a flat surface. Only the ratios of sizes count, and lengths grow slowly (LimitGrowth).
/// \param components of the faces of the surface (FaceComponents).
LengthsOfEdges FindLengthsOfEdges(
  const TriangleMesh& mesh, const std::vector<int>& components, const QuadOptions& options);

/// The number of quads on each face, if it were flat.
Vector<double> ExpectedOnFaces(const TriangleMesh& mesh, const Vector<double>& lengths);

}

#endif
