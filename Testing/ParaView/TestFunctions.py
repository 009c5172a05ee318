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

    # On the unit sphere -Laplace z = 2 z, so that z is the function with the source 2 z; a constant besides is taken out.
    sphere = simple.Sphere(Radius=1, ThetaResolution=60, PhiResolution=60)
    heat = simple.Calculator(Input=sphere, ResultArrayName="Heat", Function="2 * coordsZ + 5")
    solver = simple.HarmonicFieldSolver(Input=heat, Discretisation="Function", Source=["POINTS", "Heat"], NetSource="Take Out")
    field = simple.servermanager.Fetch(solver)
    z = vtk_to_numpy(field.GetPoints().GetData())[:, 2]
    assert abs(vtk_to_numpy(field.GetPointData().GetArray("ScalarFunction")) - z).max() < 0.01
    print("the function has the source")


main()
