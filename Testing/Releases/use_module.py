"""The smoothest crosses on a sphere, in the system's Python: by the filters and by the package's function."""

import importlib.metadata

from directionalmultigrid import smooth_field
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

indices = smooth_field(sphere.GetOutput()).GetCellData().GetArray("SingularityIndex")
assert sum(indices.GetValue(k) != 0 for k in range(indices.GetNumberOfValues())) == 8

print("directionalmultigrid", importlib.metadata.version("directionalmultigrid"))
accessors = importlib.metadata.distribution("directionalmultigrid").entry_points
assert [each.name for each in accessors if each.group == "pyvista.accessors"] == ["directional"]
