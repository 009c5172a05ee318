"""Quads that are their own mirror image:  pvbatch symmetry.py

A bath toy, seen from the front. Left, quads as they come: each side has irregular vertices of its own. Right, with Symmetry on: the filter
finds the plane (golden), and both sides are mirror images of each other, with edges along the plane.
"""

from scene import *
from surfaces import duck, source


def main():
    toy = source(duck())
    view = view_from([1, 0.45, 0.12], [1200, 700])
    plain, symmetric = (QuadMesh(Input=toy, NumberOfQuads=1500, BallRadius=0.3, Symmetry=symmetry) for symmetry in ("None", "Automatic"))
    show_quads(plain, view, 0.0013, Position=[0, 0, 1.9])
    show_quads(symmetric, view, 0.0013)
    middle = Slice(Input=symmetric, SliceType="Plane")
    middle.SliceType.Origin, middle.SliceType.Normal = [0, 0, 0], [0, 0, 1]
    show(Tube(Input=middle, Radius=0.004 * size_of(symmetric)), view, GOLD, Ambient=0.5)
    save(view, "symmetric_quads", None)
    return plain, symmetric


if __name__ == "__main__":
    main()
