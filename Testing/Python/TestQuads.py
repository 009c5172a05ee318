"""Quad meshes: quads(), and the filter behind it."""

import unittest
import warnings

import numpy as np
from directionalmultigrid import FieldError, quads, smooth_field
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkFiltersSources import vtkCylinderSource, vtkPlaneSource, vtkSphereSource
from surfaces import disc, grid


def plane(cells=12):
    """Quadrilaterals on [0, 1]^2."""
    source = vtkPlaneSource()
    source.SetOrigin(0, 0, 0)
    source.SetPoint1(1, 0, 0)
    source.SetPoint2(0, 1, 0)
    source.SetResolution(cells, cells)
    source.Update()
    return source.GetOutput()


def sphere():
    source = vtkSphereSource()
    source.SetRadius(1)
    source.SetThetaResolution(40)
    source.SetPhiResolution(40)
    source.Update()
    return source.GetOutput()


def corners(mesh):
    """The points of each quad; fails where there is another cell."""
    cells = mesh.GetPolys()
    assert mesh.GetNumberOfCells() == cells.GetNumberOfCells() and cells.IsHomogeneous() == 4
    return vtk_to_numpy(cells.GetConnectivityArray()).reshape(-1, 4)


def sides(mesh):
    quad = corners(mesh)
    return np.stack([quad, np.roll(quad, -1, axis=1)], axis=2).reshape(-1, 2)


def euler(mesh):
    edges = np.unique(np.sort(sides(mesh), axis=1), axis=0)
    return mesh.GetNumberOfPoints() - len(edges) + mesh.GetNumberOfCells()


class Quads(unittest.TestCase):
    def test_a_square_becomes_a_grid(self):
        surface = plane()
        result = quads(surface, 400)
        self.assertIsInstance(result, vtkPolyData)
        self.assertEqual((result.GetNumberOfCells(), result.GetNumberOfPoints()), (400, 441))
        self.assertEqual(surface.GetNumberOfCells(), 144)  # the input stays
        places = np.round(20 * vtk_to_numpy(result.GetPoints().GetData()), 4)
        self.assertEqual({tuple(place) for place in places}, {(i, j, 0) for i in range(21) for j in range(21)})

    def test_singularities_of_a_disk_keep_apart_so_that_edges_are_alike(self):
        """The smoothest crosses of any length have all four beside its middle, where quads become small or large."""
        disk = grid(40, disc, 2)

        def spread(mesh):
            ends = vtk_to_numpy(mesh.GetPoints().GetData())[sides(mesh)]
            lengths = np.linalg.norm(ends[:, 1] - ends[:, 0], axis=1)
            return lengths.std() / lengths.mean()

        crosses = {"Discretisation": "PointPowerField", "BoundaryWeight": 1000}
        own = quads(disk, 600)
        kept_apart = quads(smooth_field(disk, n=4, UnitLengthWhileSmoothing=True, **crosses), 600)
        together = quads(smooth_field(disk, n=4, **crosses), 600)
        self.assertLess(spread(own), 0.15)
        self.assertLess(spread(kept_apart), 0.15)
        self.assertGreater(spread(together), 0.3)

    def test_directed_edges_are_there_once(self):
        result = quads(sphere(), 600)
        self.assertEqual(euler(result), 2)
        directed = sides(result)
        self.assertEqual(len(np.unique(directed, axis=0)), len(directed))
        self.assertEqual({tuple(side) for side in directed}, {tuple(side) for side in directed[:, ::-1]})
        irregular = vtk_to_numpy(result.GetPointData().GetArray("Irregular"))
        self.assertEqual((np.bincount(corners(result).ravel()) - 4).tolist(), irregular.tolist())
        self.assertEqual(irregular.sum(), -8)
        self.assertGreater(vtk_to_numpy(result.GetCellData().GetArray("ScaledJacobian")).min(), 0)  # none is inverted

    def test_edge_length_counts_in_place_of_the_number(self):
        result = quads(plane(), edge_length=0.1)
        self.assertEqual(result.GetNumberOfCells(), 100)

    def test_open_cylinder_keeps_both_holes(self):
        source = vtkCylinderSource()
        source.SetResolution(60)
        source.CappingOff()
        source.Update()
        result = quads(source.GetOutput(), 500)
        self.assertEqual(euler(result), 0)

    def test_a_field_of_the_solver_is_followed(self):
        field = smooth_field(sphere(), n=4)
        self.assertEqual(euler(quads(field, 500)), 2)
        self.assertEqual(euler(quads(field, 500, "Direction0")), 2)
        with self.assertRaisesRegex(FieldError, "6 directions"):
            quads(smooth_field(sphere(), n=6), 500)

    def test_report_says_distances_and_shares_of_area(self):
        data = quads(sphere(), 600).GetFieldData()
        from_quads, from_surface, shares = [vtk_to_numpy(data.GetArray(name)) for name in
                                            ("DistanceFromQuads", "DistanceFromSurface", "AreaShares")]
        edge = (4 * np.pi / 600)**0.5
        self.assertTrue(0 < from_quads[1] < from_quads[0] < edge / 4)  # largest and mean: chords of squares are edge^2 / 4 deep
        self.assertTrue(0 < from_surface[1] < from_surface[0] < edge / 4)
        self.assertAlmostEqual(shares[0], 1, 1)
        self.assertEqual(len(vtk_to_numpy(data.GetArray("FarthestPlace"))), 3)

    def test_of_another_number_than_asked_for_is_a_warning_with_the_reason(self):
        with warnings.catch_warnings(record=True) as heard:
            warnings.simplefilter("always")
            result = quads(sphere(), 5)
        self.assertIn(f"there are {result.GetNumberOfCells()} quads rather than 5, as", str(heard[0].message))

    def test_sizes_that_are_not_reached_are_a_warning(self):
        mesh = sphere()
        z = vtk_to_numpy(mesh.GetPoints().GetData())[:, 2]
        array = numpy_to_vtk(np.where(z > 0, 1.0, 10.0), deep=True)
        array.SetName("Size")
        mesh.GetPointData().AddArray(array)
        with warnings.catch_warnings(record=True) as heard:
            warnings.simplefilter("always")
            asked, reached = vtk_to_numpy(quads(mesh, 1000, sizes="Size").GetFieldData().GetArray("RatioOfSizes"))
        self.assertAlmostEqual(asked, 10)
        self.assertTrue(1 < reached < 9)
        self.assertTrue(any("sizes vary by 10" in str(each.message) for each in heard))

    def test_what_is_wrong_is_an_error(self):
        with self.assertRaisesRegex(FieldError, "no array 'Wind'"):
            quads(plane(), directions="Wind")
        with self.assertRaisesRegex(FieldError, "Number Of Quads"):
            quads(plane(), 0)
        with self.assertRaisesRegex(TypeError, "did you mean SmoothingSteps"):
            quads(plane(), SmoothingStep=3)
        with self.assertRaisesRegex(FieldError, "Edge Length"):
            quads(plane(), edge_length=-1.0)


if __name__ == "__main__":
    unittest.main()
