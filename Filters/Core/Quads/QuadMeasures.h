#ifndef dmgQuadMeasures_h
#define dmgQuadMeasures_h

#include "Places/NearestPlaces.h"
#include "Quads/Isolines/IndexedQuads.h"
#include "Quads/QuadMesh.h"
#include "Support/ExecutionContext.h"

namespace dmg
{

/// The surface that quads are measured on. All is borrowed.
struct MeasuredSurface
{
  const FramedMesh& Surface;
  const NearestPlaces& Places;
  const std::vector<int>& Components; ///< FaceComponents
  const Vector<double>& Lengths;      ///< by face, of edges that are aimed at
  const Vector<double>& Sizes;        ///< as QuadOptions::Sizes
  const std::vector<int>& Regions;    ///< as AlignmentOptions::Regions
};

/// Fills in the part of the report of a quad mesh that its quads tell, scaled Jacobians and the grid.
/// \param topology of the quads.
void MeasureQuads(
  const MeasuredSurface& on, const QuadTopology& topology, QuadMesh& mesh, const ExecutionContext& context);

}

#endif
