"""The parts of a flow, with VTK's modules: python3 flow_in_python.py SURFACE.ply OUTPUT.txt"""

import sys

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkIOPLY import vtkPLYReader

from directionalmultigrid import hodge

if len(sys.argv) != 3:
    sys.exit(__doc__)
reader = vtkPLYReader()
reader.SetFileName(sys.argv[1])
reader.Update()
surface = reader.GetOutput()

flow = np.zeros((surface.GetNumberOfCells(), 3))  # along two triangles only
flow[0] = 1, 0, 0
flow[1000] = 1, 1, 1
array = numpy_to_vtk(flow, deep=True)
array.SetName("Flow")
surface.GetCellData().AddArray(array)

parts = hodge(surface, "Flow").GetCellData()
np.savetxt(sys.argv[2], np.hstack([vtk_to_numpy(parts.GetArray(name)) for name in ("GradientPart", "RotationalPart")]))
