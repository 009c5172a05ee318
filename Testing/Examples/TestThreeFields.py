"""The three fields of the gallery are what the help says of them, and their pictures show something."""

import os
import pathlib
import tempfile
import unittest

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkPNGReader

import demo
import three_fields


class ThreeFields(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        folder = tempfile.TemporaryDirectory()
        cls.addClassCleanup(folder.cleanup)
        cls.addClassCleanup(os.chdir, os.getcwd())
        os.chdir(folder.name)
        data = pathlib.Path(three_fields.__file__).resolve().parents[2] / "Data"
        cls.data, cls.fields = three_fields.main(str(data / "double_torus.vtp"), subdivisions=1)
        cls.pictures = {}
        for name in cls.fields:
            reader = vtkPNGReader()
            reader.SetFileName(f"{name}.png")
            reader.Update()
            cls.pictures[name] = vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars())

    def cells(self, name, array):
        return vtk_to_numpy(self.fields[name].GetCellData().GetArray(array))

    def test_pictures(self):
        for name, pixels in self.pictures.items():
            with self.subTest(name=name):
                self.assertEqual(pixels.shape, (580 * 406, 3))
                background = (pixels == 255).all(axis=1).mean()
                self.assertTrue(0.05 < background < 0.6, background)
                self.assertGreater(len(np.unique(pixels, axis=0)), 1000)

    def test_singularities(self):
        for name, field in self.fields.items():  # Poincare and Hopf: Euler's characteristic, -2
            with self.subTest(name=name):
                index = vtk_to_numpy(field.GetPointData().GetArray("SingularityIndex"))
                self.assertAlmostEqual(index.sum(), -2, delta=1e-9)

    def test_hard_constraints(self):
        prescribed = vtk_to_numpy(self.data.GetCellData().GetArray("Prescription"))
        where = np.abs(prescribed).sum(axis=1) > 0
        self.assertTrue(where.any())
        np.testing.assert_allclose(self.cells("face_field", "FaceField")[where], prescribed[where],
                                   atol=1e-6)
        crosses = np.stack([self.cells("power_field", f"Direction{k}")[where] for k in range(4)])
        nearest = np.linalg.norm(crosses - prescribed[where], axis=2).min(axis=0)
        self.assertLess(nearest.max(), 1e-6)

    def test_two_discretisations_of_the_same_flow(self):
        points, triangles = demo.arrays_of(self.data)
        corners = points[triangles]
        area = np.linalg.norm(np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0]),
                              axis=1)

        def norm(vectors):
            return (area * (vectors ** 2).sum(axis=1)).sum() ** 0.5

        face, form = self.cells("face_field", "Direction0"), self.cells("one_form", "Direction0")
        self.assertLess(norm(face - form), 0.05 * norm(face))


if __name__ == "__main__":
    unittest.main()
