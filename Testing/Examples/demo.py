"""A smooth cross field on a surface, through ParaView's Python:  pvbatch demo.py SURFACE

Prescribes the directions of principal curvature at a few places where they are clear, lets
DirectionalProlongation and HarmonicFieldSolver find the smoothest cross field that follows them, draws it
by FieldLines and FieldSingularities, and leaves demo.vtp, the surface with the field, and demo.png, a
picture of it, in the current folder.

SURFACE is a PLY, OBJ, STL, OFF, VTK or VTP file.
"""

import pathlib
import sys
import time

import numpy as np
import paraview.simple as simple
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData

START = time.monotonic()


def say(text):
    print(f"[{time.monotonic() - START:6.1f} s] {text}", flush=True)


# Surfaces ------------------------------------------------------------------------------------------


def poly_data(points, cells=None, lines=None, **point_arrays):
    """A vtkPolyData of points (#V by 3) with triangles (#F by 3) or lines (lists of indices)."""
    data = vtkPolyData()
    data.SetPoints(vtkPoints())
    data.GetPoints().SetData(numpy_to_vtk(np.ascontiguousarray(points, float), deep=True))
    if cells is not None:
        data.SetPolys(cell_array(np.arange(0, 3 * len(cells) + 1, 3), np.ravel(cells)))
    if lines is not None:
        offsets = np.concatenate([[0], np.cumsum([len(line) for line in lines])])
        data.SetLines(cell_array(offsets, np.concatenate(lines)))
    for name, values in point_arrays.items():
        add_array(data.GetPointData(), name, values)
    return data


def cell_array(offsets, connectivity):
    cells = vtkCellArray()
    cells.SetData(numpy_to_vtkIdTypeArray(offsets.astype(np.int64), deep=True),
                  numpy_to_vtkIdTypeArray(connectivity.astype(np.int64), deep=True))
    return cells


def add_array(attributes, name, values):
    array = numpy_to_vtk(np.ascontiguousarray(values), deep=True)
    array.SetName(name)
    attributes.AddArray(array)


def source(data):
    """A pipeline source that holds a dataset."""
    producer = simple.TrivialProducer()
    producer.GetClientSideObject().SetOutput(data)
    return producer


def read_off(path):
    """An OFF file of polygons; VTK has no reader for it."""
    text = " ".join(line.split("#")[0] for line in open(path)).split()
    if text[0] != "OFF":
        raise SystemExit(f"{path} is no OFF file of points alone (its first word is {text[0]})")
    vertices, faces = int(text[1]), int(text[2])
    points = np.array(text[4:4 + 3 * vertices], float).reshape(-1, 3)
    rest = np.array(text[4 + 3 * vertices:], float)
    offsets, corners, at = [0], [], 0
    for _ in range(faces):
        count = int(rest[at])
        corners.append(rest[at + 1:at + 1 + count])
        offsets.append(offsets[-1] + count)
        at += 1 + count
    data = poly_data(points)
    data.SetPolys(cell_array(np.array(offsets), np.concatenate(corners)))
    return data


def open_surface(path):
    """A source of triangles without doubled points."""
    if pathlib.Path(path).suffix.lower() == ".off":
        surface = source(read_off(path))
    else:
        surface = simple.ExtractSurface(Input=simple.OpenDataFile(path))
    return simple.Clean(Input=simple.Triangulate(Input=surface))


def arrays_of(data):
    """Points, #V by 3, and triangles, #F by 3."""
    return (vtk_to_numpy(data.GetPoints().GetData()).astype(float),
            vtk_to_numpy(data.GetPolys().GetConnectivityArray()).reshape(-1, 3))


# Prescribed directions -----------------------------------------------------------------------------


def normals_of(points, triangles):
    corners = points[triangles]
    normals = np.cross(corners[:, 1] - corners[:, 0], corners[:, 2] - corners[:, 0])
    return normals / np.maximum(np.linalg.norm(normals, axis=1, keepdims=True), 1e-300)


