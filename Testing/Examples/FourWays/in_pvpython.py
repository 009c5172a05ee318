"""Crosses that follow two directions: pvpython in_pvpython.py SURFACE.ply OUTPUT.txt"""

import sys

import numpy as np
from paraview.simple import *
from vtkmodules.util.numpy_support import vtk_to_numpy

if len(sys.argv) != 3:
    sys.exit(__doc__)
surface = PLYReader(FileNames=[sys.argv[1]])
try:
    PointAndCellIds
except NameError:  # until ParaView 6.0
    PointAndCellIds = GenerateIds
numbered = PointAndCellIds(Input=surface, CellIdsArrayName="Face")
directions = Calculator(Input=numbered, AttributeType="Cell Data", ResultArrayName="Directions",
                        Function="if(Face == 0, 1, 0) * iHat + if(Face == 1000, 1, 0) * (iHat + jHat + kHat)")
field = HarmonicFieldSolver(Input=directions, Directions=["CELLS", "Directions"], NumberOfDirections=4, Tolerance=1e-10)

result = servermanager.Fetch(field)
if not result.GetNumberOfCells():
    sys.exit("no field; what ParaView has printed tells why")
np.savetxt(sys.argv[2], vtk_to_numpy(result.GetCellData().GetArray("Direction0")))
