"""Guides in plain Python: numpy arrays that fit, and some that do not."""

import unittest

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import (
    vtkDataObject, vtkMultiBlockDataSet, vtkPolyData, vtkTable)

from directionalmultigrid.vtkFiltersDirectionalFields import vtkHarmonicFieldSolver
from surfaces import add, torus, values

POINTS = vtkDataObject.FIELD_ASSOCIATION_POINTS


def points_at(positions, vectors):
    data = vtkPolyData()
    data.SetPoints(vtkPoints())
    data.GetPoints().SetData(numpy_to_vtk(np.asarray(positions, float), deep=True))
    add(data.GetPointData(), "Wind", vectors)
    return data


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
            self.assertEqual(np.count_nonzero(values(cells, "Prescribed")), 2)
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

    def test_tables_are_refused(self):
        self.expect_one_error(vtkTable(), "vtkTable", "Table To Points")


if __name__ == "__main__":
    unittest.main()
