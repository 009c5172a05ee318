"""What happens to a surface on its way in:  pvbatch way_in.py

Left, a plate of quads with a stiffener: three sheets meet at every edge below it. The plate goes on under the stiffener, which
ends there, so that lines run through the plate as if nothing stood on it. Right, a grid of latitudes and longitudes, whose first
and last meridian are other points at the same places: the seam (red) is closed, and lines cross it.
"""

import numpy as np
from scene import *
from surfaces import source
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData, vtkStructuredGrid


def points_of(positions):
    points = vtkPoints()
    points.SetData(numpy_to_vtk(np.array(positions, float), deep=True))
    return points


def stiffened_plate(size=24, height=6):
    """Squares of side 1, and a wall on the middle line."""
    numbers, positions, cells = {}, [], vtkCellArray()

    def number(*place):
        if place not in numbers:
            numbers[place] = len(positions)
            positions.append(place)
        return numbers[place]

    def add(*corners):
        cells.InsertNextCell(4, [number(*corner) for corner in corners])

    for i in range(size):
        for j in range(size):
            add((i, j, 0), (i + 1, j, 0), (i + 1, j + 1, 0), (i, j + 1, 0))
    middle = size // 2
    for j in range(size):
        for k in range(height):
            add((middle, j, k), (middle, j + 1, k), (middle, j + 1, k + 1), (middle, j, k + 1))
    data = vtkPolyData()
    data.SetPoints(points_of(positions))
    data.SetPolys(cells)
    return data


def earth(around=72, along=37):
    """A sphere of radius 12 beside the plate."""
    data = vtkStructuredGrid()
    data.SetDimensions(around + 1, along, 1)
    longitude, latitude = np.meshgrid(2 * np.pi * np.arange(around + 1) / around, np.pi * (np.arange(along) / (along - 1) - 0.5))
    longitude[:, -1] = 0
    x, y = np.cos(longitude) * np.cos(latitude), np.sin(longitude) * np.cos(latitude)
    data.SetPoints(points_of(12 * np.stack([x, y, np.sin(latitude)], -1).reshape(-1, 3) + [38, 12, 3]))
    return data


def seam(grid):
    """Its first meridian as a line."""
    sizes = [0, 0, 0]
    grid.GetDimensions(sizes)
    columns, rows, _ = sizes
    lines, data = vtkCellArray(), vtkPolyData()
    lines.InsertNextCell(rows, [row * columns for row in range(rows)])
    data.SetPoints(grid.GetPoints())
    data.SetLines(lines)
    return data


def main():
    view = view_from([0.35, -1, 0.75], [1100, 480], up=(0, 0, 1))
    plate = HarmonicFieldSolver(Input=source(stiffened_plate()), SharpEdgesWeight=0)
    show(plate, view, [0.9, 0.87, 0.81], Representation="Surface With Edges", EdgeColor=[0.78, 0.75, 0.7], Ambient=0.1, Diffuse=0.9)
    show(lines_along(plate, 0.03, 0.0016), view, BLUE)
    globe = earth()
    sphere = HarmonicFieldSolver(Input=source(globe))
    show(sphere, view, IVORY, Representation="Surface With Edges", EdgeColor=[0.8, 0.78, 0.74], Ambient=0.15)
    show(lines_along(sphere, 0.03, 0.0016, shortest=12), view, BLUE)
    show(Tube(Input=source(seam(globe)), Radius=0.15), view, RED)
    save(view, "way_in", None)
    return plate, sphere


if __name__ == "__main__":
    main()
