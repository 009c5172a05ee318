"""The surfaces of the gallery, all made here, as vtkPolyData; and how they and other data become sources of ParaView."""

import numpy as np
from paraview.simple import TrivialProducer
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkImageData, vtkPolyData
from vtkmodules.vtkFiltersCore import vtkDelaunay2D, vtkFlyingEdges3D


def polydata(points, triangles, **arrays):
    """Points, triangles, and arrays with a row per triangle."""
    data, cells = vtkPolyData(), vtkCellArray()
    data.SetPoints(vtkPoints())
    data.GetPoints().SetData(numpy_to_vtk(np.ascontiguousarray(points, float), deep=True))
    cells.SetData(3, numpy_to_vtk(np.ascontiguousarray(triangles, "i8").ravel(), deep=True))
    data.SetPolys(cells)
    for name, values in arrays.items():
        array = numpy_to_vtk(np.ascontiguousarray(values, float), deep=True)
        array.SetName(name)
        data.GetCellData().AddArray(array)
    return data


def source(data):
    """The data as a source of ParaView."""
    producer = TrivialProducer()
    producer.GetClientSideObject().SetOutput(data)
    return producer


def triangles_of(data):
    """Points and the corners of triangles, as arrays with three columns."""
    return vtk_to_numpy(data.GetPoints().GetData()), vtk_to_numpy(data.GetPolys().GetConnectivityArray()).reshape(-1, 3)


def implicit(function, low, high, spacing, rounds=8):
    """Where a function of (x, y, z) is zero, oriented to where it is positive, in triangles of even size."""
    axes = [np.arange(a, b + spacing, spacing) for a, b in zip(low, high)]
    image = vtkImageData()
    image.SetDimensions(*map(len, axes))
    image.SetOrigin(low)
    image.SetSpacing(3 * [spacing])
    values = function(*np.meshgrid(*axes, indexing="ij"))
    image.GetPointData().SetScalars(numpy_to_vtk(values.ravel(order="F"), deep=True))
    contour = vtkFlyingEdges3D()
    contour.SetInputData(image)
    contour.SetValue(0, 0)
    contour.Update()
    points, triangles = triangles_of(contour.GetOutput())
    points = points.astype(float)
    edges = np.concatenate([triangles[:, [i, j]] for i in range(3) for j in range(3) if i != j])
    degrees = np.bincount(edges[:, 0])[:, None]
    for _ in range(rounds):  # each point to the mean of its neighbours, and back to the surface
        points = np.stack([np.bincount(edges[:, 0], points[edges[:, 1], k]) for k in range(3)], 1) / degrees
        for _ in range(2):
            value = function(*points.T)
            shifts = 1e-5 * np.eye(3)
            slope = np.stack([(function(*(points + h).T) - function(*(points - h).T)) / 2e-5 for h in shifts], 1)
            points -= (value / (slope ** 2).sum(1))[:, None] * slope
    a, b, c = np.moveaxis(points[triangles], 1, 0)
    outwards = (np.cross(b - a, c - a) * slope[triangles[:, 0]]).sum() > 0
    return polydata(points, triangles if outwards else triangles[:, ::-1])


def planar(curves, distance, spacing):
    """Points and triangles of the part of the plane where a distance is negative; its boundary and other curves are edges."""
    curves = np.concatenate(curves)
    low, high = curves.min(0), curves.max(0)
    x, y = np.meshgrid(np.arange(low[0], high[0], spacing), np.arange(low[1], high[1], 0.866 * spacing), indexing="ij")
    x = x + 0.5 * spacing * (np.arange(x.shape[1]) % 2)
    grid = np.stack([x.ravel(), y.ravel()], 1)
    near = np.array([((curves - p) ** 2).sum(1).min() for p in grid])
    points = np.concatenate([curves, grid[(near > (0.7 * spacing) ** 2) & (distance(*grid.T) < 0)]])
    points = np.append(points, np.zeros((len(points), 1)), 1)
    delaunay = vtkDelaunay2D()
    delaunay.SetInputData(polydata(points, np.empty((0, 3))))
    delaunay.Update()
    _, triangles = triangles_of(delaunay.GetOutput())
    triangles = triangles[distance(*points[triangles].mean(1)[:, :2].T) < 0]
    a, b, c = np.moveaxis(points[triangles], 1, 0)
    below = np.cross(b - a, c - a)[:, 2] < 0
    triangles[below] = triangles[below, ::-1]
    return points, triangles


