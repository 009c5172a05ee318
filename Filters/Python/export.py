"""Files of fields for remeshers.

They number faces as the polygons of the mesh, so the mesh goes along in a file that keeps their order: PLY or OBJ.
"""

from __future__ import annotations

import math
import os
from typing import Dict, FrozenSet, Iterable, Iterator, List, Sequence, Tuple, Union

from vtkmodules.vtkCommonCore import vtkIdList
from vtkmodules.vtkCommonDataModel import vtkDataSet, vtkPolyData

from .fields import FieldError

Path = Union[str, "os.PathLike[str]"]
Vector = Tuple[float, ...]


def write_rosy(path: Path, mesh: vtkDataSet) -> None:
    """Writes a field of N directions as .rosy, which quadwild and other programs on vcglib read (they take N = 4).

    The file has the number of faces, N, and a line per face with a unit vector along one of its directions, Direction0.
    Raises FieldError where a face has none.
    """
    n = _number_of_directions(mesh)
    lines = []
    for face, vector in enumerate(_vectors(mesh, "Direction0")):
        length = math.hypot(*vector)
        if length == 0.0:
            raise FieldError(f"face {face} has no direction, which .rosy cannot say; prescribe one there")
        lines.append(_line(component / length for component in vector))
    _write(path, [str(len(lines)), str(n), *lines])


def write_raw_field(path: Path, mesh: vtkDataSet) -> None:
    """Writes a field of N directions as Directional's raw field (.rawfield), which its read_raw_field() reads.

    The file has N and the number of faces, then a line per face with the N vectors, counter-clockwise, as long as Direction0 has
    them. They are the arrays Direction1, ... where these are there, else Direction0, rotated around the normal of the face.
    """
    n = _number_of_directions(mesh)
    rows = zip(*(_direction(mesh, k, n) for k in range(n)))
    lines = [_line(component for vector in vectors for component in vector) for vectors in rows]
    _write(path, [f"{n} {len(lines)}", *lines])


def write_sharp(path: Path, mesh: vtkDataSet, feature_angle: float = 30.0) -> None:
    """Writes the features of a mesh as .sharp, which quadwild reads: its boundary and its sharp edges.

    Edges are sharp where the normals of both faces differ by more than feature_angle, in degrees, as for the solver's
    SharpEdgesWeight; the surface is that which the solver sees, whose points are joined and whose triangles are turned alike. The file has the number of edges and a line "kind,face,side" for each: kind 0 where the surface is
    concave there, else 1; side j is the one from corner j of the face to the next. (quadwild's page separates them by blanks,
    its code by commas.)
    """
    triangles = list(_triangles(mesh))
    normals = [_normal(mesh, triangle) for triangle in triangles]
    lines = []
    for sides in _sides_of_edges(mesh, triangles):
        (face, side, start, end), others = sides[0], sides[1:]
        if len(others) != 1:  # the boundary, or an edge of more than two faces
            lines.append(f"1,{face},{side}")
            continue
        other, _, first, _ = others[0]
        normal = normals[other] if first != start else tuple(-x for x in normals[other])  # as if neighbours were turned alike
        cross = _cross(normals[face], normal)
        if math.atan2(math.hypot(*cross), _dot(normals[face], normal)) > math.radians(feature_angle):
            points = triangles[face][side], triangles[face][(side + 1) % 3]
            along = _dot(cross, _difference(mesh.GetPoint(points[1]), mesh.GetPoint(points[0])))
            lines.append(f"{0 if along < 0.0 else 1},{face},{side}")
    _write(path, [str(len(lines)), *lines])


def _sides_of_edges(mesh: vtkDataSet, triangles: List[Vector]) -> List[List[Tuple[int, int, int, int]]]:
    """For each edge the sides (face, side, start, end) of the triangles there. Points of the boundary that coincide are one, as for the
    solver."""
    def sides_by(joined: Dict[int, int]) -> Dict[FrozenSet[int], List[Tuple[int, int, int, int]]]:
        edges: Dict[FrozenSet[int], List[Tuple[int, int, int, int]]] = {}
        for face, triangle in enumerate(triangles):
            for side in range(3):
                start, end = (joined.get(triangle[j % 3], triangle[j % 3]) for j in (side, side + 1))
                edges.setdefault(frozenset((start, end)), []).append((face, side, start, end))
        return edges

    box = mesh.GetBounds()
    spacing = 1e-6 * max(math.hypot(*(box[2 * axis + 1] - box[2 * axis] for axis in range(3))), 1e-300)
    first_at: Dict[Tuple[int, ...], int] = {}
    joined = {}
    for sides in sides_by({}).values():
        if len(sides) == 1:
            for point in sides[0][2:]:
                place = tuple(round(coordinate / spacing) for coordinate in mesh.GetPoint(point))
                joined[point] = first_at.setdefault(place, point)
    return list(sides_by(joined).values())


