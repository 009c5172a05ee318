"""Smooth directional fields on triangle surfaces.

smooth_field()                        a field by one call, errors as exceptions
update()                              runs any VTK filter, errors as exceptions
write_rosy(), write_sharp(),
write_raw_field()                     files for remeshers
directionalmultigrid.vtkFiltersDirectionalFields   the filters themselves

Nothing is loaded before it is used.
"""

from __future__ import annotations

from importlib import import_module
from typing import TYPE_CHECKING, Any, List

if TYPE_CHECKING:
    from .export import write_raw_field, write_rosy, write_sharp
    from .fields import FieldError, FieldWarning, smooth_field, update

_MODULES = {
    "FieldError": "fields",
    "FieldWarning": "fields",
    "smooth_field": "fields",
    "update": "fields",
    "write_raw_field": "export",
    "write_rosy": "export",
    "write_sharp": "export",
}

__all__ = [
    "FieldError", "FieldWarning", "smooth_field", "update", "write_raw_field", "write_rosy", "write_sharp",
    "vtkFiltersDirectionalFields",
]


def __getattr__(name: str) -> Any:
    if name == "vtkFiltersDirectionalFields":
        return import_module("." + name, __name__)
    if name not in _MODULES:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    return getattr(import_module("." + _MODULES[name], __name__), name)


def __dir__() -> List[str]:
    return sorted(__all__)
