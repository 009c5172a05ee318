"""Directions as measurements bring them: a length that smooths them, eastward and northward components, and weights of tensors."""

import unittest

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy

from directionalmultigrid import FieldError, smooth_field
from surfaces import add, surface

KINDS = ("PowerField", "PointPowerField", "FaceField", "OneForm")


def tube(n):
    """A prism without ends, which is flat in itself, of length pi and circumference 2: points, triangles."""
    around, along = max(6, round(2 / np.pi * n)), n
    i, j = (k.ravel() for k in np.meshgrid(np.arange(along + 1), np.arange(around), indexing="ij"))
    radius = 1 / (around * np.sin(np.pi / around))
    angle = 2 * np.pi * (j + 0.5 * i) / around
    points = np.stack([np.pi * i / along, radius * np.cos(angle), radius * np.sin(angle)], axis=1)
    at = lambda a, b: a * around + b % around  # noqa: E731
    i, j = (k.ravel() for k in np.meshgrid(np.arange(along), np.arange(around), indexing="ij"))
    a, b, c, d = at(i, j), at(i + 1, j), at(i + 1, j - 1), at(i, j + 1)
    return points, np.concatenate([np.stack([a, b, d], 1), np.stack([a, c, b], 1)])


def with_wave(n, waves, on_points):
    """The tube with vectors around it whose length is a cosine along it, and those vectors on cells."""
    points, triangles = tube(n)
    mesh = surface(points, triangles)
    centres = points[triangles].mean(1)
    wave = lambda p: (np.cos(waves * p[:, 0]) / np.hypot(p[:, 1], p[:, 2]))[:, None] * np.stack([0 * p[:, 0], -p[:, 2], p[:, 1]], 1)  # noqa: E731
    add(mesh.GetPointData() if on_points else mesh.GetCellData(), "Wave", wave(points if on_points else centres))
    return mesh, wave(centres)


class MeasuredDirections(unittest.TestCase):
    def test_a_wave_fades_as_its_length_has_it(self):
        """The field that minimises |grad X|^2 + |X - Y|^2 / length^2 is Y / (1 + (k length)^2), at any resolution."""
        for kind in KINDS:
            for on_points in (False, True):
                for waves, length in ((1, 0.5), (2, 0.5), (2, 1.0)):
                    kept = []
                    for n in (30, 60):
                        mesh, wave = with_wave(n, waves, on_points)
                        field = smooth_field(mesh, n=1, Discretisation=kind, Directions="Wave", UnitLength=False, Tolerance=1e-8,
                                             SmoothingLength=length / mesh.GetLength(), Alignment=77)
                        found = vtk_to_numpy(field.GetCellData().GetArray("Direction0"))
                        kept.append((found * wave).sum() / (wave ** 2).sum())
                    exact = 1 / (1 + (waves * length) ** 2)
                    with self.subTest(kind=kind, on_points=on_points, waves=waves, length=length, kept=kept, exact=exact):
                        self.assertLess(abs(kept[0] / kept[1] - 1), 0.01)
                        self.assertLess(abs(kept[1] / exact - 1), 0.06)

    def test_values_of_functions_are_smoothed_as_well(self):
        for n in (30, 60):
            points, triangles = tube(n)
            mesh = surface(points, triangles)
            wave = np.cos(2 * points[:, 0])
            add(mesh.GetPointData(), "Wave", wave)
            field = smooth_field(mesh, Discretisation="ScalarFunction", Values="Wave", SmoothingLength=0.5 / mesh.GetLength(),
                                 Tolerance=1e-8)
            found = vtk_to_numpy(field.GetPointData().GetArray("ScalarFunction"))
            self.assertAlmostEqual((found * wave).sum() / (wave ** 2).sum(), 0.5, delta=0.01)

    def test_a_length_is_positive(self):
        mesh, _ = with_wave(12, 1, False)
        with self.assertRaisesRegex(FieldError, "Smoothing Length is -1"):
            smooth_field(mesh, Directions="Wave", SmoothingLength=-1.0)

    def test_eastward_and_northward(self):
        points, triangles = tube(12)
        mesh = surface(points, triangles)  # around the x-axis
        for attributes, places in ((mesh.GetPointData(), points), (mesh.GetCellData(), points[triangles].mean(1))):
            where = "P" if attributes is mesh.GetPointData() else "C"
            add(attributes, "East" + where, np.full(len(places), 3.0))
            add(attributes, "North" + where, np.zeros(len(places)))
        around = np.cross((1.0, 0, 0), points[triangles].mean(1))
        for where in "PC":
            vectors = add(mesh.GetCellData(), "Instead", np.tile((1.0, 2.0, 3.0), (len(triangles), 1))).GetName()
            field = smooth_field(mesh, n=1, Eastward="East" + where, Northward="North" + where, Axis=(1.0, 0, 0),
                                 ConstraintType="Hard", Directions=vectors)  # which do not count then
            self.assertEqual(field.GetFieldData().GetAbstractArray("Followed").GetValue(0),
                             f"array 'East{where}' and array 'North{where}'")
            found = vtk_to_numpy(field.GetCellData().GetArray("Direction0"))
            cosines = (found * around).sum(1) / np.linalg.norm(around, axis=1)
            self.assertGreater(cosines.min(), 0.99, where)
        with self.assertRaisesRegex(FieldError, "no northward component"):
            smooth_field(mesh, n=1, Eastward="EastP")
        with self.assertRaisesRegex(FieldError, "no eastward component"):
            smooth_field(mesh, n=1, Northward="NorthP")
        with self.assertRaisesRegex(FieldError, r"Axis is \(0, 0, 0\)"):
            smooth_field(mesh, n=1, Eastward="EastP", Northward="NorthP", Axis=(0.0, 0, 0))

    def test_tensors_weigh_by_their_difference(self):
        points, triangles = tube(12)
        mesh = surface(points, triangles)
        difference = np.where(np.arange(len(triangles)) % 2, 3.0, 1.0)  # along and around
        tensors = np.zeros((len(triangles), 6))
        tensors[:, 0] = 5 + difference
        tensors[:, 1] = tensors[:, 2] = 5
        add(mesh.GetCellData(), "Stress", tensors)
        for weighs, expected in ((False, np.ones(len(triangles))), (True, difference / 2)):
            field = smooth_field(mesh, n=2, Discretisation="PowerField", Directions="Stress", TensorWeights=weighs)
            found = vtk_to_numpy(field.GetCellData().GetArray("Prescribed"))
            self.assertTrue(np.allclose(found, expected, rtol=1e-9), (weighs, found[:4]))
            # At points, the mean of the cells around by area; all lines run along the tube.
            field = smooth_field(mesh, n=2, Directions="Stress", TensorWeights=weighs)
            areas = 0.5 * np.linalg.norm(np.cross(points[triangles[:, 1]] - points[triangles[:, 0]],
                                                  points[triangles[:, 2]] - points[triangles[:, 0]]), axis=1)
            sums = [np.bincount(triangles.ravel(), np.repeat(a, 3), len(points)) for a in (areas * expected, areas)]
            found = vtk_to_numpy(field.GetPointData().GetArray("Prescribed"))
            self.assertTrue(np.allclose(found, sums[0] / sums[1], rtol=1e-9), (weighs, found[:4]))
            for attributes in (field.GetPointData(), field.GetCellData()):
                along = np.abs(vtk_to_numpy(attributes.GetArray("Direction0"))[:, 0])
                self.assertGreater(along.min(), 0.99)  # the triangles lean by 5 degrees


if __name__ == "__main__":
    unittest.main()
