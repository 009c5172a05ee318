#include "Adapters/Data/SkinOfVolume.h"

#include "vtkAppendFilter.h"
#include "vtkDataObject.h"
#include "vtkDataSet.h"
#include "vtkDemandDrivenPipeline.h"
#include "vtkExecutive.h"
#include "vtkFieldData.h"
#include "vtkGenericCell.h"
#include "vtkGeometryFilter.h"
#include "vtkInformation.h"
#include "vtkInformationExecutivePortKey.h"
#include "vtkInformationIntegerVectorKey.h"
#include "vtkNew.h"
#include "vtkPolyData.h"
#include "vtkStreamingDemandDrivenPipeline.h"
#include "vtkUnstructuredGrid.h"

#include <array>
#include <utility>

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

bool IsVolume(vtkDataSet* dataset)
{
  if (vtkPolyData::SafeDownCast(dataset))
  {
    return false;
  }
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
    if (generic->GetCellDimension() == 3)
    {
      return true;
    }
  }
  return false;
}

vtkSmartPointer<vtkDataSet> SkinOfVolume(vtkDataSet* dataset)
{
  const auto copy =
    vtk::TakeSmartPointer(dataset->NewInstance()); // the pipeline writes into the data what was asked for
  copy->ShallowCopy(dataset);
  vtkNew<vtkGeometryFilter> skin;
  skin->SetInputData(copy);
  skin->Update();
  vtkSmartPointer<vtkDataSet> result = skin->GetOutput();
  if (vtkUnstructuredGrid::SafeDownCast(dataset))
  {
    vtkNew<vtkAppendFilter> grid;
    grid->SetInputData(result);
    grid->Update();
    result = grid->GetOutput();
  }
  result->GetFieldData()->ShallowCopy(dataset->GetFieldData());
  return result;
}

}
