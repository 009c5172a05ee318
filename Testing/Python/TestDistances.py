"""Distances along surfaces: distance() and shortest_path(), and the filter behind them."""

import unittest

import numpy as np
from directionalmultigrid import FieldError, FieldWarning, distance, shortest_path
from directionalmultigrid.vtkFiltersDirectionalFields import vtkSurfaceDistance
from surfaces import add, values_of_points
from TestConventions import flat
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPlane, vtkPolyData
from vtkmodules.vtkFiltersCore import vtkCutter
from vtkmodules.vtkFiltersSources import vtkPlaneSource, vtkRegularPolygonSource, vtkSphereSource


def values(data, name):
    return vtk_to_numpy(data.GetArray(name))


def sphere(resolution=60):
    source = vtkSphereSource()
    source.SetRadius(1)
    source.SetThetaResolution(resolution)
    source.SetPhiResolution(resolution)
    source.SetOutputPointsPrecision(1)
    source.Update()
    return source.GetOutput()


def plane(cells=12):
    """Quadrilaterals on [-1, 1]^2."""
    source = vtkPlaneSource()
    source.SetOrigin(-1, -1, 0)
    source.SetPoint1(1, -1, 0)
    source.SetPoint2(-1, 1, 0)
    source.SetResolution(cells, cells)
    source.SetOutputPointsPrecision(1)
    source.Update()
    return source.GetOutput()


def points_at(*places):
    data, points = vtkPolyData(), vtkPoints()
    points.SetData(numpy_to_vtk(np.array(places, float), deep=True))
    data.SetPoints(points)
    return data


def line_through(*places):
    data, lines = points_at(*places), vtkCellArray()
    lines.InsertNextCell(len(places), list(range(len(places))))
    data.SetLines(lines)
    return data


def triangles_of(cells):
    """The same points, cut into triangles."""
    data, triangles = vtkPolyData(), vtkCellArray()
    data.SetPoints(cells.GetPoints())
    for k in range(cells.GetNumberOfCells()):
        corners = cells.GetCell(k).GetPointIds()
        for j in range(1, corners.GetNumberOfIds() - 1):
            triangles.InsertNextCell(3, [corners.GetId(0), corners.GetId(j), corners.GetId(j + 1)])
    data.SetPolys(triangles)
    return data


