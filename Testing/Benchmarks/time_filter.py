"""The whole job as a user sees it: vtkHarmonicFieldSolver, from a bare surface to all of its arrays.

    pvpython time_filter.py [--out folder] [--runs n] surface.ply|vtp ...

Twenty triangles are prescribed, or nothing; everything else is as the filter comes, and then with Cholesky as its solver. Each
run has a filter of its own. Leaves filter.csv: medians of the seconds that Update() takes, and of what the filter
reports of its stages; "other" is what it needs besides, most of it for the arrays. The last column has the seconds with Cholesky
in the same run over these. Then crosses are solved and changed as in a window, and drawn: changes.csv has the medians of Update()
after each change and of each filter that draws.
"""
import argparse
import csv
import statistics
import time
from pathlib import Path

import numpy as np
from directionalmultigrid.vtkFiltersDirectionalFields import (vtkDirectionalField, vtkFieldGlyphs, vtkFieldLines,
                                                              vtkFieldSingularities, vtkHarmonicFieldSolver)
from vtkmodules.util.numpy_support import numpy_to_vtk
from vtkmodules.vtkFiltersSources import vtkLineSource
from vtkmodules.vtkIOPLY import vtkPLYReader
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

PRESCRIBED = 20
JOBS = [("points, N = 4", 4, 4, "Given"), ("points, N = 4, nothing said", 4, 4, ""), ("points, N = 2", 4, 2, "Given"),
        ("power, N = 4", 0, 4, "Given"), ("face-based", 1, 1, "Given"), ("DEC", 2, 1, "Given")]
SOLVERS = [("Cholesky", vtkHarmonicFieldSolver.Cholesky), ("Automatic", vtkHarmonicFieldSolver.Automatic)]
DRAWINGS = [vtkFieldLines, vtkFieldGlyphs, vtkFieldSingularities]
STAGES = ["SetupSeconds", "PrepareSeconds", "SolveSeconds"]


def read(path):
    reader = vtkXMLPolyDataReader() if path.suffix == ".vtp" else vtkPLYReader()
    reader.SetFileName(str(path))
    reader.Update()
    surface = reader.GetOutput()
    faces = surface.GetNumberOfCells()
    directions = np.zeros((faces, 3))
    directions[np.arange(PRESCRIBED) * faces // PRESCRIBED] = 1.0, 0.3, 0.2
    array = numpy_to_vtk(directions, deep=True)
    array.SetName("Given")
    surface.GetCellData().AddArray(array)
    return surface


def run(surface, discretisation, number, given, kind):
    """Seconds: of all, of the stages, and of the rest."""
    solver = vtkHarmonicFieldSolver()
    solver.SetDiscretisation(discretisation)
    solver.SetNumberOfDirections(number)
    solver.SetSolver(kind)
    solver.SetInputData(surface)
    solver.SetInputArrayToProcess(1, 0, 0, 1, given)
    total = seconds_of_update(solver)
    report = solver.GetOutput().GetFieldData()
    if not report.GetArray("Converged").GetValue(0):
        raise SystemExit("the solver has not converged")
    stages = [report.GetArray(stage).GetValue(0) for stage in STAGES]
    return [total, *stages, total - sum(stages)]


def seconds_of_update(solver):
    start = time.perf_counter()
    solver.Update()
    return time.perf_counter() - start


def changes(surface):
    """(what has changed, seconds of the update after it), of one filter."""
    low, high = np.reshape(surface.GetBounds(), (3, 2)).T
    above = (low + high) / 2
    above[2] = high[2]
    line = vtkLineSource()
    line.SetPoint1(above - (high - low) * (0.05, 0, 0))
    line.SetPoint2(above + (high - low) * (0.05, 0.02, 0))
    solver = vtkHarmonicFieldSolver()
    solver.SetInputData(surface)
    solver.SetInputArrayToProcess(1, 0, 0, 1, "Given")
    solver.SetNumberOfDirections(4)
    solver.SetMaximumDistance(1)
    yield "all", seconds_of_update(solver)
    solver.SetNumberOfDirections(2)
    yield "a new N", seconds_of_update(solver)
    solver.SetNumberOfDirections(4)
    yield "an old N", seconds_of_update(solver)
    solver.CombingOff()
    yield "combing", seconds_of_update(solver)
    solver.UnitLengthOff()
    yield "unit length", seconds_of_update(solver)
    solver.CombingOn()
    solver.UnitLengthOn()
    solver.AddInputConnection(1, line.GetOutputPort())
    yield "a guide added", seconds_of_update(solver)
    line.SetPoint1(above - (high - low) * (0.05, 0.02, 0))
    yield "a guide moved", seconds_of_update(solver)
    for kind in DRAWINGS:
        drawing = kind()
        drawing.SetInputData(solver.GetOutput())
        yield kind.__name__, seconds_of_update(drawing)
    everything = vtkDirectionalField()
    everything.SetInputData(surface)
    yield "vtkDirectionalField", seconds_of_update(everything)


def write_changes(path, surface, runs, rows):
    times = {}
    for _ in range(runs):
        for change, seconds in changes(surface):
            times.setdefault(change, []).append(seconds)
    for change, seconds in times.items():
        row = [path.stem, surface.GetNumberOfCells(), change, runs, f"{statistics.median(seconds):.4f}"]
        rows.writerow(row)
        print(*row, sep="  ", flush=True)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--out", type=Path, default=Path("."))
    parser.add_argument("--runs", type=int, default=5)
    parser.add_argument("surfaces", nargs="+", type=Path)
    options = parser.parse_args()
    options.out.mkdir(parents=True, exist_ok=True)
    with open(options.out / "filter.csv", "w", newline="") as file, \
            open(options.out / "changes.csv", "w", newline="") as changed:
        rows, rows_of_changes = csv.writer(file), csv.writer(changed)
        rows.writerow("surface,faces,field,solver,runs,total,setup,prepare,solve,other,ratio".split(","))
        rows_of_changes.writerow("surface,faces,change,runs,seconds".split(","))
        for path in options.surfaces:
            surface = read(path)
            for field, *job in JOBS:
                totals = []
                for solver, kind in SOLVERS:
                    runs = [run(surface, *job, kind) for _ in range(options.runs)]
                    medians = [statistics.median(column) for column in zip(*runs)]
                    totals.append(medians[0])
                    row = [path.stem, surface.GetNumberOfCells(), field, solver, options.runs,
                           *(f"{median:.4f}" for median in medians), f"{totals[0] / totals[-1]:.2f}"]
                    rows.writerow(row)
                    print(*row, sep="  ", flush=True)
            write_changes(path, surface, options.runs, rows_of_changes)


main()
