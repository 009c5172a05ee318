"""Files for remeshers, as their readers take them in.

Each reader here follows what the sources of one of them do, in the fewest words: quadwild's for .ply and .sharp, that of vcglib for .rosy,
and Directional's for .rawfield. What they know of the surface is the file of the mesh: its points and the corners of its faces, in order.
"""

import collections
import locale
import os
import re
import subprocess
import tempfile
import unittest
import unittest.mock
import warnings

import numpy as np
from vtkmodules.vtkCommonTransforms import vtkTransform
from vtkmodules.vtkFiltersCore import vtkAppendPolyData
from vtkmodules.vtkFiltersGeneral import vtkTransformFilter
from vtkmodules.vtkFiltersModeling import vtkLinearSubdivisionFilter
from vtkmodules.vtkFiltersSources import vtkPlaneSource
from vtkmodules.vtkIOPLY import vtkPLYWriter

from directionalmultigrid import FieldWarning, smooth_field, update, write_raw_field, write_rosy, write_sharp
from surfaces import corners, disc, grid, prism, surface, values, values_of_points


def text_of(path):
    with open(path, encoding="ascii") as file:
        return file.read()


def fine(mesh):
    subdivision = vtkLinearSubdivisionFilter()
    subdivision.SetNumberOfSubdivisions(2)
    subdivision.SetInputData(mesh)
    return update(subdivision)


def mirrored(mesh):
    """Its image in a mirror, whose faces look inside."""
    transform, mirror = vtkTransform(), vtkTransformFilter()
    transform.Scale(-1, 1, 1)
    mirror.SetTransform(transform)
    mirror.SetInputData(mesh)
    return update(mirror)


def together(*meshes):
    append = vtkAppendPolyData()
    for mesh in meshes:
        append.AddInputData(mesh)
    return update(append)


def half_turned(mesh):
    """Every second triangle the other way round."""
    return surface(values_of_points(mesh), [t[::-1] if k % 2 else t for k, t in enumerate(corners(mesh))])


SURFACES = {"a part": fine(prism()), "a mirrored part": mirrored(fine(prism())), "a disk": grid(6, disc),
            "a clockwise disk": mirrored(grid(6, disc)), "two parts": together(fine(prism()), grid(6, lambda x, y: (x, y, x - 5))),
            "a disk whose triangles are turned at random": half_turned(grid(6, disc))}


class Mesh:
    """What is in the file of a mesh."""

    def __init__(self, path):
        header, body = text_of(path).split("end_header\n")
        points, faces = (int(re.search(rf"element {name} (\d+)", header)[1]) for name in ("vertex", "face"))
        lines = [line.split() for line in body.splitlines()]
        self.points = np.array(lines[:points], float)
        assert all(line[0] == "3" for line in lines[points:]) and len(lines) == points + faces
        self.faces = np.array(lines[points:], int)[:, 1:]
        a, b, c = np.moveaxis(self.points[self.faces], 1, 0)
        self.normals = np.cross(b - a, c - a)
        self.normals /= np.linalg.norm(self.normals, axis=1)[:, None]
        self.sides = collections.defaultdict(list)  # (face, side) of each edge
        for face, (i, j, k) in enumerate(self.faces):
            for side, edge in enumerate(((i, j), (j, k), (k, i))):
                self.sides[frozenset(edge)].append((face, side))

    def load_rosy(self, path):
        """The number of faces, 4, and a vector for each, in single precision; the second one is perpendicular to it and the normal."""
        words = text_of(path).split()
        assert int(words[0]) == len(self.faces) and int(words[1]) == 4
        first = np.array(words[2:2 + 3 * len(self.faces)], np.float32).reshape(-1, 3)
        return first, np.cross(first, self.normals)

    def load_raw_field(self, path):
        """N, the number of faces, and N vectors for each. The stream has to be good in the end, so something follows the last number."""
        text = text_of(path)
        words = text.split()
        n, count = int(words[0]), int(words[1])
        assert count == len(self.faces) and len(words) >= 2 + 3 * n * count and text[-1].isspace()
        return np.array(words[2:2 + 3 * n * count], float).reshape(count, n, 3)

    def load_sharp(self, path):
        """A count, then "kind,face,side" for each; the side beyond has the same kind. Sides of more than two faces stand in a ring."""
        text = text_of(path)
        number, end = re.match(r"(\d+)", text)[1], re.match(r"\d+", text).end()
        kinds = {}
        for _ in range(int(number)):
            found = re.compile(r"\s*(\d+),(\d+),(\d+)").match(text, end)
            kind, face, side = map(int, found.groups())
            end = found.end()
            assert kind in (0, 1) and face < len(self.faces) and side < 3
            ring = self.sides[frozenset((self.faces[face][side], self.faces[face][(side + 1) % 3]))]
            beyond = ring[(ring.index((face, side)) + 1) % len(ring)]
            kinds[face, side] = kinds[beyond] = kind
        return kinds

    def sharp_by_geometry(self, degrees=30):
        """The same by the third corner of the face beyond: below the plane of the first face, the edge is convex."""
        kinds = {}
        for edge, sides in self.sides.items():
            kind = 1
            if len(sides) == 2:
                (first, _), (second, _) = sides
                corner, = set(self.faces[second]) - edge
                other, = set(self.faces[first]) - edge
                a, b = (self.points[i] for i in edge)
                along = (b - a) / np.linalg.norm(b - a)
                arms = [self.points[i] - a - (self.points[i] - a) @ along * along for i in (other, corner)]
                bend = 180 - np.degrees(np.arccos(np.clip(arms[0] @ arms[1] / np.linalg.norm(arms[0]) / np.linalg.norm(arms[1]), -1, 1)))
                if bend <= degrees:
                    continue
                kind = int((self.points[corner] - a) @ self.normals[first] < 0)
            kinds.update(dict.fromkeys(sides, kind))
        return kinds


