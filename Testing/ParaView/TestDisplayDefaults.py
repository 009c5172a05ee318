"""Where the first Apply fails, what shows a filter has the defaults of its data after the input is mended, as if
there had been no failure; what somebody has chosen stays."""

import unittest

import numpy as np
import paraview.simple as simple
from vtkmodules.util.numpy_support import vtk_to_numpy

DEFAULTS = ["ScaleFactor", "GaussianRadius", "SelectOrientationVectors", "SelectInputVectors", "SelectScaleArray",
            "SelectNormalArray", "OpacityArray", "SetScaleArray", "OSPRayScaleArray", "ColorArrayName", "Representation"]
LENGTH = 10  # of the surface


def defaults(display):
    return {name: getattr(display, name) for name in DEFAULTS}


class DisplayDefaults(unittest.TestCase):
    def setUp(self):
        self.view = simple.CreateRenderView()
        self.bad = simple.Calculator(Input=simple.Sphere(), CoordinateResults=1, Function="coords/0")  # an error of every filter that is tested
        self.surface = simple.Sphere(Radius=LENGTH / 2)

    def tearDown(self):
        simple.Delete(self.view)

    def mend(self, source):
        source.Input = self.surface
        source.UpdatePipeline()
        simple.Render(self.view)

    def check(self, kind, ports=(0,), of_a_field=False):
        """Shows a filter that fails, or one of a solver that fails, mends it and returns what shows it."""
        first = simple.HarmonicFieldSolver(Input=self.bad) if of_a_field else kind(Input=self.bad)
        last = kind(Input=first) if of_a_field else first
        shown = [simple.Show(simple.OutputPort(last, port), self.view) for port in ports]
        simple.Render(self.view)
        of_nothing = [defaults(display) for display in shown]
        self.mend(first)
        fresh = kind(Input=simple.HarmonicFieldSolver(Input=self.surface) if of_a_field else self.surface)
        for port, display, before in zip(ports, shown, of_nothing):
            expected = defaults(simple.Show(simple.OutputPort(fresh, port), self.view))
            self.assertNotEqual(before, expected)  # or there was nothing to mend
            self.assertEqual(defaults(display), expected, f"{kind.__name__}, port {port}")
            self.assertGreater(display.ScaleFactor, 0)
            self.assertGreater(display.GaussianRadius, 0)
        return shown

    def test_the_solver(self):
        display = self.check(simple.HarmonicFieldSolver, (0, 1))[0]
        self.assertAlmostEqual(display.ScaleFactor, LENGTH / 10, delta=0.1 * LENGTH / 10)
        self.assertEqual(display.SelectOrientationVectors, "Direction0")

    def test_a_compound_filter(self):
        self.check(simple.DirectionalField, (0, 1, 2))

    def test_the_other_filters(self):
        for kind in (simple.DirectionalProlongation, simple.PrincipalDirections):
            self.check(kind)
        for kind in (simple.FieldLines, simple.FieldGlyphs, simple.FieldAngles):
            self.check(kind, of_a_field=True)
        self.check(simple.FieldSingularities, (0, 3), of_a_field=True)

    def test_rendering_is_enough(self):
        pictures = []
        for first in (self.bad, self.surface):
            solver = simple.HarmonicFieldSolver(Input=first)
            display = simple.Show(solver, self.view)
            solver.Input = self.surface
            simple.ResetCamera(self.view)
            simple.Render(self.view)
            pictures.append(vtk_to_numpy(self.view.CaptureWindow(1).GetPointData().GetScalars()))
            simple.Hide(solver, self.view)
            self.assertGreater(display.ScaleFactor, 0)
        self.assertGreater(len(np.unique(pictures[1], axis=0)), 50)  # shades: something is drawn
        self.assertTrue((pictures[0] == pictures[1]).all())

    def test_choices_stay(self):
        solver = simple.HarmonicFieldSolver(Input=self.bad)
        display = simple.Show(solver, self.view)
        display.Representation = "Wireframe"
        display.GaussianRadius = 3
        display.SelectInputVectors = ["CELLS", "PowerField"]
        self.mend(solver)
        self.assertEqual(display.Representation, "Wireframe")
        self.assertEqual(display.GaussianRadius, 3)
        self.assertEqual(list(display.SelectInputVectors), ["CELLS", "PowerField"])
        self.assertGreater(display.ScaleFactor, 0)
        display.ScaleFactor = 7
        display.SelectOrientationVectors = "None"
        solver.NumberOfDirections = 2
        self.mend(solver)
        self.assertEqual((display.ScaleFactor, display.SelectOrientationVectors), (7, "None"))
        solver.Input = self.bad  # fails again, but there have been data
        solver.UpdatePipeline()
        self.mend(solver)
        self.assertEqual((display.ScaleFactor, display.SelectOrientationVectors), (7, "None"))


if __name__ == "__main__":
    unittest.main()
