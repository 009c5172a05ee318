"""On several ranks, a source that makes pieces: the field is that of the whole surface, closed, without a warning.

    TestSurfaceInPieces.py
"""

import paraview.simple as simple
from paraview.modules.vtkRemotingCore import vtkProcessModule

THETA, PHI = 64, 32
IS_FIRST = vtkProcessModule.GetProcessModule().GetPartitionId() == 0  # with --symmetric, all ranks come here


def update(filter):
    """The data of each output, as the first rank has them."""
    filter.UpdatePipeline()
    return [filter.SMProxy.GetDataInformation(port) for port in range(filter.SMProxy.GetNumberOfOutputPorts())]


def check(condition, text):
    assert condition or not IS_FIRST, text


field = simple.DirectionalField(Input=simple.Sphere(ThetaResolution=THETA, PhiResolution=PHI))
surface, lines, spheres = update(field)
check(surface.GetNumberOfCells() == 2 * THETA * (PHI - 2), surface.GetNumberOfCells())
check(surface.GetNumberOfPoints() == THETA * (PHI - 2) + 2, surface.GetNumberOfPoints())
check(surface.GetFieldDataInformation().GetArrayInformation("Gathered"), "nothing says that the surface was gathered")
check(lines.GetNumberOfCells() > 100, "no lines")
check(spheres.GetNumberOfCells() > 0, "no singularities")

# The pipeline goes on, and on again with other properties.
glyphs = simple.FieldGlyphs(Input=simple.OutputPort(field, 0))
check(update(glyphs)[0].GetNumberOfCells() > 100, "no glyphs")
field.NumberOfDirections = 2
check(update(glyphs)[0].GetNumberOfCells() > 100, "no glyphs of two directions")
