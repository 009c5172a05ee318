"""Any surface goes in, and the field comes out on its own cells: no list of repairs before."""

import unittest
import warnings

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkCommonDataModel import vtkDataObject, vtkImageData, vtkMultiBlockDataSet, vtkPolyData, vtkStructuredGrid
from vtkmodules.vtkCommonTransforms import vtkTransform
from vtkmodules.vtkFiltersAMR import vtkAMRGaussianPulseSource
from vtkmodules.vtkFiltersCore import vtkArrayCalculator
from vtkmodules.vtkFiltersGeneral import vtkTransformPolyDataFilter
from vtkmodules.vtkFiltersGeometry import vtkDataSetSurfaceFilter, vtkGeometryFilter
from vtkmodules.vtkFiltersSources import vtkCubeSource, vtkLineSource
from vtkmodules.vtkImagingCore import vtkRTAnalyticSource

from any_surfaces import (cells_of, grid_of, hard, hexagons, image, latitude_longitude, make, odd, out, plane, plate_with_stiffener, points_of, polygons,
                          positions_of, soup, sphere, superquadric, volumes, with_flips_and_twins)
from directionalmultigrid import FieldError, FieldWarning, update
from directionalmultigrid.vtkFiltersDirectionalFields import (vtkDirectionalField, vtkDirectionalProlongation, vtkFieldAngles,
                                                              vtkFieldGlyphs, vtkFieldLines, vtkFieldSingularities,
                                                              vtkHarmonicFieldSolver, vtkHodgeDecomposition,
                                                              vtkPrincipalDirections, vtkScaleFilter, vtkSurfaceDistance)
from smoothest import FIELDS, how_it_ended
from surfaces import add, values

CELLS = vtkDataObject.FIELD_ASSOCIATION_CELLS
POINTS = vtkDataObject.FIELD_ASSOCIATION_POINTS


def solved(data, **properties):
    """The output of the solver, whatever it warns of."""
    solver = vtkHarmonicFieldSolver()
    solver.SetInputDataObject(0, data)
    for name, value in properties.items():
        getattr(solver, "Set" + name)(value)
    return result_of(solver)


def update_strictly(data):
    """The output of the solver, which warns of nothing and refuses what is not an oriented manifold."""
    solver = vtkHarmonicFieldSolver()
    solver.SetInputDataObject(0, data)
    solver.SetStrict(True)
    with warnings.catch_warnings():
        warnings.simplefilter("error", FieldWarning)
        return update(solver)


def result_of(algorithm):
    with warnings.catch_warnings():
        warnings.simplefilter("ignore", FieldWarning)
        update(algorithm)
    return algorithm.GetOutputDataObject(0)


def solved_beside(guide, data):
    """The field that follows a guide."""
    solver = vtkHarmonicFieldSolver()
    solver.SetInputDataObject(0, data)
    solver.AddGuidesConnection(guide.GetOutputPort())
    solver.SetMaximumDistance(1.0)
    solver.AllDirectionsOn()
    return result_of(solver)


def topology(field):
    """(sum of the indices of points and of loops of the boundary, Euler characteristic, number of loops)"""
    singularities = vtkFieldSingularities()
    singularities.SetInputDataObject(0, field)
    result_of(singularities)
    loops = singularities.GetOutputDataObject(2)
    data = singularities.GetOutputDataObject(0).GetFieldData()
    return (values(data, "SumOfIndices")[0], values(data, "EulerCharacteristic")[0], loops.GetNumberOfCells())


def directions(field, k=0):
    return values(field.GetCellData(), f"Direction{k}")


def preparation(field):
    array = field.GetFieldData().GetAbstractArray("SurfacePreparation")
    return array.GetValue(0) if array else ""


def crosses(field):
    """The fourth powers of a plane's directions, which are the same for all directions of a cross."""
    return (directions(field) @ np.array([1, 1j, 0])) ** 4


# Where no path leads, and where the cells around do not determine a linear flow.
MAY_BE_NAN = ("Distance", "Divergence", "Vorticity")


