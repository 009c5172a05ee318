#ifndef dmgProblemConstraints_h
#define dmgProblemConstraints_h

#include "Constraints/NearestPlaces.h"
#include "FieldProblem.h"
#include "Mesh/FramedMesh.h"
#include "Operators/PrincipalDirections.h"
#include "Support/ExecutionContext.h"

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace dmg
{

/// All that a field follows, brought to the surface, and what could not be followed.
struct FollowedConstraints
{
  dmg::Constraints Constraints;
  GuidesReport Guides;
  std::vector<std::string> Warnings;
};

/// Makes constraints of all that a problem says: guides and features besides the constraints it has, rotated, without those
/// that cancel each other. Keeps the search for nearest places, and the principal directions of one scale.
class ProblemConstraints
{
public:
  /// \param surface is borrowed.
  explicit ProblemConstraints(const FramedMesh& surface)
    : Surface(surface)
  {
  }

  /// \param discretisation that problem.Options names.
  /// \param names says how messages call vertices and faces.
  /// \throw InvalidInput a guide or feature is wrong, or guides are given and none of them is near.
  FollowedConstraints Follow(const FieldProblem& problem, const Discretisation& discretisation,
    const ExecutionContext& context, const ElementNames& names);

  /// The search for nearest places, made at the first call.
  const NearestPlaces& Places();

private:
  void FollowGuides(const FieldProblem& problem, FollowedConstraints& followed, const ExecutionContext& context);
  void FollowFeatures(
    const FieldProblem& problem, int N, FollowedConstraints& followed, const ExecutionContext& context);
  void Rotate(
    const FieldProblem& problem, bool isNothingSaid, FollowedConstraints& followed, const ElementNames& names) const;
  const PrincipalCurvatures& Curvatures(double scale, const ExecutionContext& context);

  const FramedMesh& Surface;
  std::unique_ptr<NearestPlaces> PlacesOfSurface;
  std::optional<std::pair<double, PrincipalCurvatures>> CurvaturesAtScale;
};

}

#endif