def circle(x, y, radius, spacing):
    angles = np.linspace(0, 2 * np.pi, int(2 * np.pi * radius / spacing), endpoint=False)
    return np.stack([x + radius * np.cos(angles), y + radius * np.sin(angles)], 1)


def along(corners, spacing):
    """Points on a closed polygon in the plane, from its corners as complex numbers."""
    line = np.concatenate([np.linspace(a, b, max(1, round(abs(b - a) / spacing)), endpoint=False)
                           for a, b in zip(corners, np.roll(corners, -1))])
    return np.stack([line.real, line.imag], 1)


def extruded(points, triangles, height, spacing):
    """The solid over a part of the plane."""
    sides = np.concatenate([triangles[:, [k, (k + 1) % 3]] for k in range(3)])
    there = set(map(tuple, sides))
    a, b = np.array([side for side in sides if tuple(side[::-1]) not in there]).T
    levels = np.linspace(0, height, 1 + max(1, round(height / spacing)))
    up = len(points)  # from a point to that above it
    wall = [np.stack(three, 1) + k * up for k in range(len(levels) - 1) for three in ((a, b, b + up), (a, b + up, a + up))]
    solid = np.concatenate([triangles[:, ::-1], *wall, triangles + up * (len(levels) - 1)])
    used, corners = np.unique(solid, return_inverse=True)
    places = np.concatenate([points + (0, 0, level) for level in levels])[used]
    return polydata(places, corners.reshape(-1, 3))


def ellipsoid(centre, radii, pitch=0):
    """A distance, nearly; turned about z by pitch degrees."""
    c, s = np.cos(np.radians(pitch)), np.sin(np.radians(pitch))

    def distance(x, y, z):
        x, y, z = x - centre[0], y - centre[1], z - centre[2]
        x, y = c * x + s * y, c * y - s * x
        one = np.sqrt((x / radii[0]) ** 2 + (y / radii[1]) ** 2 + (z / radii[2]) ** 2)
        two = np.sqrt((x / radii[0] ** 2) ** 2 + (y / radii[1] ** 2) ** 2 + (z / radii[2] ** 2) ** 2)
        return one * (one - 1) / np.maximum(two, 1e-9)

    return distance


def blended(parts, blends, x, y, z):
    """The distance to parts that flow into each other."""
    whole = parts[0](x, y, z)
    for part, blend in zip(parts[1:], blends[1:]):
        other = part(x, y, z)
        share = np.clip(0.5 + 0.5 * (other - whole) / blend, 0, 1)
        whole = other + (whole - other) * share - blend * share * (1 - share)
    return whole


def duck(spacing=0.04):
    """A bath toy, 2.5 long: it looks along x, y is up."""
    parts = [ellipsoid((0, 0, 0), (1.05, 0.62, 0.72)), ellipsoid((0.7, 0.95, 0), (0.47, 0.47, 0.45)),
             ellipsoid((1.22, 0.86, 0), (0.26, 0.07, 0.2), -8), ellipsoid((-1.02, 0.38, 0), (0.4, 0.16, 0.3), -40),
             ellipsoid((-0.15, 0.14, 0.62), (0.6, 0.3, 0.2), -12), ellipsoid((-0.15, 0.14, -0.62), (0.6, 0.3, 0.2), -12)]
    blends = [0, 0.22, 0.06, 0.25, 0.08, 0.08]
    return implicit(lambda x, y, z: blended(parts, blends, x, y, z), (-1.6, -0.8, -1), (1.7, 1.6, 1), spacing)