class Distances(unittest.TestCase):
    def test_from_the_point_that_is_given(self):
        surface = sphere()
        result = distance(surface, point=(1, 0.1, 0.2))
        self.assertIs(type(result), type(surface))
        self.assertFalse(surface.GetPointData().HasArray("Distance"))  # the input stays
        start = np.array([1, 0.1, 0.2]) / np.sqrt(1.05)
        exact = np.arccos(np.clip(values_of_points(surface) @ start, -1, 1))
        self.assertLess(np.abs(values(result.GetPointData(), "Distance") - exact).max(), 0.005 * np.pi)
        self.assertEqual(distance(surface).GetPointData().GetScalars().GetName(), "Distance")

    def test_from_points_of_a_dataset_and_from_a_point(self):
        places = values_of_points(plane())
        a, b, c = np.array([-0.71, 0.33, 0]), np.array([0.4, -0.52, 0]), np.array([0.9, 0.9, 0])
        result = distance(plane(), points_at(a, b), point=c).GetPointData()
        each = np.stack([np.linalg.norm(places - source, axis=1) for source in (a, b, c)])
        np.testing.assert_allclose(values(result, "Distance"), each.min(0), atol=1e-8)
        np.testing.assert_array_equal(values(result, "NearestSource"), each.argmin(0))
        away = places - np.stack([a, b, c])[each.argmin(0)]
        np.testing.assert_allclose(values(result, "DirectionFromSource"), away / np.linalg.norm(away, axis=1)[:, None], atol=1e-6)

    def test_from_a_slice_of_the_surface(self):
        """Many lines of two points are one source; its sides have signs, as the line is closed."""
        cut, height = vtkCutter(), vtkPlane()
        height.SetOrigin(0, 0, 0.2)
        height.SetNormal(0, 0, 1)
        surface = sphere()
        cut.SetInputData(surface)
        cut.SetCutFunction(height)
        cut.Update()
        result = distance(surface, cut.GetOutput(), Signed=True)
        latitude = np.arcsin(np.clip(values_of_points(surface)[:, 2], -1, 1)) - np.arcsin(0.2)
        signed = values(result.GetPointData(), "Distance")
        self.assertEqual(values(result.GetFieldData(), "DistanceIsSigned")[0], 1)
        sign = np.sign(signed[latitude > 0.5].mean())  # a slice runs in either direction
        self.assertLess(np.abs(sign * signed - latitude).max(), 0.01)

    def test_from_the_outline_of_a_polygon(self):
        disk = vtkRegularPolygonSource()
        disk.SetNumberOfSides(64)
        disk.SetRadius(0.5)
        disk.SetCenter(0.1, 0, 0)
        disk.GeneratePolylineOff()
        for normal in (1, -1):  # inside is inside, whichever way its corners run
            disk.SetNormal(0, 0, normal)
            disk.Update()
            result = distance(plane(40), disk.GetOutput(), Signed=True)
            exact = np.linalg.norm(values_of_points(plane(40)) - (0.1, 0, 0), axis=1) - 0.5
            self.assertLess(np.abs(values(result.GetPointData(), "Distance") - exact).max(), 0.005)

    def test_from_a_mask_the_boundary_and_sharp_edges(self):
        surface = plane()
        x, y, _ = values_of_points(surface).T
        add(surface.GetPointData(), "left", np.where(x < -0.4, 1.0, 0.0))
        result = distance(surface, mask="left", Signed=True).GetPointData()
        np.testing.assert_allclose(values(result, "Distance"), x + 0.5, atol=1e-8)
        result = distance(surface, Boundary=True).GetPointData()
        self.assertLess(np.abs(values(result, "Distance") - (1 - np.maximum(abs(x), abs(y)))).max(), 0.1 / 6)
        with self.assertRaisesRegex(FieldError, "there is no source of distances"):
            distance(surface, SharpEdges=True, FeatureAngle=40.0)

    def test_lines_of_both_sides(self):
        measure = vtkSurfaceDistance()
        measure.SetInputData(plane(30))
        measure.AddInputDataObject(1, line_through((-1.01, 0.1, 0), (1.01, 0.1, 0)))
        for value in (0.5, 0.25):
            measure.AddOffsetDistance(value)
        measure.Update()
        lines = measure.GetOutputDataObject(1)
        self.assertEqual(lines.GetNumberOfCells(), 4)
        off = np.abs(values_of_points(lines)[:, 1] - 0.1)
        np.testing.assert_allclose(off, values(lines.GetPointData(), "Distance"), atol=1e-6)

    def test_gaps_are_walked_around(self):
        surface = plane(20)
        x, y, _ = values_of_points(surface).T
        add(surface.GetPointData(), "depth", np.where((abs(x) < 0.25) & (y < 0.45), np.nan, 7.0))
        result = distance(surface, point=(-1, -1, 0), gaps="depth").GetPointData()
        island = np.isnan(values(surface.GetPointData(), "depth"))
        np.testing.assert_array_equal(np.isnan(values(result, "Distance")), island)
        corner = np.argmin(abs(x - 1) + abs(y + 1))
        # Over the corners of the island at (-0.3, 0.5) and (0.3, 0.5): cells beside NaN take no part.
        exact = 2 * np.hypot(0.7, 1.5) + 0.6
        self.assertAlmostEqual(values(result, "Distance")[corner], exact, delta=0.01)

    def test_on_a_map_in_kilometres(self):
        grid = flat(np.arange(-180, 181, 4.0), np.linspace(90, -90, 46))
        paris, tokyo = (2.35, 48.86, 0), (139.69, 35.69, 0)
        onEarth = {"Coordinates": "LongitudeAndLatitude", "LengthScale": 6371.0}
        paths = shortest_path(grid, paris, tokyo, **onEarth)
        a, b, c, d = np.radians([*paris[:2], *tokyo[:2]])
        exact = 6371 * np.arccos(np.sin(b) * np.sin(d) + np.cos(b) * np.cos(d) * np.cos(c - a))
        self.assertAlmostEqual(values(paths.GetCellData(), "PathLength")[0], exact, delta=0.005 * exact)
        self.assertGreater(values_of_points(paths)[:, 1].max(), 60)  # over Siberia
        with self.assertRaisesRegex(FieldError, "Maximum Distance is -1"):
            distance(grid, MaximumDistance=-1.0, **onEarth)


