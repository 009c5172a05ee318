"""Sources and vortices of a flow that was measured on an organ:  pvbatch organ_flow.py

The vectors have errors as large as a third of the flow, on every triangle for itself. Left, the potential of the flow: it springs from
the blue places, of low potential, and ends in the red ones. Right, its stream function and streamlines, which go around the vortices.
The errors are left to the residual, but for the share that functions on such triangles resolve.

Where the Topology ToolKit is installed as a plugin, its Morse-Smale complexes of both functions are the skeleton of the flow: sources and
sinks with the separatrices between their basins, and vortices with those between their cells. Here, it is tried only if it is there.
"""

import numpy as np
from scene import *
import surfaces

SOURCES = {(0.1, -0.9, 0.55): 1, (0.75, 0.75, 0.35): 1, (-0.45, 0.6, 0.4): -1}  # springs, and a sink
VORTICES = {(0.55, -0.05, 0.45): 1, (-0.5, -0.3, 0.5): -1}
WIDTH = 0.35


def nearest(points, place):
    return points[((points - place) ** 2).sum(1).argmin()]


def bumps(points, heights):
    """A function with hills at some places, and its gradient in space."""
    value, gradient = np.zeros(len(points)), np.zeros_like(points)
    for place, height in heights.items():
        away = points - place
        hill = height * WIDTH * np.exp(-0.5 * (away ** 2).sum(1) / WIDTH ** 2)
        value += hill
        gradient -= hill[:, None] * away / WIDTH ** 2
    return value, gradient


def measured(organ, error=0.33):
    """A vector for each triangle."""
    points, triangles = surfaces.triangles_of(organ)
    a, b, c = np.moveaxis(points[triangles], 1, 0)
    normals = np.cross(b - a, c - a)
    normals /= np.linalg.norm(normals, axis=1)[:, None]
    centres = (a + b + c) / 3
    _, spreading = bumps(centres, {tuple(nearest(points, place)): -height for place, height in SOURCES.items()})
    _, swirling = bumps(centres, {tuple(nearest(points, place)): -height for place, height in VORTICES.items()})
    flow = spreading + np.cross(normals, swirling)
    noise = np.random.default_rng(7).normal(size=flow.shape)
    return flow + error * np.sqrt((flow ** 2).sum(1).mean() / 2) * noise


def skeleton(parts, view):
    """Of the potential, by the Topology ToolKit."""
    if "TTKMorseSmaleComplex" not in globals():
        print("the Topology ToolKit is not installed: its skeleton was not tried")
        return None
    complex_ = TTKMorseSmaleComplex(Input=parts, ScalarField=["POINTS", "Potential"])
    show(Tube(Input=OutputPort(complex_, 1), Radius=0.006), view, GOLD)
    return complex_


def main():
    organ = surfaces.heart(0.028)
    data = surfaces.polydata(*surfaces.triangles_of(organ), Flow=measured(organ))
    parts = HodgeDecomposition(Input=surfaces.source(data), Vectors=["CELLS", "Flow"], NumberOfContours=14)
    view = view_from([0.12, 0, 1], [1200, 760])
    right = {"Position": [2.1, 0, 0]}
    for name, shift in (("Potential", {}), ("StreamFunction", right)):
        show(SurfaceNormals(Input=parts), view, name, Ambient=0.2, Specular=0.1, **shift)
        low, high = servermanager.Fetch(parts).GetPointData().GetArray(name).GetRange()
        GetColorTransferFunction(name).RGBPoints = [low, 0.3, 0.5, 0.8, 0.5 * (low + high), *IVORY, high, 0.85, 0.35, 0.3]
    arrows = glyphs_on(parts, Directions=["CELLS", "GradientPart"], Sizing="By Magnitude", ScaleFactor=1.6)
    show(arrows, view, BLUE, Ambient=1, Diffuse=0)
    show(Tube(Input=OutputPort(parts, 1), Radius=0.006), view, BLUE, Ambient=1, Diffuse=0, **right)
    skeleton(parts, view)
    save(view, "organ_flow", 1.45)
    return parts


if __name__ == "__main__":
    main()
