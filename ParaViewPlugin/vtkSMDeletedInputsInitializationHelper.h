/**
 * @class   vtkSMDeletedInputsInitializationHelper
 * @brief   lets a filter follow no more what is deleted
 *
 * ParaView keeps a source alive that is deleted while a filter has it as an input: the panel no longer shows it, and the filter goes on
 * to use it. The window allows this for sources that were moved from one input property to another. Where the XML of a filter names this
 * class in an InitializationHelper, sources that are deleted are taken out of the inputs of its further ports.
 */

#ifndef vtkSMDeletedInputsInitializationHelper_h
#define vtkSMDeletedInputsInitializationHelper_h

#include "vtkSMProxyInitializationHelper.h"

class vtkSMDeletedInputsInitializationHelper : public vtkSMProxyInitializationHelper
{
public:
  static vtkSMDeletedInputsInitializationHelper* New();
  vtkTypeMacro(vtkSMDeletedInputsInitializationHelper, vtkSMProxyInitializationHelper);

  void PostInitializeProxy(vtkSMProxy* filter, vtkPVXMLElement* hint, vtkMTimeType initialised) override;
};

#endif
