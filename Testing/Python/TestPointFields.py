"""Power fields at points: on grids, where fields on triangles depend on how these are cut."""

import unittest
import warnings

import numpy as np

from directionalmultigrid import FieldWarning, smooth_field, update
from directionalmultigrid.vtkFiltersDirectionalFields import vtkFieldSingularities
from vtkmodules.vtkCommonDataModel import vtkCellArray
from vtkmodules.vtkFiltersSources import vtkSphereSource
from surfaces import add, corners, disc, grid, surface, values, values_of_points


def plane(x, y):
    return x, y, 0 * x


def ball(x, y):
    """A band around the unit sphere, without the poles, in squares of longitude and latitude."""
    return np.cos(1.2 * x) * np.cos(3 * y), np.cos(1.2 * x) * np.sin(3 * y), np.sin(1.2 * x)


ROLL = 1.5  # the radius of a part that is rolled


def part(x, y):
    """Half a plate with a round hole, in quads from the hole to the rim of the plate, rolled about an axis."""
    angle, t = 0.5 * np.pi * (1 + y), 0.5 * (1 + x)
    cosine, sine = np.cos(angle), np.sin(angle)
    size = (1 - t) * 0.35 + t / np.maximum(np.abs(cosine), np.abs(sine))
    return ROLL * np.sin(size * cosine / ROLL), size * sine, ROLL * np.cos(size * cosine / ROLL)


def normals_of(points):
    """The normals of the four surfaces: of a flat one, of the unit sphere, else of a cylinder."""
    if np.ptp(points[:, 2]) == 0:
        return np.tile((0.0, 0, 1), (len(points), 1))
    if np.ptp(np.linalg.norm(points, axis=1)) < 1e-6:
        return points
    return points * (1, 0, 1) / ROLL


def powers(field, n, axis):
    """The N-th powers at points against the direction of an axis, the same on every mesh of the points."""
    points, v = values_of_points(field), values(field.GetPointData(), "Direction0")
    normals = normals_of(points)
    x = axis - normals * (normals @ axis)[:, None]
    x /= np.linalg.norm(x, axis=1)[:, None]
    z = (v * x).sum(1) + 1j * (v * np.cross(normals, x)).sum(1)
    return np.abs(z) * np.exp(1j * n * np.angle(z))


def relative(a, b):
    return np.sqrt((np.abs(a - b) ** 2).mean() / (np.abs(b) ** 2).mean())


