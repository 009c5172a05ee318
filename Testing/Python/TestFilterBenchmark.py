"""A short run of Testing/Benchmarks/time_filter.py: its table and its plot are whole."""

import csv
import subprocess
import sys
import tempfile
import unittest
from pathlib import Path

from vtkmodules.vtkIOPLY import vtkPLYWriter

from surfaces import torus

BENCHMARKS = Path(__file__).resolve().parent.parent / "Benchmarks"


class FilterBenchmark(unittest.TestCase):
    def test_times_every_field_by_both_solvers(self):
        with tempfile.TemporaryDirectory() as name:
            folder = Path(name)
            writer = vtkPLYWriter()
            writer.SetInputData(torus(60, 40))
            writer.SetFileName(str(folder / "torus.ply"))
            writer.Write()
            subprocess.run([sys.executable, str(BENCHMARKS / "time_filter.py"), "--out", name,
                            "--runs", "1", str(folder / "torus.ply")], check=True)
            with open(folder / "filter.csv", newline="") as file:
                rows = list(csv.DictReader(file))
            self.assertEqual(len({row["field"] for row in rows}), 6)
            self.assertEqual(len({(row["field"], row["solver"]) for row in rows}), 12)
            for row in rows:
                stages = [float(row[stage]) for stage in ("setup", "prepare", "solve", "other")]
                self.assertGreater(min(stages), 0.0, row)
                self.assertGreater(float(row["ratio"]), 0.0)
                self.assertAlmostEqual(sum(stages), float(row["total"]), delta=3e-4)
            with open(folder / "changes.csv", newline="") as file:
                changes = {row["change"]: float(row["seconds"]) for row in csv.DictReader(file)}
            self.assertEqual(set(changes), {"all", "a new N", "an old N", "combing", "unit length", "a guide added",
                                            "a guide moved", "vtkFieldLines", "vtkFieldGlyphs", "vtkFieldSingularities",
                                            "vtkDirectionalField"})
            self.assertGreater(min(changes.values()), 0)
            subprocess.run([sys.executable, str(BENCHMARKS / "plot_fields.py"), name], check=True)
            self.assertGreater((folder / "filter.png").stat().st_size, 5000)


if __name__ == "__main__":
    unittest.main()
