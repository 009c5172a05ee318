#ifndef dmgVectorArrays_h
#define dmgVectorArrays_h

#include "Adapters/View/ChosenArrays.h"
#include "Adapters/View/EastAndNorth.h"
#include "Mesh/TriangleMesh.h" // For Vector3

#include <string>
#include <vector>

class vtkDataArray;
class vtkDataSet;

namespace dmg
{

/// The choices of arrays that vectors are read from. Eastward and northward components count where the first of them is chosen.
struct VectorChoices
{
  ChosenArray Vectors;
  ChosenArray Eastward = {}, Northward = {};
  Vector3 Axis = Vector3::UnitZ(); ///< of these, from the origin to the north pole; of any length
};

/// Arrays of a dataset that vectors are read from: one of 3 numbers, or of 2 in a plane of constant z; or eastward and northward
/// components about an axis through the origin.
class VectorArrays
{
public:
  /// None.
  VectorArrays() = default;
  /// \param what, whose for messages, as in "flow", "the surface".
  /// \throw InvalidInput as FindVectors and FindEastAndNorth.
  VectorArrays(const VectorChoices& choices, vtkDataSet* dataset, const std::string& what, const std::string& whose);

  bool AreNone() const { return this->Arrays().empty(); }
  /// \pre they are not none; so all others.
  bool AreOnPoints() const { return (this->AreComponents() ? this->Components.Eastward : this->Vectors).OnPoints(); }
  /// Whether they are components, so that the surface lies around the origin, whatever its shape.
  bool AreComponents() const { return this->Components.Eastward.Array != nullptr; }
  std::vector<vtkDataArray*> Arrays() const;
  /// The points or cells of the dataset that they are of.
  vtkIdType NumberOfTuples(vtkDataSet* dataset) const;
  /// The name of the vectors, or of the eastward components.
  const std::string& Name() const
  {
    return this->AreComponents() ? this->Components.Eastward.Name : this->Vectors.Name;
  }

  /// The vector of a tuple; of components, that at a place of the surface. Several threads may call it.
  Vector3 At(vtkIdType tuple, const Vector3& place) const;
  /// Words of an error where vectors have 2 numbers and the surface is in no plane of constant z, or where they are components and it is;
  /// else nothing.
  std::string ProblemOn(const Points& positions) const;

private:
  EastAndNorth Components;
  ChosenArray Vectors; ///< none where components are chosen
};

}

#endif
