"""Operators written by one process are used by another, unless the surface has changed since."""

import pathlib
import subprocess
import sys
import tempfile
import unittest

import numpy as np
from vtkmodules.vtkCommonCore import vtkFileOutputWindow, vtkOutputWindow
from vtkmodules.vtkCommonDataModel import vtkDataObject
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader, vtkXMLPolyDataWriter

from directionalmultigrid.vtkFiltersDirectionalFields import (
    vtkDirectionalProlongation, vtkHarmonicFieldSolver)
from surfaces import prescribe, torus, values

CELLS = vtkDataObject.FIELD_ASSOCIATION_CELLS


def make():
    """A surface with all its operators."""
    prolongation = vtkDirectionalProlongation()
    prolongation.SetInputData(prescribe(torus(60, 40), {7: (1, 2, 3), 4000: (0, 1, 0)}))
    prolongation.SetMinimumNumberOfFaces(100)
    prolongation.FaceFieldsOn()
    prolongation.OneFormsOn()
    prolongation.Update()
    return prolongation.GetOutput()


def write(path):
    """The first process: a surface with its operators, and the fields that it solves with them."""
    surface = make()
    writer = vtkXMLPolyDataWriter()
    writer.SetFileName(str(path))
    writer.SetInputData(surface)
    writer.SetDataModeToBinary()  # see Testing/Examples/README.md, "Files"
    assert writer.Write() == 1
    np.savez(path.with_suffix(".npz"),
             **{kind: unknowns(solve(surface, kind)) for kind in ("FaceField", "OneForm")})


def read(path):
    reader = vtkXMLPolyDataReader()
    reader.SetFileName(str(path))
    reader.Update()
    return reader.GetOutput()


def solve(surface, kind="PointPowerField"):
    solver = vtkHarmonicFieldSolver()
    solver.SetInputData(surface)
    solver.SetInputArrayToProcess(1, 0, 0, CELLS, "Given")
    solver.SetSolver(vtkHarmonicFieldSolver.ConjugateGradients)
    solver.SetTolerance(1e-10)
    solver.SetDiscretisation(getattr(vtkHarmonicFieldSolver, kind))
    solver.SetCoarseSpace(vtkHarmonicFieldSolver.StructurePreserving)
    solver.Update()
    return solver


def unknowns(solver):
    """The numbers of a face field or 1-form."""
    if solver.GetDiscretisation() == vtkHarmonicFieldSolver.OneForm:
        return values(solver.GetOutputDataObject(1).GetCellData(), "OneForm")
    return values(solver.GetOutput().GetCellData(), "FaceField")


class StoredOperators(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.path = pathlib.Path(self.folder.name) / "surface.vtp"
        self.log = pathlib.Path(self.folder.name) / "messages.txt"
        window = vtkFileOutputWindow()
        window.SetFileName(str(self.log))
        window.FlushOn()
        vtkOutputWindow.SetInstance(window)
        subprocess.run([sys.executable, __file__, "--write", self.path], check=True)

    def tearDown(self):
        vtkOutputWindow.SetInstance(None)
        self.folder.cleanup()

    def messages(self):
        return self.log.read_text() if self.log.exists() else ""

    def test_are_used(self):
        surface = read(self.path)
        sizes = values(surface.GetFieldData(), "Prolongation.NumbersOfFaces")
        self.assertEqual(sizes[0], 4800)
        for kind in ("PointPowerField", "PowerField"):
            solver = solve(surface, kind)
            if kind == "PointPowerField":  # else a note says that the triangles are sheared
                self.assertEqual(self.messages(), "")
            # As many levels as are stored; its own would end at 1000 faces.
            unknowns = values(solver.GetOutput().GetFieldData(), "LevelUnknowns")
            self.assertEqual(len(unknowns), len(sizes))
            self.assertGreater(len(unknowns), 2)

            # The same field as without any operators.
            exact = vtkHarmonicFieldSolver()
            exact.SetInputData(surface)
            exact.SetDiscretisation(solver.GetDiscretisation())
            exact.SetInputArrayToProcess(1, 0, 0, CELLS, "Given")
            exact.SetSolver(vtkHarmonicFieldSolver.Cholesky)
            exact.Update()
            fields = [values(s.GetOutput().GetCellData(), "PowerField") for s in (solver, exact)]
            self.assertLess(np.abs(fields[0] - fields[1]).max(), 1e-7 * np.abs(fields[1]).max())

    def test_give_the_same_bits_as_in_the_process_that_wrote_them(self):
        surface = read(self.path)
        expected = np.load(self.path.with_suffix(".npz"))
        for kind in ("FaceField", "OneForm"):
            with self.subTest(kind=kind):
                solver = solve(surface, kind)
                levels = values(solver.GetOutput().GetFieldData(), "LevelUnknowns")
                self.assertGreater(len(levels), 2)
                np.testing.assert_array_equal(unknowns(solver), expected[kind])
        self.assertEqual(self.messages(), "")

    def test_of_a_changed_surface_are_refused(self):
        surface = read(self.path)
        point = np.array(surface.GetPoint(17))
        surface.GetPoints().SetPoint(17, *(1.01 * point))
        solver = solve(surface)
        self.assertIn("apply Directional Prolongation (vtkDirectionalProlongation)", self.messages())
        self.assertEqual(solver.GetOutput().GetNumberOfCells(), 0)


if __name__ == "__main__":
    if sys.argv[1:2] == ["--write"]:
        write(pathlib.Path(sys.argv[2]))
    else:
        unittest.main()
