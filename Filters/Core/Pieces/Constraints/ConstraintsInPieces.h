#ifndef dmgConstraintsInPieces_h
#define dmgConstraintsInPieces_h

#include "Discretisations/VertexDiscretisation.h"
#include "Pieces/Surface/PieceOfSurface.h"
#include "Places/NearestPlaces.h"
#include "ProblemConstraints.h"

#include <memory>
#include <optional>
#include <utility>

namespace dmg
{

/// The sizes of a whole surface in pieces. Collective.
SurfaceSizes SizesOf(const PieceOfSurface& piece);

/// The mean area of a vertex of the whole surface. Collective.
double MeanAreaOfVertices(const PieceOfSurface& piece, const VertexDiscretisation& fields);

/// The constraints of a problem on a surface in pieces: on own triangles, counted from 0, and at points of the piece. The problem is the
/// same on all ranks, but for Constraints and Rotation. Keeps what ConstraintsOnMesh keeps. All functions are collective.
class ConstraintsInPieces : public ProblemConstraints
{
public:
  /// \param piece is borrowed.
  explicit ConstraintsInPieces(const PieceOfSurface& piece)
    : Piece(piece)
  {
  }

protected:
  SurfaceSizes Sizes() override;
  Discretisation::IntegralWeights WeightsOfIntegral(const Discretisation& discretisation) override;
  FollowedGuides DirectionsOfGuides(const Guides& guides, const ExecutionContext& context) override;
  FollowedFeatures DirectionsOfFeatures(const FeatureOptions& options, int N, const ExecutionContext& context) override;
  void TakeOutNormalParts(std::vector<Constraint>& atVertices) override;
  void Turn(Constraints& constraints, const RotationAngles& angles, const ElementNames& names) override;
  CancellingFaces TakeOutCancelling(std::vector<Constraint>& onFaces, int N, const ElementNames& names) override;
  bool IsAnywhere(bool isHere) override { return this->Piece.Everyone().Any(isHere); }

private:
  const PrincipalCurvatures& Curvatures(double scale, const ExecutionContext& context);
  std::vector<Constraint> OnOwn(std::vector<Constraint> onMesh) const;

  const PieceOfSurface& Piece;
  std::optional<SurfaceSizes> SizesOfSurface;
  std::unique_ptr<const NearestPlaces> Places;
  std::optional<std::pair<double, PrincipalCurvatures>> CurvaturesAtScale;
};

}

#endif
