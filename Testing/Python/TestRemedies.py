"""What messages tell to do, done through the package's functions: a message comes, its remedy is given, and the message is gone."""

import unittest
import warnings

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkFiltersCore import vtkDelaunay2D
from vtkmodules.vtkFiltersSources import vtkLineSource, vtkPointSource

from directionalmultigrid import FieldError, hodge, quads, smooth_field, transport, update
from surfaces import add, corners, disc, grid, surface, torus, values, values_of_points


def message(call):
    """What a call says, as an error or as warnings, or nothing."""
    with warnings.catch_warnings(record=True) as heard:
        warnings.simplefilter("always")
        try:
            call()
        except FieldError as error:
            return str(error)
    return "\n".join(str(each.message) for each in heard)


def with_turned_cells():
    """A torus with every seventh cell clockwise, and vectors."""
    mesh = torus(20, 10)
    triangles = corners(mesh)
    triangles[::7] = triangles[::7, ::-1]
    return with_vectors(surface(values_of_points(mesh), triangles))


def with_vectors(mesh):
    x, y, _ = values_of_points(mesh).T
    array = numpy_to_vtk(np.stack([-y, x, 0 * x], 1), deep=True)
    array.SetName("Flow")
    mesh.GetPointData().AddArray(array)
    return mesh


def far_line():
    line = vtkLineSource()
    line.SetPoint1(3, 0, 0)
    line.SetPoint2(3, 1, 0)
    return update(line)


def point():
    source = vtkPointSource()
    source.SetNumberOfPoints(1)
    source.SetCenter(1.4, 0, 0)
    source.SetRadius(0)
    return update(source)


def corners_of_grid(x, n, place):
    """Triangles of a grid in x by n, in the plane; place(x, y) with y in [-1/2, 1/2]."""
    X, Y = np.meshgrid(x, np.linspace(-0.5, 0.5, n), indexing="ij")
    points = np.stack([*place(X.ravel(), Y.ravel()), 0 * X.ravel()], 1)
    i, j = [k.ravel() for k in np.meshgrid(np.arange(len(x) - 1), np.arange(n - 1), indexing="ij")]
    a, b, c, d = i * n + j, (i + 1) * n + j, (i + 1) * n + j + 1, i * n + j + 1
    return surface(points, np.concatenate([np.stack([a, b, c], 1), np.stack([a, c, d], 1)]))


def plane_of(m, n, length, width):
    return corners_of_grid(np.linspace(0, length, m + 1), n + 1, lambda x, y: (x, width * y))


