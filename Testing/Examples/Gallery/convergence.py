"""How the solver converges:  pvbatch convergence.py

The chart that Convergence Chart makes of the table of a field on a fine sphere, with titles of its axes.
"""

from scene import *


def main():
    sphere = Sphere(ThetaResolution=300, PhiResolution=300)
    mask = Calculator(Input=sphere, ResultArrayName="Directions", Function="if(coordsX > 0.45, 1, 0) * jHat")
    field = HarmonicFieldSolver(Input=mask, Directions=["POINTS", "Directions"], Tolerance=1e-10, Solver="Conjugate Gradients")
    curve = ConvergenceChart(Input=OutputPort(field, 2))
    curve.UpdatePipeline()
    residuals = servermanager.Fetch(curve).GetColumn(0)
    last = residuals.GetNumberOfTuples() - 1
    view = CreateView("XYChartView")
    view.ViewSize = [900, 600]
    view.BottomAxisTitle, view.LeftAxisTitle = "iteration", "log10 of the relative residual"
    view.BottomAxisTitleFontSize = view.LeftAxisTitleFontSize = 18
    view.BottomAxisLabelFontSize = view.LeftAxisLabelFontSize = 16
    view.BottomAxisUseCustomRange, view.BottomAxisRangeMinimum, view.BottomAxisRangeMaximum = 1, 0, last
    view.BottomAxisUseCustomLabels, view.BottomAxisLabels = 1, [text for k in range(last + 1) for text in 2 * [str(k)]]
    view.ShowLegend = 0
    display = Show(curve, view)
    display.SeriesLineThickness = [residuals.GetName(), "3"]
    display.SeriesMarkerStyle = [residuals.GetName(), "4"]
    display.SeriesMarkerSize = [residuals.GetName(), "10"]
    display.SeriesColor = [residuals.GetName(), *map(str, BLUE)]
    Render(view)
    SaveScreenshot("convergence.png", view, ImageResolution=[1200, 800])
    return [residuals.GetTuple1(k) for k in range(last + 1)]


if __name__ == "__main__":
    main()
