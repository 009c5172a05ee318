"""Every filter that reads vectors gives the same numbers on one surface, however a file lays it out."""

import unittest
import warnings

import numpy as np
from directionalmultigrid import distance, hodge, scale_filter, smooth_field, transport, update
from directionalmultigrid.vtkFiltersDirectionalFields import vtkFieldAngles, vtkFieldSingularities
from layouts import CELLS, LAYOUTS, POINTS, Layout, centres, directions, mixed_torus
from surfaces import values, values_of_points


def flow(at):
    x, y, z = at.T
    return np.stack([np.sin(3 * y) + x, np.cos(2 * x) - 0.5 * y, 5 * z * x], 1)


def sources(at):
    """Vectors at three places, zero elsewhere."""
    given = np.zeros_like(at)
    for place in ((0.1, 0.1), (0.5, 0.6), (0.9, 0.3)):
        nearest = np.argmin(np.hypot(at[:, 0] - place[0], at[:, 1] - place[1]))
        given[nearest] = flow(at)[nearest]
    return given


def crosses(layout, result, on_points):
    """What all 4 directions have in common: the sums of the 4th powers of their parts along some axes."""
    axes = np.array([[1, 0, 0], [0, 1, 0], [0, 0, 1], [1, 1, 0], [1, -1, 1], [0, 1, 2]]).T
    return sum((layout.get(result, f"Direction{k}", on_points) @ axes)**4 for k in range(4))


def solve(layout, on_points):
    result = smooth_field(layout.data, n=4, Directions="sources", Rotation=30 * layout.side, Tolerance=1e-9, AllDirections=True,
                          UnitLength=True)
    return [crosses(layout, result, on) for on in (True, False)]


def along_boundary(layout, on_points):
    # A boundary has the surface on its left, seen from the positive side. From the other side all is the other way round.
    layout.add("along", layout.side * sources(POINTS if on_points else centres(POINTS, CELLS)), on_points)
    result = smooth_field(layout.data, n=1, BoundaryWeight=1, Directions="along", Tolerance=1e-9)
    return [layout.side * layout.get(result, "Direction0", True)]


def decompose(layout, on_points):
    result = hodge(layout.data, "flow", Boundary="Open")
    size = layout.scale
    return [size * layout.get(result, "Divergence", True), layout.side * size * layout.get(result, "Vorticity", True),
            layout.side * layout.get(result, "StreamFunction", True) / size, layout.get(result, "Potential", True) / size] + [
                layout.get(result, name, False) for name in ("GradientPart", "RotationalPart", "HarmonicPart", "Residual")]


def carry(layout, on_points):
    return [layout.get(transport(layout.data, "sources"), "TransportedVectors", True)]


def measure(layout, on_points):
    filter = vtkFieldAngles()
    filter.SetInputData(layout.data)
    filter.SetNumberOfDirections(1)
    for index, name in enumerate(("directions", "flow")):
        filter.SetInputArrayToProcess(index, 0, 0, 0 if on_points else 1, name)
    return [layout.side * layout.get(update(filter), "Angle", False)]


def count(layout, on_points):
    filter = vtkFieldSingularities()
    filter.SetInputData(layout.data)
    filter.SetNumberOfDirections(2)
    filter.SetInputArrayToProcess(0, 0, 0, 0 if on_points else 1, "directions")
    update(filter)
    points = filter.GetOutputDataObject(0)
    index, places = values(points.GetPointData(), "Index"), layout.own(values_of_points(points).reshape(-1, 3))
    order = np.lexsort(places.round(3).T)
    return [values(filter.GetOutputDataObject(2).GetCellData(), "Index"), index[order], places[order]]


def reach(layout, on_points):
    return [layout.get(distance(layout.data, mask="region"), "Distance", True) / layout.scale]


def filter_scales(layout, on_points):
    result = scale_filter(layout.data, ["flow", "height"], 0.5 * layout.scale, Tolerance=1e-9)
    return [layout.get(result, f"{name} below {0.5 * layout.scale:g}", on_points) for name in ("flow", "height")]


FILTERS = {"distance": reach, "scales": filter_scales, "solver": solve, "Hodge": decompose, "transport": carry, "angles": measure,
           "singularities": count}
SURFACES = {  # points, polygons, whether it is closed, filters
    "rectangle": (POINTS, CELLS, False, {**FILTERS, "boundary": along_boundary}),
    "torus": (*mixed_torus(17, 10), True, FILTERS),
}


class Layouts(unittest.TestCase):
    def results(self, run, surface, on_points, **options):
        layout = Layout(*surface, **options)
        at = surface[0] if on_points else centres(*surface[:2])
        for name, function in (("flow", flow), ("directions", directions), ("sources", sources)):
            layout.add(name, function(at), on_points)
        layout.add("height", np.sin(4 * at[:, 0]) + at[:, 1], on_points, are_vectors=False)
        layout.add("region", 1.0 * (np.hypot(at[:, 0] - 0.3, at[:, 1] - 0.4) < 0.15), on_points, are_vectors=False)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # cells that are turned, points that are joined
            return run(layout, on_points)

    def check(self, run, surface, on_points):
        expected = self.results(run, surface, on_points)
        for layout, options in LAYOUTS.items():
            with self.subTest(layout=layout, on_points=on_points):
                is_rough = any(options.get(key) for key in ("single", "small", "offset"))
                for given, right in zip(self.results(run, surface, on_points, **options), expected):
                    size = np.abs(right).max(initial=0) + 1e-3
                    if run in (reach, carry) and surface[2] and layout.startswith("mirrored"):
                        # Where a surface bends, the wavefront takes other turns in its mirror image, some thousandths longer, and other sides
                        # of a hole where both are as far.
                        self.assertLess(np.percentile(np.abs(given - right), 75), 0.03 * size)
                        continue
                    np.testing.assert_allclose(given, right, atol=(1e-3 if is_rough else 1e-5) * size)

    def test_change_nothing(self):
        for name, (*surface, filters) in SURFACES.items():
            for filter, run in filters.items():
                for on_points in (True, False):
                    with self.subTest(surface=name, filter=filter):
                        self.check(run, surface, on_points)


if __name__ == "__main__":
    unittest.main()
