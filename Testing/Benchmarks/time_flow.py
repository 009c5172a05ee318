"""A flow's parts as a user gets them: vtkHodgeDecomposition from a bare surface to all of its arrays, and for further time steps.

    pvpython time_flow.py [--out folder] [--runs n] [--limit vertices] surface.ply|vtp ...

As the filter comes, with cycles, and with CHOLMOD, which factors and solves twice; then SciPy's spsolve, twice on the same matrix, as
ocean models do (not where SciPy is not installed, or beyond --limit vertices). Each run has a filter of its own. Leaves flow.csv: medians of
the seconds of the first Update() and of further ones with other vectors, their ratios to those of cycles, and the bytes that the solver holds.
"""
import argparse
import csv
import statistics
import time
from pathlib import Path

import numpy as np
from directionalmultigrid.vtkFiltersDirectionalFields import vtkHodgeDecomposition
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkIOPLY import vtkPLYReader
from vtkmodules.vtkIOXML import vtkXMLPolyDataReader

try:
    from scipy.sparse import coo_matrix
    from scipy.sparse.linalg import spsolve
except ImportError:
    spsolve = None

STEPS = 3
SOLVERS = ["ConjugateGradients", "Automatic", "Cholesky"]


def read(path):
    reader = vtkXMLPolyDataReader() if path.suffix == ".vtp" else vtkPLYReader()
    reader.SetFileName(str(path))
    reader.Update()
    return reader.GetOutput()


def with_flow(surface, step):
    points = vtk_to_numpy(surface.GetPoints().GetData()).astype(float)
    x, y, z = (points / points.std()).T
    flow = np.stack([np.sin(3 * z + 0.3 * step) - y, x + np.cos(2 * y), np.sin(4 * x + 0.2 * step)], 1)
    result = surface.NewInstance()
    result.ShallowCopy(surface)
    array = numpy_to_vtk(flow, deep=True)
    array.SetName("Flow")
    result.GetPointData().SetVectors(array)
    return result


def run(surface, solver):
    """Seconds of the first and of a further update, bytes."""
    decomposition = vtkHodgeDecomposition()
    decomposition.SetSolver(getattr(vtkHodgeDecomposition, solver))
    seconds = []
    for step in range(STEPS):
        decomposition.SetInputData(with_flow(surface, step))
        start = time.perf_counter()
        decomposition.Update()
        seconds.append(time.perf_counter() - start)
    report = decomposition.GetOutput().GetFieldData()
    if not report.GetArray("Converged").GetValue(0) or decomposition.GetNumberOfSetups() != 1:
        raise SystemExit("the solver has not converged, or was set up more than once")
    return seconds[0], statistics.median(seconds[1:]), report.GetArray("SolverBytes").GetValue(0)


def laplacian(surface):
    """Of cotangents, with one vertex held."""
    points = vtk_to_numpy(surface.GetPoints().GetData()).astype(float)
    triangles = vtk_to_numpy(surface.GetPolys().GetConnectivityArray()).reshape(-1, 3)
    rows, columns, weights = [], [], []
    for k in range(3):
        i, j, opposite = (triangles[:, (k + shift) % 3] for shift in range(3))
        a, b = points[i] - points[opposite], points[j] - points[opposite]
        cotangent = 0.5 * (a * b).sum(1) / np.maximum(np.linalg.norm(np.cross(a, b), axis=1), 1e-300)
        rows += [i, j, i, j]
        columns += [j, i, i, j]
        weights += [-cotangent, -cotangent, cotangent, cotangent]
    matrix = coo_matrix((np.concatenate(weights), (np.concatenate(rows), np.concatenate(columns)))).tocsc()
    return matrix[1:, 1:]


def seconds_of_scipy(surface):
    matrix = laplacian(surface)
    b = np.sin(np.arange(matrix.shape[0]))
    start = time.perf_counter()
    for shift in (0, 1):
        spsolve(matrix, b + shift)
    return time.perf_counter() - start


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--out", type=Path, default=Path("."))
    parser.add_argument("--runs", type=int, default=3)
    parser.add_argument("--limit", type=int, default=200000)
    parser.add_argument("surfaces", nargs="+", type=Path)
    options = parser.parse_args()
    options.out.mkdir(parents=True, exist_ok=True)
    with open(options.out / "flow.csv", "w", newline="") as file:
        rows = csv.writer(file)
        rows.writerow("surface,faces,solver,runs,first,step,bytes,first_ratio,step_ratio,bytes_ratio".split(","))
        for path in options.surfaces:
            surface = read(path)
            ours = None

            def write(solver, *numbers):
                ratios = [f"{number / base:.2f}" for number, base in zip(numbers, ours)]
                row = [path.stem, surface.GetNumberOfCells(), solver, options.runs, *(f"{number:.4g}" for number in numbers), *ratios]
                rows.writerow(row)
                print(*row, sep="  ", flush=True)

            for solver in SOLVERS:
                medians = [statistics.median(column) for column in zip(*(run(surface, solver) for _ in range(options.runs)))]
                ours = ours or medians
                write(solver, *medians)
            if spsolve and surface.GetNumberOfPoints() <= options.limit:
                seconds = seconds_of_scipy(surface)
                write("SciPy", seconds, seconds, float("nan"))


main()
