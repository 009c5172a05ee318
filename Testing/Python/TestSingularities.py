"""Field Singularities names poles with too few triangles, and is silent on plain surfaces."""

import pathlib
import unittest

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkFiltersModeling import vtkLinearSubdivisionFilter
from vtkmodules.vtkFiltersSources import vtkPlatonicSolidSource
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

from directionalmultigrid import smooth_field
from directionalmultigrid.vtkFiltersDirectionalFields import vtkFieldSingularities
from surfaces import surface

DATA = pathlib.Path(__file__).resolve().parents[2] / "Data"


def sphere_of_icosahedron():
    """Five triangles meet at its first point; the array Parallels runs around that one."""
    solid, finer = vtkPlatonicSolidSource(), vtkLinearSubdivisionFilter()
    solid.SetSolidTypeToIcosahedron()
    finer.SetInputConnection(solid.GetOutputPort())
    finer.SetNumberOfSubdivisions(2)
    finer.Update()
    sphere = finer.GetOutput()
    points = vtk_to_numpy(sphere.GetPoints().GetData()).astype(float)
    points /= np.linalg.norm(points, axis=1, keepdims=True)
    sphere.GetPoints().SetData(numpy_to_vtk(points, deep=True))
    parallels = numpy_to_vtk(np.cross(points[0], points), deep=True)
    parallels.SetName("Parallels")
    sphere.GetPointData().AddArray(parallels)
    return sphere


def warnings_of(field, n):
    """Those of Field Singularities, and the singularities."""
    filter_, heard = vtkFieldSingularities(), []
    filter_.SetInputData(field)
    filter_.SetInputArrayToProcess(0, 0, 0, 0 if field.GetPointData().HasArray("Direction0") else 1, "Direction0")
    filter_.SetNumberOfDirections(n)
    filter_.AddObserver("WarningEvent", lambda *_: heard.append("warning"))
    filter_.Update()
    return heard, vtk_to_numpy(filter_.GetOutput().GetPointData().GetArray("Index"))


class Singularities(unittest.TestCase):
    def test_of_a_pole_with_five_triangles_are_named(self):
        crosses = smooth_field(sphere_of_icosahedron(), n=4, Directions="Parallels")
        heard, indices = warnings_of(crosses, 4)
        self.assertEqual(sorted(indices), 2 * [-0.25] + 10 * [0.25])  # both poles of index 1
        self.assertEqual(len(heard), 1)
        vectors = smooth_field(sphere_of_icosahedron(), n=1, Directions="Parallels")
        heard, indices = warnings_of(vectors, 1)
        self.assertEqual(list(indices), [1, 1])
        self.assertFalse(heard)

    def test_of_plain_surfaces_are_not(self):
        for path in sorted(DATA.glob("*.vtp")):
            reader = vtkXMLPolyDataReader()
            reader.SetFileName(str(path))
            reader.Update()
            for kind in ("PointPowerField", "PowerField"):
                for n in (1, 2, 4, 6):
                    field = smooth_field(reader.GetOutput(), n=n, Discretisation=kind)
                    self.assertFalse(warnings_of(field, n)[0], (path.name, kind, n))

    def test_that_are_many_have_small_balls(self):
        """Tetrahedra beside each other, with a singularity at each corner."""
        corners = np.array([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1)])
        sides = np.array([(0, 2, 1), (0, 1, 3), (1, 2, 3), (2, 0, 3)])

        def triangles_of_balls(number):
            points = (2 * np.stack([np.arange(number), np.zeros(number), np.zeros(number)], 1)[:, None] + corners).reshape(-1, 3)
            triangles = (4 * np.arange(number)[:, None, None] + sides).reshape(-1, 3)
            singularities = vtkFieldSingularities()
            singularities.SetInputData(smooth_field(surface(points, triangles)))
            singularities.Update()
            balls = singularities.GetOutputDataObject(0).GetNumberOfPoints()
            self.assertGreaterEqual(balls, 4 * number)
            self.assertEqual(singularities.GetOutputDataObject(3).GetNumberOfCells() % balls, 0)
            return singularities.GetOutputDataObject(3).GetNumberOfCells(), balls

        triangles, balls = triangles_of_balls(10)
        self.assertEqual(triangles, 2 * 24 * 22 * balls)
        triangles, balls = triangles_of_balls(2000)
        self.assertTrue(100 * balls < triangles <= 4e6, (triangles, balls))


if __name__ == "__main__":
    unittest.main()
