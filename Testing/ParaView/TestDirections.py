"""Which vectors of a surface the solver follows where its user has said nothing, and where they have.

In Python most inputs have not run when a filter is made, so ParaView does not know their arrays yet.
"""

import unittest

import numpy as np
import paraview.simple as simple
from vtkmodules.util.numpy_support import vtk_to_numpy


def fetch(source):
    source.UpdatePipeline()
    return simple.servermanager.Fetch(source)


def powers(source):
    return vtk_to_numpy(fetch(source).GetPointData().GetArray("PowerField"))


def is_smoothest(source):
    return fetch(source).GetFieldData().HasArray("Eigenvalues")


def prescribed(source):
    return (vtk_to_numpy(fetch(source).GetPointData().GetArray("Prescribed")) > 0).sum()


def surface():
    return simple.Sphere(ThetaResolution=20, PhiResolution=20)


def upper():
    return (vtk_to_numpy(fetch(surface()).GetPoints().GetData())[:, 2] > 0).sum()


def with_vectors(input_of_them, name="Wind"):
    return simple.Calculator(Input=input_of_them, AttributeType="Cell Data", ResultArrayName=name, Function="jHat")


class Directions(unittest.TestCase):
    def test_nothing_is_followed_that_is_not_named(self):
        for make in (simple.HarmonicFieldSolver, simple.DirectionalField):
            with self.subTest(filter=make.__name__):
                field = make(Input=with_vectors(surface()))
                self.assertTrue(is_smoothest(field))
                for chosen in (["CELLS", "Wind"], ["POINTS", "Active Vectors"]):  # as in states of former versions
                    field.Directions = chosen
                    self.assertEqual(prescribed(field), fetch(field).GetNumberOfPoints())
                field.FollowDirections = 0
                self.assertTrue(is_smoothest(field))
                field.FollowDirections = 1
                field.Directions = ["CELLS", "None"]
                self.assertTrue(is_smoothest(field))

    def test_a_second_solver_does_not_follow_the_first(self):
        for make in (simple.HarmonicFieldSolver, simple.DirectionalField):
            for runs_before in (False, True):
                with self.subTest(filter=make.__name__, runs_before=runs_before):
                    bare = surface()
                    first = simple.HarmonicFieldSolver(Input=bare, NumberOfDirections=4)
                    if runs_before:
                        first.UpdatePipeline()
                    second = make(Input=first, NumberOfDirections=2)
                    expected = powers(simple.HarmonicFieldSolver(Input=bare, NumberOfDirections=2))
                    self.assertTrue(np.array_equal(powers(second), expected))
                    second.Directions = ["CELLS", "Direction0"]  # as is said
                    self.assertEqual(prescribed(second), len(expected))

    def test_a_second_solver_follows_what_its_user_names(self):
        first = simple.HarmonicFieldSolver(Input=with_vectors(surface()))
        self.assertTrue(is_smoothest(first))
        second = simple.HarmonicFieldSolver(Input=first)
        self.assertTrue(is_smoothest(second))
        second.Directions = ["CELLS", "Wind"]
        self.assertFalse(is_smoothest(second))  # nor does it have the report of the first

    def test_directions_that_cannot_be_followed_are_left_out(self):
        """A calculator's kHat stands on end at two points of a sphere, and a mask or a vector may be missing in places."""
        missing = "output.PointData.append(numpy.where(inputs[0].Points[:, 2:] > 0, numpy.nan, 1.0), 'Missing')"
        upwards = simple.Calculator(Input=surface(), ResultArrayName="Up", Function="kHat")
        both = simple.ProgrammableFilter(Input=upwards, CopyArrays=1, Script="import numpy\n" + missing)
        product = simple.PythonCalculator(Input=both, Expression="Up * Missing", ArrayName="Holes")
        for make in (simple.HarmonicFieldSolver, simple.DirectionalField):
            for chosen, left in (({"Directions": ["POINTS", "Up"]}, 2),
                                 ({"Directions": ["POINTS", "Up"], "Mask": ["POINTS", "Missing"]}, 1 + upper()),
                                 ({"Directions": ["POINTS", "Holes"]}, 1 + upper())):
                with self.subTest(filter=make.__name__, chosen=chosen):
                    field = make(Input=product, NumberOfDirections=1, **chosen)
                    points = fetch(field).GetNumberOfPoints()
                    self.assertEqual(prescribed(field), points - left)
            for chosen in ("0 * kHat", "kHat * 0 * coordsX"):
                nothing = simple.Calculator(Input=surface(), ResultArrayName="None", Function=chosen)
                self.assertEqual(fetch(make(Input=nothing, Directions=["POINTS", "None"])).GetNumberOfPoints(), 0)

    def test_none_are_followed_where_the_user_does_not_want_it(self):
        field = simple.HarmonicFieldSolver(
            Input=with_vectors(surface()), Directions=["CELLS", "Wind"], FollowDirections=0)
        expected = powers(simple.HarmonicFieldSolver(Input=surface()))
        self.assertTrue(np.array_equal(powers(field), expected))
        field.Mask = ["CELLS", "Nowhere"]  # it is not looked at
        self.assertTrue(np.array_equal(powers(field), expected))


if __name__ == "__main__":
    unittest.main()
