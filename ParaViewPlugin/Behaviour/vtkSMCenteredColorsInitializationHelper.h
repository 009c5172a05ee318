/**
 * @class   vtkSMCenteredColorsInitializationHelper
 * @brief   centres the colours of a stream function at zero
 *
 * The sign of a stream function matters, and zero is the longest coast. Where the XML of a filter names this class in an
 * InitializationHelper, the colours of the array StreamFunction span an interval around zero, which follows the data. Colours that
 * somebody has chosen for arrays of this name stay.
 */

#ifndef vtkSMCenteredColorsInitializationHelper_h
#define vtkSMCenteredColorsInitializationHelper_h

#include "vtkSMProxyInitializationHelper.h"

class vtkSMCenteredColorsInitializationHelper : public vtkSMProxyInitializationHelper
{
public:
  static vtkSMCenteredColorsInitializationHelper* New();
  vtkTypeMacro(vtkSMCenteredColorsInitializationHelper, vtkSMProxyInitializationHelper);

  void PostInitializeProxy(vtkSMProxy* filter, vtkPVXMLElement* hint, vtkMTimeType initialised) override;
};

#endif
