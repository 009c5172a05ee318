"""Surfaces as people have them: quads, grids, seams, soups, flips, walls that meet. Each is made here, and what must be true of it.

make() gives {name: (dataset, expected)}. expected has the Euler characteristic of the surface as a person sees it (points joined,
cells oriented), its loops of boundary, and the number of cells that have a direction; None where a person may see either.
"""

from itertools import permutations, product

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonComputationalGeometry import vtkParametricEllipsoid, vtkParametricTorus
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import (VTK_BEZIER_TRIANGLE, VTK_LAGRANGE_QUADRILATERAL, VTK_PIXEL, VTK_POLYGON, VTK_QUAD,
                                           VTK_QUADRATIC_QUAD, VTK_QUADRATIC_TRIANGLE, VTK_TETRA, VTK_TRIANGLE, VTK_WEDGE, vtkCellArray,
                                           vtkImageData, vtkPolyData, vtkRectilinearGrid, vtkStructuredGrid, vtkUnstructuredGrid)
from vtkmodules.vtkFiltersCore import vtkAppendPolyData, vtkDelaunay3D, vtkPolyDataNormals, vtkTubeFilter
from vtkmodules.vtkFiltersModeling import vtkLinearExtrusionFilter
from vtkmodules.vtkFiltersSources import (vtkConeSource, vtkCubeSource, vtkCylinderSource, vtkLineSource, vtkParametricFunctionSource,
                                          vtkPlaneSource, vtkRegularPolygonSource, vtkSphereSource, vtkSuperquadricSource)


def out(algorithm, data=None):
    if data is not None:
        algorithm.SetInputData(data)
    algorithm.Update()
    return algorithm.GetOutput()


def points_of(positions):
    points = vtkPoints()
    points.SetData(numpy_to_vtk(np.array(positions, float).reshape(-1, 3), deep=True))
    return points


def polygons(positions, cells):
    """vtkPolyData of polygons."""
    array = vtkCellArray()
    for cell in cells:
        array.InsertNextCell(len(cell), [int(i) for i in cell])
    data = vtkPolyData()
    data.SetPoints(points_of(positions))
    data.SetPolys(array)
    return data


def positions_of(surface):
    return [surface.GetPoint(i) for i in range(surface.GetNumberOfPoints())]


def cells_of(surface):
    """The points of each cell."""
    result = []
    for i in range(surface.GetNumberOfCells()):
        ids = surface.GetCell(i).GetPointIds()
        result.append([ids.GetId(k) for k in range(ids.GetNumberOfIds())])
    return result


def grid_of(surface):
    """The polygons of a surface as an unstructured grid, as finite elements have them."""
    grid = vtkUnstructuredGrid()
    grid.SetPoints(surface.GetPoints())
    for cell in cells_of(surface):
        grid.InsertNextCell({3: VTK_TRIANGLE, 4: VTK_QUAD}.get(len(cell), VTK_POLYGON), len(cell), cell)
    return grid


def sphere(theta=24, phi=16):
    source = vtkSphereSource()
    source.SetThetaResolution(theta)
    source.SetPhiResolution(phi)
    return out(source)


def plane(columns=10, rows=10):
    source = vtkPlaneSource()
    source.SetResolution(columns, rows)
    return source


def latitude_longitude(around=48, along=25, noise=0.0):
    """A structured grid over the whole sphere: a seam of equal points, and poles of degenerate quads."""
    rng = np.random.default_rng(17)
    positions = []
    for j in range(along):
        for i in range(around + 1):
            u, v = 2 * np.pi * (i % around) / around, np.pi * (j / (along - 1) - 0.5)
            place = np.array([np.cos(u) * np.cos(v), np.sin(u) * np.cos(v), np.sin(v)])
            positions.append(place + noise * rng.normal(size=3) * (i == around))
    grid = vtkStructuredGrid()
    grid.SetDimensions(around + 1, along, 1)
    grid.SetPoints(points_of(positions))
    return grid


def image():
    """A plane of 12 x 7 pixels."""
    data = vtkImageData()
    data.SetDimensions(13, 1, 8)
    return data


