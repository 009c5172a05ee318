"""Fibres at an angle:  pvbatch fibres.py

The wall of a ventricle in three layers. Each follows its rim and the way around it, turned by 60 degrees outside, 0 in
the middle and -60 inside. The colour is what Field Angles measures against the way around: the helix angle, from -60
(blue) to 60 degrees (red).
"""

import numpy as np

from scene import *
from surfaces import cup, source

# Radius, depth, rotation, and the side that is drawn: angles of a half space about the z-axis.
LAYERS = [(1, 1.7, 60, -55), (0.86, 1.56, 0, -105), (0.72, 1.42, -60, None)]


def above(data, height=-1.25):
    """What is above a plane: all but the tips, where lines meet."""
    clip = Clip(Input=data, ClipType="Plane", Invert=0)
    clip.ClipType.Origin, clip.ClipType.Normal = [0, 0, height], [0, 0, 1]
    return ExtractSurface(Input=clip)


def half(data, angle):
    """What is on one side of a plane through the z-axis."""
    if angle is None:
        return data
    clip = Clip(Input=data, ClipType="Plane", Invert=0)
    clip.ClipType.Origin = [0, 0, 0]
    clip.ClipType.Normal = [np.cos(np.radians(angle + 90)), np.sin(np.radians(angle + 90)), 0]
    return ExtractSurface(Input=clip)


def main():
    view = view_from([0.1, -1, 0.45], [900, 900], [0, 0, 1])
    layers = []
    for radius, depth, rotation, side in LAYERS:
        around = Calculator(Input=source(cup(radius, depth)), ResultArrayName="Around", Function="coordsX*jHat-coordsY*iHat")
        field = HarmonicFieldSolver(Input=around, NumberOfDirections=2, Directions=["POINTS", "None"],
                                    BoundaryWeight=1, CurvatureWeight=0.3, Rotation=rotation)
        angles = FieldAngles(Input=field, ReferenceVectors=["POINTS", "Around"])
        layers.append(angles)
        show_surface(half(above(CellDatatoPointData(Input=angles)), side), view, "Angle", Ambient=0.4, Diffuse=0.75)
        show(half(above(lines_along(field, 0.013)), side), view, BLUE)
    GetColorTransferFunction("Angle").RGBPoints = [-60, 0.6, 0.72, 0.9, 0, 1, 0.97, 0.9, 60, 0.92, 0.6, 0.5]
    save(view, "fibres", 1.2)
    return layers


if __name__ == "__main__":
    main()
