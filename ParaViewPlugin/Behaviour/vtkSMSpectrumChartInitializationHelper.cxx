#include "vtkSMSpectrumChartInitializationHelper.h"

#include "ChartsOfFilter.h"

#include "vtkObjectFactory.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMSourceProxy.h"
#include "vtkSMViewProxy.h"

#include <string>

vtkStandardNewMacro(vtkSMSpectrumChartInitializationHelper);

namespace
{
const std::string Abscissa = "Wavelength";
const std::string Shown = " per octave";

bool EndsWith(const std::string& text, const std::string& end)
{
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}

void SetTitle(vtkSMProxy* view, const char* property, const char* title)
{
  vtkSMPropertyHelper former(view, property);
  if (std::string(former.GetAsString() ? former.GetAsString() : "").empty())
  {
    former.Set(title);
  }
}

void ShowPerOctave(vtkSMSourceProxy*, vtkSMProxy* representation, vtkSMViewProxy* chart)
{
  vtkSMPropertyHelper series(representation, "SeriesVisibility", true); // pairs of a name and 0 or 1
  vtkSMPropertyHelper abscissa(representation, "XArrayName", true);
  if (series.GetNumberOfElements() == 0 || abscissa.GetAsString() == Abscissa)
  {
    return; // nothing is known of the table yet, or it has been here before
  }
  bool isSpectrum = false;
  for (unsigned int k = 0; k + 1 < series.GetNumberOfElements(); k += 2)
  {
    const bool isShown = EndsWith(series.GetAsString(k), Shown);
    series.Set(k + 1, isShown ? "1" : "0");
    isSpectrum = isSpectrum || isShown;
  }
  if (!isSpectrum)
  {
    return;
  }
  abscissa.Set(Abscissa.c_str());
  vtkSMPropertyHelper(representation, "UseIndexForXAxis").Set(0);
  representation->UpdateVTKObjects();
  vtkSMPropertyHelper(chart, "BottomAxisLogScale").Set(1);
  SetTitle(chart, "BottomAxisTitle", "wavelength");
  SetTitle(chart, "LeftAxisTitle", "mean square per octave");
  chart->UpdateVTKObjects();
}
}

//------------------------------------------------------------------------------
void vtkSMSpectrumChartInitializationHelper::PostInitializeProxy(vtkSMProxy* filter, vtkPVXMLElement*, vtkMTimeType)
{
  AfterUpdatesOfCharts(filter, ShowPerOctave);
}