class Remedies(unittest.TestCase):
    def assert_helps(self, call, said, before, after):
        """The message comes with the properties before, and not with those after."""
        self.assertRegex(message(lambda: call(**before)), said)
        self.assertNotRegex(message(lambda: call(**after)), said)

    def test_of_surfaces_that_are_no_oriented_manifolds(self):
        mesh = with_turned_cells()
        calls = {"smooth_field": lambda **more: smooth_field(mesh, **more), "hodge": lambda **more: hodge(mesh, "Flow", **more),
                 "transport": lambda **more: transport(mesh, point=(1.4, 0, 0), **more)}
        for name, call in calls.items():
            with self.subTest(name):
                self.assertIn("to have it refused, switch Strict on", message(call))
                with self.assertRaisesRegex(FieldError, "Join Points on and Strict off|oriented|run through"):
                    call(Strict=True)
                self.assertNotIn("refused", message(lambda: call(Strict=True)))
                self.assertIn("cells turned", message(lambda: call(Strict=False, JoinPoints=True)))
        self.assertIn("to have it refused, take a field of Harmonic Field Solver with Strict on", message(lambda: quads(mesh, 100)))
        with self.assertRaises(FieldError):
            quads(smooth_field(mesh, Strict=True), 100)

    def test_of_rotations_of_nothing(self):
        self.assert_helps(lambda **more: smooth_field(torus(20, 10), **more), "or set them to 0", {"Rotation": 30}, {"Rotation": 0})

    def test_of_guides_that_are_far(self):
        self.assert_helps(lambda **more: smooth_field(torus(20, 10), guides=far_line(), **more), "Maximum Distance",
                          {}, {"MaximumDistance": 10})

    def test_of_triangles_with_wide_angles(self):
        """sin x cos y and its gradient, on a sheared grid: Delaunay triangles of the same points have no such angles, and errors below a tenth."""
        x, y = (each.ravel() for each in np.meshgrid(np.linspace(-1, 1, 61), np.linspace(-1, 1, 61), indexing="ij"))
        sheared = grid(60, lambda x, y: (x + 7 * y, y, 0 * x))
        add(sheared.GetPointData(), "Flow", np.stack([np.cos(x + 7 * y) * np.cos(y), -np.sin(x + 7 * y) * np.sin(y), 0 * x], 1))
        delaunay = vtkDelaunay2D()
        delaunay.SetInputData(sheared)
        errors = []
        for mesh, is_warned in ((sheared, True), (update(delaunay), False)):
            self.assertEqual("100 % of the surface have triangles with an angle above 150 degrees" in message(lambda: hodge(mesh, "Flow")), is_warned)
            self.assertEqual("Delaunay 2D" in message(lambda: hodge(mesh, "Flow")), is_warned)
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                errors.append(np.ptp(values(hodge(mesh, "Flow").GetPointData(), "Potential") - np.sin(x + 7 * y) * np.cos(y)))
        self.assertLess(errors[1], 0.1 * errors[0])

    def test_of_few_iterations(self):
        mesh = torus(100, 50)
        self.assert_helps(lambda **more: smooth_field(mesh, guides=far_line(), MaximumDistance=10, Solver="ConjugateGradients", **more),
                          "Maximum Number Of Iterations", {"MaximumNumberOfIterations": 1}, {"MaximumNumberOfIterations": 100})

    def test_of_singularities_of_other_kinds(self):
        self.assert_helps(lambda **more: smooth_field(torus(20, 10), n=1, singularities=point(), **more), "Power Field at Points",
                          {"Discretisation": "FaceField"}, {"Discretisation": "PointPowerField"})

    def test_of_crosses_under_another_name(self):
        mesh = with_vectors(grid(10, disc))
        self.assert_helps(lambda **more: quads(mesh, 100, "Flow", **more), "choose one of 4",
                          {"NumberOfDirections": 3}, {"NumberOfDirections": 4})

    def test_of_quads_that_lose_a_thin_part(self):
        """Without its boundary, a strip that is thinner than quads is lost for the most part; all of it is there with smaller quads or with the boundary."""
        strip = plane_of(240, 4, 1.0, 0.005)
        self.assert_helps(lambda **more: quads(strip, **more), "away from the surface.*ask for more.*or switch Align Boundary on",
                          {"NumberOfQuads": 20, "AlignBoundary": False}, {"NumberOfQuads": 20, "AlignBoundary": True})
        self.assertNotIn("away from", message(lambda: quads(strip, 1000, AlignBoundary=False)))

    def test_of_quads_that_lose_a_narrow_end(self):
        """Both sides of a narrow end have the same integer in a map along the boundary."""
        x = np.linspace(0.001, 1, 81)
        drop = corners_of_grid(x, 9, lambda x, y: (x, y * x**2 * (1.01 - x)**0.5))
        self.assert_helps(lambda **more: quads(drop, 400, **more), "away from the surface.*or switch Align Boundary off",
                          {"AlignBoundary": True}, {"AlignBoundary": False})

    def test_of_crosses_that_the_boundary_leaves(self):
        square = plane_of(10, 10, 1.0, 1.0)
        array = numpy_to_vtk(np.tile([1.0, 1.0, 0.0], (square.GetNumberOfPoints(), 1)), deep=True)
        array.SetName("Diagonal")
        square.GetPointData().AddArray(array)
        self.assert_helps(lambda **more: quads(square, 200, "Diagonal", **more), "40 edges of the boundary.*switch Align Boundary off",
                          {}, {"AlignBoundary": False})


if __name__ == "__main__":
    unittest.main()
