"""The demo opens every format that it promises: a cube of squares becomes 8 points, 12 triangles."""

import pathlib
import tempfile
import unittest

import numpy as np
import paraview.simple as simple
from vtkmodules.util.numpy_support import vtk_to_numpy

import demo
import off_to_ply

OFF = """OFF
# a cube
8 6 0
0 0 0
1 0 0
1 1 0
0 1 0
0 0 1
1 0 1
1 1 1
0 1 1
4 3 2 1 0
4 4 5 6 7
4 0 1 5 4
4 1 2 6 5  # a side
4 2 3 7 6
4 3 0 4 7 255 0 0
"""


class OpenSurface(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.path = pathlib.Path(self.folder.name)
        (self.path / "cube.off").write_text(OFF)
        off_to_ply.convert(self.path / "cube.off", self.path / "cube.ply")

    def assert_is_cube(self, path):
        data = simple.servermanager.Fetch(demo.open_surface(str(path)))
        points = vtk_to_numpy(data.GetPoints().GetData())
        triangles = vtk_to_numpy(data.GetPolys().GetConnectivityArray()).reshape(-1, 3)
        self.assertEqual((len(points), len(triangles)), (8, 12))
        a, b, c = (points[triangles[:, k]] for k in range(3))
        outwards = (a + b + c) / 3 - 0.5
        self.assertTrue(((np.cross(b - a, c - a) * outwards).sum(axis=1) > 0).all())

    def test_off_made_into_ply(self):
        self.assert_is_cube(self.path / "cube.ply")

    def test_formats_that_paraview_writes(self):
        cube = simple.Triangulate(Input=simple.OpenDataFile(str(self.path / "cube.ply")))
        for ending in ("ply", "stl", "vtk", "vtp"):
            with self.subTest(ending=ending):
                path = self.path / f"written.{ending}"
                simple.SaveData(str(path), cube)
                self.assert_is_cube(path)

    def test_obj(self):
        lines = OFF.splitlines()[3:11]
        faces = [[int(i) + 1 for i in line.split()[1:5]] for line in OFF.splitlines()[11:]]
        text = [f"v {line}" for line in lines]
        text += ["f " + " ".join(map(str, face)) for face in faces]
        (self.path / "cube.obj").write_text("\n".join(text) + "\n")
        self.assert_is_cube(self.path / "cube.obj")

    def test_off_with_more_than_points_is_refused(self):
        (self.path / "cube.off").write_text("C" + OFF)
        with self.assertRaises(SystemExit):
            off_to_ply.convert(self.path / "cube.off", self.path / "cube.ply")


if __name__ == "__main__":
    unittest.main()
