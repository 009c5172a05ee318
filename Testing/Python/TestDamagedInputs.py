"""Inputs that are damaged, or that do not matter: cells whose points are not there, short arrays, NaN in arrays that nobody has
chosen, values that are left over from another kind of field. A fault is one error that names the element; the rest is solved."""

import unittest
import warnings

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkDoubleArray, vtkIdList, vtkPoints
from vtkmodules.vtkCommonDataModel import (
    VTK_BEZIER_HEXAHEDRON, VTK_BEZIER_QUADRILATERAL, VTK_BEZIER_TETRAHEDRON, VTK_BEZIER_TRIANGLE, VTK_BEZIER_WEDGE, VTK_BIQUADRATIC_QUAD,
    VTK_BIQUADRATIC_TRIANGLE, VTK_HEXAGONAL_PRISM, VTK_HEXAHEDRON, VTK_LAGRANGE_HEXAHEDRON, VTK_LAGRANGE_QUADRILATERAL,
    VTK_LAGRANGE_TETRAHEDRON, VTK_LAGRANGE_TRIANGLE, VTK_LAGRANGE_WEDGE, VTK_LINE, VTK_PENTAGONAL_PRISM, VTK_PIXEL, VTK_POLYHEDRON,
    VTK_PYRAMID, VTK_QUAD, VTK_QUADRATIC_EDGE, VTK_QUADRATIC_HEXAHEDRON, VTK_QUADRATIC_LINEAR_QUAD, VTK_QUADRATIC_PYRAMID,
    VTK_QUADRATIC_QUAD, VTK_QUADRATIC_TETRA, VTK_QUADRATIC_TRIANGLE, VTK_QUADRATIC_WEDGE, VTK_TETRA, VTK_TRIANGLE,
    VTK_TRIQUADRATIC_HEXAHEDRON, VTK_VERTEX, VTK_VOXEL, VTK_WEDGE, vtkCellArray, vtkMultiBlockDataSet, vtkPolyData, vtkRectilinearGrid,
    vtkStructuredGrid, vtkTable, vtkUnstructuredGrid)
from vtkmodules.vtkFiltersSources import vtkSphereSource

from directionalmultigrid import FieldError, smooth_field, update
from directionalmultigrid.vtkFiltersDirectionalFields import (
    vtkDirectionalField, vtkDirectionalProlongation, vtkFieldAngles, vtkFieldGlyphs, vtkFieldLines, vtkFieldQuads, vtkFieldSingularities,
    vtkHarmonicFieldSolver, vtkHodgeDecomposition, vtkParallelTransport, vtkPrincipalDirections, vtkScaleFilter, vtkSurfaceDistance)
from any_surfaces import grid_of_types, points_of, polygons
from surfaces import add, torus, values

FILTERS = (vtkHarmonicFieldSolver, vtkDirectionalField, vtkDirectionalProlongation, vtkFieldLines, vtkFieldGlyphs, vtkFieldSingularities,
           vtkFieldAngles, vtkHodgeDecomposition, vtkParallelTransport, vtkPrincipalDirections, vtkScaleFilter, vtkSurfaceDistance)
WITHOUT_ARRAYS = (vtkHarmonicFieldSolver, vtkDirectionalField, vtkDirectionalProlongation, vtkParallelTransport, vtkPrincipalDirections,
                  vtkSurfaceDistance)
SQUARE = [(0, 0, 0), (1, 0, 0), (0, 1, 0), (1, 1, 0)]


def sphere(resolution=16):
    source = vtkSphereSource()
    source.SetThetaResolution(resolution)
    source.SetPhiResolution(resolution)
    return update(source)


