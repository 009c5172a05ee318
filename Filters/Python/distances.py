"""Distances along surfaces and shortest paths by one call."""

from __future__ import annotations

from numbers import Integral, Real
from typing import Any, Iterable, Optional, Sequence, TypeVar, Union

from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkDataSet, vtkPolyData

from .fields import DataObjects, FieldError, Property, _check_mesh, _choose_array, _datasets, _set_properties, _update
from .geodesics import _three
from .vtkFiltersDirectionalFields import vtkSurfaceDistance

Mesh = TypeVar("Mesh", bound=vtkDataSet)
Place = Union[int, Sequence[float], vtkDataSet]


def distance(mesh: Mesh, sources: DataObjects = None, *, point: Optional[Sequence[float]] = None, mask: Optional[str] = None,
             gaps: Optional[str] = None, **properties: Property) -> Mesh:
    """Distances along a surface from anything.

    mesh        a surface: any vtkDataSet with cells of two dimensions, or an object of a class derived from one, as
                pyvista.PolyData. It is not changed.
    sources     where the distance is 0: points, lines, or polygons, whose outline counts; one dataset or several of them
    point       a place whose nearest place of the surface is a source, too. Without any source, the filter chooses a point: on the
                largest component, near the middle of the front of its bounds, where z is largest.
    mask        the name of an array of numbers on points, else on cells: the distance is 0 where it is neither 0 nor NaN
    gaps        the name of an array of numbers on points, else on cells, that is NaN where the surface has gaps, as land in the sea
    properties  properties of vtkSurfaceDistance by name, as Boundary=True, Signed=True, MaximumDistance=0.5; values of enumerations
                may be names, as Coordinates="LongitudeAndLatitude"

    Returns a mesh of the same class, which has the arrays of the input and, at points, Distance, NearestSource and
    DirectionFromSource. Distance is NaN where no path leads.

    Raises TypeError for arguments that do not exist or are of another type, FieldError for values out of range and for what the
    filter refuses; warns with FieldWarning.
    """
    _check_mesh(mesh)
    measure = vtkSurfaceDistance()
    measure.SetInputData(mesh)
    for each in _datasets(sources, "sources"):
        measure.AddInputDataObject(1, each)
    _set_properties(measure, properties, ("mesh", "sources", "point", "mask", "gaps"))
    if point is not None:
        measure.SetPoint(*_three("point", point))
        measure.AddPointOn()
    for index, name in enumerate((mask, gaps)):
        _choose_array(measure, mesh, index, name)
    result = type(mesh)()
    result.ShallowCopy(_update(measure, 3))
    return result


def shortest_path(mesh: vtkDataSet, a: Place, b: Place, **properties: Property) -> vtkPolyData:
    """The shortest path over a surface from a to b.

    mesh        as for distance()
    a           the number of a point of the mesh, or three numbers, whose nearest place of the surface counts; or a dataset of
                points, lines or polygons, of which the nearest place counts
    b           the same; of a dataset, a path leads to each of its points
    properties  as for distance()

    Returns a line for each path, a pyvista.PolyData where the mesh is one, with the cell arrays PathLength, StraightLength, Distance,
    Source and Target. There is no line where no path leads. Its points lie on the edges of the mesh.

    Raises as distance().
    """
    _check_mesh(mesh)
    measure = vtkSurfaceDistance()
    measure.SetInputData(mesh)
    measure.SetInputDataObject(1, _place("a", a, mesh))
    measure.SetInputDataObject(2, _place("b", b, mesh))
    measure.SetNumberOfLevels(0)
    _set_properties(measure, properties, ("mesh", "a", "b"))
    _update(measure, 3)
    paths = type(mesh)() if isinstance(mesh, vtkPolyData) else vtkPolyData()
    paths.ShallowCopy(measure.GetOutputDataObject(2))
    return paths


def _place(name: str, place: Any, mesh: vtkDataSet) -> vtkDataSet:
    if isinstance(place, Iterable) and not isinstance(place, (vtkDataSet, str, bytes)):
        return _point(_three(name, place))
    if isinstance(place, Integral) and not isinstance(place, bool):
        if not 0 <= place < mesh.GetNumberOfPoints():
            raise FieldError(f"{name} = {place}, but the mesh has {mesh.GetNumberOfPoints()} points, from 0 on")
        return _point(mesh.GetPoint(int(place)))
    if isinstance(place, (Real, str, bytes)):
        raise TypeError(f"{name} is the number of a point, three numbers or a dataset, not {place!r}")
    (dataset,) = _datasets(place, name)
    return dataset


def _point(place: Sequence[float]) -> vtkPolyData:
    points, dataset = vtkPoints(), vtkPolyData()
    points.SetDataTypeToDouble()
    points.InsertNextPoint(place)
    dataset.SetPoints(points)
    return dataset
