"""One surface as files lay it out: other orders, sides, copies of points, number types, places and classes."""

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData, vtkUnstructuredGrid


def turn(angle, axis):
    """The rotation by an angle about an axis, as a matrix."""
    x, y, z = np.asarray(axis, float) / np.linalg.norm(axis)
    cross = np.array([[0, -z, y], [z, 0, -x], [-y, x, 0]])
    return np.eye(3) + np.sin(angle) * cross + (1 - np.cos(angle)) * cross @ cross


class Layout:
    """A dataset of the polygons of a surface. Arrays are given and got back in the numbers of the surface, vectors in its axes."""

    def __init__(self, points, polygons, scale=1.0, rotation=np.eye(3), offset=(0, 0, 0), turned=0.0, soup=False, order=False,
                 single=False, grid=False, lines=False, loose=False, small=False):
        random = np.random.default_rng(5)
        cells = [list(map(int, polygon)) for polygon in polygons]
        self.cells, self.points = np.arange(len(cells)), np.arange(len(points))
        if order:
            self.cells, self.points = random.permutation(len(cells)), random.permutation(len(points))
            where = np.argsort(self.points)
            cells = [[int(where[i]) for i in np.roll(cells[k], random.integers(3))] for k in self.cells]
        cells = [cell[::-1] if random.random() < turned else cell for cell in cells]
        if soup:
            self.points = np.concatenate([self.points[cell] for cell in cells])
            ends = np.cumsum([0] + [len(cell) for cell in cells])
            cells = [list(range(first, last)) for first, last in zip(ends, ends[1:])]
        self.scale, self.rotation, self.small = scale, np.asarray(rotation), small
        at = (scale * np.asarray(points, float) @ self.rotation.T + offset)[self.points]
        self.ahead_of_points, self.ahead_of_cells = int(loose), 2 * int(lines)
        if loose:  # a point that no cell has
            at = np.concatenate([at[:1] + 100 * np.ptp(at, axis=0).max(), at])
            cells = [[i + 1 for i in cell] for cell in cells]
        place = vtkPoints()
        place.SetData(numpy_to_vtk(np.ascontiguousarray(at, np.float32 if single else float), deep=True))
        self.data = vtkUnstructuredGrid() if grid else vtkPolyData()
        self.data.SetPoints(place)
        if grid:
            for cell in cells:
                self.data.InsertNextCell({3: 5, 4: 9}.get(len(cell), 7), len(cell), cell)
            return
        faces, wires = vtkCellArray(), vtkCellArray()
        for cell in cells:
            faces.InsertNextCell(len(cell), cell)
        for cell in cells[:2] if lines else []:
            wires.InsertNextCell(2, cell[:2])
        self.data.SetPolys(faces)
        self.data.SetLines(wires)

    def add(self, name, numbers, on_points, are_vectors=True):
        numbers = numbers @ self.rotation.T if are_vectors else numbers
        ahead = self.ahead_of_points if on_points else self.ahead_of_cells
        numbers = numbers[self.points if on_points else self.cells]
        numbers = np.concatenate([np.zeros((ahead,) + numbers.shape[1:]), numbers])
        array = numpy_to_vtk(np.ascontiguousarray(numbers, np.float32 if self.small else float), deep=True)
        array.SetName(name)
        (self.data.GetPointData() if on_points else self.data.GetCellData()).AddArray(array)

    def get(self, output, name, on_points):
        array = (output.GetPointData() if on_points else output.GetCellData()).GetArray(name)
        numbers = vtk_to_numpy(array)[self.ahead_of_points if on_points else self.ahead_of_cells:].astype(float)
        result = np.zeros((1 + (self.points if on_points else self.cells).max(),) + numbers.shape[1:])
        result[self.points if on_points else self.cells] = numbers
        return result @ self.rotation if numbers.ndim == 2 and numbers.shape[1] == 3 else result


LAYOUTS = {
    "any order": dict(order=True),
    "clockwise": dict(turned=1.0),
    "some clockwise": dict(turned=0.3),
    "points of each cell": dict(soup=True),
    "single precision": dict(single=True),
    "points of each cell in single precision": dict(soup=True, single=True),
    "arrays of single precision": dict(small=True),
    "unstructured grid": dict(grid=True),
    "lines before cells": dict(lines=True),
    "a loose point": dict(loose=True),
    "small": dict(scale=1e-6),
    "large": dict(scale=1e6),
    "far": dict(offset=(3e5, -4e5, 0)),
    "far, points of each cell": dict(offset=(3e5, -4e5, 0), soup=True),
    "turned in its plane": dict(rotation=turn(0.7, (0, 0, 1))),
    "turned in space": dict(rotation=turn(0.7, (1, 2, 3))),
}
