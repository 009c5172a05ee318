#ifndef dmgFieldProblem_h
#define dmgFieldProblem_h

#include "Constraints/Constraints.h"
#include "Constraints/Guides.h"
#include "Constraints/SurfaceFeatures.h"
#include "Setup/FieldOptions.h"
#include "Singularities/PrescribedSingularities.h"
#include "Solvers/Krylov/StoppingCriteria.h"

#include <optional>
#include <vector>

namespace dmg
{

/// The field that a user wants on a surface. The default values are those of the filters, too.
///
/// Where nothing is followed, the field is the smoothest one.
struct FieldProblem
{
  /// The discretisation, the weights of energies and the solver.
  FieldOptions Options = {};
  StoppingCriteria Stop = { 1e-4, 100 };

  dmg::Constraints Constraints = {}; ///< on faces and at vertices
  /// The length over which constraints that hold nearly everywhere are smoothed, relative to the diagonal of the box around the
  /// surface: fields X minimise the integral of |grad X|^2 + |X - Y|^2 / length^2, whatever the resolution. 0: weights are as
  /// Alignment has them. Soft constraints only; without effect on guides and features.
  double SmoothingLength = 0.0;
  dmg::Guides Guides = {};      ///< lines and vectors in space
  FeatureOptions Features = {}; ///< boundary, sharp edges and principal directions; functions follow none
  RotationAngles Rotation = {}; ///< against all that is followed

  /// The singularities that a power field shall have, and no others. None: they come by themselves.
  std::optional<std::vector<PrescribedSingularity>> Singularities = {};

  /// Whether the field is the smoothest one nearby among those of unit length, in place of the smoothest one of any length: singularities
  /// keep apart rather than meet where the field is short (DiffusedAtUnitLength). Of power fields and face fields; directions
  /// are followed, whatever the lengths of prescribed vectors. Prescribed singularities leave nothing for it to do.
  bool UnitLengthWhileSmoothing = false;

  /// Whether direction 0 continues from face to face wherever that is possible, rather than being the principal root.
  bool Combing = true;
  /// Whether the field comes with a basis of the harmonic fields of its kind (Field::HarmonicBasis).
  bool HarmonicBasis = false;
  /// Whether directions are unit vectors, zero where the field vanishes, rather than as long as the field.
  bool UnitLength = true;
};

}

#endif
