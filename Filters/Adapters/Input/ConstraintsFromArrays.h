#ifndef dmgConstraintsFromArrays_h
#define dmgConstraintsFromArrays_h

#include "Adapters/Surface/MeshFromDataSet.h"
#include "Adapters/View/ChosenArrays.h"
#include "Constraints/Constraints.h"

#include <string>

class vtkDataSet;

namespace dmg
{

/// The constraints that were chosen on a surface; the rules are those of vtkHarmonicFieldSolver.h. Cells prescribe faces and
/// points vertices; cells and points without a triangle take no part.
///
/// Directions that are not finite, zero or perpendicular to the surface are left out. Of tensors counts the direction of the
/// largest eigenvalue in the tangent plane.
///
/// Parts of vectors of cells along the normals of the cells are taken out here (WithoutNormalPartOfCell), those of points by ProblemConstraints.
///
/// \param unusable counts what is left out.
/// \return empty where nothing is chosen.
/// \throw InvalidInput as FindArrays and VisitPrescribed.
/// Cost: linear.
Constraints ConstraintsFromArrays(
  const ConstraintArrays& choices, vtkDataSet* input, const FramedSurface& surface, UnusableDirections& unusable);

/// Whether an array of directions is chosen that a dataset has.
bool HasDirections(const ConstraintArrays& choices, vtkDataSet* dataset);

/// The directions that are left out, and what helps; the tensors that are not symmetric.
std::string TextOf(const UnusableDirections& unusable);

/// Adds the rotations of an array, in degrees, if one is chosen. Elements of the other kind than the array's get the mean of
/// those that they touch.
/// \throw InvalidInput as FindArray.
void AddRotation(const ChosenArray& choice, vtkDataSet* input, const FramedSurface& surface, RotationAngles& angles);

}

#endif
