#include "NewColors.h"

#include "vtkNew.h"
#include "vtkSMProperty.h"
#include "vtkSMProxy.h"
#include "vtkSMSessionProxyManager.h"
#include "vtkSMTransferFunctionManager.h"

//------------------------------------------------------------------------------
vtkSMProxy* TransferFunctionOf(const char* array, vtkSMProxy* filter)
{
  vtkNew<vtkSMTransferFunctionManager> manager;
  return manager->GetColorTransferFunction(array, filter->GetSessionProxyManager());
}

//------------------------------------------------------------------------------
vtkSMProxy* NewTransferFunctionOf(const char* array, vtkSMProxy* filter)
{
  const vtkMTimeType before = filter->GetMTime();
  vtkSMProxy* const function = TransferFunctionOf(array, filter);
  return function->GetProperty("RGBPoints")->GetMTime() > before ? function : nullptr;
}
