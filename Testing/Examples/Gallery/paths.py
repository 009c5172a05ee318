"""The nearest of seven places, and ways from there:  pvbatch paths.py

Seven points of a bath toy (red) part it in the cells of the places that are nearest to each of them, along the surface. Shortest paths
(blue) lead from them to places that are spread over it.
"""

import numpy as np
from scene import *
from surfaces import duck, source
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkPolyData

COLOURS = [(0.98, 0.80, 0.62), (0.74, 0.86, 0.66), (0.66, 0.82, 0.90), (0.90, 0.72, 0.84), (0.97, 0.92, 0.62), (0.78, 0.76, 0.92), (0.82, 0.82, 0.80)]
PLACES = [(0.7, 1.2, 0.3), (-0.4, 0.3, 0.8), (0.5, -0.1, 0.6), (-1.2, 0.5, 0.1), (0.3, 0.3, -0.8), (-0.5, -0.5, 0.4), (-0.3, 0.3, -0.8)]


def points_of(surface, places):
    """The points of a surface that are nearest to some places."""
    at, points, data = vtk_to_numpy(surface.GetPoints().GetData()), vtkPoints(), vtkPolyData()
    for place in places:
        points.InsertNextPoint(at[np.linalg.norm(at - place, axis=1).argmin()])
    data.SetPoints(points)
    return data


def colour_cells(number):
    """The numbers of sources are categories, with a colour each."""
    function = GetColorTransferFunction("NearestSource")
    function.InterpretValuesAsCategories = 1
    function.Annotations = [text for k in range(number) for text in (str(k), str(k))]
    function.IndexedColors = [x for colour in COLOURS[:number] for x in colour]


def main():
    toy = duck()
    surface, points = source(toy), source(points_of(toy, PLACES))
    targets = MaskPoints(Input=surface, MaximumNumberofPoints=160, RandomSampling=1, RandomSamplingMode="Random Sampling",
                         OnRatio=1)
    measured = SurfaceDistance(Input=surface, Sources=points, Targets=targets, NumberOfLevels=0)
    view = view_from([0.3, 0.2, 1], [1200, 640])
    size = size_of(measured)
    cells = PointDatatoCellData(Input=measured, CategoricalData=1)
    colour_cells(len(PLACES))
    back = {"Position": [0.85 * size, 0, 0], "Orientation": [0, 180, 0]}
    for place in ({}, back):
        display = show_surface(cells, view, **place)
        ColorBy(display, ("CELLS", "NearestSource"))
        show(Tube(Input=OutputPort(measured, 2), Radius=0.0022 * size), view, BLUE, Ambient=1, Diffuse=0, **place)
        show(Glyph(Input=points, GlyphType="Sphere", GlyphMode="All Points", ScaleArray=["POINTS", "No scale array"],
                   ScaleFactor=0.04 * size), view, RED, Specular=0.3, **place)
    save(view, "paths", 1.5)
    return measured, PLACES


if __name__ == "__main__":
    main()
