"""Solves for fields on every surface of a folder and writes down what came of it.

    sweep.py [--out table.csv] [--limit seconds] [--most faces] [--fields names] [--solver name] folder

The filters are used as they come, with twenty prescribed elements, once by themselves and once with Cholesky. Each run
is a process of its own, so that one that crashes or hangs is a line of the table and the others go on. The columns:

    surface, faces, field   what was solved
    outcome                 solved; stopped (not converged, with a warning); refused (an error and no output); or what
                            must not be: crash, hang, not finite, wrong index, not converged (though it says so)
    iterations, residual    of the last row of the convergence table
    seconds, megabytes      of the solver's Update(), and the most that its process held
    index, euler            sum of the indices of points and boundary loops, and what it must be
    cholesky ...            outcome, seconds and megabytes of the same with Cholesky
    difference              between both fields, relative to the largest value
    solver                  what ran
    message                 the first error or warning

The program fails where the outcome of one of both must not be.
"""
import argparse
import csv
import json
import resource
import signal
import subprocess
import sys
import tempfile
import time
from pathlib import Path

import numpy as np

PRESCRIBED = 20
FIELDS = {"points": (4, 4), "power": (0, 4), "face": (1, 1), "form": (2, 1), "function": (3, 1)}
UNKNOWNS = {"power": "PowerField", "face": "FaceField", "form": "OneForm", "function": "ScalarFunction"}
ACCEPTED = {"solved", "stopped", "refused"}
# Both solve to a residual of 1e-8; an error may be larger by the condition of the system.
LARGEST_DIFFERENCE = 1e-3


# One run, in a process of its own --------------------------------------------------------------------------------

def read(path):
    from vtkmodules.vtkIOPLY import vtkPLYReader
    from vtkmodules.vtkIOXML import vtkXMLPolyDataReader
    reader = vtkXMLPolyDataReader() if path.suffix == ".vtp" else vtkPLYReader()
    reader.SetFileName(str(path))
    reader.Update()
    return reader.GetOutput()


def prescribe(surface, field):
    """A side of some triangles each, as it lies in its plane; or values of some points."""
    from surfaces import add
    from vtkmodules.util.numpy_support import vtk_to_numpy
    polygons = surface.GetPolys()
    corners = vtk_to_numpy(polygons.GetConnectivityArray())
    begins = vtk_to_numpy(polygons.GetOffsetsArray())
    points = vtk_to_numpy(surface.GetPoints().GetData())
    faces = np.arange(PRESCRIBED) * (len(begins) - 1) // PRESCRIBED
    if field == "function":
        values = np.full(len(points), np.nan)
        values[corners[begins[faces]]] = np.arange(PRESCRIBED)
        add(surface.GetPointData(), "Given", values)
    else:
        vectors = np.zeros((surface.GetNumberOfCells(), 3))
        first = surface.GetNumberOfCells() - (len(begins) - 1)
        sides = points[corners[begins[faces] + 1]].astype(float) - points[corners[begins[faces]]]
        lengths = np.linalg.norm(sides, axis=1, keepdims=True)
        vectors[first + faces] = sides / np.where(lengths > 0, lengths, 1)
        add(surface.GetCellData(), "Given", vectors)


def are_finite(data):
    """Whether all arrays of points, cells or rows, and of the field data, hold numbers."""
    from vtkmodules.util.numpy_support import vtk_to_numpy
    for attributes in range(7):
        arrays = data.GetAttributesAsFieldData(attributes)
        for k in range(arrays.GetNumberOfArrays() if arrays else 0):
            array = arrays.GetArray(k)
            if array and array.GetName() != "Given" and not np.isfinite(vtk_to_numpy(array)).all():
                return False
    return True


def first_message(algorithm):
    """A list that will hold the algorithm's messages, which then do not go to the terminal."""
    from vtkmodules.vtkCommonCore import VTK_STRING
    messages = []

    def hear(_caller, _event, text):
        messages.append(" ".join(text.split("): ", 1)[-1].split()))

    hear.CallDataType = VTK_STRING
    for algorithm_or_executive in (algorithm, algorithm.GetExecutive()):
        algorithm_or_executive.AddObserver("ErrorEvent", hear)
        algorithm_or_executive.AddObserver("WarningEvent", hear)
    return messages


