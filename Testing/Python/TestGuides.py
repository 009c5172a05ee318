"""Guides in plain Python: numpy arrays that fit, and some that do not."""

import locale
import unittest

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import (
    vtkDataObject, vtkMultiBlockDataSet, vtkPolyData, vtkTable)
from vtkmodules.vtkFiltersModeling import vtkLinearSubdivisionFilter
from vtkmodules.vtkFiltersSources import vtkLineSource

from directionalmultigrid.vtkFiltersDirectionalFields import vtkHarmonicFieldSolver
from surfaces import add, corners, torus, values, values_of_points

POINTS = vtkDataObject.FIELD_ASSOCIATION_POINTS


def points_at(positions, vectors):
    data = vtkPolyData()
    data.SetPoints(vtkPoints())
    data.GetPoints().SetData(numpy_to_vtk(np.asarray(positions, float), deep=True))
    add(data.GetPointData(), "Wind", vectors)
    return data


def subdivided(surface):
    """Each triangle in four, which have its place in the order."""
    subdivision = vtkLinearSubdivisionFilter()
    subdivision.SetInputData(surface)
    subdivision.Update()
    return subdivision.GetOutput()


def scaled(data, factor):
    copy = vtkPolyData()
    copy.DeepCopy(data)
    points = numpy_to_vtk(factor * values_of_points(data), deep=True)
    copy.GetPoints().SetData(points)
    return copy


class LinesOnAnySurface(unittest.TestCase):
    """What a soft line means depends neither on the size of a surface nor on its resolution."""

    def setUp(self):
        self.lines = []
        for start, end in (((1.1, 0.1, 0.4), (1.3, 0.4, 0.4)), ((-1, -0.9, 0.3), (-0.6, -1.2, 0.3))):
            line = vtkLineSource()
            line.SetPoint1(start)
            line.SetPoint2(end)
            line.Update()
            self.lines.append(line.GetOutput())

    def field(self, surface, lines, number, constraints):
        solver = vtkHarmonicFieldSolver()
        solver.SetInputData(surface)
        for line in lines:
            solver.AddInputDataObject(1, line)
        solver.SetNumberOfDirections(number)
        solver.SetConstraintType(constraints)
        solver.SetTolerance(1e-10)
        solver.UnitLengthOff()
        solver.Update()
        return values(solver.GetOutput().GetCellData(), "Direction0").copy()

    def test_scaling_changes_nothing(self):
        surface = torus(60, 40)
        soft = vtkHarmonicFieldSolver.Soft
        field = self.field(surface, self.lines, 1, soft)
        large = self.field(scaled(surface, 1000), [scaled(line, 1000) for line in self.lines], 1, soft)
        self.assertLess(np.linalg.norm(large - field), 1e-5 * np.linalg.norm(field))

    def test_a_subdivision_changes_no_more_than_where_the_lines_hold_exactly(self):
        coarse = torus(60, 40)
        fine = subdivided(coarse)
        triangles = values_of_points(coarse)[corners(coarse)]
        x = triangles[:, 1] - triangles[:, 0]
        x /= np.linalg.norm(x, axis=1, keepdims=True)
        normal = np.cross(x, triangles[:, 2] - triangles[:, 0])
        y = np.cross(normal / np.linalg.norm(normal, axis=1, keepdims=True), x)
        for number in (1, 2, 4):
            changes = {}
            for constraints in (vtkHarmonicFieldSolver.Soft, vtkHarmonicFieldSolver.Hard):
                powers = []
                for surface, repeats in ((coarse, 1), (fine, 4)):
                    vectors = self.field(surface, self.lines, number, constraints).reshape(-1, repeats, 3)
                    plane = (vectors * x[:, None]).sum(axis=2) + 1j * (vectors * y[:, None]).sum(axis=2)
                    size = np.maximum(np.abs(plane), 1e-300)
                    powers.append(((plane / size) ** number * size).mean(axis=1))
                changes[constraints] = np.linalg.norm(powers[1] - powers[0]) / np.linalg.norm(powers[0])
            self.assertLess(changes[vtkHarmonicFieldSolver.Soft], changes[vtkHarmonicFieldSolver.Hard], number)


