"""mesh.directional on meshes of PyVista 0.48 and later, which imports this module when it is first used."""

from __future__ import annotations

from typing import Any, Optional

import pyvista

from .distances import Place, distance, shortest_path
from .drawing import draw_as_ink
from .export import write_raw_field, write_rosy, write_sharp
from .fields import DataObjects, Property, _set_properties, smooth_field, update
from .flows import hodge
from .geodesics import transport
from .scales import scale_filter, spectrum
from .vtkFiltersDirectionalFields import vtkFieldLines


@pyvista.register_dataset_accessor("directional", pyvista.PolyData)
class DirectionalAccessor:
    """The functions of directionalmultigrid, with the mesh as their first argument."""

    def __init__(self, mesh: pyvista.PolyData) -> None:
        self._mesh = mesh

    def smooth_field(self, guides: DataObjects = None, n: Optional[int] = None, **arguments: Any) -> pyvista.PolyData:
        """A new mesh with the smoothest field of n directions; see directionalmultigrid.smooth_field."""
        return smooth_field(self._mesh, guides, n, **arguments)

    def cross_field(self, guides: DataObjects = None, **arguments: Any) -> pyvista.PolyData:
        """A new mesh with the smoothest field of crosses; see directionalmultigrid.smooth_field."""
        return smooth_field(self._mesh, guides, 4, **arguments)

    def hodge(self, vectors: Optional[str] = None, **arguments: Any) -> pyvista.PolyData:
        """A new mesh with the parts of a flow; see directionalmultigrid.hodge."""
        return hodge(self._mesh, vectors, **arguments)

    def scale_filter(self, arrays: Any = None, wavelengths: Any = None, **arguments: Any) -> pyvista.PolyData:
        """A new mesh with arrays below and above wavelengths; see directionalmultigrid.scale_filter."""
        return scale_filter(self._mesh, arrays, wavelengths, **arguments)

    def spectrum(self, arrays: Any = None, **arguments: Any) -> pyvista.Table:
        """A table of the energy of arrays by wavelength; see directionalmultigrid.spectrum."""
        return pyvista.wrap(spectrum(self._mesh, arrays, **arguments))

    def transport(self, vectors: Optional[str] = None, **arguments: Any) -> pyvista.PolyData:
        """A new mesh with vectors carried along shortest paths; see directionalmultigrid.transport."""
        return transport(self._mesh, vectors, **arguments)

    def distance(self, sources: DataObjects = None, **arguments: Any) -> pyvista.PolyData:
        """A new mesh with distances along it from anything; see directionalmultigrid.distance."""
        return distance(self._mesh, sources, **arguments)

    def shortest_path(self, a: Place, b: Place, **arguments: Any) -> pyvista.PolyData:
        """The shortest path over the mesh from a to b; see directionalmultigrid.shortest_path."""
        return shortest_path(self._mesh, a, b, **arguments)

    def add_lines(self, plotter: Any, *, color: Any = "navy", line_width: float = 3, **properties: Property) -> Any:
        """Adds evenly spaced lines along the field of this mesh to a plotter, as ink, which shows from both sides; returns their actor.

        properties are those of vtkFieldLines by name, as SeparatingDistance=0.03.
        """
        lines, mesh = vtkFieldLines(), type(self._mesh)()
        lines.SetInputData(self._mesh)
        _set_properties(lines, properties, ("plotter", "color", "line_width"))
        mesh.ShallowCopy(update(lines))
        return draw_as_ink(plotter.add_mesh(mesh, color=color, line_width=line_width))

    def write_rosy(self, path: Any) -> None:
        """Writes the field of this mesh; see directionalmultigrid.write_rosy."""
        write_rosy(path, self._mesh)

    def write_sharp(self, path: Any, feature_angle: float = 30.0) -> None:
        """Writes the features of this mesh; see directionalmultigrid.write_sharp."""
        write_sharp(path, self._mesh, feature_angle)

    def write_raw_field(self, path: Any) -> None:
        """Writes the field of this mesh; see directionalmultigrid.write_raw_field."""
        write_raw_field(path, self._mesh)
