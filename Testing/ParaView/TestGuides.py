"""Every kind of source that ParaView offers as guide of the solver: a field, or one error.

    TestGuides.py --plugin FILE

runs each case in a process of its own, since what is tested for is that none of them aborts.
"""

import argparse
import functools
import math
import os
import re
import signal
import sys
import tempfile

import numpy as np
import paraview.simple as simple
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkFiltersSources import vtkPlatonicSolidSource
from vtkmodules.vtkCommonCore import vtkDoubleArray, vtkPoints
from vtkmodules.vtkCommonDataModel import (
    vtkCellArray, vtkMultiBlockDataSet, vtkMutableDirectedGraph, vtkPolyData, vtkRectilinearGrid,
    vtkTable)

VECTOR = np.array([0.3, 0.5, 1.0])
FUNCTION = "0.3*iHat+0.5*jHat+kHat"


def with_vectors(source, **options):
    return simple.Calculator(Input=source, ResultArrayName="D", Function=FUNCTION, **options)


def producer(data):
    """A source of what was made here."""
    source = simple.TrivialProducer()
    source.GetClientSideObject().SetOutput(data)
    return source


def three_points(name="D", tuples=3, second=(0, 2, 0)):
    """Points without cells, at them vectors, which are active."""
    points, vectors, data = vtkPoints(), vtkDoubleArray(), vtkPolyData()
    for position in ((2, 0, 0), second, (0, 0, 2)):
        points.InsertNextPoint(position)
    vectors.SetNumberOfComponents(3)
    vectors.SetName(name)
    for _ in range(tuples):
        vectors.InsertNextTuple(VECTOR)
    data.SetPoints(points)
    data.GetPointData().SetVectors(vectors)
    return producer(data)


def rectilinear_grid():
    grid, coordinates = vtkRectilinearGrid(), vtkDoubleArray()
    for x in (-1, 0, 2):
        coordinates.InsertNextValue(x)
    grid.SetDimensions(3, 1, 1)
    grid.SetXCoordinates(coordinates)
    return producer(grid)


def group_of_tables():
    data = vtkMultiBlockDataSet()
    data.SetBlock(0, vtkTable())
    return producer(data)


def group(*sources):
    return simple.GroupDatasets(Input=list(sources))


def selected_points():
    source = with_vectors(simple.PointSource(NumberOfPoints=30, Radius=2))
    selection = simple.IDSelectionSource(IDs=[-1, 3, -1, 7], FieldType="POINT")
    return simple.ExtractSelection(Input=source, Selection=selection)


def selected_cells():
    source = with_vectors(simple.Sphere(), AttributeType="Cell Data")
    selection = simple.IDSelectionSource(IDs=[-1, 3, -1, 7], FieldType="CELL")
    return simple.ExtractSelection(Input=source, Selection=selection)


def glyphs():
    source = with_vectors(simple.PointSource(NumberOfPoints=30, Radius=2))
    return simple.Glyph(Input=source, GlyphType="Arrow", OrientationArray=["POINTS", "D"],
                        ScaleArray=["POINTS", "No scale array"])


# A field that follows the vectors. By name: the source, with the array D, which is chosen.
FIELDS = {
    "line": lambda: with_vectors(simple.Line()),
    "polyline": lambda: with_vectors(simple.PolyLineSource()),
    "spline": lambda: with_vectors(simple.SplineSource()),
    "points": lambda: with_vectors(simple.PointSource(NumberOfPoints=30)),
    "points of a polyline": lambda: with_vectors(simple.PolyPointSource()),
    "plane": lambda: with_vectors(simple.Plane()),
    "sphere": lambda: with_vectors(simple.Sphere()),
    "box": lambda: with_vectors(simple.Box()),
    "cone": lambda: with_vectors(simple.Cone()),
    "cylinder": lambda: with_vectors(simple.Cylinder()),
    "disk": lambda: with_vectors(simple.Disk()),
    "superquadric": lambda: with_vectors(simple.Superquadric()),
    "arrow": lambda: with_vectors(simple.Arrow()),
    "axes": lambda: with_vectors(simple.Axes()),
    "text in space": lambda: with_vectors(simple.a3DText()),
    "ruler": lambda: with_vectors(simple.Ruler()),
    "image": lambda: with_vectors(simple.Wavelet()),
    "uniform grid": lambda: with_vectors(simple.FastUniformGrid()),
    "fractal image": lambda: with_vectors(simple.Mandelbrot()),
    "structured grid": lambda: with_vectors(simple.Transform(Input=simple.Wavelet())),
    "rectilinear grid": lambda: with_vectors(rectilinear_grid()),
    "unstructured grid": lambda: with_vectors(simple.UnstructuredCellTypes()),
    "appended datasets": lambda: with_vectors(
        simple.AppendDatasets(Input=[simple.Wavelet(), simple.Cone()])),
    "group": lambda: with_vectors(group(simple.Cone(), simple.Wavelet())),
    "group in which one has the vectors": lambda: group(
        simple.Cone(), with_vectors(simple.Line())),
    "partitioned collection": lambda: with_vectors(simple.PartitionedDataSetCollectionSource()),
    "adaptive mesh": lambda: with_vectors(simple.HierarchicalFractal()),
    "selection": selected_points,
    "glyphs": glyphs,
}

