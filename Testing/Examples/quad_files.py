"""Crosses along the features of a part, and the files with which remeshers make quads of it.

    quad_files.py [part.ply]

writes part.ply, part.rosy, part.sharp and part.rawfield into the current folder. Without a file the part is a cube.
"""

import sys
import warnings

from vtkmodules.vtkFiltersCore import vtkCleanPolyData, vtkTriangleFilter
from vtkmodules.vtkFiltersModeling import vtkLinearSubdivisionFilter
from vtkmodules.vtkFiltersSources import vtkCubeSource
from vtkmodules.vtkIOPLY import vtkPLYReader, vtkPLYWriter

from directionalmultigrid import smooth_field, update, write_raw_field, write_rosy, write_sharp


def cube():
    """12 * 4^4 triangles."""
    source, triangles, clean = vtkCubeSource(), vtkTriangleFilter(), vtkCleanPolyData()
    triangles.SetInputConnection(source.GetOutputPort())
    clean.SetInputConnection(triangles.GetOutputPort())
    fine = vtkLinearSubdivisionFilter()
    fine.SetNumberOfSubdivisions(4)
    fine.SetInputConnection(clean.GetOutputPort())
    return update(fine)


def read(name):
    reader = vtkPLYReader()
    reader.SetFileName(name)
    return update(reader)


warnings.filterwarnings("ignore", "the surface has no boundary")  # as the cube
part = read(sys.argv[1]) if len(sys.argv) > 1 else cube()
crosses = smooth_field(part, BoundaryWeight=1, SharpEdgesWeight=1, CurvatureWeight=0.3)
writer = vtkPLYWriter()
writer.SetFileName("part.ply")
writer.SetInputData(part)
writer.Write()
write_rosy("part.rosy", crosses)
write_sharp("part.sharp", crosses)
write_raw_field("part.rawfield", crosses)
print(f"wrote part.ply, part.rosy, part.sharp and part.rawfield: {part.GetNumberOfCells()} faces")
