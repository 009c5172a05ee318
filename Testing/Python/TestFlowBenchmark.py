"""A short run of Testing/Benchmarks/time_flow.py: its table is whole."""

import csv
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from vtkmodules.vtkIOPLY import vtkPLYWriter

from surfaces import torus

BENCHMARKS = Path(__file__).resolve().parent.parent / "Benchmarks"


class FlowBenchmark(unittest.TestCase):
    def test_times_all_solvers(self):
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            writer = vtkPLYWriter()
            writer.SetInputData(torus(60, 40))
            writer.SetFileName(str(folder / "torus.ply"))
            writer.Write()
            subprocess.run([sys.executable, str(BENCHMARKS / "time_flow.py"), "--out", name, "--runs", "1", str(folder / "torus.ply")],
                           check=True)
            with open(folder / "flow.csv", newline="") as file:
                rows = {row["solver"]: row for row in csv.DictReader(file)}
            try:
                import scipy
                others = {"SciPy"} if scipy else set()
            except ImportError:
                others = set()
            self.assertEqual(set(rows), {"ConjugateGradients", "Automatic", "Cholesky"} | others)
            for solver in ("ConjugateGradients", "Automatic", "Cholesky"):
                self.assertGreater(min(float(rows[solver][column]) for column in ("first", "step", "bytes")), 0)
            self.assertEqual(rows["ConjugateGradients"]["first_ratio"], "1.00")


if __name__ == "__main__":
    unittest.main()
