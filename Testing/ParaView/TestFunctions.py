"""A harmonic function through ParaView's Python: the height on a cylinder between its two rims."""

import paraview.simple as simple
from vtkmodules.util.numpy_support import vtk_to_numpy


def main():
    cylinder = simple.Cylinder(Resolution=80, Height=2, Capping=0)
    triangles = simple.Triangulate(Input=cylinder)
    surface = simple.Clean(Input=simple.Subdivide(Input=triangles, NumberofSubdivisions=4))
    mask = simple.Calculator(Input=surface, ResultArrayName="Rims",
                             Function="if(abs(coordsY) > 0.999, 1, 0)")
    given = simple.Calculator(Input=mask, ResultArrayName="Height", Function="coordsY")
    solver = simple.HarmonicFieldSolver(
        Input=given, Discretisation="Function", Values=["POINTS", "Height"], Mask=["POINTS", "Rims"],
        ConstraintType="Hard", Solver="Conjugate Gradients", Tolerance=1e-8)
    field = simple.servermanager.Fetch(solver)
    assert field.GetFieldData().GetArray("Converged").GetValue(0) == 1
    function, height = (vtk_to_numpy(field.GetPointData().GetArray(name))
                        for name in ("ScalarFunction", "Height"))
    # Harmonic, and a function of the height alone.
    assert abs(function - height).max() < 1e-5, abs(function - height).max()
    gradient = vtk_to_numpy(field.GetCellData().GetArray("Direction0"))
    assert abs(gradient[:, 1] - 1).max() < 1e-4, gradient
    print("the function is the height")


main()
