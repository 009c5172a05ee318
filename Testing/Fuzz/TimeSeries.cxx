#include "Fuzz/TimeSeries.h"

#include "vtkDataArray.h"
#include "vtkDataSetAttributes.h"
#include "vtkInformation.h"
#include "vtkInformationVector.h"
#include "vtkObjectFactory.h"
#include "vtkPointSet.h"
#include "vtkPoints.h"
#include "vtkStreamingDemandDrivenPipeline.h"

#include <algorithm>
#include <cmath>

namespace dmg::test
{

vtkStandardNewMacro(TimeSeries);

int TimeSeries::RequestInformation(
  vtkInformation* /*request*/, vtkInformationVector** /*input*/, vtkInformationVector* output)
{
  std::vector<double> times;
  for (std::size_t step = 0; step < this->Steps.size(); ++step)
  {
    times.push_back(static_cast<double>(step));
  }
  const double range[] = { times.front(), times.back() };
  vtkInformation* const information = output->GetInformationObject(0);
  information->Set(vtkStreamingDemandDrivenPipeline::TIME_STEPS(), times.data(), static_cast<int>(times.size()));
  information->Set(vtkStreamingDemandDrivenPipeline::TIME_RANGE(), range, 2);
  return 1;
}

int TimeSeries::RequestData(vtkInformation* /*request*/, vtkInformationVector** /*input*/, vtkInformationVector* output)
{
  vtkInformation* const information = output->GetInformationObject(0);
  const double time = information->Has(vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP())
    ? information->Get(vtkStreamingDemandDrivenPipeline::UPDATE_TIME_STEP())
    : 0.0;
  const auto step = std::clamp<long>(std::lround(time), 0, static_cast<long>(this->Steps.size()) - 1);
  vtkPolyData* const data = vtkPolyData::GetData(output);
  data->ShallowCopy(this->Steps[step]);
  data->GetInformation()->Set(vtkDataObject::DATA_TIME_STEP(), time);
  return 1;
}

std::map<std::string, std::string> BytesOf(vtkDataObject* data)
{
  std::map<std::string, std::string> bytes;
  const auto append = [&bytes](vtkDataArray* array, const std::string& kind)
  {
    if (array)
    {
      const auto size = static_cast<std::size_t>(array->GetNumberOfValues()) * array->GetDataTypeSize();
      const std::string name = array->GetName() ? array->GetName() : "";
      bytes[kind + name] = std::string(static_cast<const char*>(array->GetVoidPointer(0)), size);
    }
  };
  for (int kind = 0; kind < vtkDataObject::NUMBER_OF_ATTRIBUTE_TYPES; ++kind)
  {
    vtkDataSetAttributes* const attributes = data->GetAttributes(kind);
    for (int k = 0; attributes && k < attributes->GetNumberOfArrays(); ++k)
    {
      append(attributes->GetArray(k), kind == vtkDataObject::POINT ? "point array " : "cell array ");
    }
  }
  if (auto* const points = vtkPointSet::SafeDownCast(data); points && points->GetPoints())
  {
    append(points->GetPoints()->GetData(), "points ");
  }
  return bytes;
}

}
