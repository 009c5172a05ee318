"""The map that quads come from, and their irregular vertices:  pvbatch quad_map.py

Left, the squares of the map as a checkerboard: they continue over its seams (red), where the map is cut, as each quad is one of them. Right,
the quads around vertices of three quads are red, and those around vertices of five green.
"""

import numpy as np
from scene import *
from surfaces import duck, source

APART = 2.9


def checkerboard(size=64):
    """The texture of one square in four fields, so that colours are the same on both sides of a seam, however it turns."""
    half = np.arange(size) < size // 2
    dark = half[:, None] == half[None, :]
    return texture_of(np.where(dark[..., None], np.array(BLUE) * 255, np.array(IVORY) * 255))


def main():
    quads = QuadMesh(Input=source(duck()), NumberOfQuads=1100)
    map, size = OutputPort(quads, 1), size_of(quads)
    seams = FeatureEdges(Input=map, BoundaryEdges=1, FeatureEdges=0, NonManifoldEdges=0, ManifoldEdges=0)
    view = view_from([0.15, 0.3, 1], [1200, 430])
    show(map, view, [1, 1, 1], Texture=checkerboard(), RepeatTextures=1, Ambient=0.15, Diffuse=0.9)
    show(Tube(Input=seams, Radius=0.003 * size, NumberofSides=8), view, RED)
    around = PointDatatoCellData(Input=quads)
    display = show(around, view, Position=[APART, 0, -0.15 * APART], Ambient=0.3)
    ColorBy(display, ("CELLS", "Irregular"))
    colours = GetColorTransferFunction("Irregular")
    colours.ColorSpace, colours.RGBPoints = "RGB", [-0.25, 0.88, 0.4, 0.35, 0, *IVORY, 0.25, 0.42, 0.7, 0.42]
    show(Tube(Input=ExtractEdges(Input=quads), Radius=0.0011 * size, NumberofSides=8), view, BLUE, Position=[APART, 0, -0.15 * APART])
    save(view, "quad_map", 1.9)
    return quads, seams


if __name__ == "__main__":
    main()
