"""Principal directions and features of surfaces in plain Python."""

import unittest

import numpy as np
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkDataObject, vtkPolyData

from directionalmultigrid.vtkFiltersDirectionalFields import (
    vtkHarmonicFieldSolver, vtkPrincipalDirections)
from surfaces import add, corners, surface, torus, values, values_of_points

CELLS = vtkDataObject.FIELD_ASSOCIATION_CELLS


def centres(data):
    points = values_of_points(data)
    return points[corners(data)].mean(axis=1)


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


def tube(rows=20, around_it=40):
    """An open cylinder of radius 1 around the z-axis, counter-clockwise from outside."""
    a, z = np.meshgrid(2 * np.pi * np.arange(around_it) / around_it, np.linspace(0, 2, rows + 1))
    points = np.stack([np.cos(a), np.sin(a), z], axis=2).reshape(-1, 3)
    i, j = (k.ravel() for k in np.meshgrid(np.arange(rows), np.arange(around_it), indexing="ij"))
    p, q = i * around_it + j, i * around_it + (j + 1) % around_it
    return surface(points, np.concatenate([np.stack([p, q, q + around_it], 1),
                                           np.stack([p, q + around_it, p + around_it], 1)]))


def cube(n=6):
    """The cube of side 2, n x n squares a side, as one surface."""
    points, triangles = {}, []
    for axis in range(3):
        for side in (-1, 1):
            def point(i, j):
                place = [0.0, 0.0, 0.0]
                place[axis], place[(axis + 1) % 3], place[(axis + 2) % 3] = side, 2 * i / n - 1, 2 * j / n - 1
                return points.setdefault(tuple(place), len(points))
            for i in range(n):
                for j in range(n):
                    a, b, c, d = point(i, j), point(i + 1, j), point(i + 1, j + 1), point(i, j + 1)
                    triangles += [(a, b, c), (a, c, d)] if side > 0 else [(a, c, b), (a, d, c)]
    return surface(list(points), triangles)


class FeaturesWithSingularities(unittest.TestCase):
    """Features turn a field of prescribed singularities as a whole, as directions and guides do."""

    def solve(self, data, places, N, **properties):
        solver = vtkHarmonicFieldSolver()
        solver.SetInputData(data)
        solver.SetNumberOfDirections(N)
        solver.SetTolerance(1e-12)
        points = vtkPolyData()
        points.SetPoints(vtkPoints())
        for place in places:
            points.GetPoints().InsertNextPoint(place)
        solver.SetInputData(2, points)
        for name, value in properties.items():
            getattr(solver, "Set" + name)(value)
        messages = []
        for event in ("ErrorEvent", "WarningEvent"):
            solver.AddObserver(event, lambda *_: messages.append(event))
        solver.Update()
        self.assertEqual(messages, [])
        self.assertEqual((solver.GetNumberOfSetups(), solver.GetNumberOfSystems()), (1, 1))
        return values(solver.GetOutput().GetCellData(), "Direction0")

    def angles_to_the_axis(self, directions):
        return np.degrees(np.arccos(np.minimum(1, np.abs(directions[:, 2]))))

    def test_the_boundary_of_a_tube(self):
        for rotation in (0, 20):
            directions = self.solve(tube(), [], 2, BoundaryWeight=1, Rotation=rotation)
            self.assertLess(np.abs(self.angles_to_the_axis(directions) - (90 - rotation)).max(), 1e-3)

    def test_the_curvature_of_a_tube(self):
        for direction, angle in ((0, 90), (1, 0)):
            for constraints in (0, 1):  # neither soft nor hard
                directions = self.solve(tube(), [], 2, CurvatureWeight=1, CurvatureDirection=direction,
                                        ConstraintType=constraints)
                self.assertLess(np.abs(self.angles_to_the_axis(directions) - angle).max(), 1)

    def test_the_sharp_edges_of_a_cube(self):
        corners_of_cube = [(x, y, z) for x in (-1, 1) for y in (-1, 1) for z in (-1, 1)]
        directions = self.solve(cube(), corners_of_cube, 4, SharpEdgesWeight=1)
        self.assertGreater(np.abs(directions).max(axis=1).min(), 1 - 1e-9)
        directions = self.solve(cube(), corners_of_cube, 4, SharpEdgesWeight=1, Rotation=45)
        self.assertLess(np.abs(np.abs(directions).max(axis=1) - 0.5 ** 0.5).max(), 1e-6)


if __name__ == "__main__":
    unittest.main()
