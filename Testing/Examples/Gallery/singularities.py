"""Singularities where you want them:  pvbatch singularities.py [SURFACE]

Eight singularities of index -1/4 are prescribed, four on the front of a slab with two holes and four on its back, and
nothing else. The crosses have these and no others, and turn as little as they can.
"""

import pathlib
import sys

from scene import *

SURFACE = str(pathlib.Path(__file__).resolve().parents[3] / "Data" / "double_torus.vtp")
# As parts of the surface's box.
PLACES = [(0.5, y, z) for y in (0.14, 0.38, 0.62, 0.86) for z in (0.0, 1.0)]


def singularities_on(surface):
    """The points, each with its index."""
    bounds = surface.GetDataInformation().GetBounds()
    places = [bounds[2 * k] + place[k] * (bounds[2 * k + 1] - bounds[2 * k]) for place in PLACES for k in range(3)]
    return Calculator(Input=PolyLineSource(Points=places), ResultArrayName="Index", Function="-0.25")


def main(path=SURFACE):
    surface = LoopSubdivision(Input=open_surface(path), NumberofSubdivisions=2)
    surface.UpdatePipeline()
    field = HarmonicFieldSolver(Input=surface, Singularities=singularities_on(surface))
    view = view_from([0.35, 0.3, 1], [900, 600])
    show_surface(field, view)
    show_lines(field, view, 0.022)
    singularities = show_singularities(field, view)
    save(view, "prescribed_singularities", 1.67)
    return singularities


if __name__ == "__main__":
    main(*sys.argv[1:])
