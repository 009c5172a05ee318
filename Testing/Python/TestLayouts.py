"""Every filter that reads vectors gives the same numbers on one surface, however a file lays it out."""

import unittest
import warnings

import numpy as np
from directionalmultigrid import distance, hodge, scale_filter, smooth_field, transport, update
from directionalmultigrid.vtkFiltersDirectionalFields import vtkFieldAngles, vtkFieldSingularities
from layouts import LAYOUTS, Layout
from surfaces import values


def mixed_cells(columns, rows):
    """A rectangle with uneven points, of quadrilaterals and triangles."""
    random = np.random.default_rng(11)
    at = np.array([[i, j, 0.0] for j in range(rows + 1) for i in range(columns + 1)])
    inner = (at[:, 0] > 0) & (at[:, 0] < columns) & (at[:, 1] > 0) & (at[:, 1] < rows)
    at[inner, :2] += random.uniform(-0.2, 0.2, (np.count_nonzero(inner), 2))
    cells = []
    for j in range(rows):
        for i in range(columns):
            a = j * (columns + 1) + i
            b, c, d = a + 1, a + columns + 2, a + columns + 1
            cells += [(a, b, c, d)] if i % 3 else [(a, b, c), (a, c, d)]
    return at / columns, cells


POINTS, CELLS = mixed_cells(12, 9)
CENTRES = np.array([POINTS[list(cell)].mean(0) for cell in CELLS])


def flow(at):
    x, y, _ = at.T
    return np.stack([np.sin(3 * y) + x, np.cos(2 * x) - 0.5 * y, 0 * x], 1)


def directions(at):
    angle = 0.4 * np.sin(3 * at[:, 0]) + at[:, 1]
    return np.stack([np.cos(angle), np.sin(angle), 0 * angle], 1)


def sources(at):
    """Vectors at three places, zero elsewhere."""
    given = np.zeros_like(at)
    for place in ((0.1, 0.1), (0.5, 0.6), (0.9, 0.3)):
        nearest = np.argmin(np.hypot(at[:, 0] - place[0], at[:, 1] - place[1]))
        given[nearest] = flow(at)[nearest]
    return given


def power(vectors, n):
    """What all n directions have in common; vectors are in the plane of the surface."""
    numbers = vectors[:, 0] + 1j * vectors[:, 1]
    return np.stack([(numbers**n).real, (numbers**n).imag, vectors[:, 2]], 1)


def solve(layout, on_points):
    result = smooth_field(layout.data, n=4, Directions="sources", Rotation=30, Tolerance=1e-9)
    return [power(layout.get(result, "Direction0", on), 4) for on in (True, False)]


def along_boundary(layout, on_points):
    result = smooth_field(layout.data, n=1, BoundaryWeight=1, Directions="sources", Tolerance=1e-9)
    return [layout.get(result, "Direction0", True)]


def decompose(layout, on_points):
    result = hodge(layout.data, "flow", Boundary="Open")
    size = layout.scale
    return [size * layout.get(result, "Divergence", True), size * layout.get(result, "Vorticity", True),
            layout.get(result, "StreamFunction", True) / size, layout.get(result, "Potential", True) / size] + [
                layout.get(result, name, False) for name in ("GradientPart", "RotationalPart", "HarmonicPart", "Residual")]


def carry(layout, on_points):
    return [layout.get(transport(layout.data, "sources"), "TransportedVectors", True)]


def measure(layout, on_points):
    filter = vtkFieldAngles()
    filter.SetInputData(layout.data)
    filter.SetNumberOfDirections(1)
    for index, name in enumerate(("directions", "flow")):
        filter.SetInputArrayToProcess(index, 0, 0, 0 if on_points else 1, name)
    return [layout.get(update(filter), "Angle", False)]


def count(layout, on_points):
    filter = vtkFieldSingularities()
    filter.SetInputData(layout.data)
    filter.SetNumberOfDirections(2)
    filter.SetInputArrayToProcess(0, 0, 0, 0 if on_points else 1, "directions")
    update(filter)
    return [values(filter.GetOutputDataObject(2).GetCellData(), "Index"),
            np.array([filter.GetOutputDataObject(0).GetNumberOfPoints()])]


def reach(layout, on_points):
    return [layout.get(distance(layout.data, mask="region"), "Distance", True) / layout.scale]


def filter_scales(layout, on_points):
    result = scale_filter(layout.data, ["flow", "height"], 0.5 * layout.scale, Tolerance=1e-9)
    return [layout.get(result, f"{name} below {0.5 * layout.scale:g}", on_points) for name in ("flow", "height")]


FILTERS = {"distance": reach, "scales": filter_scales, "solver": solve, "boundary": along_boundary, "Hodge": decompose, "transport": carry, "angles": measure, "singularities": count}


class Layouts(unittest.TestCase):
    def results(self, run, on_points, **layout):
        one = Layout(POINTS, CELLS, **layout)
        for name, function in (("flow", flow), ("directions", directions), ("sources", sources)):
            one.add(name, function(POINTS if on_points else CENTRES), on_points)
        at = POINTS if on_points else CENTRES
        one.add("height", np.sin(4 * at[:, 0]) + at[:, 1], on_points, are_vectors=False)
        one.add("region", 1.0 * (np.hypot(at[:, 0] - 0.3, at[:, 1] - 0.4) < 0.15), on_points, are_vectors=False)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # cells that are turned, points that are joined
            return run(one, on_points)

    def test_change_nothing(self):
        for name, run in FILTERS.items():
            for on_points in (True, False):
                expected = self.results(run, on_points)
                for layout, options in LAYOUTS.items():
                    with self.subTest(filter=name, layout=layout, on_points=on_points):
                        is_rough = any(options.get(key) for key in ("single", "small", "offset"))
                        for given, right in zip(self.results(run, on_points, **options), expected):
                            size = np.abs(right).max() + 1e-3
                            np.testing.assert_allclose(given, right, atol=(1e-3 if is_rough else 1e-5) * size)


if __name__ == "__main__":
    unittest.main()
