#ifndef dmgSampledLevels_h
#define dmgSampledLevels_h

#include "Levels/ProlongationOperators.h"
#include "Levels/TangentGraph.h"
#include "Mesh/TriangleMesh.h"
#include "Mesh/VertexConnection.h"
#include "Support/ExecutionContext.h"

#include <vector>

namespace dmg
{

/// The distance of samples that suits most discretisations; see SampledLevels.
constexpr double DefaultSampleDistance = 3.6;

/// The elements that the first level of samples is taken from: those that the unknowns stand on.
struct PointsToSample
{
  std::vector<int> Order; ///< [i] is the element of point i of the graph
  TangentGraph Graph;
  double LargestCurvature; ///< that a sample covers; see SamplePoints
  bool AreVertices;        ///< rather than faces
};

/// The faces of a surface, in FaceFrames.
PointsToSample FacesToSample(const TriangleMesh& mesh, const ExecutionContext& context);
/// The vertices of a surface, in VertexFrames.
PointsToSample VerticesToSample(
  const TriangleMesh& mesh, const VertexConnection& connection, const ExecutionContext& context);

/// The default levels: samples of the faces of a surface, samples of those samples, and so on down to some 1,500 (Wiersma
/// et al. 2023). They have no surfaces, so only the linear operators are there; all others stay empty. A surface with too
/// few faces has no coarse level.
/// \param distance between neighbouring samples of the first level, in spacings of the faces around them, > 1. There is
///   about one sample for distance^2 / 1.5 faces, and more of them where the surface is curved.
/// \throw InvalidInput the distance is not above 1.
/// \throw Cancelled
/// Checkpoints: a few for each level. Cost: linear.
ProlongationOperators SampledLevels(const TriangleMesh& mesh, double distance, const ExecutionContext& context);
/// Levels of any elements of the surface. \param distance in spacings of the points of the graph.
ProlongationOperators SampledLevels(
  const TriangleMesh& mesh, PointsToSample toSample, double distance, const ExecutionContext& context);

}

#endif