def heart(spacing=0.045):
    """Two ventricles with their point below, and two atria, 2.4 high; y is up."""
    parts = [ellipsoid((0, -0.1, 0), (0.78, 1.12, 0.7), 12), ellipsoid((0.42, 0.78, 0.1), (0.46, 0.42, 0.42)),
             ellipsoid((-0.46, 0.72, -0.1), (0.5, 0.38, 0.44), 20), ellipsoid((0.02, 1.12, 0.12), (0.2, 0.42, 0.2), -15)]
    return implicit(lambda x, y, z: blended(parts, [0, 0.25, 0.25, 0.15], x, y, z), (-1.5, -1.6, -1.3), (1.5, 1.9, 1.3), spacing)


def tangle(spacing=0.07):
    """A cube of struts with five handles."""
    return implicit(lambda x, y, z: x ** 4 + y ** 4 + z ** 4 - 5 * (x * x + y * y + z * z) + 11.8, 3 * [-2.6], 3 * [2.6], spacing)


def ball(radii=(1, 1, 1), spacing=0.05):
    return implicit(ellipsoid((0, 0, 0), radii), [-1.2 * r for r in radii], [1.2 * r for r in radii], spacing)


def cup(radius, depth, spacing=0.03):
    """An ellipsoid about the z-axis with its point below, open above: the wall of a ventricle."""
    spacing /= radius
    points, triangles = planar([circle(0, 0, 1, spacing)], lambda x, y: x * x + y * y - 1, spacing)
    r, angle = np.hypot(*points[:, :2].T), np.arctan2(*points[:, 1::-1].T)
    polar = np.radians(110) * r
    points = [radius * np.sin(polar) * np.cos(angle), radius * np.sin(polar) * np.sin(angle), -depth * np.cos(polar)]
    return polydata(np.stack(points, 1), triangles[:, ::-1])


def bracket(spacing=0.04):
    """Sheet metal with four holes, folded along two lines, one of them askew."""
    holes = [(0.35, 0.35, 0.28), (-0.4, -0.3, 0.2), (1.75, -0.05, 0.3), (-1.65, 0, 0.34)]
    corner, half = 0.5, np.array([2.3, 1])

    def distance(x, y):
        x1, y1 = np.maximum(np.abs(x) - half[0] + corner, 0), np.maximum(np.abs(y) - half[1] + corner, 0)
        outline = np.where((x1 > 0) & (y1 > 0), np.hypot(x1, y1), np.maximum(x1, y1)) - corner
        return np.max([outline] + [r - np.hypot(x - a, y - b) for a, b, r in holes], axis=0)

    x, y = half - corner
    arc = corner * np.exp(0.5j * np.pi * np.linspace(0, 1, int(0.5 * np.pi * corner / spacing)))
    corners = np.concatenate([x + 1j * y + arc, -x + 1j * y + 1j * arc])
    outline = along(np.concatenate([corners, -corners]), spacing)
    across = np.linspace(-1, 1, int(2 / spacing))[:, None]
    folds = across * (0.25, 1) + (1, 0), across * (0, 1) - (1, 0)
    points, triangles = planar([outline, *folds, *(circle(*hole, spacing) for hole in holes)],
                               distance, spacing)
    for fold, origin, up in (((0.25, 1, 0), (1, 0, 0), -1), ((0, -1, 0), (-1, 0, 0), 1)):
        across = np.cross(fold, (0, 0, 1)) / np.linalg.norm(fold)
        beyond = (points - origin) @ across
        points = points - np.maximum(beyond, 0)[:, None] * (across - (0, 0, up))
    return polydata(points, triangles)


