"""A power field at points through ParaView's Python: crosses along the boundary of a square, and their singularities."""

import paraview.simple as simple
from vtkmodules.util.numpy_support import vtk_to_numpy


def main():
    plane = simple.Triangulate(Input=simple.Plane(XResolution=30, YResolution=30))
    solver = simple.HarmonicFieldSolver(Input=plane, Discretisation="Power Field at Points", BoundaryWeight=1.0,
                                        ConstraintType="Hard", Tolerance=1e-8)
    field = simple.servermanager.Fetch(solver)
    assert field.GetFieldData().GetArray("Converged").GetValue(0) == 1
    prescribed = vtk_to_numpy(field.GetPointData().GetArray("Prescribed"))
    assert (prescribed > 0).sum() == 4 * 30, prescribed  # the points of the boundary and no others
    # Crosses along the sides of a square are parallel, and nothing is singular.
    direction = abs(vtk_to_numpy(field.GetPointData().GetArray("Direction0")))
    assert direction.max(1).min() > 0.9999, direction
    assert not vtk_to_numpy(field.GetCellData().GetArray("SingularityIndex")).any()
    singularities = simple.servermanager.Fetch(simple.FieldSingularities(Input=solver))
    assert singularities.GetNumberOfPoints() == 0
    assert singularities.GetFieldData().GetArray("EulerCharacteristic").GetValue(0) == 1
    assert abs(singularities.GetFieldData().GetArray("SumOfIndices").GetValue(0) - 1) < 1e-9
    print("crosses on a square are parallel to its sides")


main()
