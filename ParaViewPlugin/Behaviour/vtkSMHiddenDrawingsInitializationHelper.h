/**
 * @class   vtkSMHiddenDrawingsInitializationHelper
 * @brief   hides the lines and balls of a field that a filter turns into something else, or draws itself
 *
 * In the window, Apply hides the output that a new filter takes, and leaves the other outputs of the same source in view. Where the XML of a
 * filter names this class in an InitializationHelper, these are hidden as well at the first update. With of="surface" they stay, and the
 * surface, which shows as Field Lines, is shown as Surface, since the filter draws on it. Scripts hide what they like.
 */

#ifndef vtkSMHiddenDrawingsInitializationHelper_h
#define vtkSMHiddenDrawingsInitializationHelper_h

#include "vtkSMProxyInitializationHelper.h"

class vtkSMHiddenDrawingsInitializationHelper : public vtkSMProxyInitializationHelper
{
public:
  static vtkSMHiddenDrawingsInitializationHelper* New();
  vtkTypeMacro(vtkSMHiddenDrawingsInitializationHelper, vtkSMProxyInitializationHelper);

  void PostInitializeProxy(vtkSMProxy* filter, vtkPVXMLElement* hint, vtkMTimeType initialised) override;
};

#endif