def band_of_strips(squares=8):
    """Strips of two triangles each."""
    data, strips = vtkPolyData(), vtkCellArray()
    data.SetPoints(points_of([(i // 2, i % 2, 0) for i in range(2 * squares + 2)]))
    for i in range(0, 2 * squares, 2):
        strips.InsertNextCell(4, [i, i + 1, i + 2, i + 3])
    data.SetStrips(strips)
    return data


def made(kind, data):
    filter = kind()
    filter.SetInputData(data)
    return filter


class DamagedInputs(unittest.TestCase):
    def expect_error(self, data, pattern, kinds=FILTERS):
        for kind in kinds:
            with self.subTest(filter=kind.__name__), self.assertRaisesRegex(FieldError, pattern):
                update(made(kind, data))

    def test_cells_of_too_few_points_are_named(self):
        positions = [(i % 3, i // 3, 0) for i in range(12)]
        needed = {VTK_PIXEL: 4, VTK_QUADRATIC_TRIANGLE: 6, VTK_QUADRATIC_QUAD: 8, VTK_BIQUADRATIC_QUAD: 9, VTK_QUADRATIC_LINEAR_QUAD: 6,
                  VTK_BIQUADRATIC_TRIANGLE: 7, VTK_LAGRANGE_TRIANGLE: 3, VTK_BEZIER_TRIANGLE: 3, VTK_LAGRANGE_QUADRILATERAL: 4,
                  VTK_BEZIER_QUADRILATERAL: 4}
        for kind, size in needed.items():
            for given in range(size):
                grid = grid_of_types(positions, [(VTK_TRIANGLE, [0, 1, 3]), (kind, range(4, 4 + given))])
                self.expect_error(grid, f"cell 1 of the surface has {given} points, and its type needs {size}", FILTERS[:1])
        self.expect_error(grid, "cell 1 of the surface has 3 points")
        seven = grid_of_types(positions, [(VTK_LAGRANGE_QUADRILATERAL, range(7))])  # VTK takes it for one of 3 x 3
        self.expect_error(seven, "has 7 points, and its type needs 9", FILTERS[:1])

    def test_cells_of_volumes_are_named_too(self):
        """Cells of three dimensions by themselves, and any cell beside a tetrahedron: VTK reads all of them for the skin."""
        positions = [(i % 3, i // 3 % 3, i // 9 + 0.1 * (i % 2)) for i in range(30)]
        solid = {VTK_TETRA: 4, VTK_VOXEL: 8, VTK_HEXAHEDRON: 8, VTK_WEDGE: 6, VTK_PYRAMID: 5, VTK_PENTAGONAL_PRISM: 10,
                 VTK_HEXAGONAL_PRISM: 12, VTK_QUADRATIC_TETRA: 10, VTK_QUADRATIC_HEXAHEDRON: 20, VTK_QUADRATIC_WEDGE: 15,
                 VTK_QUADRATIC_PYRAMID: 13, VTK_TRIQUADRATIC_HEXAHEDRON: 27, VTK_LAGRANGE_TETRAHEDRON: 4, VTK_LAGRANGE_HEXAHEDRON: 8,
                 VTK_LAGRANGE_WEDGE: 6, VTK_BEZIER_TETRAHEDRON: 4, VTK_BEZIER_HEXAHEDRON: 8, VTK_BEZIER_WEDGE: 6}
        flat = {VTK_LINE: 2, VTK_QUADRATIC_EDGE: 3, VTK_TRIANGLE: 3, VTK_PIXEL: 4, VTK_QUAD: 4, VTK_QUADRATIC_QUAD: 8}
        for kind, size in {**solid, **flat}.items():
            for given in range(size):
                grid = grid_of_types(positions, [(VTK_TETRA, [0, 1, 3, 10]), (kind, range(given))])
                self.expect_error(grid, f"cell 1 of the surface has {given} points, and its type needs {size}", FILTERS[:1])
            if kind in solid:
                self.expect_error(grid_of_types(positions, [(kind, range(size - 1))]), "cell 0 of the surface has", FILTERS[:1])
        odd = {VTK_LAGRANGE_TETRAHEDRON: (5, 10), VTK_BEZIER_TETRAHEDRON: (11, 20), VTK_LAGRANGE_WEDGE: (11, 18), VTK_LAGRANGE_HEXAHEDRON: (20, 27)}
        for kind, (given, size) in odd.items():
            self.expect_error(grid_of_types(positions, [(kind, range(given))]), f"has {given} points, and its type needs {size}", FILTERS[:1])
        self.expect_error(grid_of_types(positions, [(VTK_TETRA, [0, 1, 3])]), "cell 0 of the surface has 3 points")

    def test_faces_of_polyhedra_are_checked(self):
        faces = [[0, 2, 1], [0, 1, 3], [1, 2, 3], [2, 0, 3]]

        def polyhedron(faces):
            grid, stream = vtkUnstructuredGrid(), vtkIdList()
            grid.SetPoints(points_of([(0, 0, 0), (1, 0, 0), (0, 1, 0), (0, 0, 1), (5, 5, 5)]))
            for number in [len(faces)] + [number for face in faces for number in [len(face), *face]]:
                stream.InsertNextId(number)
            grid.InsertNextCell(VTK_POLYHEDRON, stream)
            return grid

        self.assertEqual(smooth_field(polyhedron(faces)).GetNumberOfCells(), 4)
        for wrong in ([0, 2], [0], []):
            self.expect_error(polyhedron([wrong] + faces[1:]), "cell 0 of the surface is a polyhedron", FILTERS[:1])
        for wrong in ([0, 2, 99], [0, 2, -1], [0, 2, 10**12]):
            self.expect_error(polyhedron([wrong] + faces[1:]), "cell 0", FILTERS[:1])
        for few in ([], faces[:1]):
            self.expect_error(polyhedron(few), f"is a polyhedron of {len(few)} faces", FILTERS[:1])

    def test_short_arrays_of_volumes_are_those_of_surfaces(self):
        positions = [(x, y, z) for z in range(2) for y in range(40) for x in range(40)]
        at = lambda x, y, z: (z * 40 + y) * 40 + x
        cells = [(VTK_VOXEL, [at(x + i, y + j, k) for k in (0, 1) for j in (0, 1) for i in (0, 1)]) for y in range(39) for x in range(39)]
        for association in ("Point", "Cell"):
            grid = grid_of_types(positions, cells)
            add(getattr(grid, f"Get{association}Data")(), "Short", np.ones((3, 3)))
            self.assertTrue(smooth_field(grid).GetNumberOfCells() > 0)  # nobody asked for it
            with self.assertRaisesRegex(FieldError, "array 'Short'.* has 3 tuples for"):
                smooth_field(grid, Directions="Short")

    def test_blocks_without_a_surface_go_through(self):
        """Beams and node sets beside a surface, as in files of finite elements; and tables."""
        line, vertices = vtkPolyData(), grid_of_types([(0, 0, 0), (1, 0, 0)], [(VTK_VERTEX, [0]), (VTK_VERTEX, [1])])
        line.SetPoints(points_of([(0, 0, 0), (1, 0, 0)]))
        lines = vtkCellArray()
        lines.InsertNextCell(2, [0, 1])
        line.SetLines(lines)
        alone = {kind: update(made(kind, sphere())).GetNumberOfCells() for kind in WITHOUT_ARRAYS}
        for other in (line, vertices):
            for kind in WITHOUT_ARRAYS:
                with self.subTest(kind=kind.__name__, other=other.GetClassName()):
                    blocks = vtkMultiBlockDataSet()
                    blocks.SetBlock(0, other)
                    blocks.SetBlock(1, sphere())
                    result = update(made(kind, blocks))
                    self.assertEqual(result.GetBlock(0).GetNumberOfCells(), other.GetNumberOfCells())
                    self.assertEqual(result.GetBlock(1).GetNumberOfCells(), alone[kind])
        for kind in FILTERS[:2] + (vtkFieldQuads,):
            blocks = vtkMultiBlockDataSet()
            blocks.SetBlock(0, sphere())
            blocks.SetBlock(1, vtkTable())
            with warnings.catch_warnings():
                warnings.simplefilter("ignore")
                self.assertGreater(update(made(kind, blocks)).GetBlock(0).GetNumberOfCells(), 0)

    def test_points_that_are_not_there_are_named_in_cells_of_any_type(self):
        for far in (-10**9, -1, 4, 10**9):
            for kind, size in ((VTK_TRIANGLE, 3), (VTK_LINE, 2), (VTK_VERTEX, 1), (VTK_TETRA, 4)):
                cells = [(VTK_TRIANGLE, [0, 1, 2]), (kind, [0, 1, 2][:size - 1] + [far])]
                self.expect_error(grid_of_types(SQUARE, cells), f"cell 1 uses point {far}, and the surface has 4 points", FILTERS[:1])
                self.expect_error(grid_of_types(SQUARE, cells[1:]), f"cell 0 uses point {far}", FILTERS[:1])
        self.expect_error(grid_of_types(SQUARE, cells), f"cell 1 uses point {far}")
        lines = vtkPolyData()
        lines.DeepCopy(sphere())
        lines.SetLines(vtkCellArray())
        lines.GetLines().InsertNextCell(2, [0, 10**9])
        self.expect_error(lines, "cell 0 uses point 1000000000")

    def test_lists_that_are_shorter_than_their_grid_are_refused(self):
        grid = vtkStructuredGrid()
        grid.SetDimensions(3, 3, 1)
        grid.SetPoints(points_of(SQUARE))
        self.expect_error(grid, "the surface has 4 points for 9 places", FILTERS[:1])
        grid = vtkRectilinearGrid()
        grid.SetDimensions(30, 3, 1)
        for set_axis, values in ((grid.SetXCoordinates, [0, 1]), (grid.SetYCoordinates, [0, 1, 2]), (grid.SetZCoordinates, [0])):
            set_axis(numpy_to_vtk(np.array(values, float), deep=True))
        self.expect_error(grid, "the surface has 2 coordinates along an axis for 30 places", FILTERS[:1])

    def test_edges_and_guides_are_checked_as_the_surface_is(self):
        mesh = sphere()
        solver = made(vtkHarmonicFieldSolver, mesh)
        solver.SetDiscretisation(solver.OneForm)
        update(solver)
        edges = vtkPolyData()
        edges.DeepCopy(solver.GetOutputDataObject(1))
        edges.GetLines().InsertNextCell(2, [0, 10**9])
        edges.GetCellData().GetArray("OneForm").InsertNextTuple([1.0])
        hodge = made(vtkHodgeDecomposition, mesh)
        hodge.SetInputData(1, edges)
        with self.assertRaisesRegex(FieldError, "uses point 1000000000, and the dataset of edges has"):
            update(hodge)
        solver = made(vtkHarmonicFieldSolver, mesh)
        solver.SetInputData(1, edges)
        with self.assertRaisesRegex(FieldError, "uses point 1000000000, and the guide has"):
            update(solver)

    def test_short_arrays_beside_strips_are_handed_on(self):
        data = band_of_strips()
        for name, values in (("None", []), ("Some", [1.0, 2.0])):
            array = vtkDoubleArray()
            array.SetName(name)
            for value in values:
                array.InsertNextValue(value)
            data.GetCellData().AddArray(array)
        for kind in WITHOUT_ARRAYS:
            with self.subTest(filter=kind.__name__):
                update(made(kind, data))
        field = update(made(vtkHarmonicFieldSolver, data))
        self.assertEqual(field.GetNumberOfCells(), 16)
        np.testing.assert_array_equal(vtk_to_numpy(field.GetCellData().GetArray("Some")), [1, 1, 2, 2])
        whole = vtkDoubleArray()
        whole.SetName("V")
        whole.SetNumberOfComponents(3)
        for _ in range(8):
            whole.InsertNextTuple3(1, 0, 0)
        data.GetCellData().AddArray(whole)
        with self.assertRaisesRegex(FieldError, "array 'Some', chosen for the mask of the surface, has 4 tuples for 16 cells"):
            smooth_field(data, Directions="V", Mask="Some")

    def test_numbers_in_arrays_that_are_not_chosen_may_be_anything(self):
        mesh = sphere()
        values = np.full(mesh.GetNumberOfPoints(), np.nan)
        mesh.GetPointData().AddArray(numpy_to_vtk(values, deep=True))  # without a name
        mesh.GetFieldData().AddArray(numpy_to_vtk(values, deep=True))
        strips = band_of_strips()
        add(strips.GetCellData(), "Temperature", [np.nan] + 7 * [1.0])
        for data, cells in ((mesh, mesh.GetNumberOfCells()), (strips, 16)):
            for kind in WITHOUT_ARRAYS:
                with self.subTest(filter=kind.__name__):
                    self.assertEqual(update(made(kind, data)).GetNumberOfCells(), cells)

    def test_points_without_cells_are_refused(self):
        cloud = vtkPolyData()
        cloud.SetPoints(points_of(SQUARE))
        self.expect_error(cloud, "the surface has no triangles or other cells of two dimensions", WITHOUT_ARRAYS)
        self.expect_error(cloud, "the surface has no field|there is no flow|there is nothing to filter|the surface has no triangles", set(FILTERS) - set(WITHOUT_ARRAYS))
        self.assertEqual(update(made(vtkHarmonicFieldSolver, vtkPolyData())).GetNumberOfCells(), 0)  # a source that has nothing yet

    def test_values_count_for_functions_alone(self):
        """They are left over from a function when another kind of field is chosen."""
        mesh = sphere()
        add(mesh.GetPointData(), "S", np.ones(mesh.GetNumberOfPoints()))
        add(mesh.GetCellData(), "G", np.tile([1, 2, 3], (mesh.GetNumberOfCells(), 1)))
        add(mesh.GetCellData(), "W", np.ones(mesh.GetNumberOfCells()))
        for kind in (0, 1, 2, 4):
            solver = made(vtkHarmonicFieldSolver, mesh)
            solver.SetDiscretisation(kind)
            solver.SetInputArrayToProcess(3, 0, 0, 0, "S")
            solver.Update()
            self.assertEqual(solver.GetFollowed(), "nothing")
            solver.SetInputArrayToProcess(1, 0, 0, 1, "G")
            solver.SetInputArrayToProcess(2, 0, 0, 1, "W")
            solver.Update()
            self.assertEqual(solver.GetFollowed(), "array 'G'")
            self.assertEqual(solver.GetOutput().GetNumberOfCells(), mesh.GetNumberOfCells())


class KeptArrays(unittest.TestCase):
    def test_arrays_have_a_tuple_for_each_cell_after_cells_have_come_or_gone(self):
        """Vertices beside the triangles are all that changes."""
        for kind in (vtkHarmonicFieldSolver, vtkDirectionalField):
            filter = kind()
            for vertices in (0, 3, 1):
                cells = [(VTK_TRIANGLE, [0, 1, 2]), (VTK_TRIANGLE, [1, 3, 2])] + vertices * [(VTK_VERTEX, [0])]
                filter.SetInputData(grid_of_types(SQUARE, cells))
                filter.Update()
                self.assertEqual(filter.GetOutput().GetCellData().GetArray("Direction0").GetNumberOfTuples(), 2 + vertices)

    def test_the_caller_may_change_arrays_in_place(self):
        """The next execution gives the filter's own numbers."""
        mesh = sphere()

        def arrays_of(output, edges):
            sets = (output.GetCellData(), output.GetPointData(), output.GetFieldData(), edges.GetCellData() if edges else vtkPolyData().GetCellData())
            return [data.GetArray(k) for data in sets for k in range(data.GetNumberOfArrays()) if data.GetArray(k)]

        for kind in (vtkHarmonicFieldSolver, vtkDirectionalField, vtkDirectionalProlongation):
            filter = made(kind, mesh)
            if kind is vtkHarmonicFieldSolver:
                filter.SetDiscretisation(filter.OneForm)
                filter.SetHarmonicBasis(True)

            def arrays():
                filter.Update()
                return arrays_of(filter.GetOutput(), filter.GetOutputDataObject(1) if kind is vtkHarmonicFieldSolver else None)

            before = {array.GetName(): vtk_to_numpy(array).copy() for array in arrays() if "Seconds" not in array.GetName()}
            for array in arrays():
                if not mesh.GetPointData().HasArray(array.GetName()):
                    vtk_to_numpy(array)[...] = 7
            filter.Modified()
            after = {array.GetName(): vtk_to_numpy(array) for array in arrays()}
            for name, values in before.items():
                with self.subTest(filter=kind.__name__, array=name):
                    np.testing.assert_array_equal(after[name], values)


    def test_the_smoothest_field_does_not_depend_on_former_fields(self):
        """It is an eigenvector, free by a rotation of all directions, and a torus has more than one."""
        mesh = torus(24, 16)

        def power(solver):
            return vtk_to_numpy(update(solver).GetPointData().GetArray("PowerField")).copy()

        fresh = power(made(vtkHarmonicFieldSolver, mesh))
        kept = made(vtkHarmonicFieldSolver, mesh)
        kept.SetCurvatureWeight(1)
        self.assertGreater(np.abs(power(kept) - fresh).max(), 0.1)
        kept.SetCurvatureWeight(0)
        np.testing.assert_array_equal(power(kept), fresh)


class ExtremeProperties(unittest.TestCase):
    def test_a_warning_says_where_cycles_cannot_estimate_their_error(self):
        """1-forms on a sphere that is stretched a thousandfold: all triangles are thin."""
        mesh = sphere(60)
        places = vtk_to_numpy(mesh.GetPoints().GetData())
        places[:, 0] *= 1e3
        given = np.zeros((mesh.GetNumberOfCells(), 3))
        given[::500] = (1, 0, 0)
        add(mesh.GetCellData(), "G", given)
        for solver, is_warned in ((vtkHarmonicFieldSolver.ConjugateGradients, True), (vtkHarmonicFieldSolver.Cholesky, False)):
            form = made(vtkHarmonicFieldSolver, mesh)
            form.SetDiscretisation(form.OneForm)
            form.SetInputArrayToProcess(1, 0, 0, 1, "G")
            form.SetSolver(solver)
            with warnings.catch_warnings(record=True) as said:
                warnings.simplefilter("always")
                update(form)
            texts = " ".join(str(warning.message) for warning in said)
            self.assertEqual("triangles are thin, where cycles" in texts or "did not converge" in texts, is_warned, texts)

    def test_a_point_far_away_is_named_where_vectors_cannot_be_carried(self):
        for far in (1e8, 1e20, 1e36):
            mesh = sphere(20)
            mesh.GetPoints().SetPoint(100, far, 0, 0)
            transport = made(vtkParallelTransport, mesh)
            transport.SetPoint(0, 0, 0.5)
            try:
                self.assertEqual(update(transport).GetNumberOfCells(), mesh.GetNumberOfCells())
            except FieldError as error:
                self.assertRegex(str(error), r"the point at \(1e\+\d+, 0, 0\) is the farthest from the others; move it")

    def test_principal_directions_of_polygons_have_unit_length(self):
        """A quad of an ellipsoid has two triangles, whose directions are not the same."""
        a, b = np.meshgrid(2 * np.pi * np.arange(24) / 24, np.pi * np.arange(1, 12) / 12)
        places = np.stack([np.cos(a) * np.sin(b), 1.2 * np.sin(a) * np.sin(b), 1.5 * np.cos(b)], axis=-1).reshape(-1, 3)
        quads = [[24 * j + i, 24 * (j + 1) + i, 24 * (j + 1) + (i + 1) % 24, 24 * j + (i + 1) % 24] for j in range(10) for i in range(24)]
        cells = update(made(vtkPrincipalDirections, polygons(places, quads))).GetCellData()
        for name in ("MaximumDirection", "MinimumDirection"):
            np.testing.assert_allclose(np.linalg.norm(vtk_to_numpy(cells.GetArray(name)), axis=1), 1)

    def test_axes_have_a_direction_of_any_length(self):
        mesh = sphere()
        for name in ("East", "North"):
            add(mesh.GetPointData(), name, np.ones(mesh.GetNumberOfPoints()))

        def energy(*axis):
            hodge = made(vtkHodgeDecomposition, mesh)
            hodge.SetAxis(*axis)
            hodge.SetInputArrayToProcess(1, 0, 0, 0, "East")
            hodge.SetInputArrayToProcess(2, 0, 0, 0, "North")
            return update(hodge).GetFieldData().GetArray("FlowEnergies").GetValue(0)

        def angle(*axis):
            angles = made(vtkFieldAngles, smooth_field(mesh))
            angles.SetAxis(*axis)
            return vtk_to_numpy(update(angles).GetCellData().GetArray("Angle"))

        for length in (1e150, 1e200, 1e-200, 1e300):
            self.assertAlmostEqual(energy(0, 0, length), energy(0, 0, 1))
            np.testing.assert_allclose(angle(0, length, 0), angle(0, 1, 0), atol=1e-9)
        for wrong in ((np.nan, 0, 0), (0, np.inf, 0), (0, 0, 0)):
            for measure in (energy, angle):
                with self.assertRaisesRegex(FieldError, "Axis is .*, which has no direction"):
                    measure(*wrong)

    def test_balls_are_drawn_at_the_largest_coordinates(self):
        """Those are beyond what floats hold; so is an edge of quads that is the longest of its range."""
        quads = made(vtkFieldQuads, sphere())
        quads.SetEdgeLength(1e40)
        update(quads)
        self.assertGreater(quads.GetOutput(2).GetNumberOfPoints(), 0)
        far = sphere()
        far.GetPoints().SetData(numpy_to_vtk(9e39 / 0.5 * vtk_to_numpy(far.GetPoints().GetData()).astype(float), deep=True))
        quads.SetEdgeLength(0)
        quads.SetNumberOfQuads(60)
        for balls, port, data in ((quads, 2, far), (vtkFieldSingularities(), 3, smooth_field(far))):
            balls.SetInputData(data)
            update(balls)
            lengths = np.linalg.norm(vtk_to_numpy(balls.GetOutput(port).GetPoints().GetData()) / 9e39, axis=1)
            np.testing.assert_allclose(lengths, 1, atol=0.3)

    def test_flows_are_decomposed_or_refused_by_their_size(self):
        """Parts of a flow are as large as the flow, whatever its unit."""
        mesh = sphere()
        flow = np.tile([1.0, 2, 3], (mesh.GetNumberOfCells(), 1))

        def gradient(scale, length=1):
            add(mesh.GetCellData(), "U", scale * flow)
            hodge = made(vtkHodgeDecomposition, mesh)
            hodge.SetInputArrayToProcess(0, 0, 0, 1, "U")
            hodge.SetLengthScale(length)
            return np.abs(vtk_to_numpy(update(hodge).GetCellData().GetArray("GradientPart"))).max() / scale

        one = gradient(1)
        self.assertGreater(one, 1)
        for scale in (1e-39, 1e39):
            self.assertAlmostEqual(gradient(scale), one)
        self.assertAlmostEqual(gradient(1e39, 1e30), one)
        for scale in (1e-170, 1e-300, 1e160):
            with self.assertRaisesRegex(FieldError, "the largest vector of the flow is .*bring it to between 1e-40 and 1e\\+40"):
                gradient(scale)
        with self.assertRaisesRegex(FieldError, "Length Scale is 1e\\+300; choose a value from 1e-30 to 1e\\+30"):
            gradient(1, 1e300)


class CellsOfTooFewPoints(unittest.TestCase):
    """VTK does not number the cells of polygonal data where one has too few points for its list; the other cells count all the same."""

    def test_a_guide_of_such_cells_is_followed_by_its_line(self):
        line = guide_of(("Lines", (0, 1)))
        expected = values(smooth_field(torus(12, 8), guides=line).GetCellData(), "Direction0")
        for short in ((), (0,), (0, 1)):
            for kind in ("Verts", "Lines", "Polys", "Strips"):
                if short and kind == "Verts" or len(short) == 2 and kind == "Lines":
                    continue
                with self.subTest(kind, size=len(short)):
                    field = smooth_field(torus(12, 8), guides=guide_of(("Lines", (0, 1)), (kind, short)))
                    np.testing.assert_array_equal(values(field.GetCellData(), "Direction0"), expected)


def guide_of(*cells):
    """Polygonal data on two points of the torus, with cells by list."""
    guide = vtkPolyData()
    guide.SetPoints(vtkPoints())
    guide.GetPoints().InsertNextPoint(1.4, 0, 0)
    guide.GetPoints().InsertNextPoint(1.3, 0.4, 0.1)
    lists = {}
    for kind, points in cells:
        lists.setdefault(kind, vtkCellArray()).InsertNextCell(len(points), list(points))
    for kind, array in lists.items():
        getattr(guide, f"Set{kind}")(array)
    return guide


if __name__ == "__main__":
    unittest.main()
