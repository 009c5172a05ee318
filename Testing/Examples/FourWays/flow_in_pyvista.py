"""The parts of a flow, with PyVista: python3 flow_in_pyvista.py SURFACE.ply OUTPUT.txt"""

import sys

import numpy as np
import pyvista

from directionalmultigrid import hodge

if len(sys.argv) != 3:
    sys.exit(__doc__)
surface = pyvista.read(sys.argv[1])
flow = np.zeros((surface.n_cells, 3))  # along two triangles only
flow[0] = 1, 0, 0
flow[1000] = 1, 1, 1
surface.cell_data["Flow"] = flow

parts = hodge(surface, "Flow").cell_data  # or surface.directional.hodge("Flow"), since PyVista 0.48
np.savetxt(sys.argv[2], np.hstack([parts["GradientPart"], parts["RotationalPart"]]))
