#include "Support/Remedy.h"

#include <array>

namespace dmg
{

std::string TextOf(Remedy remedy)
{
  // The order is that of the enumeration.
  static constexpr std::array<const char*, static_cast<std::size_t>(Remedy::Count)> Texts{
    "DiscretisationOptions::N",
    "FeatureOptions::FeatureAngle",
    "FeatureOptions::BoundaryWeight",
    "FeatureOptions::SharpEdgesWeight",
    "FeatureOptions::CurvatureWeight",
    "set FieldOptions::Constraints to Soft",
    "FieldProblem::Rotation has no effect, as the field follows nothing; add Guides or Constraints, or set it to 0",
    "FieldProblem::Rotation",
    "Guides::MaximumDistance",
    "DistanceOptions::MaximumSourceDistance",
    "FieldProblem::SmoothingLength",
    "take VertexPowerField as DiscretisationOptions::Kind",
    "FieldProblem::Guides",
    "by taking it from Constraints",
    "set DiscretisationOptions::Kind to VertexPowerField, or reset FieldProblem::Singularities",
    "set SolverOptions::Kind to ConjugateGradients",
    "StoppingCriteria::MaximumIterations",
    "reset FieldProblem::HarmonicBasis",
    "set PreparationOptions::Strict to false",
    "LineOptions::Separation",
    "GlyphPlaceOptions::Distance",
    "set GlyphPlaceOptions::Placement to EvenlySpread",
    "NetSource::TakeOut",
    "add to Constraints::Values",
    "by removing it from Constraints::Values",
    "call BuildSurfaceHierarchy with OperatorSelection::PowerFields",
    "call BuildSurfaceHierarchy with OperatorSelection::FaceFields",
    "call BuildSurfaceHierarchy with OperatorSelection::OneForms",
    "scale it up",
    "scale the whole surface down",
    "give it triangles",
    "take a surface of fewer triangles",
    "leave the face out, as PrepareSurface does",
    "leave out the face without area, as PrepareSurface does",
    "leave out the tiny face, as PrepareSurface does",
    "leave out unused points, as PrepareSurface does",
    "remove one of them, as PrepareSurface does",
    "PrepareSurface, which cuts the surface",
    "turn one of them, or let PrepareSurface turn and cut the surface",
    "remove the triangles without area",
    "triangulate its points anew",
    "by one factor for all",
  };
  return Texts[static_cast<std::size_t>(remedy)];
}

}
