"""Files for remeshers, read back by parsers that know only what the formats say."""

import os
import subprocess
import sys
import tempfile
import unittest

import numpy as np
from vtkmodules.vtkCommonCore import vtkDoubleArray
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkFiltersCore import vtkCleanPolyData, vtkTriangleFilter
from vtkmodules.vtkFiltersSources import vtkCubeSource, vtkPlaneSource
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter

from directionalmultigrid import FieldError, smooth_field, write_raw_field, write_rosy, write_sharp
from surfaces import add, prism, surface, torus, values


def numbers(path, separator=None):
    """The file's lines as lists of numbers."""
    with open(path, encoding="ascii") as file:
        text = file.read()
    assert text.endswith("\n")  # Directional's reader fails at the end of a file without
    return [[float(word) for word in line.split(separator)] for line in text.splitlines()]


def cube():
    """A cube of 12 triangles."""
    source, triangles, clean = vtkCubeSource(), vtkTriangleFilter(), vtkCleanPolyData()
    triangles.SetInputConnection(source.GetOutputPort())
    clean.SetInputConnection(triangles.GetOutputPort())
    clean.Update()
    return surface([clean.GetOutput().GetPoint(i) for i in range(8)], faces(clean.GetOutput()))


def faces(mesh):
    """The points of each triangle."""
    return np.array([[mesh.GetCell(cell).GetPointId(j) for j in range(3)] for cell in range(mesh.GetNumberOfCells())])


