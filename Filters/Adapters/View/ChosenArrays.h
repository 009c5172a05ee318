#ifndef dmgChosenArrays_h
#define dmgChosenArrays_h

#include "Constraints/Constraints.h"
#include "Mesh/TriangleMesh.h" // For Vector3

#include "vtkDataObject.h"

#include <functional>
#include <string>

class vtkAlgorithm;
class vtkDataArray;
class vtkDataSet;

namespace dmg
{

/// An array of a dataset that is chosen by its name, or as the active one of some attribute; or none.
struct ChosenArray
{
  std::string Name;   ///< empty for none
  int Attribute = -1; ///< of vtkDataSetAttributes, where nothing is chosen by name; -1 for none
  int Association = vtkDataObject::FIELD_ASSOCIATION_POINTS;
  vtkDataArray* Array = nullptr; ///< in a dataset; null before FindArray, and where there is none

  bool IsMade() const { return !this->Name.empty() || this->Attribute >= 0; }
  bool IsSameChoiceAs(const ChosenArray& other) const
  {
    return this->Name == other.Name && this->Attribute == other.Attribute && this->Association == other.Association;
  }

  /// \pre Array is found. \return false: it is on cells.
  bool OnPoints() const { return this->Association == vtkDataObject::FIELD_ASSOCIATION_POINTS; }
};

/// The arrays that prescribe constraints on a dataset. Without vectors, components or values nothing is prescribed.
struct ConstraintArrays
{
  ChosenArray Mask;    ///< 1 component; none: where the vector and the weight are not zero
  ChosenArray Vectors; ///< 3 components, or others of which a DirectionReader makes them
  ChosenArray Weights; ///< 1 component; none: 1
  // On the surface alone:
  ChosenArray Values = {};                   ///< of functions
  ChosenArray Rotation = {};                 ///< in degrees
  ChosenArray Eastward = {}, Northward = {}; ///< components of directions around Axis, in place of Vectors
  Vector3 Axis = Vector3::UnitZ();
  bool WeighsTensors = false; ///< by the difference of both principal values
  ChosenArray Source = {};    ///< of functions
};

/// The choice of one index of vtkAlgorithm::SetInputArrayToProcess. "Active Vectors", of menus, are those of the points, else of the
/// cells.
ChosenArray ChoiceOf(vtkAlgorithm* algorithm, int index);

/// The choices of indices 0 (mask), 1 (vectors), 2 (weights), 3 (values), 4 (rotation), 5 (eastward), 6 (northward) and 7 (source).
ConstraintArrays ChoicesOf(vtkAlgorithm* algorithm);

/// Choices of a surface that may have been through a solver before: active vectors do not count where they are Direction0, its
/// field. Nobody has asked to follow that.
ConstraintArrays WithoutFormerField(ConstraintArrays choices, vtkDataSet* surface);

/// Whether a choice is made and the dataset has such an array, whatever its form.
bool HasArray(const ChosenArray& choice, vtkDataSet* dataset);

/// The array of a dataset that was chosen, or none. Its form is checked here, once.
/// \param what, whose for messages, as in "mask", "the surface".
/// \throw InvalidInput it does not exist, has another number of components, or fewer tuples than
/// there are elements.
ChosenArray FindArray(
  const ChosenArray& choice, vtkDataSet* dataset, int components, const std::string& what, const std::string& whose);

/// The number of components of the array of numbers that was chosen; 0 where there is none.
int ComponentsOf(const ChosenArray& choice, vtkDataSet* dataset);

/// FindArray of vectors of 3 numbers, or of 2 (see ProblemOfPlaneVectors).
ChosenArray FindVectors(
  const ChosenArray& choice, vtkDataSet* dataset, const std::string& what, const std::string& whose);

/// Vectors of 2 numbers, and tensors of 4, belong to surfaces in a plane of constant z, where the other numbers are zero.
/// \return the words of an error where the surface is another one, else nothing.
std::string ProblemOfPlaneVectors(vtkDataArray* vectors, const Points& positions);

/// A tensor: one of a plane of 4 numbers (XX XY YX YY), a symmetric one of 6 (XX YY ZZ XY YZ XZ), or one of 9 by rows.
Eigen::Matrix3d TensorOf(const double* numbers, int components);
bool HoldsTensors(vtkDataArray* array);

/// The mask, vectors and weights of a dataset. Eastward components come as vectors of 1 number, and northward ones beside them.
/// \param whose how messages call the dataset, as in "the surface".
/// \param takesTensors whether directions may be tensors, vectors of 2 numbers, or components as well.
/// \throw InvalidInput as FindArray; arrays that are not of the same elements; mask or weights
/// without vectors.
ConstraintArrays FindArrays(
  const ConstraintArrays& choices, vtkDataSet* dataset, const std::string& whose, bool takesTensors = false);

/// The rule that makes a direction of an element of a dataset and its numbers in an array; empty: the numbers are a vector.
using DirectionReader = std::function<Vector3(vtkIdType element, const double* numbers)>;

/// A direction that an element of a dataset prescribes.
struct ElementDirection
{
  vtkIdType Element;
  Vector3 Vector;
  double Weight;
};

/// Visits all that is prescribed, in ascending order of elements. Those whose vector, mask or weight is not a number, as where
/// nothing was measured, and those whose vector is zero although the mask is not, are passed over.
/// \param arrays found by FindArrays. \param whose the name of the dataset in messages.
/// \param takesPart elements for which it is false are passed over, whatever they hold.
/// \return how many elements are skipped for their values, and what is reported of fill values.
/// \throw InvalidInput a weight is negative or infinite; as SuspectedFillValues, of the vectors that are visited.
UnusableDirections VisitPrescribed(const ConstraintArrays& arrays, vtkDataSet* dataset, const std::string& whose,
  const DirectionReader& directionOf, const std::function<bool(vtkIdType)>& takesPart,
  const std::function<void(const ElementDirection&)>& visit);

}

#endif
