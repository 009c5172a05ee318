"""Short runs of BenchmarkFields: all tables are whole, and the solvers agree.

    TestFieldsTables.py BenchmarkFields folder
"""
import csv
import math
import subprocess
import sys
from pathlib import Path

program, folder = sys.argv[1], Path(sys.argv[2])
folder.mkdir(parents=True, exist_ok=True)
here = Path(__file__).resolve().parent
DISCRETISATIONS, REGIMES = ["DEC", "face-based", "power", "points", "scalar"], ["20", "0.5 %"]
EVERYWHERE = ["ours", "CHOLMOD; AMD", "CHOLMOD; METIS", "IC(0)-CG; RCM", "Eigen SimplicialLDLT"]
OF_POWERS = "geometry-central's factor"
LIBRARIES = ["hypre BoomerAMG", "hypre AMS", "PETSc GAMG"]


def run(*options):
    subprocess.run([program, "--out", str(folder), "--short", *options], check=True)


def read(name):
    with open(folder / (name + ".csv"), newline="") as file:
        return list(csv.DictReader(file))


def plot():
    subprocess.run([sys.executable, str(here / "plot_fields.py"), str(folder)], check=True)


run("--runs", "1")  # fails by itself if solutions differ
fields = read("fields")
seen = {(row["discretisation"], row["prescribed"], row["solver"]) for row in fields}
assert seen >= {(d, r, s) for d in DISCRETISATIONS for r in REGIMES for s in EVERYWHERE}, seen
assert seen >= {(d, r, OF_POWERS) for d in ("power", "points") for r in REGIMES}, seen
for row in fields:
    if row["solver"] in LIBRARIES and not row["total"]:
        assert row["note"] == "not built", row
        continue
    # Conjugate gradients stop by a norm of their preconditioner's, not by the residual's.
    limit = 1e-7 if "CG" in row["solver"] or row["solver"] in LIBRARIES else 1.1e-8
    assert float(row["residual"]) <= limit and float(row["difference"]) <= 1e-6, row
    stages = [float(row[stage]) for stage in ("setup", "assembly", "prepare", "solve")]
    assert abs(sum(stages) - float(row["bare"])) < 1e-3 + 1e-4 * sum(stages), row
    assert float(row["process_mb"]) > 0 and row["runs"] == "1", row
    # Only what factors knows no iterations, and only ours has levels to set up.
    factors = any(word in row["solver"] for word in ("CHOLMOD", "Eigen", "factor"))
    assert (row["iterations"] == "0") == factors, row
    assert (stages[0] > 0) == (row["solver"] == "ours"), row

resolves = read("resolves")
assert len(resolves) == len(DISCRETISATIONS) * len(REGIMES) * 7, len(resolves)
for row in resolves:
    assert float(row["residual"]) <= (1e-3 if "1e-3" in row["solver"] else 1.1e-8), row
    assert float(row["error"]) < 0.1, row

run("--iterations-only")
plot()
iterations = read("iterations")
assert len(iterations) == (1 + 1 + 4 + 4 + 1) * 5, len(iterations)
run("--robustness")
plot()
weights = {float(row["alignment"]) for row in read("iterations")}
assert math.inf in weights, weights  # hard constraints
weights.remove(math.inf)
assert max(weights) / min(weights) > 0.99e16, weights
pictures = [quantity + regime for quantity in ("total", "bare", "iterations", "peak_mb", "resolves")
            for regime in ("_20", "_0.5_percent")]
for picture in pictures + ["iterations_by_prescribed", "iterations_by_alignment"]:
    assert (folder / (picture + ".png")).stat().st_size > 5000, picture
print("all tables and plots are whole")
