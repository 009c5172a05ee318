"""The package's functions: one call for a field, errors as exceptions, and the accessor of PyVista."""

import importlib
import importlib.metadata
import os
import subprocess
import sys
import types
import typing
import unittest
import unittest.mock
import warnings

import numpy as np
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkFiltersSources import vtkLineSource, vtkSphereSource
from vtkmodules.vtkIOPLY import vtkPLYReader
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

import directionalmultigrid
from directionalmultigrid import FieldError, FieldWarning, draw_as_ink, quads, smooth_field, transport, update, write_rosy, write_sharp
from directionalmultigrid.vtkFiltersDirectionalFields import vtkFieldLines, vtkFieldSingularities, vtkHarmonicFieldSolver
from surfaces import prescribe, surface, torus, values, values_of_points


class Derived(vtkPolyData):
    """As the meshes of PyVista are derived from vtkPolyData."""


def run(code):
    """Runs code in an interpreter of its own: what it prints, and its messages."""
    done = subprocess.run([sys.executable, "-c", code], check=True, text=True, capture_output=True,
                          cwd=os.path.dirname(os.path.abspath(__file__)))
    return done.stdout, done.stderr


def with_a_point_nowhere():
    mesh = torus(20, 10)
    mesh.GetPoints().SetPoint(3, np.nan, 0, 0)
    return mesh


