#ifndef NewColors_h
#define NewColors_h

class vtkSMProxy;

/// The colours of arrays of a name.
vtkSMProxy* TransferFunctionOf(const char* array, vtkSMProxy* filter);

/// The same where ParaView makes them in this call; null where somebody has had and may have changed them before.
vtkSMProxy* NewTransferFunctionOf(const char* array, vtkSMProxy* filter);

#endif
