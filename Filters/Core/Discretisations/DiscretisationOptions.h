#ifndef dmgDiscretisationOptions_h
#define dmgDiscretisationOptions_h

#include "Operators/ExteriorCalculus.h"

#include <tuple>

namespace dmg
{

/// The meaning of the unknowns of a field.
enum class DiscretisationKind
{
  /// The N-th power of N directions per face: one complex number in the face's frame. Thesis, 6.3.
  PowerField,
  /// A vector per face: two numbers in the face's frame. Thesis, 6.2.
  FaceField,
  /// A number per edge, the integral of a 1-form. Thesis, 6.1.
  OneForm,
  /// A number per vertex: a function, whose gradient is drawn.
  ScalarFunction,
  /// The N-th power of N directions per vertex: one complex number in its tangent plane. Knoeppel et al. 2013.
  VertexPowerField,
};

struct DiscretisationOptions
{
  DiscretisationKind Kind = DiscretisationKind::VertexPowerField;
  /// Power fields have N directions per point, 2 pi / N apart; 1 to 8. The others have one.
  int N = 4;
  /// The star of 0-forms: of 1-forms in their divergence, of functions in their mass.
  VertexAreas Areas = VertexAreas::MixedVoronoi;

  static DiscretisationOptions OfFunctions()
  {
    DiscretisationOptions options;
    options.Kind = DiscretisationKind::ScalarFunction;
    return options;
  }

  /// Whether a field consists of directions, which features and rotations concern; else of values.
  bool HasDirections() const { return this->Kind != DiscretisationKind::ScalarFunction; }

  int DirectionsPerPoint() const
  {
    const bool isPower =
      this->Kind == DiscretisationKind::PowerField || this->Kind == DiscretisationKind::VertexPowerField;
    return isPower ? this->N : 1;
  }

  friend bool operator==(const DiscretisationOptions& a, const DiscretisationOptions& b)
  {
    const auto members = [](const DiscretisationOptions& options)
    {
      const auto& [kind, N, areas] = options; // all of them, or it does not compile
      return std::tie(kind, N, areas);
    };
    return members(a) == members(b);
  }
};

}

#endif
