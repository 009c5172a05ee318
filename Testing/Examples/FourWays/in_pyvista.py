"""Crosses that follow two directions, with PyVista: python3 in_pyvista.py SURFACE.ply OUTPUT.txt"""

import sys

import numpy as np
import pyvista

from directionalmultigrid.vtkFiltersDirectionalFields import vtkHarmonicFieldSolver

if len(sys.argv) != 3:
    sys.exit(__doc__)
surface = pyvista.read(sys.argv[1])
directions = np.zeros((surface.n_cells, 3))  # zero where nothing is prescribed
directions[0] = 1, 0, 0
directions[1000] = 1, 1, 1
surface.cell_data["Directions"] = directions

solver = vtkHarmonicFieldSolver()
solver.SetInputData(surface)
solver.SetInputArrayToProcess(1, 0, 0, 1, "Directions")  # of cells
solver.SetNumberOfDirections(4)
solver.SetTolerance(1e-10)
solver.Update()

field = pyvista.wrap(solver.GetOutput())
if not field.n_cells:
    sys.exit("no field; what VTK has printed tells why")
np.savetxt(sys.argv[2], field.cell_data["Direction0"])