def rectilinear():
    """A plane of rectangles of many sizes."""
    grid = vtkRectilinearGrid()
    x, y = np.cumsum(np.arange(1, 8)) / 7.0, np.linspace(0.0, 2.0, 9) ** 2
    grid.SetDimensions(len(x), len(y), 1)
    grid.SetXCoordinates(numpy_to_vtk(x, deep=True))
    grid.SetYCoordinates(numpy_to_vtk(y, deep=True))
    grid.SetZCoordinates(numpy_to_vtk(np.zeros(1), deep=True))
    return grid


def icosahedron():
    t = (1 + 5 ** 0.5) / 2
    corners = [(-1, t, 0), (1, t, 0), (-1, -t, 0), (1, -t, 0), (0, -1, t), (0, 1, t), (0, -1, -t), (0, 1, -t), (t, 0, -1), (t, 0, 1),
               (-t, 0, -1), (-t, 0, 1)]
    faces = [(0, 11, 5), (0, 5, 1), (0, 1, 7), (0, 7, 10), (0, 10, 11), (1, 5, 9), (5, 11, 4), (11, 10, 2), (10, 7, 6), (7, 1, 8),
             (3, 9, 4), (3, 4, 2), (3, 2, 6), (3, 6, 8), (3, 8, 9), (4, 9, 5), (2, 4, 11), (6, 2, 10), (8, 6, 7), (9, 8, 1)]
    return [np.array(corner) / np.linalg.norm(corner) for corner in corners], faces


def subdivided(positions, faces):
    """Each triangle of a sphere into four."""
    middles, result = {}, []

    def middle(a, b):
        key = (min(a, b), max(a, b))
        if key not in middles:
            place = positions[a] + positions[b]
            middles[key] = len(positions)
            positions.append(place / np.linalg.norm(place))
        return middles[key]

    for a, b, c in faces:
        x, y, z = middle(a, b), middle(b, c), middle(c, a)
        result += [(a, x, z), (b, y, x), (c, z, y), (x, y, z)]
    return result


def hexagons(level=3):
    """The polygons around the points of a subdivided icosahedron, as ocean models have them: 12 pentagons, else hexagons."""
    positions, faces = icosahedron()
    for _ in range(level):
        faces = subdivided(positions, faces)
    around = {}
    for face, corners in enumerate(faces):
        for k in range(3):
            around.setdefault(corners[k], {})[corners[(k + 1) % 3]] = (face, corners[(k + 2) % 3])
    cells = []
    for fan in around.values():
        start = corner = next(iter(fan))
        ring = []
        while not ring or corner != start:
            face, corner = fan[corner]
            ring.append(face)
        cells.append(ring)
    centres = [sum(positions[i] for i in corners) for corners in faces]
    return polygons([centre / np.linalg.norm(centre) for centre in centres], cells)


def quadratic(kind):
    """A plane of 3 x 3 squares of quadratic cells."""
    numbers, positions, grid = {}, [], vtkUnstructuredGrid()

    def number(x, y):
        if (x, y) not in numbers:
            numbers[x, y] = len(positions)
            positions.append((x, y, 0))
        return numbers[x, y]

    def middle(a, b):
        return (a[0] + b[0]) / 2, (a[1] + b[1]) / 2

    for i in range(3):
        for j in range(3):
            a, b, c, d = (i, j), (i + 1, j), (i + 1, j + 1), (i, j + 1)
            for ring in [(a, b, c, d)] if kind == VTK_QUADRATIC_QUAD else [(a, b, c), (a, c, d)]:
                middles = [middle(ring[k], ring[(k + 1) % len(ring)]) for k in range(len(ring))]
                ids = [number(*place) for place in [*ring, *middles]]
                grid.InsertNextCell(kind, len(ids), ids)
    grid.SetPoints(points_of(positions))
    return grid


def plate_with_stiffener():
    """A plate of 8 x 8 squares with a wall standing on its middle line: three sheets at every edge there."""
    numbers, positions = {}, []

    def number(*place):
        if place not in numbers:
            numbers[place] = len(positions)
            positions.append(place)
        return numbers[place]

    cells = [[number(i, j, 0), number(i + 1, j, 0), number(i + 1, j + 1, 0), number(i, j + 1, 0)] for i in range(8) for j in range(8)]
    cells += [[number(4, j, k), number(4, j + 1, k), number(4, j + 1, k + 1), number(4, j, k + 1)] for j in range(8) for k in range(3)]
    return polygons(positions, cells)


