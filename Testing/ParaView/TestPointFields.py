"""The default field through ParaView's Python, which stands at points: crosses along the boundary of a square, and their
singularities; a plane of quads, whose field is that of its triangles."""

import numpy as np
import paraview.simple as simple
from vtkmodules.util.numpy_support import vtk_to_numpy


def main():
    plane = simple.Triangulate(Input=simple.Plane(XResolution=30, YResolution=30))
    solver = simple.HarmonicFieldSolver(Input=plane, BoundaryWeight=1.0, ConstraintType="Hard", Tolerance=1e-8)
    assert solver.Discretisation == "Power Field at Points", solver.Discretisation
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

    fields = []
    for mirrored in (False, True):  # the diagonals of a mirrored plane run the other way
        quads = simple.Plane(XResolution=60, YResolution=60)
        bent = simple.Calculator(Input=simple.Triangulate(Input=quads) if mirrored else quads, CoordinateResults=1,
                                 Function=("-coordsX" if mirrored else "coordsX") + "*iHat + coordsY*jHat + 0.3*coordsX^2*kHat")
        given = simple.Calculator(Input=bent, ResultArrayName="Given", Function=(
            "if(max(abs(coordsX), abs(coordsY)) > 0.499, 1, 0)*(cos(2*coordsX + coordsY)*iHat + sin(2*coordsX + coordsY)*jHat)"))
        field = simple.servermanager.Fetch(simple.HarmonicFieldSolver(
            Input=given, Directions=["POINTS", "Given"], ConstraintType="Hard", UnitLength=0, Tolerance=1e-10))
        points, v = (vtk_to_numpy(a).astype(float) for a in (field.GetPoints().GetData(), field.GetPointData().GetArray("Direction0")))
        order = np.lexsort((points[:, 0].round(6), points[:, 1].round(6)))
        across = v[order, 0] * np.sqrt(1 + (0.6 * points[order, 0]) ** 2)  # the length along the bent direction
        z = across + 1j * v[order, 1]
        fields.append(np.abs(z) * np.exp(4j * np.angle(z)))
    difference = np.sqrt((np.abs(fields[0] - fields[1]) ** 2).mean() / (np.abs(fields[0]) ** 2).mean())
    assert difference < 0.01, difference
    print("quads have the field of their triangles")


main()
