"""Nothing said:  pvbatch nothing_said.py [SURFACE]

The smoothest crosses there are, on a PLY, OBJ, STL, VTK or VTP file, else on a bath toy.
"""

import sys

from scene import *
from surfaces import duck, source


def main(path=None):
    surface = open_surface(path) if path else source(duck())
    field = HarmonicFieldSolver(Input=surface, NumberOfDirections=4)
    view = view_from([0.55, 0.2, 1], [900, 760])
    show_surface(field, view)
    show_lines(field, view, 0.014)
    singularities = show_singularities(field, view, 0.008)
    save(view, "nothing_said", 1.45)
    return field, singularities


if __name__ == "__main__":
    main(*sys.argv[1:])
