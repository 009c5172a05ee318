"""Features of a part:  pvbatch features.py

Crosses that follow the boundary, holes and folds of a piece of sheet metal, and nothing else; a mesh of squares would, too.
"""

from scene import *
from surfaces import bracket, source


def main():
    field = HarmonicFieldSolver(Input=source(bracket()), BoundaryWeight=3, SharpEdgesWeight=3)
    view = view_from([1, -0.75, 0.9], [900, 600], [0, 0, 1])
    show_surface(field, view)
    show_lines(field, view, 0.014, shortest=2)
    edges = FeatureEdges(Input=field, FeatureAngle=30)
    show(Tube(Input=edges, Radius=0.012), view, GOLD)
    singularities = show_singularities(field, view)
    save(view, "features", 1.08)
    return field, edges, singularities


if __name__ == "__main__":
    main()
