"""Fields of every discretisation on a sphere through ParaView's Python, in whatever process runs this.

    TestPipeline.py [--plugin FILE] [--server HOST:PORT] [--image FILE]

--plugin  loads the plugin from a file; otherwise ParaView has to find it by itself
--server  connects to a pvserver, which has to have the plugin too
--image   also draws the field into a file
"""

import argparse

import paraview.simple as simple
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkPNGReader


def solve():
    """Crosses, a face field and a 1-form on the unit sphere, prescribed at one side of it."""
    sphere = simple.Sphere(Radius=1, ThetaResolution=60, PhiResolution=60)
    mask = simple.Calculator(Input=sphere, ResultArrayName="Mask",
                             Function="if(coordsX > 0.9, 1, 0)")
    directions = simple.Calculator(Input=mask, ResultArrayName="Directions", Function="jHat")
    prolongation = simple.DirectionalProlongation(Input=directions, MinimumNumberOfFaces=200)
    return [simple.HarmonicFieldSolver(
        Input=prolongation, Mask=["POINTS", "Mask"], Directions=["POINTS", "Directions"],
        Discretisation=discretisation, NumberOfDirections=4, Solver="Conjugate Gradients",
        HarmonicBasis=1, AllDirections=1)
            for discretisation in ("Power Field at Points", "Face Field", "1-Form")]


def check(crosses, faceField, oneForm):
    check_crosses(crosses)
    for solver in (faceField, oneForm):
        field = simple.servermanager.Fetch(solver)
        assert field.GetFieldData().GetArray("Converged").GetValue(0) == 1
        assert field.GetCellData().GetArray("PowerField") is None
        # A sphere has no harmonic fields.
        assert field.GetFieldData().GetArray("HarmonicBasisSize").GetValue(0) == 0
        assert field.GetCellData().GetArray("HarmonicBasis 1") is None
        indices = vtk_to_numpy(field.GetPointData().GetArray("SingularityIndex"))
        assert abs(indices.sum() - 2) < 1e-12, indices.sum()
    cells = simple.servermanager.Fetch(faceField).GetCellData()
    vectors, directions = (vtk_to_numpy(cells.GetArray(name))
                           for name in ("FaceField", "Direction0"))
    lengths = (vectors ** 2).sum(axis=1, keepdims=True) ** 0.5
    assert abs(vectors - lengths * directions).max() < 1e-12 * lengths.max()
    edges = simple.servermanager.Fetch(oneForm, idx=1)
    for name in ("OneForm", "Prescribed"):
        assert edges.GetCellData().GetArray(name).GetNumberOfTuples() == edges.GetNumberOfCells()


def check_crosses(solver):
    """What has to hold on any sphere."""
    field = simple.servermanager.Fetch(solver)
    assert field.GetNumberOfCells() > 6000, field.GetNumberOfCells()
    points, cells, report = field.GetPointData(), field.GetCellData(), field.GetFieldData()
    assert report.GetArray("Converged").GetValue(0) == 1
    # Poincare-Hopf: the indices sum to the Euler characteristic.
    indices = vtk_to_numpy(cells.GetArray("SingularityIndex"))
    assert abs(indices.sum() - 2) < 1e-12, indices.sum()
    # Four unit vectors per face, opposite ones opposite, all tangential to the face.
    arrays = [vtk_to_numpy(cells.GetArray(f"Direction{k}")) for k in range(4)]
    assert abs((arrays[0] ** 2).sum(axis=1) - 1).max() < 1e-12
    assert abs(arrays[0] + arrays[2]).max() < 1e-12
    assert abs((arrays[0] * arrays[1]).sum(axis=1)).max() < 1e-12


def check_chosen_point():
    """Nothing is said: the filter chooses a point, which Point is then. All ranks go on from there."""
    ball = simple.Sphere(Radius=2, ThetaResolution=40, PhiResolution=40)
    carried = simple.ParallelTransport(Input=ball)
    carried.UpdatePipeline()
    assert list(carried.Point) == [0, 0, 2], list(carried.Point)
    lines = simple.FieldLines(Input=carried)
    for change in ({}, {"NumberOfCircles": 5}, {"Point": [2, 0, 0]}):
        for name, value in change.items():
            setattr(carried, name, value)
        lines.UpdatePipeline()
        assert lines.GetDataInformation(0).GetNumberOfCells() > 100, change


def draw(solver, image):
    view = simple.CreateRenderView(ViewSize=[600, 600])
    view.CameraPosition = [4, 2, 2]
    display = simple.Show(solver, view)
    simple.ColorBy(display, ("POINTS", "Direction0", "X"))
    simple.Render(view)
    simple.SaveScreenshot(image, view)
    pixels = read(image)
    background = (pixels == pixels[0]).all(axis=1).mean()
    assert 0.2 < background < 0.8, f"{background:.0%} of the image is background"
    assert len(set(map(tuple, pixels[::7]))) > 100, "the image has hardly any colours"


def read(image):
    """The colours of a PNG file, one row per pixel."""
    reader = vtkPNGReader()
    reader.SetFileName(image)
    reader.Update()
    return vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars())[:, :3]


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--plugin")
    parser.add_argument("--server")
    parser.add_argument("--image")
    options = parser.parse_args()
    if options.server:
        host, port = options.server.split(":")
        simple.Connect(host, int(port))
    if options.plugin:
        simple.LoadPlugin(options.plugin, remote=False, ns=vars(simple))

    solvers = solve()
    for solver in solvers:
        solver.UpdatePipeline()
    check(*solvers)
    check_chosen_point()
    if options.image:
        draw(solvers[0], options.image)


if __name__ == "__main__":
    main()
