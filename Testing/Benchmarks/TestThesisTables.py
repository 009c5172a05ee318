"""A short run of BenchmarkThesis: all tables are whole, and say what they must.

    TestThesisTables.py BenchmarkThesis folder
"""
import csv
import subprocess
import sys
from pathlib import Path

program, folder = sys.argv[1], Path(sys.argv[2])
folder.mkdir(parents=True, exist_ok=True)
subprocess.run([program, "--out", str(folder), "--runs", "1", "--short"], check=True)
here = Path(__file__).resolve().parent
subprocess.run([sys.executable, str(here / "plot_thesis.py"), str(folder)], check=True)

SURFACES, DISCRETISATIONS = 2, 3


def read(name, rows):
    """The rows, of which none lacks a number of ours."""
    with open(folder / (name + ".csv"), newline="") as file:
        table = list(csv.DictReader(file))
    assert len(table) == rows, (name, len(table))
    for row in table:
        for column, cell in row.items():
            assert cell or column.startswith("thesis") or column in ("cycles", "total"), (name, row)
    return table


solves = read("solves", SURFACES * DISCRETISATIONS)
for row in solves:
    cp, ni, fmg = (float(row[name]) for name in ("cp_error", "ni_error", "fmg_error"))
    assert ni < cp < 1.0, row   # sweeps improve on coarse prolongation, which improves on zero
    assert fmg < 0.05, row      # cycles converge, whatever the level below missed
read("setup", SURFACES)
read("starts", SURFACES * DISCRETISATIONS * 2)
sweeps = read("sweeps", SURFACES * DISCRETISATIONS * 2)
for once, twice in zip(sweeps[::2], sweeps[1::2]):
    # twice the sweeps, no more cycles; an empty cell needed more than the limit
    assert float(twice["cycles"] or "inf") <= float(once["cycles"] or "inf"), (once, twice)
with open(folder / "curves.csv", newline="") as file:
    curves = list(csv.DictReader(file))
for first, last in ((rows[0], rows[-1]) for rows in (
        [row for row in curves
         if (row["surface"], row["discretisation"]) == (solve["surface"], solve["discretisation"])]
        for solve in solves)):
    assert 0.5 < float(first["error"]) <= 1 and float(last["error"]) < 1e-2, (first, last)
for picture in ("errors", "times", "sweeps", "curves_by_cycle", "curves_by_time", "setup"):
    assert (folder / (picture + ".png")).stat().st_size > 5000, picture
print("all tables and plots are whole")
