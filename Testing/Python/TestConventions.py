"""Results do not depend on how a file stores its data: order of rows, maps, land, polygons, doubled points, holes."""

import os
import tempfile
import unittest
import warnings

import numpy as np
from directionalmultigrid import (FieldError, FieldWarning, distance, hodge, quads, smooth_field, transport, update, write_raw_field, write_rosy,
                                  write_sharp)
from directionalmultigrid.vtkFiltersDirectionalFields import (vtkFieldAngles, vtkFieldLines, vtkFieldSingularities, vtkHarmonicFieldSolver,
                                                             vtkHodgeDecomposition, vtkPrincipalDirections)
from surfaces import add, surface, values
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import (vtkCellArray, vtkImageData, vtkMultiBlockDataSet, vtkPlane, vtkPolyData, vtkRectilinearGrid,
                                           vtkStructuredGrid)
from vtkmodules.vtkFiltersCore import vtkAppendFilter, vtkCutter, vtkDelaunay3D
from vtkmodules.vtkFiltersGeometry import vtkGeometryFilter
from vtkmodules.vtkFiltersSources import vtkTexturedSphereSource


def globe(longitudes, latitudes):
    """A vtkStructuredGrid on the unit sphere, and its points."""
    longitude, latitude = np.meshgrid(np.radians(longitudes), np.radians(latitudes))
    grid, points = vtkStructuredGrid(), vtkPoints()
    grid.SetDimensions(len(longitudes), len(latitudes), 1)
    xyz = np.stack([np.cos(latitude) * np.cos(longitude), np.cos(latitude) * np.sin(longitude), np.sin(latitude)], -1).reshape(-1, 3)
    points.SetData(numpy_to_vtk(xyz, deep=True))
    grid.SetPoints(points)
    return grid, xyz


def east_and_north(xyz, vectors):
    longitude, latitude = np.arctan2(xyz[:, 1], xyz[:, 0]), np.arcsin(np.clip(xyz[:, 2], -1, 1))
    east = np.stack([-np.sin(longitude), np.cos(longitude), 0 * longitude], 1)
    north = np.stack([-np.sin(latitude) * np.cos(longitude), -np.sin(latitude) * np.sin(longitude), np.cos(latitude)], 1)
    return (vectors * east).sum(1), (vectors * north).sum(1)


def flat(longitudes, latitudes):
    """A map as ParaView's reader of netCDF leaves it without spherical coordinates."""
    grid = vtkRectilinearGrid()
    grid.SetDimensions(len(longitudes), len(latitudes), 1)
    for axis, numbers in (("X", longitudes), ("Y", latitudes), ("Z", [0.0])):
        getattr(grid, f"Set{axis}Coordinates")(numpy_to_vtk(np.ascontiguousarray(numbers, float), deep=True))
    return grid


def image(nx, ny, vectors, spacing=1.0):
    grid = vtkImageData()
    grid.SetDimensions(nx, ny, 1)
    grid.SetSpacing(spacing, spacing, 1)
    x, y = (each.ravel() for each in np.meshgrid(np.arange(nx) * spacing, np.arange(ny) * spacing))
    add(grid.GetPointData(), "U", vectors(x, y))
    return grid, x, y


def polygons(points, cells):
    data, at, array = vtkPolyData(), vtkPoints(), vtkCellArray()
    at.SetData(numpy_to_vtk(np.ascontiguousarray(points, float), deep=True))
    for cell in cells:
        array.InsertNextCell(len(cell), [int(each) for each in cell])
    data.SetPoints(at)
    data.SetPolys(array)
    return data


class OrderOfRows(unittest.TestCase):
    def test_a_globe_has_the_same_signs_from_south_and_from_north(self):
        for latitudes in (np.linspace(-90, 90, 37), np.linspace(90, -90, 37)):
            grid, xyz = globe(np.linspace(0, 360, 73), latitudes)
            add(grid.GetPointData(), "u", np.hypot(xyz[:, 0], xyz[:, 1]))  # to the east, as the Earth turns
            add(grid.GetPointData(), "v", 0 * xyz[:, 0])
            result = hodge(grid, eastward="u", northward="v")
            data = result.GetPointData()
            np.testing.assert_allclose(values(data, "Vorticity"), 2 * xyz[:, 2], atol=0.03)
            np.testing.assert_allclose(values(data, "StreamFunction"), -xyz[:, 2], atol=0.01)
            self.assertEqual(result.GetFieldData().GetAbstractArray("PositiveSide").GetValue(0), "the outside")
            angles = values(transport(grid, point=(1, 0, 0), direction=(0, 1, 0)).GetPointData(), "GeodesicAngle")
            self.assertAlmostEqual(angles[np.argmin(np.abs(xyz[:, 2] - 0.7) + np.abs(xyz[:, 1]) - xyz[:, 0])], 90, delta=2)

    def test_a_part_of_a_globe_too(self):
        for latitudes in (np.linspace(20, 50, 31), np.linspace(50, 20, 31)):
            grid, xyz = globe(np.linspace(-100, -60, 41), latitudes)
            add(grid.GetPointData(), "u", np.hypot(xyz[:, 0], xyz[:, 1]))
            add(grid.GetPointData(), "v", 0 * xyz[:, 0])
            data = hodge(grid, eastward="u", northward="v", Boundary="Open").GetPointData()
            np.testing.assert_allclose(values(data, "Vorticity"), 2 * xyz[:, 2], atol=0.03)

    def test_a_plane_has_the_same_signs_from_below_and_from_above(self):
        for order in (1, -1):
            x, y = np.linspace(-1, 1, 21), np.linspace(-1, 1, 21)[::order]
            grid = flat(x, y)
            x, y = (each.ravel() for each in np.meshgrid(x, y))
            add(grid.GetPointData(), "U", np.stack([-y, x, 0 * x], 1))
            np.testing.assert_allclose(values(hodge(grid, "U").GetPointData(), "Vorticity"), 2, atol=1e-9)

    def test_a_slice_has_them_whatever_its_normal(self):
        volume = vtkImageData()
        volume.SetDimensions(9, 9, 9)
        x, y, z = (np.array([volume.GetPoint(k)[axis] for k in range(volume.GetNumberOfPoints())]) for axis in range(3))
        add(volume.GetPointData(), "U", np.stack([-y, x, 0 * z], 1))
        for normal in ((0, 0, 1), (0, 0, -1)):
            plane, cutter = vtkPlane(), vtkCutter()
            plane.SetOrigin(0.3, 0.2, 4.1)
            plane.SetNormal(*normal)
            cutter.SetCutFunction(plane)
            cutter.SetInputData(volume)
            cutter.Update()
            np.testing.assert_allclose(values(hodge(cutter.GetOutput(), "U").GetPointData(), "Vorticity"), 2, atol=1e-5)


    def test_of_cells_changes_neither_angles_nor_lines(self):
        at = np.array([[i, j, 0.0] for j in range(6) for i in range(6)])
        triangles = np.array([t for j in range(5) for i in range(5) for a in [j * 6 + i] for t in ((a, a + 1, a + 7), (a, a + 7, a + 6))])
        for cells in (triangles, triangles[:, ::-1]):
            data = surface(at, cells)
            add(data.GetCellData(), "D", np.tile([np.cos(0.3), np.sin(0.3), 0], (len(cells), 1)))
            angles = vtkFieldAngles()
            angles.SetInputData(data)
            angles.SetInputArrayToProcess(0, 0, 0, 1, "D")
            angles.SetNumberOfDirections(1)
            angles.SetAxis(1, 0, 0)
            angles.Update()
            np.testing.assert_allclose(values(angles.GetOutput().GetCellData(), "Angle"), np.degrees(0.3), atol=1e-9)
            add(data.GetPointData(), "U", np.stack([2.5 - at[:, 1], at[:, 0] - 2.5, 0 * at[:, 0]], 1))
            flow = vtkHodgeDecomposition()
            flow.SetInputData(data)
            flow.SetInputArrayToProcess(0, 0, 0, 0, "U")
            flow.SetNumberOfContours(4)
            flow.Update()
            lines = flow.GetOutput(1)
            points = vtk_to_numpy(lines.GetPoints().GetData())[:, :2] - 2.5
            start, end = vtk_to_numpy(lines.GetLines().GetConnectivityArray())[:2]
            self.assertGreater(np.cross(points[start], points[end]), 0)  # counter-clockwise, as the flow