class AnySurface(unittest.TestCase):
    def test_each_has_the_smoothest_field_of_the_surface_that_a_person_sees(self):
        for name, (data, expected) in make().items():
            with self.subTest(surface=name):
                field = solved(data)
                lengths = np.linalg.norm(directions(field), axis=1)
                self.assertTrue(np.isfinite(lengths).all())
                if expected["cells"] is not None:
                    self.assertEqual((abs(lengths - 1) < 1e-6).sum(), expected["cells"])
                self.assertEqual(values(field.GetFieldData(), "Converged")[0], 1)
                total, characteristic, loops = topology(field)
                self.assertAlmostEqual(total, characteristic, delta=1e-9)
                if expected["characteristic"] is not None:
                    self.assertEqual((characteristic, loops), (expected["characteristic"], expected["loops"]))

    def test_what_files_hold_has_a_field_or_one_clear_error(self):
        for name, (data, error) in odd().items():
            with self.subTest(surface=name):
                curvature, hodge = vtkPrincipalDirections(), vtkHodgeDecomposition()
                add(data.GetCellData(), "Flow", np.random.default_rng(2).normal(size=(data.GetNumberOfCells(), 3)))
                hodge.SetInputArrayToProcess(0, 0, 0, CELLS, "Flow")
                scales = vtkScaleFilter()
                scales.AddArray("Flow")
                for each in (vtkDirectionalField(), curvature, hodge, scales, vtkSurfaceDistance()):
                    each.SetInputDataObject(0, data)
                    if error:
                        with self.assertRaisesRegex(FieldError, error):
                            result_of(each)
                        continue
                    result = result_of(each)
                    for attributes in (result.GetCellData(), result.GetPointData()):
                        for k in range(attributes.GetNumberOfArrays()):
                            name_of_array = attributes.GetArrayName(k)
                            self.assertTrue(name_of_array in MAY_BE_NAN or np.isfinite(values(attributes, name_of_array)).all())
                if not error:
                    total, characteristic, _ = topology(solved(data))
                    self.assertAlmostEqual(total, characteristic, delta=1e-9)

    def test_the_skin_of_tetrahedra_is_closed_and_turned_nowhere(self):
        """Solids that touch in edges and points are parted there, and nothing else is done."""
        for name, (data, characteristic, manifold) in volumes().items():
            for extract in (vtkGeometryFilter(), vtkDataSetSurfaceFilter()):
                with self.subTest(solid=name, skin=extract.GetClassName()):
                    skin = out(extract, data)
                    field = update_strictly(skin) if manifold else solved(skin)
                    self.assertRegex(preparation(field), "^((, )?[0-9]+ (edges? of more than two sheets|pinched points?) parted)*$")
                    total, found, loops = topology(field)
                    self.assertAlmostEqual(total, found, delta=1e-9)
                    self.assertEqual((found, loops), (found if characteristic is None else characteristic, 0))

    def test_a_volume_is_solved_on_its_skin(self):
        """Grids of rows become surfaces, also below other filters, and when their extents change; others keep their type."""
        source = vtkRTAnalyticSource()
        source.SetWholeExtent(0, 4, 0, 3, 0, 2)
        solver, below = vtkHarmonicFieldSolver(), vtkArrayCalculator()
        solver.SetInputConnection(source.GetOutputPort())
        below.SetInputConnection(solver.GetOutputPort())
        for depth, kind, cells in ((2, vtkPolyData, 52), (0, vtkImageData, 12), (1, vtkPolyData, 38)):
            source.SetWholeExtent(0, 4, 0, 3, 0, depth)
            field = update(below)
            self.assertIsInstance(field, kind)
            self.assertEqual(field.GetNumberOfCells(), cells)
        for name in ("ring_of_5", "at_an_edge_of_6"):
            data = volumes()[name][0]
            add(data.GetCellData(), "Number", np.arange(data.GetNumberOfCells()))
            skin = out(vtkGeometryFilter(), data)
            field = solved(data)
            self.assertIs(type(field), type(data))
            np.testing.assert_array_equal(directions(field), directions(solved(skin)))
            np.testing.assert_array_equal(values(field.GetCellData(), "Number"), values(skin.GetCellData(), "Number"))
            self.assertIn("three dimensions", field.GetFieldData().GetAbstractArray("Skin").GetValue(0))
        blocks = vtkMultiBlockDataSet()
        for k, leaf in enumerate((out(source), data, image())):
            blocks.SetBlock(k, leaf)
        field = solved(blocks)
        self.assertEqual([field.GetBlock(k).GetClassName() for k in range(3)], ["vtkPolyData", data.GetClassName(), "vtkImageData"])

    def test_layers_along_a_wall_are_no_rounding(self):
        data = odd()["layers_along_a_wall"][0]
        self.assertEqual(preparation(solved(data)), "")

    def test_the_smoothest_field_is_found_on_small_surfaces_of_any_shape(self):
        for name, data in hard().items():
            for fields, (discretisation, numbers) in FIELDS.items():
                for n in numbers:
                    with self.subTest(surface=name, fields=fields, n=n):
                        self.assertEqual(how_it_ended(data, discretisation, n), "")

    def test_the_output_is_of_the_type_that_came_in_with_its_cells_points_and_arrays(self):
        for name, (data, _) in make().items():
            if getattr(data, "GetNumberOfStrips", int)():
                continue
            with self.subTest(surface=name):
                numbers = add(data.GetCellData(), "Number", np.arange(data.GetNumberOfCells()))
                add(data.GetPointData(), "Height", np.arange(data.GetNumberOfPoints()))
                field = solved(data)
                self.assertIs(type(field), type(data))
                self.assertEqual((field.GetNumberOfCells(), field.GetNumberOfPoints()),
                                 (data.GetNumberOfCells(), data.GetNumberOfPoints()))
                self.assertIs(field.GetCellData().GetArray("Number"), numbers)
                self.assertEqual([field.GetPoint(i) for i in (0, 5)], [data.GetPoint(i) for i in (0, 5)])
                self.assertEqual(field.GetCell(2).GetNumberOfPoints(), data.GetCell(2).GetNumberOfPoints())

    def test_strips_come_out_as_triangles_with_the_arrays_of_their_strip(self):
        data = superquadric()
        add(data.GetCellData(), "Strip", np.arange(data.GetNumberOfCells()))
        lengths = [data.GetCell(i).GetNumberOfPoints() - 2 for i in range(data.GetNumberOfCells())]
        field = solved(data)
        self.assertEqual((field.GetNumberOfStrips(), field.GetNumberOfPolys()), (0, sum(lengths)))
        np.testing.assert_array_equal(values(field.GetCellData(), "Strip"), np.repeat(np.arange(len(lengths)), lengths))

    def test_blocks_are_solved_leaf_by_leaf(self):
        blocks = vtkMultiBlockDataSet()
        blocks.SetBlock(0, grid_of(out(vtkCubeSource())))
        blocks.SetBlock(1, sphere())
        blocks.SetBlock(2, None)
        field = solved(blocks)
        self.assertIsInstance(field, vtkMultiBlockDataSet)
        for k in (0, 1):
            self.assertIs(type(field.GetBlock(k)), type(blocks.GetBlock(k)))
            lengths = np.linalg.norm(directions(field.GetBlock(k)), axis=1)
            np.testing.assert_allclose(lengths, 1.0, atol=1e-12)
        self.assertIsNone(field.GetBlock(2))

    def test_grids_of_adaptive_refinement_are_blocks(self):
        """Such a dataset holds only grids, and the skin of a volume is none."""
        for dimension, kind in ((2, "vtkUniformGrid"), (3, "vtkPolyData")):
            source = vtkAMRGaussianPulseSource()
            source.SetDimension(dimension)
            solver = vtkHarmonicFieldSolver()
            solver.SetInputConnection(source.GetOutputPort())
            with warnings.catch_warnings(record=True):
                field = update(solver)
            self.assertIsInstance(field, vtkMultiBlockDataSet)
            leaves, count = field.NewIterator(), 0
            leaves.InitTraversal()
            while not leaves.IsDoneWithTraversal():
                leaf = leaves.GetCurrentDataObject()
                self.assertTrue(leaf.IsA(kind), leaf.GetClassName())
                self.assertGreater(np.linalg.norm(directions(leaf), axis=1).max(), 0.99)
                leaves.GoToNextItem()
                count += 1
            self.assertEqual(count, 3)

    def test_blocks_keep_their_set_ups(self):
        """A moved guide solves anew, on leaves that come and go in any order; another surface is set up as the only one."""
        leaves = [sphere(12, 8), grid_of(out(vtkCubeSource())), hexagons(1)]
        blocks = vtkMultiBlockDataSet()
        for k, leaf in enumerate([*leaves, sphere(12, 8)]):  # the last one is a twin of the first
            blocks.SetBlock(k, leaf)
        guide = vtkLineSource()
        guide.SetPoint1(0, 0, 0.75)
        guide.SetPoint2(0.3, 0, 0.75)
        solver = vtkHarmonicFieldSolver()
        solver.SetInputDataObject(0, blocks)
        solver.AddGuidesConnection(guide.GetOutputPort())
        solver.SetMaximumDistance(1.0)

        def counts():
            result_of(solver)
            return solver.GetNumberOfSetups(), solver.GetNumberOfSystems()

        first = counts()
        self.assertEqual(first[0], 3)
        alone = [directions(solved_beside(guide, leaf)) for leaf in leaves]
        for k in range(4):
            np.testing.assert_array_equal(directions(solver.GetOutputDataObject(0).GetBlock(k)), alone[k % 3])
        guide.SetPoint2(0.3, 0.2, 0.75)
        self.assertEqual(counts()[0], 3)
        shuffled = vtkMultiBlockDataSet()
        for k, leaf in enumerate([leaves[2], leaves[0]]):
            shuffled.SetBlock(k, leaf)
        solver.SetInputDataObject(0, shuffled)
        self.assertEqual(counts()[0], 3)
        solver.SetInputDataObject(0, blocks)  # the box is no longer kept, and takes over from the hexagons
        self.assertEqual(counts()[0], 5)
        other = vtkMultiBlockDataSet()
        for k, leaf in enumerate([leaves[0], hexagons(2), leaves[2]]):
            other.SetBlock(k, leaf)
        solver.SetInputDataObject(0, other)
        self.assertEqual(counts()[0], 6)

    def test_a_guide_near_one_block_leaves_the_others_as_smooth_as_they_can_be(self):
        away = vtkTransformPolyDataFilter()
        moved = vtkTransform()
        moved.Translate(10, 0, 0)
        away.SetTransform(moved)
        blocks = vtkMultiBlockDataSet()
        blocks.SetBlock(0, sphere())
        blocks.SetBlock(1, out(away, sphere()))
        guide = vtkLineSource()
        guide.SetPoint1(0.5, -0.2, 0)
        guide.SetPoint2(0.5, 0.2, 0)
        solver = vtkHarmonicFieldSolver()
        solver.SetInputDataObject(0, blocks)
        solver.AddGuidesConnection(guide.GetOutputPort())
        with self.assertWarnsRegex(FieldWarning, "1 element farther from the surface"):
            update(solver)
        near, far = (solver.GetOutputDataObject(0).GetBlock(k) for k in range(2))
        self.assertGreater(values(near.GetFieldData(), "GuidesTaken")[0], 0)
        self.assertEqual(values(far.GetFieldData(), "GuidesTaken")[0], 0)
        np.testing.assert_allclose(directions(far), directions(solved(blocks.GetBlock(1))), atol=1e-12)

    def test_the_corner_that_a_polygon_begins_with_makes_no_difference(self):
        for data in (out(plane(7, 5)), hexagons(2), plate_with_stiffener()):
            cells = cells_of(data)
            rotated = polygons(positions_of(data), [cell[k % len(cell):] + cell[:k % len(cell)] for k, cell in enumerate(cells)])
            given = polygons(positions_of(data), cells)
            for each in (rotated, given):
                vectors = np.zeros((len(cells), 3))
                vectors[3] = (1.0, 0.25, 0.5)
                add(each.GetCellData(), "Given", vectors)
            results = []
            for each in (rotated, given):
                solver = vtkHarmonicFieldSolver()
                solver.SetInputData(each)
                solver.SetInputArrayToProcess(1, 0, 0, CELLS, "Given")
                results.append(result_of(solver))
            np.testing.assert_allclose(directions(results[0]), directions(results[1]), atol=1e-12)

    def test_a_direction_prescribed_on_a_cell_is_that_of_the_cell(self):
        """Held exactly on one cell of a plane, and free elsewhere, a field is parallel to it."""
        data = out(plane(6, 4))
        vectors = np.zeros((24, 3))
        vectors[9] = (np.cos(0.3), np.sin(0.3), 0)
        add(data.GetCellData(), "Given", vectors)
        grid = grid_of(data)
        grid.GetCellData().ShallowCopy(data.GetCellData())
        for each in (data, grid):
            solver = vtkHarmonicFieldSolver()
            solver.SetInputDataObject(0, each)
            solver.SetConstraintType(vtkHarmonicFieldSolver.Hard)
            solver.SetTolerance(1e-10)
            solver.SetInputArrayToProcess(1, 0, 0, CELLS, "Given")
            field = result_of(solver)
            np.testing.assert_allclose(crosses(field), np.exp(4j * 0.3), atol=1e-8)
            prescribed = values(field.GetPointData(), "Prescribed")
            self.assertEqual(set(np.flatnonzero(prescribed)), set(cells_of(data)[9]))

    def test_a_direction_prescribed_at_a_point_counts_there(self):
        data = grid_of(out(plane(6, 4)))
        vectors = np.zeros((35, 3))
        vectors[17] = (np.cos(0.2), np.sin(0.2), 0)
        add(data.GetPointData(), "Given", vectors)
        solver = vtkHarmonicFieldSolver()
        solver.SetInputDataObject(0, data)
        solver.SetTolerance(1e-10)
        solver.SetInputArrayToProcess(1, 0, 0, POINTS, "Given")
        np.testing.assert_allclose(crosses(result_of(solver)), np.exp(4j * 0.2), atol=1e-7)

    def test_doubled_cells_have_the_field_of_their_twin(self):
        field = solved(with_flips_and_twins(sphere()))
        n = sphere().GetNumberOfCells()
        np.testing.assert_array_equal(directions(field)[[n, n + 1, n + 2]], directions(field)[[5, 9, 5]])

    def test_hidden_cells_take_no_part(self):
        data = latitude_longitude()
        flags = np.zeros(data.GetNumberOfCells(), np.uint8)
        flags[500:520] = 32  # HIDDENCELL
        array = numpy_to_vtk(flags, deep=True)
        array.SetName("vtkGhostType")
        data.GetCellData().AddArray(array)
        field = solved(data)
        lengths = np.linalg.norm(directions(field), axis=1)
        np.testing.assert_allclose(lengths, flags == 0, atol=1e-12)
        self.assertEqual(topology(field)[2], 1)

    def test_cells_of_other_dimensions_have_zeros(self):
        data, _ = make()["lines_and_vertices_beside"]
        self.assertTrue((directions(solved(data))[:2] == 0).all())

    def test_the_report_counts_what_was_done(self):
        surfaces = make()
        for name, text in (("plane_of_quads", ""), ("box_of_quads_with_doubled_points", "16 points joined"),
                           ("plate_with_stiffener", "8 edges of more than two sheets parted"),
                           ("two_spheres_at_a_point", "1 pinched point parted"),
                           ("triangles_without_area", "1 cell without area"), ("ghost_cells", "")):
            with self.subTest(surface=name):
                self.assertEqual(preparation(solved(surfaces[name][0])), text)
        with self.assertWarnsRegex(FieldWarning, "cells turned, 3 cells doubled"):
            solver = vtkHarmonicFieldSolver()
            solver.SetInputData(surfaces["flipped_and_doubled_triangles"][0])
            update(solver)

    def test_joining_can_be_switched_off(self):
        box = out(vtkCubeSource())
        self.assertEqual(topology(solved(box))[1:], (2, 0))
        self.assertEqual(topology(solved(box, JoinPoints=False))[1:], (6, 6))

    def test_strict_refuses(self):
        for name in ("flipped_and_doubled_triangles", "plate_with_stiffener", "two_spheres_at_a_point", "moebius_strip"):
            with self.subTest(surface=name), self.assertRaisesRegex(FieldError, "switch Strict off"):
                solved(make()[name][0], Strict=True)
        self.assertEqual(topology(solved(out(plane()), Strict=True))[1:], (1, 1))

    def test_all_filters_take_what_the_solver_takes(self):
        for data in (out(plane()), hexagons(2), grid_of(hexagons(2)), latitude_longitude(), image(), soup(sphere()),
                     plate_with_stiffener()):
            with self.subTest(data=data.GetClassName()):
                field = solved(data)
                for each in (vtkFieldLines(), vtkFieldGlyphs(), vtkFieldAngles(), vtkFieldSingularities()):
                    each.SetInputDataObject(0, field)
                    drawn = result_of(each)
                    self.assertTrue(drawn.GetNumberOfCells() > 0 or isinstance(each, vtkFieldSingularities))
                curvature, prolongation = vtkPrincipalDirections(), vtkDirectionalProlongation()
                curvature.SetInputDataObject(0, data)
                prolongation.SetInputDataObject(0, data)
                prolongation.SetMinimumNumberOfFaces(20)
                self.assertIs(type(result_of(curvature)), type(data))
                with_operators = result_of(prolongation)
                self.assertIs(type(with_operators), type(data))
                stored = solved(with_operators, CoarseSpace=vtkHarmonicFieldSolver.StructurePreserving,
                                Solver=vtkHarmonicFieldSolver.ConjugateGradients)
                self.assertEqual(values(stored.GetFieldData(), "Converged")[0], 1)

    def test_fields_on_cells_that_are_not_plane_are_drawn(self):
        """Quads over uneven ground, a quad that is folded, and polygons that cross themselves."""
        rng = np.random.default_rng(5)
        ground = vtkStructuredGrid()
        ground.SetDimensions(12, 9, 1)
        places = np.stack(np.meshgrid(np.arange(12.0), np.arange(9.0)), -1).reshape(-1, 2)
        ground.SetPoints(points_of(np.hstack([places, rng.normal(size=(108, 1))])))
        folded = polygons([(0, 0, 0), (1, 0, 0), (1, 1, 0), (0.9, 0.1, 0.001)], [[0, 1, 2, 3]])
        star = polygons([(np.cos(t), np.sin(t), 0) for t in 2 * np.pi * np.arange(5) / 5], [[0, 2, 4, 1, 3]])
        bow = polygons([(0, 0, 0), (1, 0, 0), (0, 1, 0), (1, 1, 0)], [[0, 1, 2, 3]])
        for data in (ground, folded, star, bow):
            for n in (1, 2, 4, 6):
                field = solved(data, NumberOfDirections=n)
                total, characteristic, _ = topology(field)
                self.assertAlmostEqual(total, characteristic, delta=1e-9)
                for each in (vtkFieldLines(), vtkFieldGlyphs(), vtkFieldAngles()):
                    each.SetInputDataObject(0, field)
                    self.assertGreater(result_of(each).GetNumberOfCells(), 0)

    def test_operators_say_which_triangles_they_refer_to(self):
        prolongation = vtkDirectionalProlongation()
        prolongation.SetInputData(hexagons(2))
        data = result_of(prolongation).GetFieldData()
        sizes = values(data, "Prolongation.NumbersOfFaces")
        cells = values(data, "Prolongation.CellsOfFaces")
        self.assertEqual(len(cells), sizes[0])
        np.testing.assert_array_equal(np.bincount(cells.astype(int)), [len(cell) - 2 for cell in cells_of(hexagons(2))])
        prolongation.SetInputData(sphere())
        self.assertFalse(result_of(prolongation).GetFieldData().HasArray("Prolongation.CellsOfFaces"))

    def test_the_index_stands_at_one_point_of_those_that_were_joined(self):
        field = solved(latitude_longitude(), Discretisation=vtkHarmonicFieldSolver.PowerField)
        self.assertAlmostEqual(values(field.GetPointData(), "SingularityIndex").sum(), 2.0, delta=1e-9)

    def test_a_surface_without_cells_of_two_dimensions_is_refused(self):
        line = vtkStructuredGrid()
        line.SetDimensions(4, 1, 1)
        line.SetPoints(out(plane(3, 1)).GetPoints())
        with self.assertRaisesRegex(FieldError, "no triangles or other cells of two dimensions"):
            solved(line)
        self.assertEqual(solved(vtkPolyData()).GetNumberOfCells(), 0)


if __name__ == "__main__":
    unittest.main()
