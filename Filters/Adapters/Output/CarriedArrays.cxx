#include "Adapters/Output/CarriedArrays.h"

#include "Adapters/Data/ShortArrays.h"
#include "Adapters/Pipeline/FiniteArrays.h"
#include "Adapters/View/VectorsOnSurface.h"

#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkIdList.h"
#include "vtkPointData.h"

#include <array>
#include <cmath>
#include <string>

namespace dmg
{

namespace
{

/// Whether the values of an array cannot be interpolated: integers, but for colours, and all that is no number.
bool AreLabels(vtkAbstractArray* array)
{
  auto* const numbers = vtkDataArray::SafeDownCast(array);
  const int type = array->GetDataType();
  const bool areColours = type == VTK_UNSIGNED_CHAR && array->GetNumberOfComponents() >= 3;
  return !numbers || !(type == VTK_FLOAT || type == VTK_DOUBLE || areColours);
}

bool MeansNothingElsewhere(vtkDataSetAttributes* attributes, vtkAbstractArray* array)
{
  const std::string name = array->GetName() ? array->GetName() : "";
  return array == attributes->GetGlobalIds() || name == vtkDataSetAttributes::GhostArrayName();
}

/// Adds an array, which stays active in the roles that it has.
void AddInRoles(vtkDataSetAttributes* from, vtkAbstractArray* array, vtkDataSetAttributes* to, vtkAbstractArray* added)
{
  const int index = to->AddArray(added);
  for (int role = 0; role < vtkDataSetAttributes::NUM_ATTRIBUTES; ++role)
  {
    if (from->GetAbstractAttribute(role) == array)
    {
      to->SetActiveAttribute(index, role);
    }
  }
}

void MakeUnit(vtkDataArray* vectors)
{
  for (vtkIdType tuple = 0; vectors && tuple < vectors->GetNumberOfTuples(); ++tuple)
  {
    std::array<double, 3> vector{};
    vectors->GetTuple(tuple, vector.data());
    if (const double length = std::hypot(vector[0], vector[1], vector[2]); length > 0.0)
    {
      vectors->SetTuple3(tuple, vector[0] / length, vector[1] / length, vector[2] / length);
    }
  }
}

}

CarriedPoints::CarriedPoints(const SurfaceView& view, vtkPointData* to, vtkIdType size)
  : View(view)
  , To(to)
  , OfCorners(PointsOfCorners(view.Data(), view.Mesh(), view.Relation()))
{
  vtkNew<vtkPointData> all;
  all->ShallowCopy(view.Given()->GetPointData());
  RemoveShortArrays(all, view.Given()->GetNumberOfPoints());
  for (int k = 0; k < all->GetNumberOfArrays(); ++k)
  {
    vtkAbstractArray* const array = all->GetAbstractArray(k);
    if (!MeansNothingElsewhere(all, array))
    {
      AddInRoles(all, array, AreLabels(array) ? this->GivenLabels : this->Given, array);
    }
  }
  to->CopyAllOn();
  to->InterpolateAllocate(this->Given, size);
  this->Labels->CopyAllOn();
  this->Labels->CopyAllocate(this->GivenLabels, size);
}

CarriedPoints::~CarriedPoints() = default;

void CarriedPoints::Set(vtkIdType point, const SurfacePlace& place)
{
  vtkNew<vtkIdList> corners;
  SurfacePlace weighted = place;
  for (int h = 3 * place.Face; h < 3 * place.Face + 3; ++h)
  {
    corners->InsertNextId(
      this->OfCorners.empty() ? this->View.Relation().PointOf(this->View.Mesh().Tail(h)) : this->OfCorners[h]);
  }
  this->To->InterpolatePoint(this->Given, point, corners, weighted.Weights.data());
  int nearest = 0;
  place.Weights.maxCoeff(&nearest);
  this->Labels->CopyData(this->GivenLabels, corners->GetId(nearest), point);
}

void CarriedPoints::Finish()
{
  for (int k = 0; k < this->Labels->GetNumberOfArrays(); ++k)
  {
    vtkAbstractArray* const array = this->Labels->GetAbstractArray(k);
    AddInRoles(this->Labels, array, this->To, array);
  }
  MakeUnit(this->To->GetNormals());
  AllowAnyNumber(this->To);
}

vtkSmartPointer<vtkCellData> StartCarryingCells(const SurfaceView& view, vtkCellData* to, vtkIdType size)
{
  auto given = vtkSmartPointer<vtkCellData>::New();
  given->ShallowCopy(view.Given()->GetCellData());
  RemoveShortArrays(given, view.Given()->GetNumberOfCells());
  to->CopyAllOn();
  to->CopyNormalsOff();
  to->CopyGlobalIdsOff();
  to->CopyFieldOff(vtkDataSetAttributes::GhostArrayName());
  to->CopyAllocate(given, size);
  AllowAnyNumber(to);
  return given;
}

}
