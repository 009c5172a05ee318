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

/// The choice of an array of a dataset: one by its name, the active one of some attribute,
/// or none.
struct ArrayChoice
{
  std::string Name;   ///< empty for none
  int Attribute = -1; ///< of vtkDataSetAttributes, where nothing is chosen by name; -1 for none
  int Association = vtkDataObject::FIELD_ASSOCIATION_POINTS;

  bool IsMade() const { return !this->Name.empty() || this->Attribute >= 0; }
  bool operator==(const ArrayChoice& other) const
  {
    return this->Name == other.Name && this->Attribute == other.Attribute && this->Association == other.Association;
  }
};

/// The choices that say what is prescribed on a dataset.
struct ConstraintChoices
{
  ArrayChoice Mask, Vectors, Weights;
  ArrayChoice Values = {};   ///< of functions, on the surface alone
  ArrayChoice Rotation = {}; ///< in degrees, on the surface alone
  /// Components of directions around Axis, in place of Vectors; on the surface alone.
  ArrayChoice Eastward = {}, Northward = {};
  Vector3 Axis = Vector3::UnitZ();
  bool WeighsTensors = false; ///< by the difference of both principal values
  ArrayChoice Source = {};    ///< of functions, on the surface alone
};

/// The choice of one index of vtkAlgorithm::SetInputArrayToProcess.
ArrayChoice ChoiceOf(vtkAlgorithm* algorithm, int index);

/// The arrays chosen with vtkAlgorithm::SetInputArrayToProcess and indices 0 (mask), 1 (vectors),
/// 2 (weights), 3 (values), 4 (rotation), 5 (eastward), 6 (northward) and 7 (source). The name "Active Vectors", of menus, chooses those of the points, else of
/// the cells.
ConstraintChoices ChoicesOf(vtkAlgorithm* algorithm);

/// The same choices of a surface that may have been through a solver before: active vectors do not count where they are
/// Direction0, its field. Nobody has asked to follow that.
ConstraintChoices WithoutFormerField(ConstraintChoices choices, vtkDataSet* surface);

/// The rule that makes a direction of an element of a dataset and its numbers in an array.
using DirectionReader = std::function<Vector3(vtkIdType element, const double* numbers)>;

/// Arrays of one dataset that prescribe directions. Without vectors nothing is prescribed.
struct ConstraintArrays
{
  vtkDataArray* Mask = nullptr;     ///< 1 component; null: where the vector and the weight are not zero
  vtkDataArray* Vectors = nullptr;  ///< 3 components, or others of which DirectionOf makes them
  vtkDataArray* Weights = nullptr;  ///< 1 component; null: 1
  bool OnPoints = false;            ///< else on cells
  vtkIdType Size = 0;               ///< points or cells
  std::string Whose;                ///< how messages call the dataset
  DirectionReader DirectionOf = {}; ///< empty: the numbers are a vector

  /// For messages, as in "point 7 of the surface".
  std::string NameOf(vtkIdType element) const;
};

/// Whether a choice is made and the dataset has such an array, whatever its form.
bool HasArray(const ArrayChoice& choice, vtkDataSet* dataset);

/// An array with a tuple for every point or cell of a dataset.
struct ChosenArray
{
  vtkDataArray* Array = nullptr;
  bool OnPoints = false; ///< else on cells
};

/// The array of a dataset that was chosen, or none. This is where its form is checked, once.
/// \param what, whose for messages, as in "mask", "the surface".
/// \throw InvalidInput it does not exist, has another number of components, or fewer tuples than
/// there are elements.
ChosenArray FindArray(
  const ArrayChoice& choice, vtkDataSet* dataset, int components, const std::string& what, const std::string& whose);

/// The same for vectors, of 3 numbers or of 2 (see ProblemOfPlaneVectors).
ChosenArray FindVectors(
  const ArrayChoice& choice, vtkDataSet* dataset, const std::string& what, const std::string& whose);

/// Vectors of 2 numbers belong to surfaces in a plane of constant z, where the third number is zero.
/// \return the words of an error where the surface is another one, else nothing.
std::string ProblemOfPlaneVectors(vtkDataArray* vectors, const Points& positions);

/// A symmetric tensor of 6 numbers (XX YY ZZ XY YZ XZ), or one of 9 by rows.
Eigen::Matrix3d TensorOf(const double* numbers, int components);
bool HoldsTensors(vtkDataArray* array);

/// The chosen arrays of a dataset.
/// \param whose how messages call the dataset, as in "the surface".
/// \param takesTensors whether directions may be tensors, or vectors of 2 numbers, as well.
/// \throw InvalidInput as FindArray; arrays that are not of the same elements; mask or weights
/// without vectors.
ConstraintArrays FindArrays(
  const ConstraintChoices& choices, vtkDataSet* dataset, const std::string& whose, bool takesTensors = false);

/// A direction that an element of a dataset prescribes.
struct ElementDirection
{
  vtkIdType Element;
  Vector3 Vector;
  double Weight;
};

/// Visits all that is prescribed, in ascending order of elements. Those whose vector, mask or weight is not a number, as where
/// nothing was measured, and those whose vector is zero although the mask is not, are passed over.
/// \param takesPart elements for which it is false are passed over, whatever they hold.
/// \return the numbers of elements that are passed over for what they hold.
/// \throw InvalidInput a weight is negative or infinite.
UnusableDirections VisitPrescribed(const ConstraintArrays& arrays, const std::function<bool(vtkIdType)>& takesPart,
  const std::function<void(const ElementDirection&)>& visit);

}

#endif
