#ifndef dmgRemedy_h
#define dmgRemedy_h

#include <string>

namespace dmg
{

/// A remedy that messages of the core propose, or an option that they name. The core says it in the words of its own
/// interface. Callers whose users have other words replace these (Adapters/Pipeline/PanelWords).
enum class Remedy
{
  // Options.
  Directions,
  FeatureAngle,
  BoundaryWeight,
  SharpEdgesWeight,
  CurvatureWeight,
  SoftConstraints,
  RotationOfNothing,
  Rotation,
  MaximumDistance,
  MaximumSourceDistance,
  SmoothingLength,
  FieldAtPoints,
  Guides,
  Mask,
  NoSingularities,
  ConjugateGradients,
  Iterations,
  NoBasis,
  Lenient,
  LineSeparation,
  GlyphSeparation,
  SpreadGlyphs,
  NoNetSource,
  PrescribedValues,
  MaskOfValues,
  PowerFieldOperators,
  FaceFieldOperators,
  OneFormOperators,
  // Changes of the surface or of its arrays.
  Enlarge,
  Shrink,
  Triangulate,
  FewerTriangles,
  DropRepeatedCorner,
  DropPoint,
  DropNearPoint,
  DropUnusedPoints,
  DropTwin,
  CutApart,
  Orient,
  DropWithoutArea,
  Retriangulate,
  Rescale,
  Count ///< of these
};

/// The words of the core.
std::string TextOf(Remedy remedy);

}

#endif
