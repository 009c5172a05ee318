"""Harmonic functions from plain Python: values at points, through both filters."""

import unittest

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkDataObject

from directionalmultigrid.vtkFiltersDirectionalFields import (
    vtkDirectionalProlongation, vtkHarmonicFieldSolver)
from surfaces import add, torus, values

POINTS = vtkDataObject.FIELD_ASSOCIATION_POINTS


def surface():
    """A torus with values at two of its points, and NaN elsewhere."""
    result = torus(60, 40)
    given = np.full(result.GetNumberOfPoints(), np.nan)
    given[[0, 1230]] = (-1.0, 2.0)
    add(result.GetPointData(), "Given", given)
    return result


def solver_of(data):
    solver = vtkHarmonicFieldSolver()
    solver.SetInputData(data)
    solver.SetDiscretisation(vtkHarmonicFieldSolver.ScalarFunction)
    solver.SetConstraintType(vtkHarmonicFieldSolver.Hard)
    solver.SetInputArrayToProcess(3, 0, 0, POINTS, "Given")
    return solver


def function(solver):
    solver.Update()
    return values(solver.GetOutput().GetPointData(), "ScalarFunction").copy()


class Functions(unittest.TestCase):
    def test_values_hold_and_bound_the_function(self):
        solver = solver_of(surface())
        u = function(solver)
        self.assertEqual((u[0], u[1230]), (-1.0, 2.0))
        self.assertTrue(np.all((u >= -1.0 - 1e-9) & (u <= 2.0 + 1e-9)))  # maximum principle
        weights = values(solver.GetOutput().GetPointData(), "Prescribed")
        self.assertEqual(list(np.flatnonzero(weights)), [0, 1230])

    def test_solvers_and_both_filters_agree(self):
        expected = function(solver_of(surface()))
        cycles = solver_of(surface())
        cycles.SetSolver(vtkHarmonicFieldSolver.ConjugateGradients)
        cycles.SetTolerance(1e-11)
        np.testing.assert_allclose(function(cycles), expected, atol=1e-8)
        prolongation = vtkDirectionalProlongation()
        prolongation.SetInputData(surface())
        prolongation.Update()
        for space in (vtkHarmonicFieldSolver.LinearInterpolation, vtkHarmonicFieldSolver.StructurePreserving):
            stored = solver_of(prolongation.GetOutput())
            stored.SetSolver(vtkHarmonicFieldSolver.ConjugateGradients)
            stored.SetCoarseSpace(space)
            stored.SetTolerance(1e-11)
            np.testing.assert_allclose(function(stored), expected, atol=1e-8)

    def test_mask_and_weights_say_where(self):
        data = surface()
        full = np.arange(data.GetNumberOfPoints(), dtype=float)
        mask = np.zeros(len(full))
        mask[[3, 700, 2000]] = 1
        add(data.GetPointData(), "Full", full)
        add(data.GetPointData(), "Mask", mask)
        for index in (0, 2):
            solver = solver_of(data)
            solver.SetInputArrayToProcess(3, 0, 0, POINTS, "Full")
            solver.SetInputArrayToProcess(index, 0, 0, POINTS, "Mask")
            u = function(solver)
            self.assertEqual([u[3], u[700], u[2000]], [3.0, 700.0, 2000.0])
            prescribed = values(solver.GetOutput().GetPointData(), "Prescribed")
            self.assertEqual(list(np.flatnonzero(prescribed)), [3, 700, 2000])

    def test_the_gradient_is_shown(self):
        solver = solver_of(surface())
        solver.SetUnitLength(False)
        u = function(solver)
        output = solver.GetOutput()
        corners = vtk_to_numpy(output.GetPolys().GetConnectivityArray()).reshape(-1, 3)
        points = vtk_to_numpy(output.GetPoints().GetData()).astype(float)[corners]
        gradient = values(output.GetCellData(), "Direction0")
        for k in (1, 2):
            side = points[:, k] - points[:, 0]
            difference = u[corners[:, k]] - u[corners[:, 0]]
            np.testing.assert_allclose((gradient * side).sum(axis=1), difference, atol=1e-6)


if __name__ == "__main__":
    unittest.main()
