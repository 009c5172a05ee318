"""Inputs as people have them: vectors that no one has asked to follow, that stand on end or are missing, tensors, axes without
a sign, and processes that fork. Each gives a field, or a sentence that says what to do."""

import os
import signal
import subprocess
import sys
import unittest
import warnings

import numpy as np
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkFiltersSources import vtkSphereSource

from directionalmultigrid import FieldError, smooth_field, update
from directionalmultigrid.vtkFiltersDirectionalFields import vtkHarmonicFieldSolver
from surfaces import add, corners, values, values_of_points


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
            self.assertTrue(update(solver).GetFieldData().HasArray("Eigenvalues"))

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
