"""What a session with the filters keeps: states and scripts give the same bits, moving data give their own fields, and a
moved guide repeats no set-up. ParaView has to find the plugin by itself.

    TestSessions.py FOLDER
"""

import pathlib
import sys
import unittest

import numpy as np
import paraview.simple as simple
from directionalmultigrid import vtkFiltersDirectionalFields  # so that Python knows the classes
from paraview import smstate, smtrace
from vtkmodules.util.numpy_support import vtk_to_numpy

FOLDER = pathlib.Path(sys.argv.pop())


def fetch(source, time=None):
    source.UpdatePipeline(*[] if time is None else [time])
    return simple.servermanager.Fetch(source)


def arrays_of(data):
    """Bytes of all arrays of points and cells."""
    return {(kind, attributes.GetArrayName(i)): vtk_to_numpy(attributes.GetArray(i)).tobytes()
            for kind, attributes in (("points", data.GetPointData()), ("cells", data.GetCellData()))
            for i in range(attributes.GetNumberOfArrays())}


def powers(data):
    return vtk_to_numpy(data.GetCellData().GetArray("PowerField")).copy()


def counts(solver):
    """Set-ups, systems and solves so far."""
    stages = solver.GetClientSideObject()
    return stages.GetNumberOfSetups(), stages.GetNumberOfSystems(), stages.GetNumberOfSolves()


def sphere(resolution=40):
    return simple.Sphere(Radius=1, ThetaResolution=resolution, PhiResolution=resolution)


def meridian(angle):
    """An arc from the south to the north of the unit sphere, at an angle around the z-axis."""
    x, y = np.cos(angle), np.sin(angle)
    return [coordinate for t in np.linspace(-1, 1, 7) for coordinate in (np.cos(t) * x, np.cos(t) * y, np.sin(t))]


def write_series(name, files):
    lines = [f'<DataSet timestep="{time}" file="{file}"/>' for time, file in enumerate(files)]
    path = FOLDER / name
    path.write_text('<VTKFile type="Collection" version="0.1"><Collection>' + "".join(lines) + "</Collection></VTKFile>")
    return str(path)


# What ParaView saved of a sphere and a Directional Field that was made of three filters.
FORMER_STATE = """<ParaView><ServerManagerState version="5.11.0">
  <Proxy group="sources" type="SphereSource" id="302" servers="1">
    <Property name="EndPhi" id="302.EndPhi" number_of_elements="1"><Element index="0" value="90"/></Property>
    <Property name="PhiResolution" id="302.PhiResolution" number_of_elements="1"><Element index="0" value="40"/></Property>
    <Property name="ThetaResolution" id="302.ThetaResolution" number_of_elements="1"><Element index="0" value="40"/></Property>
  </Proxy>
  <Proxy group="filters" type="DirectionalField" id="399" servers="1">
    <Property name="Input" id="399.Input" number_of_elements="1"><Proxy value="302" output_port="0"/></Property>
    <Property name="Number Of Directions" id="399.N" number_of_elements="1"><Element index="0" value="2"/></Property>
    <Property name="Follow Directions" id="399.FD" number_of_elements="1"><Element index="0" value="1"/></Property>
    <Property name="Directions" id="399.Directions" number_of_elements="5">
      <Element index="0" value="1"/><Element index="1" value="0"/><Element index="2" value="0"/>
      <Element index="3" value="0"/><Element index="4" value="Active Vectors"/>
    </Property>
    <Property name="Boundary Weight" id="399.BW" number_of_elements="1"><Element index="0" value="3"/></Property>
    <Property name="Boundary Rotation" id="399.BR" number_of_elements="1"><Element index="0" value="20"/></Property>
    <Property name="Line Distance" id="399.Line" number_of_elements="1"><Element index="0" value="0.05"/></Property>
    <Property name="Sphere Radius" id="399.Sphere" number_of_elements="1"><Element index="0" value="0.03"/></Property>
  </Proxy>
  <ProxyCollection name="sources">
    <Item id="302" name="Ball"/><Item id="399" name="Field"/>
  </ProxyCollection>
</ServerManagerState></ParaView>"""