class SmoothField(unittest.TestCase):
    def direction(self, mesh):
        return values(mesh.GetCellData(), "Direction0")

    def test_gives_what_the_filter_gives_and_leaves_the_mesh_alone(self):
        mesh = prescribe(torus(20, 10), {7: (1, 2, 3)})
        solver = vtkHarmonicFieldSolver()
        solver.SetInputData(mesh)
        solver.SetInputArrayToProcess(1, 0, 0, 1, "Given")
        solver.SetNumberOfDirections(2)
        solver.SetConstraintType(vtkHarmonicFieldSolver.Hard)
        solver.Update()
        result = smooth_field(mesh, n=2, Directions="Given", ConstraintType="Hard")
        np.testing.assert_array_equal(self.direction(result), self.direction(solver.GetOutput()))
        self.assertEqual(mesh.GetCellData().GetNumberOfArrays(), 1)

    def test_returns_the_class_that_it_takes(self):
        mesh = Derived()
        mesh.ShallowCopy(torus(20, 10))
        self.assertIs(type(smooth_field(mesh)), Derived)
        self.assertIs(type(smooth_field(torus(20, 10))), vtkPolyData)

    def test_takes_meshes_of_pyvista(self):
        try:
            pyvista = importlib.import_module("pyvista")
        except ImportError:
            self.skipTest("PyVista is not installed")
        result = smooth_field(pyvista.PolyData(torus(20, 10)), n=2)
        self.assertIs(type(result), pyvista.PolyData)
        np.testing.assert_array_equal(result.cell_data["Direction0"], self.direction(smooth_field(torus(20, 10), n=2)))

    def test_follows_guides_one_or_several(self):
        """On a plane a field of lines along one straight guide is constant, and so is one along two that are parallel."""
        mesh = surface([(0, 0, 0), (4, 0, 0), (4, 4, 0), (0, 4, 0), (2, 2, 0)],
                       [(0, 1, 4), (1, 2, 4), (2, 3, 4), (3, 0, 4)])
        lines = []
        for shift in (0.5, 1.0):
            line = vtkLineSource()
            line.SetPoint1(shift, 0.5, 0)
            line.SetPoint2(shift + 1.5, 2.5, 0)
            line.Update()
            lines.append(line.GetOutput())
        for guides in (lines[0], lines[:1], tuple(lines), iter(lines)):
            along = self.direction(smooth_field(mesh, guides, 2)) @ (0.6, 0.8, 0)
            np.testing.assert_allclose(np.abs(along), 1, atol=1e-6)

    def test_singularities_stand_where_they_are_put(self):
        """An octahedron's corners on a sphere: index 1/3 each, which sum to 2."""
        sphere = vtkSphereSource()
        sphere.SetThetaResolution(32)
        sphere.SetPhiResolution(33)
        sphere.Update()
        corners = surface(0.5 * np.concatenate([np.eye(3), -np.eye(3)]), [])
        result = smooth_field(sphere.GetOutput(), n=3, singularities=corners)
        indices = values(result.GetPointData(), "SingularityIndex")
        np.testing.assert_allclose(indices[np.abs(indices) > 1e-9], 1 / 3)
        self.assertEqual(np.count_nonzero(np.abs(indices) > 1e-9), 6)

    def test_indices_are_no_negative_zeros(self):
        source = vtkSphereSource()
        source.SetThetaResolution(32)
        source.SetPhiResolution(33)
        sphere = update(source)
        for kind in ("PointPowerField", "PowerField", "FaceField", "OneForm"):
            for n in (1,) if kind in ("FaceField", "OneForm") else (1, 2, 4):
                with warnings.catch_warnings():
                    warnings.simplefilter("ignore")  # the triangles are sheared
                    field = smooth_field(sphere, n=n, Discretisation=kind)
                for attributes in (field.GetPointData(), field.GetCellData()):
                    if attributes.HasArray("SingularityIndex"):
                        indices = values(attributes, "SingularityIndex")
                        self.assertFalse((np.signbit(indices) & (indices == 0)).any(), (kind, n))

    def test_no_singularities_may_be_prescribed(self):
        """A torus may have none, a sphere has to have some; None prescribes nothing."""
        tilted = prescribe(torus(20, 10), {7: (1, 2, 3), 150: (3, -1, 2), 260: (-2, 3, 1)})
        for nothing in ((), [], iter(())):
            result = smooth_field(tilted, singularities=nothing, Directions="Given")
            self.assertEqual(np.abs(values(result.GetPointData(), "SingularityIndex")).max(), 0)
        sphere = update(vtkSphereSource())
        with self.assertRaisesRegex(FieldError, "sum"):
            smooth_field(sphere, singularities=[])
        self.assertAlmostEqual(values(smooth_field(sphere, singularities=None).GetCellData(), "SingularityIndex").sum(), 2)

    def test_only_power_fields_have_several_directions(self):
        mesh = torus(20, 10)
        for kind in ("FaceField", "OneForm"):
            for n in (None, 1):
                result = smooth_field(mesh, n=n, Discretisation=kind)
                self.assertFalse(result.GetCellData().HasArray("Direction1"))
            with self.assertRaisesRegex(FieldError, "n = 4, but only power fields"):
                smooth_field(mesh, n=4, Discretisation=kind)
        self.assertTrue(smooth_field(mesh, AllDirections=True).GetCellData().HasArray("Direction3"))

    def test_drawings_need_the_first_direction_alone(self):
        """The number of directions comes from the report of the solver."""
        for n in (2, 3, 4):
            drawn = []
            for all_directions in (False, True):
                field = smooth_field(torus(20, 10), n=n, AllDirections=all_directions)
                self.assertEqual(field.GetCellData().HasArray("Direction1"), all_directions)
                lines, singularities = vtkFieldLines(), vtkFieldSingularities()
                for each in (lines, singularities):
                    each.SetInputData(field)
                    update(each)
                drawn.append((values_of_points(lines.GetOutput()).tolist(),
                              values(lines.GetOutput().GetCellData(), "Branch").tolist(),
                              values(singularities.GetOutput().GetPointData(), "Index").tolist()))
            self.assertEqual(drawn[0], drawn[1])

    def test_takes_numbers_of_numpy(self):
        mesh = torus(20, 10)
        result = smooth_field(mesh, n=np.int64(2), Tolerance=np.float32(1e-3), UnitLength=np.bool_(True), AllDirections=True,
                              Rotation=3)
        self.assertFalse(result.GetCellData().HasArray("Direction2"))

    def test_follows_no_array_that_is_not_named(self):
        """A result has active vectors; a field made on it is the same as one on the bare surface."""
        mesh = torus(20, 10)
        result = smooth_field(mesh, n=1)
        np.testing.assert_array_equal(self.direction(smooth_field(result)), self.direction(smooth_field(mesh)))

    def test_errors_name_what_is_wrong(self):
        mesh = torus(20, 10)
        for error, text, arguments in (
                (TypeError, "no property Allignment; did you mean Alignment", {"Allignment": 2}),
                (TypeError, "there are Alignment, .*Weights", {"Xyzq": 2}),
                (TypeError, "did you mean n[?]", {"NumberOfDirections": 2}),
                (TypeError, "did you mean n[?]", {"number_of_directions": 2}),
                (TypeError, "did you mean n[?]", {"N": 2}),
                (TypeError, "did you mean MaximumDistance[?]", {"max_distance": 2}),
                (TypeError, "did you mean guides[?]", {"Guide": 2}),
                (TypeError, "Tolerance = 'small'", {"Tolerance": "small"}),
                (TypeError, "Tolerance = None", {"Tolerance": None}),
                (TypeError, "Tolerance = True", {"Tolerance": True}),
                (FieldError, "Tolerance = nan is out of range$", {"Tolerance": float("nan")}),
                (FieldError, "Alignment = inf is out of range$", {"Alignment": float("inf")}),
                (FieldError, "Alignment = 10+ is out of range$", {"Alignment": 10**400}),
                (FieldError, "ExpectedSolves = 10+ is out of range$", {"ExpectedSolves": 10**30}),
                (TypeError, "ExpectedSolves = 2.5: .*integer", {"ExpectedSolves": 2.5}),
                (TypeError, "NumberOfDirections = True: .*integer", {"n": True}),
                (TypeError, "NumberOfDirections = 'four': .*integer", {"n": "four"}),
                (TypeError, "Discretisation = True: .*integer", {"Discretisation": True}),
                (TypeError, "Discretisation = None: .*integer", {"Discretisation": None}),
                (TypeError, "UnitLength = None: .*True or False", {"UnitLength": None}),
                (TypeError, "UnitLength = 'off': .*True or False", {"UnitLength": "off"}),
                (TypeError, "UnitLength = array.*True or False", {"UnitLength": np.array([1, 0])}),
                (FieldError, "no array 'm{99}[.][.][.]'; it has", {"Mask": "m" * 500}),
                (TypeError, "no property p{99}[.][.][.]; there", {"p" * 500: 1}),
                (TypeError, "GuideWeights = None: .*name", {"GuideWeights": None}),
                (TypeError, "guides are datasets", {"guides": [3]}),
                (TypeError, "guides are datasets", {"guides": 3}),
                (TypeError, "singularities are datasets", {"singularities": iter(["x"])}),
                (TypeError, "no name of an array", {"Mask": 3}),
                (FieldError, "^Number Of Directions is 9; .* 1 to 8$", {"n": 9}),
                (FieldError, "^Rotation is 200; .* -180 to 180$", {"Rotation": 200}),
                (FieldError, "one of LinearInterpolation, StructurePreserving$", {"CoarseSpace": "Voronoi"}),
                (FieldError, "one of PowerField, FaceField, OneForm, ScalarFunction, PointPowerField$", {"Discretisation": "1-Form"}),
                (FieldError, "no array 'Given'", {"Directions": "Given"})):
            with self.subTest(arguments=arguments), self.assertRaisesRegex(error, text):
                smooth_field(mesh, **arguments)
        with self.assertRaisesRegex(TypeError, "no vtkDataSet"):
            smooth_field("mesh.vtp")

    def test_a_mesh_of_another_vtk_is_told_apart(self):
        """Another build of VTK has classes of the same names, which ours do not know."""
        of_vtk = type("vtkObjectBase", (), {})
        mesh = type("PolyData", (type("vtkPolyData", (of_vtk,), {}),), {})()
        for call in (lambda: smooth_field(mesh), lambda: smooth_field(torus(20, 10), mesh), lambda: update(mesh)):
            with self.assertRaisesRegex(TypeError, "another VTK"):
                call()

    def test_what_the_filter_reports_is_raised(self):
        with self.assertRaises(FieldError) as caught:
            smooth_field(with_a_point_nowhere())
        self.assertRegex(str(caught.exception), r"\A.*point 3.*not finite.*\Z")  # one line, without address or file
        self.assertNotIn("0x", str(caught.exception))

    def test_what_the_filter_warns_of_is_a_warning_at_the_call(self):
        with self.assertWarnsRegex(FieldWarning, "no boundary") as caught:
            result = smooth_field(torus(20, 10), BoundaryWeight=1)
        self.assertEqual(os.path.basename(caught.filename), os.path.basename(__file__))
        self.assertTrue(result.GetCellData().HasArray("Direction0"))

    def test_nothing_goes_to_standard_error(self):
        _, messages = run("from TestPackage import *\n"
                          "for call in (lambda: smooth_field(with_a_point_nowhere()), lambda: update(vtkHarmonicFieldSolver())):\n"
                          "    try:\n        call()\n    except FieldError:\n        continue\n"
                          "    raise AssertionError\n")
        self.assertEqual(messages, "")


