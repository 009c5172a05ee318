"""A noisy flow on a scan:  pvbatch noisy_flow.py

Left, what was measured on a bath toy in the wind: vectors on two thirds of the triangles, with errors of every size and
a confidence each. Right, the field that follows them as far as they are to be trusted, and fills what is missing.
"""

import numpy as np

from scene import *
from surfaces import duck, polydata, source, triangles_of


def measure(surface, seed=5):
    """The wind along x, tangential, with noise; its confidences, the inverse variances of the noise; and the truth."""
    points, triangles = triangles_of(surface)
    a, b, c = np.moveaxis(points[triangles], 1, 0)
    normals = np.cross(b - a, c - a)
    normals /= np.linalg.norm(normals, axis=1)[:, None]
    truth = (-1, 0, 0) + normals[:, :1] * normals
    random = np.random.default_rng(seed)
    deviation = random.uniform(0.2, 2, len(truth))
    measured = truth + deviation[:, None] * random.normal(size=truth.shape)
    measured *= random.random(len(truth))[:, None] < 2 / 3
    return polydata(points, triangles, Measured=measured, Confidence=deviation ** -2, Truth=truth)


def main():
    data = source(measure(duck()))
    field = HarmonicFieldSolver(Input=data, NumberOfDirections=1, Directions=["CELLS", "Measured"],
                                Weights=["CELLS", "Confidence"], SmoothingLength=0.06, UnitLength=0)
    view = view_from([0, 0.15, 1], [900, 340])
    for k, drawn in enumerate([data, field]):
        show_surface(drawn, view, Position=[3 * k, 0, 0])
    show(glyphs_on(data, Directions=["CELLS", "Measured"], SeparatingDistance=0.04), view, RED)
    show_lines(field, view, 0.025, Position=[3, 0, 0])
    save(view, "noisy_flow", 2.5)
    return field


if __name__ == "__main__":
    main()
