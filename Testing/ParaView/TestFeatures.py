"""Principal Directions, and all that Harmonic Field Solver follows of a surface, as a user of ParaView
reaches them."""

import unittest

import numpy as np
import paraview.simple as simple
from vtkmodules.util.numpy_support import vtk_to_numpy


def fetch(source):
    source.UpdatePipeline()
    return simple.servermanager.Fetch(source)


def array(attributes, name):
    return vtk_to_numpy(attributes.GetArray(name))


def tube():
    """An open cylinder around the y-axis, of triangles."""
    cylinder = simple.Cylinder(Resolution=48, Height=2, Radius=1, Capping=0)
    shape = simple.Subdivide(Input=simple.Triangulate(Input=cylinder), NumberofSubdivisions=2)
    return simple.Clean(Input=shape)


def angles_to_the_axis(source):
    directions = array(fetch(source).GetCellData(), "Direction0")
    return np.degrees(np.arccos(np.minimum(1, np.abs(directions[:, 1]))))


class Features(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.tube = tube()

    def solver(self, **properties):
        return simple.HarmonicFieldSolver(Input=self.tube, **properties)

    def test_principal_directions(self):
        principal = simple.PrincipalDirections(Input=self.tube)
        data = fetch(principal)
        for attributes in (data.GetCellData(), data.GetPointData()):
            self.assertGreater(np.abs(array(attributes, "MinimumDirection")[:, 1]).mean(), 0.99)
            self.assertAlmostEqual(array(attributes, "MaximumCurvature").mean(), 1, delta=0.3)
            self.assertGreater(array(attributes, "Confidence").mean(), 0.3)
        principal.Scale = 8
        self.assertNotEqual(list(array(fetch(principal).GetCellData(), "Confidence")),
                            list(array(data.GetCellData(), "Confidence")))
        lines = simple.FieldLines(Input=principal, Directions=["CELLS", "MinimumDirection"],
                                  NumberOfDirections=2)
        self.assertGreater(fetch(lines).GetNumberOfLines(), 10)

    def test_curvature_with_every_property(self):
        solver = self.solver(NumberOfDirections=2, CurvatureWeight=1)
        self.assertGreater(angles_to_the_axis(solver).mean(), 85)
        solver.CurvatureDirection = "Minimum"
        self.assertLess(angles_to_the_axis(solver).mean(), 5)
        solver.Rotation = 30
        self.assertAlmostEqual(angles_to_the_axis(solver).mean(), 30, delta=5)

    def test_curvature_at_a_scale(self):
        # A tube alone bends alike at all scales.
        wavy = simple.Calculator(Input=self.tube, CoordinateResults=1,
                                 Function="coords + 0.1*sin(4*coordsY + 3*coordsX)*(coordsX*iHat + coordsZ*kHat)")
        solver = simple.HarmonicFieldSolver(Input=wavy, NumberOfDirections=2, CurvatureWeight=1)
        before = array(fetch(solver).GetCellData(), "PowerField").copy()
        solver.CurvatureScale = 6
        self.assertGreater(np.abs(array(fetch(solver).GetCellData(), "PowerField") - before).max(), 1e-2)

    def test_each_feature_turns_by_an_angle_of_its_own(self):
        # The boundary runs around the axis and the least curvature along it: turned by 90 degrees, both do the same.
        solver = self.solver(NumberOfDirections=2, BoundaryWeight=100, CurvatureWeight=1, CurvatureDirection="Minimum")
        self.assertGreater(angles_to_the_axis(solver).max(), 45)
        solver.BoundaryRotation = 90
        self.assertLess(angles_to_the_axis(solver).max(), 1)
        solver.BoundaryRotation, solver.CurvatureRotation = 0, -90
        self.assertGreater(angles_to_the_axis(solver).min(), 89)
        solver.Rotation = 60  # of all, besides
        self.assertLess(np.abs(angles_to_the_axis(solver) - 30).max(), 1)

    def test_the_boundary_and_rotation_arrays(self):
        solver = self.solver(NumberOfDirections=1, BoundaryWeight=1)
        data = fetch(solver)
        height = vtk_to_numpy(fetch(simple.CellCenters(Input=solver)).GetPoints().GetData())
        directions = array(data.GetCellData(), "Direction0")
        circulation = height[:, 2] * directions[:, 0] - height[:, 0] * directions[:, 2]  # about +y
        low, high = height[:, 1] < -0.8, height[:, 1] > 0.8
        # The surface stays on the left: about +y at the lower end, against it at the upper one.
        self.assertGreater(circulation[low].min(), 0.9)
        self.assertLess(circulation[high].max(), -0.9)

        for association in ("Point Data", "Cell Data"):
            angle = simple.Calculator(Input=self.tube, AttributeType=association,
                                      ResultArrayName="Angle", Function="20")
            rotated = simple.HarmonicFieldSolver(
                Input=angle, NumberOfDirections=4, BoundaryWeight=1, Rotation=10,
                RotationArray=["POINTS" if association == "Point Data" else "CELLS", "Angle"])
            turned = angles_to_the_axis(rotated)
            self.assertLess(np.abs(np.minimum(turned % 90, 90 - turned % 90) - 30).max(), 2)

    def test_sharp_edges_and_their_angle(self):
        box = simple.Subdivide(Input=simple.Clean(Input=simple.Triangulate(Input=simple.Box()),
                                                          PointMerging=1), NumberofSubdivisions=3)
        solver = simple.HarmonicFieldSolver(Input=box, SharpEdgesWeight=1)
        directions = array(fetch(solver).GetCellData(), "Direction0")
        self.assertGreater(np.abs(directions).max(axis=1).min(), 0.9999)
        solver.SharpEdgesRotation = 45
        field = fetch(solver)
        places = vtk_to_numpy(field.GetPoints().GetData())[vtk_to_numpy(field.GetPolys().GetConnectivityArray()).reshape(-1, 3)]
        # The quarter turn of a corner is spread over the triangles there, where the field is zero.
        away = np.abs(places.mean(axis=1)).min(axis=1) < 0.35
        directions = array(field.GetCellData(), "Direction0")[away]
        self.assertLess(np.abs(np.abs(directions).max(axis=1) - 0.5 ** 0.5).max(), 1e-3)
        solver.FeatureAngle = 120
        sharpest = fetch(solver)  # no edge, with a warning: the smoothest field
        self.assertIsNotNone(sharpest.GetFieldData().GetArray("Eigenvalues"))


if __name__ == "__main__":
    unittest.main()
