"""Both filters from plain Python: wrapping, arrays as numpy arrays, and fields for every N."""

import unittest

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkDataObject

from directionalmultigrid.vtkFiltersDirectionalFields import (
    vtkDirectionalProlongation, vtkHarmonicFieldSolver)
from surfaces import add, corners, prescribe, torus, values, values_of_points

CELLS = vtkDataObject.FIELD_ASSOCIATION_CELLS


def example():
    """A torus of 4800 faces with three prescribed directions."""
    return prescribe(torus(60, 40), {7: (1, 2, 3), 2000: (-1, 0, 1), 4000: (0, 1, 0)})


def corner_points(surface):
    """The corners of each triangle, #F x 3 x 3."""
    corners = vtk_to_numpy(surface.GetPolys().GetConnectivityArray()).reshape(-1, 3)
    return vtk_to_numpy(surface.GetPoints().GetData())[corners]


class Pipeline(unittest.TestCase):
    def setUp(self):
        self.prolongation = vtkDirectionalProlongation()
        self.prolongation.SetInputData(example())
        self.solver = vtkHarmonicFieldSolver()
        self.solver.SetInputConnection(self.prolongation.GetOutputPort())
        self.solver.SetInputArrayToProcess(1, 0, 0, CELLS, "Given")

    def cells(self, name):
        return values(self.solver.GetOutput().GetCellData(), name)

    def points(self, name):
        return values(self.solver.GetOutput().GetPointData(), name)

    def report(self, name):
        return values(self.solver.GetOutput().GetFieldData(), name)

    def test_enums_and_defaults(self):
        self.assertEqual(self.solver.GetSolver(), vtkHarmonicFieldSolver.Automatic)
        self.assertEqual(self.solver.GetConstraintType(), vtkHarmonicFieldSolver.Soft)
        self.assertEqual(self.solver.GetCoarseSpace(), vtkHarmonicFieldSolver.LinearInterpolation)
        self.assertEqual(self.prolongation.GetCollapsePolicy(),
                         vtkDirectionalProlongation.IndependentRounds)
        self.assertEqual(self.solver.GetDiscretisation(), vtkHarmonicFieldSolver.PointPowerField)
        self.assertEqual(self.prolongation.GetConstruction(),
                         vtkDirectionalProlongation.TrackedPaths)
        text = str(self.solver)
        for name in ("Discretisation: PointPowerField", "NumberOfDirections: 4", "Solver: Automatic", "Tolerance: 0.0001"):
            self.assertIn(name, text)

    def test_cholesky_and_conjugate_gradients_agree_for_every_N(self):
        self.solver.SetTolerance(1e-11)
        for N in range(1, 9):
            with self.subTest(N=N):
                self.solver.SetNumberOfDirections(N)
                self.solver.SetSolver(vtkHarmonicFieldSolver.Cholesky)
                self.solver.Update()
                exact = self.cells("PowerField").copy()
                self.solver.SetSolver(vtkHarmonicFieldSolver.ConjugateGradients)
                self.solver.Update()
                self.assertEqual(self.report("Converged")[0], 1)
                difference = np.abs(self.cells("PowerField") - exact).max()
                self.assertLess(difference, 1e-8 * np.abs(exact).max())

    def test_directions_are_roots_of_one_power(self):
        """N unit vectors per element that add up to nothing for N > 1, in the tangent plane."""
        self.solver.AllDirectionsOn()
        for N in range(1, 9):
            with self.subTest(N=N):
                self.solver.SetNumberOfDirections(N)
                self.solver.Update()
                for array in (self.cells, self.points):
                    directions = np.stack([array(f"Direction{k}") for k in range(N)])
                    np.testing.assert_allclose(np.linalg.norm(directions, axis=2), 1, rtol=1e-12)
                    if N > 1:
                        np.testing.assert_allclose(directions.sum(axis=0), 0, atol=1e-12)
                    with self.assertRaises(KeyError):
                        array(f"Direction{N}")

    def test_magnitudes_are_those_of_the_powers(self):
        self.solver.UnitLengthOff()
        self.solver.AllDirectionsOn()
        self.solver.Update()
        for array in (self.cells, self.points):
            power = np.linalg.norm(array("PowerField"), axis=1)
            for k in range(4):
                length = np.linalg.norm(array(f"Direction{k}"), axis=1)
                np.testing.assert_allclose(length, power, rtol=1e-12, atol=1e-14)

    def test_indices_sum_to_zero_on_a_torus(self):
        self.solver.Update()
        self.assertAlmostEqual(self.cells("SingularityIndex").sum(), 0, places=9)

    def test_convergence_table(self):
        self.solver.SetSolver(vtkHarmonicFieldSolver.ConjugateGradients)
        self.solver.SetTolerance(1e-8)
        self.solver.Update()
        rows = self.solver.GetOutputDataObject(2).GetRowData()
        iterations = values(rows, "Iteration")
        residuals = values(rows, "RelativeResidual")
        np.testing.assert_array_equal(iterations, np.arange(len(iterations)))
        self.assertAlmostEqual(residuals[0], 1)
        self.assertLessEqual(residuals[-1], self.solver.GetTolerance())
        self.assertTrue(np.all(np.diff(values(rows, "Seconds")) >= 0))
        self.assertGreaterEqual(len(self.report("LevelUnknowns")), 2)
        energies = values(rows, "Energy")
        self.assertLess(energies[0], 0)  # X = 0 has 0, and solvers start where penalties and stiffness balance
        self.assertLess(energies[-1], energies[0])
        self.assertLess(values(rows, "MassResidual")[-1], 1e-6 * values(rows, "MassResidual")[0])

    def test_one_forms_and_face_fields_are_numpy_arrays(self):
        """Hard, a 1-form is the integral of the given vector along the sides of its face."""
        self.solver.SetConstraintType(vtkHarmonicFieldSolver.Hard)
        self.solver.SetDiscretisation(vtkHarmonicFieldSolver.FaceField)
        self.solver.UnitLengthOff()
        self.solver.Update()
        np.testing.assert_allclose(self.cells("FaceField"), self.cells("Direction0"), rtol=1e-12,
                                   atol=1e-14)
        self.solver.SetDiscretisation(vtkHarmonicFieldSolver.OneForm)
        self.solver.Update()
        edges = self.solver.GetOutputDataObject(1)
        form = values(edges.GetCellData(), "OneForm")
        prescribed = values(edges.GetCellData(), "Prescribed")
        self.assertEqual(len(form), 7200)
        self.assertEqual(np.count_nonzero(prescribed), 9)  # three sides of three faces
        surface = self.solver.GetInput()
        given = values(surface.GetCellData(), "Given")
        for edge in np.flatnonzero(prescribed):
            ends = [edges.GetCell(edge).GetPointId(k) for k in range(2)]
            side = np.subtract(surface.GetPoint(ends[1]), surface.GetPoint(ends[0]))
            face, = [cell for cell in (7, 2000, 4000)
                     if set(ends) <= {surface.GetCell(cell).GetPointId(k) for k in range(3)}]
            self.assertAlmostEqual(form[edge], given[face] @ side, places=12)

    def test_harmonic_basis_expands_fields(self):
        """Two fields on a torus, orthonormal when summed with the areas of the faces."""
        self.assertFalse(self.solver.GetHarmonicBasis())
        self.assertIn("HarmonicBasis: Off", str(self.solver))
        self.solver.HarmonicBasisOn()
        self.prolongation.Update()
        sides = np.diff(corner_points(self.prolongation.GetOutput()), axis=1)
        areas = np.linalg.norm(np.cross(sides[:, 0], sides[:, 1]), axis=1) / 2
        for discretisation in (vtkHarmonicFieldSolver.FaceField, vtkHarmonicFieldSolver.OneForm):
            with self.subTest(discretisation=discretisation):
                self.solver.SetDiscretisation(discretisation)
                self.solver.Update()
                size, = self.report("HarmonicBasisSize")
                self.assertEqual(size, 2)
                basis = np.stack([self.cells(f"HarmonicBasis {k + 1}") for k in range(size)])
                gram = np.einsum("ifd,jfd,f->ij", basis, basis, areas)
                np.testing.assert_allclose(gram, np.eye(2), atol=1e-12)
                with self.assertRaises(KeyError):
                    self.cells("HarmonicBasis 3")

    def test_values_changed_in_place_are_noticed(self):
        """numpy writes into the array; Modified() on it is all that VTK needs."""
        surface = example()
        solver = vtkHarmonicFieldSolver()
        solver.SetInputData(surface)
        solver.SetInputArrayToProcess(1, 0, 0, CELLS, "Given")
        solver.Update()
        array = surface.GetCellData().GetArray("Given")
        values(surface.GetCellData(), "Given")[7] = (3, 2, 1)
        array.Modified()
        surface.Modified()
        solver.Update()
        self.assertEqual(
            (solver.GetNumberOfSetups(), solver.GetNumberOfSystems(), solver.GetNumberOfSolves()),
            (1, 1, 2))

    def test_mask_and_weights(self):
        surface = example()
        mask = np.zeros(surface.GetNumberOfCells())
        mask[2000] = 1
        add(surface.GetCellData(), "Mask", mask)
        add(surface.GetCellData(), "Weights", 3 * mask)
        self.prolongation.SetInputData(surface)
        self.solver.SetInputArrayToProcess(0, 0, 0, CELLS, "Mask")
        self.solver.SetInputArrayToProcess(2, 0, 0, CELLS, "Weights")
        self.solver.Update()
        # The three corners, each with the share of the triangle in the area around it.
        points, triangles = values_of_points(surface), corners(surface)
        a, b, c = np.moveaxis(points[triangles], 1, 0)
        areas = np.linalg.norm(np.cross(b - a, c - a), axis=1)
        around = np.bincount(triangles.ravel(), np.repeat(areas, 3))
        prescribed = self.points("Prescribed")
        self.assertEqual(set(np.flatnonzero(prescribed)), set(triangles[2000]))
        np.testing.assert_allclose(prescribed[triangles[2000]], 3 * areas[2000] / around[triangles[2000]], rtol=1e-12)
        self.solver.SetDiscretisation(vtkHarmonicFieldSolver.PowerField)
        self.solver.Update()
        prescribed = self.cells("Prescribed")
        self.assertEqual(np.flatnonzero(prescribed).tolist(), [2000])
        self.assertEqual(prescribed[2000], 3)


if __name__ == "__main__":
    unittest.main()