class Sides(unittest.TestCase):
    """Rotations, boundaries, the order of directions, normal parts and curvatures are seen from the positive side of the shape, whatever the
    order of the cells' corners."""

    def test_of_a_globe_are_the_same_from_south_and_from_north(self):
        for latitudes in (np.linspace(-80, 80, 41), np.linspace(80, -80, 41)):
            grid, xyz = globe(np.linspace(0, 360, 73), latitudes)
            east = np.stack([-xyz[:, 1], xyz[:, 0], 0 * xyz[:, 2]], 1)
            speed = np.linalg.norm(east, axis=1)
            add(grid.GetPointData(), "Wind", east)
            turned = smooth_field(grid, n=1, Directions="Wind", Rotation=30)
            vectors = values(turned.GetPointData(), "Direction0")
            up = np.einsum("ij,ij->i", xyz, np.cross(east, vectors))
            angles = np.degrees(np.arctan2(up, np.einsum("ij,ij->i", east, vectors)))[speed > 0.3]
            self.assertLess(np.abs(np.median(angles) - 30), 1)
            along = values(smooth_field(grid, n=1, BoundaryWeight=1).GetPointData(), "Direction0")
            north = np.abs(xyz[:, 2] - np.sin(np.radians(80))) < 1e-6
            eastward = np.einsum("ij,ij->i", along, east)[north] / speed[north] / np.linalg.norm(along[north], axis=1)
            np.testing.assert_allclose(eastward, -1, atol=0.01)  # with the surface on the left
            add(grid.GetPointData(), "Outwards", 0.8 * xyz + east)
            with warnings.catch_warnings():
                warnings.simplefilter("ignore", FieldWarning)  # the part along the normal is told at the rims
                outwards = values(hodge(grid, "Outwards").GetCellData(), "NormalComponent")
            self.assertLess(np.abs(np.median(outwards) - 0.8), 0.01)
            bent = vtkPrincipalDirections()
            bent.SetInputData(grid)
            self.assertLess(np.abs(np.median(values(update(bent).GetCellData(), "MaximumCurvature")) - 1), 0.05)

    def test_of_planes_and_tubes_are_those_of_their_shape(self):
        angles, heights = np.linspace(0, 2 * np.pi, 40, endpoint=False), np.linspace(0, 3, 16)
        tube = np.stack([np.tile(np.cos(angles), 16), np.tile(np.sin(angles), 16), np.repeat(heights, 40)], 1)
        square = np.stack([np.tile(np.linspace(-1, 1, 16), 16), np.repeat(np.linspace(-1, 1, 16), 16), np.zeros(256)], 1)

        def quads(across, wraps):
            at = lambda i, j: j * across + i % across
            return [[at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)] for j in range(15) for i in range(across - (not wraps))]

        for turn in (1, -1):
            bent = vtkPrincipalDirections()
            bent.SetInputData(polygons(tube, [quad[::turn] for quad in quads(40, True)]))
            result = update(bent)
            np.testing.assert_allclose(np.median(values(result.GetCellData(), "MaximumCurvature")), 1, atol=0.1)
            self.assertLess(np.abs(values(result.GetCellData(), "MaximumDirection")[:, 2]).max(), 0.1)
            plane = polygons(square, [quad[::turn] for quad in quads(16, False)])
            add(plane.GetPointData(), "Along", np.tile((1.0, 0, 0), (256, 1)))
            crosses = smooth_field(plane, n=4, Directions="Along", AllDirections=True)
            first, second = (values(crosses.GetPointData(), name) for name in ("Direction0", "Direction1"))
            np.testing.assert_allclose(np.cross(first, second), np.tile((0, 0, 1), (256, 1)), atol=1e-3)
            turned = values(smooth_field(plane, n=1, Directions="Along", Rotation=30).GetPointData(), "Direction0")
            np.testing.assert_allclose(turned, np.tile((np.sqrt(0.75), 0.5, 0), (256, 1)), atol=1e-3)

    def test_of_powers_on_cells_are_in_the_frames_of_their_own_corners(self):
        """The N-th power of a direction in the frame whose first axis is along the first side of the cell, its normal that of the corners."""
        at = np.array([[i, j, 0.0] for j in range(7) for i in range(7)])
        triangles = np.array([t for j in range(6) for i in range(6) for a in [j * 7 + i] for t in ((a, a + 1, a + 8), (a, a + 8, a + 7))])
        angle = 0.3
        for corners in (triangles, triangles[:, ::-1]):
            data = surface(at, corners)
            add(data.GetPointData(), "D", np.tile([np.cos(angle), np.sin(angle), 0], (len(at), 1)))
            side = at[corners[:, 1]] - at[corners[:, 0]]
            turn = 1 if corners is triangles else -1
            for n in (1, 2, 3, 4):
                for kind in ("PowerField", "PointPowerField"):
                    with warnings.catch_warnings():
                        warnings.simplefilter("ignore", FieldWarning)  # triangles of grids are sheared
                        field = smooth_field(data, n=n, Directions="D", Discretisation=kind)
                    powers = values(field.GetCellData(), "PowerField") @ [1, 1j]
                    expected = np.exp(1j * n * turn * (angle - np.arctan2(side[:, 1], side[:, 0])))
                    np.testing.assert_allclose(powers / np.abs(powers), expected, atol=1e-6)


class Derivatives(unittest.TestCase):
    def test_of_linear_flows_are_exact_at_corners_and_in_strips(self):
        for nx, ny in ((11, 11), (11, 2)):
            grid, _, _ = image(nx, ny, lambda x, y: np.stack([x, y, 0 * x], 1))
            np.testing.assert_allclose(values(hodge(grid, "U").GetPointData(), "Divergence"), 2, atol=1e-9)

    def test_of_cells_are_exact_on_quadrilaterals_that_are_no_rectangles(self):
        n = 12
        points = np.array([[i, j, 0.0] for j in range(n + 1) for i in range(n + 1)])
        points[:, :2] += np.random.default_rng(0).uniform(-0.1, 0.1, (len(points), 2))
        cells = [[j * (n + 1) + i, j * (n + 1) + i + 1, (j + 1) * (n + 1) + i + 1, (j + 1) * (n + 1) + i] for j in range(n) for i in range(n)]
        data = polygons(points, cells)
        centres = points[np.array(cells)].mean(1)
        add(data.GetCellData(), "U", np.stack([-3 * centres[:, 1], centres[:, 0] + 2 * centres[:, 1], 0 * centres[:, 0]], 1))
        result = hodge(data, "U", Boundary="Open").GetPointData()
        np.testing.assert_allclose(values(result, "Vorticity"), 4, atol=1e-9)
        np.testing.assert_allclose(values(result, "Divergence"), 2, atol=1e-9)


