/**
 * @class   vtkSMSpectrumChartInitializationHelper
 * @brief   a chart of spectra, by wavelength on a logarithmic axis
 *
 * A chart that shows the spectrum of a filter whose XML names this class in an InitializationHelper has the columns "... per octave" over the
 * column Wavelength, on a logarithmic axis, with titles where the view has none. The first update decides; what somebody changes then stays.
 */

#ifndef vtkSMSpectrumChartInitializationHelper_h
#define vtkSMSpectrumChartInitializationHelper_h

#include "vtkSMProxyInitializationHelper.h"

class vtkSMSpectrumChartInitializationHelper : public vtkSMProxyInitializationHelper
{
public:
  static vtkSMSpectrumChartInitializationHelper* New();
  vtkTypeMacro(vtkSMSpectrumChartInitializationHelper, vtkSMProxyInitializationHelper);

  void PostInitializeProxy(vtkSMProxy* filter, vtkPVXMLElement* hint, vtkMTimeType initialised) override;
};

#endif
