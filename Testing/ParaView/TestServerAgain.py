"""A field on a surface that ranks have in pieces, of one client after another of the same server, or in pvbatch.

    TestServerAgain.py [HOST:PORT]

Each time it makes fields, fetches arrays, makes an error, goes on, and leaves.
"""

import sys

import paraview.simple as simple
from paraview.modules.vtkRemotingCore import vtkProcessModule
from vtkmodules.util.numpy_support import vtk_to_numpy

RESOLUTION = 60
CELLS = 2 * RESOLUTION * (RESOLUTION - 2)  # of Sphere


def fetch(proxy, port=0):
    """The dataset of all ranks, where this process gets it: a client, or the first rank."""
    data = simple.servermanager.Fetch(proxy, idx=port)
    return data if data and data.GetNumberOfCells() else None


def check(field):
    data = fetch(field)
    if not IS_FIRST:  # it gets what it has itself: its piece, or nothing
        return
    assert data is not None, "the field is empty"
    assert data.GetNumberOfCells() == CELLS, data.GetNumberOfCells()
    assert data.GetFieldData().GetArray("Converged").GetValue(0) == 1
    directions = vtk_to_numpy(data.GetCellData().GetArray("Direction0"))
    assert abs((directions ** 2).sum(axis=1) - 1).max() < 1e-12
    indices = vtk_to_numpy(data.GetCellData().GetArray("SingularityIndex"))
    assert abs(indices.sum() - 2) < 1e-12, indices.sum()  # Poincare-Hopf


def use():
    """Fields that follow something and nothing, and an error in between."""
    sphere = simple.Sphere(Radius=1, ThetaResolution=RESOLUTION, PhiResolution=RESOLUTION)
    marked = simple.Calculator(Input=sphere, ResultArrayName="Directions", Function="if(coordsX > 0.9, 1, 0) * jHat")
    crosses = simple.DirectionalField(Input=marked, Directions=["POINTS", "Directions"])
    crosses.UpdatePipeline()
    check(crosses)
    lines = fetch(crosses, 1)
    assert lines.GetNumberOfCells() > 10 if IS_FIRST else True

    solver = simple.HarmonicFieldSolver(Input=marked, NumberOfDirections=2, Directions=["POINTS", "Directions"])
    solver.UpdatePipeline()
    check(solver)
    solver.Alignment = -1  # an error on all ranks
    solver.UpdatePipeline()
    assert fetch(solver) is None, "a negative weight was taken"
    if PROCESS.GetSymmetricMPIMode():
        solver.Alignment = 2 + PROCESS.GetPartitionId()  # ranks differ
        solver.UpdatePipeline()
        assert fetch(solver) is None, "different weights were taken"
    solver.Alignment = 5  # another one than before on each rank, as one whose filter has not changed would not run
    solver.UpdatePipeline()
    check(solver)

    smoothest = simple.HarmonicFieldSolver(Input=sphere)
    smoothest.UpdatePipeline()
    check(smoothest)
    for proxy in (smoothest, solver, crosses, marked, sphere):
        simple.Delete(proxy)


server = sys.argv[1] if len(sys.argv) > 1 else None
if server:
    host, port = server.split(":")
    simple.Connect(host, int(port))
PROCESS = vtkProcessModule.GetProcessModule()
IS_FIRST = PROCESS.GetPartitionId() == 0
for _ in range(1 if server else 3):
    use()
print("fields made and fetched", flush=True)
if server:
    simple.Disconnect()
