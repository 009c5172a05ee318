"""Liquid crystals, cells and cracks: Q tensors of a plane, the order of what is measured, and defects with their axes."""

import unittest
import warnings

import numpy as np

from directionalmultigrid import FieldError, smooth_field, update
from directionalmultigrid.vtkFiltersDirectionalFields import vtkFieldLines, vtkFieldSingularities
from surfaces import add, surface, values, values_of_points


def plane(cells=24, bent=False):
    """A square of triangles around the origin, none of whose points is there."""
    x, y = (each.ravel() for each in np.meshgrid(*2 * [np.linspace(-1, 1, cells + 1) + 0.3 / cells], indexing="ij"))
    at = np.arange((cells + 1) ** 2).reshape(cells + 1, -1)
    a, b, c, d = (each.ravel() for each in (at[:-1, :-1], at[1:, :-1], at[1:, 1:], at[:-1, 1:]))
    return surface(np.stack([x, y, 0.1 * x * x if bent else 0 * x], 1).tolist(),
                   np.concatenate([np.stack([a, b, c], 1), np.stack([a, c, d], 1)]).tolist())


def directors(mesh, angle, order=1.0):
    """Q tensors of 4 numbers, of a director at an angle; the trace is zero."""
    return 0.5 * np.stack([order * np.cos(2 * angle), order * np.sin(2 * angle), order * np.sin(2 * angle), -order * np.cos(2 * angle)], 1)


def polar_angle(mesh):
    place = values_of_points(mesh)
    return np.arctan2(place[:, 1], place[:, 0])


def defects(mesh, name, n=0):
    finder = vtkFieldSingularities()
    finder.SetInputData(mesh)
    finder.SetNumberOfDirections(n)
    finder.SetInputArrayToProcess(0, 0, 0, 0, name)
    return update(finder).GetPointData()


class Nematics(unittest.TestCase):
    def setUp(self):
        warnings.simplefilter("error")

    def test_tensors_of_two_by_two_are_those_of_the_plane(self):
        mesh = plane()
        angle = 0.4 + 0.2 * values_of_points(mesh)[:, 0]
        four = directors(mesh, angle)
        nine = np.zeros((len(four), 9))
        nine[:, [0, 1, 3, 4]] = four
        add(mesh.GetPointData(), "Q", four)
        add(mesh.GetPointData(), "Q9", nine)
        fields = [values(smooth_field(mesh, n=2, Directions=name).GetPointData(), "Direction0") for name in ("Q", "Q9")]
        np.testing.assert_array_equal(*fields)
        lines = vtkFieldLines()
        lines.SetInputData(mesh)
        lines.SetInputArrayToProcess(0, 0, 0, 0, "Q")
        self.assertGreater(update(lines).GetNumberOfLines(), 5)

    def test_principal_values_have_signs(self):
        """Tension along x of a strength that grows, and pressure across it; the larger one belongs to the direction."""
        mesh = plane()
        for data, count in ((mesh.GetPointData(), mesh.GetNumberOfPoints()), (mesh.GetCellData(), mesh.GetNumberOfCells())):
            strength = 1 + np.arange(count) / count
            stress = np.zeros((count, 6))
            stress[:, 0], stress[:, 1], stress[:, 2] = strength, -0.25, 99  # what stands across the plane does not count
            add(data, "Stress of " + data.GetClassName(), stress)
            field = smooth_field(mesh, n=4, Directions="Stress of " + data.GetClassName())
            result = field.GetPointData() if data is mesh.GetPointData() else field.GetCellData()
            np.testing.assert_allclose(values(result, "PrincipalValues"), np.stack([strength, 0 * strength - 0.25], 1), atol=1e-12)
        add(mesh.GetPointData(), "Vectors", np.ones((mesh.GetNumberOfPoints(), 3)))
        self.assertFalse(smooth_field(mesh, Directions="Vectors").GetPointData().HasArray("PrincipalValues"))

    def test_tensors_of_two_by_two_need_a_plane(self):
        mesh = plane(bent=True)
        add(mesh.GetPointData(), "Q", directors(mesh, 0.4 + 0 * polar_angle(mesh)))
        for call in (lambda: smooth_field(mesh, n=2, Directions="Q"), lambda: defects(mesh, "Q")):
            with self.assertRaisesRegex(FieldError, r"array 'Q' holds tensors of 4 numbers \(XX XY YX YY\), and the surface is not in a plane"):
                call()

    def test_powers_of_a_solver_are_no_directions(self):
        mesh = smooth_field(plane(), n=2)
        with self.assertRaisesRegex(FieldError, "'PowerField' holds the powers of a field .* choose Direction0"):
            defects(mesh, "PowerField")

    def test_order_is_the_length_of_smoothed_directions(self):
        """Directors at angles a and -a by turns have the mean cos(2 a), as an order of S in the plane is."""
        mesh, a = plane(), 0.3
        sign = np.where(np.arange(mesh.GetNumberOfCells()) % 2, 1.0, -1.0) * np.ones(mesh.GetNumberOfCells())
        add(mesh.GetCellData(), "director", np.stack([np.cos(a * sign), np.sin(a * sign), 0 * sign], 1))
        field = smooth_field(mesh, n=2, Directions="director", SmoothingLength=0.3, UnitLength=False)
        length = np.linalg.norm(values(field.GetPointData(), "Direction0"), axis=1)
        inside = np.abs(values_of_points(mesh)[:, :2]).max(axis=1) < 0.5
        np.testing.assert_allclose(length[inside], np.cos(2 * a), atol=0.02)

    def test_defects_of_a_half_have_one_axis_or_three(self):
        mesh, theta = plane(), 0.3
        for index, axes in ((0.5, 1), (-0.5, 3)):
            name = f"Q{axes}"
            add(mesh.GetPointData(), name, directors(mesh, index * polar_angle(mesh) + theta))
            found = defects(mesh, name)
            np.testing.assert_array_equal(values(found, "Index"), [index])
            np.testing.assert_array_equal(values(found, "NumberOfAxes"), [axes])
            np.testing.assert_array_equal(values(found, "SpiralAngle"), [0])
            for k in range(axes):
                axis = values(found, f"Axis{k}")[0]
                phi = np.arctan2(axis[1], axis[0])
                # radial: 2 (index phi + theta - phi) is a multiple of 2 pi
                self.assertLess(abs(np.angle(np.exp(2j * (index * phi + theta - phi)))), 0.1)
            self.assertFalse(found.HasArray(f"Axis{axes}"))

    def test_index_one_is_an_aster_a_vortex_or_a_spiral(self):
        mesh = plane()
        for k, angle in enumerate((0.0, 60.0, -30.0, 89.0)):
            add(mesh.GetPointData(), f"V{k}", np.stack([np.cos(polar_angle(mesh) + np.radians(angle)),
                                                        np.sin(polar_angle(mesh) + np.radians(angle)), 0 * polar_angle(mesh)], 1))
            found = defects(mesh, f"V{k}", 1)
            np.testing.assert_array_equal(values(found, "Index"), [1.0])
            np.testing.assert_array_equal(values(found, "NumberOfAxes"), [0])
            np.testing.assert_allclose(values(found, "SpiralAngle"), [angle], atol=5)


if __name__ == "__main__":
    unittest.main()
