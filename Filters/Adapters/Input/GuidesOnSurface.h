#ifndef dmgGuidesOnSurface_h
#define dmgGuidesOnSurface_h

#include "Adapters/Input/ChosenArrays.h"
#include "Adapters/Input/SegmentOnSurface.h"
#include "Constraints/Constraints.h"

#include <string>
#include <vector>

class vtkDataObject;
class vtkFieldData;
class vtkInformationVector;
class vtkPolyData;

namespace dmg
{

/// Datasets that a field shall follow, and how they are read; the rules are those of
/// vtkHarmonicFieldSolver.h.
struct Guides
{
  std::vector<vtkDataObject*> Data; ///< datasets, or composite ones
  ConstraintChoices Choices;
  double MaximumDistance = 0.1; ///< from the surface, relative to the diagonal of its bounding box
};

/// The data of all connections of an input port.
std::vector<vtkDataObject*> DataOf(vtkInformationVector* port);

/// What became of the guides. What counts is a point or a cell with a vector, or a segment of a
/// line; a segment whose parts fare differently counts for each of them.
struct GuidesReport
{
  long long Taken = 0;          ///< prescribes some face
  long long TooFar = 0;         ///< farther from the surface than MaximumDistance
  long long OnFarSide = 0;      ///< SegmentPart::OnFarSide
  long long Perpendicular = 0;  ///< within 5 degrees of the normal of the surface
  double Farthest = 0.0;        ///< largest distance of what is taken, in the unit of the points
  double MaximumDistance = 0.0; ///< in the unit of the points

  bool IsAllTaken() const { return this->TooFar == 0 && this->OnFarSide == 0 && this->Perpendicular == 0; }
  /// What was left out, why, and what helps, in one sentence; empty where all was taken.
  std::string LeftOut() const;
};

/// What guides prescribe on the faces of a surface.
struct GuidesOnSurface
{
  std::vector<Constraint> Directions;
  GuidesReport Report;
  bool AreGiven = false; ///< some guide has points
};

/// \throw InvalidInput a guide is no dataset, or has neither lines nor vectors; a choice that no
/// guide has; as FindArray and VisitPrescribed; a point that is not finite; a vector of a point or
/// a cell that is zero in the mask; a weight that is negative or not finite.
/// \throw Cancelled
/// Checkpoints: every hundred elements. Cost: logarithmic time for each vector, each face that a line touches, and each mean edge of its length.
GuidesOnSurface BringToSurface(const Guides& guides, const NearestPlaces& surface, const ExecutionContext& context);

/// Adds the report to \p fieldData.
void AddGuidesReport(const GuidesReport& report, vtkFieldData* fieldData);

}

#endif
