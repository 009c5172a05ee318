/**
 * @class   vtkSMCyclicColorsInitializationHelper
 * @brief   gives angles a colour map whose ends are alike
 *
 * The array Angle of Field Angles goes from -180 / N to 180 / N degrees, which are the same angle. Where the XML of a filter names
 * this class in an InitializationHelper, the colours of that array are cyclic, and they span this interval. Colours that somebody
 * has chosen for arrays of this name stay.
 */

#ifndef vtkSMCyclicColorsInitializationHelper_h
#define vtkSMCyclicColorsInitializationHelper_h

#include "vtkSMProxyInitializationHelper.h"

class vtkSMCyclicColorsInitializationHelper : public vtkSMProxyInitializationHelper
{
public:
  static vtkSMCyclicColorsInitializationHelper* New();
  vtkTypeMacro(vtkSMCyclicColorsInitializationHelper, vtkSMProxyInitializationHelper);

  void PostInitializeProxy(vtkSMProxy* filter, vtkPVXMLElement* hint, vtkMTimeType initialised) override;
};

#endif