def lever(spacing=0.05):
    """A solid with two round ends, one of radius 1 with a hole of six sides, the other one smaller with a round hole; z is up."""
    length, small, slope = 2.4, 0.55, (1 - 0.55) / 2.4
    across = np.sqrt(1 - slope ** 2)

    def distance(x, y):
        straight = np.max([slope * x + across * np.abs(y) - 1, slope - x, x - length - small * slope], axis=0)
        solid = np.min([np.hypot(x, y) - 1, np.hypot(x - length, y) - small, straight], axis=0)
        six = np.max([np.abs(x * np.cos(t) + y * np.sin(t)) for t in np.pi / 6 + np.pi / 3 * np.arange(3)], axis=0)
        return np.max([solid, 0.5 - six, 0.28 - np.hypot(x - length, y)], axis=0)

    turn = np.arccos(slope)
    ends = [np.exp(1j * np.linspace(turn, 2 * np.pi - turn, int((2 * np.pi - 2 * turn) / spacing))),
            length + small * np.exp(1j * np.linspace(-turn, turn, int(2 * turn * small / spacing)))]
    hexagon = 0.5 / np.cos(np.pi / 6) * np.exp(1j * np.pi / 3 * np.arange(6))
    curves = [along(np.concatenate(ends), spacing), along(hexagon, spacing), circle(length, 0, 0.28, spacing)]
    return extruded(*planar(curves, distance, spacing), 0.6, spacing)


def disk(spacing=0.04):
    """Of radius 1, in a plane."""
    return polydata(*planar([circle(0, 0, 1, spacing)], lambda x, y: x * x + y * y - 1, spacing))


def ocean(spacing=0.035):
    """A sphere without five continents; coasts are smooth lines of points."""
    centres = np.array([[1, 0.2, 0.5], [0.75, -0.5, -0.5], [0.1, -1, 0.35], [-0.4, 0.8, -0.1], [-0.7, -0.4, -0.6]])
    centres = centres / np.linalg.norm(centres, axis=1)[:, None]
    radii = np.array([0.45, 0.28, 0.36, 0.5, 0.42])

    def land(points):
        """Positive on continents."""
        near = np.exp(10 * (points @ centres.T - np.cos(radii)))
        return near.sum(1) - 1 + 0.3 * np.sin(7 * points[:, 0] + 1) * np.cos(6 * points[:, 1] - 5 * points[:, 2])

    points, triangles = triangles_of(implicit(lambda x, y, z: x * x + y * y + z * z - 1, 3 * [-1.1], 3 * [1.1], spacing))
    points = points / np.linalg.norm(points, axis=1)[:, None]
    used, corners = np.unique(triangles[land(points[triangles].mean(1)) < 0], return_inverse=True)
    points, triangles = points[used], corners.reshape(-1, 3)
    edges = np.concatenate([triangles[:, [i, j]] for i in range(3) for j in range(3) if i != j])
    sides, numbers = np.unique(np.sort(edges, axis=1), axis=0, return_counts=True)
    rim = sides[numbers == 2]  # each side of a triangle is there in both directions
    coast, along = np.unique(rim), np.concatenate([rim, rim[:, ::-1]])
    degrees = np.bincount(edges[:, 0])[:, None]
    for _ in range(40):  # points to the mean of their neighbours; those of coasts along these, and to where land begins
        means = np.stack([np.bincount(edges[:, 0], points[edges[:, 1], k]) for k in range(3)], 1) / degrees
        means[coast] = np.stack([np.bincount(along[:, 0], points[along[:, 1], k], len(points)) for k in range(3)], 1)[coast] / 2
        points = 0.5 * (points + means)
        value, shifts = land(points[coast]), 1e-5 * np.eye(3)
        slope = np.stack([(land(points[coast] + h) - land(points[coast] - h)) / 2e-5 for h in shifts], 1)
        points[coast] -= 0.5 * (value / (slope ** 2).sum(1))[:, None] * slope
        points /= np.linalg.norm(points, axis=1)[:, None]
    return polydata(points, triangles)
