/**
 * @class   vtkSMFollowedInitializationHelper
 * @brief   says in the output messages what a field follows
 *
 * After an update of a filter whose XML names this class in an InitializationHelper, there is one line that says what the field
 * follows: the property Followed of the filter. It comes again only where that has changed.
 */

#ifndef vtkSMFollowedInitializationHelper_h
#define vtkSMFollowedInitializationHelper_h

#include "vtkSMProxyInitializationHelper.h"

class vtkSMFollowedInitializationHelper : public vtkSMProxyInitializationHelper
{
public:
  static vtkSMFollowedInitializationHelper* New();
  vtkTypeMacro(vtkSMFollowedInitializationHelper, vtkSMProxyInitializationHelper);

  void PostInitializeProxy(vtkSMProxy* filter, vtkPVXMLElement* hint, vtkMTimeType initialised) override;
};

#endif
