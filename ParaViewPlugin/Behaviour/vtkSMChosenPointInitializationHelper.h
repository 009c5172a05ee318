/**
 * @class   vtkSMChosenPointInitializationHelper
 * @brief   where the handle of Parallel Transport stands before the first Apply
 *
 * Where the XML of a filter names this class in an InitializationHelper, its property UsePoint is on if a script has given Point
 * when it made the filter. Else Point is in the middle of the front of the input's bounds, near to where the filter will choose one.
 */

#ifndef vtkSMChosenPointInitializationHelper_h
#define vtkSMChosenPointInitializationHelper_h

#include "vtkSMProxyInitializationHelper.h"

class vtkSMChosenPointInitializationHelper : public vtkSMProxyInitializationHelper
{
public:
  static vtkSMChosenPointInitializationHelper* New();
  vtkTypeMacro(vtkSMChosenPointInitializationHelper, vtkSMProxyInitializationHelper);

  void PostInitializeProxy(vtkSMProxy* filter, vtkPVXMLElement* hint, vtkMTimeType initialised) override;
};

#endif
