"""What comes after crosses: a hatched drawing on paper:  pvbatch hatching.py

Crosses follow the bends of a bath toy. Lines along them, where they are seen, are its hatching: one family where it is not in the
light, the other one as well where it is dark. Lines begin at different tones, and are thin at their ends. hatching.svg is the drawing as lines, for a plotter or a page; hatching.png shows it.
"""

import numpy as np
from scene import *
from surfaces import duck, source
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import mutable, vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData, vtkStaticCellLocator, vtkStaticPointLocator
from vtkmodules.vtkFiltersCore import vtkContourFilter, vtkPolyDataNormals, vtkStripper

TO_EYE, TO_LIGHT, UP = (np.array(v) / np.linalg.norm(v) for v in ([0.45, 0.35, 1], [-0.7, 0.9, 0.5], [0, 1, 0]))
RIGHT = np.cross(UP, TO_EYE) / np.linalg.norm(np.cross(UP, TO_EYE))
TONES, SOFTNESS = [0.55, 0.05], 0.25  # a family is drawn where there is less light than this, give or take half of that


class Paper:
    """Places of a surface as they are seen, and the light there."""

    def __init__(self, surface):
        normals = vtkPolyDataNormals()
        normals.SetInputData(surface)
        normals.SplittingOff()
        normals.Update()
        self.surface = normals.GetOutput()
        self.normals = vtk_to_numpy(self.surface.GetPointData().GetNormals())
        self.size = self.surface.GetLength()
        self.cells, self.points = vtkStaticCellLocator(), vtkStaticPointLocator()
        for locator in (self.cells, self.points):
            locator.SetDataSet(self.surface)
            locator.BuildLocator()

    def light(self, place):
        return self.normals[self.points.FindClosestPoint(place)] @ TO_LIGHT

    def is_dark(self, place, line, branch):
        """For neighbours at different places, as lines are numbered: multiples of the golden ratio spread evenly."""
        return self.light(place) < TONES[branch] + SOFTNESS * (line * 0.618034 % 1 - 0.5)

    def is_seen(self, place):
        """Nothing stands between it and the eye."""
        start = place + 0.004 * self.size * (TO_EYE + self.normals[self.points.FindClosestPoint(place)])
        unused = [mutable(0.0), [0.0, 0, 0], [0.0, 0, 0], mutable(0), mutable(0)]
        return not self.cells.IntersectWithLine(start, start + 2 * self.size * TO_EYE, 1e-6, *unused)

    def outline(self):
        """Where the surface turns away from the eye."""
        facing = numpy_to_vtk(self.normals @ TO_EYE, deep=True)
        facing.SetName("Facing")
        self.surface.GetPointData().SetScalars(facing)
        contour, joined = vtkContourFilter(), vtkStripper()
        contour.SetInputData(self.surface)
        contour.SetValue(0, 0)
        joined.SetInputConnection(contour.GetOutputPort())
        joined.Update()
        return joined.GetOutput()


def strokes(lines, is_drawn, shortest):
    """The parts of lines whose points are all drawn but for short gaps, as arrays of points, without crumbs."""
    places = vtk_to_numpy(lines.GetPoints().GetData()).astype(float)
    for line in range(lines.GetNumberOfCells()):
        ids = lines.GetCell(line).GetPointIds()
        points = places[[ids.GetId(k) for k in range(ids.GetNumberOfIds())]]
        drawn = np.array([is_drawn(line, place) for place in points])
        ways = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(points, axis=0), axis=1))])
        for gap in np.split(np.arange(len(points)), np.flatnonzero(np.diff(drawn)) + 1):
            if 0 < gap[0] and gap[-1] < len(points) - 1 and ways[gap[-1]] - ways[gap[0]] < shortest / 5:
                drawn[gap] = True
        for part in np.split(np.arange(len(points)), np.flatnonzero(np.diff(drawn)) + 1):
            if drawn[part[0]] and ways[part[-1]] - ways[part[0]] > shortest:
                yield points[part]


def with_ends(parts, length):
    """What is left of lines without their ends, and these."""
    bodies, ends = [], []
    for part in parts:
        ways = np.concatenate([[0], np.cumsum(np.linalg.norm(np.diff(part, axis=0), axis=1))])
        first, last = np.searchsorted(ways, min(length, ways[-1] / 3)), np.searchsorted(ways, ways[-1] - min(length, ways[-1] / 3))
        ends += [part[:first + 1], part[last:]]
        bodies.append(part[first:last + 1])
    return [line for line in bodies if len(line) > 1], [line for line in ends if len(line) > 1]


def on_paper(parts):
    points, cells, data = vtkPoints(), vtkCellArray(), vtkPolyData()
    for part in parts:
        cells.InsertNextCell(len(part))
        for place in part:
            cells.InsertCellPoint(points.InsertNextPoint(place @ RIGHT, place @ np.cross(TO_EYE, RIGHT), 0))
    data.SetPoints(points)
    data.SetLines(cells)
    return data


def write_drawing(name, lines_of_width):
    """Lines with round ends, as SVG of the size of their surface."""
    bounds = np.array([data.GetBounds() for data in lines_of_width.values()])
    left, right, below, above = bounds[:, 0].min(), bounds[:, 1].max(), bounds[:, 2].min(), bounds[:, 3].max()
    with open(name, "w") as file:
        file.write(f'<svg xmlns="http://www.w3.org/2000/svg" viewBox="{left - 0.1:.3f} {-above - 0.1:.3f} {right - left + 0.2:.3f} '
                   f'{above - below + 0.2:.3f}">\n')
        for width, data in lines_of_width.items():
            file.write(f'<g fill="none" stroke="#1a1a24" stroke-width="{width}" stroke-linecap="round">\n')
            for line in range(data.GetNumberOfCells()):
                points = data.GetCell(line).GetPoints()
                places = (points.GetPoint(k) for k in range(points.GetNumberOfPoints()))
                file.write('<polyline points="' + " ".join(f"{x:.4f},{-y:.4f}" for x, y, _ in places) + '"/>\n')
            file.write("</g>\n")
        file.write("</svg>\n")


def main():
    field = HarmonicFieldSolver(Input=source(duck()), NumberOfDirections=4, CurvatureWeight=0.3)
    lines = servermanager.Fetch(FieldLines(Input=field, SeparatingDistance=0.009, Lift=0))
    paper = Paper(servermanager.Fetch(field))
    branches = vtk_to_numpy(lines.GetCellData().GetArray("Branch"))
    parts = strokes(lines, lambda line, at: paper.is_dark(at, line, branches[line]) and paper.is_seen(at), 0.08 * paper.size)
    hatching, ends = map(on_paper, with_ends(parts, 0.03 * paper.size))
    outline = on_paper(strokes(paper.outline(), lambda line, at: paper.is_seen(at), 0.1 * paper.size))
    view = view_from([0, 0, 1], [1200, 1000])
    for data, width in ((ends, 1), (hatching, 2), (outline, 4)):
        show(source(data), view, [0.1, 0.1, 0.14], Representation="Wireframe", LineWidth=width, Ambient=1, Diffuse=0)
    save(view, "hatching", 1.25)
    write_drawing("hatching.svg", {0.0015: ends, 0.003: hatching, 0.006: outline})
    return ends, hatching, outline, "hatching.svg"


if __name__ == "__main__":
    main()
