#include "RegisterInitializationHelpers.h"

#include "vtkClientServerInterpreter.h"
#include "vtkClientServerInterpreterInitializer.h"
#include "vtkFieldLinesRepresentation.h"
#include "vtkInkRepresentation.h"
#include "vtkSMCenteredColorsInitializationHelper.h"
#include "vtkSMChosenPointInitializationHelper.h"
#include "vtkSMConvergenceChartInitializationHelper.h"
#include "vtkSMCyclicColorsInitializationHelper.h"
#include "vtkSMDirectionsInitializationHelper.h"
#include "vtkSMDisplayDefaultsInitializationHelper.h"
#include "vtkSMHiddenDrawingsInitializationHelper.h"
#include "vtkSMSequentialColorsInitializationHelper.h"
#include "vtkSMSpectrumChartInitializationHelper.h"

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
      Register<vtkSMChosenPointInitializationHelper>(interpreter, "vtkSMChosenPointInitializationHelper");
      Register<vtkSMConvergenceChartInitializationHelper>(interpreter, "vtkSMConvergenceChartInitializationHelper");
      Register<vtkSMCyclicColorsInitializationHelper>(interpreter, "vtkSMCyclicColorsInitializationHelper");
      Register<vtkSMDirectionsInitializationHelper>(interpreter, "vtkSMDirectionsInitializationHelper");
      Register<vtkSMDisplayDefaultsInitializationHelper>(interpreter, "vtkSMDisplayDefaultsInitializationHelper");
      Register<vtkSMSequentialColorsInitializationHelper>(interpreter, "vtkSMSequentialColorsInitializationHelper");
      Register<vtkSMHiddenDrawingsInitializationHelper>(interpreter, "vtkSMHiddenDrawingsInitializationHelper");
      Register<vtkSMSpectrumChartInitializationHelper>(interpreter, "vtkSMSpectrumChartInitializationHelper");
      vtkFieldLinesRepresentation::Register(interpreter);
      vtkInkRepresentation::Register(interpreter);
    });
}
