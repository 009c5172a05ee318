"""Solves for the smoothest field on surfaces where that is hard, and on files, and says which have none.

    smoothest.py [--seconds limit] [--cells most] [file ...]

Each kind of field that is smoothest by itself is solved for, with the properties as they come, with Strict and without. Without
files the surfaces are those of any_surfaces.hard(). The program fails where a field has not converged, is not finite, or took
longer than the limit. A surface that Strict refuses is none of its business.
"""
import argparse
import sys
import time
import warnings
from pathlib import Path

import numpy as np

from any_surfaces import hard
from directionalmultigrid import FieldError, FieldWarning, update
from directionalmultigrid.vtkFiltersDirectionalFields import vtkHarmonicFieldSolver
from surfaces import values

FIELDS = {"at points": (vtkHarmonicFieldSolver.PointPowerField, (1, 2, 3, 4, 6)),
          "on faces": (vtkHarmonicFieldSolver.PowerField, (1, 2, 3, 4, 6)),
          "face fields": (vtkHarmonicFieldSolver.FaceField, (1,)), "1-forms": (vtkHarmonicFieldSolver.OneForm, (1,))}


def how_it_ended(data, discretisation, n, strict=False):
    """An empty text, or why there is no smoothest field."""
    solver = vtkHarmonicFieldSolver()
    solver.SetInputDataObject(0, data)
    solver.SetDiscretisation(discretisation)
    solver.SetNumberOfDirections(n)
    solver.SetStrict(strict)
    try:
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", FieldWarning)
            field = update(solver)
    except FieldError as error:
        return "" if strict else str(error)
    if not np.isfinite(values(field.GetCellData(), "Direction0")).all():
        return "not finite"
    return "" if values(field.GetFieldData(), "Converged")[0] == 1 else "not converged"


def read(path):
    from vtkmodules.vtkIOPLY import vtkPLYReader
    from vtkmodules.vtkIOXML import vtkXMLPolyDataReader
    reader = vtkXMLPolyDataReader() if path.suffix == ".vtp" else vtkPLYReader()
    reader.SetFileName(str(path))
    return update(reader)


def main():
    parser = argparse.ArgumentParser()
    parser.add_argument("--seconds", type=float, default=60.0)
    parser.add_argument("--cells", type=int, default=50000)
    parser.add_argument("files", type=Path, nargs="*")
    options = parser.parse_args()
    surfaces = {path.stem: read(path) for path in options.files} or hard()
    bad = 0
    for name, data in surfaces.items():
        for fields, (discretisation, numbers) in FIELDS.items():
            for n, strict in [(n, strict) for n in numbers for strict in (False, True) if data.GetNumberOfCells() <= options.cells]:
                start = time.perf_counter()
                end = how_it_ended(data, discretisation, n, strict)
                seconds = time.perf_counter() - start
                end = end or ("slow" if seconds > options.seconds else "")
                bad += end != ""
                print("BAD" if end else "   ", name, data.GetNumberOfCells(), fields, n, "strict" if strict else "-", f"{seconds:.2f}", end,
                      flush=True)
    print(f"{bad} must not be")
    return 1 if bad else 0


if __name__ == "__main__":
    sys.exit(main())
