#ifndef ChartsOfFilter_h
#define ChartsOfFilter_h

class vtkSMProxy;
class vtkSMSourceProxy;
class vtkSMViewProxy;

/// A function of a filter, a representation of it and a chart that shows that.
using ChartFunction = void (*)(vtkSMSourceProxy* filter, vtkSMProxy* representation, vtkSMViewProxy* chart);

/// Calls a function after each update of a representation of the filter, for each chart view that shows it. Representations of former
/// state files are not known.
void AfterUpdatesOfCharts(vtkSMProxy* filter, ChartFunction function);

#endif