class OtherTypes(unittest.TestCase):
    def test_each_function_names_what_is_of_another_type(self):
        mesh = torus(12, 8)
        for text, call in (("the mesh is of type NoneType", lambda: write_rosy("field", None)),
                           ("the mesh is of type int", lambda: write_sharp("field", 5)),
                           ("FeatureAngle = 'x'", lambda: write_sharp("field", mesh, "x")),
                           ("the actor is of type int", lambda: draw_as_ink(5)),
                           ("point = 3: .*vector", lambda: transport(mesh, point=3)),
                           ("direction = 'xyz': .*vector", lambda: transport(mesh, direction="xyz")),
                           ("NumberOfQuads = '5'", lambda: quads(mesh, number="5"))):
            with self.subTest(text), self.assertRaisesRegex(TypeError, text):
                call()

    def test_a_volume_is_noted_in_the_log_once(self):
        """Two filters on two volumes: a line on standard error, none on standard output."""
        code = """if True:
            from vtkmodules.vtkImagingCore import vtkRTAnalyticSource
            from directionalmultigrid import update
            from directionalmultigrid.vtkFiltersDirectionalFields import vtkHarmonicFieldSolver
            for size in (3, 4):
                source, solver = vtkRTAnalyticSource(), vtkHarmonicFieldSolver()
                source.SetWholeExtent(0, size, 0, 3, 0, 3)
                solver.SetInputConnection(source.GetOutputPort())
                update(solver)
        """
        done = subprocess.run([sys.executable, "-c", code], text=True, check=True, stdout=subprocess.PIPE, stderr=subprocess.PIPE)
        self.assertEqual(done.stdout, "")
        self.assertEqual(done.stderr.count("its skin is the surface"), 1)


