"""A flow around handles:  pvbatch handles.py

A surface with five handles has flows without any source, sink or vortex; with nothing prescribed, a face field is one of
them. The colour is its speed, from 0 (blue) to the largest (red); the balls are its saddles, of index -1.
"""

from scene import *
from surfaces import tangle, source


def main():
    field = HarmonicFieldSolver(Input=source(tangle()), Discretisation="Face Field", UnitLength=0)
    view = view_from([0.25, 0.35, 1], [900, 820])
    speed = Calculator(Input=field, ResultArrayName="Speed", Function="mag(Direction0)")
    show_surface(speed, view, "Speed")
    speed.UpdatePipeline()
    colour_by_size("Speed", speed.PointData["Speed"].GetRange()[1])
    show_lines(field, view, 0.016)
    show_singularities(field, view)
    save(view, "handles", 1.2)
    return field


if __name__ == "__main__":
    main()
