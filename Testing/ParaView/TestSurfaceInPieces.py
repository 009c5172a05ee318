"""On several ranks, a source that makes pieces: the field is that of the whole surface, closed, without a warning.

    TestSurfaceInPieces.py
"""

import paraview.simple as simple
from paraview.modules.vtkRemotingCore import vtkProcessModule
from vtkmodules.vtkCommonCore import vtkDoubleArray
from vtkmodules.vtkParallelCore import vtkCommunicator, vtkMultiProcessController

THETA, PHI = 64, 32
PROCESS = vtkProcessModule.GetProcessModule()


def number(here):
    """Over all ranks; with --symmetric, each comes here and knows its own."""
    if not PROCESS.GetSymmetricMPIMode():
        return here
    one, total = vtkDoubleArray(), vtkDoubleArray()
    one.InsertNextValue(here)
    vtkMultiProcessController.GetGlobalController().AllReduce(one, total, vtkCommunicator.SUM_OP)
    return total.GetValue(0)


def update(source):
    """The information on each output, and its cells on all ranks."""
    source.UpdatePipeline()
    outputs = [source.SMProxy.GetDataInformation(port) for port in range(source.SMProxy.GetNumberOfOutputPorts())]
    return outputs, [number(output.GetNumberOfCells()) for output in outputs]


def was_gathered(output):
    return number(output.GetFieldDataInformation().GetArrayInformation("Gathered") is not None) > 0


sphere = simple.Sphere(ThetaResolution=THETA, PhiResolution=PHI)
field = simple.DirectionalField(Input=sphere)
outputs, (surface, lines, spheres, paths) = update(field)
assert surface == 2 * THETA * (PHI - 2), surface
assert was_gathered(outputs[0]) != was_gathered(outputs[1]), "the surface, or its lines where it stays in pieces"
assert lines > 50 and spheres > 0 and paths == 0, (lines, spheres, paths)

# The pipeline goes on, and on again with other properties.
glyphs = simple.FieldGlyphs(Input=simple.OutputPort(field, 0))
assert update(glyphs)[1][0] > 100
field.NumberOfDirections = 2
assert update(glyphs)[1][0] > 100
singularities = simple.FieldSingularities(Input=simple.OutputPort(field, 0))
points, cuts, loops, spheres = update(singularities)[1]
assert points > 0 and loops == 0, (points, loops)  # a seam would be a boundary

# A volume in pieces: its skin is that of the whole, without sides between pieces.
block = simple.AppendDatasets(Input=[simple.Wavelet(WholeExtent=[0, 6, 0, 6, 0, 6])])
field = simple.DirectionalField(Input=block)
outputs, (skin, lines, *_) = update(field)
assert skin == 6 * 6 * 6 and lines > 5 and was_gathered(outputs[0]), (skin, lines)
singularities = simple.FieldSingularities(Input=simple.OutputPort(field, 0))
assert update(singularities)[1][2] == 0  # no boundary
