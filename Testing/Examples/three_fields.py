"""The three discretisations beside each other, through ParaView's Python:

    pvbatch three_fields.py Data/double_torus.vtp

Prescribes the same three directions on a subdivided surface, solves for a cross field (power field),
a face field and a 1-form, and leaves power_field.png, face_field.png and one_form.png in the current
folder: the pictures of the README and of the help. Lines follow the field; the colour of the surface
is the field's magnitude, from 0 (blue) to 1 (red), that of the prescribed directions.
"""

import sys

import numpy as np
import paraview.simple as simple
from vtkmodules.util.numpy_support import vtk_to_numpy

from demo import (add_array, arrays_of, look_at, normals_of, open_surface, poly_data, say, show,
                  show_singularities, source, tubes, white_view)

# Where directions are prescribed, as parts of the surface's box, and which way. The second opposes the
# flow from the first to the third.
STROKES = [((0.1, 0.5, 1.0), (0.0, -1.0, 0.0)),
           ((0.5, 0.9, 1.0), (1.0, 0.0, 0.0)),
           ((0.9, 0.5, 1.0), (0.5, 1.0, 0.0))]

FIELDS = {"power_field": dict(Discretisation="Power Field", NumberOfDirections=4),
          "face_field": dict(Discretisation="Face Field"),
          "one_form": dict(Discretisation="1-Form")}


def prescribe(data, size):
    """Adds the cell array Prescription, zero where nothing is prescribed; returns the strokes: their
    places, normals and directions."""
    points, triangles = arrays_of(data)
    normals, centres = normals_of(points, triangles), points[triangles].mean(axis=1)
    prescription = np.zeros(centres.shape)
    strokes = []
    for place, way in STROKES:
        place = points.min(axis=0) + np.array(place) * np.ptp(points, axis=0)
        face = np.linalg.norm(centres - place, axis=1).argmin()
        near = np.linalg.norm(centres - centres[face], axis=1) < 0.025 * size
        near &= normals @ normals[face] > 0.5
        tangential = np.array(way) - normals[near] * (normals[near] @ way)[:, None]
        prescription[near] = tangential / np.linalg.norm(tangential, axis=1, keepdims=True)
        strokes.append((centres[face], normals[face], prescription[face]))
    add_array(data.GetCellData(), "Prescription", prescription)
    return [np.array(part) for part in zip(*strokes)]


def solve(data):
    """The fields: a dictionary from names of pictures to datasets."""
    levels = simple.DirectionalProlongation(Input=source(data))
    fields = {}
    for name, properties in FIELDS.items():
        solver = simple.HarmonicFieldSolver(
            Input=levels, Directions=["CELLS", "Prescription"], ConstraintType="Hard", UnitLength=0,
            **properties)
        fields[name] = simple.servermanager.Fetch(solver)
    return fields


def heads(points, directions, length):
    """Arrow heads."""
    return simple.Glyph(Input=source(poly_data(points, Way=directions)), GlyphType="Cone",
                        GlyphMode="All Points", ScaleFactor=length,
                        ScaleArray=["POINTS", "No scale array"],
                        OrientationArray=["POINTS", "Way"])


def draw_field(field, view, size):
    """Lines along the field; with arrow heads if it has one direction, not four."""
    lines = simple.FieldLines(Input=field, SeparatingDistance=0.03)
    ink = [0.16, 0.33, 0.52]
    show(tubes(lines, 0.0017 * size), view, ink)
    data = simple.servermanager.Fetch(lines)
    if vtk_to_numpy(data.GetCellData().GetArray("Branch")).max() > 0:
        return
    points = vtk_to_numpy(data.GetPoints().GetData())
    sizes = np.diff(vtk_to_numpy(data.GetLines().GetOffsetsArray()))
    line = np.repeat(np.arange(len(sizes)), sizes)
    points = points[vtk_to_numpy(data.GetLines().GetConnectivityArray())]
    ways = np.diff(points, axis=0)
    ways[line[1:] != line[:-1]] = 0
    # A head wherever the length of all lines has grown by another part.
    parts = np.cumsum(np.linalg.norm(ways, axis=1)) // (0.25 * size)
    at = np.flatnonzero(np.diff(parts)) + 1
    show(heads(points[at], ways[at], 0.022 * size), view, ink)


def draw(field, strokes, size, image):
    points, triangles = arrays_of(field)
    view = white_view([580, 406])

    magnitude = np.linalg.norm(vtk_to_numpy(field.GetCellData().GetArray("Direction0")), axis=1)
    around = np.bincount(triangles.ravel(), minlength=len(points))
    add_array(field.GetPointData(), "Magnitude",
              np.bincount(triangles.ravel(), np.repeat(magnitude, 3), len(points)) / around)
    smooth = simple.GenerateSurfaceNormals(Input=source(field), FeatureAngle=60)
    show(smooth, view, [1.0, 1.0, 1.0], Ambient=0.3, Diffuse=0.8)
    simple.ColorBy(simple.GetDisplayProperties(smooth, view), ("POINTS", "Magnitude"))
    colours = simple.GetColorTransferFunction("Magnitude")
    colours.RGBPoints = [0.0, 0.62, 0.74, 0.90, 0.5, 1.0, 0.97, 0.88, 1.0, 0.93, 0.55, 0.42]
    colours.ColorSpace = "Lab"

    draw_field(source(field), view, size)

    places, normals, ways = strokes
    middles, ways = places + 0.006 * size * normals, size * ways
    segments = np.stack([middles - 0.035 * ways, middles + 0.03 * ways], axis=1).reshape(-1, 3)
    gold = [0.98, 0.72, 0.10]
    pairs = list(np.arange(len(segments)).reshape(-1, 2))
    show(tubes(source(poly_data(segments, lines=pairs)), 0.006 * size), view, gold, Specular=0.4)
    show(heads(middles + 0.04 * ways, ways, 0.035 * size), view, gold, Specular=0.4)

    show_singularities(source(field), view, 0.011 * size)
    look_at(view, points)
    simple.SaveScreenshot(image, view, ImageResolution=[580, 406], CompressionLevel="9")
    simple.Delete(view)


def main(path, subdivisions=2):
    """Draws the pictures; returns the surface with the prescription, and the fields."""
    data = simple.servermanager.Fetch(
        simple.LoopSubdivision(Input=open_surface(path), NumberofSubdivisions=subdivisions))
    size = np.linalg.norm(np.ptp(arrays_of(data)[0], axis=0))
    strokes = prescribe(data, size)
    fields = solve(data)
    say(f"solved on {data.GetNumberOfCells()} triangles")
    for name, field in fields.items():
        draw(field, strokes, size, f"{name}.png")
        say(f"wrote {name}.png")
    return data, fields


if __name__ == "__main__":
    if len(sys.argv) != 2:
        raise SystemExit(__doc__)
    main(sys.argv[1])
