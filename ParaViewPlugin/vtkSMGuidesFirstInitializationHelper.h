/**
 * @class   vtkSMGuidesFirstInitializationHelper
 * @brief   lets Apply reach the guides of a filter before the filter
 *
 * The button Apply goes through all proxies that have changed, in no order that a person would know, and a new filter is updated as
 * soon as its turn comes. Guides whose turn comes later have the values of their creation until then. Values that the panel holds for
 * the inputs of a filter's further ports are therefore taken over when the properties of the filter are, with what these inputs are
 * made of. The turn of the guides comes all the same, and changes nothing more.
 */

#ifndef vtkSMGuidesFirstInitializationHelper_h
#define vtkSMGuidesFirstInitializationHelper_h

#include "vtkSMProxyInitializationHelper.h"

class vtkSMGuidesFirstInitializationHelper : public vtkSMProxyInitializationHelper
{
public:
  static vtkSMGuidesFirstInitializationHelper* New();
  vtkTypeMacro(vtkSMGuidesFirstInitializationHelper, vtkSMProxyInitializationHelper);

  void PostInitializeProxy(vtkSMProxy* filter, vtkPVXMLElement* hint, vtkMTimeType initialised) override;
};

#endif
