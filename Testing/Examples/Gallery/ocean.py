"""Currents among continents:  pvbatch ocean.py

The wind blows to the west near the equator and to the east beyond, and does not mind continents. The part of this flow that goes
around them has a stream function that is constant on each coast: its contours are streamlines, with the same transport between all
neighbours. Colours are the stream function, and the numbers on continents are its values along their coasts: the difference between
two of them flows through the strait between.
"""

import numpy as np
from scene import *
import surfaces
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy


def wind(points):
    """Eastward and northward."""
    latitude = np.arcsin(np.clip(points[:, 2], -1, 1))
    return -np.cos(3 * latitude) * np.cos(latitude), 0.15 * np.sin(2 * latitude)


def number_coasts(coasts, view):
    """On each continent in view, the stream function along its coast."""
    towards = np.array(view.CameraPosition) / np.linalg.norm(view.CameraPosition)
    values = vtk_to_numpy(coasts.GetCellData().GetArray("BoundaryStreamFunction"))
    for k, value in enumerate(values):
        middle = vtk_to_numpy(coasts.GetCell(k).GetPoints().GetData()).mean(0)
        if middle @ towards > 0.2 * np.linalg.norm(middle):
            show_text(f"{value / 1e6:.1f}", middle / np.linalg.norm(middle) + 0.2 * towards, view, 0.1)


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
    millions = Calculator(Input=parts, ResultArrayName="Millions", Function="StreamFunction / 1000000")
    show(millions, view, "Millions", Ambient=0.6, Diffuse=0.4)
    colours = GetColorTransferFunction("Millions")
    colours.ColorSpace, colours.RGBPoints = "RGB", [-2, 0.35, 0.55, 0.8, 0, *IVORY, 2, 0.9, 0.5, 0.4]
    bar = GetScalarBar(colours, view)
    bar.Title, bar.ComponentTitle, bar.Visibility = "Stream function, million m\u00b2/s", "", 1
    bar.TitleColor = bar.LabelColor = [0, 0, 0]
    bar.TitleFontSize = bar.LabelFontSize = 20
    bar.WindowLocation, bar.ScalarBarLength, bar.ScalarBarThickness = "Lower Right Corner", 0.3, 16
    bar.UseCustomLabels, bar.CustomLabels, bar.AddRangeLabels, bar.LabelFormat = 1, [-2, -1, 0, 1, 2], 0, "%.0f"
    show(Tube(Input=OutputPort(parts, 1), Radius=0.004), view, BLUE, Ambient=1, Diffuse=0)
    show(Tube(Input=OutputPort(parts, 2), Radius=0.008), view, [0.35, 0.32, 0.22], Ambient=1, Diffuse=0)
    show(Sphere(Radius=0.985, ThetaResolution=120, PhiResolution=120), view, [0.72, 0.68, 0.55], Ambient=1, Diffuse=0)
    number_coasts(servermanager.Fetch(parts, idx=2), view)
    save(view, "ocean", 1.35)
    return parts


if __name__ == "__main__":
    main()
