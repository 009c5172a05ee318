#ifndef dmgSymmetricQuads_h
#define dmgSymmetricQuads_h

#include "Mesh/FramedMesh.h"
#include "Quads/MirrorPlane.h"
#include "Quads/QuadMesh.h"
#include "Support/ExecutionContext.h"

#include <memory>
#include <optional>

namespace dmg
{

/// The half of a surface that the normal of a plane points to. Faces are cut at the plane; vertices that are next to it lie in it.
/// \return faces as parts of those of the surface, and vertices near its own (FinerSurface, but for the numbers of vertices). Null where the half is no surface:
///   nothing is on that side, faces lie in the plane, or the cut touches itself.
std::shared_ptr<const FinerSurface> HalfOf(
  const FramedMesh& surface, const MirrorPlane& plane, const ExecutionContext& context = SerialContext());

/// Makes a quad mesh that is its own mirror image: one of the half that the normal of a plane points to, whose cut becomes edges of quads, and its
/// mirror image. All of the boundary becomes edges of quads, whatever the options say. Where the surface is off its mirror image by more than
/// LargestAsymmetry, or cannot be cut (HalfOf), the quads are those without symmetry, and QuadReport::IsSymmetric is false.
/// \param powers the fourth powers of a field on the surface, of which those on the half count, as MakeQuadsAcrossGaps; none: the quads follow features, as
///   MakeQuadsAlongFeatures.
/// \param plane none: FindMirrorPlane.
/// \return Finer, Map and IsCut are those of the half. The report is that of the whole, where singularities and flipped faces of the half count twice.
/// \throw as MakeQuads.
QuadMesh MakeSymmetricQuads(const FramedMesh& surface, const std::optional<Vector<Complex>>& powers,
  const std::optional<MirrorPlane>& plane, const QuadOptions& options = {},
  const ExecutionContext& context = SerialContext(), const ElementNames& names = {});

}

#endif
