"""Field Lines, Field Glyphs and Field Singularities as a user of ParaView reaches them.

Crosses on the unit sphere are drawn with nothing prescribed, and with every property; ParaView has to find
the plugin by itself. Where there is a display, what is shown after Apply is looked at as well.

    TestDrawing.py [IMAGE]
"""

import sys
import unittest

import numpy as np
import paraview.simple as simple
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkPNGReader

IMAGE = sys.argv.pop() if len(sys.argv) > 1 and sys.argv[-1].endswith(".png") else None


def crosses():
    sphere = simple.Sphere(Radius=1, ThetaResolution=60, PhiResolution=60)
    given = simple.Calculator(Input=sphere, ResultArrayName="Given",
                              Function="if(coordsX > 0.9, jHat, 0*jHat)")
    return simple.HarmonicFieldSolver(Input=given, Directions=["POINTS", "Given"], AllDirections=1)


def fetch(source, port=0):
    source.UpdatePipeline()
    return simple.servermanager.Fetch(source, idx=port)


def array(attributes, name):
    return vtk_to_numpy(attributes.GetArray(name))


class Drawing(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.field = crosses()

    def test_lines_with_nothing_said(self):
        lines = fetch(simple.FieldLines(Input=self.field))
        self.assertGreater(lines.GetNumberOfLines(), 50)
        self.assertEqual(set(array(lines.GetCellData(), "Branch")), {0, 1})
        # Two families at about 0.015 of the diagonal on an area of 4 pi.
        total = array(lines.GetCellData(), "Length").sum()
        distance = 0.015 * 2 * 3 ** 0.5
        self.assertGreater(total * distance, 0.8 * 2 * 4 * np.pi)
        self.assertLess(total * distance, 1.3 * 2 * 4 * np.pi)

    def test_filters_that_are_made_before_their_input_has_run(self):
        for make in (simple.FieldLines, simple.FieldGlyphs, simple.FieldSingularities, simple.FieldAngles):
            drawn = make(Input=simple.HarmonicFieldSolver(Input=simple.Sphere()))
            self.assertGreater(fetch(drawn).GetNumberOfPoints(), 0, make)

    def test_lines_with_every_property(self):
        lines = simple.FieldLines(Input=self.field)
        default = fetch(lines)
        lines.SeparatingDistance = 0.06
        self.assertLess(fetch(lines).GetNumberOfPoints(), default.GetNumberOfPoints() / 2)
        lines.SeparatingDistanceRatio = 0.9
        lines.MinimumLength = 8
        shortest = array(fetch(lines).GetCellData(), "Length").min()
        self.assertGreaterEqual(shortest, 8 * 0.06 * 2 * 3 ** 0.5 * 0.99)
        lines.Lift = 0.05
        points = vtk_to_numpy(fetch(lines).GetPoints().GetData())
        self.assertGreater(np.linalg.norm(points, axis=1).min(), 1.1)
        lines.NumberOfDirections = 1
        self.assertEqual(set(array(fetch(lines).GetCellData(), "Branch")), {0})
        # Those of the points, which the solver averages, are the cells'.
        lines.Directions = ["POINTS", "Direction0"]
        at_points = array(fetch(lines).GetCellData(), "Length")
        lines.Directions = ["CELLS", "Direction0"]
        self.assertEqual(list(at_points), list(array(fetch(lines).GetCellData(), "Length")))
        lines.Directions = ["CELLS", "Direction1"]
        self.assertNotEqual(list(at_points), list(array(fetch(lines).GetCellData(), "Length")))

    def test_glyphs_with_every_property(self):
        glyphs = simple.FieldGlyphs(Input=self.field)
        default = fetch(glyphs)
        self.assertGreater(default.GetNumberOfPolys(), 1000)
        self.assertEqual(set(array(default.GetCellData(), "Branch")), {0, 1})
        self.assertEqual(set(array(default.GetCellData(), "Direction")), {0, 1, 2, 3})
        glyphs.Style = "Strokes"
        strokes = fetch(glyphs)
        self.assertEqual(strokes.GetNumberOfPolys(), 0)
        places = array(strokes.GetCellData(), "Glyph").max() + 1
        self.assertEqual(strokes.GetNumberOfLines(), 4 * places)
        glyphs.SeparatingDistance = 0.06
        self.assertLess(fetch(glyphs).GetNumberOfLines(), strokes.GetNumberOfLines() / 2)
        for sizing in ("Even", "By Triangle", "By Magnitude"):
            glyphs.Sizing = sizing
            self.assertGreater(fetch(glyphs).GetNumberOfLines(), 0)
        glyphs.Placement = "Every Triangle"
        self.assertEqual(fetch(glyphs).GetNumberOfLines(),
                         4 * fetch(self.field).GetNumberOfCells())
        glyphs.NumberOfDirections = 2
        self.assertEqual(fetch(glyphs).GetNumberOfLines(),
                         2 * fetch(self.field).GetNumberOfCells())
        glyphs.Style, glyphs.Width, glyphs.ScaleFactor, glyphs.Lift = "Solid", 0.2, 2, 0.05
        points = vtk_to_numpy(fetch(glyphs).GetPoints().GetData())
        self.assertGreater(np.linalg.norm(points, axis=1).min(), 1.1)
        glyphs.Directions = ["CELLS", "Direction1"]
        self.assertGreater(fetch(glyphs).GetNumberOfPolys(), 0)

    def test_singularities_and_their_other_outputs(self):
        singularities = simple.FieldSingularities(Input=self.field)
        points = fetch(singularities)
        indices = array(points.GetPointData(), "Index")
        self.assertAlmostEqual(indices.sum(), 2)
        self.assertEqual(set(array(points.GetPointData(), "NumberOfDirections")), {4})
        self.assertEqual(points.GetFieldData().GetArray("EulerCharacteristic").GetValue(0), 2)
        self.assertAlmostEqual(points.GetFieldData().GetArray("SumOfIndices").GetValue(0), 2)
        self.assertGreater(fetch(singularities, 1).GetNumberOfLines(), 0)
        self.assertEqual(fetch(singularities, 2).GetNumberOfLines(), 0)
        spheres = fetch(singularities, 3)
        self.assertEqual(set(array(spheres.GetPointData(), "Index")), set(indices))
        colours = array(spheres.GetPointData(), "SignColor")
        self.assertTrue((colours[:, 0] > 2 * colours[:, 1:].max(axis=1)).all())  # red, as all indices are positive
        used = np.unique(vtk_to_numpy(spheres.GetPolys().GetConnectivityArray()))
        self.assertEqual(len(used), spheres.GetNumberOfPoints())
        singularities.SphereRadius = 0.1
        centres, around = (vtk_to_numpy(fetch(singularities, port).GetPoints().GetData()) for port in (0, 3))
        distances = np.linalg.norm(around[:, None] - centres, axis=2).min(axis=1)
        self.assertAlmostEqual(distances.max(), 0.1 * 2 * 3 ** 0.5, places=2)
        singularities.NumberOfDirections = 2
        self.assertAlmostEqual(array(fetch(singularities).GetPointData(), "Index").sum(), 2)
        singularities.Directions = ["CELLS", "Direction1"]
        self.assertGreater(fetch(singularities).GetNumberOfPoints(), 0)

    def test_principal_directions_are_lines(self):
        tube = simple.Triangulate(Input=simple.Cylinder(Resolution=40, Capping=0))
        bends = simple.PrincipalDirections(Input=tube)
        glyphs = simple.FieldGlyphs(Input=bends, Directions=["CELLS", "MaximumDirection"])
        self.assertEqual(set(array(fetch(glyphs).GetCellData(), "Direction")), {0, 1})

    @unittest.skipUnless(IMAGE, "needs a display and the name of an image")
    def test_apply_shows_them(self):
        view = simple.CreateRenderView(ViewSize=[500, 500])
        simple.Show(self.field, view).Representation = "Surface"
        singular = vtk_to_numpy(fetch(simple.FieldSingularities(Input=self.field)).GetPoints().GetData())
        view.CameraPosition = 3 * singular[0].astype(float)
        plain = self.colours(view)
        for proxy in (simple.FieldLines, simple.FieldGlyphs, simple.FieldSingularities):
            with self.subTest(proxy=proxy.__name__):
                source = proxy(Input=self.field)
                display = simple.Show(source, view)
                display.GaussianRadius = 0.03
                self.assertGreater((self.colours(view) != plain).any(axis=1).mean(), 0.001)
                simple.Hide(source, view)
        self.assertEqual(display.Representation, "Point Gaussian")
        self.assertEqual(display.ColorArrayName[1], "Index")
        simple.Delete(view)

    @unittest.skipUnless(IMAGE, "needs a display and the name of an image")
    def test_lines_and_glyphs_are_dark_until_an_array_is_chosen(self):
        """Without one there is no scalar bar."""
        view = simple.CreateRenderView(ViewSize=[500, 500])
        for proxy, port in ((simple.FieldLines, 0), (simple.FieldGlyphs, 0), (simple.DirectionalField, 1)):
            with self.subTest(proxy=proxy.__name__):
                source = proxy(Input=self.field)
                display = simple.Show(simple.OutputPort(source, port), view)
                self.assertEqual((display.Representation, display.ColorArrayName[1]), ("Ink", ""))
                display.InkColor = [0, 0.5, 0]
                self.assertGreater(self.part_of(view, 1), 0.01)
                simple.ColorBy(display, ("CELLS", "Branch"))
                for component in (0, 2):
                    self.assertGreater(self.part_of(view, component), 0.002)
                self.assertLess(self.part_of(view, 1), 0.002)
                simple.Hide(simple.OutputPort(source, port), view)
        simple.Delete(view)

    @unittest.skipUnless(IMAGE, "needs a display and the name of an image")
    def test_lines_do_not_break_into_dashes(self):
        """As much is seen of them as off the surface, also near the silhouette, and nothing from behind."""
        view = simple.CreateRenderView(ViewSize=[500, 500], OrientationAxesVisibility=0)
        simple.Show(self.field, view).Representation = "Surface"
        lines = simple.FieldLines(Input=self.field)
        simple.Show(lines, view)
        blue = 2
        seen = self.part_of(view, blue)
        lines.Lift = 0.001
        self.assertAlmostEqual(seen / self.part_of(view, blue), 1, delta=0.05)
        simple.Delete(view)

    @unittest.skipUnless(IMAGE, "needs a display and the name of an image")
    def test_ink_shows_from_both_sides(self):
        """A plane looks alike from above and below, near and far, in perspective and without, in the window and in saved pictures. The
        lines that are seen have one colour on both sides."""
        plane = simple.Plane(XResolution=30, YResolution=30)
        field = simple.HarmonicFieldSolver(Input=plane)
        flow = simple.HodgeDecomposition(Input=simple.Calculator(Input=plane, ResultArrayName="Flow", Function="jHat*coordsX-iHat*coordsY"),
                                         Vectors=["POINTS", "Flow"], NumberOfContours=30)
        view = simple.CreateRenderView(ViewSize=[500, 500], OrientationAxesVisibility=0, CameraParallelScale=0.5)
        simple.Show(field, view, Representation="Surface", ColorArrayName=["POINTS", ""])
        for ink, port in ((simple.FieldLines(Input=field), 0), (simple.FieldGlyphs(Input=field, Style="Solid"), 0), (flow, 1)):
            for distance, parallel in ((3, 0), (0.3, 0), (3, 1)):
                with self.subTest(ink=ink.SMProxy.GetXMLName(), distance=distance, parallel=parallel):
                    seen, darkest = [], []
                    for side in (distance, -distance):
                        view.CameraPosition, view.CameraFocalPoint, view.CameraViewUp = [0, 0.02, side], [0, 0, 0], [0, 1, 0]
                        view.CameraParallelProjection = parallel
                        simple.Hide(simple.OutputPort(ink, port), view)
                        plain = self.colours(view)
                        simple.Show(simple.OutputPort(ink, port), view)
                        inked = self.colours(view)
                        seen.append((inked != plain).any(axis=1).mean())
                        darkest.append(inked[inked.sum(axis=1).argmin()].astype(int))
                    self.assertGreater(min(seen), 0.005)
                    self.assertLess(np.abs(darkest[0] - darkest[1]).max(), 10)
                    self.assertAlmostEqual(seen[0] / seen[1], 1, delta=0.25)
            simple.Hide(simple.OutputPort(ink, port), view)
        simple.Delete(view)

    @unittest.skipUnless(IMAGE, "needs a display and the name of an image")
    def test_ink_behind_a_surface_is_hidden(self):
        """A sphere's lines on the far side, and lines of a plane a fiftieth behind another."""
        view = simple.CreateRenderView(ViewSize=[500, 500], OrientationAxesVisibility=0, CameraPosition=[0, 0, 3], CameraFocalPoint=[0, 0, 0])
        simple.Show(simple.Plane(), view)
        behind = simple.Transform(Input=simple.Plane(XResolution=30, YResolution=30))
        behind.Transform.Translate, behind.Transform.Scale = [0, 0, -0.02], [0.8, 0.8, 1]
        simple.Show(simple.FieldLines(Input=simple.HarmonicFieldSolver(Input=behind)), view)
        self.assertEqual(self.part_of(view, 2), 0)
        simple.Delete(view)

    @unittest.skipUnless(IMAGE, "needs a display and the name of an image")
    def test_ink_of_a_thin_wall_shows_from_its_own_side_alone(self):
        """Lines are blue on the upper side and red on the lower one."""
        view = simple.CreateRenderView(ViewSize=[300, 300], OrientationAxesVisibility=0, CameraPosition=[0.3, 0.2, 3], CameraFocalPoint=[0, 0, 0])
        wall = simple.Subdivide(Input=simple.Triangulate(Input=simple.Box(ZLength=1e-4)), NumberofSubdivisions=3)
        field = simple.HarmonicFieldSolver(Input=wall, SharpEdgesWeight=1)
        simple.Show(field, view, Representation="Surface", ColorArrayName=["POINTS", ""])
        for ink in (simple.FieldLines(Input=field, SeparatingDistance=0.05), simple.FieldGlyphs(Input=field)):
            display = simple.Show(ink, view)
            simple.ColorBy(display, ("POINTS", "Normals", "Z"))
            simple.GetColorTransferFunction("Normals").RGBPoints = [-0.5, 1, 0, 0, 0.5, 0, 0, 1]
            self.assertGreater(self.part_of(view, 2), 0.01)
            self.assertLess(self.part_of(view, 0), 0.0005)
            simple.Hide(ink, view)
        simple.Delete(view)

    def test_ink_of_two_open_sheets_shows_from_its_own_side_alone(self):
        """However both are oriented, the upper one's from above and the lower one's from below."""
        for up in ((0, 0), (0, 1), (1, 0), (1, 1)):
            ends = (([-0.5, 0.5], [0.5, -0.5]), ([0.5, -0.5], [-0.5, 0.5]))
            sheets = [simple.Plane(Origin=[-0.5, -0.5, z], Point1=[*ends[k][0], z], Point2=[*ends[k][1], z], XResolution=12, YResolution=12)
                      for z, k in zip((0, -1e-4), up)]
            field = simple.HarmonicFieldSolver(Input=simple.AppendDatasets(Input=sheets))
            lines = fetch(simple.FieldLines(Input=field, SeparatingDistance=0.05))
            heights = vtk_to_numpy(lines.GetPoints().GetData())[:, 2]
            normals = vtk_to_numpy(lines.GetPointData().GetArray("Normals"))[:, 2]
            self.assertEqual(set(np.round(normals[heights > -5e-5], 6)), {0.5})
            self.assertEqual(set(np.round(normals[heights < -5e-5], 6)), {-0.5})

    @unittest.skipUnless(IMAGE, "needs a display and the name of an image")
    def test_the_mouse_reaches_the_surface_below_lines(self):
        """As where points of a stroke are placed by keys. ParaView puts those on lines up to 0.1 off."""
        view = simple.CreateRenderView(ViewSize=[500, 500], CameraPosition=[0, 0, 5], CameraFocalPoint=[0, 0, 0])
        sphere = simple.Sphere(Radius=1, ThetaResolution=60, PhiResolution=60)
        field = simple.DirectionalField(Input=sphere)
        simple.Show(field, view)
        display = simple.Show(simple.OutputPort(field, 1), view)
        places = {}
        for pickable in (1, 0):
            display.InkPickable = pickable
            simple.Render(view)
            places[pickable] = np.array([self.place_at(view, x, y) for x in range(180, 320, 14) for y in range(180, 320, 14)])
        self.assertLess(np.abs(np.linalg.norm(places[0], axis=1) - 1).max(), 0.01)
        self.assertGreater(np.abs(places[1] - places[0]).max(), 1e-6)  # on lines
        self.assertEqual(simple.Show(simple.FieldLines(Input=self.field), view).InkPickable, 0)
        simple.Delete(view)

    @staticmethod
    def place_at(view, x, y):
        place, normal = [0.0] * 3, [0.0] * 3
        try:
            view.SMProxy.ConvertDisplayToPointOnSurface([x, y], place, normal, False)
        except TypeError:  # as versions differ
            view.SMProxy.ConvertDisplayToPointOnSurface([x, y], place, False)
        return place

    @unittest.skipUnless(IMAGE, "needs a display and the name of an image")
    def test_spheres_are_red_and_green(self):
        view = simple.CreateRenderView(ViewSize=[500, 500])
        line = simple.Line(Point1=[0, 0, -1], Point2=[0, 0, 1], Resolution=1)
        poles = simple.Calculator(Input=line, ResultArrayName="Index", Function="1 + 2 * coordsZ")  # -1 and 3
        sphere = simple.Sphere(Radius=1, ThetaResolution=60, PhiResolution=60)
        field = simple.DirectionalField(Input=sphere, PrescribedSingularities=poles, SphereRadius=0.1)
        view.CameraPosition = [7, 0, 0]
        display = simple.Show(simple.OutputPort(field, 2), view)
        self.assertEqual((display.Representation, display.ColorArrayName[1]), ("Sign Colors", ""))
        for component, least, most in ((0, 0.005, 1), (1, 0.005, 1), (2, 0, 1e-4)):
            self.assertGreaterEqual(self.part_of(view, component), least, component)
            self.assertLess(self.part_of(view, component), most, component)
        simple.Delete(view)

    @unittest.skipUnless(IMAGE, "needs a display and the name of an image")
    def test_boundaries_show_their_numbers(self):
        """Yellow letters beside them, on black as on white, which Ink has not; transports first, and more letters for long numbers than for 0 and 1."""
        ring = simple.Sphere(ThetaResolution=40, PhiResolution=40, StartPhi=40, EndPhi=140)
        flow = simple.Calculator(Input=ring, ResultArrayName="Flow", Function="-coordsY * iHat + coordsX * jHat")
        parts = simple.HodgeDecomposition(Input=flow, Vectors=["POINTS", "Flow"])
        view = simple.CreateRenderView(ViewSize=[500, 500], CameraPosition=[0, -3, 1], CameraViewUp=[0, 0, 1], OrientationAxesVisibility=0,
                                       UseColorPaletteForBackground=0, Background=[1, 1, 1])
        display = simple.Show(simple.OutputPort(parts, 2), view)
        self.assertEqual(display.NumbersArray, "BoundaryTransport")
        letters = {}
        for ground in (1, 0):
            view.Background = 3 * [ground]
            for kind, numbers in (("Ink", "Boundary"), ("Numbers", "Boundary"), ("Numbers", "BoundaryLength")):
                display.Representation, display.NumbersArray = kind, numbers
                colours = self.colours(view)
                letters[kind, numbers] = ((colours[:, 0] > 200) & (colours[:, 1] > 160) & (colours[:, 2] < 130)).sum()
            self.assertEqual(letters["Ink", "Boundary"], 0)
            self.assertGreater(letters["Numbers", "Boundary"], 10)
            self.assertGreater(letters["Numbers", "BoundaryLength"], 1.5 * letters["Numbers", "Boundary"])
        simple.Delete(view)

    def part_of(self, view, component):
        """Of the picture, that in which one of red, green and blue is strong and the others are weak."""
        colours = self.colours(view).astype(int)
        others = np.delete(colours, component, axis=1).max(axis=1)
        return (colours[:, component] > 1.5 * others + 5).mean()

    @unittest.skipUnless(IMAGE, "needs a display and the name of an image")
    def test_surface_lic_shows_the_points_directions(self):
        """Stripes along the field: brightness varies more than shading does, and across more than along the directions."""
        plane = simple.Triangulate(Input=simple.Plane(XResolution=40, YResolution=40))
        field = simple.HarmonicFieldSolver(Input=plane, BoundaryWeight=1)
        view = simple.CreateRenderView(ViewSize=[500, 500], OrientationAxesVisibility=0)
        display = simple.Show(field, view)
        if "Surface LIC" not in display.GetProperty("Representation").Available:
            self.skipTest("ParaView has no Surface LIC here")
        display.Representation = "Surface LIC"
        stripes = self.brightness(view)
        display.Representation = "Surface"
        flat = self.brightness(view)
        x, y = 0, 1
        self.assertLess(flat.std(), 1)
        self.assertGreater(stripes.std(), 10)
        direction = vtk_to_numpy(fetch(field).GetPointData().GetArray("Direction0"))
        along, across = (x, y) if np.abs(direction[:, x]).min() > 0.99 else (y, x)
        changes = [np.abs(np.diff(stripes, axis=1 - axis)).mean() for axis in (along, across)]
        self.assertGreater(changes[1], 2 * changes[0])
        simple.Delete(view)

    @unittest.skipUnless(IMAGE, "needs a display and the name of an image")
    def test_the_solver_shows_lines(self):
        """What has the colour of ink is there as long as the surface shows so, along all directions, on blocks, too, and where it is moved."""
        surface = simple.Triangulate(Input=simple.Plane(XResolution=40, YResolution=40))
        field = simple.HarmonicFieldSolver(Input=surface, BoundaryWeight=1)
        view = simple.CreateRenderView(ViewSize=[500, 500], OrientationAxesVisibility=0)
        display = simple.Show(field, view)
        simple.ResetCamera(view)
        self.assertEqual(display.Representation, "Field Lines")
        of_crosses = self.ink(view)
        self.assertGreater(of_crosses, 5000)
        for change, back in (("Surface", "Field Lines"), (0, 1)):
            for value, shows in ((change, False), (back, True)):
                setattr(display, "Representation" if isinstance(value, str) else "Visibility", value)
                self.assertEqual(self.ink(view), of_crosses if shows else 0, value)
        display.LineDistance = 0.03
        self.assertLess(abs(self.ink(view) / of_crosses - 0.5), 0.1)
        display.LineDistance = 0.015
        field.NumberOfDirections = 2
        self.assertLess(abs(self.ink(view) / of_crosses - 0.5), 0.1)
        display.Position = [9, 0, 0]
        self.assertEqual(self.ink(view), 0)
        simple.ResetCamera(view)
        self.assertLess(abs(self.ink(view) / of_crosses - 0.5), 0.1)
        display.Position = [0, 0, 0]
        field.Input = simple.GroupDatasets(Input=[surface, simple.Transform(Input=surface, Transform="Transform")])
        simple.ResetCamera(view)
        self.assertLess(abs(self.ink(view) / of_crosses - 0.5), 0.1)
        simple.Delete(view)

    @unittest.skipUnless(IMAGE, "needs a display and the name of an image")
    def test_lines_are_as_wide_in_a_large_picture(self):
        """They cover as much of it with four times as many pixels across, and again in the view."""
        field = simple.DirectionalField(Input=simple.Plane(XResolution=20, YResolution=20), LineDistance=0.05,
                                        Guides=simple.Line(Point1=[-0.3, -0.2, 0], Point2=[0.3, 0.1, 0]))
        view = simple.CreateRenderView(ViewSize=[400, 400], OrientationAxesVisibility=0)
        simple.Show(field, view).Representation = "Surface"
        simple.ResetCamera(view)

        def blue(resolution):
            """In the mean of the picture: lines take some away, however few pixels they are wide."""
            return self.colours(view, ImageResolution=[resolution, resolution])[:, 2].astype(float).mean()

        bare = {resolution: blue(resolution) for resolution in (400, 1600)}
        for port, kind in ((1, "Ink"), (3, "Guide Ink")):
            shown = simple.Show(simple.OutputPort(field, port), view)
            self.assertEqual(shown.Representation, kind)
            taken, of_large, again = (bare[resolution] - blue(resolution) for resolution in (400, 1600, 400))
            self.assertGreater(taken, 0.2)
            self.assertLess(abs(of_large / taken - 1), 0.15, kind)
            self.assertEqual(again, taken)
            simple.Hide(simple.OutputPort(field, port), view)
        simple.Delete(view)

    def ink(self, view):
        return (np.abs(self.colours(view).astype(int) - (26, 51, 153)).max(axis=1) < 40).sum()

    def brightness(self, view):
        """In the middle of the picture, rows from below."""
        return self.colours(view).astype(float).mean(axis=1).reshape(500, 500)[200:300, 200:300]

    @unittest.skipUnless(IMAGE, "needs a display")
    def test_colours_come_from_points_and_cells_alone(self):
        view = simple.CreateRenderView()
        operators = simple.DirectionalProlongation(Input=simple.Sphere(ThetaResolution=20, PhiResolution=20))
        for source in (self.field, simple.FieldSingularities(Input=self.field), operators):
            source.UpdatePipeline()
            self.assertGreater(len(source.FieldData), 1)
            menu = simple.Show(source, view).SMProxy.GetProperty("ColorArrayName").GetDomain("array_list")
            kinds = {menu.GetFieldAssociation(i) for i in range(menu.GetNumberOfStrings())}
            self.assertLessEqual(kinds, {0, 1})
            self.assertIn(0, kinds)
        simple.Delete(view)

    @staticmethod
    def colours(view, **options):
        simple.Render(view)
        simple.SaveScreenshot(IMAGE, view, **options)
        reader = vtkPNGReader()
        reader.SetFileName(IMAGE)
        reader.Update()
        return vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars())[:, :3]


if __name__ == "__main__":
    unittest.main()
