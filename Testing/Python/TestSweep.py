"""The sweep over a folder of surfaces: over those of Data, over small ones beside the repository where there are, and
that it tells what must not be."""

import contextlib
import csv
import io
import tempfile
import unittest
from pathlib import Path

import sweep

ROOT = Path(__file__).parents[2]
DATA = ROOT / "Data"
SHARED = ROOT.parent / "shared" / "meshes"
MOST_FACES = 10000


def table_of(paths, kind, fields=tuple(sweep.FIELDS)):
    """The rows of the table, and those that must not be."""
    with tempfile.TemporaryDirectory() as folder, contextlib.redirect_stdout(io.StringIO()):
        out = Path(folder) / "sweep.csv"
        bad = sweep.sweep(sorted(paths), fields, kind, 120, out)
        with open(out, newline="") as file:
            return list(csv.DictReader(file)), bad


class Sweep(unittest.TestCase):
    def test_cycles_solve_every_field_on_the_surfaces_of_this_repository(self):
        rows, bad = table_of(DATA.glob("*.vtp"), "ConjugateGradients")
        self.assertEqual(bad, [])
        self.assertEqual(len(rows), len(sweep.FIELDS) * len(list(DATA.glob("*.vtp"))))
        for row in rows:
            with self.subTest(surface=row["surface"], field=row["field"]):
                self.assertEqual(row["outcome"], "solved")
                self.assertEqual(float(row["index"]), float(row["euler"]))
                self.assertLess(float(row["difference"]), 1e-6)

    @unittest.skipUnless(SHARED.is_dir(), "no surfaces beside the repository")
    def test_small_real_surfaces_are_solved_or_refused(self):
        paths = [path for path in SHARED.glob("*.ply") if sweep.is_small_enough(path, MOST_FACES)]
        self.assertEqual(table_of(paths, "Automatic")[1], [])

    @unittest.skipUnless(SHARED.is_dir(), "no surfaces beside the repository")
    def test_dirty_real_surfaces_are_solved(self):
        """None is refused, and the indices sum to the Euler characteristic of the surface on which it was solved."""
        paths = sorted(SHARED.glob("bad_*.ply"))
        rows, bad = table_of(paths, "Automatic", ("points", "power"))
        self.assertEqual((bad, len(rows)), ([], 2 * len(paths)))
        for row in rows:
            with self.subTest(surface=row["surface"], field=row["field"]):
                self.assertEqual(row["outcome"], "solved")
                self.assertEqual(float(row["index"]), float(row["euler"]))

    def test_a_run_that_hangs_or_crashes_is_a_row(self):
        surface = DATA / "disk.vtp"
        self.assertEqual(sweep.run(surface, "power", "Automatic", "none.npy", 0.01)["outcome"], "hang")
        row = sweep.run(surface, "no such field", "Automatic", "none.npy", 120)
        self.assertEqual(row["outcome"], "crash")
        self.assertIn("no such field", row["message"])


if __name__ == "__main__":
    unittest.main()
