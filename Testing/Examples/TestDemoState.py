"""What demo.pvsm shows in ParaView's window: the surface of demo.vtp, blue lines on it, and balls in the colours of their signs.

    pvpython TestDemoState.py

in the folder where the demo has run.
"""

import numpy as np
from paraview.simple import *
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkPNGReader

LoadState("demo.pvsm")
SaveScreenshot("demo-state.png", GetActiveView(), ImageResolution=[600, 525])
reader = vtkPNGReader()
reader.SetFileName("demo-state.png")
reader.Update()
red, green, blue = vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars())[:, :3].astype(int).T
dark = blue > 1.5 * red
assert np.sum(dark & (blue > green)) > 2000, "no lines"
assert np.sum((red > 2 * green) & (red > 2 * blue) & (red > 100)) + np.sum((green > 1.5 * red) & (green > 1.5 * blue)) > 20, "no balls"
assert np.sum((red > 150) & (red >= blue) & (np.minimum(green, blue) < 245)) > 20000, "no surface"
print("demo.pvsm shows the field of", [name for name, _ in GetSources()][0])
