#ifndef dmgSurfaceSizes_h
#define dmgSurfaceSizes_h

#include "Mesh/TriangleMesh.h"
#include "Support/Types.h"

namespace dmg
{

/// The sizes of a surface, to which lengths and weights are relative. A mesh that is a part takes those of the whole.
struct SurfaceSizes
{
  double Area = 0.0;
  double MeanFaceArea = 0.0;
  double MeanEdge = 0.0;           ///< length
  Vector3 Lower = Vector3::Zero(); ///< corner of the box around it
  Vector3 Upper = Vector3::Zero(); ///< the opposite one
  long long NumberOfVertices = 0;

  /// The length of the diagonal of the box.
  double Diagonal() const { return (this->Upper - this->Lower).norm(); }
};

/// Cost: linear.
SurfaceSizes SizesOf(const TriangleMesh& mesh);

}

#endif
