"""Flows and their parts: hodge(), and the filter behind it in a time series."""

import unittest

import numpy as np
from directionalmultigrid import FieldError, FieldWarning, hodge
from directionalmultigrid.vtkFiltersDirectionalFields import vtkHodgeDecomposition
from surfaces import add, surface as surface_of, torus, values_of_points
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.util.vtkAlgorithm import VTKPythonAlgorithmBase
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkCommonExecutionModel import vtkStreamingDemandDrivenPipeline
try:
    from vtkmodules.vtkFiltersCore import vtkExtractEdges
except ImportError:  # VTK 9.1
    from vtkmodules.vtkFiltersExtraction import vtkExtractEdges


def values(data, name):
    return vtk_to_numpy(data.GetArray(name))


def with_flow():
    """Around the axis with the speed 1 / distance, a harmonic field, and the gradient of z."""
    surface = torus(60, 30)
    x, y, z = values_of_points(surface).T
    distance = np.hypot(x, y)
    around = np.stack([-y, x, 0 * x], 1) / distance[:, None] ** 2
    add(surface.GetPointData(), "Flow", around + [0, 0, 1])
    add(surface.GetPointData(), "u", 1 / distance)
    add(surface.GetPointData(), "v", 0 * distance)
    return surface


class Weather(VTKPythonAlgorithmBase):
    """A source with a hundred time steps: the flow of with_flow(), its gradient growing with time."""

    TIMES = [0.25 * k for k in range(100)]

    def __init__(self):
        super().__init__(nInputPorts=0, nOutputPorts=1, outputType="vtkPolyData")
        self.surface = with_flow()

    def RequestInformation(self, _request, _inputs, outputs):
        information = outputs.GetInformationObject(0)
        information.Set(vtkStreamingDemandDrivenPipeline.TIME_STEPS(), self.TIMES, len(self.TIMES))
        information.Set(vtkStreamingDemandDrivenPipeline.TIME_RANGE(), [self.TIMES[0], self.TIMES[-1]], 2)
        return 1

    def RequestData(self, _request, _inputs, outputs):
        information = outputs.GetInformationObject(0)
        time = information.Get(vtkStreamingDemandDrivenPipeline.UPDATE_TIME_STEP())
        output = vtkPolyData.GetData(outputs)
        output.ShallowCopy(self.surface)
        add(output.GetPointData(), "Flow", values(self.surface.GetPointData(), "Flow") + [0, 0, time])
        output.GetPointData().SetActiveVectors("Flow")
        return 1


