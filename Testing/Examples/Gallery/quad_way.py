"""How quads are made:  pvbatch quad_way.py

A cross field with its singularities; the map whose integer grid follows it, as a texture that repeats; the isolines of the map at
half-integers, of u (red) and v (blue), which cross once for each quad; the quads.
"""

import numpy as np

from scene import *
from surfaces import duck, source

APART = 3.1


def square(size=64, width=3):
    """The texture of a square with a dark line around it."""
    colours = np.full((size, size, 3), (255, 247, 235))
    inside = slice(width, -width)
    frame = np.ones((size, size), bool)
    frame[inside, inside] = False
    colours[frame] = (26, 66, 115)
    return texture_of(colours)


def isolines(map, coordinate):
    """Where a coordinate of the map is a half-integer."""
    one = Calculator(Input=map, ResultArrayName=coordinate, Function=f"TextureCoordinates_{coordinate}")
    one.UpdatePipeline()
    low, high = one.PointData[coordinate].GetRange()
    return Contour(Input=one, ContourBy=["POINTS", coordinate], Isosurfaces=list(np.arange(np.floor(low), high) + 0.5))


def main():
    toy = source(duck())
    field = HarmonicFieldSolver(Input=toy, NumberOfDirections=4, UnitLengthWhileSmoothing=1)
    quads = QuadMesh(Input=field, NumberOfQuads=1100)
    map, size = OutputPort(quads, 1), size_of(field)
    view = view_from([0.15, 0.3, 1], [1200, 860])
    show_surface(field, view)
    show_lines(field, view, 0.02)
    show_singularities(field, view)
    show(map, view, [1, 1, 1], Position=[APART, 0, 0], Texture=square(), RepeatTextures=1, Ambient=0.15, Diffuse=0.9)
    for coordinate, colour in (("X", RED), ("Y", BLUE)):
        show(Tube(Input=isolines(map, coordinate), Radius=0.0016 * size), view, colour, Position=[0, -0.8 * APART, 0])
    show_surface(toy, view, Position=[0, -0.8 * APART, 0])
    show_quads(quads, view, Position=[APART, -0.8 * APART, 0])
    save(view, "quad_way", 1.35)
    return quads


if __name__ == "__main__":
    main()
