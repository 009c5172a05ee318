#ifndef dmgProblemConstraints_h
#define dmgProblemConstraints_h

#include "Directions/PrincipalDirections.h"
#include "FieldProblem.h"
#include "Mesh/FramedMesh.h"
#include "Mesh/SurfaceSizes.h"
#include "Places/NearestPlaces.h"
#include "Support/ExecutionContext.h"

#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace dmg
{

/// The constraints of a problem on a surface, and what was left out.
struct FollowedConstraints
{
  dmg::Constraints Constraints;
  GuidesReport Guides;
  std::vector<SurfaceFeature> Features; ///< that are followed
  std::vector<std::string> Warnings;
};

/// The faces on which directions cancel each other.
struct CancellingFaces
{
  long long Number = 0;
  std::string First; ///< its name
};

/// Makes constraints of the guides and features of a problem, besides those that it has. Rotates them, and takes out those that cancel
/// each other. Subclasses know the surface: as a whole, or in pieces.
class ProblemConstraints
{
public:
  virtual ~ProblemConstraints() = default;

  /// \param discretisation that problem.Options names.
  /// \param names says how messages call vertices and faces.
  /// \throw InvalidInput a guide or feature is wrong, or guides are given and none of them is near.
  FollowedConstraints Follow(const FieldProblem& problem, const Discretisation& discretisation,
    const ExecutionContext& context, const ElementNames& names);

protected:
  virtual SurfaceSizes Sizes() = 0;
  virtual Discretisation::IntegralWeights WeightsOfIntegral(const Discretisation& discretisation) = 0;
  virtual FollowedGuides DirectionsOfGuides(const Guides& guides, const ExecutionContext& context) = 0;
  virtual FollowedFeatures DirectionsOfFeatures(
    const FeatureOptions& options, int N, const ExecutionContext& context) = 0;
  /// Takes parts along normals out of directions at vertices, but for elements that are none (WithoutNormalPart).
  virtual void TakeOutNormalParts(std::vector<Constraint>& atVertices) = 0;
  virtual void Turn(Constraints& constraints, const RotationAngles& angles, const ElementNames& names) = 0;
  virtual CancellingFaces TakeOutCancelling(std::vector<Constraint>& onFaces, int N, const ElementNames& names) = 0;
  /// Whether something holds on any piece of the surface.
  virtual bool IsAnywhere(bool isHere) { return isHere; }

private:
  void AddGuides(const FieldProblem& problem, FollowedConstraints& followed, const ExecutionContext& context);
  void AddFeatures(const FieldProblem& problem, int N, FollowedConstraints& followed, const ExecutionContext& context);
  void Rotate(
    const FieldProblem& problem, bool isNothingSaid, FollowedConstraints& followed, const ElementNames& names);
};

/// Constraints on a mesh. Keeps the search for nearest places, and the principal directions of one scale.
class ConstraintsOnMesh : public ProblemConstraints
{
public:
  /// \param surface is borrowed.
  explicit ConstraintsOnMesh(const FramedMesh& surface)
    : Surface(surface)
  {
  }

  /// The search for nearest places, made at the first call.
  const NearestPlaces& Places();

protected:
  SurfaceSizes Sizes() override;
  Discretisation::IntegralWeights WeightsOfIntegral(const Discretisation& discretisation) override
  {
    return discretisation.WeightsOfIntegral();
  }
  FollowedGuides DirectionsOfGuides(const Guides& guides, const ExecutionContext& context) override;
  FollowedFeatures DirectionsOfFeatures(const FeatureOptions& options, int N, const ExecutionContext& context) override;
  void TakeOutNormalParts(std::vector<Constraint>& atVertices) override;
  void Turn(Constraints& constraints, const RotationAngles& angles, const ElementNames& names) override;
  CancellingFaces TakeOutCancelling(std::vector<Constraint>& onFaces, int N, const ElementNames& names) override;

private:
  const PrincipalCurvatures& Curvatures(double scale, const ExecutionContext& context);

  const FramedMesh& Surface;
  std::unique_ptr<NearestPlaces> PlacesOfSurface;
  std::optional<std::pair<double, PrincipalCurvatures>> CurvaturesAtScale;
};

}

#endif