class Flows(unittest.TestCase):
    def test_parts_of_a_known_flow(self):
        surface = with_flow()
        result = hodge(surface, "Flow")
        self.assertIs(type(result), type(surface))
        self.assertFalse(surface.GetPointData().HasArray("Potential"))  # the input stays
        points = values_of_points(surface)
        np.testing.assert_allclose(values(result.GetPointData(), "Potential"), points[:, 2], atol=0.01)
        self.assertLess(np.abs(values(result.GetPointData(), "StreamFunction")).max(), 0.01)
        shares = values(result.GetFieldData(), "FlowShares")
        self.assertAlmostEqual(shares.sum(), 1, places=9)
        # Of the harmonic field: 2 pi times the integral of 0.4 / (1 + 0.4 cos t), 2 pi 0.4 / sqrt(1 - 0.16)
        harmonic = 2 * np.pi * 2 * np.pi * 0.4 / np.sqrt(1 - 0.16)
        self.assertAlmostEqual(values(result.GetFieldData(), "FlowEnergies")[3] / harmonic, 1, delta=0.02)

    def test_components_about_an_axis(self):
        result = hodge(with_flow(), eastward="u", northward="v", Axis=(0, 0, 1))
        self.assertGreater(values(result.GetFieldData(), "FlowShares")[2], 0.99)

    def test_properties(self):
        result = hodge(with_flow(), "Flow", GradientPart=False, Boundary="Open", LengthScale=10)
        self.assertFalse(result.GetPointData().HasArray("Potential"))
        with self.assertRaisesRegex(TypeError, "did you mean LengthScale"):
            hodge(with_flow(), "Flow", Lengthscale=3)
        with self.assertRaisesRegex(FieldError, "Boundary is not 'Coast'"):
            hodge(with_flow(), "Flow", Boundary="Coast")
        with self.assertRaisesRegex(FieldError, "no array 'Wind'"):
            hodge(with_flow(), "Wind")
        with self.assertRaisesRegex(FieldError, "no flow to decompose"):
            hodge(with_flow())

    def test_derivatives_in_a_strait_one_cell_wide(self):
        """Two seas of 5 x 5 cells, and between them a strait of 12 cells in a row: three cells beside each sea know it."""
        cells = [(i, j) for i in range(22) for j in range(5) if j == 2 or not 5 <= i < 17]
        corners = np.array([(i + a, j + b) for i, j in cells for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))])
        points, numbers = np.unique(corners, axis=0, return_inverse=True)
        quads = vtkPolyData()
        quads.DeepCopy(surface_of(np.c_[points, 0 * points[:, 0]], []))
        rows = vtkCellArray()
        for row in numbers.reshape(-1, 4):
            rows.InsertNextCell(4, [int(k) for k in row])
        quads.SetPolys(rows)
        x, y = (np.array(cells) + 0.5).T
        add(quads.GetCellData(), "Flow", np.stack([2 * x - 3 * y, 4 * x + 3 * y, 0 * x], 1))
        with self.assertWarnsRegex(FieldWarning, "Divergence and vorticity are NaN at 14 points.*one cell wide"):
            data = hodge(quads, "Flow").GetPointData()
        inStrait = (points[:, 0] > 7.5) & (points[:, 0] < 14.5)
        for name, exact in (("Divergence", 5), ("Vorticity", 7)):
            np.testing.assert_array_equal(np.isnan(values(data, name)), inStrait)
            np.testing.assert_allclose(values(data, name)[~inStrait], exact, atol=1e-9)

    def test_a_form_on_edges(self):
        surface = with_flow()
        extract = vtkExtractEdges()
        extract.SetInputData(surface)
        extract.Update()
        edges = extract.GetOutput()
        ends = vtk_to_numpy(edges.GetLines().GetConnectivityArray()).reshape(-1, 2)
        points = values_of_points(edges)
        differences = points[ends[:, 1], 2] - points[ends[:, 0], 2]
        add(edges.GetCellData(), "OneForm", differences)
        add(edges.GetCellData(), "Velocity", differences / np.linalg.norm(points[ends[:, 1]] - points[ends[:, 0]], axis=1))
        for arguments in ({}, {"EdgeArray": "Velocity", "EdgeValues": "Components"}):
            result = hodge(surface, edges=edges, **arguments)
            height = values_of_points(surface)[:, 2]
            potential = values(result.GetPointData(), "Potential")
            np.testing.assert_allclose(potential - potential[0], height - height[0], atol=1e-6)  # merged points are in single precision
            self.assertGreater(values(result.GetFieldData(), "FlowShares")[0], 1 - 1e-9)
        with self.assertRaisesRegex(FieldError, "no array|has no|is not among"):
            hodge(surface, edges=edges, EdgeArray="Speed")

    def test_active_vectors(self):
        surface = with_flow()
        surface.GetPointData().SetActiveVectors("Flow")
        self.assertTrue(hodge(surface).GetPointData().HasArray("Potential"))

    def test_a_hundred_time_steps_are_set_up_once(self):
        for solver in ("Automatic", "ConjugateGradients"):
            source = Weather()
            decomposition = vtkHodgeDecomposition()
            decomposition.SetInputConnection(source.GetOutputPort())
            decomposition.SetSolver(getattr(vtkHodgeDecomposition, solver))
            decomposition.UpdateInformation()
            information = decomposition.GetOutputInformation(0)
            times = vtkStreamingDemandDrivenPipeline.TIME_STEPS()
            self.assertEqual([information.Get(times, k) for k in range(information.Length(times))], Weather.TIMES)
            for time in Weather.TIMES:
                decomposition.UpdateTimeStep(time)
                potential = values(decomposition.GetOutput().GetPointData(), "Potential")
                height = values_of_points(decomposition.GetOutput())[:, 2]
                np.testing.assert_allclose(potential, (1 + time) * height, atol=0.01 * (1 + time))
            self.assertEqual(decomposition.GetNumberOfSetups(), 1)
            self.assertEqual(decomposition.GetNumberOfBases(), 1)
            self.assertEqual(decomposition.GetNumberOfSolves(), 2 * len(Weather.TIMES))
            name = decomposition.GetOutput().GetFieldData().GetAbstractArray("Solver").GetValue(0)
            self.assertEqual("Cholesky" in name, solver == "Automatic", name)

    def test_a_time_series_is_the_same_as_its_steps(self):
        decomposition = vtkHodgeDecomposition()
        for step in range(3):
            surface = with_flow()
            flow = values(surface.GetPointData(), "Flow") * (step + 1) + [step, 0, 0]
            add(surface.GetPointData(), "Flow", flow)
            surface.GetPointData().SetActiveVectors("Flow")
            decomposition.SetInputData(surface)
            decomposition.Update()
            np.testing.assert_array_equal(values(decomposition.GetOutput().GetPointData(), "Potential"),
                                          values(hodge(surface, "Flow").GetPointData(), "Potential"))


if __name__ == "__main__":
    unittest.main()
