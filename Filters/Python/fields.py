"""Smooth fields by one call, and filters whose errors are exceptions."""

from __future__ import annotations

import difflib
import math
import numbers
import operator
import re
import warnings
from typing import Any, Callable, Dict, Iterable, List, Optional, Sequence, Set, Tuple, TypeVar, Union

from vtkmodules.vtkCommonCore import vtkObjectBase, vtkVersion
from vtkmodules.vtkCommonDataModel import vtkDataObject, vtkDataSet, vtkPolyData
from vtkmodules.vtkCommonExecutionModel import vtkAlgorithm

from .vtkFiltersDirectionalFields import vtkHarmonicFieldSolver

Mesh = TypeVar("Mesh", bound=vtkDataSet)
DataObjects = Union[vtkDataObject, Iterable[vtkDataObject], None]
Property = Union[bool, int, float, str, Tuple[float, float, float]]
Message = Tuple[vtkAlgorithm, str]

# The solver's arrays: the index of each in SetInputArrayToProcess. Their names are those in pvpython.
_ARRAYS = {"Mask": 0, "Directions": 1, "Weights": 2, "Values": 3, "RotationArray": 4, "Eastward": 5, "Northward": 6,
           "Source": 7}
_ARGUMENTS = ("mesh", "guides", "n", "singularities", *_ARRAYS)


class FieldError(ValueError):
    """An error of a filter or a writer. It names the element and a remedy."""


class FieldWarning(UserWarning):
    """A warning of a filter, which has a result all the same."""


def smooth_field(mesh: Mesh, guides: DataObjects = None, n: Optional[int] = None, *, singularities: DataObjects = None,
                 **properties: Property) -> Mesh:
    """The smoothest field of n directions that follows the guides, or the smoothest one there is.

    mesh           a surface: any vtkDataSet with cells of two dimensions, or an object of a class derived from one, as
                   pyvista.PolyData. It is not changed.
    guides         what the field follows: lines, or any datasets with vectors; one or several of them
    n              the number of directions per point, 1 to 8, by default 4; 1 for all but power fields
    singularities  points, one dataset or several: the field has singularities there and nowhere else; with an empty
                   sequence, nowhere at all; by default, None, where it is smoothest
    properties     properties of vtkHarmonicFieldSolver by name, as BoundaryWeight=1; values of enumerations may be names, as
                   Discretisation="OneForm". Mask, Directions, Weights, Values, Source and RotationArray are the names of arrays of
                   the mesh, at points, else on cells; unlike the filter, the function follows no array that is not named.

    Returns a mesh of the same class, which has the arrays of the input and those of the solver: Direction0 on cells and at points
    (AllDirections=True adds Direction1, ...), SingularityIndex on cells (at points for other discretisations and with
    singularities), and more (see vtkHarmonicFieldSolver, output port 0).

    Raises TypeError for arguments that do not exist or are of another type, FieldError for values out of range and for what
    the filter refuses; warns with FieldWarning.
    """
    _check_mesh(mesh)
    solver = vtkHarmonicFieldSolver()
    solver.SetInputData(mesh)
    for each in _datasets(guides, "guides"):
        solver.AddInputDataObject(1, each)
    if singularities is not None:
        for each in _datasets(singularities, "singularities") or (vtkPolyData(),):
            solver.AddInputDataObject(2, each)
    _set_properties(solver, {name: value for name, value in properties.items() if name not in _ARRAYS}, _ARGUMENTS,
                    {"numberofdirections": "n", "directionsperpoint": "n"})
    _set_number_of_directions(solver, n)
    for name, index in _ARRAYS.items():
        _choose_array(solver, mesh, index, properties.get(name))
    result = type(mesh)()
    result.ShallowCopy(_update(solver, 3))
    return result


def _check_mesh(mesh: Any) -> None:
    _check_vtk(mesh, "the mesh")
    if not isinstance(mesh, vtkDataSet):
        raise TypeError(f"the mesh is of type {type(mesh).__name__}, which is no vtkDataSet; call the function for each of its "
                        "blocks, or use the filter")
    if mesh.GetNumberOfCells() == 0:
        raise FieldError("the mesh has no cells, so there is no surface; give it triangles, by vtkDelaunay2D for instance")


def _check_vtk(item: Any, name: str) -> None:
    """A process may have loaded two builds of VTK, whose classes have the same names and are strangers to each other."""
    classes = {each.__name__ for each in type(item).__mro__}
    if "vtkObjectBase" in classes and not isinstance(item, vtkObjectBase):
        raise TypeError(f"{name} belongs to another VTK than this package, which was built for VTK "
                        f"{vtkVersion.GetVTKVersion()}; use the Python modules of that VTK, or copy points and cells by numpy")


