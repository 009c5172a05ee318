"""Files of fields for remeshers.

They number faces as the polygons of the mesh, so the mesh goes along in a file that keeps their order: PLY or OBJ.
"""

from __future__ import annotations

import math
import os
from typing import Iterable, Iterator, List, Tuple, Union

from vtkmodules.vtkCommonCore import vtkIdList
from vtkmodules.vtkCommonDataModel import vtkPolyData

from .fields import FieldError

Path = Union[str, "os.PathLike[str]"]
Vector = Tuple[float, ...]


def write_rosy(path: Path, mesh: vtkPolyData) -> None:
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


def write_raw_field(path: Path, mesh: vtkPolyData) -> None:
    """Writes a field of N directions as Directional's raw field (.rawfield), which its read_raw_field() reads.

    The file has N and the number of faces, then a line per face with the N vectors, counter-clockwise, as long as Direction0 has
    them. They are the arrays Direction1, ... where these are there, else Direction0, rotated around the normal of the face.
    """
    n = _number_of_directions(mesh)
    rows = zip(*(_direction(mesh, k, n) for k in range(n)))
    lines = [_line(component for vector in vectors for component in vector) for vectors in rows]
    _write(path, [f"{n} {len(lines)}", *lines])


def write_sharp(path: Path, mesh: vtkPolyData, feature_angle: float = 30.0) -> None:
    """Writes the features of a mesh as .sharp, which quadwild reads: its boundary and its sharp edges.

    Edges are sharp where the normals of both faces differ by more than feature_angle, in degrees, as for the solver's
    SharpEdgesWeight. The file has the number of edges and a line "kind,face,side" for each: kind 0 where the surface is
    concave there, else 1; side j is the one from corner j of the face to the next. (quadwild's page separates them by blanks,
    its code by commas.)
    """
    triangles = list(_triangles(mesh))
    normals = [_normal(mesh, triangle) for triangle in triangles]
    sides = {(triangle[j], triangle[(j + 1) % 3]): (face, j) for face, triangle in enumerate(triangles) for j in range(3)}
    lines = []
    for (start, end), (face, side) in sides.items():
        other = sides.get((end, start), (None, None))[0]
        if other is None:
            lines.append(f"1,{face},{side}")
        elif face < other:
            cross = _cross(normals[face], normals[other])
            angle = math.atan2(math.hypot(*cross), _dot(normals[face], normals[other]))
            if angle > math.radians(feature_angle):
                along = _dot(cross, _difference(mesh.GetPoint(end), mesh.GetPoint(start)))
                lines.append(f"{0 if along < 0.0 else 1},{face},{side}")
    _write(path, [str(len(lines)), *lines])


def _number_of_directions(mesh: vtkPolyData) -> int:
    if not mesh.GetCellData().HasArray("Direction0"):
        raise FieldError("the mesh has no cell array Direction0; compute a field first, as by smooth_field()")
    reported = mesh.GetFieldData().GetArray("NumberOfDirections")
    if reported is not None:
        return int(reported.GetTuple1(0))
    n = 1
    while mesh.GetCellData().HasArray(f"Direction{n}"):
        n += 1
    return n


def _direction(mesh: vtkPolyData, k: int, n: int) -> Iterator[Vector]:
    """Direction k of each face."""
    name = f"Direction{k}"
    return _vectors(mesh, name) if mesh.GetCellData().HasArray(name) else _rotated(mesh, 2 * math.pi * k / n)


def _rotated(mesh: vtkPolyData, angle: float) -> Iterator[Vector]:
    """Direction0 of each face, rotated around the normal of the face."""
    for face, (polygon, vector) in enumerate(zip(_polygons(mesh), _vectors(mesh, "Direction0"))):
        area = [sum(parts) for parts in zip(*(_normal(mesh, (polygon[0], *side)) for side in zip(polygon[1:], polygon[2:])))]
        twice = math.hypot(*area)
        if any(vector) and twice == 0.0:
            raise FieldError(f"face {face} has no area, so its directions do not follow from Direction0; compute the field with "
                             "AllDirections")
        across = _cross([component / (twice or 1.0) for component in area], vector)
        yield tuple(math.cos(angle) * x + math.sin(angle) * y for x, y in zip(vector, across))


def _triangles(mesh: vtkPolyData) -> Iterator[Vector]:
    """The points of each polygon, all of which are triangles."""
    for face, polygon in enumerate(_polygons(mesh)):
        if len(polygon) != 3:
            raise FieldError(f"face {face} is not a triangle; apply vtkTriangleFilter first")
        yield polygon


def _polygons(mesh: vtkPolyData) -> Iterator[Vector]:
    """The points of each polygon."""
    polygons, points = mesh.GetPolys(), vtkIdList()
    for face in range(polygons.GetNumberOfCells()):
        polygons.GetCellAtId(face, points)
        yield tuple(points.GetId(j) for j in range(points.GetNumberOfIds()))


def _vectors(mesh: vtkPolyData, name: str) -> Iterator[Vector]:
    """A cell array of vectors on the polygons, which stand behind vertices and lines."""
    array, first = mesh.GetCellData().GetArray(name), mesh.GetNumberOfVerts() + mesh.GetNumberOfLines()
    if array.GetNumberOfComponents() != 3:
        raise FieldError(f"the array {name} has {array.GetNumberOfComponents()} components instead of 3")
    if array.GetNumberOfTuples() < mesh.GetNumberOfCells():
        raise FieldError(f"the array {name} has {array.GetNumberOfTuples()} tuples for {mesh.GetNumberOfCells()} cells; "
                         "cells were added after the field was computed, so compute it again")
    for face in range(mesh.GetNumberOfPolys()):
        vector = array.GetTuple3(first + face)
        if not all(map(math.isfinite, vector)):
            raise FieldError(f"the array {name} is not finite on face {face}")
        yield vector


def _normal(mesh: vtkPolyData, triangle: Vector) -> Vector:
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
