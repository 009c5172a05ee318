"""Hodge decompositions of flows by one call."""

from __future__ import annotations

from typing import Optional, TypeVar

from vtkmodules.vtkCommonDataModel import vtkDataObject, vtkDataSet, vtkDataSetAttributes

from .fields import Property, _check_mesh, _choose_array, _datasets, _set_properties, _update
from .vtkFiltersDirectionalFields import vtkHodgeDecomposition

Mesh = TypeVar("Mesh", bound=vtkDataSet)


def hodge(mesh: Mesh, vectors: Optional[str] = None, *, eastward: Optional[str] = None, northward: Optional[str] = None,
          edges: Optional[vtkDataSet] = None, open_boundary: Optional[str] = None, **properties: Property) -> Mesh:
    """A flow on a surface as the sum of a gradient part, a rotational part, a harmonic part and a residual.

    mesh                 a surface: any vtkDataSet with cells of two dimensions, or an object of a class derived from one, as
                         pyvista.PolyData. It is not changed.
    vectors              the name of an array of vectors at points, else on cells; by default the active vectors of points, else of
                         cells
    eastward, northward  names of two arrays of numbers instead, for surfaces around the origin with Axis to the north, or
                         for flat maps with Coordinates="LongitudeAndLatitude"
    edges                the flow as a 1-form instead: a dataset with a line for each edge of the mesh, and a number for each in its
                         cell array OneForm, or that which EdgeArray names; EdgeValues="Components" where these are velocities along
                         the lines and not their integrals
    open_boundary        the name of an array of numbers at points, else on cells: the boundary is open between two points, or along the
                         cells, where it is neither 0 nor NaN, and closed elsewhere; by default all of it is as Boundary says
    properties           properties of vtkHodgeDecomposition by name, as LengthScale=6371000; values of enumerations may be names,
                         as Boundary="Open", or switches, as SteeringFlow=True

    Returns a mesh of the same class, which has the arrays of the input and GradientPart, RotationalPart, HarmonicPart and Residual on
    cells and at points; Potential, StreamFunction, Divergence and Vorticity at points; in its field data energies and, for each
    boundary, circulation, flux and stream function (see vtkHodgeDecomposition).

    NaN is no flow: such cells take no part, and are NaN in the result. Counter-clockwise is positive, as seen from outside, from +z
    in a plane of constant z, from the convex side of tubes and domes, else from the side of the cells.

    Raises TypeError for arguments that do not exist or are of another type, FieldError for values out of range and for what the
    filter refuses; warns with FieldWarning.
    """
    _check_mesh(mesh)
    decomposition = vtkHodgeDecomposition()
    decomposition.SetInputData(mesh)
    if edges is not None:
        (lines,) = _datasets(edges, "edges")
        decomposition.SetInputDataObject(1, lines)
    _set_properties(decomposition, properties, ("mesh", "vectors", "eastward", "northward", "edges", "open_boundary"),
                    {"u": "eastward", "v": "northward"})
    for index, name in ((0, vectors), (1, eastward), (2, northward), (3, open_boundary)):
        _choose_array(decomposition, mesh, index, name)
    if vectors is None:
        decomposition.SetInputArrayToProcess(0, 0, 0, vtkDataObject.FIELD_ASSOCIATION_POINTS_THEN_CELLS, vtkDataSetAttributes.VECTORS)
    result = type(mesh)()
    result.ShallowCopy(_update(decomposition, 3))
    return result
