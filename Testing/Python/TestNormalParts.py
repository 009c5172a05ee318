"""A part of vectors along the normal, as of 3-D winds and tractions, changes no result along the surface."""

import unittest
import warnings

import numpy as np
from directionalmultigrid import hodge, scale_filter, smooth_field, transport, update
from directionalmultigrid.vtkFiltersDirectionalFields import vtkFieldAngles, vtkFieldLines, vtkFieldSingularities
from surfaces import add, corners, surface, values, values_of_points
from vtkmodules.vtkFiltersCore import vtkTriangleFilter
from vtkmodules.vtkFiltersModeling import vtkLoopSubdivisionFilter
from vtkmodules.vtkFiltersSources import vtkPlatonicSolidSource

AXIS = np.array([0.6, 0.0, 0.8])


def uneven_sphere():
    """Points on the unit sphere, moved along it by up to a fifth of an edge, and triangles of some sizes."""
    solid = vtkPlatonicSolidSource()
    solid.SetSolidTypeToIcosahedron()
    triangles, finer = vtkTriangleFilter(), vtkLoopSubdivisionFilter()
    triangles.SetInputConnection(solid.GetOutputPort())
    finer.SetInputConnection(triangles.GetOutputPort())
    finer.SetNumberOfSubdivisions(3)
    finer.Update()
    points = values_of_points(finer.GetOutput())
    points = points / np.linalg.norm(points, axis=1)[:, None] + np.random.default_rng(4).uniform(-0.03, 0.03, points.shape)
    return points / np.linalg.norm(points, axis=1)[:, None], corners(finer.GetOutput())


POINTS, TRIANGLES = uneven_sphere()
CENTRES = POINTS[TRIANGLES].mean(1)


class NormalParts(unittest.TestCase):
    def data(self, on_points, part):
        """The sphere with directions to the east, a rotation and two sources, and a part along the normal."""
        places = POINTS if on_points else CENTRES
        normals = places / np.linalg.norm(places, axis=1)[:, None]
        facets = normals if on_points else np.cross(*(POINTS[TRIANGLES[:, k]] - POINTS[TRIANGLES[:, 0]] for k in (1, 2)))
        facets = facets / np.linalg.norm(facets, axis=1)[:, None]  # cells have their own normals, as pressure on them has
        east = np.cross([0, 0, 1], normals)
        data = surface(POINTS, TRIANGLES)
        attributes = data.GetPointData() if on_points else data.GetCellData()
        directions = east / np.linalg.norm(east, axis=1)[:, None] + part * facets
        add(attributes, "east", directions)
        add(attributes, "rotation", np.cross(AXIS, normals) + part * facets)
        sources = np.zeros_like(directions)
        sources[[3, len(sources) // 2]] = directions[[3, len(sources) // 2]]
        add(attributes, "sources", sources)
        return data

    def filter(self, one, on_points, part, name, n=1):
        one.SetInputData(self.data(on_points, part))
        one.SetNumberOfDirections(n)
        one.SetInputArrayToProcess(0, 0, 0, 0 if on_points else 1, name)
        return update(one)

    def check(self, run):
        for on_points in (True, False):
            expected = run(on_points, 0)
            for part in (10, 100):
                with self.subTest(on_points=on_points, part=part):
                    for given, right in zip(run(on_points, part), expected):
                        np.testing.assert_allclose(given, right, atol=1e-6 * np.abs(right).max())

    def test_along_the_axis_are_turns(self):
        for on_points in (True, False):
            for part in (0, 100):
                output = self.filter(vtkFieldAngles(), on_points, part, "east")
                angles = np.abs(values(output.GetCellData(), "Angle"))[np.abs(CENTRES[:, 2]) < 0.8]
                self.assertLess(np.abs(angles - 90).max(), 5)  # east is perpendicular to the axis, up to the size of triangles

    def test_singularities_are_the_poles(self):
        for on_points in (True, False):
            for part in (0, 100):
                points = self.filter(vtkFieldSingularities(), on_points, part, "east")
                np.testing.assert_array_equal(values(points.GetPointData(), "Index"), [1, 1])
                self.assertGreater(np.abs(values_of_points(points)[:, 2]).min(), 0.98)

    def test_angles(self):
        self.check(lambda *given: [values(self.filter(vtkFieldAngles(), *given, "east").GetCellData(), "Angle")])

    def test_lines(self):
        self.check(lambda *given: [np.array([self.filter(vtkFieldLines(), *given, "east", 2).GetNumberOfLines()])])

    def test_flows(self):
        def decompose(*given):
            result = hodge(self.data(*given), "rotation")
            return [values(result.GetPointData(), name) for name in ("Divergence", "Vorticity", "StreamFunction")]

        for on_points in (True, False):
            divergence, vorticity, _ = decompose(on_points, 100)
            self.assertLess(np.abs(divergence).mean(), 0.03)
            self.assertLess(np.abs(vorticity - 2 * POINTS @ AXIS).mean(), 0.03)
        self.check(decompose)

    def test_scales(self):
        def split(*given):
            result = scale_filter(self.data(*given), ["rotation"], 0.5)
            return [values(result.GetPointData() if given[0] else result.GetCellData(), "rotation below 0.5")]

        self.check(split)

    def test_transport(self):
        self.check(lambda *given: [values(transport(self.data(*given), "sources").GetPointData(), "TransportedVectors")])

    def test_solver(self):
        self.check(lambda *given: [values(smooth_field(self.data(*given), n=2, Directions="sources", Tolerance=1e-10).GetPointData(),
                                          "Direction0")])

    def test_guides(self):
        """Vectors of guides stand between points: at the surface's normal there, which is that of the sphere."""

        def follow(_, part):
            places = np.array([[0.3, 0.5, 0.2], [-0.2, 0.7, -0.4], [0.1, -0.6, 0.5]])
            places /= np.linalg.norm(places, axis=1)[:, None]
            guides = surface(places, [])
            add(guides.GetPointData(), "Wind", np.cross([0, 0, 1], places) + part * places)
            guides.GetPointData().SetActiveVectors("Wind")
            result = smooth_field(surface(POINTS, TRIANGLES), guides, n=2, Tolerance=1e-10, UnitLength=True)
            return values(result.GetPointData(), "Direction0")

        expected = follow(True, 0)
        cosines = np.abs((follow(True, 3) * expected).sum(1))
        self.assertLess(np.degrees(np.arccos(np.minimum(cosines, 1))).max(), 0.5)  # by normals of faces 5 to 10


if __name__ == "__main__":
    with warnings.catch_warnings():
        warnings.simplefilter("ignore")
        unittest.main()
