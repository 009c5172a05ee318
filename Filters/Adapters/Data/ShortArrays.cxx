#include "Adapters/Data/ShortArrays.h"

#include "vtkAbstractArray.h"
#include "vtkDataSetAttributes.h"

namespace dmg
{

void RemoveShortArrays(vtkDataSetAttributes* data, vtkIdType elements)
{
  for (int k = data->GetNumberOfArrays() - 1; k >= 0; --k)
  {
    if (data->GetAbstractArray(k)->GetNumberOfTuples() < elements)
    {
      data->RemoveArray(k);
    }
  }
}

}