# The same with vectors on cells.
ON_CELLS = {
    "cells": lambda: with_vectors(simple.Cone(), AttributeType="Cell Data"),
    "cells of an image": lambda: with_vectors(simple.Wavelet(), AttributeType="Cell Data"),
    "cells that are lines": lambda: with_vectors(
        simple.PolyLineSource(Points=[1, 0, 0, 0.7, 0.5, 0.5]), AttributeType="Cell Data"),
    "selected cells": selected_cells,
}

# The same with what is active, which is not chosen.
ACTIVE = {
    "active vectors": lambda: with_vectors(simple.PointSource(NumberOfPoints=30)),
    "vectors without a name": lambda: three_points(name=None),
}

# Nothing to follow: the smoothest field.
EMPTY = {
    "nothing": lambda: producer(vtkPolyData()),
    "group of nothing": lambda: producer(vtkMultiBlockDataSet()),
    "group of tables": group_of_tables,
}

# One error. By name: the source, the array that is chosen, if any, and words of the message.
ERRORS = {
    "points without vectors": (simple.PointSource, None, "neither lines nor vectors.*Calculator"),
    "image without vectors": (simple.Wavelet, None, "neither lines nor vectors.*Calculator"),
    "image without the array": (simple.Wavelet, "D", "array 'D'.*choose"),
    "scalars": (simple.Wavelet, "RTData", "array 'RTData'.*3 numbers.*choose"),
    "table": (simple.Text, "D", "is a vtkTable.*Table To Points"),
    "hyper tree grid": (simple.HyperTreeGridRandom, "D", "is a vtkHyperTreeGrid.*connect"),
    "graph": (
        lambda: producer(vtkMutableDirectedGraph()), "D", "is a vtkMutableDirectedGraph.*connect"),
    "not a number": (lambda: three_points(second=(math.nan, 0, 0)), "D", "point 1 of .*nan.*move"),
    "infinite": (lambda: three_points(second=(0, -math.inf, 0)), "D", "point 1 of .*inf.*move"),
    "no tuples": (lambda: three_points(tuples=0), "D", "array 'D'.* 0 tuples for 3 points.*choose"),
    "too few tuples": (
        lambda: three_points(tuples=2), "D", "array 'D'.* 2 tuples for 3 points.*choose"),
}


def solver_of(source, array, elements="POINTS"):
    octahedron = vtkPlatonicSolidSource()
    octahedron.SetSolidTypeToOctahedron()
    octahedron.Update()
    octahedron.GetOutput().GetCellData().Initialize()  # an array without a name
    # Even triangles on flat sides with sharp edges between them, so that each triangle has the normals of its corners.
    surface = simple.Subdivide(Input=producer(octahedron.GetOutput()), NumberofSubdivisions=3)
    solver = simple.HarmonicFieldSolver(Input=surface, Guides=source, Discretisation="Power Field on Faces",
                                        NumberOfDirections=1, ConstraintType="Hard",
                                        MaximumDistance=1000)  # shows the triangles that a guide reaches
    if array:
        solver.GuideDirections = array
    return solver


def corner_points(surface):
    """The corners of each triangle, #F x 3 x 3."""
    corners = vtk_to_numpy(surface.GetPolys().GetConnectivityArray()).reshape(-1, 3)
    return vtk_to_numpy(surface.GetPoints().GetData()).astype(float)[corners]


