"""A flow through ParaView's Python: every property of Hodge Decomposition, by its label."""

import tempfile

import numpy as np
import paraview.simple as simple
from vtkmodules.util.numpy_support import vtk_to_numpy


def point_array(data, name):
    return vtk_to_numpy(data.GetPointData().GetArray(name))


def shares(data):
    return vtk_to_numpy(data.GetFieldData().GetArray("FlowShares"))


def interval():
    assert list(simple.GetColorTransferFunction("StreamFunction").NanColor) == [0.72, 0.68, 0.55]  # land
    colours = simple.GetColorTransferFunction("StreamFunction").RGBPoints
    return colours[0], colours[-4]


def check_colours_of_steps():
    """The steps of a series have one interval of colours, which grows where a step needs more, also in a state that is opened again. What
    somebody has chosen stays."""
    simple.ResetSession()
    sphere = simple.Sphere(Radius=1, ThetaResolution=30, PhiResolution=30)
    flow = simple.Calculator(registrationName="Step", Input=sphere, ResultArrayName="Flow")
    simple.HodgeDecomposition(registrationName="Parts", Input=flow, Vectors=["POINTS", "Flow"])

    def after_step(factor):
        simple.FindSource("Step").Function = f"{factor} * (coordsX * jHat - coordsY * iHat)"
        parts = simple.FindSource("Parts")
        simple.UpdatePipeline(proxy=parts)
        largest = np.abs(point_array(simple.servermanager.Fetch(parts), "StreamFunction")).max()
        return largest, interval()

    def shows(range, half):
        return np.allclose(range, (-half, half), rtol=1e-6)

    one, colours = after_step(1)
    assert shows(colours, one), (colours, one)
    three, colours = after_step(3)
    assert shows(colours, three), (colours, three)
    assert shows(after_step(2)[1], three)
    with tempfile.TemporaryDirectory() as folder:
        simple.SaveState(f"{folder}/steps.pvsm")
        simple.ResetSession()
        simple.LoadState(f"{folder}/steps.pvsm")
    assert shows(after_step(1)[1], three), interval()
    four, colours = after_step(4)
    assert shows(colours, four), (colours, four)
    simple.GetColorTransferFunction("StreamFunction").RescaleTransferFunction(-7, 9)
    for factor in (5, 1):
        assert after_step(factor)[1] == (-7, 9), interval()


