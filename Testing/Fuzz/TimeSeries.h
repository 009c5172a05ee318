#ifndef dmgTimeSeries_h
#define dmgTimeSeries_h

#include "vtkPolyData.h"
#include "vtkPolyDataAlgorithm.h"
#include "vtkSmartPointer.h"

#include <map>
#include <string>
#include <vector>

namespace dmg::test
{

/// A source of datasets at the times 0, 1, 2, ... as a reader of a file has them.
class TimeSeries : public vtkPolyDataAlgorithm
{
public:
  static TimeSeries* New();
  vtkTypeMacro(TimeSeries, vtkPolyDataAlgorithm);

  std::vector<vtkSmartPointer<vtkPolyData>> Steps;

protected:
  TimeSeries() { this->SetNumberOfInputPorts(0); }

  int RequestInformation(vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output) override;
  int RequestData(vtkInformation* request, vtkInformationVector** input, vtkInformationVector* output) override;
};

/// The bytes of the points and of all arrays of points and cells, by their names.
std::map<std::string, std::string> BytesOf(vtkDataObject* data);

}

#endif