def soup(surface):
    """Its cells, each with points of its own."""
    positions, cells = [], []
    for cell in cells_of(surface):
        cells.append(range(len(positions), len(positions) + len(cell)))
        positions += [surface.GetPoint(i) for i in cell]
    return polygons(positions, cells)


def with_flips_and_twins(surface):
    rng = np.random.default_rng(23)
    cells = [cell[::-1] if rng.random() < 0.3 else cell for cell in cells_of(surface)]
    return polygons(positions_of(surface), cells + [cells[5], cells[9][::-1], cells[5]])


def hourglass():
    """Two spheres that share a point."""
    one = out(vtkSphereSource())
    positions, cells = positions_of(one), cells_of(one)
    top, bottom = int(np.argmax(positions, axis=0)[2]), int(np.argmin(positions, axis=0)[2])
    above = [(x, y, z + 1.0) for x, y, z in positions]
    return polygons(positions + above, cells + [[top if i == bottom else len(positions) + i for i in cell] for cell in cells])


def moebius(around=40, across=4):
    positions = []
    for u in 2 * np.pi * np.arange(around) / around:
        for t in np.linspace(-0.3, 0.3, across + 1):
            radius = 1 + t * np.cos(u / 2)
            positions.append((np.cos(u) * radius, np.sin(u) * radius, t * np.sin(u / 2)))

    def at(i, j):
        return i * (across + 1) + j if i < around else across - j

    return polygons(positions, [cell for i in range(around) for j in range(across)
                                for cell in ((at(i, j), at(i + 1, j), at(i + 1, j + 1)), (at(i, j), at(i + 1, j + 1), at(i, j + 1)))])


def collapsed(surface):
    """A triangle with a corner twice, and a cap: a corner on the opposite side, with the neighbour split there."""
    positions, cells = [np.array(place) for place in positions_of(surface)], cells_of(surface)
    a, b, c = cells[40]
    other = next(k for k, cell in enumerate(cells) if k != 40 and a in cell and b in cell)
    d = next(i for i in cells[other] if i not in (a, b))
    positions.append((positions[a] + positions[b]) / 2)
    middle = len(positions) - 1
    cells[other] = [middle, a, d]
    return polygons(positions, cells + [[b, middle, d], [a, middle, b], [a, a, c]])


def plate(sides=24, height=0.001):
    source = vtkRegularPolygonSource()
    source.SetNumberOfSides(sides)
    source.GeneratePolylineOff()
    source.SetRadius(1)
    extrusion = vtkLinearExtrusionFilter()
    extrusion.SetInputConnection(source.GetOutputPort())
    extrusion.SetExtrusionTypeToVectorExtrusion()
    extrusion.SetVector(0, 0, height)
    extrusion.CappingOn()
    return out(extrusion)


def ghosts():
    """Three cells of a sphere once more, as duplicates that another process owns."""
    whole = sphere()
    cells = cells_of(whole)
    data = polygons(positions_of(whole), cells + cells[3:6])
    flags = np.zeros(data.GetNumberOfCells(), np.uint8)
    flags[-3:] = 1
    array = numpy_to_vtk(flags, deep=True)
    array.SetName("vtkGhostType")
    data.GetCellData().AddArray(array)
    return data


def with_lines_and_vertices():
    data = sphere()
    lines, vertices = vtkCellArray(), vtkCellArray()
    lines.InsertNextCell(2, [0, 1])
    vertices.InsertNextCell(1, [0])
    data.SetLines(lines)
    data.SetVerts(vertices)
    return data


def parametric(function):
    source = vtkParametricFunctionSource()
    source.SetParametricFunction(function)
    return out(source)


def cylinder():
    source = vtkCylinderSource()
    source.SetResolution(60)
    return out(source)


def tube():
    line, source = vtkLineSource(), vtkTubeFilter()
    line.SetResolution(20)
    source.SetInputConnection(line.GetOutputPort())
    source.SetNumberOfSides(12)
    source.CappingOn()
    return out(source)


def superquadric():
    source = vtkSuperquadricSource()
    source.ToroidalOn()
    source.SetThetaResolution(48)
    source.SetPhiResolution(48)
    return out(source)


def cone():
    source = vtkConeSource()
    source.SetResolution(30)
    return out(source)


