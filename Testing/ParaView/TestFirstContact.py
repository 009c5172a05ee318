"""What a person sees and is told at first contact, without having chosen anything."""

import os
import unittest

import numpy as np
import paraview.simple as simple
from paraview import smtrace
from paraview.modules.vtkRemotingCore import vtkPVPluginTracker
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkOutputWindow, vtkStringOutputWindow


def sphere():
    return simple.Sphere(ThetaResolution=40, PhiResolution=40)


def show(source, port=0):
    source.UpdatePipeline()
    display = simple.Show(simple.OutputPort(source, port), simple.GetActiveViewOrCreate("RenderView"))
    simple.Render()
    return display


class FirstContact(unittest.TestCase):
    def tearDown(self):
        for view in simple.GetRenderViews():
            simple.Delete(view)

    def test_directions_show_on_apply(self):
        for kind, shown in ((simple.HarmonicFieldSolver, "Field Lines"), (simple.PrincipalDirections, "Surface LIC")):
            display = show(kind(Input=simple.Transform(Input=sphere(), Transform="Transform")))
            self.assertEqual(display.Representation, shown)
            self.assertIn(display.SelectInputVectors[1], ("Direction0", "MaximumDirection"))

    def test_kinds_of_fields_have_filters(self):
        self.assertEqual(simple.VectorField(Input=sphere()).Discretisation, "Face Field")
        for kind, number in ((simple.CrossField, 4), (simple.LineField, 2), (simple.FibreOrientation, 2), (simple.FiberOrientation, 2),
                             (simple.FibreOrientation, 2), (simple.VectorField, 1), (simple.FrameOrRosyFieldOfCrosses, 4),
                             (simple.SmoothHatchingLines, 2), (simple.NematicFieldAndDefects, 2)):
            field = kind(Input=sphere())
            field.UpdatePipeline()
            report = simple.servermanager.Fetch(field, idx=0).GetFieldData()
            self.assertEqual(report.GetArray("NumberOfDirections").GetValue(0), number)
            self.assertEqual(show(field, 1).Representation, "Ink")
        # Ctrl+Space finds filters all of whose words are in their label.
        labels = {proxy.GetXMLLabel().lower() for proxy in (getattr(simple, name)(Input=sphere()).SMProxy for name in (
            "CrossField", "LineField", "VectorField", "FibreOrientation", "FiberOrientation", "DirectionalField", "FieldLines", "QuadRemeshing",
            "SurfaceStreamlines", "GeodesicDistance", "SurfaceDistance", "ShortestPathOnSurface", "OffsetLines", "TextureAroundPoint",
            "HelmholtzDecomposition", "DivergenceAndVorticity", "TensorAndStressDirections", "FrameOrRosyFieldOfCrosses", "SmoothHatchingLines",
            "NematicFieldAndDefects", "OceanCurrentsAndWind", "CurvatureDirections", "ScaleFilter"))}
        words = ("cross field", "line field", "fibre", "fiber", "vector field", "orientation", "quad", "remesh", "stream", "geodesic", "distance",
                 "surface distance", "shortest path", "offset", "texture", "helmholtz", "divergence", "vorticity", "tensor", "stress", "frame",
                 "hatch", "crosses", "ocean", "wind", "rosy", "curvature", "smooth", "nematic", "defect", "scale")
        for word in words:
            self.assertTrue(any(all(part in label for part in word.split()) for label in labels), word)

    def test_boxes_switch_weights(self):
        """Boundary and sharp edges are followed where there are any, without a warning where there are none."""
        field = simple.DirectionalField(Input=simple.Cylinder(Capping=0, Resolution=30))
        self.assertEqual((field.FollowBoundary, field.FollowSharpEdges, field.FollowCurvature), (1, 1, 0))
        field.BoundaryWeight = 5
        field.FollowBoundary = 0
        self.assertEqual(field.BoundaryWeight, 0)
        field.FollowBoundary = 1
        self.assertEqual(field.BoundaryWeight, 5)  # the last one
        field.FollowCurvature = 1
        self.assertEqual(field.CurvatureWeight, 1)
        field.CurvatureWeight = 0
        self.assertEqual(field.FollowCurvature, 0)
        for kind in (simple.DirectionalField, simple.HarmonicFieldSolver):
            spread = kind(Input=sphere(), SpreadSingularities=1)
            self.assertEqual(spread.UnitLengthWhileSmoothing, 1)
            spread.UnitLengthWhileSmoothing = 0
            self.assertEqual(spread.SpreadSingularities, 0)
        for surface, follows in ((sphere(), "nothing"), (simple.Box(), "sharp edges"), (simple.Disk(), "boundary"),
                                 (simple.Cylinder(Resolution=30), "sharp edges")):
            field = simple.DirectionalField(Input=surface)
            field.UpdatePipeline()
            field.UpdatePropertyInformation()
            self.assertEqual(field.GetProperty("Followed").GetData(), follows)
        # A script says box or weight, and one panel's values agree before they are applied.
        self.assertEqual(simple.DirectionalField(Input=sphere(), FollowCurvature=1).CurvatureWeight, 1)
        self.assertEqual(simple.DirectionalField(Input=sphere(), FollowBoundary=0).BoundaryWeight, 0)
        self.assertEqual(simple.DirectionalField(Input=sphere(), CurvatureWeight=2).FollowCurvature, 1)
        field.SMProxy.GetProperty("Follow Boundary").SetUncheckedElement(0, 0)
        self.assertEqual(field.SMProxy.GetProperty("Boundary Weight").GetUncheckedElement(0), 0)
        self.assertEqual(field.BoundaryWeight, 1)
        # What was measured or chosen is followed alone.
        for kind in (simple.FibreOrientation, simple.FiberOrientation, simple.TensorAndStressDirections, simple.VectorField):
            measured = kind(Input=simple.Disk())
            self.assertEqual((measured.BoundaryWeight, measured.SharpEdgesWeight, measured.FollowBoundary, measured.FollowSharpEdges), (0, 0, 0, 0))

    def test_flows_have_heads(self):
        surface = sphere()
        ends = [simple.Line(Point1=[0, -0.1, z], Point2=[0, 0.1, z]) for z in (0.5, -0.5)]
        for kind in ("Face Field", "1-Form", "Power Field at Points", "Power Field on Faces"):
            for number in (1, 2) if "Power" in kind else (1,):
                flow = simple.DirectionalField(Input=surface, Discretisation=kind, NumberOfDirections=number, Guides=ends[0],
                                               SecondGuide=ends[1])
                flow.UpdatePipeline()
                drawn = simple.servermanager.Fetch(flow, idx=1)
                lengths = [drawn.GetCell(line).GetNumberOfPoints() for line in range(drawn.GetNumberOfCells())]
                heads = lengths.count(3)  # a head is a line of three points
                self.assertTrue(heads > 20 if number == 1 else heads == 0, (kind, number, heads))

    def test_apply_reaches_guides_before_their_filter(self):
        """Apply comes to proxies in an order of its own. Until then, their properties have what the panel shows as unchecked values."""
        stroke = simple.Line(Point1=[0, 0, 0], Point2=[1, 0, 0])  # across the surface, as a new one
        field = simple.VectorField(Input=sphere(), Guides=stroke)
        for name, values in (("Point1", (0.5, -0.1, 0)), ("Point2", (0.5, 0.1, 0))):
            for element, value in enumerate(values):
                stroke.SMProxy.GetProperty(name).SetUncheckedElement(element, value)
        simple.RenameSource("Stroke", stroke)
        smtrace.start_trace()
        field.LineDistance = 0.05
        trace = smtrace.stop_trace()
        self.assertEqual((list(stroke.Point1), list(stroke.Point2)), ([0.5, -0.1, 0], [0.5, 0.1, 0]))
        self.assertIn("Point1=[0.5,-0.1,0", trace.replace(" ", ""))  # of the stroke
        field.UpdatePipeline()
        report = simple.servermanager.Fetch(field, idx=0).GetFieldData()
        self.assertEqual(report.GetArray("GuidesTooFar").GetValue(0), 0)

    def test_normals_are_never_the_first_choice(self):
        fibres = simple.Calculator(Input=sphere(), ResultArrayName="Zz", Function="kHat")
        fibres.UpdatePipeline()
        self.assertIsNotNone(fibres.PointData.GetArray("Normals"))
        for kind in (simple.FieldLines, simple.FieldGlyphs, simple.FieldAngles, simple.FieldSingularities):
            self.assertEqual(list(kind(Input=fibres).Directions), ["POINTS", "Zz"], kind.__name__)

    def test_texture_coordinates_are_never_the_first_choice(self):
        """Although vectors of two components may be chosen, as those of models in the plane are."""
        script = "import numpy\noutput.PointData.append(numpy.tile((1.0, 0.0), (len(inputs[0].Points), 1)), 'Wind')"
        flow = simple.ProgrammableFilter(Input=simple.Plane(XResolution=10, YResolution=10), CopyArrays=1, Script=script)
        flow.UpdatePipeline()
        for kind in (simple.FieldLines, simple.FieldGlyphs, simple.FieldAngles, simple.FieldSingularities):
            drawn = kind(Input=flow)
            offered = drawn.SMProxy.GetProperty("Directions").GetDomain("array_list")
            self.assertEqual({offered.GetString(k) for k in range(offered.GetNumberOfStrings())},
                             {"Normals", "TextureCoordinates", "Wind"}, kind.__name__)
            self.assertEqual(list(drawn.Directions), ["POINTS", "Wind"], kind.__name__)
            drawn.UpdatePipeline()
            points = simple.servermanager.Fetch(drawn).GetNumberOfPoints()
            self.assertEqual(points > 0, kind is not simple.FieldSingularities)  # parallel vectors have none

    def test_fibres_follow_the_only_vectors(self):
        """Beside normals. Of two arrays none is chosen, and what a script names stays."""
        fibres = simple.Calculator(Input=sphere(), ResultArrayName="Fibres", Function="kHat")
        both = simple.Calculator(Input=fibres, ResultArrayName="Sheets", Function="jHat")
        both.UpdatePipeline()
        for kind in (simple.FibreOrientation, simple.FiberOrientation):
            self.assertEqual(list(kind(Input=fibres).Directions), ["POINTS", "Fibres"])
            self.assertEqual(kind(Input=fibres, Directions=["POINTS", "Normals"]).Directions[1], "Normals")
            self.assertEqual(kind(Input=both).Directions[1], "None")
            self.assertEqual(kind(Input=sphere()).Directions[1], "None")
        self.assertEqual(simple.LineField(Input=fibres).Directions[1], "None")

    def test_quads_of_parts_have_flat_faces(self):
        """A box has one shade on each of the three sides that are seen: no normals are averaged over its edges."""
        view = simple.CreateRenderView(ViewSize=[300, 300], OrientationAxesVisibility=0, CameraPosition=[3, 4, 5])
        part = simple.Subdivide(Input=simple.Triangulate(Input=simple.Box()), NumberofSubdivisions=3)
        display = show(simple.QuadMesh(Input=part, NumberOfQuads=300))
        self.assertEqual(display.Representation, "Surface With Edges")
        display.Representation, display.ColorArrayName = "Surface", ["POINTS", ""]
        simple.Render(view)
        shades, pixels = np.unique(vtk_to_numpy(view.CaptureWindow(1).GetPointData().GetScalars()), axis=0, return_counts=True)
        self.assertEqual((pixels > 100).sum(), 4, pixels)  # and the background

    def test_messages_say_what_is_followed(self):
        window, former = vtkStringOutputWindow(), vtkOutputWindow.GetInstance()
        vtkOutputWindow.SetInstance(window)
        try:
            dome = simple.Sphere(EndPhi=90, ThetaResolution=40, PhiResolution=20)
            field = simple.HarmonicFieldSolver(Input=simple.Calculator(
                Input=dome, AttributeType="Cell Data", ResultArrayName="Wind", Function="jHat"))
            field.UpdatePipeline()
            field.NumberOfDirections = 2  # follows no more than before
            field.UpdatePipeline()
            field.Directions = ["CELLS", "Wind"]
            field.BoundaryWeight, field.SharpEdgesWeight = 1, 1  # of which there are none
            field.UpdatePipeline()
            said = [line.split("follows ")[1] for line in window.GetOutput().splitlines() if "the field follows" in line]
        finally:
            vtkOutputWindow.SetInstance(former)
        self.assertEqual(said, ["nothing", "array 'Wind', boundary"])
        field.UpdatePropertyInformation()
        self.assertEqual(field.GetProperty("Followed").GetData(), "array 'Wind', boundary")

    def test_bar_of_a_flow_has_a_unit(self):
        flow = simple.Calculator(Input=sphere(), Function="coordsX * jHat - coordsY * iHat")
        display = show(simple.HodgeDecomposition(Input=flow, Vectors=["POINTS", "Result"]))
        simple.ColorBy(display, ("POINTS", "StreamFunction"))
        display.SetScalarBarVisibility(simple.GetActiveView(), True)
        bar = simple.GetScalarBar(display.LookupTable, simple.GetActiveView())
        self.assertEqual((bar.Title, bar.LabelFormat), ("Stream function (speed \u00d7 length)", "%.3g"))

    def test_angles_have_cyclic_colours(self):
        field = simple.HarmonicFieldSolver(Input=sphere(), NumberOfDirections=2)
        angles = simple.FieldAngles(Input=field)
        display = show(angles)
        points = np.reshape(simple.GetColorTransferFunction("Angle").RGBPoints, (-1, 4))
        self.assertEqual((points[0, 0], points[-1, 0]), (-90, 90))
        bar = simple.GetScalarBar(display.LookupTable, simple.GetActiveView())
        display.SetScalarBarVisibility(simple.GetActiveView(), True)
        self.assertEqual((bar.Title, bar.ComponentTitle, bar.RangeLabelFormat), ("Angle (degrees)", "", "%.0f"))
        self.assertLess(np.abs(points[0, 1:] - points[-1, 1:]).max(), 0.1)
        self.assertGreater(np.ptp(points[:, 1:], axis=0).min(), 0.3)
        # Crosses have half of that. What somebody has chosen stays.
        field.NumberOfDirections = 4
        angles.UpdatePipeline()
        points = np.reshape(simple.GetColorTransferFunction("Angle").RGBPoints, (-1, 4))
        self.assertEqual((points[0, 0], points[-1, 0]), (-45, 45))
        simple.ColorBy(display, ("CELLS", "Angle"))
        display.LookupTable.ApplyPreset("Cool to Warm", True)
        chosen = np.reshape(display.LookupTable.RGBPoints, (-1, 4))[:, 1:]
        show(simple.FieldAngles(Input=field))
        colours = np.reshape(simple.GetColorTransferFunction("Angle").RGBPoints, (-1, 4))[:, 1:]
        self.assertTrue(np.array_equal(colours, chosen))

    def test_the_chart_has_whole_iterations(self):
        field = simple.HarmonicFieldSolver(Input=sphere(), Solver="Conjugate Gradients", Tolerance=1e-10)
        chart = simple.ConvergenceChart(Input=simple.OutputPort(field, 2))
        view, own = simple.CreateView("XYChartView"), simple.CreateView("XYChartView")
        own.BottomAxisTitle = "cycles"
        for shown in (view, own):
            simple.Show(chart, shown)
            simple.Render(shown)
        self.assertEqual((view.BottomAxisTitle, view.LeftAxisTitle), ("iteration", "log10 of the relative residual"))
        self.assertEqual((own.BottomAxisTitle, own.BottomAxisUseCustomLabels), ("cycles", 0))
        last = chart.GetDataInformation().GetNumberOfRows() - 1
        labels = [int(text) for text in view.BottomAxisLabels[1::2]]
        self.assertEqual(list(view.BottomAxisLabels[0::2]), list(view.BottomAxisLabels[1::2]))
        self.assertGreater(last, 10)
        step = labels[1]
        self.assertEqual(labels, list(range(0, last + 1, step)))
        self.assertLessEqual(len(labels), 11)
        simple.Delete(own)
        simple.Delete(view)

    def test_other_data_do_not_offer_our_representations(self):
        offered = show(sphere()).GetProperty("Representation").Available
        self.assertNotIn("Ink", offered)
        self.assertNotIn("Sign Colors", offered)
        self.assertNotIn("Field Lines", offered)
        self.assertIn("Surface LIC", offered)
        field = simple.DirectionalField(Input=sphere())
        for port, kind in ((1, "Ink"), (2, "Sign Colors")):
            self.assertEqual(show(field, port).Representation, kind)

    def test_the_plugin_has_one_entry(self):
        tracker = vtkPVPluginTracker.GetInstance()
        names = [tracker.GetPluginName(k) for k in range(tracker.GetNumberOfPlugins())]
        self.assertEqual([name for name in names if "directionalmultigrid" in name.lower()], ["DirectionalMultigrid"])
        self.assertTrue(os.environ.get("PV_PLUGIN_PATH"))


if __name__ == "__main__":
    unittest.main()