class Export(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.path = os.path.join(folder.name, "field")

    def sharp_edges(self, mesh, *arguments):
        """{pair of points: kind}, each listed once."""
        write_sharp(self.path, mesh, *arguments)
        (count,), *rows = numbers(self.path, ",")
        self.assertEqual(count, len(rows))
        triangles = faces(mesh)
        edges = {}
        for kind, face, side in np.array(rows, int).reshape(-1, 3):
            edges[frozenset(np.roll(triangles[face], -side)[:2].tolist())] = kind
        self.assertEqual(len(edges), count)
        return edges

    def test_a_line_that_was_added_after_the_field_is_an_error(self):
        field, line = smooth_field(torus(20, 10)), vtkCellArray()
        line.InsertNextCell(2, [0, 1])
        field.SetLines(line)
        with self.assertRaisesRegex(FieldError, "Direction0 has 400 tuples for 401 cells; .*compute it again"):
            write_rosy(self.path, field)
        write_rosy(self.path, smooth_field(field))  # which knows of the line
        self.assertEqual(numbers(self.path)[:2], [[400], [4]])

    def test_rosy_has_a_unit_direction_of_each_face(self):
        mesh = smooth_field(torus(12, 8), UnitLength=False)
        write_rosy(self.path, mesh)
        (count,), (n,), *rows = numbers(self.path)
        self.assertEqual((count, n), (192, 4))
        read = np.array(rows)
        np.testing.assert_allclose(np.linalg.norm(read, axis=1), 1, rtol=1e-15)
        given = values(mesh.GetCellData(), "Direction0")
        angles = np.arccos(np.clip(np.sum(read * given, axis=1) / np.linalg.norm(given, axis=1), -1, 1))
        self.assertLess(angles.max(), 1e-7)

    def test_raw_field_has_all_directions_to_the_last_bit(self):
        for n in (1, 2, 3, 6):
            mesh = smooth_field(torus(12, 8), n=n, UnitLength=False, AllDirections=True)
            write_raw_field(self.path, mesh)
            header, *rows = numbers(self.path)
            self.assertEqual(header, [n, 192])
            given = np.stack([values(mesh.GetCellData(), f"Direction{k}") for k in range(n)], axis=1)
            np.testing.assert_array_equal(np.array(rows).reshape(-1, n, 3), given)

    def test_raw_field_has_directions_that_the_mesh_has_not(self):
        """Those that the solver does not write, since they follow from the first."""
        for n in (1, 2, 3, 6):
            write_raw_field(self.path, smooth_field(torus(12, 8), n=n, AllDirections=True))
            all_of_them = np.array(numbers(self.path)[1:])
            write_raw_field(self.path, smooth_field(torus(12, 8), n=n))
            header, *rows = numbers(self.path)
            self.assertEqual(header, [n, 192])
            np.testing.assert_allclose(np.array(rows), all_of_them, atol=1e-12)

    def test_raw_field_goes_counter_clockwise(self):
        """From one direction to the next it is a turn by 2 pi / 5 about the normal, here z."""
        plane = vtkPlaneSource()
        triangles = vtkTriangleFilter()
        triangles.SetInputConnection(plane.GetOutputPort())
        triangles.Update()
        write_raw_field(self.path, smooth_field(triangles.GetOutput(), n=5))
        _, *rows = numbers(self.path)
        directions = np.array(rows).reshape(-1, 5, 3)
        turns = np.angle((directions[:, 1:] @ (1, 1j, 0)) / (directions[:, :-1] @ (1, 1j, 0)))
        np.testing.assert_allclose(turns, 2 * np.pi / 5, rtol=1e-12)

    def test_raw_field_goes_counter_clockwise_whatever_the_order_of_arrays_is(self):
        mesh = vtkPlaneSource()
        triangles = vtkTriangleFilter()
        triangles.SetInputConnection(mesh.GetOutputPort())
        triangles.Update()
        mesh = triangles.GetOutput()
        for name, quarter in zip(range(4), (0, 2, 1, 3)):
            angle = 0.2 + quarter * np.pi / 2
            add(mesh.GetCellData(), f"Direction{name}", np.tile([np.cos(angle), np.sin(angle), 0], (mesh.GetNumberOfCells(), 1)))
        write_raw_field(self.path, mesh)
        _, *rows = numbers(self.path)
        directions = np.array(rows).reshape(-1, 4, 3)
        turns = np.angle((directions[:, 1:] @ (1, 1j, 0)) / (directions[:, :-1] @ (1, 1j, 0)))
        np.testing.assert_allclose(turns, np.pi / 2, rtol=1e-12)

    def test_faces_are_the_polygons_whatever_stands_before_them(self):
        """Vertices and lines of a mesh have cells, too, which no file of faces counts."""
        mesh = torus(12, 8)
        write_rosy(self.path, smooth_field(mesh))
        alone = numbers(self.path)
        for cells, points in ((mesh.SetVerts, [0]), (mesh.SetLines, [0, 1])):
            array = vtkCellArray()
            array.InsertNextCell(len(points), points)
            cells(array)
        write_rosy(self.path, smooth_field(mesh))
        np.testing.assert_allclose(np.array(numbers(self.path)[2:]), np.array(alone[2:]), atol=1e-12)

    def test_sharp_edges_of_a_cube_are_its_twelve_sides(self):
        mesh = cube()
        sides = {frozenset((i, j)) for i in range(8) for j in range(i)
                 if np.isclose(np.linalg.norm(np.subtract(mesh.GetPoint(i), mesh.GetPoint(j))), 1)}
        self.assertEqual(self.sharp_edges(mesh), dict.fromkeys(sides, 1))
        self.assertEqual(self.sharp_edges(mesh, 89.0), dict.fromkeys(sides, 1))
        self.assertEqual(self.sharp_edges(mesh, 91.0), {})
        inside_out = surface([mesh.GetPoint(i) for i in range(8)], faces(mesh)[:, ::-1])
        self.assertEqual(self.sharp_edges(inside_out), dict.fromkeys(sides, 0))

    def test_the_inner_edge_of_an_L_is_concave(self):
        edges = self.sharp_edges(prism())
        self.assertEqual(len(edges), 18)
        self.assertEqual([set(edge) for edge, kind in edges.items() if kind == 0], [{3, 9}])

    def test_the_boundary_is_sharp(self):
        edges = self.sharp_edges(surface([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)], [(0, 1, 2), (0, 2, 3)]))
        self.assertEqual(edges, {frozenset(pair): 1 for pair in ((0, 1), (1, 2), (2, 3), (3, 0))})

    def test_errors_leave_no_file(self):
        mesh = smooth_field(torus(12, 8))
        mesh.GetCellData().GetArray("Direction0").SetTuple3(5, 0, 0, 0)
        quads = vtkPlaneSource()
        quads.Update()
        for text, call in (("face 5 has no direction", lambda: write_rosy(self.path, mesh)),
                           ("no cell array Direction0", lambda: write_rosy(self.path, torus(12, 8))),
                           ("no cell array Direction0", lambda: write_raw_field(self.path, torus(12, 8))),
                           ("face 0 is not a triangle", lambda: write_sharp(self.path, quads.GetOutput()))):
            with self.subTest(text), self.assertRaisesRegex(FieldError, text):
                call()
        mesh.GetCellData().GetArray("Direction0").SetTuple3(7, 0, float("nan"), 0)
        with self.assertRaisesRegex(FieldError, "Direction0 is not finite on face 7"):
            write_raw_field(self.path, mesh)
        self.assertFalse(os.path.exists(self.path))

    def test_surfaces_are_checked_as_by_the_filters(self):
        def damaged(change):
            mesh = vtkPolyData()
            mesh.DeepCopy(smooth_field(torus(12, 8)))
            change(mesh)
            return mesh

        def add_cell(*points):
            def change(mesh):
                mesh.GetPolys().InsertNextCell(len(points), list(points))
                mesh.GetCellData().GetArray("Direction0").InsertNextTuple3(1, 0, 0)
            return change

        def say_number(*numbers):
            def change(mesh):
                array = vtkDoubleArray()
                array.SetName("NumberOfDirections")
                for number in numbers:
                    array.InsertNextValue(number)
                mesh.GetFieldData().AddArray(array)
            return change

        wrong = {"uses point 1000000000": add_cell(0, 1, 10**9), "uses point -1": add_cell(0, 1, -1), "fewer than three points": add_cell(),
                 "point 0 has a coordinate that is not finite": lambda mesh: mesh.GetPoints().SetPoint(0, float("nan"), 0, 0),
                 "point 3 .*1e": lambda mesh: mesh.GetPoints().SetPoint(3, 1e200, 0, 0)}
        for text, change in wrong.items():
            for write in (write_rosy, write_raw_field, write_sharp):
                with self.subTest(text, write=write.__name__), self.assertRaisesRegex(FieldError, text):
                    write(self.path, damaged(change))
        for numbers in ((), (0,), (-3,), (float("nan"),), (1e9,), (2.5,), (4, 4)):
            for write in (write_rosy, write_raw_field):
                with self.subTest(numbers), self.assertRaisesRegex(FieldError, "NumberOfDirections is not one number from 1 to 8"):
                    write(self.path, damaged(say_number(*numbers)))
        self.assertFalse(os.path.exists(self.path))

    def test_a_full_disk_leaves_the_former_file(self):
        mesh = smooth_field(torus(12, 8))
        with open(self.path, "w") as file:
            file.write("former")
        write_in_little_room = """if True:
            import resource, signal, sys
            from vtkmodules.vtkIOXML import vtkXMLPolyDataReader
            from directionalmultigrid import FieldError, update, write_rosy
            signal.signal(signal.SIGXFSZ, signal.SIG_IGN)
            reader = vtkXMLPolyDataReader()
            reader.SetFileName(sys.argv[1])
            mesh = update(reader)
            resource.setrlimit(resource.RLIMIT_FSIZE, (1000, 1000))
            try:
                write_rosy(sys.argv[2], mesh)
            except FieldError as error:
                print(error)
        """
        with tempfile.TemporaryDirectory() as folder:
            writer = vtkXMLPolyDataWriter()
            writer.SetFileName(os.path.join(folder, "mesh.vtp"))
            writer.SetInputData(mesh)
            writer.SetDataModeToBinary()
            writer.Write()
            done = subprocess.run([sys.executable, "-c", write_in_little_room, os.path.join(folder, "mesh.vtp"), self.path],
                                  check=True, text=True, stdout=subprocess.PIPE)
        self.assertIn("cannot be written", done.stdout)
        with open(self.path) as file:
            self.assertEqual(file.read(), "former")
        self.assertFalse(os.path.exists(self.path + ".part"))


if __name__ == "__main__":
    unittest.main()
