"""The smoothest crosses on a sphere, in the system's Python."""

from directionalmultigrid.vtkFiltersDirectionalFields import vtkFieldSingularities, vtkHarmonicFieldSolver
from vtkmodules.vtkFiltersSources import vtkSphereSource

sphere = vtkSphereSource()
sphere.SetThetaResolution(60)
sphere.SetPhiResolution(60)
solver = vtkHarmonicFieldSolver()
solver.SetInputConnection(sphere.GetOutputPort())
solver.SetNumberOfDirections(4)
singularities = vtkFieldSingularities()
singularities.SetInputConnection(solver.GetOutputPort())
singularities.Update()
points = singularities.GetOutput().GetNumberOfPoints()
print(points, "singular points")
assert points == 8
