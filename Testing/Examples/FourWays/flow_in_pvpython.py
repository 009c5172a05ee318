"""The parts of a flow: pvpython flow_in_pvpython.py SURFACE.ply OUTPUT.txt"""

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
flow = Calculator(Input=numbered, AttributeType="Cell Data", ResultArrayName="Flow",  # along two triangles only
                  Function="if(Face == 0, 1, 0) * iHat + if(Face == 1000, 1, 0) * (iHat + jHat + kHat)")
parts = servermanager.Fetch(HodgeDecomposition(Input=flow, Vectors=["CELLS", "Flow"]), idx=0).GetCellData()
if not parts.HasArray("GradientPart"):
    sys.exit("no parts; what ParaView has printed tells why")
np.savetxt(sys.argv[2], np.hstack([vtk_to_numpy(parts.GetArray(name)) for name in ("GradientPart", "RotationalPart")]))
