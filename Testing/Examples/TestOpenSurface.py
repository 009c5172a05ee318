"""The demo opens every format that it promises: a cube of squares becomes 8 points, 12 triangles."""

import pathlib
import tempfile
import unittest

import paraview.simple as simple

import demo

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
4 3 0 4 7
"""


class OpenSurface(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.path = pathlib.Path(self.folder.name)
        (self.path / "cube.off").write_text(OFF)

    def assert_is_cube(self, path):
        data = simple.servermanager.Fetch(demo.open_surface(str(path)))
        points, triangles = demo.arrays_of(data)
        self.assertEqual((len(points), len(triangles)), (8, 12))
        normals = demo.normals_of(points, triangles)
        outwards = points[triangles].mean(axis=1) - 0.5
        self.assertTrue(((normals * outwards).sum(axis=1) > 0).all())

    def test_off(self):
        self.assert_is_cube(self.path / "cube.off")

    def test_formats_that_paraview_writes(self):
        cube = simple.Triangulate(Input=demo.source(demo.read_off(self.path / "cube.off")))
        for ending in ("ply", "stl", "vtk", "vtp"):
            with self.subTest(ending=ending):
                path = self.path / f"cube.{ending}"
                simple.SaveData(str(path), cube)
                self.assert_is_cube(path)

    def test_obj(self):
        lines = OFF.splitlines()[3:11]
        faces = [[int(i) + 1 for i in line.split("#")[0].split()[1:]]
                 for line in OFF.splitlines()[11:]]
        text = [f"v {line}" for line in lines]
        text += ["f " + " ".join(map(str, face)) for face in faces]
        (self.path / "cube.obj").write_text("\n".join(text) + "\n")
        self.assert_is_cube(self.path / "cube.obj")

    def test_off_with_more_than_points_is_refused(self):
        (self.path / "cube.off").write_text("C" + OFF)
        with self.assertRaises(SystemExit):
            demo.open_surface(str(self.path / "cube.off"))


if __name__ == "__main__":
    unittest.main()
