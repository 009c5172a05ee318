"""Currents among continents:  pvbatch ocean.py

The wind blows to the west near the equator and to the east beyond, and does not mind continents. The part of this flow that goes
around them has a stream function that is constant on each coast: its contours are streamlines, with the same transport between all
neighbours. Colours are the stream function.
"""

import numpy as np
from scene import *
import surfaces
from vtkmodules.util.numpy_support import numpy_to_vtk


def wind(points):
    """Eastward and northward."""
    latitude = np.arcsin(np.clip(points[:, 2], -1, 1))
    return -np.cos(3 * latitude) * np.cos(latitude), 0.15 * np.sin(2 * latitude)


def main():
    sea = surfaces.ocean(0.022)
    points, _ = surfaces.triangles_of(sea)
    for name, values in zip(("Eastward", "Northward"), wind(points)):
        array = numpy_to_vtk(values, deep=True)
        array.SetName(name)
        sea.GetPointData().AddArray(array)
    parts = HodgeDecomposition(Input=surfaces.source(sea), Eastward=["POINTS", "Eastward"], Northward=["POINTS", "Northward"],
                               NumberOfContours=24, LengthScale=6371000)
    view = view_from([0.9, -0.75, 0.3], [900, 800], up=(0, 0, 1))
    show(parts, view, "StreamFunction", Ambient=0.6, Diffuse=0.4)
    largest = max(map(abs, servermanager.Fetch(parts).GetPointData().GetArray("StreamFunction").GetRange()))
    GetColorTransferFunction("StreamFunction").RGBPoints = [-largest, 0.35, 0.55, 0.8, 0, *IVORY, largest, 0.9, 0.5, 0.4]
    bar = GetScalarBar(GetColorTransferFunction("StreamFunction"), view)
    bar.Title, bar.ComponentTitle, bar.Visibility = "Stream function, m\u00b2/s", "", 1
    bar.TitleColor = bar.LabelColor = [0, 0, 0]
    bar.TitleFontSize = bar.LabelFontSize = 20
    bar.WindowLocation, bar.ScalarBarLength, bar.ScalarBarThickness = "Lower Right Corner", 0.3, 16
    bar.LabelFormat = bar.RangeLabelFormat = "%-#6.1e"
    show(Tube(Input=OutputPort(parts, 1), Radius=0.005), view, BLUE, Ambient=1, Diffuse=0)
    show(Sphere(Radius=0.985, ThetaResolution=120, PhiResolution=120), view, [0.72, 0.68, 0.55], Ambient=1, Diffuse=0)
    save(view, "ocean", 1.35)
    return parts


if __name__ == "__main__":
    main()