class Signs(unittest.TestCase):
    def test_of_vectors_that_are_carried_are_not_doubted_on_solids_with_few_faces(self):
        random = np.random.default_rng(1)
        for _ in range(20):
            at = random.normal(size=(4, 3)).round(2)
            with warnings.catch_warnings(record=True) as said:
                warnings.simplefilter("always")
                transport(surface(at, [(0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3)]))
            self.assertFalse([each for each in said if "no sign" in str(each.message)])


class Gaps(unittest.TestCase):
    """Directions that were not measured, NaN or zero: a hole in the data is a loop with an index, as a boundary is."""

    def square(self, directions, hole, on_points=True, n=40):
        at = np.array([[i, j, 0.0] for j in range(n) for i in range(n)]) * 2 / (n - 1) - [1, 1, 0]
        triangles = np.array([t for j in range(n - 1) for i in range(n - 1) for a in [j * n + i]
                              for t in ((a, a + 1, a + n + 1), (a, a + n + 1, a + n))])
        data = surface(at, triangles)
        places = at if on_points else at[triangles].mean(1)
        numbers = directions(places[:, 0], places[:, 1])
        numbers[np.hypot(places[:, 0], places[:, 1]) < 0.3] = hole
        add(data.GetPointData() if on_points else data.GetCellData(), "d", numbers)
        return data

    def singularities(self, data, n, on_points):
        filter = vtkFieldSingularities()
        filter.SetInputData(data)
        filter.SetNumberOfDirections(n)
        filter.SetInputArrayToProcess(0, 0, 0, 0 if on_points else 1, "d")
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", FieldWarning)  # numbers that are not finite are counted
            update(filter)
        balls, loops = filter.GetOutputDataObject(0), filter.GetOutputDataObject(2)
        indices = values(balls.GetPointData(), "Index") if balls.GetNumberOfPoints() else np.zeros(0)
        self.assertAlmostEqual(values(balls.GetFieldData(), "SumOfIndices")[0], values(balls.GetFieldData(), "EulerCharacteristic")[0])
        return indices, sorted(values(loops.GetCellData(), "Index"))

    def test_of_a_parallel_field_are_loops_without_a_singularity(self):
        for n in (1, 2, 4):
            for hole in (np.nan, 0.0):
                for on_points in (True, False):
                    data = self.square(lambda x, y: np.tile([0.8, 0.6, 0], (len(x), 1)), hole, on_points)
                    balls, loops = self.singularities(data, n, on_points)
                    self.assertEqual(len(balls), 0)
                    np.testing.assert_allclose(loops, [-1, 1])

    def test_over_a_core_have_its_index(self):
        """The boundary's tangent turns once around the hole the other way, -1, and the field by 1/2."""
        def half(x, y):
            angle = np.arctan2(y, x) / 2
            return np.stack([np.cos(angle), np.sin(angle), 0 * x], 1)

        balls, loops = self.singularities(self.square(half, np.nan), 2, True)
        self.assertEqual(len(balls), 0)
        np.testing.assert_allclose(loops, [-0.5, 0.5])

    def test_of_one_cell_are_singularities_there(self):
        def vortex(x, y):
            vectors = np.stack([-y, x, 0 * x], 1)
            vectors[np.hypot(x, y) < 0.04] = 0
            return vectors

        at = np.array([[i, j, 0.0] for j in range(12) for i in range(12)]) * 2 / 11 - [1, 1, 0]
        cells = [(a, a + 1, a + 13, a + 12) for j in range(11) for i in range(11) for a in [12 * j + i]]
        data = polygons(at, cells)
        add(data.GetCellData(), "d", vortex(*at[np.array(cells)].mean(1)[:, :2].T))
        balls, loops = self.singularities(data, 1, False)
        np.testing.assert_allclose(balls, [1])
        np.testing.assert_allclose(loops, [0])

    def test_are_filled_by_the_smoothest_crosses_for_quads(self):
        for hole in (np.nan, 0.0):
            data = self.square(lambda x, y: np.tile([1.0, 0, 0], (len(x), 1)), hole)
            with warnings.catch_warnings():
                warnings.simplefilter("ignore", FieldWarning)
                mesh = quads(data, 400, directions="d")
            self.assertEqual(np.count_nonzero(values(mesh.GetPointData(), "Irregular")), 0)
            self.assertEqual(values(mesh.GetFieldData(), "Singularities")[0], 0)


class NormalParts(unittest.TestCase):
    """Vectors with a part along the normal, as tractions: what is tangential is decomposed, whatever that part is."""

    def sphere(self, n, part):
        k = np.arange(n) + 0.5
        polar, azimuth = np.arccos(1 - 2 * k / n), np.pi * (1 + 5 ** 0.5) * k
        at = np.stack([np.cos(azimuth) * np.sin(polar), np.sin(azimuth) * np.sin(polar), np.cos(polar)], 1)
        at += 0.25 * n ** -0.5 * np.random.default_rng(7).normal(size=at.shape)
        at /= np.linalg.norm(at, axis=1)[:, None]
        hull = vtkDelaunay3D()
        hull.SetInputData(polygons(at, []))
        skin = vtkGeometryFilter()
        skin.SetInputConnection(hull.GetOutputPort())
        skin.Update()
        data = skin.GetOutput()
        at = vtk_to_numpy(data.GetPoints().GetData()).astype(float)
        add(data.GetPointData(), "traction", np.cross([0, 0, 1.0], at) + part * at)
        return data, at

    def test_leave_no_divergence_on_spheres(self):
        for part in (0, 3, 100):
            data, at = self.sphere(2000, part)
            result = hodge(data, "traction")
            self.assertLess(np.abs(values(result.GetPointData(), "Divergence")).mean(), 0.02)
            self.assertLess(np.abs(values(result.GetPointData(), "Vorticity") - 2 * at[:, 2]).mean(), 0.02)
            self.assertAlmostEqual(np.median(values(result.GetCellData(), "NormalComponent")), part, delta=0.01 * part + 1e-3)

    def test_are_told_at_a_rim(self):
        angle, height = np.meshgrid(np.linspace(0, np.pi / 2, 13), np.linspace(0, 2, 25))
        at = np.stack([np.cos(angle).ravel(), np.sin(angle).ravel(), height.ravel()], 1)
        cells = [(a, a + 1, a + 14, a + 13) for j in range(24) for i in range(12) for a in [13 * j + i]]
        for part in (0, 3):
            data = polygons(at, cells)
            add(data.GetPointData(), "traction", [0, 0, 1] + part * at * [1, 1, 0])
            with warnings.catch_warnings(record=True) as said:
                warnings.simplefilter("always")
                divergence = values(hodge(data, "traction").GetPointData(), "Divergence")
            self.assertEqual(["along the normal are 3 times" in str(each.message) for each in said], [True] * (part > 0))
            inner = (angle.ravel() > 0.2) & (angle.ravel() < 1.3)
            self.assertLess(np.abs(divergence[inner]).max(), 0.01)


