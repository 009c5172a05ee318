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
    def test_borders_of_regions_become_edges_of_quads(self):
        mesh = plane(12)
        labels = numpy_to_vtk((np.arange(144) % 12 < 5).astype(np.int32), deep=True)
        labels.SetName("Material")
        mesh.GetCellData().AddArray(labels)
        result = quads(mesh, 100, regions="Material")
        places = vtk_to_numpy(result.GetPoints().GetData())[corners(result)][:, :, 0]
        material = vtk_to_numpy(result.GetCellData().GetArray("Material"))
        self.assertTrue(np.all(np.where(material == 1, places.max(axis=1) <= 5 / 12 + 1e-6, places.min(axis=1) >= 5 / 12 - 1e-6)))
        self.assertEqual(result.GetFieldData().GetArray("LostRegions").GetValue(0), 0)

    def test_a_symmetric_surface_has_symmetric_quads(self):
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            result = quads(sphere(), 300, Symmetry="Automatic")
        plane = vtk_to_numpy(result.GetFieldData().GetArray("SymmetryPlane")).ravel()
        places = vtk_to_numpy(result.GetPoints().GetData()).astype(float)
        images = places - 2 * np.outer((places - plane[:3]) @ plane[3:], plane[3:])
        for image in images:
            self.assertLess(np.linalg.norm(places - image, axis=1).min(), 1e-6)
        self.assertEqual(euler(result), 2)

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

    def test_gaps_of_a_field_are_filled(self):
        """Crosses of one direction, zero in the middle: the smoothest ones in between have no singularity."""
        mesh = plane(40)
        places = vtk_to_numpy(mesh.GetPoints().GetData())
        directions = np.tile([1.0, 0, 0], (len(places), 1))
        directions[np.hypot(places[:, 0] - 0.5, places[:, 1] - 0.5) < 0.2] = 0
        array = numpy_to_vtk(directions, deep=True)
        array.SetName("d")
        mesh.GetPointData().AddArray(array)
        result = quads(mesh, 400, directions="d")
        self.assertEqual(result.GetFieldData().GetArray("Singularities").GetValue(0), 0)
        self.assertFalse(vtk_to_numpy(result.GetPointData().GetArray("Irregular")).any())

    def test_labels_are_those_of_the_nearest_point_and_numbers_are_interpolated(self):
        mesh = sphere()
        z = vtk_to_numpy(mesh.GetPoints().GetData())[:, 2].astype(float)
        for name, values in (("Group", np.where(z > 0, 10, 0).astype(np.int32)), ("Height", z)):
            array = numpy_to_vtk(values, deep=True)
            array.SetName(name)
            mesh.GetPointData().AddArray(array)
        result = quads(mesh, 500)
        group, height = [vtk_to_numpy(result.GetPointData().GetArray(name)) for name in ("Group", "Height")]
        self.assertEqual(set(group), {0, 10})
        place = vtk_to_numpy(result.GetPoints().GetData())[:, 2]
        np.testing.assert_allclose(height, place, atol=1e-6)
        self.assertTrue(np.all(group[place > 0.1] == 10) and np.all(group[place < -0.1] == 0))

    def test_active_arrays_stay_active(self):
        mesh = plane()
        places = vtk_to_numpy(mesh.GetPoints().GetData()).astype(float)
        data = mesh.GetPointData()
        for role, values in {"TCoords": places[:, :2], "Normals": np.tile([0.0, 0, 1], (len(places), 1)), "Vectors": 2 * places,
                             "Tensors": np.tile(np.arange(9.0), (len(places), 1)), "PedigreeIds": np.arange(len(places)),
                             "GlobalIds": np.arange(len(places))}.items():
            array = numpy_to_vtk(np.ascontiguousarray(values), deep=True)
            array.SetName(f"My{role}")
            getattr(data, f"Set{role}")(array)
        result = quads(mesh, 50)
        carried, where = result.GetPointData(), vtk_to_numpy(result.GetPoints().GetData())
        np.testing.assert_allclose(vtk_to_numpy(carried.GetTCoords()), where[:, :2], atol=1e-6)
        np.testing.assert_allclose(vtk_to_numpy(carried.GetVectors()), 2 * where, atol=1e-6)
        np.testing.assert_allclose(np.linalg.norm(vtk_to_numpy(carried.GetNormals()), axis=1), 1)
        self.assertEqual([carried.GetNormals().GetName(), carried.GetTensors().GetName()], ["MyNormals", "MyTensors"])
        nearest = places[vtk_to_numpy(carried.GetAbstractArray("MyPedigreeIds"))]
        self.assertLess(np.linalg.norm(nearest - where, axis=1).max(), 2**0.5 / 12)
        self.assertFalse(carried.HasArray("MyGlobalIds"))

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
            quads(sphere(), edge_length=1000.0)
        said = "\n".join(str(each.message) for each in heard)
        self.assertIn(f"there are {result.GetNumberOfCells()} quads rather than 5, as", said)
        self.assertRegex(said, "edges of quads are [0-9.]+ long on average rather than 1000, as")

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

    def ratio_of_sizes(self, mesh, directions, **options):
        """What is asked for and reached, and whether a warning names the field as the reason."""
        with warnings.catch_warnings(record=True) as heard:
            warnings.simplefilter("always")
            result = quads(mesh, 1000, directions, **options)
        said = any("as the given field is kept; without one" in str(each.message) for each in heard)
        return *vtk_to_numpy(result.GetFieldData().GetArray("RatioOfSizes")), said

    def test_a_given_field_does_not_turn_with_sizes_and_a_warning_says_which_does(self):
        mesh = sphere()
        points = vtk_to_numpy(mesh.GetPoints().GetData())
        for name, values in ("Size", 2.0**points[:, 2]), ("Around", np.cross([0, 0, 1], points)):
            array = numpy_to_vtk(values, deep=True)
            array.SetName(name)
            mesh.GetPointData().AddArray(array)
        _, kept, told = self.ratio_of_sizes(mesh, "Around", sizes="Size")
        self.assertTrue(told)
        asked, found, told = self.ratio_of_sizes(mesh, None, sizes="Size")
        self.assertFalse(told)
        self.assertLess(kept, 0.9 * asked)
        self.assertGreater(found, 0.9 * asked)  # the remedy works

    def test_a_given_field_does_not_turn_with_curvature_and_a_warning_says_which_does(self):
        mesh = plane(60)  # with a crest along y, over which a field along x and y has no room for shorter edges along y
        points = vtk_to_numpy(mesh.GetPoints().GetData())
        points[:, 2] = 0.1 * np.exp(-((12 * (points[:, 0] - 0.5))**2))
        array = numpy_to_vtk(np.tile([1.0, 0.0, 0.0], (len(points), 1)), deep=True)
        array.SetName("Along")
        mesh.GetPointData().AddArray(array)
        asked, reached, told = self.ratio_of_sizes(mesh, "Along", Adaptivity=1.0)
        self.assertTrue(told)
        self.assertLess(reached, 0.9 * asked)

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
