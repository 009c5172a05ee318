"""Every filter that draws a field, or makes quads along it, does what geometry asks, however a file lays its surface out."""

import os
import tempfile
import unittest
import warnings

import numpy as np
from directionalmultigrid import FieldWarning, update, write_rosy
from directionalmultigrid.vtkFiltersDirectionalFields import (vtkFieldAngles, vtkFieldGlyphs, vtkFieldLines, vtkFieldQuads,
                                                             vtkFieldSingularities)
from layouts import CELLS, CENTRES, LAYOUTS, POINTS, Layout, directions
from surfaces import values, values_of_points
from vtkmodules.util.numpy_support import vtk_to_numpy

WIDTH, HEIGHT = 1.0, 0.75
DIAGONAL = np.hypot(WIDTH, HEIGHT)
LONGEST = np.hypot(1.4, 1.4) / 12  # of edges: points move by at most a fifth of a square each way
# Directions turn by at most that much from the middle of a cell to any place of it: their gradient is at most (1.2, 1).
FARTHEST = np.degrees(np.hypot(1.2, 1.0)) * 2 / 3 * LONGEST
DEFECTS = {(0.31, 0.34): 0.5, (0.72, 0.47): -0.5}  # not at points
PLACES = np.stack(np.meshgrid(np.linspace(0.03, 0.97, 30), np.linspace(0.03, 0.72, 24)), -1).reshape(-1, 2)


def turned(vectors, degrees):
    """In the plane of the surface, counter-clockwise."""
    x, y, z = vectors.T
    c, s = np.cos(np.radians(degrees)), np.sin(np.radians(degrees))
    return np.stack([c * x - s * y, s * x + c * y, z], 1)


def defects(at):
    """Lines with two singular points."""
    angle = sum(index * np.arctan2(at[:, 1] - y, at[:, 0] - x) for (x, y), index in DEFECTS.items())
    return np.stack([np.cos(angle), np.sin(angle), 0 * angle], 1)


def leaning(at):
    """Crosses that turn slowly, so that squares of one size can follow them."""
    angle = 0.5 + 0.1 * (at[:, 0]**2 - at[:, 1]**2) + 0.1 * at[:, 0]
    return np.stack([np.cos(angle), np.sin(angle), 0 * angle], 1)


def spiral(at):
    """40 degrees from the radius around a place."""
    radius = at - [0.53, 0.38, 0]
    return turned(radius / np.linalg.norm(radius, axis=1)[:, None], 40)


def segments(layout, lines):
    """Starts and ends of the segments of lines, in the plane of the surface, and the line of each."""
    cells = lines.GetLines()
    ends = vtk_to_numpy(cells.GetOffsetsArray())
    along = vtk_to_numpy(cells.GetConnectivityArray())
    line = np.repeat(np.arange(len(ends) - 1), np.diff(ends))
    at = layout.own(values_of_points(lines))[along]
    is_segment = line[1:] == line[:-1]
    return at[:-1][is_segment], at[1:][is_segment], line[1:][is_segment]


def degrees_off(vectors, right, n):
    """Angles between vectors and the nearest of n directions."""
    numbers, others = (v[:, 0] + 1j * v[:, 1] for v in (vectors, right))
    return np.degrees(np.abs(np.angle((numbers / others)**n))) / n


def nearest(places, others):
    return np.sqrt(((places[:, None] - others[None])**2).sum(-1).min(1))


