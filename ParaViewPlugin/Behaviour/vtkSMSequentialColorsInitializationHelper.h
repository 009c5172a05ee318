/**
 * @class   vtkSMSequentialColorsInitializationHelper
 * @brief   gives distances a colour map that goes one way
 *
 * ParaView's default colours diverge from a middle that distances do not have. Where the XML of a filter names this class in an
 * InitializationHelper, those of the array Distance go from light to dark with it. Colours that somebody has chosen for arrays of this
 * name stay.
 */

#ifndef vtkSMSequentialColorsInitializationHelper_h
#define vtkSMSequentialColorsInitializationHelper_h

#include "vtkSMProxyInitializationHelper.h"

class vtkSMSequentialColorsInitializationHelper : public vtkSMProxyInitializationHelper
{
public:
  static vtkSMSequentialColorsInitializationHelper* New();
  vtkTypeMacro(vtkSMSequentialColorsInitializationHelper, vtkSMProxyInitializationHelper);

  void PostInitializeProxy(vtkSMProxy* filter, vtkPVXMLElement* hint, vtkMTimeType initialised) override;
};

#endif