def main():
    sphere = simple.Sphere(Radius=1, ThetaResolution=60, PhiResolution=60)
    flow = simple.Calculator(Input=sphere, ResultArrayName="Flow", Function="-coordsZ * jHat + (coordsY + 1) * kHat")
    east = simple.Calculator(Input=flow, ResultArrayName="u", Function="sqrt(coordsX^2 + coordsY^2)")
    north = simple.Calculator(Input=east, ResultArrayName="v", Function="0 * coordsX")
    parts = simple.HodgeDecomposition(Input=north, Vectors=["POINTS", "Flow"])
    data = simple.servermanager.Fetch(parts)
    x, _, z = vtk_to_numpy(data.GetPoints().GetData()).T
    assert np.abs(point_array(data, "StreamFunction") + x).max() < 0.01
    assert np.abs(point_array(data, "Potential") - z).max() < 0.01
    lines = simple.servermanager.Fetch(parts, idx=1)
    assert lines.GetNumberOfLines() > 0
    assert len(np.unique(np.round(point_array(lines, "StreamFunction"), 5))) == 20

    parts.Lift = 0.05
    lifted = vtk_to_numpy(simple.servermanager.Fetch(parts, idx=1).GetPoints().GetData())
    assert abs(np.linalg.norm(lifted, axis=1).mean() - 1 - 0.05 * 12 ** 0.5) < 0.01
    parts.NumberOfContours = 5
    parts.LengthScale = 100
    parts.Solver = "Conjugate Gradients"
    parts.ExpectedSolves = 2
    data = simple.servermanager.Fetch(parts)
    assert np.abs(point_array(data, "StreamFunction") + 100 * x).max() < 1
    assert data.GetFieldData().GetAbstractArray("Solver").GetValue(0).startswith("conjugate gradients")
    lines = simple.servermanager.Fetch(parts, idx=1)
    assert len(np.unique(np.round(point_array(lines, "StreamFunction"), 3))) == 5

    parts.LengthScale = 1
    parts.Eastward = ["POINTS", "u"]
    parts.Northward = ["POINTS", "v"]
    data = simple.servermanager.Fetch(parts)
    assert np.abs(point_array(data, "StreamFunction") + z).max() < 0.01 and shares(data)[1] > 0.99
    parts.Axis = [0, 0, -1]
    assert np.abs(point_array(simple.servermanager.Fetch(parts), "StreamFunction") - z).max() < 0.01

    parts.GradientPart = parts.RotationalPart = parts.HarmonicPart = parts.Derivatives = 0
    data = simple.servermanager.Fetch(parts)
    for name in ("GradientPart", "RotationalPart", "HarmonicPart", "Divergence", "Vorticity"):
        assert not data.GetPointData().HasArray(name), name
    assert data.GetPointData().HasArray("Residual")

    solver = simple.HarmonicFieldSolver(Input=flow, Discretisation="1-Form", Directions=["POINTS", "Flow"], UnitLength=0)
    parts = simple.HodgeDecomposition(Input=solver, Edges=simple.OutputPort(solver, 1))
    data = simple.servermanager.Fetch(parts)
    assert shares(data)[:2].sum() > 0.9 and not data.GetCellData().HasArray("NormalComponent")
    integrals = point_array(data, "StreamFunction")
    parts.EdgeValues = "Components"  # of the same numbers, which are then velocities
    assert np.abs(point_array(simple.servermanager.Fetch(parts), "StreamFunction") - integrals).max() > 1e-3
    parts.EdgeArray = "Rotation"  # chosen by name, too
    assert shares(simple.servermanager.Fetch(parts)).size == 4

    half = simple.Clip(Input=flow, ClipType="Plane")
    half.ClipType.Origin, half.ClipType.Normal = [0, 0, 0.013], [0, 0, 1]
    region = simple.Clean(Input=simple.Triangulate(Input=simple.ExtractSurface(Input=half)))
    parts = simple.HodgeDecomposition(Input=region, Vectors=["POINTS", "Flow"], Boundary="Open")
    data = simple.servermanager.Fetch(parts)
    rim = np.abs(vtk_to_numpy(data.GetPoints().GetData())[:, 2] - 0.013) < 1e-5
    assert rim.sum() >= 60 and np.abs(point_array(data, "Potential")[rim]).max() == 0

    # The colours of a stream function have zero in their middle, also where its values do not.
    simple.UpdatePipeline(proxy=parts)
    colours = simple.GetColorTransferFunction("StreamFunction").RGBPoints
    assert abs(colours[0] + colours[-4]) < 1e-12 * colours[-4], colours
    parts.Boundary = "Closed"
    boundaries = simple.servermanager.Fetch(parts, idx=2)
    assert boundaries.GetNumberOfCells() == 1 and boundaries.GetCellData().HasArray("BoundaryTransport")
    parts.ReferenceBoundary = 0

    sea = simple.Calculator(Input=region, ResultArrayName="Sea", Function="if(coordsX > 0, 1, 0)")
    parts = simple.HodgeDecomposition(Input=sea, Vectors=["POINTS", "Flow"], OpenBoundary=["POINTS", "Sea"], SteeringFlow=1)
    data = simple.servermanager.Fetch(parts)
    x, _, z = vtk_to_numpy(data.GetPoints().GetData()).T
    rim = np.abs(z - 0.013) < 1e-5
    potential, stream = point_array(data, "Potential")[rim], point_array(data, "StreamFunction")[rim]
    assert np.abs(potential[x[rim] > 0]).max() == 0 and np.ptp(potential) > 0.1  # open, and closed
    assert np.abs(stream[x[rim] < -0.1]).max() == 0 and np.ptp(stream) > 0.1
    assert sorted(vtk_to_numpy(data.GetFieldData().GetArray("BoundaryIsOpen"))) == [0, 1]
    assert point_array(data, "SteeringFlow").shape == (len(x), 3)

    # Two blocks that are one surface, and the remedy of the warning.
    halves = [simple.Clip(Input=flow, ClipType="Plane", Invert=side) for side in (0, 1)]
    for half in halves:
        half.ClipType.Origin, half.ClipType.Normal = [0, 0, 0.013], [0, 0, 1]
    blocks = simple.GroupDatasets(Input=halves)
    parts = simple.HodgeDecomposition(Input=simple.MergeBlocks(Input=blocks), Vectors=["POINTS", "Flow"])
    assert simple.servermanager.Fetch(parts).GetFieldData().GetArray("BoundaryPoint").GetNumberOfTuples() == 0
    check_colours_of_steps()
    print("parts of a flow are found")


main()