def principal_directions(points, triangles, rounds=10):
    """A direction of principal curvature per face, and how much the two curvatures differ there.

    The curvature tensor of an edge is its bend times the square of its direction (D. Cohen-Steiner
    and J.-M. Morvan, Restricted Delaunay triangulations and normal cycle, 2003); it is averaged over
    some rounds of neighbours, since scans are noisy.
    """
    normals = normals_of(points, triangles)
    ends = np.stack([triangles, np.roll(triangles, -1, axis=1)], axis=2).reshape(-1, 2)
    key = ends.min(axis=1) * len(points) + ends.max(axis=1)
    order = np.argsort(key, kind="stable")
    pairs = np.flatnonzero(key[order[:-1]] == key[order[1:]])
    left, right = order[pairs] // 3, order[pairs + 1] // 3

    edge = points[ends[order[pairs], 1]] - points[ends[order[pairs], 0]]
    length = np.linalg.norm(edge, axis=1)
    edge /= np.maximum(length, 1e-300)[:, None]
    sine = (np.cross(normals[left], normals[right]) * edge).sum(axis=1)
    bend = np.arctan2(sine, (normals[left] * normals[right]).sum(axis=1))
    tensor = (bend * length)[:, None, None] * edge[:, :, None] * edge[:, None, :]

    def gather(values, where, size):
        flat = values.reshape(len(values), -1)
        columns = [np.bincount(where, column, size) for column in flat.T]
        return np.stack(columns, axis=1).reshape((size,) + values.shape[1:])

    count = len(triangles)
    tensors = gather(np.concatenate([tensor, tensor]), np.concatenate([left, right]), count)
    area = 0.5 * np.linalg.norm(np.cross(points[triangles[:, 1]] - points[triangles[:, 0]],
                                         points[triangles[:, 2]] - points[triangles[:, 0]]), axis=1)
    for _ in range(rounds):  # faces to points and back; areas alike, to divide by in the end
        for_points = gather(np.repeat(tensors, 3, axis=0), triangles.ravel(), len(points))
        tensors = for_points[triangles].mean(axis=1)
        for_points = gather(np.repeat(area, 3), triangles.ravel(), len(points))
        area = for_points[triangles].mean(axis=1)
    tensors /= np.maximum(area, 1e-300)[:, None, None]

    tangential = np.eye(3) - normals[:, :, None] * normals[:, None, :]
    values, vectors = np.linalg.eigh(tangential @ tensors @ tangential)
    strongest = np.abs(values).argmax(axis=1)
    directions = np.take_along_axis(vectors, strongest[:, None, None], axis=2)[:, :, 0]
    # Of the three values the normal's is zero: the differences of the other two.
    mean = values.sum(axis=1) / 2
    difference = np.sqrt(np.maximum(0, 2 * (values ** 2).sum(axis=1) - 4 * mean ** 2))
    return directions, difference


def choose_strokes(centres, normals, clearness, distance, limit):
    """Faces where the direction is clearest, none nearer to another than the distance."""
    chosen = []
    threshold = np.quantile(clearness, 0.7)
    for face in np.argsort(-clearness):
        if len(chosen) == limit or clearness[face] < threshold:
            break
        near = np.linalg.norm(centres[chosen] - centres[face], axis=1) < distance
        if not (near & ((normals[chosen] * normals[face]).sum(axis=1) > 0)).any():
            chosen.append(face)
    return np.array(chosen)


def prescribe(data, size):
    """Adds the cell arrays Prescribed and Directions; returns the strokes' segments to draw."""
    points, triangles = arrays_of(data)
    normals, centres = normals_of(points, triangles), points[triangles].mean(axis=1)
    directions, clearness = principal_directions(points, triangles)
    mask = np.zeros(len(triangles), np.int8)
    prescribed = np.zeros((len(triangles), 3))
    segments, sides = [], []
    radius = 0.012 * size
    for face in choose_strokes(centres, normals, clearness, 0.1 * size, 60):
        near = np.linalg.norm(centres - centres[face], axis=1) < radius
        near &= normals @ normals[face] > 0.7
        mask[near] = 1
        prescribed[near] = directions[face]
        segments += [centres[face] - radius * directions[face],
                     centres[face] + radius * directions[face]]
        sides += [normals[face], normals[face]]
    add_array(data.GetCellData(), "PrescribedMask", mask)
    add_array(data.GetCellData(), "PrescribedDirections", prescribed)
    return np.array(segments), np.array(sides), int(mask.sum())


# The picture ---------------------------------------------------------------------------------------


def show(data, view, colour, **properties):
    display = simple.Show(data, view)
    display.SetRepresentationType("Surface")
    simple.ColorBy(display, ("POINTS", ""))
    display.AmbientColor = display.DiffuseColor = colour
    for name, value in properties.items():
        setattr(display, name, value)


def tubes(lines, radius):
    return simple.Tube(Input=lines, Radius=radius, NumberofSides=8, Capping=1)


