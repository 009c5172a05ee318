"""Functions and flows by wavelength, by one call."""

from __future__ import annotations

from typing import Dict, Optional, Sequence, Tuple, TypeVar, Union

from vtkmodules.vtkCommonDataModel import vtkDataSet, vtkTable

from .fields import FieldError, Property, _check_mesh, _choose_array, _converted, _set_properties, _short, _update
from .vtkFiltersDirectionalFields import vtkScaleFilter

Mesh = TypeVar("Mesh", bound=vtkDataSet)
Names = Union[str, Sequence[str], None]


def scale_filter(mesh: Mesh, arrays: Names = None, wavelengths: Union[float, Sequence[float], None] = None, *,
                 eastward: Optional[str] = None, northward: Optional[str] = None, relative_wavelengths: Optional[str] = None,
                 **properties: Property) -> Mesh:
    """What of functions and flows on a surface is larger than a wavelength, and what is smaller.

    mesh                 a surface: any vtkDataSet with cells of two dimensions, or an object of a class derived from one, as
                         pyvista.PolyData. It is not changed.
    arrays               the name of an array at points, else on cells, or several: numbers are functions, vectors are flows; by default the
                         active scalars and vectors
    wavelengths          one or several, in the unit of the points times LengthScale; by default one of ten mean edges. A wave of that length
                         keeps 1/3 of its amplitude.
    eastward, northward  names of two arrays of numbers, a flow around the origin with Axis to the north, or on flat maps with
                         Coordinates="LongitudeAndLatitude"; its results are called Flow
    relative_wavelengths the name of an array of positive numbers: at each point, wavelengths are so many times those asked for, which are then 1
                         by default
    properties           properties of vtkScaleFilter by name, as Order=1, LengthScale=6371; values of enumerations may be names, as
                         FlowKind="Wholes"

    Returns a mesh of the same class, which has the arrays of the input and for each of these, as "ssh" at a wavelength of 200, "ssh below
    200" and "ssh above 200", which sum to it; in its field data means before and after, Converged and Iterations.

    NaN is land: such cells take no part, and are NaN in the result.

    Raises TypeError for arguments that do not exist or are of another type, FieldError for values out of range and for what the
    filter refuses; warns with FieldWarning.
    """
    scales = _scale_filter(mesh, arrays, (eastward, northward, relative_wavelengths), {"Spectrum": False, **properties}, ("wavelengths",))
    _set_wavelengths(scales, wavelengths)
    result = type(mesh)()
    result.ShallowCopy(_update(scales, 3))
    return result


def spectrum(mesh: vtkDataSet, arrays: Names = None, *, eastward: Optional[str] = None, northward: Optional[str] = None,
             relative_wavelengths: Optional[str] = None, **properties: Property) -> vtkTable:
    """The energy of functions and flows on a surface by wavelength.

    properties  properties of vtkScaleFilter by name: SpectrumFrom and SpectrumTo, the shortest and the longest wavelength, SpectrumRows, and
                so on

    All else is as for scale_filter. Returns a table with a row for each wavelength: the columns Wavelength and Wavenumber and, as for "ssh",
    "ssh per octave", "ssh per wavenumber", "ssh in band", whose rows sum to the variance, and "ssh above".
    """
    scales = _scale_filter(mesh, arrays, (eastward, northward, relative_wavelengths), properties, ("spectrum",))
    scales.SpectrumOn()
    _update(scales, 3)
    table = vtkTable()
    table.ShallowCopy(scales.GetOutputDataObject(1))
    return table


def _scale_filter(mesh: vtkDataSet, arrays: Names, choices: Tuple[Optional[str], ...], properties: Dict[str, Property],
                  others: Sequence[str]) -> vtkScaleFilter:
    _check_mesh(mesh)
    scales = vtkScaleFilter()
    scales.SetInputData(mesh)
    _set_properties(scales, properties, ("mesh", "arrays", "eastward", "northward", "relative_wavelengths", *others),
                    {"u": "eastward", "v": "northward", "wavelength": "wavelengths"})
    for name in () if arrays is None else arrays if isinstance(arrays, (list, tuple)) else (arrays,):
        if not isinstance(name, str):
            raise TypeError(f"{_short(name)} is no name of an array")
        scales.AddArray(name)
    for index, name in enumerate(choices, 1):
        if name is not None:
            _choose_array(scales, mesh, index, name)
    return scales


def _set_wavelengths(scales: vtkScaleFilter, wavelengths: Union[float, Sequence[float], None]) -> None:
    if wavelengths is None:
        return
    several = wavelengths if hasattr(wavelengths, "__iter__") and not isinstance(wavelengths, str) else (wavelengths,)
    for wavelength in several:
        try:
            scales.AddWavelength(_converted(wavelength, float))
        except TypeError as error:
            raise TypeError(f"wavelengths = {_short(wavelengths)}: {error}") from None
        except OverflowError:
            raise FieldError(f"wavelengths = {_short(wavelengths)} is out of range") from None
