"""Files of fields for remeshers.

They number faces as the polygons of the mesh, so the mesh goes along in a file that keeps their order: PLY or OBJ.
"""

from __future__ import annotations

import os
from typing import Union

from vtkmodules.vtkCommonDataModel import vtkDataSet

from .fields import _check_mesh, _set_property, update
from .vtkFiltersDirectionalFields import vtkFieldWriter

Path = Union[str, "os.PathLike[str]"]


def write_rosy(path: Path, mesh: vtkDataSet) -> None:
    """Writes a field of N directions as .rosy, which quadwild and other programs on vcglib read (they take N = 4).

    The file has the number of faces, N, and a line per face with a unit vector along one of its directions, Direction0.
    Raises FieldError where a face has none; warns where a face is no triangle, as readers split it.
    """
    _write(path, mesh, vtkFieldWriter.Rosy)


def write_raw_field(path: Path, mesh: vtkDataSet) -> None:
    """Writes a field of N directions as Directional's raw field (.rawfield), which its read_raw_field() reads.

    The file has N and the number of faces, then a line per face with the N vectors, counter-clockwise, as long as Direction0 has
    them. They are the arrays Direction1, ... where these are there, else Direction0, rotated around the normal of the face.
    Warns where a face is no triangle, as readers split it.
    """
    _write(path, mesh, vtkFieldWriter.RawField)


def write_sharp(path: Path, mesh: vtkDataSet, feature_angle: float = 30.0) -> None:
    """Writes the features of a mesh as .sharp, which quadwild reads: its boundary and its sharp edges.

    Edges are sharp where the normals of both faces differ by more than feature_angle, in degrees, as for the solver's
    SharpEdgesWeight; the surface is that which the solver sees, whose points are joined and whose triangles are turned alike.
    The file has the number of lines and a line "kind,face,side" for each edge: kind 0 where the surface is concave there, else 1;
    side j is the one from corner j of the face to the next. An edge of more than two faces has a line for each. (quadwild's page
    separates numbers by blanks, its code by commas.)
    """
    _write(path, mesh, vtkFieldWriter.Sharp, feature_angle)


def _write(path: Path, mesh: vtkDataSet, format: int, feature_angle: float = 30.0) -> None:
    _check_mesh(mesh)
    writer = vtkFieldWriter()
    writer.SetInputData(mesh)
    writer.SetFileName(os.fspath(path))
    writer.SetFormat(format)
    _set_property(writer, "FeatureAngle", feature_angle)
    update(writer)
