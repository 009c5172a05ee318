#include "Adapters/Data/SkinOfVolume.h"

#include "Adapters/Data/NumberedCells.h"
#include "Adapters/Data/ShortArrays.h"

#include "vtkAbstractArray.h"
#include "vtkAppendFilter.h"
#include "vtkCellData.h"
#include "vtkDataObject.h"
#include "vtkDataSet.h"
#include "vtkDataSetAttributes.h"
#include "vtkDemandDrivenPipeline.h"
#include "vtkExecutive.h"
#include "vtkFieldData.h"
#include "vtkGenericCell.h"
#include "vtkGeometryFilter.h"
#include "vtkInformation.h"
#include "vtkInformationExecutivePortKey.h"
#include "vtkInformationIntegerVectorKey.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkPolyData.h"
#include "vtkSMPTools.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkUnstructuredGrid.h"

#include <algorithm>
#include <array>
#include <utility>
#include <vector>

namespace dmg
{

bool IsStructuredVolume(vtkInformation* input)
{
  vtkDataObject* const data = input->Get(vtkDataObject::DATA_OBJECT());
  if (!data || data->GetExtentType() != VTK_3D_EXTENT)
  {
    return false;
  }
  vtkExecutive* producer = nullptr;
  int port = 0;
  vtkExecutive::PRODUCER()->Get(input, producer, port);
  if (auto* const source = vtkDemandDrivenPipeline::SafeDownCast(producer))
  {
    source->UpdateInformation();
  }
  const int* const extent = input->Get(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT());
  return extent && extent[0] < extent[1] && extent[2] < extent[3] && extent[4] < extent[5];
}

namespace
{

/// Whether some cell has at least so many dimensions.
bool HasCellsOf(vtkDataSet* dataset, int dimensions)
{
  std::array<bool, 256> isSeen{}; // by type
  vtkNew<vtkGenericCell> generic;
  for (vtkIdType cell = 0; cell < dataset->GetNumberOfCells(); ++cell)
  {
    const int type = dataset->GetCellType(cell);
    if (std::exchange(isSeen.at(type), true))
    {
      continue;
    }
    generic->SetCellType(type);
    if (generic->GetCellDimension() >= dimensions)
    {
      return true;
    }
  }
  return false;
}

}

bool IsVolume(vtkDataSet* dataset)
{
  return !vtkPolyData::SafeDownCast(dataset) && HasCellsOf(dataset, 3);
}

bool HasSurface(vtkDataSet* dataset)
{
  return HasCellsOf(dataset, 2);
}

namespace
{

/// Takes the arrays out that are shorter than the elements of a volume: VTK would copy tuples that are not there.
class ShortArraysApart
{
public:
  ShortArraysApart(vtkDataSetAttributes* data, vtkIdType elements)
  {
    for (int k = data->GetNumberOfArrays() - 1; k >= 0; --k)
    {
      if (data->GetAbstractArray(k)->GetNumberOfTuples() < elements)
      {
        this->Arrays.emplace_back(data->GetAbstractArray(k));
      }
    }
    RemoveShortArrays(data, elements);
  }

  /// Adds them to the skin, where they are too short, too, so that whoever chooses one is told.
  void AddTo(vtkDataSetAttributes* data, vtkIdType elements) const
  {
    for (vtkAbstractArray* const array : this->Arrays)
    {
      const auto part = vtk::TakeSmartPointer(array->NewInstance());
      part->SetName(array->GetName());
      part->SetNumberOfComponents(array->GetNumberOfComponents());
      part->InsertTuples(0, std::min(array->GetNumberOfTuples(), std::max<vtkIdType>(elements - 1, 0)), 0, array);
      data->AddArray(part);
    }
  }

private:
  std::vector<vtkSmartPointer<vtkAbstractArray>> Arrays;
};

}

vtkSmartPointer<vtkDataSet> SkinOfVolume(vtkDataSet* dataset)
{
  const auto copy =
    vtk::TakeSmartPointer(dataset->NewInstance()); // the pipeline writes into the data what was asked for
  copy->ShallowCopy(dataset);
  const ShortArraysApart ofPoints(copy->GetPointData(), copy->GetNumberOfPoints());
  const ShortArraysApart ofCells(copy->GetCellData(), copy->GetNumberOfCells());
  vtkNew<vtkGeometryFilter> skin;
  skin->SetInputData(copy);
  // Several threads of VTK 9.1 order the cells by who comes first.
  vtkSMPTools::LocalScope(vtkSMPTools::Config{ 1, "Sequential", false }, [&skin] { skin->Update(); });
  vtkSmartPointer<vtkDataSet> result = skin->GetOutput();
  if (vtkUnstructuredGrid::SafeDownCast(dataset))
  {
    vtkNew<vtkAppendFilter> grid;
    grid->SetInputData(WithNumberedCells(result)); // a curve may have one point
    grid->Update();
    result = grid->GetOutput();
  }
  ofPoints.AddTo(result->GetPointData(), result->GetNumberOfPoints());
  ofCells.AddTo(result->GetCellData(), result->GetNumberOfCells());
  result->GetFieldData()->ShallowCopy(dataset->GetFieldData());
  return result;
}

}
