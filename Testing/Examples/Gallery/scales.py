"""A globe at three wavelengths, and its spectrum:  pvbatch scales.py

A function on the Earth with waves of all lengths, and what of it is larger than 1500, 4000 and 10000 km. Its spectrum is the chart that
Scale Filter opens.
"""

import numpy as np
from scene import *
import surfaces
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy

WAVELENGTHS = [1500, 4000, 10000]


def weather(points):
    """Waves of many lengths and directions in space, longer ones higher."""
    random = np.random.default_rng(8)
    values = np.zeros(len(points))
    for length in np.geomspace(0.12, 3, 400):
        way = random.normal(size=3)
        phase = points @ (2 * np.pi / length * way / np.linalg.norm(way)) + random.uniform(0, 2 * np.pi)
        values += length ** 0.4 * np.sin(phase)
    return values / values.std()


def main():
    sphere = Sphere(Radius=1, ThetaResolution=240, PhiResolution=120)
    sphere.UpdatePipeline()
    globe = servermanager.Fetch(sphere)
    array = numpy_to_vtk(weather(vtk_to_numpy(globe.GetPoints().GetData()).astype(float)), deep=True)
    array.SetName("T")
    globe.GetPointData().AddArray(array)
    scales = ScaleFilter(Input=surfaces.source(globe), Arrays=["T"], Wavelengths=WAVELENGTHS, LengthScale=6371)
    view = view_from([0.8, -1, 0.5], [1500, 480], up=(0, 0, 1))
    right = np.cross(view.CameraViewUp, view.CameraPosition)
    right /= np.linalg.norm(right)
    for k, name in enumerate(["T"] + [f"T below {wavelength}" for wavelength in WAVELENGTHS]):
        colours = GetColorTransferFunction(name)
        colours.ColorSpace, colours.RGBPoints = "RGB", [-2, 0.2, 0.38, 0.65, 0, *IVORY, 2, 0.75, 0.25, 0.2]
        place = list(2.25 * k * right)
        show(SurfaceNormals(Input=scales), view, name, Ambient=0.5, Diffuse=0.5, Position=place)  # a source for each display
        text = f"{WAVELENGTHS[k - 1]} km" if k else "all of it"
        show_text(text, np.array(place) - [0, 0, 1.4], view, 0.25)
    save(view, "scales", 2)
    chart = CreateView("XYChartView")
    chart.ViewSize = [900, 500]
    Show(OutputPort(scales, 1), chart)
    Render(chart)
    chart.BottomAxisTitle, chart.LeftAxisTitle = "wavelength in km", "mean square per octave"
    chart.BottomAxisTitleFontSize = chart.LeftAxisTitleFontSize = 18
    chart.BottomAxisLabelFontSize = chart.LeftAxisLabelFontSize = 16
    chart.ShowLegend = 0
    SaveScreenshot("spectrum.png", chart, ImageResolution=[1200, 667])
    return scales


if __name__ == "__main__":
    main()