def show_singularities(field, view, radius):
    """Balls, red where the index is positive and green where it is negative; returns the indices."""
    singularities = simple.FieldSingularities(Input=field)
    balls = simple.Glyph(Input=singularities, GlyphType="Sphere", GlyphMode="All Points",
                         ScaleFactor=2 * radius, ScaleArray=["POINTS", "No scale array"],
                         OrientationArray=["POINTS", "No orientation array"])
    balls.GlyphType.ThetaResolution = balls.GlyphType.PhiResolution = 24
    show(balls, view, [1.0, 1.0, 1.0], Specular=0.4)
    simple.ColorBy(simple.GetDisplayProperties(balls, view), ("POINTS", "Index"))
    colours = simple.GetColorTransferFunction("Index")
    colours.RGBPoints = [-1.0, 0.12, 0.53, 0.30, -0.01, 0.12, 0.53, 0.30,
                         0.01, 0.83, 0.15, 0.17, 1.0, 0.83, 0.15, 0.17]
    return vtk_to_numpy(simple.servermanager.Fetch(singularities).GetPointData().GetArray("Index"))


def look_at(view, points):
    """From the front, a little from the right and above; the points fill the picture."""
    towards = np.array([0.35, 0.3, 1.0]) / np.linalg.norm([0.35, 0.3, 1.0])
    right = np.cross([0, 1, 0], towards)
    right /= np.linalg.norm(right)
    up = np.cross(towards, right)
    axes = np.stack([right, up, towards])
    low, high = (points @ axes.T).min(axis=0), (points @ axes.T).max(axis=0)
    centre = (low + high) / 2 @ axes
    width, height = view.ViewSize
    view.CameraParallelProjection = 1
    view.CameraParallelScale = 0.53 * max(high[1] - low[1], (high[0] - low[0]) * height / width)
    view.CameraFocalPoint = centre
    view.CameraPosition = centre + 2 * np.linalg.norm(high - low) * towards
    view.CameraViewUp = up


def white_view(size):
    view = simple.CreateRenderView(ViewSize=size)
    view.OrientationAxesVisibility = 0
    view.UseColorPaletteForBackground = 0
    view.Background = [1.0, 1.0, 1.0]
    return view


def draw(field, points, strokes, size, image):
    view = white_view([1200, 1050])
    smooth = simple.GenerateSurfaceNormals(Input=field, FeatureAngle=60)
    show(smooth, view, [1.0, 0.97, 0.92], Ambient=0.12, Specular=0.1, SpecularPower=30)

    lines = simple.FieldLines(Input=field, SeparatingDistance=0.016)
    show(tubes(lines, 0.0009 * size), view, [0.16, 0.33, 0.52])
    say(f"{lines.GetDataInformation().GetNumberOfCells()} lines along the crosses")

    segments, sides = strokes
    pairs = list(np.arange(len(segments)).reshape(-1, 2))
    gold = source(poly_data(segments + 0.002 * size * sides, lines=pairs))
    show(tubes(gold, 0.0035 * size), view, [0.98, 0.72, 0.10], Specular=0.4)

    index = show_singularities(field, view, 0.008 * size)
    say(f"{(index > 0).sum()} singularities of positive index (red), {(index < 0).sum()} of negative"
        f" (green); the indices sum to {index.sum():g}")

    look_at(view, points)
    simple.SaveScreenshot(image, view, ImageResolution=[2400, 2100])


def main():
    if len(sys.argv) != 2:
        raise SystemExit(__doc__)
    surface = open_surface(sys.argv[1])
    data = simple.servermanager.Fetch(surface)
    points, triangles = arrays_of(data)
    size = np.linalg.norm(np.ptp(points, axis=0))
    say(f"{sys.argv[1]}: {len(points)} points, {len(triangles)} triangles")

    segments, sides, count = prescribe(data, size)
    say(f"{len(segments) // 2} strokes prescribe directions on {count} triangles")

    prolongation = simple.DirectionalProlongation(Input=source(data))
    prolongation.UpdatePipeline()
    if prolongation.GetDataInformation().GetNumberOfCells() == 0:
        raise SystemExit("The surface was refused, for the reason given above.")
    say("decimated level by level, with the operators between the levels")

    solver = simple.HarmonicFieldSolver(
        Input=prolongation, NumberOfDirections=4, Mask=["CELLS", "PrescribedMask"],
        Directions=["CELLS", "PrescribedDirections"])
    solver.UpdatePipeline()
    report = simple.servermanager.Fetch(solver).GetFieldData()
    say(f"solved: {report.GetAbstractArray('Solver').GetValue(0)}")

    simple.SaveData("demo.vtp", solver, DataMode="Binary")  # see README, "Files"
    draw(solver, points, (segments, sides), size, "demo.png")
    say("wrote demo.vtp and demo.png")


if __name__ == "__main__":
    main()
