"""A cross field and a flow on a sphere, in pvpython: the example of the README."""

from paraview.simple import *

surface = Sphere(Radius=1, ThetaResolution=100, PhiResolution=100)
mask = Calculator(Input=surface, ResultArrayName="Mask", Function="if(coordsX > 0.95, 1, 0)")
directions = Calculator(Input=mask, ResultArrayName="Directions", Function="jHat")
levels = DirectionalProlongation(Input=directions)
field = HarmonicFieldSolver(Input=levels, Mask=["POINTS", "Mask"], Directions=["POINTS", "Directions"],
                            NumberOfDirections=4)
SaveData("field.vtp", field, DataMode="Binary")

flow = HarmonicFieldSolver(Input=levels, Mask=["POINTS", "Mask"], Directions=["POINTS", "Directions"],
                           Discretisation="1-Form", UnitLength=0)
SaveData("flow.vtp", flow, DataMode="Binary")
