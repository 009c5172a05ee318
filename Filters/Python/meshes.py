"""Quad meshes by one call."""

from __future__ import annotations

from typing import Optional

from vtkmodules.vtkCommonDataModel import vtkDataSet, vtkPolyData

from .fields import Property, _check_mesh, _choose_array, _set_properties, _update
from .vtkFiltersDirectionalFields import vtkFieldQuads


def quads(mesh: vtkDataSet, number: Optional[int] = None, directions: Optional[str] = None, *, edge_length: Optional[float] = None,
          sizes: Optional[str] = None, regions: Optional[str] = None, **properties: Property) -> vtkPolyData:
    """A mesh of quads alone whose edges follow a cross field, the boundary and sharp edges.

    mesh         a surface: any vtkDataSet with cells of two dimensions, or an object of a class derived from one, as
                 pyvista.PolyData. It is not changed.
    number       of quads that is aimed at, by default 4000
    directions   the name of an array of vectors at points, else on cells: the field; by default Direction0, as smooth_field() leaves it,
                 and without that the smoothest cross field
    edge_length  in place of the number
    sizes        the name of an array of lengths of edges relative to other places
    regions      the name of an array of numbers on cells; borders between different ones become edges of quads
    properties   properties of vtkFieldQuads by name, as AlignSharpEdges=False

    Returns the quads, of the class of the mesh where that is derived from vtkPolyData: with the arrays of the mesh, Irregular
    at points, and ScaledJacobian on cells.

    Raises TypeError for arguments that do not exist or are of another type, FieldError for values out of range and for what the
    filter refuses; warns with FieldWarning.
    """
    _check_mesh(mesh)
    remesh = vtkFieldQuads()
    remesh.SetInputData(mesh)
    given = {"NumberOfQuads": number, "EdgeLength": edge_length}
    _set_properties(remesh, {**properties, **{name: value for name, value in given.items() if value is not None}},
                    ("mesh", "number", "directions", "edge_length", "sizes", "regions"))
    for index, array in enumerate((directions, sizes, regions)):
        _choose_array(remesh, mesh, index, array)
    result = type(mesh)() if isinstance(mesh, vtkPolyData) else vtkPolyData()
    result.ShallowCopy(_update(remesh, 3))
    return result