def update(algorithm: vtkAlgorithm) -> Optional[vtkDataObject]:
    """Updates a filter, one of this package or any other, and what stands before it in the pipeline.

    Returns its first output, or None if it has none. Raises FieldError where one of them reports an error, which would else be
    a line on standard error and an empty output; warns with FieldWarning. A filter that has failed runs again at the next call. A
    failure in an earlier Update() is not reported again by VTK, unless something has changed since.
    """
    _check_vtk(algorithm, "the filter")
    if not isinstance(algorithm, vtkAlgorithm):
        raise TypeError(f"an object of type {type(algorithm).__name__} is no VTK filter")
    return _update(algorithm, 3)


def _update(algorithm: vtkAlgorithm, stacklevel: int) -> Optional[vtkDataObject]:
    errors: List[Message] = []
    failures: List[Message] = []  # messages of executives, mostly on errors that their filter has reported
    warned: List[Message] = []
    observed = []
    for each in _pipeline(algorithm):
        for source, heard in ((each, errors), (each.GetExecutive(), failures)):
            observed.append((source, source.AddObserver("ErrorEvent", _listener(each, heard))))
            observed.append((source, source.AddObserver("WarningEvent", _listener(each, warned))))
    try:
        algorithm.Update()
    finally:
        for source, tag in observed:
            source.RemoveObserver(tag)
    for _, text in warned:
        warnings.warn(text, FieldWarning, stacklevel=stacklevel)
    if errors or failures:
        for failed, _ in errors + failures:
            failed.Modified()  # else the next update would take the empty output for its result
        texts = [text for _, text in errors] or [_reason(failed, text, warned) for failed, text in failures]
        raise FieldError("\n".join(dict.fromkeys(texts)))
    return algorithm.GetOutputDataObject(0) if algorithm.GetNumberOfOutputPorts() else None


def _reason(algorithm: vtkAlgorithm, text: str, warned: List[Message]) -> str:
    """The reason of a failure: the message of the executive or, if it only says that a filter failed, the filter's warnings."""
    if "returned failure for request" not in text:
        return text
    name = getattr(algorithm, "GetFileName", str)()
    reasons = [reason for each, reason in warned if each is algorithm] or ["it does not say why"]
    return f"{algorithm.GetClassName()} failed" + (f" on {name!r}" if name else "") + ": " + "; ".join(reasons)


def _pipeline(algorithm: vtkAlgorithm) -> Iterable[vtkAlgorithm]:
    """The algorithm and all upstream of it."""
    found = [algorithm]
    for each in found:  # it grows
        for port in range(each.GetNumberOfInputPorts()):
            for connection in range(each.GetNumberOfInputConnections(port)):
                producer = each.GetInputConnection(port, connection).GetProducer()
                if producer not in found:
                    found.append(producer)
    return found


def _listener(algorithm: vtkAlgorithm, messages: List[Message]) -> Callable[[Any, str, str], None]:
    def listen(_source: Any, _event: str, text: str) -> None:
        # "ERROR: In file, line 7", then "vtkClass (0x123): message"
        messages.append((algorithm, re.sub(r"\A\w+: In .*, line \d+\n\w+ \(.*?\): ", "", text).strip()))

    listen.CallDataType = "string0"  # type: ignore[attr-defined]
    return listen


def _datasets(objects: DataObjects, what: str) -> Tuple[vtkDataObject, ...]:
    if objects is None:
        return ()
    if isinstance(objects, vtkDataObject):
        return (objects,)  # composite datasets are sequences, too
    if not isinstance(objects, Iterable):
        objects = (objects,)
    datasets = tuple(objects)
    for each in datasets:
        _check_vtk(each, f"one of the {what}")
        if not isinstance(each, vtkDataObject):
            raise TypeError(f"{what} are datasets; an object of type {type(each).__name__} is none")
    return datasets


def _set_properties(algorithm: vtkAlgorithm, properties: Dict[str, Property], arguments: Sequence[str],
                    other_names: Dict[str, str] = {}) -> None:
    """Sets properties of a filter by their names, but for those that an argument of the function stands for.

    other_names maps further names of arguments, in small letters, to these.
    """
    known = sorted(name for name in _properties_of(algorithm) if name.lower() not in (*arguments, *other_names))
    for name, value in properties.items():
        if name not in known:
            raise TypeError(f"there is no property {_short(name)[1:-1]}; " + _nearest(name, [*known, *arguments], other_names))
        _set_property(algorithm, name, value)