class Guides(unittest.TestCase):
    def setUp(self):
        self.surface = torus(60, 40)
        self.solver = vtkHarmonicFieldSolver()
        self.solver.SetInputData(self.surface)
        self.solver.SetGuideArrayToProcess(1, 1, 0, POINTS, "Wind")
        self.solver.SetMaximumDistance(1)  # of the diagonal
        self.errors = []
        self.solver.AddObserver("ErrorEvent", self.note)
        self.solver.GetExecutive().AddObserver("ErrorEvent", lambda *_: None)

    def note(self, caller, event, text):
        self.errors.append(text)

    note.CallDataType = "string0"

    def expect_one_error(self, data, *words):
        self.errors.clear()
        self.solver.SetInputDataObject(1, data)
        self.solver.Update()
        self.assertEqual(len(self.errors), 1, self.errors)
        for word in words:
            self.assertIn(word, self.errors[0])
        self.assertEqual(self.solver.GetOutput().GetNumberOfCells(), 0)

    def test_directions_prescribe_the_nearest_faces(self):
        wind = points_at([(2, 0, 0), (-2, 0, 0)], [(0, 0, 1), (0, 1, 0)])
        both = vtkMultiBlockDataSet()
        both.SetBlock(0, points_at([(2, 0, 0)], [(0, 0, 1)]))
        both.SetBlock(1, points_at([(-2, 0, 0)], [(0, 1, 0)]))
        fields = []
        for data in (wind, both):
            self.solver.SetInputDataObject(1, data)
            self.solver.Update()
            self.assertEqual(self.errors, [])
            cells = self.solver.GetOutput().GetCellData()
            prescribed = values(self.solver.GetOutput().GetPointData(), "Prescribed")
            self.assertEqual(np.count_nonzero(prescribed), 6)  # the corners of two triangles
            fields.append(values(cells, "Direction0").copy())
        np.testing.assert_array_equal(*fields)

    def test_arrays_have_a_tuple_for_every_point(self):
        positions = [(2, 0, 0), (-2, 0, 0)]
        self.expect_one_error(points_at(positions, [(0, 0, 1)]), "'Wind'", "1 tuples for 2 points")
        self.expect_one_error(
            points_at(positions, np.zeros((0, 3))), "'Wind'", "0 tuples for 2 points")
        self.expect_one_error(points_at(positions, [(0, 1), (1, 0)]), "'Wind'", "3 numbers")

    def test_arrays_of_the_surface_have_a_tuple_for_every_cell(self):
        add(self.surface.GetCellData(), "Given", np.ones((10, 3)))
        self.solver.SetInputArrayToProcess(
            1, 0, 0, vtkDataObject.FIELD_ASSOCIATION_CELLS, "Given")
        self.expect_one_error(None, "'Given'", "10 tuples for 4800 cells")

    def test_points_are_finite(self):
        self.expect_one_error(
            points_at([(2, 0, 0), (np.nan, 0, 0)], [(0, 0, 1)] * 2), "point 1", "nan", "move")

    def test_weights_have_a_point_in_any_locale(self):
        """Programs with a window set the locale of their user."""
        guides = []
        for x, y in ((1.4, 0.1), (1.4, -0.1)):
            line = vtkLineSource()
            line.SetPoint1(x, 0, 0)
            line.SetPoint2(x, 0.1, y)
            line.Update()
            guides.append(line.GetOutput())

        def field():
            solver = vtkHarmonicFieldSolver()
            solver.SetInputData(torus(20, 10))
            for guide in guides:
                solver.AddInputDataObject(1, guide)
            solver.SetGuideWeights("1 0.25")
            solver.Update()
            return values(solver.GetOutput().GetCellData(), "Direction0")

        expected = field()
        for name in ("de_DE.UTF-8", "de_DE.utf8", "fr_FR.UTF-8", "nl_NL.UTF-8"):
            try:
                locale.setlocale(locale.LC_ALL, name)
                break
            except locale.Error:
                continue
        else:
            self.skipTest("this machine has no locale with a decimal comma")
        self.addCleanup(locale.setlocale, locale.LC_ALL, "C")
        np.testing.assert_array_equal(field(), expected)

    def test_tables_are_refused(self):
        self.expect_one_error(vtkTable(), "vtkTable", "Table To Points")


if __name__ == "__main__":
    unittest.main()
