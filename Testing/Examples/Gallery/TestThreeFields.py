"""The three fields of the gallery are what the help says of them, and their pictures show something."""

import os
import pathlib
import tempfile
import unittest

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy

import three_fields
from TestGallery import cells, corners, fetch, normals, picture, unit


class ThreeFields(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.addClassCleanup(os.chdir, os.getcwd())
        os.chdir(folder.name)
        data = pathlib.Path(three_fields.__file__).resolve().parents[3] / "Data"
        proxies = three_fields.main(str(data / "double_torus.vtp"), subdivisions=1)
        cls.fields = {name: fetch(field) for name, field in proxies.items()}
        cls.corners = corners(cls.fields["face_field"]).astype(float)
        cls.pictures = {name: picture(f"{name}.png") for name in cls.fields}

    def cells(self, name, array):
        return cells(self.fields[name], array)

    def test_pictures(self):
        for name, pixels in self.pictures.items():
            with self.subTest(name=name):
                self.assertEqual(pixels.shape, (2700 * (2400 if name == "one_form" else 1890), 3))  # with a legend
                background = (pixels == 255).all(axis=1).mean()
                self.assertTrue(0.05 < background < 0.6, background)
                self.assertGreater(len(np.unique(pixels, axis=0)), 1000)

    def test_singularities(self):
        for name, field in self.fields.items():  # Poincare and Hopf: Euler's characteristic, -2
            with self.subTest(name=name):
                attributes = field.GetCellData() if name == "power_field" else field.GetPointData()
                index = vtk_to_numpy(attributes.GetArray("SingularityIndex"))
                self.assertAlmostEqual(index.sum(), -2, delta=1e-9)

    def test_hard_constraints(self):
        """Each arrow holds the faces below it: a unit vector in their planes, its own way."""
        a, b, c = np.moveaxis(self.corners, 1, 0)
        n = normals(self.fields["face_field"])
        for start, end in np.array(three_fields.STROKES):
            way = (end - start) / np.linalg.norm(end - start)
            near = np.linalg.norm((a + b + c) / 3 - (start + end) / 2, axis=1) < 0.15
            where = (self.cells("face_field", "Prescribed") > 0) & near
            self.assertTrue(where.any())
            expected = unit(way - n[where] * (n[where] @ way)[:, None])
            np.testing.assert_allclose(self.cells("face_field", "FaceField")[where], expected, atol=1e-5)
            first = self.cells("power_field", "Direction0")[where]
            across = np.cross(n[where], first)
            crosses = np.stack([first, across, -first, -across])
            # A point has the mean of the faces there that the arrow passes, which lie in planes of their own.
            planes = np.abs(n[where] @ n[where].mean(axis=0))
            self.assertLess(np.linalg.norm(crosses - expected, axis=2).min(axis=0).max(),
                            1e-5 + 2 * np.arccos(np.minimum(1, planes)).max())

    def test_two_discretisations_of_the_same_flow(self):
        a, b, c = np.moveaxis(self.corners, 1, 0)
        area = np.linalg.norm(np.cross(b - a, c - a), axis=1)

        def norm(vectors):
            return (area * (vectors ** 2).sum(axis=1)).sum() ** 0.5

        face, form = self.cells("face_field", "Direction0"), self.cells("one_form", "Direction0")
        self.assertLess(norm(face - form), 0.05 * norm(face))


if __name__ == "__main__":
    unittest.main()