def _properties_of(algorithm: vtkAlgorithm) -> Set[str]:
    """What a filter and its base classes in this package can set and get."""
    classes = [each for each in type(algorithm).__mro__ if each.__module__ == type(algorithm).__module__]
    return {name[3:] for each in classes for name in vars(each) if name.startswith("Set") and hasattr(algorithm, "Get" + name[3:])}


def _nearest(name: str, names: Sequence[str], other_names: Dict[str, str]) -> str:
    """A hint at the property or argument with the nearest name, in any spelling: max_distance for MaximumDistance, N for n."""
    spellings = {**{each.replace("_", "").lower(): each for each in names}, **other_names}
    near = difflib.get_close_matches(name.replace("_", "").lower(), spellings, 1, 0.5)
    return f"did you mean {spellings[near[0]]}?" if near else "there are " + ", ".join(names)


def _set_number_of_directions(solver: vtkHarmonicFieldSolver, n: Optional[int]) -> None:
    is_power_field = solver.GetDiscretisation() in (solver.PowerField, solver.PointPowerField)
    if n is None:
        n = 4 if is_power_field else 1
    _set_property(solver, "NumberOfDirections", n)
    if n != 1 and not is_power_field:
        raise FieldError(f"n = {n}, but only power fields have more than 1 direction per point")


def _set_property(solver: vtkHarmonicFieldSolver, name: str, value: Property) -> None:
    # Discretisation has the values of the enumeration Discretisations, CoarseSpace those of CoarseSpaces.
    choices = {key: item for key, item in vars(type(solver)).items()
               if isinstance(item, int) and type(item).__name__.startswith(name.rstrip("s"))}
    if choices and isinstance(value, str):
        if value not in choices:
            raise FieldError(f"{name} is not {_short(value)} but one of {', '.join(choices)}")
        value = choices[value]
    try:
        getattr(solver, "Set" + name)(_converted(value, type(getattr(solver, "Get" + name)())))
    except TypeError as error:
        raise TypeError(f"{name} = {_short(value)}: {error}") from None
    except OverflowError:
        raise FieldError(f"{name} = {_short(value)} is out of range") from None


def _converted(value: Any, kind: type) -> Property:
    """The value in the type of the property. The wrapping would take NaN, None for an empty name, and any object for a bool."""
    if kind is bool:
        if not hasattr(value, "__bool__") or getattr(value, "ndim", 0) or value not in (False, True):
            raise TypeError("it is True or False")
        return bool(value)
    if kind is tuple:
        if isinstance(value, (str, bytes)) or not isinstance(value, Iterable) or len(numbers_of := tuple(value)) != 3:
            raise TypeError("it is a vector of three numbers")
        return tuple(_converted(each, float) for each in numbers_of)
    if kind is str:
        if not isinstance(value, str):
            raise TypeError("it is the name of an array")
        return value
    if isinstance(value, bool) or not isinstance(value, numbers.Integral if kind is int else numbers.Real):
        raise TypeError("it is an integer" if kind is int else "it is a number")
    if kind is int:
        return operator.index(value)
    if not math.isfinite(value):
        raise OverflowError
    return float(value)


def _choose_array(solver: vtkHarmonicFieldSolver, mesh: vtkDataSet, index: int, name: Optional[Property]) -> None:
    points, cells = vtkDataObject.FIELD_ASSOCIATION_POINTS, vtkDataObject.FIELD_ASSOCIATION_CELLS
    if name is None:
        solver.SetInputArrayToProcess(index, 0, 0, points, "")
        return
    if not isinstance(name, str):
        raise TypeError(f"{_short(name)} is no name of an array")
    for association, attributes in ((points, mesh.GetPointData()), (cells, mesh.GetCellData())):
        if attributes.HasArray(name):
            solver.SetInputArrayToProcess(index, 0, 0, association, name)
            return
    there = dict.fromkeys(attributes.GetArrayName(i) for attributes in (mesh.GetPointData(), mesh.GetCellData())
                          for i in range(attributes.GetNumberOfArrays()))
    raise FieldError(f"the mesh has no array {_short(name)}; it has {', '.join(map(_short, there)) or 'none'}")


def _short(value: Any) -> str:
    """A value as messages say it: names that are longer than 100 characters are cut."""
    text = repr(value)
    return text if len(text) <= 102 or isinstance(value, numbers.Number) else text[:100] + "..." + text[-1]
