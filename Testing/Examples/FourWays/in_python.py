"""Crosses that follow two directions, with VTK's modules: python3 in_python.py SURFACE.ply OUTPUT.txt"""

import sys

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkDataObject
from vtkmodules.vtkIOPLY import vtkPLYReader

from directionalmultigrid.vtkFiltersDirectionalFields import vtkHarmonicFieldSolver

if len(sys.argv) != 3:
    sys.exit(__doc__)
reader = vtkPLYReader()
reader.SetFileName(sys.argv[1])
reader.Update()
surface = reader.GetOutput()

directions = np.zeros((surface.GetNumberOfCells(), 3))  # zero where nothing is prescribed
directions[0] = 1, 0, 0
directions[1000] = 1, 1, 1
array = numpy_to_vtk(directions, deep=True)
array.SetName("Directions")
surface.GetCellData().AddArray(array)

solver = vtkHarmonicFieldSolver()
solver.SetInputData(surface)
solver.SetInputArrayToProcess(1, 0, 0, vtkDataObject.FIELD_ASSOCIATION_CELLS, "Directions")
solver.SetNumberOfDirections(4)
solver.SetTolerance(1e-10)
solver.Update()

field = solver.GetOutput()
if not field.GetNumberOfCells():
    sys.exit("no field; what VTK has printed tells why")
np.savetxt(sys.argv[2], vtk_to_numpy(field.GetCellData().GetArray("Direction0")))
