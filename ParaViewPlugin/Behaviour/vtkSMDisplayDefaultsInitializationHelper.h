/**
 * @class   vtkSMDisplayDefaultsInitializationHelper
 * @brief   gives what shows a filter its defaults once there are data, where the first Apply failed
 *
 * ParaView derives the defaults of a representation (sizes of glyphs, arrays of vectors and
 * normals) from the data when it makes the representation, and never again. If the first Apply
 * fails, these are defaults of nothing, no arrays and senseless sizes, and would stay after the
 * input is mended. The XML of our filters therefore names this class in an InitializationHelper: it
 * watches the filter, and when an output has points for the first time, it derives those properties
 * again that still have the defaults of nothing. What somebody has chosen stays. ParaView calls no
 * InitializationHelper for a filter that it loads from a state file.
 */

#ifndef vtkSMDisplayDefaultsInitializationHelper_h
#define vtkSMDisplayDefaultsInitializationHelper_h

#include "vtkSMProxyInitializationHelper.h"

class vtkSMDisplayDefaultsInitializationHelper : public vtkSMProxyInitializationHelper
{
public:
  static vtkSMDisplayDefaultsInitializationHelper* New();
  vtkTypeMacro(vtkSMDisplayDefaultsInitializationHelper, vtkSMProxyInitializationHelper);

  void PostInitializeProxy(vtkSMProxy* filter, vtkPVXMLElement* hint, vtkMTimeType initialised) override;
};

#endif
