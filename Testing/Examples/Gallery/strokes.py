"""Strokes:  pvbatch strokes.py

Splines drawn near a bath toy are the only guides of its plumage: a field of lines (N = 2) follows them, and is smooth
between them.
"""

from scene import *
from surfaces import duck, source

# Points near the surface; a spline through them goes to its nearest triangles.
STROKES = [[(0.32, 1.00, 0.26), (0.47, 1.27, 0.24), (0.70, 1.37, 0.19), (0.94, 1.28, 0.23), (1.07, 1.08, 0.24)],  # on the head
           [(-0.67, 0.16, 0.74), (-0.48, 0.38, 0.77), (-0.20, 0.41, 0.77), (0.08, 0.28, 0.80), (0.32, 0.12, 0.76)],  # the wing
           [(0.58, 0.39, 0.39), (0.65, 0.22, 0.51), (0.58, 0.00, 0.60), (0.39, -0.21, 0.62), (0.10, -0.36, 0.58)],  # the breast
           [(-1.28, 0.61, 0.17), (-1.09, 0.46, 0.32), (-0.91, 0.35, 0.35), (-0.58, 0.48, 0.30)]]  # the tail


def main():
    surface = source(duck())
    strokes = [SplineSource(ParametricFunction="Spline") for _ in STROKES]
    for spline, points in zip(strokes, STROKES):
        spline.ParametricFunction.Points = [x for point in points for x in point]
    field = HarmonicFieldSolver(Input=surface, Guides=strokes, NumberOfDirections=2, Alignment=10)
    view = view_from([0.55, 0.2, 1], [900, 760])
    show_surface(field, view)
    show_lines(field, view, 0.009)
    show_singularities(field, view)
    for stroke in strokes:
        show(Tube(Input=stroke, Radius=0.018), view, GOLD, Specular=0.3)
    save(view, "strokes", 1.45)
    return field, strokes


if __name__ == "__main__":
    main()