def solve(path, field, kind, unknowns_file):
    from directionalmultigrid.vtkFiltersDirectionalFields import (
        vtkFieldSingularities, vtkHarmonicFieldSolver)
    from vtkmodules.util.numpy_support import vtk_to_numpy
    surface = read(path)
    prescribe(surface, field)
    solver = vtkHarmonicFieldSolver()
    messages = first_message(solver)
    discretisation, directions = FIELDS[field]
    solver.SetDiscretisation(discretisation)
    solver.SetNumberOfDirections(directions)
    solver.SetSolver(getattr(vtkHarmonicFieldSolver, kind))
    solver.SetTolerance(1e-8)
    solver.SetInputData(surface)
    if field == "function":
        solver.SetInputArrayToProcess(3, 0, 0, 0, "Given")
    else:
        solver.SetInputArrayToProcess(1, 0, 0, 1, "Given")
    start = time.perf_counter()
    solver.Update()
    row = {"faces": surface.GetNumberOfCells(), "seconds": time.perf_counter() - start,
           "message": messages[0] if messages else ""}
    output = solver.GetOutput()
    if output.GetNumberOfCells() == 0:
        row["outcome"] = "refused" if messages else "empty without a word"
        return row

    converged = output.GetFieldData().GetArray("Converged").GetValue(0)
    row["outcome"] = "solved" if converged else "stopped" if messages else "stopped without a word"
    row["solver"] = output.GetFieldData().GetAbstractArray("Solver").GetValue(0)
    table = solver.GetOutputDataObject(2)
    last = table.GetNumberOfRows() - 1
    if last >= 0:
        row["iterations"] = table.GetValueByName(last, "Iteration").ToInt()
        row["residual"] = table.GetValueByName(last, "RelativeResidual").ToDouble()
    if not all(are_finite(solver.GetOutputDataObject(port)) for port in range(3)):
        row["outcome"] = "not finite"
    edges = solver.GetOutputDataObject(1)
    attributes = {"form": edges.GetCellData(), "function": output.GetPointData()}.get(
        field, output.GetCellData())
    # Fields at points have no array of their unknowns, so they are not compared.
    np.save(unknowns_file, vtk_to_numpy(attributes.GetArray(UNKNOWNS[field])) if field in UNKNOWNS else np.zeros(1))

    singularities = vtkFieldSingularities()
    messages = first_message(singularities)
    singularities.SetInputData(output)
    singularities.Update()
    data = singularities.GetOutput().GetFieldData()
    if messages:
        row["message"] = row["message"] or messages[0]
    if data.HasArray("SumOfIndices"):  # a warning leaves them
        row["index"] = data.GetArray("SumOfIndices").GetValue(0)
        row["euler"] = data.GetArray("EulerCharacteristic").GetValue(0)
        if not abs(row["index"] - row["euler"]) < 1e-6:
            row["outcome"] = "wrong index"
    return row


# All of them ----------------------------------------------------------------------------------------------------

def run(path, field, kind, unknowns_file, limit):
    """The row of one process; it says so where that did not end well."""
    command = [sys.executable, __file__, "--one", field, kind, str(unknowns_file), str(path)]
    start = time.perf_counter()
    try:
        done = subprocess.run(command, capture_output=True, text=True, timeout=limit)
    except subprocess.TimeoutExpired:
        return {"outcome": "hang", "seconds": time.perf_counter() - start}
    if done.returncode == 0:
        return json.loads(done.stdout.splitlines()[-1])
    reason = (signal.Signals(-done.returncode).name if done.returncode < 0
              else (done.stderr.splitlines() or ["?"])[-1])
    return {"outcome": "crash", "seconds": time.perf_counter() - start, "message": reason}


def compare(path, field, kind, limit):
    """A row of the table, as a dictionary."""
    with tempfile.TemporaryDirectory() as folder:
        files = Path(folder) / "mine.npy", Path(folder) / "cholesky.npy"
        row = {"surface": path.stem, "field": field, **run(path, field, kind, files[0], limit)}
        other = run(path, field, "Cholesky", files[1], limit)
        row.update({f"cholesky {key}": value for key, value in other.items()})
        if row["outcome"] == other["outcome"] == "solved":
            mine, cholesky = map(np.load, files)
            largest = np.abs(cholesky).max()
            row["difference"] = np.abs(mine - cholesky).max() / (largest if largest > 0 else 1)
            if row["difference"] > LARGEST_DIFFERENCE and not row["message"]:
                row["outcome"] = "not converged"
    return row


COLUMNS = ["surface", "faces", "field", "outcome", "iterations", "residual", "seconds", "megabytes", "index", "euler",
           "cholesky outcome", "cholesky seconds", "cholesky megabytes", "difference", "solver",
           "message"]


def shown(value):
    return f"{value:.3g}" if isinstance(value, float) else value


def sweep(paths, fields, kind, limit, out):
    """Writes the table. Returns the rows that must not be."""
    bad = []
    with open(out, "w", newline="") as file:
        table = csv.DictWriter(file, COLUMNS, extrasaction="ignore", restval="")
        table.writeheader()
        for path in paths:
            for field in fields:
                row = compare(path, field, kind, limit)
                table.writerow({key: shown(value) for key, value in row.items()})
                file.flush()
                is_bad = not {row["outcome"], row["cholesky outcome"]} <= ACCEPTED
                bad += [row] if is_bad else []
                print("BAD" if is_bad else "   ", *(shown(row.get(key, "-")) for key in COLUMNS[:-1]), flush=True)
    return bad


def is_small_enough(path, most):
    return most is None or read(path).GetNumberOfCells() <= most


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--one", nargs=3, metavar=("FIELD", "SOLVER", "FILE"), help="a single run, as JSON")
    parser.add_argument("--out", type=Path, default=Path("sweep.csv"))
    parser.add_argument("--limit", type=float, default=120.0)
    parser.add_argument("--most", type=int)
    parser.add_argument("--fields", default=",".join(FIELDS))
    parser.add_argument("--solver", default="Automatic")
    parser.add_argument("folder", type=Path)
    options = parser.parse_args()
    if options.one:
        row = solve(options.folder, *options.one)
        row["megabytes"] = resource.getrusage(resource.RUSAGE_SELF).ru_maxrss / 1024
        print(json.dumps(row))
        return 0
    paths = [path for path in sorted(options.folder.iterdir())
             if path.suffix in (".ply", ".vtp") and is_small_enough(path, options.most)]
    bad = sweep(paths, options.fields.split(","), options.solver, options.limit, options.out)
    print(f"{len(bad)} of {len(paths) * len(options.fields.split(','))} must not be")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