class Sessions(unittest.TestCase):
    def tearDown(self):
        simple.ResetSession()

    def assert_same(self, data, expected):
        """Names what differs; a comparison as a whole would print for minutes."""
        arrays, others = arrays_of(data), arrays_of(expected)
        self.assertEqual(list(arrays), list(others))
        self.assertEqual([name for name in arrays if arrays[name] != others[name]], [])

    def a_pipeline(self):
        """With a guide, its properties, and singularities of the field."""
        line = simple.PolyLineSource(registrationName="Line", Points=meridian(0.3))
        field = simple.HarmonicFieldSolver(
            registrationName="Field", Input=sphere(), Guides=line, NumberOfDirections=3, Alignment=2, Rotation=25)
        simple.FieldLines(registrationName="Lines", Input=field)
        simple.FieldSingularities(registrationName="Singular", Input=field)
        return self.results()

    def results(self):
        return [arrays_of(fetch(simple.FindSource(name))) for name in ("Field", "Lines", "Singular")]

    def test_a_state_gives_the_same_bits(self):
        before = self.a_pipeline()
        state = str(FOLDER / "session.pvsm")
        simple.SaveState(state)
        simple.ResetSession()
        self.assertIsNone(simple.FindSource("Field"))
        simple.LoadState(state)
        self.assertEqual(self.results(), before)

    def all_inputs(self):
        """Filters with something at each of their inputs: four guides, singularities of the corner of a cube, edges of a 1-form."""
        surface = simple.Sphere(registrationName="Ball", Radius=1, ThetaResolution=40, PhiResolution=40)
        guides = {name: simple.PolyLineSource(registrationName=name, Points=meridian(angle))
                  for name, angle in zip(("Guides", "SecondGuide", "ThirdGuide", "FourthGuide"), (0.3, 1.9, 3.2, 4.7))}
        corners = simple.Calculator(registrationName="Corners", Input=simple.Box(XLength=1.1, YLength=1.1, ZLength=1.1),
                                    ResultArrayName="Index", Function="0.25")
        corners = simple.Clean(registrationName="Singular points", Input=corners)
        field = simple.DirectionalField(registrationName="Field", Input=surface, PrescribedSingularities=corners,
                                        GuideWeights="1 1 1 2", **guides)
        simple.HarmonicFieldSolver(registrationName="Lines", Input=surface, Singularities=corners, GuideWeights="2", **guides)
        flow = simple.HarmonicFieldSolver(registrationName="Flow", Input=surface, Discretisation="1-Form", Guides=guides["Guides"])
        simple.HodgeDecomposition(registrationName="Singular", Input=flow, Vectors=["CELLS", "Direction0"],
                                  Edges=simple.OutputPort(flow, 1))
        return field

    def test_a_state_keeps_what_is_at_each_input(self):
        field = self.all_inputs()
        before = self.results()
        report = fetch(field).GetFieldData()
        self.assertEqual(report.GetArray("GuidesTaken").GetValue(0), 4 * 6)
        indices = vtk_to_numpy(fetch(field).GetPointData().GetArray("SingularityIndex"))
        self.assertEqual(sorted(indices[indices != 0]), 8 * [0.25])
        state = str(FOLDER / "inputs.pvsm")
        simple.SaveState(state)
        simple.ResetSession()
        simple.LoadState(state)
        self.assertEqual(self.results(), before)
        field = simple.FindSource("Field")
        guides = [*field.Guides, field.SecondGuide, field.ThirdGuide, field.FourthGuide]
        self.assertEqual(guides, [simple.FindSource(name) for name in ("Guides", "SecondGuide", "ThirdGuide", "FourthGuide")])
        field.FourthGuide, field.GuideWeights = None, "3"
        self.assertEqual(fetch(field).GetFieldData().GetArray("GuidesTaken").GetValue(0), 3 * 6)

    def test_what_is_deleted_is_followed_no_more_after_a_state_either(self):
        self.a_pipeline()
        state = str(FOLDER / "deleted.pvsm")
        simple.SaveState(state)
        simple.ResetSession()
        simple.LoadState(state)
        field = simple.FindSource("Field")
        self.assertEqual(fetch(field).GetFieldData().GetArray("GuidesTaken").GetValue(0), 6)
        simple.Delete(simple.FindSource("Line"))
        alone = simple.HarmonicFieldSolver(Input=sphere(), NumberOfDirections=3, Alignment=2, Rotation=25)
        self.assert_same(fetch(field), fetch(alone))
        self.assertFalse(fetch(field).GetFieldData().HasArray("GuidesTaken"))

    def test_a_state_keeps_the_point_of_a_map(self):
        carried = simple.ParallelTransport(registrationName="Map", Input=sphere())
        before = arrays_of(fetch(carried))
        place = list(carried.Point)
        state = str(FOLDER / "map.pvsm")
        simple.SaveState(state)
        simple.ResetSession()
        simple.LoadState(state)
        carried = simple.FindSource("Map")
        self.assertEqual((list(carried.Point), carried.UsePoint), (place, 1))
        self.assertEqual(arrays_of(fetch(carried)), before)
        carried.Point = [1, 0, 0]
        self.assertNotEqual(arrays_of(fetch(carried)), before)

    def test_a_state_of_a_former_version_gives_the_same_field(self):
        path = FOLDER / "former.pvsm"
        path.write_text(FORMER_STATE)
        simple.LoadState(str(path))
        field = simple.FindSource("Field")
        values = {"NumberOfDirections": 2, "BoundaryWeight": 3, "BoundaryRotation": 20, "LineDistance": 0.05,
                  "SphereRadius": 0.03}
        self.assertEqual({name: field.GetProperty(name).SMProperty.GetElement(0) for name in values}, values)
        solver = simple.HarmonicFieldSolver(
            Input=simple.Sphere(EndPhi=90, PhiResolution=40, ThetaResolution=40), NumberOfDirections=2, BoundaryWeight=3,
            BoundaryRotation=20)
        self.assert_same(fetch(field), fetch(solver))
        lines = simple.FieldLines(Input=solver, SeparatingDistance=0.05)
        self.assert_same(simple.servermanager.Fetch(field, idx=1), fetch(lines))

    def test_a_state_that_knows_weights_alone_gives_the_same_field(self):
        """Boxes are on as weights are not 0, whatever their defaults are."""
        weights = "".join(f'<Property name="{name}" id="399.{name[0]}X" number_of_elements="1"><Element index="0" value="{value}"/></Property>'
                          for name, value in (("Sharp Edges Weight", 0), ("Curvature Weight", 0.3)))
        path = FOLDER / "weights.pvsm"
        path.write_text(FORMER_STATE.replace('number_of_elements="1"><Element index="0" value="3"/></Property>',
                                             'number_of_elements="1"><Element index="0" value="0"/></Property>' + weights))
        simple.LoadState(str(path))
        field = simple.FindSource("Field")
        self.assertEqual((field.BoundaryWeight, field.SharpEdgesWeight, field.CurvatureWeight), (0, 0, 0.3))
        self.assertEqual((field.FollowBoundary, field.FollowSharpEdges, field.FollowCurvature), (0, 0, 1))
        solver = simple.HarmonicFieldSolver(
            Input=simple.Sphere(EndPhi=90, PhiResolution=40, ThetaResolution=40), NumberOfDirections=2, CurvatureWeight=0.3)
        self.assert_same(fetch(field), fetch(solver))
        simple.SaveState(str(path))  # today's
        simple.ResetSession()
        simple.LoadState(str(path))
        self.assertEqual(simple.FindSource("Field").FollowCurvature, 1)

    def test_a_python_state_gives_the_same_bits(self):
        before = self.a_pipeline()
        script = smstate.get_state()
        self.assertIn("HarmonicFieldSolver", script)
        simple.ResetSession()
        exec(compile(script, "state.py", "exec"), {"__name__": "state"})
        self.assertEqual(self.results(), before)

    def test_a_trace_gives_the_same_bits(self):
        smtrace.start_trace()
        before = self.a_pipeline()
        script = smtrace.stop_trace()
        self.assertRegex(script, "Alignment ?= ?2")  # without spaces since ParaView 6
        simple.ResetSession()
        exec(compile(script, "trace.py", "exec"), {"__name__": "trace"})
        self.assertEqual(self.results(), before)

    def test_guides_of_a_time_series_move_the_field(self):
        angles = (0.1, 0.6, 1.05)  # not along edges
        for time, angle in enumerate(angles):
            simple.SaveData(str(FOLDER / f"guide{time}.vtp"), simple.PolyLineSource(Points=meridian(angle)),
                            DataMode="Binary")
        series = write_series("guides.pvd", [f"guide{time}.vtp" for time in range(3)])
        guides = simple.PVDReader(FileName=series)
        solver = simple.HarmonicFieldSolver(Input=sphere(), Guides=guides, NumberOfDirections=2, Tolerance=1e-10)
        self.assertEqual(list(guides.TimestepValues), [0, 1, 2])
        for time in (0, 1, 2, 1):
            alone = simple.HarmonicFieldSolver(
                Input=sphere(), Guides=simple.PolyLineSource(Points=meridian(angles[time])), NumberOfDirections=2,
                Tolerance=1e-10)
            difference = np.abs(powers(fetch(solver, time)) - powers(fetch(alone))).max()
            self.assertLess(difference, 1e-6)
        setups, systems, solves = counts(solver)
        self.assertEqual(setups, 1)
        self.assertLessEqual(max(systems, solves), 4)

    def test_a_hundred_steps_of_a_guide_cost_a_solve_each(self):
        line = simple.PolyLineSource(Points=meridian(0.0))
        solver = simple.HarmonicFieldSolver(Input=sphere(), Guides=line, NumberOfDirections=4)
        fetch(solver)
        for step in range(1, 101):
            line.Points = meridian(0.013 * step)
            solver.UpdatePipeline()
            self.assertEqual(counts(solver)[0::2], (1, step + 1))
        alone = simple.HarmonicFieldSolver(
            Input=sphere(), Guides=simple.PolyLineSource(Points=meridian(1.3)), NumberOfDirections=4)
        angles = [np.angle(field[:, 0] + 1j * field[:, 1]) for field in (powers(fetch(solver)), powers(fetch(alone)))]
        turned = np.abs(np.angle(np.exp(1j * (angles[0] - angles[1])))) / 4
        self.assertLess(np.degrees(np.median(turned)), 0.1)

    def test_an_animation_moves_what_it_animates(self):
        line = simple.PolyLineSource(Points=meridian(0.0))
        moved = simple.Transform(Input=line)
        solver = simple.HarmonicFieldSolver(Input=sphere(), Guides=moved, NumberOfDirections=2)
        scene = simple.GetAnimationScene()
        scene.PlayMode, scene.StartTime, scene.EndTime, scene.NumberOfFrames = "Sequence", 0, 1, 5
        track = simple.GetAnimationTrack("Rotation", index=2, proxy=moved.Transform)
        track.KeyFrames = [simple.CompositeKeyFrame(KeyTime=key, KeyValues=[90 * key]) for key in (0, 1)]
        fields = []
        scene.GoToFirst()
        for _ in range(5):
            fields.append(powers(fetch(solver)))
            scene.GoToNext()
        self.assertTrue(all(np.abs(one - other).max() > 0.1 for one, other in zip(fields, fields[1:])))
        self.assertEqual(counts(solver)[0], 1)

    def test_a_moving_surface_has_a_field_of_its_own_at_each_time(self):
        sizes = (1.0, 1.5, 2.0)
        for time, size in enumerate(sizes):
            simple.SaveData(str(FOLDER / f"surface{time}.vtp"), self.stretched(size), DataMode="Binary")
        series = simple.PVDReader(FileName=write_series("surfaces.pvd", [f"surface{t}.vtp" for t in range(3)]))
        solver = simple.HarmonicFieldSolver(
            Input=series, Guides=simple.PolyLineSource(Points=meridian(0.2)), NumberOfDirections=2, MaximumDistance=1)
        for time, size in enumerate(sizes):
            field = fetch(solver, time)
            self.assertAlmostEqual(field.GetBounds()[5], size, places=5)
            alone = simple.HarmonicFieldSolver(
                Input=simple.XMLPolyDataReader(FileName=[str(FOLDER / f"surface{time}.vtp")]),
                Guides=simple.PolyLineSource(Points=meridian(0.2)), NumberOfDirections=2, MaximumDistance=1)
            self.assertEqual(arrays_of(field), arrays_of(fetch(alone)))
            self.assertEqual(counts(solver), (time + 1,) * 3)

    @staticmethod
    def stretched(size):
        transform = simple.Transform(Input=sphere())
        transform.Transform.Scale = [1, 1, size]
        return transform


if __name__ == "__main__":
    unittest.main()
