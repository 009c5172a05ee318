"""Harmonic functions from plain Python: values at points, through both filters."""

import unittest

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkDataObject

from directionalmultigrid import FieldError, smooth_field
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

    def test_a_mask_alone_asks_for_values(self):
        data = surface()
        with self.assertRaisesRegex(FieldError, "neither directions nor values are; .* numbers for Values of a function"):
            smooth_field(data, Discretisation=vtkHarmonicFieldSolver.ScalarFunction, Mask="Given")

    def test_a_source_that_changes_with_time_is_solved_for_alone(self):
        data = torus(60, 40)
        height = np.array([data.GetPoint(i)[2] for i in range(data.GetNumberOfPoints())])
        solver = vtkHarmonicFieldSolver()
        solver.SetDiscretisation(vtkHarmonicFieldSolver.ScalarFunction)
        solver.SetInputArrayToProcess(7, 0, 0, POINTS, "Heat")
        solver.SetInputData(data)
        solver.SetTolerance(1e-10)
        for step in range(1, 4):
            add(data.GetPointData(), "Heat", step * height)
            u = function(solver)
            self.assertAlmostEqual(np.abs(u).max() / step, first, delta=1e-6) if step > 1 else None
            first = np.abs(u).max() / step
        self.assertGreater(np.corrcoef(u, height)[0, 1], 0.9)  # warm where heat is supplied
        self.assertEqual((solver.GetNumberOfSystems(), solver.GetNumberOfSolves()), (1, 3))
        self.assertEqual(values(solver.GetOutput().GetPointData(), "Prescribed").max(), 0)

    def test_net_sources_are_refused_or_taken_out(self):
        data = torus(60, 40)
        add(data.GetPointData(), "Heat", np.full(data.GetNumberOfPoints(), 2.0))
        area = 4 * np.pi ** 2 * 0.4
        with self.assertRaises(FieldError) as raised:
            smooth_field(data, Discretisation="ScalarFunction", Source="Heat")
        total = float(str(raised.exception).split("sums to ")[1].split(",")[0])
        self.assertAlmostEqual(total / (2 * area), 1, delta=0.01)
        result = smooth_field(data, Discretisation="ScalarFunction", Source="Heat", NetSource="TakeOut")
        self.assertLess(np.abs(values(result.GetPointData(), "ScalarFunction")).max(), 1e-9)
        with self.assertRaisesRegex(FieldError, "take no source"):
            smooth_field(data, Discretisation="ScalarFunction", Source="Heat", NetSource="TakeOut", Solver="NestedIterations")

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
