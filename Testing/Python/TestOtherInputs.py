"""Inputs as people have them: vectors that no one has asked to follow, that stand on end or are missing, tensors, axes without
a sign, and processes that fork. Each gives a field, or a sentence that says what to do."""

import os
import signal
import subprocess
import sys
import unittest
import warnings

import numpy as np
from vtkmodules.vtkCommonCore import vtkPoints, vtkStringArray
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkFiltersSources import vtkSphereSource

from directionalmultigrid import FieldError, FieldWarning, hodge, smooth_field, update
from directionalmultigrid.vtkFiltersDirectionalFields import (
    vtkFieldAngles, vtkFieldGlyphs, vtkFieldLines, vtkFieldSingularities, vtkHarmonicFieldSolver)
from any_surfaces import points_of
from surfaces import add, corners, surface, torus, values, values_of_points


def sphere(resolution=40):
    source = vtkSphereSource()
    source.SetThetaResolution(resolution)
    source.SetPhiResolution(resolution)
    return update(source)


def centres(mesh):
    return values_of_points(mesh)[corners(mesh)].mean(axis=1)


class OtherInputs(unittest.TestCase):
    def test_nothing_is_followed_that_was_not_chosen(self):
        """A result of a simulation has zero vectors at its first step."""
        mesh = sphere()
        mesh.GetPointData().SetVectors(add(mesh.GetPointData(), "displacement", np.zeros((mesh.GetNumberOfPoints(), 3))))
        solver = vtkHarmonicFieldSolver()
        solver.SetInputData(mesh)
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            report = update(solver).GetFieldData()
        self.assertTrue(report.HasArray("Eigenvalues"))
        self.assertEqual(report.GetAbstractArray("Followed").GetValue(0), "nothing")

    def test_indices_of_singularities_are_no_text(self):
        mesh, given, text = sphere(), vtkPolyData(), vtkStringArray()
        given.SetPoints(points_of([(0, 0, 0.5), (0, 0, -0.5)]))
        text.SetName("Index")
        text.SetNumberOfValues(2)
        given.GetPointData().AddArray(text)
        solver = vtkHarmonicFieldSolver()
        solver.SetInputData(mesh)
        solver.SetInputData(2, given)
        solver.SetNumberOfDirections(1)
        with self.assertRaisesRegex(FieldError, "holds text, and an index is a number"):
            update(solver)
        given.GetPointData().RemoveArray("Index")
        update(solver)

    def test_what_is_followed_is_written_in_the_report(self):
        """Features are there if the surface has them: a sphere bends alike in all directions, a torus does not."""
        for mesh, features in ((sphere(), ""), (torus(24, 12), ", curvature")):
            add(mesh.GetCellData(), "Around", np.cross((0, 0, 1.0), centres(mesh)))
            with warnings.catch_warnings():
                warnings.simplefilter("ignore", FieldWarning)  # the sphere's
                field = smooth_field(mesh, n=2, Directions="Around", CurvatureWeight=1e-3)
            self.assertEqual(field.GetFieldData().GetAbstractArray("Followed").GetValue(0), "array 'Around'" + features)

    def test_a_uniform_vector_is_left_out_where_it_stands_on_end(self):
        """Any uniform wind is perpendicular to a sphere at two points."""
        mesh = sphere()
        add(mesh.GetPointData(), "wind", np.tile((0.0, 0, 1), (mesh.GetNumberOfPoints(), 1)))
        with self.assertWarnsRegex(FieldWarning, "left out: 2 perpendicular to the surface"):
            field = smooth_field(mesh, n=1, Directions="wind")
        middle = np.abs(centres(mesh)[:, 2]) < 0.25
        self.assertGreater(values(field.GetCellData(), "Direction0")[middle, 2].min(), 0.85)  # cos 30 degrees

    def test_what_was_not_measured_is_left_out(self):
        """NaN in vectors, mask and weights; one warning counts them."""
        for holes in ("vectors", "mask", "weights"):
            with self.subTest(holes=holes):
                mesh = sphere()
                place = centres(mesh)
                around, mask, weights = np.cross((0, 0, 1.0), place), np.ones(len(place)), np.ones(len(place))
                upper = place[:, 2] > 0
                {"vectors": around, "mask": mask, "weights": weights}[holes][upper] = np.nan
                for name, array in (("D", around), ("M", mask), ("W", weights)):
                    add(mesh.GetCellData(), name, array)
                with self.assertWarnsRegex(FieldWarning, f"left out: {upper.sum()} not finite"):
                    field = smooth_field(mesh, n=1, Directions="D", Mask="M", Weights="W")
                prescribed = values(field.GetPointData(), "Prescribed") > 0
                # The points inside of the region are held, its rim is free; triangles without such a point hold all corners.
                inside = np.ones(mesh.GetNumberOfPoints(), bool)
                inside[corners(mesh)[upper]] = False
                lower = corners(mesh)[~upper]
                inside[lower[~inside[lower].any(axis=1)]] = True
                np.testing.assert_array_equal(prescribed, inside)
        add(mesh.GetCellData(), "D", np.full((len(place), 3), np.nan))
        with self.assertRaisesRegex(FieldError, "no direction is prescribed"):
            smooth_field(mesh, n=1, Directions="D")

    def test_lines_follow_the_largest_principal_stress(self):
        """Of 6 components (XX YY ZZ XY YZ XZ) and of 9, at points and on cells; the smallest is 90 degrees from it."""
        mesh = sphere()
        place = centres(mesh)
        for attributes, size in ((mesh.GetCellData(), len(place)), (mesh.GetPointData(), mesh.GetNumberOfPoints())):
            add(attributes, "six", np.tile((1.0, 0, 0, 0, 0, 0), (size, 1)))
            add(attributes, "nine", np.tile((1.0, 0, 0, 0, 0, 0, 0, 0, 0), (size, 1)))
            for name in ("six", "nine"):
                for rotation in (0.0, 90.0):
                    field = smooth_field(mesh, n=2, Directions=name, Rotation=rotation)
                    self.assertGreater(self.along_x(field, place, rotation), 0.99)
                    crosses = smooth_field(mesh, n=4, Directions=name, Rotation=rotation, AllDirections=True)
                    self.assertGreater(max(self.along_x(crosses, place, 0.0, k) for k in range(4)), 0.99)
                angles = vtkFieldAngles()
                angles.SetInputData(mesh)
                angles.SetInputArrayToProcess(0, 0, 0, int(attributes is mesh.GetCellData()), name)
                angles.SetAxis(1, 0, 0)
                self.assertLess(np.median(np.abs(values(update(angles).GetCellData(), "Angle"))), 3)  # degrees
            mesh.GetPointData().Initialize()
            mesh.GetCellData().Initialize()

    @staticmethod
    def along_x(field, place, rotation, k=0):
        """The median cosine between direction k of the field and the x-axis in the surface, turned about the normal."""
        normal = place / np.linalg.norm(place, axis=1, keepdims=True)
        axis = (1.0, 0, 0) - normal * normal[:, :1]
        away = np.linalg.norm(axis, axis=1) > 0.5
        axis /= np.linalg.norm(axis, axis=1, keepdims=True) + 1e-300
        turned = axis if rotation == 0.0 else np.cross(normal, axis)
        return np.median(np.abs((values(field.GetCellData(), f"Direction{k}") * turned).sum(axis=1))[away])

    def test_tensors_are_drawn_as_lines_and_refuse_vectors(self):
        mesh = sphere()
        add(mesh.GetCellData(), "S", np.tile((1.0, 0, 0, 0, 0, 0), (mesh.GetNumberOfCells(), 1)))
        for kind in (vtkFieldLines, vtkFieldGlyphs, vtkFieldSingularities):
            drawing = kind()
            drawing.SetInputData(mesh)
            drawing.SetInputArrayToProcess(0, 0, 0, 1, "S")
            self.assertGreater(update(drawing).GetNumberOfPoints(), 0)
            drawing.SetNumberOfDirections(1)
            with self.assertRaisesRegex(FieldError, "no sign; choose 2 or 4 as Number Of Directions"):
                update(drawing)
        with self.assertRaisesRegex(FieldError, "even Number Of Directions"):
            smooth_field(mesh, n=1, Directions="S")

    def test_vectors_of_two_components_are_those_of_the_plane(self):
        plane = surface([(0, 0, 1), (4, 0, 1), (4, 4, 1), (0, 4, 1), (2, 2, 1)], [(0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4)])
        add(plane.GetCellData(), "V", np.tile((0.6, 0.8), (4, 1)))
        np.testing.assert_allclose(
            values(smooth_field(plane, n=1, Directions="V").GetCellData(), "Direction0"),
            np.tile((0.6, 0.8, 0), (4, 1)), atol=1e-6)
        add(plane.GetCellData(), "W", np.tile((0.6, 0.8, 0.0), (4, 1)))
        potentials = [values(hodge(plane, name).GetPointData(), "Potential") for name in "VW"]
        np.testing.assert_array_equal(*potentials)
        self.assertGreater(np.ptp(potentials[0]), 1)
        bent = sphere()
        add(bent.GetPointData(), "V", np.tile((0.6, 0.8), (bent.GetNumberOfPoints(), 1)))
        for call in (lambda: smooth_field(bent, Directions="V"), lambda: hodge(bent, "V")):
            with self.assertRaisesRegex(FieldError, "array 'V' holds vectors of 2 numbers, .* with Calculator"):
                call()

    def test_hard_constraints_everywhere_are_the_field(self):
        """An axis on every triangle, turned by 30 degrees."""
        mesh = sphere()
        place = centres(mesh)
        normal = place / np.linalg.norm(place, axis=1, keepdims=True)
        around = np.cross((0, 0, 1.0), normal)
        around /= np.linalg.norm(around, axis=1, keepdims=True)
        add(mesh.GetCellData(), "axis", around)
        for kind, n in (("PointPowerField", 2), ("PowerField", 2), ("FaceField", 1)):
            field = smooth_field(mesh, n=n, Discretisation=kind, Directions="axis", ConstraintType="Hard", Rotation=30.0)
            turned = np.cos(np.radians(30)) * around + np.sin(np.radians(30)) * np.cross(normal, around)
            cosine = (values(field.GetCellData(), "Direction0") * turned).sum(axis=1)
            self.assertGreater(np.abs(cosine).min(), 0.99)  # a facet's normal is not quite that of the sphere
            self.assertEqual(field.GetFieldData().GetArray("Converged").GetValue(0), 1)

    def test_an_axis_without_a_sign_is_told(self):
        mesh = sphere()
        around = np.cross((0, 0, 1.0), centres(mesh))
        at_points = np.cross((0, 0, 1.0), values_of_points(mesh))
        random = np.random.default_rng(3)
        for association, attributes, axis in ((1, mesh.GetCellData(), around), (0, mesh.GetPointData(), at_points)):
            add(attributes, "E", axis * random.choice((-1.0, 1.0), (len(axis), 1)))
            add(attributes, "V", axis)
            for kind in (vtkFieldSingularities, vtkFieldLines):
                drawing = kind()
                drawing.SetInputData(mesh)
                drawing.SetInputArrayToProcess(0, 0, 0, association, "E")
                with self.assertWarnsRegex(FieldWarning, "'E' seems to have no sign.*choose 2 as Number Of Directions"):
                    update(drawing)
                drawing.SetNumberOfDirections(2)
                with warnings.catch_warnings():
                    warnings.simplefilter("error")
                    update(drawing)
                drawing.SetNumberOfDirections(1)
                drawing.SetInputArrayToProcess(0, 0, 0, association, "V")
                with warnings.catch_warnings():
                    warnings.simplefilter("error")
                    update(drawing)

    def test_neither_normals_nor_colours_are_proposed_as_directions_of_guides(self):
        singularities = vtkFieldSingularities()
        singularities.SetInputData(smooth_field(sphere(), n=4))
        update(singularities)
        spheres = singularities.GetOutput(3)
        self.assertEqual([spheres.GetPointData().GetArray(name).GetNumberOfComponents() for name in ("Normals", "SignColor")], [3, 3])
        with self.assertRaisesRegex(FieldError, "neither lines nor vectors to follow"):
            smooth_field(sphere(), guides=[spheres])

    def test_a_mesh_without_cells_is_an_error(self):
        mesh, points = vtkPolyData(), vtkPoints()
        for i in range(5):
            points.InsertNextPoint(i, i * i, 0)
        with self.assertRaisesRegex(FieldError, "no cells"):
            smooth_field(mesh)
        mesh.SetPoints(points)
        with self.assertRaisesRegex(FieldError, "no cells"):
            smooth_field(mesh)

    def test_a_child_after_a_fork_computes_the_same_bits(self):
        code = ("import os\n"
                "from directionalmultigrid import smooth_field\n"
                "from TestOtherInputs import sphere, values\n"
                "def field():\n"
                "    return values(smooth_field(sphere(100)).GetCellData(), 'PowerField').tobytes()\n"
                "expected = field()\n"
                "child = os.fork()\n"
                "if child == 0:\n"
                "    os._exit(0 if len(field()) == len(expected) else 1)\n"
                "assert os.waitpid(child, 0)[1] == 0\n"
                "field()\n")
        process = subprocess.Popen([sys.executable, "-c", code], start_new_session=True,
                                   cwd=os.path.dirname(os.path.abspath(__file__)))
        try:
            self.assertEqual(process.wait(timeout=120), 0)
        finally:
            if process.poll() is None:
                os.killpg(process.pid, signal.SIGKILL)
                process.wait()


if __name__ == "__main__":
    unittest.main()
