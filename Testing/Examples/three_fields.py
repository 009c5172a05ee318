"""The three discretisations beside each other, in pvbatch:  pvbatch three_fields.py SURFACE

Prescribes the same few directions on a surface, solves for a cross field (power field), a face field
and a 1-form, and leaves power_field.png, face_field.png and one_form.png in the current folder: the
pictures of the README and of the help. Lines follow the field; the colour of a surface is the
magnitude of its field, from blue (none) to red (that of the prescribed arrows, or more).

SURFACE is Data/double_torus.vtp for these pictures, or another file that demo.py reads.
"""

import sys

import numpy as np
import paraview.simple as simple
from vtkmodules.util.numpy_support import vtk_to_numpy

from demo import (add_array, arrays_of, balls, look_at, normals_of, open_surface, poly_data, say,
                  show, source, tubes)
from evenly_spaced_lines import evenly_spaced_lines

# Where directions are prescribed, as parts of the surface's box, and which way.
STROKES = [((0.03, 0.5, 0.9), (0.0, -1.0, 0.0)),
           ((0.5, 0.9, 0.9), (1.0, 0.0, 0.0)),
           ((0.97, 0.5, 0.9), (0.5, 1.0, 0.0))]

FIELDS = {"power_field": dict(Discretisation="Power Field", NumberOfDirections=4),
          "face_field": dict(Discretisation="Face Field"),
          "one_form": dict(Discretisation="1-Form")}


def prescribe(data, size):
    """Adds the cell array Prescription, zero where nothing is prescribed; returns the faces' arrows."""
    points, triangles = arrays_of(data)
    normals, centres = normals_of(points, triangles), points[triangles].mean(axis=1)
    prescription = np.zeros(centres.shape)
    arrows = []
    for place, way in STROKES:
        place = points.min(axis=0) + np.array(place) * np.ptp(points, axis=0)
        face = np.linalg.norm(centres - place, axis=1).argmin()
        near = np.linalg.norm(centres - centres[face], axis=1) < 0.025 * size
        near &= normals @ normals[face] > 0.5
        tangential = np.array(way) - normals[near] * (normals[near] @ way)[:, None]
        prescription[near] = tangential / np.linalg.norm(tangential, axis=1, keepdims=True)
        arrows.append((centres[face], normals[face], prescription[face]))
    add_array(data.GetCellData(), "Prescription", prescription)
    return [np.array(part) for part in zip(*arrows)]


def heads(points, directions, length):
    return simple.Glyph(Input=source(poly_data(points, Way=directions)), GlyphType="Cone",
                        GlyphMode="All Points", ScaleFactor=length,
                        ScaleArray=["POINTS", "No scale array"],
                        OrientationArray=["POINTS", "Way"])


def draw(field, arrows, size, image):
    points, triangles = arrays_of(field)
    crosses = int(vtk_to_numpy(field.GetFieldData().GetArray("NumberOfDirections"))[0]) > 1
    cells = field.GetCellData()
    directions = [vtk_to_numpy(cells.GetArray(f"Direction{k}")) for k in range(4 if crosses else 1)]
    magnitude = np.linalg.norm(directions[0], axis=1)
    unit = [d / np.maximum(magnitude, 1e-300)[:, None] for d in directions]
    lines = evenly_spaced_lines(points, triangles, unit, 0.025 * size)

    view = simple.CreateRenderView(ViewSize=[800, 560])
    view.OrientationAxesVisibility = 0
    view.UseColorPaletteForBackground = 0
    view.Background = [1.0, 1.0, 1.0]

    corners = np.bincount(triangles.ravel(), minlength=len(points))
    at_points = np.bincount(triangles.ravel(), np.repeat(magnitude, 3), len(points)) / corners
    add_array(field.GetPointData(), "Magnitude", at_points)
    smooth = simple.GenerateSurfaceNormals(Input=source(field), FeatureAngle=60)
    show(smooth, view, [1.0, 0.97, 0.92], Ambient=0.12, Specular=0.1, SpecularPower=30)
    display = simple.GetDisplayProperties(smooth, view)
    simple.ColorBy(display, ("POINTS", "Magnitude"))
    colours = simple.GetColorTransferFunction("Magnitude")
    colours.RGBPoints = [0.0, 0.60, 0.71, 0.85, 0.5, 1.0, 0.98, 0.90, 1.0, 0.91, 0.55, 0.42]
    colours.ColorSpace = "Lab"

    offset = 0.001 * size
    parts = [np.array(p) + offset * np.array(n) for p, n in lines]
    ends = np.cumsum([len(part) for part in parts])
    indices = [np.arange(end - len(part), end) for part, end in zip(parts, ends)]
    ink = [0.16, 0.33, 0.52]
    show(tubes(np.concatenate(parts), indices, 0.0015 * size), view, ink)
    if not crosses:
        middles = [part[len(part) // 2 - 1:len(part) // 2 + 1] for part in parts]
        ways = []
        for (p, n), part in zip(lines, parts):
            m = len(part) // 2
            ways.append(part[m] - part[m - 1])
        show(heads(np.array([m[0] for m in middles]), np.array(ways), 0.018 * size), view, ink)

    places, sides, ways = arrows
    tails = places + 0.004 * size * sides
    segments = np.stack([tails - 0.035 * size * ways, tails + 0.03 * size * ways], axis=1)
    gold = [0.98, 0.72, 0.10]
    show(tubes(segments.reshape(-1, 3), list(np.arange(2 * len(places)).reshape(-1, 2)),
               0.006 * size), view, gold, Specular=0.4)
    show(heads(tails + 0.04 * size * ways, ways, 0.035 * size), view, gold, Specular=0.4)

    index = vtk_to_numpy(field.GetPointData().GetArray("SingularityIndex"))
    for where, colour in ((index > 0, [0.83, 0.15, 0.17]), (index < 0, [0.12, 0.53, 0.30])):
        if where.any():
            show(balls(points[where], 0.011 * size), view, colour, Specular=0.4)

    look_at(view, points)
    simple.SaveScreenshot(image, view, ImageResolution=[800, 560])
    simple.Delete(view)


def main():
    if len(sys.argv) != 2:
        raise SystemExit(__doc__)
    fine = simple.LoopSubdivision(Input=open_surface(sys.argv[1]), NumberofSubdivisions=2)
    data = simple.servermanager.Fetch(fine)
    points, triangles = arrays_of(data)
    size = np.linalg.norm(np.ptp(points, axis=0))
    arrows = prescribe(data, size)
    say(f"{len(triangles)} triangles")
    levels = simple.DirectionalProlongation(Input=source(data))
    for name, properties in FIELDS.items():
        solver = simple.HarmonicFieldSolver(Input=levels, Directions=["CELLS", "Prescription"],
                                            ConstraintType="Hard", UnitLength=0, **properties)
        field = simple.servermanager.Fetch(solver)
        d = vtk_to_numpy(field.GetCellData().GetArray("Direction0"))
        say((name, field.GetFieldData().GetAbstractArray("Solver").GetValue(0), np.quantile(np.linalg.norm(d,axis=1),[0,.25,.5,.75,1]),
            np.unique(vtk_to_numpy(field.GetPointData().GetArray("SingularityIndex")),return_counts=True)))
        draw(field, arrows, size, f"{name}.png")
        say(f"wrote {name}.png")


if __name__ == "__main__":
    main()
