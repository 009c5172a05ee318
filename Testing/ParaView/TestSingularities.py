"""Every kind of source that ParaView offers as singularities of the solver: these and no others, or one error.

    TestSingularities.py --plugin FILE

runs each case in a process of its own, as TestGuides.py does.
"""

import argparse
import sys

import numpy as np
import paraview.simple as simple
from vtkmodules.util.numpy_support import vtk_to_numpy

import TestGuides


def surface(resolution=24):
    return simple.Sphere(Radius=1, ThetaResolution=resolution, PhiResolution=resolution)


def corners(**options):
    """The eight corners of a cube in the sphere."""
    return simple.Clean(Input=simple.Box(XLength=1.15, YLength=1.15, ZLength=1.15, **options))


def poles(index, count=2):
    line = simple.Line(Point1=[0, 0, -1], Point2=[0, 0, 1], Resolution=count - 1)
    return simple.Calculator(Input=line, ResultArrayName="Index", Function=index)


def indices_of(solver):
    solver.UpdatePipeline()
    field = simple.servermanager.Fetch(solver)
    assert field.GetFieldData().GetArray("Converged").GetValue(0) == 1
    points = vtk_to_numpy(field.GetPoints().GetData())
    of_triangles = field.GetCellData().GetArray("SingularityIndex")  # of fields at points, unless they are prescribed
    if of_triangles:
        points = points[vtk_to_numpy(field.GetPolys().GetConnectivityArray()).reshape(-1, 3)].mean(axis=1)
    indices = vtk_to_numpy(of_triangles or field.GetPointData().GetArray("SingularityIndex"))
    return points[indices != 0], indices[indices != 0]


def check_corners():
    points, indices = indices_of(
        simple.HarmonicFieldSolver(Input=surface(), Singularities=corners(), MaximumDistance=0.5))
    assert (indices == 0.25).all() and len(indices) == 8
    assert np.abs(np.abs(points) - 3 ** -0.5).max() < 0.15


def check_several():
    """Two inputs, of which one has indices; a third one is added, for another number of directions."""
    solver = simple.HarmonicFieldSolver(Input=surface(), NumberOfDirections=2, MaximumDistance=0.5,
                                        Singularities=[poles("1")])
    points, indices = indices_of(solver)
    assert sorted(points[:, 2]) == [-1, 1] and (indices == 1).all()
    solver.Singularities = [corners(), poles("-1")]
    points, indices = indices_of(solver)
    assert sorted(indices) == 2 * [-1] + 8 * [0.5]
    solver.Singularities = []
    points, indices = indices_of(solver)
    assert len(indices) == 4  # the smoothest lines on a sphere


def check_another_array():
    line = simple.Line(Point1=[0, 0, -1], Point2=[0, 0, 1], Resolution=1)
    given = simple.Calculator(Input=line, ResultArrayName="Turns", Function="1 + 0.5 * coordsZ")
    solver = simple.HarmonicFieldSolver(Input=surface(), NumberOfDirections=2, Singularities=given,
                                        SingularityIndexArray="Turns")
    points, indices = indices_of(solver)
    assert {float(z): float(index) for z, index in zip(points[:, 2], indices)} == {-1: 0.5, 1: 1.5}


def check_those_of_another_field():
    """As from the first one to a second one by itself, then moved: from triangles to the points next to them."""
    sphere = surface(60)  # on coarse ones singularities meet at the poles
    first = simple.HarmonicFieldSolver(Input=sphere)
    middles, indices = indices_of(first)
    assert len(middles) == 8
    singularities = simple.FieldSingularities(Input=first)
    moved = simple.Transform(Input=singularities)
    moved.Transform.Rotate = [0, 0, 30]  # five triangles
    shown = simple.DirectionalField(Input=sphere)
    found = []
    for given in (singularities, moved, simple.OutputPort(shown, 2)):
        points, indices = indices_of(simple.HarmonicFieldSolver(Input=sphere, Singularities=given))
        assert (indices == 0.25).all() and len(indices) == 8
        found.append(points)
    assert np.linalg.norm(found[0][:, None] - middles[None], axis=2).min(axis=1).max() < 0.1
    assert np.isclose(sorted(found[1][:, 2]), sorted(found[0][:, 2]), atol=1e-6).all()
    assert np.array_equal(found[2], found[0])  # from the middle of the spheres


