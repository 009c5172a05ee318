#include "Adapters/Ranks/DigestOfData.h"

#include "Support/Hash.h"

#include "vtkCellArray.h"
#include "vtkCharArray.h"
#include "vtkCommunicator.h"
#include "vtkCompositeDataSet.h"
#include "vtkDataArray.h"
#include "vtkDataSet.h"
#include "vtkDataSetAttributes.h"
#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkPolyData.h"
#include "vtkStringArray.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnstructuredGrid.h"

#include <functional>
#include <sstream>
#include <string_view>

namespace dmg
{

namespace
{

class Digest
{
public:
  void Add(std::string_view bytes) { this->Hash = MixHash(this->Hash, std::hash<std::string_view>()(bytes)); }
  void Add(vtkDataArray* numbers)
  {
    const std::size_t size = numbers ? numbers->GetNumberOfValues() * numbers->GetDataTypeSize() : 0;
    this->Add(size > 0 ? std::string_view(static_cast<const char*>(numbers->GetVoidPointer(0)), size) : "");
  }
  void Add(vtkCellArray* cells)
  {
    if (cells && cells->GetNumberOfCells() > 0)
    {
      this->Add(cells->GetOffsetsArray());
      this->Add(cells->GetConnectivityArray());
    }
  }
  void Add(vtkFieldData* data)
  {
    for (int k = 0; data && k < data->GetNumberOfArrays(); ++k)
    {
      vtkAbstractArray* const array = data->GetAbstractArray(k);
      this->Add(array->GetName() ? array->GetName() : "");
      this->Add(vtkDataArray::SafeDownCast(array));
      auto* const texts = vtkStringArray::SafeDownCast(array);
      for (vtkIdType each = 0; texts && each < texts->GetNumberOfValues(); ++each)
      {
        this->Add(texts->GetValue(each));
      }
    }
  }

  std::string Text() const { return std::to_string(this->Hash); }

private:
  unsigned long long Hash = 0;
};

}

std::string OutlineOf(vtkDataObject* data)
{
  std::ostringstream text;
  text.precision(17);
  if (auto* const dataset = vtkDataSet::SafeDownCast(data); dataset && dataset->GetNumberOfPoints() > 0)
  {
    text << data->GetClassName() << " " << dataset->GetNumberOfPoints() << " " << dataset->GetNumberOfCells();
    double box[6];
    dataset->GetBounds(box);
    for (const double number : box)
    {
      text << " " << number;
    }
  }
  else if (auto* const composite = vtkCompositeDataSet::SafeDownCast(data);
           composite && composite->GetNumberOfPoints() > 0)
  {
    text << data->GetClassName() << " " << composite->GetNumberOfPoints();
  }
  return text.str();
}

std::string DigestOfData(vtkDataObject* data)
{
  Digest digest;
  auto* const polyData = vtkPolyData::SafeDownCast(data);
  auto* const grid = vtkUnstructuredGrid::SafeDownCast(data);
  if (!polyData && !grid)
  {
    vtkNew<vtkCharArray> bytes;
    vtkCommunicator::MarshalDataObject(data, bytes);
    digest.Add(bytes);
    return digest.Text();
  }
  if (vtkPoints* const points = vtkPointSet::SafeDownCast(data)->GetPoints())
  {
    digest.Add(points->GetData());
  }
  if (polyData)
  {
    for (vtkCellArray* const cells :
      { polyData->GetVerts(), polyData->GetLines(), polyData->GetPolys(), polyData->GetStrips() })
    {
      digest.Add(cells);
    }
  }
  else
  {
    digest.Add(grid->GetCells());
    vtkDataSet* const dataset = grid;
    std::string types;
    for (vtkIdType cell = 0; cell < dataset->GetNumberOfCells(); ++cell)
    {
      types.push_back(static_cast<char>(dataset->GetCellType(cell)));
    }
    digest.Add(std::string_view(types));
  }
  for (int kind = 0; kind < vtkDataObject::NUMBER_OF_ATTRIBUTE_TYPES; ++kind)
  {
    digest.Add(data->GetAttributesAsFieldData(kind));
  }
  digest.Add(data->GetFieldData());
  return digest.Text();
}

}
