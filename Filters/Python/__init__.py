"""Smooth directional fields on triangle surfaces.

smooth_field()                        a field by one call, errors as exceptions
hodge()                               stream function, potential and parts of a flow
quads()                               a mesh of quads along a cross field
scale_filter(), spectrum()            functions and flows below and above a wavelength, and their energy by wavelength
transport()                           vectors along shortest paths, and polar coordinates around a point
distance(), shortest_path()           distances along a surface from anything, and shortest paths
draw_as_ink()                         shows lines and glyphs that lie in a surface, from both sides of it
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
    from .distances import distance, shortest_path
    from .drawing import draw_as_ink
    from .export import write_raw_field, write_rosy, write_sharp
    from .fields import FieldError, FieldWarning, smooth_field, update
    from .flows import hodge
    from .geodesics import transport
    from .meshes import quads
    from .scales import scale_filter, spectrum

__all__ = [
    "FieldError", "FieldWarning", "distance", "draw_as_ink", "hodge", "quads", "scale_filter", "shortest_path", "smooth_field", "spectrum",
    "transport", "update",
    "write_raw_field", "write_rosy", "write_sharp", "vtkFiltersDirectionalFields",
]


def __getattr__(name: str) -> Any:
    if name not in __all__:
        raise AttributeError(f"module {__name__!r} has no attribute {name!r}")
    if name == "vtkFiltersDirectionalFields":
        return import_module("." + name, __name__)
    modules = {"distance": "distances", "draw_as_ink": "drawing", "hodge": "flows", "quads": "meshes", "scale_filter": "scales",
               "shortest_path": "distances", "spectrum": "scales",
               "transport": "geodesics"}
    module = "export" if name.startswith("write_") else modules.get(name, "fields")
    return getattr(import_module("." + module, __name__), name)


def __dir__() -> List[str]:
    return sorted(__all__)
