#include "RegisterInitializationHelpers.h"

#include "vtkClientServerInterpreter.h"
#include "vtkClientServerInterpreterInitializer.h"
#include "vtkSMCenteredColorsInitializationHelper.h"
#include "vtkSMConvergenceChartInitializationHelper.h"
#include "vtkSMCyclicColorsInitializationHelper.h"
#include "vtkSMDeletedInputsInitializationHelper.h"
#include "vtkSMDirectionsInitializationHelper.h"
#include "vtkSMDisplayDefaultsInitializationHelper.h"
#include "vtkSMFollowedInitializationHelper.h"
#include "vtkSMGuidesFirstInitializationHelper.h"

namespace
{
template <class Helper>
void Register(vtkClientServerInterpreter* interpreter, const char* name)
{
  interpreter->AddNewInstanceFunction(name, [](void*) -> vtkObjectBase* { return Helper::New(); });
}
}

void RegisterInitializationHelpers()
{
  vtkClientServerInterpreterInitializer::GetInitializer()->RegisterCallback(
    [](vtkClientServerInterpreter* interpreter)
    {
      Register<vtkSMCenteredColorsInitializationHelper>(interpreter, "vtkSMCenteredColorsInitializationHelper");
      Register<vtkSMConvergenceChartInitializationHelper>(interpreter, "vtkSMConvergenceChartInitializationHelper");
      Register<vtkSMCyclicColorsInitializationHelper>(interpreter, "vtkSMCyclicColorsInitializationHelper");
      Register<vtkSMDeletedInputsInitializationHelper>(interpreter, "vtkSMDeletedInputsInitializationHelper");
      Register<vtkSMDirectionsInitializationHelper>(interpreter, "vtkSMDirectionsInitializationHelper");
      Register<vtkSMDisplayDefaultsInitializationHelper>(interpreter, "vtkSMDisplayDefaultsInitializationHelper");
      Register<vtkSMFollowedInitializationHelper>(interpreter, "vtkSMFollowedInitializationHelper");
      Register<vtkSMGuidesFirstInitializationHelper>(interpreter, "vtkSMGuidesFirstInitializationHelper");
    });
}