class Update(unittest.TestCase):
    def test_returns_the_first_output_and_warns_of_nothing(self):
        solver = vtkHarmonicFieldSolver()
        solver.SetInputData(torus(20, 10))
        singularities = vtkFieldSingularities()
        singularities.SetInputConnection(solver.GetOutputPort())
        with warnings.catch_warnings():
            warnings.simplefilter("error")
            self.assertIs(update(singularities), singularities.GetOutput())

    def test_raises_each_time_and_recovers(self):
        solver = vtkHarmonicFieldSolver()
        for _ in range(2):
            with self.assertRaisesRegex(FieldError, "Input port 0"):
                update(solver)
        solver.SetInputData(with_a_point_nowhere())
        for _ in range(2):
            with self.assertRaisesRegex(FieldError, "not finite"):
                update(solver)
        solver.SetInputData(torus(20, 10))
        self.assertEqual(update(solver).GetNumberOfCells(), 400)
        self.assertFalse(solver.HasObserver("ErrorEvent"))

    def test_raises_what_stands_before_it_reports(self):
        reader = vtkXMLPolyDataReader()
        reader.SetFileName("no such file.vtp")
        solver = vtkHarmonicFieldSolver()
        solver.SetInputConnection(reader.GetOutputPort())
        with self.assertRaisesRegex(FieldError, "no such file.vtp"):
            update(solver)
        with self.assertRaisesRegex(TypeError, "no VTK filter"):
            update(torus(20, 10))

    def test_says_in_a_line_what_a_reader_only_warns_of(self):
        reader = vtkPLYReader()
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")
            with self.assertRaisesRegex(FieldError, r"\AvtkPLYReader failed: [^\n]*\Z"):
                update(reader)
            reader.SetFileName("no such file.ply")
            with self.assertRaisesRegex(FieldError, r"\AvtkPLYReader failed on 'no such file.ply': [^\n]*\Z"):
                update(reader)