class Poles(unittest.TestCase):
    """Quadrilaterals with a corner twice: the data of cells stand at the mean of the corners as they are written."""

    def test_of_a_disc_are_exact_in_the_middle(self):
        r, t = np.meshgrid(np.linspace(0, 1, 5), np.linspace(0, 2 * np.pi, 17))  # the spokes end at points of their own
        at = np.stack([(r * np.cos(t)).ravel(), (r * np.sin(t)).ravel(), 0 * r.ravel()], 1)
        quads = np.array([[a, a + 1, a + 6, a + 5] for i in range(16) for j in range(4) for a in [5 * i + j]])
        once = np.where(quads % 5 == 0, 0, quads)
        for cells in (quads, once):
            data = polygons(at, cells)
            x, y, _ = at[cells].mean(1).T
            add(data.GetCellData(), "U", np.stack([x - 0.7 * y, 2 * x + y, 0 * x], 1))
            result = hodge(data, "U", Boundary="Open").GetPointData()
            used = np.unique(cells)
            np.testing.assert_allclose(values(result, "Divergence")[used], 2, atol=1e-6)
            np.testing.assert_allclose(values(result, "Vorticity")[used], 2.7, atol=1e-6)

    def test_under_cells_that_reach_over_them_are_places_of_data(self):
        """Cells of a step around values at the poles, as readers make them: an eastward flow has its vorticity there."""
        for n in (36, 72):
            longitudes, latitudes = np.linspace(0, 360, n + 1), np.linspace(-90 - 180 / n, 90 + 180 / n, n // 2 + 2)
            grid, xyz = globe(longitudes, latitudes)
            centres = np.radians((latitudes[1:] + latitudes[:-1]) / 2)
            add(grid.GetCellData(), "u", np.repeat(np.cos(centres), n))
            add(grid.GetCellData(), "v", np.zeros(n * (n // 2 + 1)))
            vorticity = values(hodge(grid, eastward="u", northward="v").GetPointData(), "Vorticity")
            inner = np.repeat(np.abs(latitudes) < 90, n + 1)
            self.assertLess(np.abs(vorticity - 2 * xyz[:, 2])[inner].max(), 0.03)

    def test_of_a_globe_converge(self):
        for axis in ((0, 0, 1.0), (1.0, 0, 0)):
            errors = []
            for n in (36, 72, 144):
                longitudes, latitudes = np.linspace(0, 360, n + 1), np.linspace(-90, 90, n // 2 + 1)
                grid, xyz = globe(longitudes, latitudes)
                _, centres = globe((longitudes[1:] + longitudes[:-1]) / 2, (latitudes[1:] + latitudes[:-1]) / 2)
                for name, numbers in zip("uv", east_and_north(centres, np.cross(axis, centres))):
                    add(grid.GetCellData(), name, numbers)
                vorticity = values(hodge(grid, eastward="u", northward="v").GetPointData(), "Vorticity")
                errors.append(np.abs(vorticity - 2 * xyz @ axis).max())
            self.assertLess(errors[0], 0.1)
            self.assertLess(errors[2], 0.6 * errors[1])


class EastwardAndNorthward(unittest.TestCase):
    def test_at_the_poles_the_flow_is_that_of_the_neighbours(self):
        grid, xyz = globe(np.linspace(0, 360, 73), np.linspace(-90, 90, 37))
        u, v = east_and_north(xyz, np.cross([1.0, 0, 0], xyz))  # across the poles
        add(grid.GetPointData(), "u", u)
        add(grid.GetPointData(), "v", v)
        result = hodge(grid, eastward="u", northward="v")
        np.testing.assert_allclose(values(result.GetPointData(), "StreamFunction"), -xyz[:, 0], atol=0.01)
        np.testing.assert_allclose(values(result.GetPointData(), "Vorticity"), 2 * xyz[:, 0], atol=0.1)

    def test_in_a_plane_are_refused_with_the_remedy(self):
        grid = flat(np.linspace(-100, -60, 41), np.linspace(20, 50, 31))
        add(grid.GetPointData(), "u", np.full(41 * 31, 10.0))
        add(grid.GetPointData(), "v", np.zeros(41 * 31))
        with self.assertRaisesRegex(FieldError, "Longitude and Latitude in Degrees"):
            hodge(grid, eastward="u", northward="v")

    def test_are_carried_and_followed_as_the_vectors_that_they_are_of(self):
        grid, xyz = globe(np.arange(0, 361, 10.0), np.linspace(-80, 80, 17))
        given = np.zeros_like(xyz)
        sources = (40, 300, 577)
        given[list(sources)] = np.cross(xyz[list(sources)], (0.3, -0.5, 0.8))  # tangential
        for name, numbers in zip("uv", east_and_north(xyz, given)):
            add(grid.GetPointData(), name, numbers)
        add(grid.GetPointData(), "w", given)
        for expected, result, name in (
                (transport(grid, "w"), transport(grid, eastward="u", northward="v"), "TransportedVectors"),
                (smooth_field(grid, n=1, Directions="w"), smooth_field(grid, n=1, Eastward="u", Northward="v"), "Direction0")):
            np.testing.assert_allclose(values(result.GetPointData(), name), values(expected.GetPointData(), name), atol=1e-9)

    def test_turn_with_the_axis_where_they_are_carried(self):
        """About x, east at (0, 0, 1) is x cross z = -y."""
        grid, xyz = globe(np.arange(0, 361, 10.0), np.linspace(-90, 90, 19))
        add(grid.GetPointData(), "u", np.where(np.arange(len(xyz)) >= 37 * 18, 1.0, 0.0))
        add(grid.GetPointData(), "v", np.zeros(len(xyz)))
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", FieldWarning)  # the rows of the poles are points that are there often
            carried = values(transport(grid, eastward="u", northward="v", Axis=(1, 0, 0)).GetPointData(), "TransportedVectors")
        np.testing.assert_allclose(carried[37 * 18], (0, -1, 0), atol=1e-6)

    def test_in_a_plane_are_refused_by_all_filters(self):
        grid = flat(np.linspace(-100, -60, 41), np.linspace(20, 50, 31))
        for name in "uv":
            add(grid.GetPointData(), name, np.full(41 * 31, 1.0))
        for run in (lambda: hodge(grid, eastward="u", northward="v"), lambda: transport(grid, eastward="u", northward="v"),
                    lambda: smooth_field(grid, n=1, Eastward="u", Northward="v")):
            with self.assertRaisesRegex(FieldError, "need a globe around the origin"):
                run()

    def test_on_a_flat_map_give_what_they_give_on_the_globe(self):
        longitudes, latitudes = np.arange(-20, 341, 5.0), np.linspace(90, -90, 37)
        on_globe, xyz = globe(longitudes, latitudes)
        on_map = flat(longitudes, latitudes)
        u, v = np.hypot(xyz[:, 0], xyz[:, 1]), 0 * xyz[:, 0]
        for grid in (on_globe, on_map):
            add(grid.GetPointData(), "u", u)
            add(grid.GetPointData(), "v", v)
        expected = hodge(on_globe, eastward="u", northward="v").GetPointData()
        result = hodge(on_map, eastward="u", northward="v", Coordinates="LongitudeAndLatitude")
        self.assertIsInstance(result, vtkRectilinearGrid)
        for name in ("StreamFunction", "Vorticity"):
            np.testing.assert_allclose(values(result.GetPointData(), name), values(expected, name), atol=1e-9)
        parts = values(result.GetPointData(), "RotationalPart")  # eastward, northward, upward
        inner = np.abs(xyz[:, 2]) < 0.95
        np.testing.assert_allclose(parts[inner, 0], u[inner], atol=0.02)
        np.testing.assert_allclose(parts[inner, 1:], 0, atol=0.02)


class PeriodicData(unittest.TestCase):
    def test_are_right_in_all_layouts_that_readers_make(self):
        """A wave of degree 5 on a grid of 5 degrees: cells around values at the poles, which reach over these, and columns at 0 and at 360."""
        def wave(p):
            x, y, z = p.T
            return (x ** 4 - 6 * x * x * y * y + y ** 4) * z - z

        def wind(p):
            x, y, z = p.T
            q = x ** 4 - 6 * x * x * y * y + y ** 4
            return np.cross(p, np.stack([z * (4 * x ** 3 - 12 * x * y * y), z * (4 * y ** 3 - 12 * x * x * y), q - 1], 1))

        once, between, poles = np.arange(0, 360, 5.0), np.arange(-87.5, 90, 5.0), np.arange(-90, 90.1, 5.0)
        for longitudes in (once, np.append(once, 360)):
            for latitudes in (between, poles, poles[::-1]):
                step = latitudes[1] - latitudes[0]
                grid, xyz = globe(np.append(longitudes - 2.5, longitudes[-1] + 2.5),
                                  np.append(latitudes - step / 2, latitudes[-1] + step / 2))
                _, centres = globe(longitudes, latitudes)
                for name, numbers in zip("uv", east_and_north(centres, wind(centres))):
                    add(grid.GetCellData(), name, numbers)
                with warnings.catch_warnings():
                    warnings.simplefilter("error")
                    result = hodge(grid, eastward="u", northward="v")
                self.assertEqual(result.GetFieldData().GetArray("BoundaryPoint").GetNumberOfTuples(), 0)
                error = values(result.GetPointData(), "StreamFunction") - wave(xyz)
                self.assertLess(np.abs(error - np.median(error)).max(), 0.002 * np.ptp(wave(xyz)))
                speeds = np.linalg.norm(values(result.GetCellData(), "RotationalPart"), axis=1)
                self.assertLess(np.abs(speeds - np.linalg.norm(wind(centres), axis=1)).max(), 0.1)

    def test_maps_reach_over_the_poles_as_globes_do(self):
        """Cells of 5 degrees around values at the poles have corners at 92.5."""
        longitudes, latitudes = np.linspace(0, 360, 73), np.linspace(-92.5, 92.5, 38)
        results = []
        for make, options in ((globe, {}), (lambda *rows: (flat(*rows), None), dict(Coordinates="LongitudeAndLatitude"))):
            grid, _ = make(longitudes, latitudes)
            centres = (latitudes[1:] + latitudes[:-1]) / 2
            add(grid.GetCellData(), "u", np.repeat(np.cos(np.radians(centres)), 72))
            add(grid.GetCellData(), "v", np.zeros(72 * 37))
            results.append(hodge(grid, eastward="u", northward="v", **options).GetPointData())
        for name in ("Vorticity", "StreamFunction"):
            on_globe, on_map = (values(data, name) for data in results)
            np.testing.assert_allclose(on_map, on_globe, atol=1e-6)

    def test_a_grid_one_step_short_of_the_circle_is_told(self):
        for longitudes, is_told in ((np.arange(0, 360.1, 5), False), (np.arange(0, 360, 5), True)):
            grid, xyz = globe(longitudes, np.linspace(-90, 90, 37))
            add(grid.GetPointData(), "u", np.hypot(xyz[:, 0], xyz[:, 1]))
            add(grid.GetPointData(), "v", 0 * xyz[:, 0])
            with warnings.catch_warnings(record=True) as said:
                warnings.simplefilter("always")
                hodge(grid, eastward="u", northward="v")
            self.assertEqual(any("short of a full circle" in str(each.message) for each in said), is_told)


class Land(unittest.TestCase):
    def test_cells_without_a_flow_take_no_part_at_each_time_by_itself(self):
        grid, x, y = image(21, 15, lambda x, y: np.stack([np.sin(y / 5), np.cos(x / 5), 0 * x], 1))
        for land in (x < 3, x < 5):
            flow = np.stack([np.sin(y / 5), np.cos(x / 5), 0 * x], 1)
            flow[land] = np.nan
            add(grid.GetPointData(), "U", flow)
            with warnings.catch_warnings():
                warnings.simplefilter("error")
                result = hodge(grid, "U")
            np.testing.assert_array_equal(np.isnan(values(result.GetPointData(), "StreamFunction")), land)
            cells = 14 * int(land[:21].sum())
            self.assertEqual(values(result.GetFieldData(), "CellsWithoutFlow")[0], cells)
            self.assertEqual(np.isnan(values(result.GetCellData(), "GradientPart")[:, 0]).sum(), cells)

    def test_fill_values_are_refused_or_told(self):
        grid, x, y = image(21, 15, lambda x, y: np.stack([np.sin(y / 5), np.cos(x / 5), 0 * x], 1))
        for fill, refuses in ((9.96921e36, True), (np.inf, True), (-32767.0, False)):
            flow = np.stack([np.sin(y / 5), np.cos(x / 5), 0 * x], 1)
            flow[x < 3] = (fill, fill, 0)
            add(grid.GetPointData(), "U", flow)
            if refuses:
                with self.assertRaisesRegex(FieldError, "Replace Fill Value With Nan"):
                    hodge(grid, "U")
            else:
                with self.assertWarnsRegex(FieldWarning, "Replace Fill Value With Nan"):
                    hodge(grid, "U")

    def test_a_pulse_in_a_calm_is_no_fill_value(self):
        """A wave that has not come far: 1e8 times the median and more, with all sizes between."""
        for a in (1, 10, 40):
            grid, x, y = image(41, 41, lambda x, y: np.exp(-a * ((x - 3) ** 2 + (y - 3) ** 2))[:, None] * np.stack([1 - y, x, 0 * x], 1), 0.15)
            with warnings.catch_warnings():
                warnings.simplefilter("error")
                result = hodge(grid, "U")
            shares = values(result.GetFieldData(), "FlowShares")
            self.assertAlmostEqual(shares.sum(), 1)

    def test_values_of_files_are_known_beside_each_other(self):
        grid, x, y = image(21, 15, lambda x, y: np.stack([np.sin(y / 5), np.cos(x / 5), 0 * x], 1))
        flow = np.stack([np.sin(y / 5), np.cos(x / 5), 0 * x], 1)
        flow[x < 3], flow[x > 18] = -9999, -32767
        add(grid.GetPointData(), "U", flow)
        with self.assertWarnsRegex(FieldWarning, "the size 3276"):
            hodge(grid, "U")


class FillValues(unittest.TestCase):
    """20 values among 961, which all filters that read vectors would follow."""
    def expect(self, fill, run):
        if fill > 1e15:
            with self.assertRaisesRegex(FieldError, "as fill values have"):
                run()
        else:
            with self.assertWarnsRegex(FieldWarning, "20 values of .* have the size 9999. If that is a fill value"):
                run()

    def setUp(self):
        self.grid, x, y = image(31, 31, lambda x, y: np.stack([1 + 0 * x, 0 * x, 0 * x], 1))
        self.holes = np.random.default_rng(7).choice(len(x), 20, replace=False)

    def filled(self, name, fill, components):
        numbers = np.zeros((961, components))
        numbers[:, 0] = 1
        numbers[self.holes, 0] = fill
        add(self.grid.GetPointData(), name, numbers if components > 1 else numbers[:, 0])

    def test_are_refused_or_told_by_all_filters(self):
        for fill in (1e20, 9.96921e36, -9999.0):
            self.filled("D", fill, 3)
            self.filled("f", fill, 1)
            self.expect(fill, lambda: hodge(self.grid, "D"))
            self.expect(fill, lambda: smooth_field(self.grid, n=1, Directions="D"))
            self.expect(fill, lambda: transport(self.grid, "D"))
            for drawing in (vtkFieldLines(), vtkFieldAngles()):
                drawing.SetInputArrayToProcess(0, 0, 0, 0, "D")
                self.expect(fill, lambda: self.updated(drawing, self.grid))
            angles = vtkFieldAngles()
            angles.SetInputArrayToProcess(1, 0, 0, 0, "D")
            self.expect(fill, lambda: self.updated(angles, smooth_field(self.grid)))
            poisson = vtkHarmonicFieldSolver()
            poisson.SetDiscretisation(poisson.ScalarFunction)
            poisson.SetInputArrayToProcess(7, 0, 0, 0, "f")
            add(self.grid.GetPointData(), "rim", np.array([0.0 if 31 <= k < 930 else 1.0 for k in range(961)]))
            add(self.grid.GetPointData(), "zero", np.zeros(961))
            poisson.SetInputArrayToProcess(0, 0, 0, 0, "rim")
            poisson.SetInputArrayToProcess(3, 0, 0, 0, "zero")
            self.expect(fill, lambda: self.updated(poisson, self.grid))

    def updated(self, algorithm, surface):
        algorithm.SetInputData(surface)
        return update(algorithm)

    def test_do_not_count_where_the_mask_is_zero(self):
        self.filled("D", 1e20, 3)
        mask = np.ones(961)
        mask[self.holes] = 0
        add(self.grid.GetPointData(), "known", mask)
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            result = smooth_field(self.grid, n=1, Directions="D", Mask="known")
        np.testing.assert_allclose(values(result.GetPointData(), "Direction0"), np.tile([1.0, 0, 0], (961, 1)), atol=1e-6)


class CopiesOfPoints(unittest.TestCase):
    """Points that stand once for each cell, as of discontinuous elements, and are joined."""
    def parts(self, data, name):
        result = hodge(data, name)
        return sum(values(result.GetCellData(), part) for part in ("GradientPart", "RotationalPart", "HarmonicPart", "Residual"))

    def test_keep_their_own_vectors_on_the_triangles_of_their_cells(self):
        data = polygons([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 0, 0), (1, 1, 0), (0, 1, 0)], [(0, 1, 2), (3, 4, 5)])
        add(data.GetPointData(), "u", np.array([(1.0, 0, 0)] * 3 + [(0, 1.0, 0)] * 3))
        np.testing.assert_allclose(self.parts(data, "u"), [(1, 0, 0), (0, 1, 0)], atol=1e-9)

    def test_of_cells_without_a_flow_do_not_count(self):
        """The first cell is land, and its copies of the points come first."""
        corners = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]
        squares = [[(x + i, y + j, 0) for x, y, _ in corners] for i, j in ((0, 0), (1, 0), (0, 1), (1, 1))]
        data = polygons(sum(squares, []), [range(4 * k, 4 * k + 4) for k in range(4)])
        flow = np.array([(y, 1 - x, 0) for x, y, _ in sum(squares, [])], float)
        flow[:4] = np.nan
        add(data.GetPointData(), "u", flow)
        expected = [(np.nan,) * 3] + [(0.5 + j, 0.5 - i, 0) for i, j in ((1, 0), (0, 1), (1, 1))]
        np.testing.assert_allclose(self.parts(data, "u"), expected, atol=1e-9)


class VectorsOfTwoNumbers(unittest.TestCase):
    def test_in_a_plane_are_those_of_three_for_all_filters(self):
        grid, x, y = image(21, 15, lambda x, y: np.stack([2 + np.sin(y / 5), np.cos(x / 5), 0 * x], 1))
        add(grid.GetPointData(), "two", values(grid.GetPointData(), "U")[:, :2])
        field = smooth_field(grid)
        for run in (lambda name: values(hodge(grid, name).GetPointData(), "RotationalPart"),
                    lambda name: values(transport(grid, name).GetPointData(), "TransportedVectors"),
                    lambda name: values(smooth_field(grid, n=1, Directions=name).GetPointData(), "Direction0"),
                    lambda name: self.angles(grid, 0, name), lambda name: self.angles(field, 1, name)):
            np.testing.assert_allclose(run("two"), run("U"), atol=1e-9)

    def angles(self, surface, index, name):
        filter = vtkFieldAngles()
        filter.SetInputData(surface)
        filter.SetAxis(1, 0, 0)
        filter.SetInputArrayToProcess(index, 0, 0, 0, name)
        return values(update(filter).GetCellData(), "Angle")


class Coasts(unittest.TestCase):
    def test_are_not_crossed_where_the_sea_beside_them_is_open(self):
        """By an array of points, and by one of cells."""
        def spreading(x, y):
            return np.stack([1 + 0.3 * np.sin(x), 0.2 * y * np.cos(x), 0 * x], 1)

        sea, x, y = image(61, 41, spreading, 0.1)
        add(sea.GetPointData(), "open at", ((y > 0) | (x == 0) | (x == x.max())).astype(float))
        cells = np.ones((40, 60))
        cells[0, 1:-1] = 0
        add(sea.GetCellData(), "open along", cells.ravel())
        for name in ("open at", "open along"):
            result = hodge(sea, "U", open_boundary=name)
            data = result.GetPointData()
            coast, west = (y == 0) & (x > 0.5) & (x < 5.5), (x == 0) & (y > 0.5) & (y < 3.5)
            for part in ("GradientPart", "RotationalPart"):
                self.assertLess(np.abs(values(data, part)[coast, 1]).max(), 0.02)
            self.assertGreater(values(data, "RotationalPart")[west, 0].mean(), 0.9)  # of a mean current of 1
            np.testing.assert_array_equal(values(result.GetFieldData(), "BoundaryIsOpen"), [1, 0])  # the longer one first

    def test_an_array_that_is_not_there_is_named(self):
        sea, _, _ = image(5, 5, lambda x, y: np.stack([x, y, 0 * x], 1))
        with self.assertRaisesRegex(FieldError, "no array 'coast'"):
            hodge(sea, "U", open_boundary="coast")


class CGrids(unittest.TestCase):
    def test_transports_lack_the_flow_of_half_a_cell_at_each_coast_which_is_told(self):
        """A flow of speed 1 around a cylinder of height 1, whose rows of hexagons have their normal velocities."""
        rows, columns = 8, 60
        at, triangles = [], []
        for j in range(rows):
            for i in range(columns):
                angle = 2 * np.pi * (i + 0.5 * (j % 2)) / columns
                at.append((np.cos(angle), np.sin(angle), (j + 0.5) / rows))
                a, b = j * columns + i, j * columns + (i + 1) % columns
                c, d = a + columns, b + columns
                triangles += [] if j == rows - 1 else [(a, b, c), (b, d, c)] if j % 2 == 0 else [(a, b, d), (a, d, c)]
        at, lines = np.array(at), vtkCellArray()
        edges = np.array(sorted({tuple(sorted((t[k], t[k - 1]))) for t in triangles for k in range(3)}))
        for edge in edges:
            lines.InsertNextCell(2, [int(each) for each in edge])
        centres = surface(at, np.array(triangles))
        velocities = vtkPolyData()
        velocities.SetPoints(centres.GetPoints())
        velocities.SetLines(lines)
        along, middle = at[edges[:, 1]] - at[edges[:, 0]], (at[edges[:, 1]] + at[edges[:, 0]]) / 2
        east = np.stack([-middle[:, 1], middle[:, 0], 0 * middle[:, 0]], 1) / np.hypot(middle[:, 0], middle[:, 1])[:, None]
        add(velocities.GetCellData(), "velocity", (east * along).sum(1) / np.linalg.norm(along, axis=1))
        data = hodge(centres, edges=velocities, EdgeArray="velocity", EdgeValues="Components").GetFieldData()
        transport = np.ptp(values(data, "BoundaryStreamFunction"))
        self.assertAlmostEqual(transport, 1 - 1 / rows, delta=1e-3)
        self.assertAlmostEqual(transport + values(data, "BoundaryHalfCell").sum(), 1, delta=1e-3)


class SteeringFlow(unittest.TestCase):
    def test_is_the_wind_that_a_storm_stands_in(self):
        """Of a vortex and an inflow whose potentials are zero at the boundary to three digits."""
        def storm(x, y):
            x, y = x - 6, y - 6
            fall = np.exp(-(x * x + y * y))
            return np.stack([(-y - 0.3 * x) * fall + 5, (x - 0.3 * y) * fall + 2, 0 * x], 1)

        grid, x, y = image(49, 49, storm, 0.25)
        for boundary in ("Closed", "Open"):
            wind = values(hodge(grid, "U", Boundary=boundary, SteeringFlow=True).GetPointData(), "SteeringFlow")
            np.testing.assert_allclose(wind, np.broadcast_to([5, 2, 0], wind.shape), atol=0.02)

    def test_is_the_flow_less_the_parts_that_two_boundaries_hold(self):
        def storm(x, y):
            x, y = x - 6, y - 6
            r = np.hypot(x, y) + 1e-9
            swirl, inflow = 40 * np.where(r < 0.6, r / 0.6, 0.6 / r), -8 * np.where(r < 1.2, r / 1.2, 1.2 / r)
            return np.stack([(-swirl * y + inflow * x) / r + 5, (swirl * x + inflow * y) / r + 2, 0 * x], 1)

        grid, x, y = image(49, 49, storm, 0.25)
        rest = storm(x, y) - values(hodge(grid, "U", Boundary="Open").GetPointData(), "GradientPart")
        rest -= values(hodge(grid, "U", Boundary="Closed").GetPointData(), "RotationalPart")
        near = np.hypot(x - 6, y - 6) < 4
        # The storm changes its sign under a half turn about the middle, and so do all of its parts: their mean there is zero.
        np.testing.assert_allclose(rest[near].mean(0), [5, 2, 0], atol=1e-6)


class DoubledPoints(unittest.TestCase):
    def test_weigh_once(self):
        n = 24
        at = np.array([[i / n, j / n, 0.0] for j in range(n + 1) for i in range(n + 1)])
        triangles = np.array([t for j in range(n) for i in range(n) for a in [j * (n + 1) + i]
                              for t in ((a, a + 1, a + n + 2), (a, a + n + 2, a + n + 1))])
        fields = []
        for points, cells in ((at, triangles), (at[triangles].reshape(-1, 3), np.arange(3 * len(triangles)).reshape(-1, 3))):
            data = surface(points, cells)
            angle = 0.3 * np.sin(7 * points[:, 0])
            add(data.GetPointData(), "D", np.stack([np.cos(angle), np.sin(angle), 0 * angle], 1))
            field = smooth_field(data, n=1, Directions="D", SmoothingLength=0.1, Tolerance=1e-9)
            fields.append(values(field.GetPointData(), "Direction0"))
        np.testing.assert_allclose(fields[1], fields[0][triangles.ravel()], atol=1e-5)


class Distances(unittest.TestCase):
    def test_go_around_a_hole(self):
        rings, around = 10, 180
        r, t = np.meshgrid(np.linspace(0.8, 1, rings + 1), np.arange(around) * 2 * np.pi / around, indexing="ij")
        at = np.stack([(r * np.cos(t)).ravel(), (r * np.sin(t)).ravel(), 0 * r.ravel()], 1)
        triangles = [f for i in range(rings) for j in range(around) for a, b, c, d in
                     [(i * around + j, (i + 1) * around + j, i * around + (j + 1) % around, (i + 1) * around + (j + 1) % around)]
                     for f in ((a, b, d), (a, d, c))]
        result = transport(surface(at, triangles), point=(0.9, 0, 0), direction=(1, 0, 0)).GetPointData()
        opposite = np.argmin(np.linalg.norm(at + [0.9, 0, 0], axis=1))
        tangent = np.sqrt(0.81 - 0.64)
        exact = 2 * tangent + 0.8 * (np.pi - 2 * np.arccos(0.8 / 0.9))
        self.assertAlmostEqual(values(result, "GeodesicDistance")[opposite], exact, delta=0.01 * exact)

    def test_of_places_that_nothing_reaches_are_not_numbers(self):
        data = surface([[0, 0, 0], [1, 0, 0], [0, 1, 0], [5, 0, 0], [6, 0, 0], [5, 1, 0]], [(0, 1, 2), (3, 4, 5)])
        result = transport(data, point=(0, 0, 0))
        self.assertEqual(values(result.GetFieldData(), "PointsWithoutMap")[0], 3)
        np.testing.assert_array_equal(np.isnan(values(result.GetPointData(), "GeodesicDistance")), [False] * 3 + [True] * 3)


    def test_on_a_flat_map_are_those_on_the_globe_from_south_and_from_north(self):
        """With the same point twice at 0 and at 360 degrees, and often at the poles."""
        longitudes = np.linspace(0, 360, 73)
        for latitudes in (np.linspace(-90, 90, 37), np.linspace(90, -90, 37)):
            on_globe, xyz = globe(longitudes, latitudes)
            with warnings.catch_warnings():
                warnings.simplefilter("ignore", FieldWarning)  # points that are there often
                expected = values(distance(on_globe, point=xyz[700]).GetPointData(), "Distance")
            result = distance(flat(longitudes, latitudes), point=(longitudes[700 % 73], latitudes[700 // 73], 0),
                              Coordinates="LongitudeAndLatitude").GetPointData()
            np.testing.assert_allclose(values(result, "Distance"), expected, atol=1e-9)
            self.assertLess(np.abs(expected - np.arccos(np.clip(xyz @ xyz[700], -1, 1))).max(), 0.01)

    def test_do_not_depend_on_polygons_and_doubled_points(self):
        """Quadrilaterals, each with points of its own, which are joined; and a mask that one of two copies has."""
        corners = [(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)]
        squares = [[(x + i, y + j, 0) for x, y, _ in corners] for j in range(4) for i in range(4)]
        data = polygons(sum(squares, []), [range(4 * k, 4 * k + 4) for k in range(16)])
        at = np.array(sum(squares, []), float)
        mask = np.zeros(64)
        mask[np.flatnonzero((at == (2, 2, 0)).all(axis=1))[2]] = 1
        add(data.GetPointData(), "mask", mask)
        for result in (distance(data, point=(2, 2, 5)), distance(data, mask="mask")):
            np.testing.assert_allclose(values(result.GetPointData(), "Distance"), np.linalg.norm(at - (2, 2, 0), axis=1), atol=1e-9)


class Tiles(unittest.TestCase):
    def six_tiles(self):
        n = 11
        a = np.tan(np.linspace(-np.pi / 4, np.pi / 4, n))
        x, y = (each.ravel() for each in np.meshgrid(a, a))
        one = np.ones_like(x)
        for corner in ((one, x, y), (-x, one, y), (-one, -x, y), (x, -one, y), (-y, x, one), (y, x, -one)):
            at = np.stack(corner, 1)
            at /= np.linalg.norm(at, axis=1)[:, None]
            tile, points = vtkStructuredGrid(), vtkPoints()
            tile.SetDimensions(n, n, 1)
            points.SetData(numpy_to_vtk(at, deep=True))
            tile.SetPoints(points)
            add(tile.GetPointData(), "U", np.cross([0, 0, 1.0], at))
            yield tile

    def shares(self, data):
        """Of the gradient part, and warnings."""
        decomposition = vtkHodgeDecomposition()
        decomposition.SetInputDataObject(0, data)
        decomposition.SetInputArrayToProcess(0, 0, 0, 0, "U")
        with warnings.catch_warnings(record=True) as said:
            warnings.simplefilter("always")
            return update(decomposition), [str(each.message) for each in said]

    def test_are_told_with_the_remedy_which_makes_one_surface_of_them(self):
        blocks, merge = vtkMultiBlockDataSet(), vtkAppendFilter()
        for tile in self.six_tiles():
            blocks.SetBlock(blocks.GetNumberOfBlocks(), tile)
            merge.AddInputData(tile)
        for _ in range(2):  # each execution by itself
            _, said = self.shares(blocks)
            self.assertEqual(len(said), 1)
            self.assertRegex(said[0], r"Merge Blocks \(vtkAppendFilter\)")
        merge.Update()
        merged, said = self.shares(merge.GetOutput())
        self.assertEqual(said, [])
        self.assertLess(values(merged.GetFieldData(), "FlowShares")[0], 1e-3)

    def test_blocks_apart_and_twins_are_no_tiles(self):
        tiles = list(self.six_tiles())
        for pair in ((tiles[0], tiles[2]), (tiles[0], tiles[0])):
            blocks = vtkMultiBlockDataSet()
            for k, tile in enumerate(pair):
                blocks.SetBlock(k, tile)
            self.assertEqual(self.shares(blocks)[1], [])


class Tensors(unittest.TestCase):
    def test_that_are_not_symmetric_are_told_and_their_symmetric_part_counts(self):
        symmetric, spin = np.array([[2, 0.5, 0], [0.5, 1, 0], [0, 0, 1]]), np.array([[0, 3, 0], [-3, 0, 0], [0, 0, 0]])
        fields = []
        for tensor, told in ((symmetric, False), (symmetric + spin, True)):
            grid, x, _ = image(7, 7, lambda x, y: np.stack([x, y, 0 * x], 1))
            add(grid.GetPointData(), "T", np.broadcast_to(tensor.ravel(), (len(x), 9)))
            with warnings.catch_warnings(record=True) as said:
                warnings.simplefilter("always")
                field = smooth_field(grid, n=2, Directions="T")
            self.assertEqual(["49 tensors are not symmetric; their symmetric parts are used" in str(each.message) for each in said],
                             [True] * told)
            fields.append(values(field.GetPointData(), "Direction0"))
        np.testing.assert_allclose(np.abs((fields[0] * fields[1]).sum(1)), 1, atol=1e-6)


class PrincipalDirections(unittest.TestCase):
    def test_are_unit_vectors_on_quadrilaterals_too(self):
        u, v = np.meshgrid(np.linspace(-1, 1, 13), np.linspace(-1, 1, 13))
        at = np.stack([u, v, u * u - 0.3 * v * v + 0.2 * u * v], -1).reshape(-1, 3)
        cells = [(a, a + 1, a + 14, a + 13) for j in range(12) for i in range(12) for a in [13 * j + i]]
        filter = vtkPrincipalDirections()
        filter.SetInputData(polygons(at, cells))
        data = update(filter)
        for attributes in (data.GetCellData(), data.GetPointData()):
            np.testing.assert_allclose(np.linalg.norm(values(attributes, "MaximumDirection"), axis=1), 1, atol=1e-12)


class Export(unittest.TestCase):
    def test_a_sphere_with_the_seam_of_a_texture_has_no_features(self):
        sphere = vtkTexturedSphereSource()
        sphere.SetThetaResolution(40)
        sphere.SetPhiResolution(40)
        sphere.Update()
        with warnings.catch_warnings(), tempfile.TemporaryDirectory() as folder:
            warnings.simplefilter("ignore")
            path = os.path.join(folder, "part.sharp")
            write_sharp(path, smooth_field(sphere.GetOutput()))
            with open(path, encoding="ascii") as file:
                self.assertEqual(int(file.readline()), 0)

    def test_features_are_those_of_the_surface_that_the_solver_sees(self):
        n = 6
        at = np.array([[i, j, 0.0] for j in range(n + 1) for i in range(n + 1)])
        triangles = np.array([t for j in range(n) for i in range(n) for a in [j * (n + 1) + i]
                              for t in ((a, a + 1, a + n + 2), (a, a + n + 2, a + n + 1))])
        turned = np.array([t[::-1] if k % 2 else t for k, t in enumerate(triangles)])
        soup = surface(at[triangles].reshape(-1, 3), np.arange(3 * len(triangles)).reshape(-1, 3))
        with warnings.catch_warnings(), tempfile.TemporaryDirectory() as folder:
            warnings.simplefilter("ignore")
            for data in (surface(at, triangles), surface(at, turned), soup):
                path = os.path.join(folder, "part.sharp")
                write_sharp(path, smooth_field(data))
                with open(path, encoding="ascii") as file:
                    self.assertEqual(int(file.readline()), 4 * n)

    def test_unstructured_grids_are_written_as_their_polygons(self):
        grid = vtkAppendFilter()
        grid.AddInputData(surface([[0, 0, 0], [1, 0, 0], [1, 1, 0], [0, 1, 0]], [(0, 1, 2), (0, 2, 3)]))
        grid.Update()
        field = smooth_field(grid.GetOutput())
        with tempfile.TemporaryDirectory() as folder:
            for write in (write_rosy, write_raw_field, write_sharp):
                write(os.path.join(folder, "x"), field)


if __name__ == "__main__":
    unittest.main()
