/**
 * @class   vtkSMConvergenceChartInitializationHelper
 * @brief   titles and whole iterations for the axes of Convergence Chart
 *
 * A chart view that shows a filter whose XML names this class in an InitializationHelper gets titles of its axes where it has none.
 * As long as the horizontal axis has that title, its labels are whole numbers of iterations, at most eleven.
 */

#ifndef vtkSMConvergenceChartInitializationHelper_h
#define vtkSMConvergenceChartInitializationHelper_h

#include "vtkSMProxyInitializationHelper.h"

class vtkSMConvergenceChartInitializationHelper : public vtkSMProxyInitializationHelper
{
public:
  static vtkSMConvergenceChartInitializationHelper* New();
  vtkTypeMacro(vtkSMConvergenceChartInitializationHelper, vtkSMProxyInitializationHelper);

  void PostInitializeProxy(vtkSMProxy* filter, vtkPVXMLElement* hint, vtkMTimeType initialised) override;
};

#endif