class Package(unittest.TestCase):
    def test_loads_nothing_before_it_is_used(self):
        printed, _ = run("import sys\nfrom directionalmultigrid.vtkFiltersDirectionalFields import vtkFieldLines\n"
                         "print([name for name in sys.modules if name.startswith('directionalmultigrid.')])\n")
        self.assertEqual(printed.strip(), "['directionalmultigrid.vtkFiltersDirectionalFields']")

    def test_is_annotated(self):
        for name in directionalmultigrid.__all__:
            item = getattr(directionalmultigrid, name)
            if isinstance(item, types.FunctionType):
                hints = typing.get_type_hints(item)
                self.assertIn("return", hints)
                self.assertEqual(len(hints), item.__code__.co_argcount + item.__code__.co_kwonlyargcount + 1
                                 + bool(item.__code__.co_flags & 8), name)  # 8: **properties
        self.assertTrue(os.path.exists(os.path.join(os.path.dirname(directionalmultigrid.__file__), "py.typed")))
        with self.assertRaises(AttributeError):
            directionalmultigrid.no_such_name


class Accessor(unittest.TestCase):
    def setUp(self):
        """What an accessor sees of PyVista, where it is not installed: a class of meshes, and a place to register."""
        self.addCleanup(sys.modules.pop, "directionalmultigrid.pyvista_accessor", None)
        try:
            self.pyvista = importlib.import_module("pyvista")
        except ImportError:
            self.pyvista = types.ModuleType("pyvista")
            self.pyvista.PolyData = type("PolyData", (vtkPolyData,), {})

            def register(name, target):
                return lambda accessor: setattr(target, name, property(accessor)) or accessor

            self.pyvista.register_dataset_accessor = register
            sys.modules["pyvista"] = self.pyvista
            self.addCleanup(sys.modules.pop, "pyvista")

    def test_entry_point_gives_meshes_their_methods(self):
        if not hasattr(self.pyvista, "register_dataset_accessor"):
            self.skipTest("PyVista before 0.48 has no accessors")
        point, = [point for point in importlib.metadata.entry_points(group="pyvista.accessors")
                  if point.name == "directional"]
        importlib.import_module(point.value)
        mesh = self.pyvista.PolyData()
        mesh.ShallowCopy(torus(20, 10))
        result = mesh.directional.cross_field(ConstraintType="Hard")
        self.assertIs(type(result), self.pyvista.PolyData)
        self.assertEqual(result.GetFieldData().GetArray("NumberOfDirections").GetValue(0), 4)
        self.assertEqual(mesh.directional.smooth_field(n=2).GetFieldData().GetArray("NumberOfDirections").GetValue(0), 2)
        with self.assertRaises(TypeError):
            mesh.directional.cross_field(n=3)
        flow = result.directional.hodge("Direction0", Boundary="Open")
        self.assertIs(type(flow), self.pyvista.PolyData)
        self.assertTrue(flow.GetPointData().HasArray("StreamFunction"))
        carried = mesh.directional.transport(point=(1, 0, 0), direction=(0, 0, 1))
        self.assertIs(type(carried), self.pyvista.PolyData)
        self.assertTrue(carried.GetPointData().HasArray("LogarithmicMap"))

        plotter = unittest.mock.Mock()
        actor = result.directional.add_lines(plotter, color="red", SeparatingDistance=0.05)
        (lines,), style = plotter.add_mesh.call_args
        self.assertIs(type(lines), self.pyvista.PolyData)
        self.assertGreater(lines.GetNumberOfLines(), 10)
        self.assertEqual(style["color"], "red")
        self.assertIs(actor, plotter.add_mesh.return_value)
        actor.GetShaderProperty().AddVertexShaderReplacement.assert_called_once()
        with self.assertRaisesRegex(TypeError, "did you mean SeparatingDistance"):
            result.directional.add_lines(plotter, SeparatingDistances=0.05)


if __name__ == "__main__":
    unittest.main()
