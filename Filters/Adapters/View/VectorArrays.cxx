#include "Adapters/View/VectorArrays.h"

#include "vtkDataArray.h"
#include "vtkDataSet.h"

namespace dmg
{

VectorArrays::VectorArrays(
  const VectorChoices& choices, vtkDataSet* dataset, const std::string& what, const std::string& whose)
  : Components(FindEastAndNorth(choices.Eastward, choices.Northward, choices.Axis, dataset, whose))
{
  if (!this->AreComponents())
  {
    this->Vectors = FindVectors(choices.Vectors, dataset, what, whose);
  }
}

std::vector<vtkDataArray*> VectorArrays::Arrays() const
{
  if (this->AreComponents())
  {
    return { this->Components.Eastward.Array, this->Components.Northward.Array };
  }
  return this->Vectors.Array ? std::vector<vtkDataArray*>{ this->Vectors.Array } : std::vector<vtkDataArray*>();
}

vtkIdType VectorArrays::NumberOfTuples(vtkDataSet* dataset) const
{
  return dataset->GetNumberOfElements(this->AreOnPoints() ? vtkDataObject::POINT : vtkDataObject::CELL);
}

Vector3 VectorArrays::At(vtkIdType tuple, const Vector3& place) const
{
  if (this->AreComponents())
  {
    return this->Components.At(tuple, place);
  }
  Vector3 vector = Vector3::Zero();
  this->Vectors.Array->GetTuple(tuple, vector.data());
  return vector;
}

std::string VectorArrays::ProblemOn(const Points& positions) const
{
  return this->AreComponents() ? ProblemOfComponents(positions) : ProblemOfPlaneVectors(this->Vectors.Array, positions);
}

}
