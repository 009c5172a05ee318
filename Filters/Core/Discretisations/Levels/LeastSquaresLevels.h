#ifndef dmgLeastSquaresLevels_h
#define dmgLeastSquaresLevels_h

#include "Levels/TransportOperator.h"
#include "Mesh/TangentFrames.h"
#include "Mesh/TriangleMesh.h"
#include "Solvers/LeastSquares/LeastSquaresHierarchy.h"
#include "Support/ExecutionContext.h"

#include <vector>

/// The parts of the surface that multigrid needs for face fields and 1-forms: blocks of unknowns
/// (SmoothingBlocks), and coarse levels of vectors at points. The finest level takes its vectors from so
/// far up that there are six faces or more for each, if there are such levels: smoothed, its interpolation
/// reaches farther than that.
namespace dmg
{

/// \param linear see ProlongationOperators; not empty.
LeastSquaresLevels LinearLevelsOfFaceFields(
  const TriangleMesh& mesh, const std::vector<TransportOperator>& linear, const ExecutionContext& context);

/// A vector field becomes a 1-form by FormFromFaceField.
LeastSquaresLevels LinearLevelsOfOneForms(const TriangleMesh& mesh, const TangentFrames& faceFrames,
  const std::vector<TransportOperator>& linear, const ExecutionContext& context);

}

#endif
