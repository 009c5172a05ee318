"""The smoothest crosses on a sphere, in pvpython and in ParaView's window (paraview --script=...), where the plugin loads by itself.
"""

import os

from paraview.simple import *

field = HarmonicFieldSolver(Input=Sphere(Radius=1, ThetaResolution=60, PhiResolution=60), NumberOfDirections=4)
if "DISPLAY" in os.environ:
    Show(field)
points = servermanager.Fetch(FieldSingularities(Input=field)).GetNumberOfPoints()
os.write(1, f"{points} singular points\n".encode())  # since the window of ParaView 5.13 keeps what is printed
assert points == 8
if "DISPLAY" in os.environ:
    os._exit(0)  # the window would stay