def two_patches():
    both, left, right = vtkAppendPolyData(), plane(6, 6), plane(6, 6)
    right.SetOrigin(0.5, -0.5, 0)
    right.SetPoint1(1.5, -0.5, 0)
    right.SetPoint2(0.5, 0.5, 0)
    both.AddInputConnection(left.GetOutputPort())
    both.AddInputConnection(right.GetOutputPort())
    return out(both)


def thin_box(squares, height):
    """The unit square twice, so far apart, with a rim of one row of quads."""
    numbers, cells = {}, []

    def number(*place):
        return numbers.setdefault(place, len(numbers))

    for i in range(squares):
        for j in range(squares):
            for side in (0, 1):
                cell = [number(i, j, side), number(i + 1, j, side), number(i + 1, j + 1, side), number(i, j + 1, side)]
                cells.append(cell if side else cell[::-1])
        for a, b in (((i, 0), (i + 1, 0)), ((squares, i), (squares, i + 1)), ((i + 1, squares), (i, squares)), ((0, i + 1), (0, i))):
            cells.append([number(*a, 0), number(*b, 0), number(*b, 1), number(*a, 1)])
    return polygons([(i / squares, j / squares, side * height) for i, j, side in numbers], cells)


def stretched(columns, ratio):
    """A wavy grid of rectangles that are so many times as long as wide."""
    places = [(i * ratio, j, 0.1 * ratio * np.sin(i)) for i in range(columns + 1) for j in range(columns + 1)]
    rows = columns + 1
    return polygons(places, [[i * rows + j, (i + 1) * rows + j, (i + 1) * rows + j + 1, i * rows + j + 1]
                             for i in range(columns) for j in range(columns)])


def needle(length, radius):
    """A closed tube of eight sides."""
    around = 2 * np.pi * np.arange(8) / 8
    places = [(k, radius * np.cos(u), radius * np.sin(u)) for k in range(length + 1) for u in around]
    cells = [[8 * k + i, 8 * k + (i + 1) % 8, 8 * k + 8 + (i + 1) % 8, 8 * k + 8 + i] for k in range(length) for i in range(8)]
    return polygons(places, cells + [list(range(8))[::-1], list(range(8 * length, 8 * length + 8))])


def pieces(number, surface):
    """A surface so many times, in all sizes, far apart."""
    rng = np.random.default_rng(3)
    positions, cells = np.array(positions_of(surface)), cells_of(surface)
    size = len(positions)
    places = np.concatenate([positions * rng.uniform(0.1, 10) + rng.uniform(-1000, 1000, 3) for _ in range(number)])
    return polygons(places, [[k * size + i for i in cell] for k in range(number) for cell in cells])


def scaled(surface, factors):
    return polygons(np.array(positions_of(surface)) * factors, cells_of(surface))


def hard():
    """{name: dataset} of surfaces whose smoothest fields are hard to find: plates, whose sides have almost the same one, cells of
    many sizes and shapes, and many pieces."""
    triangle = polygons([(0, 0, 0), (1, 0, 0), (0, 1, 0)], [[0, 1, 2]])
    surfaces = {f"disc_of_height_{height:g}": plate(24, height) for height in (1e-1, 1e-2, 1e-3, 1e-4, 1e-5, 1e-6)}
    surfaces.update({f"box_of_height_{height:g}": thin_box(squares, height)
                     for squares, height in ((1, 1e-3), (4, 1e-2), (8, 1e-4), (20, 1e-6))})
    surfaces.update({f"grid_stretched_{ratio:g}_times": stretched(12, ratio) for ratio in (1e3, 1e-3)})
    surfaces.update({f"needle_of_radius_{radius:g}": needle(30, radius) for radius in (1e-2, 1e-5)})
    surfaces["ellipsoid_of_three_scales"] = scaled(hexagons(2), (5.0, 2.4e-3, 3.8e-6))
    surfaces["superquadric_of_three_scales"] = scaled(superquadric(), (50.0, 1e-6, 3e-3))
    surfaces.update({f"{around}_meridians": latitude_longitude(around, along) for around, along in ((8, 200), (200, 8))})
    surfaces.update({"a_triangle": triangle, "triangles": pieces(100, triangle), "boxes": pieces(100, out(vtkCubeSource())),
                     "spheres": pieces(40, sphere(8, 6)), "discs": pieces(40, plate(8, 1e-3))})
    return surfaces


