"""Parallel transport and logarithmic maps by one call."""

from __future__ import annotations

from typing import Optional, Sequence, TypeVar

from vtkmodules.vtkCommonDataModel import vtkDataSet

from .fields import FieldError, Property, _check_mesh, _choose_array, _converted, _set_properties, _short, _update
from .vtkFiltersDirectionalFields import vtkParallelTransport

Mesh = TypeVar("Mesh", bound=vtkDataSet)


def transport(mesh: Mesh, vectors: Optional[str] = None, *, eastward: Optional[str] = None, northward: Optional[str] = None,
              point: Optional[Sequence[float]] = None, direction: Optional[Sequence[float]] = None, **properties: Property) -> Mesh:
    """Vectors carried over a surface along shortest paths, and the logarithmic map of a point.

    mesh        a surface: any vtkDataSet with cells of two dimensions, or an object of a class derived from one, as
                pyvista.PolyData. It is not changed.
    vectors     the name of an array of vectors at points, else on cells, zero or NaN where nothing is given; by default, the direction
                at the point is carried
    eastward, northward  names of two arrays of numbers instead, for surfaces around the origin with Axis to the north
    point       a place; the point of the mesh that is nearest to it is that of the map. By default, the one on the largest component
                that is nearest to the middle of the front of its bounds, where z is largest. Beside vectors, its direction counts only
                with AddPoint=True.
    direction   the vector there, of which the part along the surface counts, and the zero of the angles; by default (1, 0, 0)
    properties  properties of vtkParallelTransport by name, as TextureSize=0.5, LogarithmicMap=False

    Returns a mesh of the same class, which has the arrays of the input and TransportedVectors on cells and at points;
    GeodesicDistance, GeodesicAngle, LogarithmicMap and TextureCoordinates at points; in its field data MapPoint.

    Raises TypeError for arguments that do not exist or are of another type, FieldError for values out of range and for what the
    filter refuses; warns with FieldWarning.
    """
    _check_mesh(mesh)
    carry = vtkParallelTransport()
    carry.SetInputData(mesh)
    _set_properties(carry, properties, ("mesh", "vectors", "eastward", "northward", "point", "direction"))
    if point is not None:
        carry.SetPoint(*_three("point", point))
    if direction is not None:
        carry.SetDirection(*_three("direction", direction))
    for index, name in enumerate((vectors, eastward, northward)):
        _choose_array(carry, mesh, index, name)
    result = type(mesh)()
    result.ShallowCopy(_update(carry, 3))
    return result


def _three(name: str, values: Sequence[float]) -> Sequence[float]:
    if isinstance(values, Sequence) and not isinstance(values, str) and len(values) != 3:
        raise FieldError(f"{name} has {len(values)} numbers; give three")
    try:
        return _converted(values, tuple)
    except TypeError as error:
        raise TypeError(f"{name} = {_short(values)}: {error}") from None
    except OverflowError:
        raise FieldError(f"{name} = {_short(values)} is out of range") from None
