"""Fibres measured on a third of a surface:  pvbatch measured_fibres.py

The fibres of a ventricle's wall are known in a window only (red strokes, left), to 20 degrees. A field of lines, which
have no sign, follows them there (middle) and goes on as smoothly as it can elsewhere (right, from the back).
"""

import numpy as np

from scene import *
from surfaces import cup, polydata, source, triangles_of


def measure(surface, angle=60, noise=20, seed=5):
    """Lines at an angle to the way around, in a window of 120 degrees, each with an error, and the truth."""
    points, triangles = triangles_of(surface)
    a, b, c = np.moveaxis(points[triangles], 1, 0)
    normals = np.cross(b - a, c - a)
    normals /= np.linalg.norm(normals, axis=1)[:, None]
    centres = (a + b + c) / 3
    around = np.cross((0, 0, 1), centres)
    around -= (around * normals).sum(1)[:, None] * normals
    around /= np.linalg.norm(around, axis=1)[:, None]
    upwards = np.cross(normals, around)

    def turned(degrees):
        return np.cos(np.radians(degrees))[:, None] * around + np.sin(np.radians(degrees))[:, None] * upwards

    random = np.random.default_rng(seed)
    window = np.abs(np.arctan2(centres[:, 0], -centres[:, 1])) < np.pi / 3
    measured = turned(angle + noise * random.normal(size=len(centres))) * random.choice([-1, 1], len(centres))[:, None]
    return polydata(points, triangles, Measured=measured * window[:, None], Truth=turned(np.full(len(centres), angle)))


def main():
    data = source(measure(cup(1, 1.7)))
    field = HarmonicFieldSolver(Input=data, NumberOfDirections=2, Directions=["CELLS", "Measured"], Alignment=0.03)
    view = view_from([0, -1, 0.45], [900, 380], [0, 0, 1])
    for k, (drawn, turn) in enumerate([(data, 0), (field, 0), (field, 180)]):
        place = dict(Position=[2.08 * k, 0, 0], Orientation=[0, 0, turn])
        show_surface(drawn, view, **place)
        if drawn is data:
            strokes = glyphs_on(data, Directions=["CELLS", "Measured"], NumberOfDirections=2, SeparatingDistance=0.03)
            show(strokes, view, RED)
        else:
            show_lines(field, view, 0.018, **place)
            show_singularities(field, view, **place)
    save(view, "measured_fibres", None)
    return field


if __name__ == "__main__":
    main()
