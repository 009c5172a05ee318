"""Unit length while smoothing:  pvbatch unit_length.py

Crosses along the boundary of a disk, and quads that follow them. Left, the smoothest crosses of any length: they are
short in the middle, where their four singularities meet. Right, crosses of unit length, whose singularities keep apart.
"""

from scene import *
from surfaces import disk, source


def main():
    view = view_from([0, 0, 1], [1100, 560])
    results = []
    for k in (0, 1):
        field = HarmonicFieldSolver(Input=source(disk()), NumberOfDirections=4, BoundaryWeight=1000, UnitLengthWhileSmoothing=k)
        quads = QuadMesh(Input=field, NumberOfQuads=400, BallRadius=0.35)
        show_quads(quads, view, 0.0016, Position=[2.2 * k, 0, 0], Ambient=0.4)
        results.append(quads)
    save(view, "unit_length", 1.4)
    return results


if __name__ == "__main__":
    main()