def cells_of_a_plane(columns, rows):
    """The points of a plane of unit squares, and the corners of these."""
    width = columns + 1
    places = [(i % width, i // width, 0.0) for i in range(width * (rows + 1))]
    return np.array(places), [[c, c + 1, c + 1 + width, c + width] for j in range(rows) for c in range(j * width, j * width + columns)]


def single_precision(positions, cells):
    data = polygons(positions, cells)
    points = vtkPoints()
    points.SetData(numpy_to_vtk(np.array(positions, np.float32), deep=True))
    data.SetPoints(points)
    return data


def grid_of_types(positions, cells):
    """An unstructured grid of pairs of a type and corners."""
    grid = vtkUnstructuredGrid()
    grid.SetPoints(points_of(positions))
    for kind, corners in cells:
        grid.InsertNextCell(kind, len(corners), list(corners))
    return grid


FIVE = [[(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)], [(1, 1, 0), (1, 0, 0), (0, 1, 0), (1, 1, 1)],
        [(1, 0, 1), (1, 0, 0), (0, 0, 1), (1, 1, 1)], [(0, 1, 1), (0, 1, 0), (0, 0, 1), (1, 1, 1)],
        [(1, 0, 0), (0, 1, 0), (0, 0, 1), (1, 1, 1)]]
SIX = [np.cumsum([np.zeros(3, int), *np.eye(3, dtype=int)[list(axes)]], axis=0) for axes in permutations(range(3))]


def tetrahedra(cubes, pattern):
    """Unit cubes, each of five tetrahedra, mirrored from cube to cube so that diagonals meet, or of six."""
    numbers, cells = {}, []
    for cube in map(np.array, cubes):
        for corners in pattern:
            places = cube + (abs(cube % 2 - corners) if pattern is FIVE else corners)
            a, b, c, d = places
            if np.linalg.det([b - a, c - a, d - a]) < 0:
                places = [b, a, c, d]
            cells.append((VTK_TETRA, [numbers.setdefault(tuple(place), len(numbers)) for place in places]))
    return grid_of_types(list(numbers), cells)


def volumes():
    """{name: (dataset, Euler characteristic of its skin, whether that is a manifold)} of tetrahedra. The characteristic is None where
    solids touch in ways that a person may part one way or the other."""
    rng = np.random.default_rng(2)
    cloud = polygons(rng.random((300, 3)), [])
    alpha = vtkDelaunay3D()
    alpha.SetAlpha(0.2)
    alpha.AlphaTrisOff()
    alpha.AlphaLinesOff()
    alpha.AlphaVertsOff()
    solids = {"block": (list(product(range(3), range(4), range(2))), 2, True), "at_an_edge": ([(0, 0, 0), (1, 1, 0)], 4, False),
              "at_a_vertex": ([(0, 0, 0), (1, 1, 1)], 4, False), "chequered": ([c for c in product(range(4), repeat=3) if sum(c) % 2 == 0], 64, False),
              "ring": ([c for c in product(range(3), range(3), [0]) if c != (1, 1, 0)], 0, True),
              "hollow": ([c for c in product(range(3), repeat=3) if c != (1, 1, 1)], 4, True),
              "any": ([c for c in product(range(5), repeat=3) if rng.random() < 0.5], None, False)}
    result = {f"{name}_of_{len(pattern)}": (tetrahedra(cubes, pattern), *expected)
              for name, (cubes, *expected) in solids.items() for pattern in (FIVE, SIX)}
    result["delaunay"] = (out(vtkDelaunay3D(), cloud), 2, True)
    result["alpha_shape"] = (out(alpha, cloud), None, False)
    result["half_of_delaunay"] = (grid_of_types(positions_of(cloud), [(VTK_TETRA, cell) for cell in cells_of(result["delaunay"][0])[::2]]), None, False)
    return result


def book(sheets):
    """Squares around one edge."""
    positions, cells = [(0, 0, 0), (0, 0, 1)], []
    for k in range(sheets):
        x, y = np.cos(2 * np.pi * k / sheets), np.sin(2 * np.pi * k / sheets)
        positions += [(x, y, 0), (x, y, 1)]
        cells.append([0, 2 + 2 * k, 3 + 2 * k, 1])
    return polygons(positions, cells)


def klein_bottle(size=16):
    """Closed, with one side, and through itself."""
    u, v = np.meshgrid(*[2 * np.pi * np.arange(size) / size] * 2, indexing="ij")
    radius = 2 + np.cos(u / 2) * np.sin(v) - np.sin(u / 2) * np.sin(2 * v)
    positions = np.stack([radius * np.cos(u), radius * np.sin(u), np.sin(u / 2) * np.sin(v) + np.cos(u / 2) * np.sin(2 * v)], -1)

    def at(i, j):
        return i * size + j % size if i < size else -j % size

    return polygons(positions, [[at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)] for i in range(size) for j in range(size)])


def strip_beside_quads():
    places, cells = cells_of_a_plane(6, 3)
    data, strips = polygons(places, cells[:12]), vtkCellArray()
    strips.InsertNextCell(14, [i + (2 + j) * 7 for i in range(7) for j in (0, 1)])
    data.SetStrips(strips)
    return data


def odd():
    """{name: (dataset, error)} of what files hold, too. The error is a pattern, empty where there is a field."""
    places, quads = cells_of_a_plane(8, 6)
    rng = np.random.default_rng(3)
    nowhere = places.copy()
    nowhere[14] = np.nan
    layers, cells_of_layers = cells_of_a_plane(8, 50)
    layers *= 10
    layers[:, 1] = 5e-6 * (1.2 ** (layers[:, 1] / 10) - 1)
    unused = np.vstack([places, [(1e9, 0, 0), (np.nan, 0, 0)]])
    wedge = np.vstack([places, np.random.default_rng(1).normal(size=(6, 3))])
    return {
        "mixed_cells": (grid_of_types(places, [(VTK_QUAD, q) if k % 3 else (VTK_POLYGON, q + [q[0]]) for k, q in enumerate(quads)]), ""),
        "pixels": (grid_of_types(places, [(VTK_PIXEL, [q[0], q[1], q[3], q[2]]) for q in quads]), ""),
        "a_lagrange_quad": (grid_of_types(
            [(0, 0, 0), (3, 0, 0), (3, 3, 0), (0, 3, 0), (1, 0, 0), (2, 0, 0), (3, 1, 0), (3, 2, 0), (1, 3, 0), (2, 3, 0), (0, 1, 0),
             (0, 2, 0), (1, 1, 0.1), (2, 1, 0.1), (1, 2, 0.1), (2, 2, 0.1)], [(VTK_LAGRANGE_QUADRILATERAL, range(16))]), ""),
        "a_bezier_triangle": (grid_of_types([(0, 0, 0), (3, 0, 0), (0, 3, 0), (1.5, 0, 0.2), (1.5, 1.5, 0.2), (0, 1.5, 0.2)],
                                            [(VTK_BEZIER_TRIANGLE, range(6))]), ""),
        "a_wedge_beside_quads": (grid_of_types(wedge, [(VTK_QUAD, q) for q in quads] + [(VTK_WEDGE, range(63, 69))]), ""),
        "strip_beside_quads": (strip_beside_quads(), ""),
        "unused_points_far_away": (polygons(unused, quads), ""),
        "a_point_nowhere": (polygons(nowhere, quads), "point 14 has a coordinate that is not finite"),
        "a_point_that_is_not_there": (polygons(places, quads[:5] + [[0, 1, 99]]), "cell 5 uses point 99"),
        "a_negative_point": (polygons(places, quads[:5] + [[0, 1, -1]]), "cell 5 uses point -1"),
        "far_in_single_precision": (single_precision(0.7 * places + 1e6, quads), ""),
        "far": (polygons(0.1 * places + 1e9, quads), ""),
        "tiny": (polygons(1e-9 * places, quads), ""),
        "too_tiny": (polygons(1e-100 * places, quads), "smaller than 1e-40.*Transform"),
        "huge": (polygons(1e30 * places, quads), ""),
        "too_huge": (polygons(1e160 * places, quads), "beyond 1e40.*Transform"),
        "layers_along_a_wall": (polygons(layers, cells_of_layers), ""),
        "narrow": (polygons(places * (1, 1e-6, 1), quads), ""),
        "repeated_corners": (polygons(places, [[*q, q[3], q[0]] for q in quads]), ""),
        "a_spike": (polygons([(0, 0, 0), (2, 0, 0), (2, 2, 0), (1, 2, 0), (1, 3, 0), (0, 2, 0)], [[0, 1, 2, 3, 4, 3, 5]]), ""),
        "a_bridge_to_a_hole": (polygons([(0, 0, 0), (4, 0, 0), (4, 4, 0), (0, 4, 0), (1, 1, 0), (1, 3, 0), (3, 3, 0), (3, 1, 0)],
                                        [[0, 1, 2, 3, 0, 4, 5, 6, 7, 4]]), ""),
        "a_star": (polygons([(np.cos(t), np.sin(t), 0.1 * np.sin(3 * t)) for t in 2 * np.pi * np.arange(7) / 7], [[0, 3, 6, 2, 5, 1, 4]]), ""),
        "few_corners": (polygons(places, quads + [[0, 1], [5], []]), ""),
        "all_cells_twice": (polygons(places, quads + [q[::-1] for q in quads]), ""),
        "chequered": (polygons(places, [q for k, q in enumerate(quads) if (k % 8 + k // 8) % 2]), ""),
        "a_book": (book(7), ""),
        "klein_bottle": (klein_bottle(), ""),
        "polygons_of_any_points": (polygons(rng.normal(size=(30, 3)), [rng.integers(0, 30, rng.integers(3, 9)) for _ in range(60)]), ""),
        "on_a_line": (polygons([(i, 0, 0) for i in range(4)], [[0, 1, 2], [1, 2, 3]]), "no triangle of the surface has an area"),
    }


def make():
    def expect(characteristic, loops, cells):
        return {"characteristic": characteristic, "loops": loops, "cells": cells}

    return {
        "plane_of_quads": (out(plane()), expect(1, 1, 100)),
        "box_of_quads_with_doubled_points": (out(vtkCubeSource()), expect(2, 0, 6)),
        "cylinder_with_caps_of_60_corners": (cylinder(), expect(2, 0, 62)),
        "toroidal_superquadric_of_strips": (superquadric(), expect(0, 0, None)),
        "cone": (cone(), expect(2, 0, 31)),
        "tube_with_caps": (tube(), expect(2, 0, None)),
        "parametric_torus": (parametric(vtkParametricTorus()), expect(0, 0, None)),
        "parametric_ellipsoid": (parametric(vtkParametricEllipsoid()), expect(2, 0, None)),
        "cylinder_after_surface_normals": (out(vtkPolyDataNormals(), cylinder()), expect(2, 0, 62)),
        "extruded_disc": (plate(24, 0.2), expect(2, 0, None)),
        "extruded_disc_very_flat": (plate(24, 0.001), expect(2, 0, None)),
        "two_patches_side_by_side": (two_patches(), expect(1, 1, 72)),
        "latitude_longitude_grid": (latitude_longitude(), expect(2, 0, 48 * 24)),
        "latitude_longitude_grid_rounded": (latitude_longitude(noise=1e-8), expect(2, 0, 48 * 24)),
        "image": (image(), expect(1, 1, 84)),
        "rectilinear_grid": (rectilinear(), expect(1, 1, 48)),
        "hexagons_and_pentagons": (hexagons(), expect(2, 0, 642)),
        "hexagons_in_an_unstructured_grid": (grid_of(hexagons()), expect(2, 0, 642)),
        "quads_in_an_unstructured_grid": (grid_of(out(plane())), expect(1, 1, 100)),
        "quadratic_triangles": (quadratic(VTK_QUADRATIC_TRIANGLE), expect(1, 1, 18)),
        "quadratic_quads": (quadratic(VTK_QUADRATIC_QUAD), expect(1, 1, 9)),
        "plate_with_stiffener": (plate_with_stiffener(), expect(None, None, 88)),
        "soup_of_triangles": (soup(sphere()), expect(2, 0, sphere().GetNumberOfCells())),
        "flipped_and_doubled_triangles": (with_flips_and_twins(sphere()), expect(2, 0, sphere().GetNumberOfCells() + 3)),
        "two_spheres_at_a_point": (hourglass(), expect(4, 0, hourglass().GetNumberOfCells())),
        "moebius_strip": (moebius(), expect(None, None, 320)),
        "triangles_without_area": (collapsed(sphere()), expect(2, 0, None)),
        "lines_and_vertices_beside": (with_lines_and_vertices(), expect(2, 0, sphere().GetNumberOfCells())),
        "ghost_cells": (ghosts(), expect(2, 0, ghosts().GetNumberOfCells())),
    }
