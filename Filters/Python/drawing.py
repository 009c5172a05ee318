"""Drawings on surfaces, in plain VTK and PyVista."""

from __future__ import annotations

from typing import Any, TypeVar

from .fields import _check_vtk
from .vtkFiltersDirectionalFields import vtkFieldLines

Actor = TypeVar("Actor", bound=Any)  # not vtkActor, whose module loads what draws


def draw_as_ink(actor: Actor) -> Actor:
    """Draws an actor as ParaView's representation Ink does: nearer to the viewer, by two thousandths of its distance.

    Lines, glyphs and contours that lie in a surface (those of this package do, as their Lift is 0) then show from both sides of it,
    without flickering, and in the same colour, as they are not lit. Returns the actor, for plotter.add_mesh(...) of PyVista in one line.
    """
    _check_vtk(actor, "the actor")
    if not hasattr(actor, "GetShaderProperty"):
        raise TypeError(f"the actor is of type {type(actor).__name__}, which is no vtkActor")
    actor.GetProperty().LightingOff()
    actor.GetShaderProperty().AddVertexShaderReplacement("//VTK::PositionVC::Impl", True, vtkFieldLines.GetInkShader(), False)
    return actor