class LayoutsOfDrawings(unittest.TestCase):
    def lay_out(self, on_points, options):
        layout = Layout(POINTS, CELLS, **options)
        at = POINTS if on_points else CENTRES
        for name, vectors in {"directions": directions(at), "turned": turned(directions(at), 20), "defects": defects(at),
                              "leaning": leaning(at), "spiral": spiral(at)}.items():
            layout.add(name, vectors, on_points)
        return layout

    def update(self, filter, layout, on_points, n, *names, **properties):
        filter.SetInputData(layout.data)
        filter.SetNumberOfDirections(n)
        for index, name in enumerate(names):
            filter.SetInputArrayToProcess(index, 0, 0, 0 if on_points else 1, name)
        for name, value in properties.items():
            getattr(filter, "Set" + name)(value)
        return update(filter)

    def in_every_layout(self, check):
        for name, options in {"plain": {}, **LAYOUTS}.items():
            for on_points in (True, False):
                with self.subTest(layout=name, on_points=on_points), warnings.catch_warnings():
                    warnings.simplefilter("ignore", FieldWarning)  # cells that are turned, points that are joined
                    check(self.lay_out(on_points, options), on_points)

    def test_lines_follow_the_field_everywhere(self):
        def check(layout, on_points):
            lines = self.update(vtkFieldLines(), layout, on_points, 4, "directions", SeparatingDistance=0.04, MinimumLength=0)
            start, end, line = segments(layout, lines)
            length = np.linalg.norm(end - start, axis=1)
            is_long = length > 1e-4  # others run past a corner, and are rounding
            off = degrees_off(end - start, directions((start + end) / 2), 4)
            self.assertLess(off[is_long].max(), FARTHEST)
            self.assertLess(off @ length / length.sum(), FARTHEST / 3)
            np.testing.assert_allclose(start[:, 2], 0, atol=1e-6)
            np.testing.assert_allclose(np.bincount(line, length), values(lines.GetCellData(), "Length")[:line.max() + 1] / layout.scale,
                                       rtol=1e-3, atol=1e-3)
            for branch in (0, 1):
                on_branch = values(lines.GetCellData(), "Branch")[line] == branch
                at = np.concatenate([start[on_branch], end[on_branch]])[:, :2]
                self.assertLess(nearest(PLACES, at).max(), 1.5 * 0.04 * DIAGONAL)

        self.in_every_layout(check)

    def test_glyphs_point_along_the_field(self):
        def check(layout, on_points):
            glyphs = self.update(vtkFieldGlyphs(), layout, on_points, 4, "directions", SeparatingDistance=0.06,
                                 Style=vtkFieldGlyphs.Strokes)
            start, end, line = segments(layout, glyphs)
            first = np.searchsorted(line, np.arange(line.max() + 1))
            is_long = np.linalg.norm(end - start, axis=1)[first] > 1e-4  # others end at the boundary where they begin
            number = values(glyphs.GetCellData(), "Direction")
            for k in range(4):  # counter-clockwise, seen from the positive side
                mine = first[(number == k) & is_long]
                right = turned(directions(start[mine]), layout.side * 90 * k)
                self.assertLess(degrees_off(end[mine] - start[mine], right, 1).max(), FARTHEST)
            centres = start[first[number == 0]][:, :2]
            apart = np.linalg.norm(centres[:, None] - centres[None], axis=-1) + 9 * np.eye(len(centres))
            self.assertGreater(apart.min(), 0.999 * 0.06 * DIAGONAL)
            self.assertLess(nearest(PLACES, centres).max(), 1.5 * 0.06 * DIAGONAL)

        self.in_every_layout(check)

    def test_arrows_point_ahead(self):
        def check(layout, on_points):
            glyphs = self.update(vtkFieldGlyphs(), layout, on_points, 1, "directions", Style=vtkFieldGlyphs.Strokes,
                                 Placement=vtkFieldGlyphs.EveryTriangle)
            start, end, line = segments(layout, glyphs)
            triangles = sum(len(cell) - 2 for cell in CELLS)
            number = values(glyphs.GetCellData(), "Glyph")
            self.assertEqual(len(np.unique(number)), triangles)
            first = np.searchsorted(line, np.unique(number, return_index=True)[1])
            self.assertLess(degrees_off(end[first] - start[first], directions(start[first]), 1).max(), FARTHEST)

        self.in_every_layout(check)

    def test_angles_to_a_field_that_is_turned(self):
        def check(layout, on_points):
            for n in (1, 2, 4):
                output = self.update(vtkFieldAngles(), layout, on_points, n, "turned", "directions")
                np.testing.assert_allclose(layout.get(output, "Angle", False), 20 * layout.side, atol=0.1 if on_points else 2e-3)

        self.in_every_layout(check)

    def test_singularities_stand_where_they_are(self):
        def check(layout, on_points):
            filter = vtkFieldSingularities()
            points = self.update(filter, layout, on_points, 2, "defects")
            found = dict(zip(values(points.GetPointData(), "Index"), layout.own(values_of_points(points))))
            self.assertEqual(sorted(found), [-0.5, 0.5])
            self.assertEqual(points.GetNumberOfPoints(), 2)
            for place, index in DEFECTS.items():
                self.assertLess(np.linalg.norm(found[index][:2] - place), LONGEST)
            self.assertEqual(values(points.GetFieldData(), "SumOfIndices")[0], 1)
            self.assertEqual(values(filter.GetOutputDataObject(2).GetCellData(), "Index"), [1])

        self.in_every_layout(check)

    def test_a_spiral_turns_as_it_does(self):
        def check(layout, on_points):
            points = self.update(vtkFieldSingularities(), layout, on_points, 1, "spiral")
            self.assertEqual(values(points.GetPointData(), "Index"), [1])
            self.assertAlmostEqual(values(points.GetPointData(), "SpiralAngle")[0], 40 * layout.side, delta=3)

        self.in_every_layout(check)

    def test_quads_follow_the_field(self):
        def check(layout, on_points):
            result = self.update(vtkFieldQuads(), layout, on_points, 4, "leaning", NumberOfQuads=600, AlignBoundary=False)
            at = layout.own(values_of_points(result))
            corners = vtk_to_numpy(result.GetPolys().GetConnectivityArray()).reshape(-1, 4)
            edges = np.sort(np.stack([corners, np.roll(corners, -1, axis=1)], -1).reshape(-1, 2), axis=1)
            edges, count = np.unique(edges, axis=0, return_counts=True)
            inside = ~np.isin(edges, edges[count == 1]).any(1)  # the boundary cuts across the others
            start, end = at[edges[inside].T]
            off = degrees_off(end - start, leaning((start + end) / 2), 4)
            self.assertLess(off.mean(), 2)
            self.assertLess(np.percentile(off, 90), 5)
            self.assertAlmostEqual(len(corners), 600, delta=30)
            self.assertTrue(np.all(values(result.GetPointData(), "Irregular") == 0))  # as the field has no singularities
            x, y = at[corners][..., 0], at[corners][..., 1]
            area = 0.5 * np.abs((x * np.roll(y, -1, 1) - y * np.roll(x, -1, 1)).sum(1)).sum()
            self.assertAlmostEqual(area / (WIDTH * HEIGHT), 1, delta=0.02)

        self.in_every_layout(check)

    def test_files_have_the_directions_of_cells(self):
        def check(layout, on_points):
            if on_points:
                return
            layout.add("Direction0", directions(CENTRES), False)
            with tempfile.TemporaryDirectory() as folder:
                name = os.path.join(folder, "field.rosy")
                write_rosy(name, layout.data)
                with open(name) as file:
                    number, n = int(file.readline()), int(file.readline())
                    vectors = np.loadtxt(file)
            self.assertEqual((number, n), (len(CELLS), 1))
            np.testing.assert_allclose(vectors @ layout.rotation, directions(CENTRES)[layout.cells], atol=1e-5)

        self.in_every_layout(check)


if __name__ == "__main__":
    unittest.main()
