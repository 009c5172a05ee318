"""Polar coordinates and parallel directions around a point:  pvbatch carried.py

Left, circles and rays of the logarithmic map of a point of a bath toy: places at the same distance along the surface, and shortest
paths that start 15 degrees apart. Right, one direction that was carried along these paths to everywhere.
"""

from scene import *
import surfaces


def main():
    carried = ParallelTransport(Input=surfaces.source(surfaces.duck()), Point=[0.1, 0.1, 0.9], Direction=[1, 0, 0])
    view = view_from([0.2, 0.25, 1], [1200, 640])
    size = size_of(carried)
    right = {"Position": [0.68 * size, 0, 0.4 * size]}
    rays = Calculator(Input=carried, ResultArrayName="Rays", Function="sin(12 * GeodesicAngle * 0.017453292519943295)")
    show_surface(carried, view)
    show_surface(carried, view, **right)
    circles = Contour(Input=carried, ContourBy=["POINTS", "GeodesicDistance"], Isosurfaces=[0.03 * size * k for k in range(1, 40)])
    show(Tube(Input=circles, Radius=0.0018 * size), view, BLUE, Ambient=1, Diffuse=0)
    beyond = Threshold(Input=rays, Scalars=["POINTS", "GeodesicDistance"], LowerThreshold=0.06 * size, UpperThreshold=1e9)
    beams = Contour(Input=beyond, ContourBy=["POINTS", "Rays"], Isosurfaces=[0])
    show(Tube(Input=beams, Radius=0.0012 * size), view, RED, Ambient=1, Diffuse=0)
    arrows = glyphs_on(carried, Directions=["CELLS", "TransportedVectors"], SeparatingDistance=0.03)
    show(arrows, view, BLUE, Ambient=1, Diffuse=0, **right)
    save(view, "carried", None)
    return carried


if __name__ == "__main__":
    main()