def check_field(source, array, elements="POINTS"):
    """Where directions are prescribed, the field is the tangential part of the vector."""
    solver = solver_of(source(), array, elements)
    solver.UpdatePipeline()
    field = simple.servermanager.Fetch(solver)
    assert field.GetFieldData().GetArray("Converged").GetValue(0) == 1
    cells = field.GetCellData()
    held = vtk_to_numpy(cells.GetArray("Prescribed")) > 0
    assert held.any()
    sides = np.diff(corner_points(field), axis=1)
    normals = np.cross(sides[:, 0], sides[:, 1])
    normals /= np.linalg.norm(normals, axis=1, keepdims=True)
    expected = VECTOR - normals * (normals @ VECTOR)[:, None]
    expected /= np.linalg.norm(expected, axis=1, keepdims=True)
    directions = vtk_to_numpy(cells.GetArray("Direction0"))
    assert np.abs(directions - expected)[held].max() < 1e-6  # points in single precision


def check_smoothest(source):
    solver = solver_of(source(), "D")
    solver.UpdatePipeline()
    report = simple.servermanager.Fetch(solver).GetFieldData()
    assert report.GetArray("Converged").GetValue(0) == 1
    assert report.GetArray("Eigenvalues").GetNumberOfTuples() == 1
    assert report.GetArray("GuidesTaken").GetValue(0) == 0


def check_error(source, array):
    """There is no field; problem_of looks at the message."""
    solver = solver_of(source(), array)
    solver.UpdatePipeline()
    assert simple.servermanager.Fetch(solver).GetNumberOfCells() == 0


def check_the_first_example():
    """As a user has it; the middle of the line is farther from the sphere than guides count."""
    c = simple.Calculator(Input=simple.Line(), ResultArrayName="D", Function="jHat")
    solver = simple.HarmonicFieldSolver(
        Input=simple.Sphere(), Guides=c, GuideDirections="D")
    solver.UpdatePipeline()
    assert simple.servermanager.Fetch(solver).GetFieldData().GetArray("Converged").GetValue(0) == 1


def check_lines_and_points():
    """A polyline above a plate, which is followed, and points with vectors, at once."""
    plate = simple.Plane(Origin=[0, 0, 0], Point1=[8, 0, 0], Point2=[0, 8, 0],
                         XResolution=8, YResolution=8)
    line = simple.PolyLineSource(Points=[0.1, 3.3, 0.2, 7.9, 3.3, 0.2])
    points = simple.Calculator(
        Input=simple.PointSource(Center=[4.2, 6.3, 0.1], NumberOfPoints=1, Radius=0),
        ResultArrayName="D", Function="jHat")
    spline = simple.SplineSource(ParametricFunction="Spline")
    spline.ParametricFunction.Points = [0.1, 0.4, 0.0, 4.0, 0.4, 0.0, 7.9, 0.4, 0.0]
    solver = simple.HarmonicFieldSolver(
        Input=simple.Triangulate(Input=plate), Guides=[line, points, spline], NumberOfDirections=1,
        GuideDirections="D", ConstraintType="Hard")
    solver.UpdatePipeline()
    field = simple.servermanager.Fetch(solver)
    held = vtk_to_numpy(field.GetPointData().GetArray("Prescribed")) > 0
    y = vtk_to_numpy(field.GetPoints().GetData())[:, 1]
    directions = vtk_to_numpy(field.GetPointData().GetArray("Direction0"))
    # The corners of the squares that a line passes.
    for first, last in ((0, 1), (3, 4)):
        around = (y > first - 0.5) & (y < last + 0.5)
        assert held[around].all(), first
        assert np.abs(directions[around] - (1, 0, 0)).max() < 1e-6
    others = held & (y > 5)
    assert others.sum() == 3 and held.sum() == 18 + 18 + 3
    assert np.abs(directions[others] - (0, 1, 0)).max() < 1e-6
    report = field.GetFieldData()
    assert report.GetArray("GuidesTooFar").GetValue(0) == 0
    assert abs(report.GetArray("GuidesFarthest").GetValue(0) - 0.2) < 1e-6
    solver.Guides = [points]
    solver.UpdatePipeline()
    points = simple.servermanager.Fetch(solver).GetPointData()
    assert (vtk_to_numpy(points.GetArray("Prescribed")) > 0).sum() == 3


def check_weights_in_field_data():
    line = vtkPolyData()
    line.SetPoints(vtkPoints())
    line.SetLines(vtkCellArray())
    line.GetLines().InsertNextCell(2)
    for point, position in enumerate(((0.9, 0, 0.5), (0.9, 0.5, 0))):
        line.GetPoints().InsertNextPoint(position)
        line.GetLines().InsertCellPoint(point)
    weights = vtkDoubleArray()
    weights.SetName("W")
    weights.InsertNextValue(2.5)
    line.GetFieldData().AddArray(weights)
    prescribed = []
    for array in ("", "W"):
        solver = simple.HarmonicFieldSolver(
            Input=simple.Sphere(Radius=1), Guides=producer(line), GuideWeights=array)
        solver.UpdatePipeline()
        prescribed.append(vtk_to_numpy(
            simple.servermanager.Fetch(solver).GetPointData().GetArray("Prescribed")))
    assert prescribed[0].max() > 0
    assert np.allclose(prescribed[1], 2.5 * prescribed[0], rtol=1e-12)


