/**
 * @class   vtkSMDirectionsInitializationHelper
 * @brief   chooses vectors that are neither normals nor texture coordinates
 *
 * ParaView's first choice from a list of vectors is the first of them, which on many surfaces are normals or texture coordinates. Where
 * the XML of a filter names this class in an InitializationHelper, the first choice of its property Directions is another array of the
 * list, if there is one.
 *
 * With choice="only" beside the class, Directions is an array that is the only one of its kind, and nothing where there are several.
 */

#ifndef vtkSMDirectionsInitializationHelper_h
#define vtkSMDirectionsInitializationHelper_h

#include "vtkSMProxyInitializationHelper.h"

class vtkSMDirectionsInitializationHelper : public vtkSMProxyInitializationHelper
{
public:
  static vtkSMDirectionsInitializationHelper* New();
  vtkTypeMacro(vtkSMDirectionsInitializationHelper, vtkSMProxyInitializationHelper);

  void PostInitializeProxy(vtkSMProxy* filter, vtkPVXMLElement* hint, vtkMTimeType initialised) override;
};

#endif