class FilesOfRemeshers(unittest.TestCase):
    def setUp(self):
        folder = tempfile.TemporaryDirectory()
        self.addCleanup(folder.cleanup)
        self.folder = folder.name
        warnings.simplefilter("ignore", FieldWarning)

    def path(self, suffix):
        return os.path.join(self.folder, "part" + suffix)

    def saved(self, data):
        writer = vtkPLYWriter()
        writer.SetFileName(self.path(".ply"))
        writer.SetFileTypeToASCII()
        writer.SetInputData(data)
        writer.Write()
        return Mesh(self.path(".ply"))

    def crosses(self):
        """(name, mesh as its file has it, field, its directions) of each surface."""
        for name, data in SURFACES.items():
            field = smooth_field(data, BoundaryWeight=1, SharpEdgesWeight=1, AllDirections=True, UnitLength=False)
            directions = np.stack([values(field.GetCellData(), f"Direction{k}") for k in range(4)], 1)
            yield name, self.saved(field), field, directions

    def test_quadwild_finds_the_cross_of_each_face_in_rosy(self):
        for name, mesh, field, directions in self.crosses():
            write_rosy(self.path(".rosy"), field)
            unit = directions / np.linalg.norm(directions, axis=2)[..., None]
            for vector in mesh.load_rosy(self.path(".rosy")):
                self.assertLess(np.abs((vector * mesh.normals).sum(1)).max(), 1e-5, name)
                self.assertLess(np.linalg.norm(unit - vector[:, None], axis=2).min(1).max(), 1e-5, name)

    def test_directional_finds_each_vector_counter_clockwise_of_the_one_before(self):
        for name, mesh, field, directions in self.crosses():
            for there in ("all directions", "the first one"):
                write_raw_field(self.path(".rawfield"), field)
                vectors = mesh.load_raw_field(self.path(".rawfield"))
                np.testing.assert_array_equal(vectors[:, 0], directions[:, 0])
                turned = np.cross(mesh.normals[:, None], vectors)
                scale = np.linalg.norm(directions, axis=2).max()
                self.assertLess(np.abs(np.roll(vectors, -1, axis=1) - turned).max(), 1e-5 * scale, (name, there))
                for k in range(1, 4):
                    field.GetCellData().RemoveArray(f"Direction{k}")

    def test_quadwild_finds_sharp_edges_and_the_boundary(self):
        for name, mesh, field, _ in self.crosses():
            write_sharp(self.path(".sharp"), field)
            self.assertEqual(mesh.load_sharp(self.path(".sharp")), mesh.sharp_by_geometry(), name)

    def test_edges_of_three_faces_are_sharp_on_all_of_them(self):
        data = surface([(0, 0, 0), (0, 1, 0), (1, 0, 0), (-1, 0, 0), (0, 0, 1)], [(0, 2, 1), (0, 1, 3), (0, 1, 4)])
        write_sharp(self.path(".sharp"), data)
        mesh = self.saved(data)
        self.assertEqual(mesh.load_sharp(self.path(".sharp")), mesh.sharp_by_geometry())

    def test_faces_that_remeshers_would_split_are_warned_of(self):
        plane = vtkPlaneSource()
        plane.SetResolution(4, 4)
        field = smooth_field(update(plane))
        for write in (write_rosy, write_raw_field):
            with self.assertWarnsRegex(FieldWarning, "face 0 is not a triangle, .*; apply Triangulate"):
                write(self.path(".txt"), field)

    def test_numbers_have_a_point_where_the_locale_has_a_comma(self):
        locale_folder = unittest.mock.patch.dict(os.environ, LOCPATH=self.folder)
        locale_folder.start()
        self.addCleanup(locale_folder.stop)
        self.addCleanup(locale.setlocale, locale.LC_NUMERIC, "C")
        try:
            subprocess.run(["localedef", "-i", "de_DE", "-f", "UTF-8", self.path(".UTF-8")], check=True, capture_output=True)
            locale.setlocale(locale.LC_NUMERIC, "part.UTF-8")
        except (OSError, subprocess.CalledProcessError, locale.Error):
            self.skipTest("there is no locale with a comma")
        self.assertEqual(locale.localeconv()["decimal_point"], ",")
        field = smooth_field(SURFACES["a disk"])
        for write in (write_rosy, write_raw_field):
            write(self.path(".txt"), field)
            self.assertFalse("," in text_of(self.path(".txt")))


if __name__ == "__main__":
    unittest.main()
