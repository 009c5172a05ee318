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

    def __init__(self, points, polygons, closed=False, scale=1.0, rotation=np.eye(3), offset=(0, 0, 0), turned=0.0, soup=False, order=False,
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
        self.scale, self.rotation, self.offset, self.small = scale, np.asarray(rotation), np.asarray(offset), small
        at = (scale * np.asarray(points, float) @ self.rotation.T + self.offset)[self.points]
        # Whether what is counter-clockwise seen from outside, or from +z of a surface in the plane z = 0, is so from the positive side of the
        # layout: the outside, or that of +z where z is constant, or else that from which most cells are counter-clockwise.
        mirrored, up = np.linalg.det(self.rotation), self.rotation[2, 2]
        self.side = mirrored if closed else mirrored * up if abs(abs(up) - 1) < 1e-9 else 1 if turned < 0.5 else -1
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

    def own(self, places):
        """Places of a dataset, in the coordinates of the surface."""
        return (places - self.offset) @ self.rotation / self.scale

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
    "turned in space, clockwise": dict(rotation=turn(0.7, (1, 2, 3)), turned=1.0),
    "turned over": dict(rotation=np.diag([1, -1, -1])),
    "mirrored": dict(rotation=np.diag([-1, 1, 1])),
    "mirrored, clockwise": dict(rotation=np.diag([-1, 1, 1]), turned=1.0),
}


def centres(points, cells):
    """The means of corners."""
    return np.array([points[list(cell)].mean(0) for cell in cells])


def mixed_cells(columns, rows):
    """A rectangle with uneven points, of quadrilaterals and triangles."""
    random = np.random.default_rng(11)
    at = np.array([[i, j, 0.0] for j in range(rows + 1) for i in range(columns + 1)])
    inner = (at[:, 0] > 0) & (at[:, 0] < columns) & (at[:, 1] > 0) & (at[:, 1] < rows)
    at[inner, :2] += random.uniform(-0.2, 0.2, (np.count_nonzero(inner), 2))
    cells = []
    for j in range(rows):
        for i in range(columns):
            a = j * (columns + 1) + i
            b, c, d = a + 1, a + columns + 2, a + columns + 1
            cells += [(a, b, c, d)] if i % 3 else [(a, b, c), (a, c, d)]
    return at / columns, cells


def mixed_torus(around, across):
    """A torus with uneven points, of quadrilaterals and triangles."""
    random = np.random.default_rng(12)
    u, v = (np.stack(np.meshgrid(np.arange(around), np.arange(across), indexing="ij"), -1).reshape(-1, 2)
            + random.uniform(-0.2, 0.2, (around * across, 2))).T
    a, b = 2 * np.pi * u / around, 2 * np.pi * v / across
    radius = 0.5 + 0.2 * np.cos(b)
    cells = []
    for i in range(around):
        for j in range(across):
            p, q, r, s = (k % around * across + m % across for k, m in ((i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)))
            cells += [(p, q, r, s)] if i % 3 else [(p, q, r), (p, r, s)]
    return np.stack([radius * np.cos(a), radius * np.sin(a), 0.2 * np.sin(b)], 1), cells


POINTS, CELLS = mixed_cells(12, 9)
CENTRES = centres(POINTS, CELLS)


def directions(at):
    angle = 0.4 * np.sin(3 * at[:, 0]) + at[:, 1]
    return np.stack([np.cos(angle), np.sin(angle), 0 * angle], 1)
