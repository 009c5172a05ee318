"""Functions and flows by scale through ParaView's Python: every property of Scale Filter, by its label, and the chart of its spectrum."""

import numpy as np
import paraview.simple as simple
from vtkmodules.util.numpy_support import vtk_to_numpy


def fetch(proxy, port=0):
    return simple.servermanager.Fetch(proxy, idx=port)


def point_array(data, name):
    return vtk_to_numpy(data.GetPointData().GetArray(name))


def check_properties(source):
    scales = simple.ScaleFilter(Input=source, Arrays=["f", "U"], Wavelengths=[1000, 3000], LengthScale=1000, Order=1, PartsApart=1,
                                SpectrumRows=5, SpectrumFrom=500, SpectrumTo=5000, Tolerance=1e-8, Solver="Cholesky", Boundary="Open")
    data, table = fetch(scales), fetch(scales, 1)
    for name in ("f", "U"):
        for wavelength in (1000, 3000):
            total = point_array(data, f"{name} below {wavelength}") + point_array(data, f"{name} above {wavelength}")
            assert np.allclose(total, point_array(data, name), atol=0.02), name  # the sphere's normals are those of points
    assert data.GetPointData().HasArray("U rotational below 1000") and data.GetPointData().HasArray("U divergent below 3000")
    lengths = vtk_to_numpy(table.GetRowData().GetArray("Wavelength"))
    assert len(lengths) == 5 and lengths[0] > 500 and lengths[-1] < 5000
    assert data.GetFieldData().GetArray("Converged").GetValue(0) == 1
    scales.FlowKind = "Wholes"
    scales.Order = 2
    scales.Spectrum = 0
    assert not fetch(scales).GetPointData().HasArray("U rotational below 1000")
    assert fetch(scales, 1).GetNumberOfColumns() == 0
    components = simple.ScaleFilter(Input=source, Arrays=[], Eastward=["POINTS", "f"], Northward=["POINTS", "f"], Axis=[0, 0, 1], Spectrum=0,
                                    JoinPoints=0, Strict=0, Coordinates="Space")
    assert any(name.startswith("Flow below") for name in components.PointData.keys())


def check_chart(source):
    """Apply with nothing said, and the second output in a chart."""
    scales = simple.ScaleFilter(Input=source)
    chart = simple.CreateView("XYChartView")
    display = simple.Show(simple.OutputPort(scales, 1), chart)
    simple.Render(chart)
    assert scales.PointData.GetArray("f above 0.7") or any(" below " in name for name in scales.PointData.keys())
    assert str(display.XArrayName).strip("'") == "Wavelength" and not display.UseIndexForXAxis
    assert all(name.endswith(" per octave") for name in display.SeriesVisibility) and len(display.SeriesVisibility) > 0
    assert chart.BottomAxisLogScale == 1 and chart.BottomAxisTitle == "wavelength"
    chart.BottomAxisTitle = "mine"
    scales.Order = 1
    simple.Render(chart)
    assert chart.BottomAxisTitle == "mine"


def main():
    sphere = simple.Sphere(Radius=1, ThetaResolution=48, PhiResolution=48)
    function = simple.Calculator(Input=sphere, ResultArrayName="f", Function="sin(3*coordsX)+coordsZ")
    flow = simple.Calculator(Input=function, ResultArrayName="U", Function="coordsX * jHat - coordsY * iHat")
    check_properties(flow)
    check_chart(flow)


if __name__ == "__main__":
    main()
