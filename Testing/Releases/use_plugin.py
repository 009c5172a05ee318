"""The smoothest crosses on a sphere, in pvpython and in ParaView's window (paraview --script=...), where the plugin loads by itself.
"""

import os

from paraview.simple import *

field = HarmonicFieldSolver(Input=Sphere(Radius=1, ThetaResolution=60, PhiResolution=60), NumberOfDirections=4)
if "DISPLAY" in os.environ:
    Show(field)
points = servermanager.Fetch(FieldSingularities(Input=field)).GetNumberOfPoints()
print(points, "singular points", flush=True)
assert points == 8
if "DISPLAY" in os.environ:
    os._exit(0)  # the window would stay