class PointFields(unittest.TestCase):
    def crosses_on_disc(self, n, diagonals):
        return smooth_field(grid(n, disc, diagonals), n=4, BoundaryWeight=1.0,
                            ConstraintType="Hard", Tolerance=1e-9, UnitLength=False)

    def test_crosses_along_the_boundary_of_a_disc_are_the_harmonic_ones(self):
        """Their power is r^4 exp(4 i (angle + 90 degrees)), whatever the triangles."""
        for diagonals in (0, 1, 2):
            errors = []
            for n in (20, 40):
                field = self.crosses_on_disc(n, diagonals)
                points = values_of_points(field)
                exact = (points[:, 0] + 1j * points[:, 1]) ** 4
                errors.append(relative(powers(field, 4, np.array((1.0, 0, 0))), exact))
            self.assertLess(errors[1], 0.02)
            self.assertGreater(errors[0] / errors[1], 2.5)

    def test_its_singularities_are_near_the_centre(self):
        field = self.crosses_on_disc(40, 0)
        singularities = vtkFieldSingularities()
        singularities.SetInputData(field)
        found = update(singularities)
        self.assertGreater(found.GetNumberOfPoints(), 0)
        self.assertLess(np.linalg.norm(values_of_points(found), axis=1).max(), 0.35)
        self.assertAlmostEqual(values(found.GetFieldData(), "SumOfIndices")[0], 1.0)

    def test_quads_may_be_split_either_way(self):
        """To 1 % in the mean of squares."""
        n = 80
        for place in (plane, disc, ball, part):
            fields = []
            for diagonals in (0, 1, 2):
                mesh = grid(n, place, diagonals)
                x, y = (k.ravel() for k in np.meshgrid(*[np.linspace(-1, 1, n + 1)] * 2, indexing="ij"))
                rim = np.maximum(np.abs(x), np.abs(y)) == 1
                directions = rim[:, None] * np.stack([np.cos(x + 0.5 * y), np.sin(x + 0.5 * y), 0.3 * np.cos(x)], 1)
                normals = normals_of(values_of_points(mesh))
                directions -= normals * (normals * directions).sum(1)[:, None]
                add(mesh.GetPointData(), "Given", directions)
                field = smooth_field(mesh, n=4, Directions="Given",
                                     ConstraintType="Hard", UnitLength=False, Tolerance=1e-10)
                fields.append(powers(field, 4, np.array((0.1, 0.3, 0.9 if place is ball else 0.0))))  # along no normal
            for other in fields[1:]:
                self.assertLess(relative(other, fields[0]), 0.01, place.__name__)

    def test_a_line_is_followed_where_it_passes(self):
        """Half a great circle around a sphere: crosses at the points below it run along it, and so do those on the triangles."""
        sphere = vtkSphereSource()
        sphere.SetRadius(1)
        sphere.SetThetaResolution(60)
        sphere.SetPhiResolution(60)
        angles = np.linspace(0, np.pi, 50)
        line = surface(np.stack([np.cos(angles), np.sin(angles) * 0.8, np.sin(angles) * 0.6], 1), [])
        line.SetLines(vtkCellArray())
        line.GetLines().InsertNextCell(50, range(50))
        for kind in ("Soft", "Hard"):
            field = smooth_field(update(sphere), [line], 4, ConstraintType=kind, AllDirections=True)
            held = values(field.GetPointData(), "Prescribed") > 0
            self.assertGreater(held.sum(), 60)
            held_cells = held[corners(field)].all(axis=1)
            axis = np.array((0, -0.6, 0.8))  # across the circle's plane
            places = values_of_points(field)
            for attributes, which, at in ((field.GetPointData(), held, places),
                                          (field.GetCellData(), held_cells, places[corners(field)].mean(axis=1))):
                across = np.stack([values(attributes, f"Direction{k}")[which] @ axis for k in range(4)])
                tangential = np.sqrt(1 - (at[which] @ axis) ** 2)
                self.assertGreater((np.abs(across).max(axis=0) / tangential).min(), np.cos(np.radians(3)))

    def test_fields_on_faces_say_where_triangles_are_sheared(self):
        with self.assertWarnsRegex(FieldWarning, "100 % of the surface have sheared triangles.*PointPowerField"):
            smooth_field(grid(40, plane), n=4, Discretisation="PowerField", BoundaryWeight=1.0)
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            smooth_field(grid(40, plane), n=4, BoundaryWeight=1.0)
            smooth_field(grid(40, lambda x, y: (x - 0.5 * y, np.sqrt(0.75) * y, 0 * x)), n=4, Discretisation="PowerField",
                         BoundaryWeight=1.0)

    def test_a_harmonic_vector_field_is_found_on_cells_of_1_to_4(self):
        for stretch in (1.0, 0.25):
            mesh = grid(40, lambda x, y: (x, stretch * y, 0 * x))
            x, y, _ = values_of_points(mesh).T
            exact = np.stack([1 + 3 * (x * x - y * y), 0.5 - 6 * x * y, 0 * x], 1)
            held = np.maximum(np.abs(x), np.abs(y) / stretch) > 0.99
            add(mesh.GetPointData(), "Given", np.where(held[:, None], exact, 0))
            field = smooth_field(mesh, n=1, Directions="Given",
                                 ConstraintType="Hard", UnitLength=False, Tolerance=1e-10)
            self.assertLess(relative(values(field.GetPointData(), "Direction0"), exact), 0.002)


if __name__ == "__main__":
    unittest.main()