def check_several_lists():
    """A guide in each list of the panel, and a weight for each, or one for all, as a person types them."""
    lines = [simple.Line(Point1=[-0.4, y, 0.6], Point2=[0.4, y, 0.6], Resolution=1) for y in (-0.5, -0.2, 0.2, 0.5)]
    solver = simple.HarmonicFieldSolver(Input=simple.Sphere(Radius=1, ThetaResolution=40, PhiResolution=40), Guides=lines[0],
                                        SecondGuide=lines[1], ThirdGuide=lines[2], FourthGuide=lines[3], MaximumDistance=1)
    weights = []
    for typed in ("", "5", "1 1 1 2"):
        solver.GuideWeights = typed
        solver.UpdatePipeline()
        field = simple.servermanager.Fetch(solver)
        assert field.GetFieldData().GetArray("GuidesTaken").GetValue(0) == 4
        weights.append(vtk_to_numpy(field.GetPointData().GetArray("Prescribed")))
    assert np.allclose(weights[1], 5 * weights[0], rtol=1e-12) and weights[0].max() > 0
    ratios = weights[2][weights[0] > 0] / weights[0][weights[0] > 0]
    assert np.allclose(ratios[np.abs(ratios - 1) > 1e-9], 2) and ratios.max() > 1.9, ratios
    solver.SecondGuide = solver.ThirdGuide = solver.FourthGuide = None
    solver.GuideWeights = ""
    solver.UpdatePipeline()
    assert simple.servermanager.Fetch(solver).GetFieldData().GetArray("GuidesTaken").GetValue(0) == 1


def run(check):
    """(exit status, messages) of a check in a process of its own."""
    with tempfile.TemporaryFile() as messages:
        sys.stdout.flush()
        process = os.fork()
        if process == 0:
            os.dup2(messages.fileno(), 1)
            os.dup2(messages.fileno(), 2)
            status = 1
            try:
                check()
                status = 0
            except BaseException as error:
                print(type(error).__name__, error)
            sys.stdout.flush()
            os._exit(status)
        _, status = os.waitpid(process, 0)
        messages.seek(0)
        return status, messages.read().decode(errors="replace")


def problem_of(status, output, words):
    """What is wrong with how a case has ended, or nothing."""
    if os.WIFSIGNALED(status):
        return f"ended by {signal.Signals(os.WTERMSIG(status)).name}"
    if status != 0:
        return "failed"
    messages = [line for line in output.splitlines() if re.search(r"\b(ERR|WARN)\|", line)
                and "returned failure for request" not in line  # which VTK adds
                and "within 5 degrees of the normal" not in line]  # the same vectors everywhere around a sphere
    if len(messages) != (1 if words else 0):
        return f"reported {len(messages)} errors and warnings"
    return None if not words or re.search(words, messages[0]) else f"does not say '{words}'"


def cases():
    """(name, check, words of the only error or warning, or None) of each case."""
    yield "the first example", check_the_first_example, "WARN.*left out.*Maximum Distance"
    yield "lines and points", check_lines_and_points, None
    yield "several lists", check_several_lists, None
    yield "weights in field data", check_weights_in_field_data, None
    for name, source in FIELDS.items():
        yield name, functools.partial(check_field, source, "D"), None
    for name, source in ON_CELLS.items():
        yield name, functools.partial(check_field, source, "D", "CELLS"), None
    for name, source in ACTIVE.items():
        yield name, functools.partial(check_field, source, None), None
    for name, source in EMPTY.items():
        yield name, functools.partial(check_smoothest, source), None
    for name, (source, array, words) in ERRORS.items():
        yield name, functools.partial(check_error, source, array), "ERR.*" + words


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--plugin", required=True)
    simple.LoadPlugin(parser.parse_args().plugin, remote=False, ns=vars(simple))
    failures = 0
    for name, check, words in cases():
        status, messages = run(check)
        problem = problem_of(status, messages, words)
        print(f"{name}: {problem or 'as expected'}", flush=True)
        if problem:
            failures += 1
            print(messages, flush=True)
    return 1 if failures else 0


if __name__ == "__main__":
    sys.exit(main())