def _number_of_directions(mesh: vtkDataSet) -> int:
    if not mesh.GetCellData().HasArray("Direction0"):
        raise FieldError("the mesh has no cell array Direction0; compute a field first, as by smooth_field()")
    reported = mesh.GetFieldData().GetArray("NumberOfDirections")
    if reported is not None:
        return int(reported.GetTuple1(0))
    n = 1
    while mesh.GetCellData().HasArray(f"Direction{n}"):
        n += 1
    return n


def _direction(mesh: vtkDataSet, k: int, n: int) -> Iterator[Vector]:
    """Direction k of each face."""
    name = f"Direction{k}"
    return _vectors(mesh, name) if mesh.GetCellData().HasArray(name) else _rotated(mesh, 2 * math.pi * k / n)


def _rotated(mesh: vtkDataSet, angle: float) -> Iterator[Vector]:
    """Direction0 of each face, rotated around the normal of the face."""
    for face, (polygon, vector) in enumerate(zip(_polygons(mesh), _vectors(mesh, "Direction0"))):
        area = [sum(parts) for parts in zip(*(_normal(mesh, (polygon[0], *side)) for side in zip(polygon[1:], polygon[2:])))]
        twice = math.hypot(*area)
        if any(vector) and twice == 0.0:
            raise FieldError(f"face {face} has no area, so its directions do not follow from Direction0; compute the field with "
                             "AllDirections")
        across = _cross([component / (twice or 1.0) for component in area], vector)
        yield tuple(math.cos(angle) * x + math.sin(angle) * y for x, y in zip(vector, across))


def _triangles(mesh: vtkDataSet) -> Iterator[Vector]:
    """The points of each polygon, all of which are triangles."""
    for face, polygon in enumerate(_polygons(mesh)):
        if len(polygon) != 3:
            raise FieldError(f"face {face} is not a triangle; apply vtkTriangleFilter first")
        yield polygon


def _polygons(mesh: vtkDataSet) -> Iterator[Vector]:
    """The points of each polygon."""
    points = vtkIdList()
    for cell in _cells(mesh):
        mesh.GetCellPoints(cell, points)
        yield tuple(points.GetId(j) for j in range(points.GetNumberOfIds()))


def _cells(mesh: vtkDataSet) -> Sequence[int]:
    """The numbers of the cells of two dimensions."""
    if isinstance(mesh, vtkPolyData):
        first = mesh.GetNumberOfVerts() + mesh.GetNumberOfLines()
        return range(first, first + mesh.GetNumberOfPolys())
    return [cell for cell in range(mesh.GetNumberOfCells()) if mesh.GetCell(cell).GetCellDimension() == 2]


def _vectors(mesh: vtkDataSet, name: str) -> Iterator[Vector]:
    """A cell array of vectors on the polygons."""
    array = mesh.GetCellData().GetArray(name)
    if array.GetNumberOfComponents() != 3:
        raise FieldError(f"the array {name} has {array.GetNumberOfComponents()} components instead of 3")
    if array.GetNumberOfTuples() < mesh.GetNumberOfCells():
        raise FieldError(f"the array {name} has {array.GetNumberOfTuples()} tuples for {mesh.GetNumberOfCells()} cells; "
                         "cells were added after the field was computed, so compute it again")
    for face, cell in enumerate(_cells(mesh)):
        vector = array.GetTuple3(cell)
        if not all(map(math.isfinite, vector)):
            raise FieldError(f"the array {name} is not finite on face {face}")
        yield vector


def _normal(mesh: vtkDataSet, triangle: Vector) -> Vector:
    a, b, c = (mesh.GetPoint(point) for point in triangle)
    return _cross(_difference(b, a), _difference(c, a))


def _difference(a: Vector, b: Vector) -> Vector:
    return tuple(x - y for x, y in zip(a, b))


def _cross(a: Vector, b: Vector) -> Vector:
    return (a[1] * b[2] - a[2] * b[1], a[2] * b[0] - a[0] * b[2], a[0] * b[1] - a[1] * b[0])


def _dot(a: Vector, b: Vector) -> float:
    return sum(x * y for x, y in zip(a, b))


def _line(numbers: Iterable[float]) -> str:
    return " ".join(map(repr, numbers))


def _write(path: Path, lines: List[str]) -> None:
    with open(path, "w", encoding="ascii", newline="\n") as file:
        file.write("\n".join(lines) + "\n")