def check_the_filter_that_shows_it():
    field = simple.DirectionalField(Input=surface(), PrescribedSingularities=corners())
    points, indices = indices_of(field)
    assert (indices == 0.25).all() and len(indices) == 8
    spheres = field[2].GetPointDataInformation().GetArray("Index")
    assert spheres.GetRange() == (0.25, 0.25)


def check_what_comes_next():
    """Of the default kind: singular points stay where they were put, have no direction, and all that draws goes on."""
    solver = simple.HarmonicFieldSolver(Input=surface(), Singularities=corners(), MaximumDistance=0.5)
    assert solver.Discretisation == "Power Field at Points"
    points, _ = indices_of(solver)
    found = simple.servermanager.Fetch(simple.FieldSingularities(Input=solver))
    assert np.array_equal(vtk_to_numpy(found.GetPoints().GetData()), points)
    data = simple.servermanager.Fetch(solver).GetPointData()
    lengths = np.linalg.norm(vtk_to_numpy(data.GetArray("Direction0")), axis=1)
    assert np.allclose(lengths, vtk_to_numpy(data.GetArray("SingularityIndex")) == 0)
    for drawing in (simple.FieldLines(Input=solver), simple.FieldGlyphs(Input=solver)):
        drawing.UpdatePipeline()
        assert drawing.GetDataInformation().GetNumberOfCells() > 20


def check_error(source, **options):
    solver = simple.HarmonicFieldSolver(Input=surface(), Singularities=source(), **options)
    solver.UpdatePipeline()
    assert simple.servermanager.Fetch(solver).GetNumberOfCells() == 0


ERRORS = {
    "too few": (lambda: poles("0.75"), "sum to 1.5.*characteristic is 2; add singularities of 0.5"),
    "no multiple": (lambda: poles("0.3"), "point 0 of the input Singularities is 0.3.*1/4"),
    "too far": (simple.Wavelet, "farther from the surface.*Maximum Distance"),
    "vectors as indices": (lambda: poles("iHat"), "3 components"),
    "nothing": (TestGuides.EMPTY["nothing"], "sum to 0.*add singularities of 2"),
    "group of tables": (TestGuides.EMPTY["group of tables"], "sum to 0"),
    "table": (simple.Text, "is a vtkTable.*Table To Points"),
    "graph": (TestGuides.ERRORS["graph"][0], "is a vtkMutableDirectedGraph.*connect"),
    "not a number": (TestGuides.ERRORS["not a number"][0], "point 1 of .*nan|farther"),
    "group": (lambda: TestGuides.group(simple.Cone(), simple.Wavelet()), "farther|characteristic"),
    "vectors without a name": (
        TestGuides.ACTIVE["vectors without a name"], "farther|characteristic"),
}


def cases():
    for check in (check_corners, check_several, check_another_array, check_those_of_another_field,
                  check_the_filter_that_shows_it, check_what_comes_next):
        yield check.__name__, check, None
    for name, (source, words) in ERRORS.items():
        yield name, lambda source=source: check_error(source), "ERR.*(" + words + ")"


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--plugin", required=True)
    simple.LoadPlugin(parser.parse_args().plugin, remote=False, ns=vars(simple))
    failures = 0
    for name, check, words in cases():
        status, messages = TestGuides.run(check)
        problem = TestGuides.problem_of(status, messages, words)
        print(f"{name}: {problem or 'as expected'}", flush=True)
        if problem:
            failures += 1
            print(messages, flush=True)
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