class ShortestPaths(unittest.TestCase):
    def test_between_places_numbers_and_datasets(self):
        surface = plane()
        a, b = (-0.91, -0.37, 0), (0.77, 0.65, 0)
        path = shortest_path(surface, a, b)
        along = values_of_points(path)
        np.testing.assert_allclose(along[[0, -1]], [a, b], atol=1e-9)
        length = np.linalg.norm(np.subtract(a, b))
        for name in ("PathLength", "Distance", "StraightLength"):
            np.testing.assert_allclose(values(path.GetCellData(), name), [length], rtol=1e-7)
        np.testing.assert_allclose(np.linalg.norm(np.diff(along, axis=0), axis=1).sum(), length, rtol=1e-6)  # it is straight
        corner = shortest_path(surface, 0, np.int64(12))
        np.testing.assert_allclose(values(corner.GetCellData(), "PathLength"), [2.0])
        several = shortest_path(surface, line_through((-1.01, 0, 0), (1.01, 0, 0)), points_at((0.3, 0.5, 0), (-0.3, -0.75, 0)))
        np.testing.assert_allclose(values(several.GetCellData(), "Distance"), [0.5, 0.75], atol=1e-6)
        lengths = values(several.GetCellData(), "PathLength")  # from where the line crosses an edge: at most half an edge beside
        self.assertTrue((lengths >= (0.5, 0.75)).all() and (lengths < np.hypot((0.5, 0.75), 1 / 12)).all(), lengths)

    def test_is_as_long_back(self):
        surface = triangles_of(sphere(30))
        rng = np.random.default_rng(11)
        for a, b in rng.normal(size=(10, 2, 3)):
            a, b = a / np.linalg.norm(a), b / np.linalg.norm(b)
            there, back = (values(shortest_path(surface, *ends).GetCellData(), "PathLength")[0] for ends in ((a, b), (b, a)))
            self.assertAlmostEqual(there, back, delta=0.002)
            self.assertAlmostEqual(there, np.arccos(np.clip(a @ b, -1, 1)), delta=0.02)

    def test_what_is_no_place_is_refused(self):
        for wrong, error, text in ((1.5, TypeError, "three numbers or a dataset"), ("start", TypeError, "three numbers"),
                                   (True, TypeError, "three numbers"), (169, FieldError, "169 points, from 0 on"),
                                   ((1, 2), FieldError, "has 2 numbers"), (-1, FieldError, "from 0 on")):
            with self.assertRaisesRegex(error, text):
                shortest_path(plane(), wrong, 3)
        with self.assertWarnsRegex(FieldWarning, "1 points, or segments"):
            distance(plane(), points_at((0, 0, 0), (0, 0, 9)))
        for run in (lambda: distance(plane(), Bundary=True), lambda: shortest_path(plane(), 0, 1, Bundary=True)):
            with self.assertRaisesRegex(TypeError, "did you mean Boundary"):
                run()

    def test_no_line_where_no_path_leads(self):
        surface, cells = points_at((0, 0, 0), (1, 0, 0), (0, 1, 0), (5, 0, 0), (6, 0, 0), (5, 1, 0)), vtkCellArray()
        cells.InsertNextCell(3, [0, 1, 2])
        cells.InsertNextCell(3, [3, 4, 5])
        surface.SetPolys(cells)
        self.assertEqual(shortest_path(surface, 0, 4).GetNumberOfCells(), 0)
        self.assertEqual(shortest_path(surface, 0, 1).GetNumberOfCells(), 1)


if __name__ == "__main__":
    unittest.main()
