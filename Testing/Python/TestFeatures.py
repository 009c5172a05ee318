"""Principal directions and features of surfaces in plain Python."""

import unittest

import numpy as np
from vtkmodules.vtkCommonDataModel import vtkDataObject

from directionalmultigrid.vtkFiltersDirectionalFields import (
    vtkHarmonicFieldSolver, vtkPrincipalDirections)
from surfaces import add, surface, torus, values

CELLS = vtkDataObject.FIELD_ASSOCIATION_CELLS


def centres(data):
    points = values_of_points(data)
    return points[corners(data)].mean(axis=1)


def values_of_points(data):
    return np.array([data.GetPoint(i) for i in range(data.GetNumberOfPoints())])


def corners(data):
    return np.array([[data.GetCell(c).GetPointId(k) for k in range(3)]
                     for c in range(data.GetNumberOfCells())])


def around(places):
    """Unit vectors around the z-axis."""
    vectors = np.stack([-places[:, 1], places[:, 0], 0 * places[:, 2]], axis=1)
    return vectors / np.linalg.norm(vectors, axis=1, keepdims=True)


class Features(unittest.TestCase):
    def test_principal_directions_of_a_torus(self):
        principal = vtkPrincipalDirections()
        principal.SetInputData(torus(60, 30))
        principal.SetScale(2)
        principal.Update()
        data = principal.GetOutput()
        for attributes, places in ((data.GetCellData(), centres(data)),
                                   (data.GetPointData(), values_of_points(data))):
            along = (values(attributes, "MinimumDirection") * around(places)).sum(axis=1)
            self.assertGreater(np.abs(along).min(), 0.99)
            self.assertLess(np.abs(values(attributes, "MaximumCurvature") - 2.5).max(), 0.5)
            self.assertTrue((values(attributes, "Confidence") > 0.1).all())

    def test_the_filter_and_the_weight_lead_to_the_same_field(self):
        """What the solver follows by itself is what the filter shows."""
        principal = vtkPrincipalDirections()
        principal.SetInputData(torus(60, 30))
        principal.Update()
        data = principal.GetOutput()
        # At weight 1, (30 / L)^2 of the integral of |X - Y|^2, and of faces of area A over the mean one 1.
        weights = 2 * 900 / data.GetNumberOfCells() * values(data.GetCellData(), "Confidence")
        add(data.GetCellData(), "Weights", weights)
        fields = []
        for solver in (vtkHarmonicFieldSolver(), vtkHarmonicFieldSolver()):
            solver.SetTolerance(1e-12)
            if fields:
                solver.SetInputData(torus(60, 30))
                solver.SetCurvatureWeight(1)
            else:
                solver.SetInputData(data)
                solver.SetInputArrayToProcess(1, 0, 0, CELLS, "MaximumDirection")
                solver.SetInputArrayToProcess(2, 0, 0, CELLS, "Weights")
            solver.Update()
            fields.append(values(solver.GetOutput().GetCellData(), "PowerField").copy())
        self.assertLess(np.abs(fields[0] - fields[1]).max(), 1e-9)

    def test_rotation_of_what_follows_a_boundary(self):
        rim = np.linspace(0, 2 * np.pi, 24, endpoint=False)
        points = np.concatenate([[[0, 0, 0]], np.stack([np.cos(rim), np.sin(rim), 0 * rim], 1)])
        fan = [(0, 1 + k, 1 + (k + 1) % 24) for k in range(24)]
        solver = vtkHarmonicFieldSolver()
        solver.SetInputData(surface(points, fan))
        solver.SetNumberOfDirections(1)
        solver.SetBoundaryWeight(1)
        solver.SetRotation(-30)
        solver.Update()
        data = solver.GetOutput()
        directions = values(data.GetCellData(), "Direction0")
        along = (directions * around(centres(data))).sum(axis=1)
        self.assertLess(np.abs(along - np.cos(np.pi / 6)).max(), 1e-6)
        self.assertTrue(((directions * centres(data)).sum(axis=1) > 0).all())  # clockwise: outwards


if __name__ == "__main__":
    unittest.main()
