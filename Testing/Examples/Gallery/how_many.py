"""How many directions:  pvbatch how_many.py

Nothing prescribed, on a sphere: the smoothest fields of 1, 2, 4 and 6 directions, with 2, 4, 8 and 12 singularities of index
1 / N, as far from each other as can be.
"""

from scene import *
from surfaces import ball, source

NUMBERS = [1, 2, 4, 6]


def main():
    view = view_from([0, 0.25, 1], [900, 900])
    sphere, counts = source(ball()), []
    for k, number in enumerate(NUMBERS):
        field = HarmonicFieldSolver(Input=sphere, NumberOfDirections=number)
        place = [2.3 * (k % 2), -2.3 * (k // 2), 0]
        show_surface(field, view, Position=place)
        show_lines(field, view, 0.03, Position=place)
        singularities = show_singularities(field, view, 0.02, Position=place)
        counts.append(singularities.GetNumberOfPoints())
    save(view, "how_many", 1.3)
    return counts


if __name__ == "__main__":
    main()
