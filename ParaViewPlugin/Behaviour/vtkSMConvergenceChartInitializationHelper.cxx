#include "vtkSMConvergenceChartInitializationHelper.h"

#include "ChartsOfFilter.h"

#include "vtkObjectFactory.h"
#include "vtkPVDataInformation.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMSourceProxy.h"
#include "vtkSMViewProxy.h"

#include <string>

vtkStandardNewMacro(vtkSMConvergenceChartInitializationHelper);

namespace
{
const std::string TitleBelow = "iteration";
const std::string TitleAtTheLeft = "log10 of the relative residual";

// Of 1, 2, 5, 10, 20, 50 and so on the first that makes at most ten steps.
vtkIdType StepOf(vtkIdType iterations)
{
  vtkIdType power = 1;
  while (iterations > 100 * power)
  {
    power *= 10;
  }
  for (const vtkIdType factor : { 1, 2, 5 })
  {
    if (iterations <= 10 * factor * power)
    {
      return factor * power;
    }
  }
  return 10 * power;
}

bool IsTitle(vtkSMProxy* view, const char* property, const std::string& title)
{
  const char* const text = vtkSMPropertyHelper(view, property).GetAsString();
  return (text ? text : "") == title;
}

void SetTitle(vtkSMProxy* view, const char* property, const std::string& title)
{
  if (IsTitle(view, property, ""))
  {
    vtkSMPropertyHelper(view, property).Set(title.c_str());
  }
}

void LabelAxes(vtkSMProxy* view, vtkIdType iterations)
{
  SetTitle(view, "BottomAxisTitle", TitleBelow);
  SetTitle(view, "LeftAxisTitle", TitleAtTheLeft);
  if (IsTitle(view, "BottomAxisTitle", TitleBelow))
  {
    vtkSMPropertyHelper(view, "BottomAxisUseCustomLabels").Set(1);
    vtkSMPropertyHelper labels(view, "BottomAxisLabels"); // pairs of a number and its text
    const vtkIdType step = StepOf(iterations);
    labels.SetNumberOfElements(2 * static_cast<unsigned int>(iterations / step + 1));
    unsigned int element = 0;
    for (vtkIdType iteration = 0; iteration <= iterations; iteration += step)
    {
      const std::string text = std::to_string(iteration);
      labels.Set(element++, text.c_str());
      labels.Set(element++, text.c_str());
    }
  }
  view->UpdateVTKObjects();
}

void LabelChart(vtkSMSourceProxy* filter, vtkSMProxy*, vtkSMViewProxy* chart)
{
  if (const vtkIdType rows = filter->GetDataInformation(0)->GetNumberOfRows(); rows > 0)
  {
    LabelAxes(chart, rows - 1); // the first row is iteration 0
  }
}
}

//------------------------------------------------------------------------------
void vtkSMConvergenceChartInitializationHelper::PostInitializeProxy(vtkSMProxy* filter, vtkPVXMLElement*, vtkMTimeType)
{
  AfterUpdatesOfCharts(filter, LabelChart);
}
