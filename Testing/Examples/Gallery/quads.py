"""Quads on a scan and on parts:  pvbatch quads.py [SURFACE]

A scan, from a PLY, OBJ, STL, VTK or VTP file, else a bath toy; a solid with sharp edges; and sheet metal, which has a boundary. Edges of
quads run along the boundary and sharp edges. Nothing else is said but how many quads there shall be.
"""

import sys

from scene import *
from surfaces import bracket, duck, lever, source


def main(path=None):
    scan = QuadMesh(Input=open_surface(path) if path else source(duck()), NumberOfQuads=4000, BallRadius=0.35)
    view = view_from([0.55, 0.2, 1], [900, 760])
    show_quads(scan, view)
    save(view, "quads_of_scan", 1.45)

    solid = QuadMesh(Input=source(lever()), NumberOfQuads=2200, BallRadius=0.4)
    sheet = QuadMesh(Input=source(bracket()), NumberOfQuads=1500, BallRadius=0.4)
    view = view_from([0.6, -0.9, 0.9], [1200, 640], up=[0, 0, 1])
    show_quads(solid, view, Ambient=0.3)
    show_quads(sheet, view, Ambient=0.3, Position=[3.1, 2.3, 0.2])
    save(view, "quads_of_parts", None)
    return scan, solid, sheet


if __name__ == "__main__":
    main(*sys.argv[1:])
