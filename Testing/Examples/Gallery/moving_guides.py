"""Moving guides:  pvbatch moving_guides.py

An arrow turns on a pebble, another one stays, and the lines follow both. Only what the guides change is solved for
again in each frame.
"""

import math

from scene import *
from surfaces import ball, source

ANGLES = [0, 30, 60, 90]


def main(angles=ANGLES):
    pebble = source(ball((1, 1.25, 0.45), 0.04))
    fixed, moving = Line(Point1=[-0.3, -0.75, 0.38], Point2=[0.3, -0.75, 0.38]), Line()
    field = HarmonicFieldSolver(Input=pebble, Guides=[fixed, moving], NumberOfDirections=2, Alignment=10)
    view = view_from([0, -0.25, 1], [900, 300])
    fields = []
    for k, angle in enumerate(angles):
        x, y = 0.3 * math.cos(math.radians(angle)), 0.3 * math.sin(math.radians(angle))
        moving.Point1, moving.Point2 = [-x, 0.5 - y, 0.42], [x, 0.5 + y, 0.42]
        field.UpdatePipeline()
        fields.append(servermanager.Fetch(field))
        frame = source(fields[-1])
        place = [2.08 * k, 0, 0]
        show_surface(frame, view, Position=place)
        show_lines(frame, view, 0.017, Position=place)
        show_singularities(frame, view, 0.015, Position=place)
        for line in (fixed, Line(Point1=moving.Point1, Point2=moving.Point2)):
            show_arrow(line, view, 0.6, Position=[place[0], 0, 0.08])
    save(view, "moving_guides", None)
    return fields


if __name__ == "__main__":
    main()
