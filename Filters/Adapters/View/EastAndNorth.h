#ifndef dmgEastAndNorth_h
#define dmgEastAndNorth_h

#include "Adapters/View/ChosenArrays.h"

namespace dmg
{

/// The eastward and northward components of vectors on a surface around the origin, as ocean and atmosphere data have them.
struct EastAndNorth
{
  ChosenArray Eastward, Northward; ///< of the same points or cells; none where none is chosen
  Vector3 Axis = Vector3::UnitZ(); ///< a unit vector, from the origin to the north pole

  /// The vector of a tuple at a place; zero on the axis, where there is no east. Several threads may call it.
  Vector3 At(vtkIdType tuple, const Vector3& place) const;
};

/// The direction of an axis, of any length. \throw InvalidInput it is zero or not finite; \p another remedy may follow.
Vector3 UnitAxis(const Vector3& axis, const std::string& another = "");

/// Eastward and northward components belong to surfaces around the origin.
/// \return the words of an error where the surface is in a plane of constant z, else nothing.
std::string ProblemOfComponents(const Points& positions);

/// \param axis of any length.
/// \throw InvalidInput as FindArray and UnitAxis; one of both is chosen, or they are not both on points or on cells.
EastAndNorth FindEastAndNorth(const ChosenArray& eastward, const ChosenArray& northward, const Vector3& axis,
  vtkDataSet* dataset, const std::string& whose);

}

#endif
