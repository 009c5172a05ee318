"""Lines beside a stroke:  pvbatch offset_lines.py

A spline that is drawn near a bath toy (golden) is the source of distances along its surface. Blue lines are at equal distances from it.
"""

from scene import *
from surfaces import duck, source

STROKE = [(-0.67, 0.16, 0.74), (-0.48, 0.38, 0.77), (-0.20, 0.41, 0.77), (0.08, 0.28, 0.80), (0.32, 0.12, 0.76)]  # along the wing


def main():
    stroke = SplineSource(ParametricFunction="Spline")
    stroke.ParametricFunction.Points = [x for point in STROKE for x in point]
    measured = SurfaceDistance(Input=source(duck()), Sources=stroke, OffsetDistances=[0.1 * k for k in range(1, 60)])
    view = view_from([0.3, 0.2, 1], [1200, 640])
    size = size_of(measured)
    back = {"Position": [0.85 * size, 0, 0], "Orientation": [0, 180, 0]}
    for place in ({}, back):
        show_surface(measured, view, "Distance", **place)
        show(Tube(Input=OutputPort(measured, 1), Radius=0.002 * size), view, BLUE, Ambient=1, Diffuse=0, **place)
    show(Tube(Input=stroke, Radius=0.018), view, GOLD, Specular=0.3)
    save(view, "offset_lines", 1.5)
    return measured, stroke


if __name__ == "__main__":
    main()
