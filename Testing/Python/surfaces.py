"""Surfaces with prescribed directions, for the tests of this folder."""

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData


def surface(points, triangles):
    """vtkPolyData of #V x 3 points and #F x 3 triangles."""
    data = vtkPolyData()
    data.SetPoints(vtkPoints())
    data.GetPoints().SetData(numpy_to_vtk(np.asarray(points, float), deep=True))
    cells = vtkCellArray()
    for triangle in triangles:
        cells.InsertNextCell(3, [int(i) for i in triangle])
    data.SetPolys(cells)
    return data


def values_of_points(data):
    return np.array([data.GetPoint(i) for i in range(data.GetNumberOfPoints())])


def corners(data):
    return np.array([[data.GetCell(c).GetPointId(k) for k in range(3)]
                     for c in range(data.GetNumberOfCells())])


def grid(n, place, diagonals=0):
    """n x n squares on [-1, 1]^2, mapped; diagonals rise (0), fall (1) or run at random (2)."""
    x, y = (a.ravel() for a in np.meshgrid(np.linspace(-1, 1, n + 1), np.linspace(-1, 1, n + 1), indexing="ij"))
    i, j = (a.ravel() for a in np.meshgrid(np.arange(n), np.arange(n), indexing="ij"))
    a, b, c, d = (k * (n + 1) + m for k, m in ((i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)))
    rises = (np.ones(n * n, bool), np.zeros(n * n, bool), np.random.default_rng(3).random(n * n) < 0.5)[diagonals]
    first = np.where(rises[:, None], np.stack([a, b, c], 1), np.stack([a, b, d], 1))
    second = np.where(rises[:, None], np.stack([a, c, d], 1), np.stack([b, c, d], 1))
    return surface(np.stack(place(x, y), 1), np.concatenate([first, second]))


def disc(x, y):
    """A square as a disk; see grid."""
    return x * np.sqrt(1 - y * y / 2), y * np.sqrt(1 - x * x / 2), 0 * x


def torus(around, across, major=1.0, minor=0.4):
    """A torus around the z-axis, 2 around across faces."""
    u, v = np.meshgrid(np.arange(around), np.arange(across), indexing="ij")
    u, v = u.ravel(), v.ravel()
    a, b = 2 * np.pi * u / around, 2 * np.pi * v / across
    radius = major + minor * np.cos(b)
    points = np.stack([radius * np.cos(a), radius * np.sin(a), minor * np.sin(b)], axis=1)

    def index(i, j):
        return (i % around) * across + j % across

    p, q, r, s = index(u, v), index(u + 1, v), index(u + 1, v + 1), index(u, v + 1)
    return surface(points, np.concatenate([np.stack([p, q, r], 1), np.stack([p, r, s], 1)]))


# An L, seen along y: its corners, counter-clockwise; the third has an angle of 270 degrees inside.
L_CORNERS = [(0, 0), (2, 0), (2, 1), (1, 1), (1, 2), (0, 2)]
L_TRIANGLES = [(0, 1, 3), (1, 2, 3), (0, 3, 5), (3, 4, 5)]



def prism():
    """The L from y = 0 to y = 1, closed: 20 triangles that look outside."""
    n = len(L_CORNERS)
    points = [(x, y, z) for y in (0, 1) for x, z in L_CORNERS]
    front = L_TRIANGLES
    back = [(n + c, n + b, n + a) for a, b, c in L_TRIANGLES]
    sides = [triangle for i in range(n) for j in [(i + 1) % n]
             for triangle in ((i, n + i, n + j), (i, n + j, j))]
    return surface(points, front + back + sides)


def add(attributes, name, values):
    """Adds a copy of an array to cell, point or field data."""
    array = numpy_to_vtk(np.asarray(values, float), deep=True)
    array.SetName(name)
    attributes.AddArray(array)
    return array


def prescribe(data, directions, name="Given"):
    """Adds a cell array of vectors that is zero but for {cell: direction}."""
    vectors = np.zeros((data.GetNumberOfCells(), 3))
    for cell, direction in directions.items():
        vectors[cell] = direction
    add(data.GetCellData(), name, vectors)
    return data


def values(attributes, name):
    """An array as numpy array; a KeyError where there is none."""
    array = attributes.GetArray(name)
    if array is None:
        raise KeyError(name)
    return vtk_to_numpy(array)
