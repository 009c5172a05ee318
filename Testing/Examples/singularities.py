"""A cross field with prescribed singularities, through ParaView's Python:

    pvbatch singularities.py Data/double_torus.vtp

Prescribes eight singularities of index -1/4, four on the front of a subdivided surface and four on its back, and nothing else,
and leaves prescribed_singularities.png in the current folder: the picture of the help.
"""

import sys

import numpy as np
import paraview.simple as simple
from vtkmodules.util.numpy_support import vtk_to_numpy

from demo import (arrays_of, look_at, open_surface, poly_data, say, show, show_singularities, source,
                  tubes, white_view)

# As parts of the surface's box.
PLACES = [(0.5, y, z) for y in (0.14, 0.38, 0.62, 0.86) for z in (0.0, 1.0)]
INDEX = -0.25


def solve(data):
    points = arrays_of(data)[0]
    places = points.min(axis=0) + np.array(PLACES) * np.ptp(points, axis=0)
    singularities = poly_data(places, Index=np.full(len(places), INDEX))
    return simple.HarmonicFieldSolver(Input=source(data), Singularities=source(singularities))


def draw(field, points, size, image):
    view = white_view([580, 406])
    smooth = simple.GenerateSurfaceNormals(Input=field, FeatureAngle=60)
    show(smooth, view, [1.0, 0.97, 0.92], Ambient=0.2, Diffuse=0.85)
    lines = simple.FieldLines(Input=field, SeparatingDistance=0.025)
    show(tubes(lines, 0.0015 * size), view, [0.16, 0.33, 0.52])
    show_singularities(field, view, 0.011 * size)
    look_at(view, points)
    simple.SaveScreenshot(image, view, ImageResolution=[580, 406], CompressionLevel="9")


def main(path, subdivisions=2):
    """Draws the picture; returns the indices of all points of the surface."""
    surface = simple.LoopSubdivision(Input=open_surface(path), NumberofSubdivisions=subdivisions)
    data = simple.servermanager.Fetch(surface)
    points = arrays_of(data)[0]
    field = solve(data)
    field.UpdatePipeline()
    draw(field, points, np.linalg.norm(np.ptp(points, axis=0)), "prescribed_singularities.png")
    say("wrote prescribed_singularities.png")
    solved = simple.servermanager.Fetch(field)
    return vtk_to_numpy(solved.GetPointData().GetArray("SingularityIndex"))


if __name__ == "__main__":
    if len(sys.argv) != 2:
        raise SystemExit(__doc__)
    indices = main(sys.argv[1])
    say(f"{np.count_nonzero(indices)} singularities, whose indices sum to {indices.sum():g}")
