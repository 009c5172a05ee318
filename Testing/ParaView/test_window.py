#!/usr/bin/env python3
"""Drives ParaView's window as a user does: filters from the menu, arrays and guides from their lists, Apply.

    test_window.py PARAVIEW OUTPUT-FOLDER NAME

plays NAME.xml (FieldInTheWindow, GuideInTheWindow, NothingSaidInTheWindow or FeaturesInTheWindow), leaves NAME.vtk, as saved by
the window, and a screenshot of it in the folder, and checks the former. Needs a display; ParaView has to find the plugin by itself.
"""

import pathlib
import subprocess
import sys
import time

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkFiltersSources import vtkArcSource, vtkSphereSource
from vtkmodules.vtkIOImage import vtkPNGReader
from vtkmodules.vtkIOLegacy import vtkPolyDataReader
from vtkmodules.vtkIOXML import vtkXMLPolyDataWriter


def write_sphere(path):
    """The unit sphere with prescribed directions on one side."""
    source = vtkSphereSource()
    source.SetRadius(1)
    source.SetThetaResolution(60)
    source.SetPhiResolution(60)
    source.Update()
    sphere = source.GetOutput()
    points = vtk_to_numpy(sphere.GetPoints().GetData())
    arrays = {"Mask": (points[:, 0] > 0.9).astype("i4"), "Directions": 0 * points + (0, 1, 0)}
    for name, values in arrays.items():
        array = numpy_to_vtk(values, deep=True)
        array.SetName(name)
        sphere.GetPointData().AddArray(array)
    write(path, sphere)


def write_ellipsoid(path):
    """Twice as long along the z-axis as across."""
    source = vtkSphereSource()
    source.SetThetaResolution(60)
    source.SetPhiResolution(60)
    source.Update()
    ellipsoid = source.GetOutput()
    vtk_to_numpy(ellipsoid.GetPoints().GetData())[:, 2] *= 2
    write(path, ellipsoid)


def write_guide(path):
    """An arc around a part of the equator of ParaView's own sphere, of radius 1/2."""
    arc = vtkArcSource()
    arc.SetPoint1(0.5, 0, 0.01)
    arc.SetPoint2(0, 0.5, 0.01)
    arc.SetCenter(0, 0, 0.01)
    arc.SetResolution(9)
    arc.Update()
    write(path, arc.GetOutput())


def write(path, data):
    writer = vtkXMLPolyDataWriter()
    writer.SetFileName(str(path))
    writer.SetInputData(data)
    writer.SetDataModeToBinary()  # see README, "Files"
    writer.Write()


def play(paraview, data, result, folder):
    """Runs the window until the result is written and no longer grows; takes the screenshot then."""
    command = [paraview, "--disable-registry", f"--data={data}", f"--test-directory={folder}",
               f"--test-script={pathlib.Path(__file__).with_name(result.stem + '.xml')}"]
    log = result.with_suffix(".log")
    with log.open("w") as output:
        window = subprocess.Popen(command, stdout=output, stderr=subprocess.STDOUT)
    try:
        size, complete = 0, False
        deadline = time.monotonic() + 120
        while not complete and time.monotonic() < deadline and window.poll() is None:
            time.sleep(0.5)
            if "critical:" in log.read_text():
                break
            former, size = size, result.stat().st_size if result.exists() else 0
            complete = size == former > 0
        subprocess.run(["import", "-window", "root", result.with_suffix(".png")], check=True)
    finally:
        window.kill()
        window.wait()
    print(log.read_text())
    if "ERR|" in log.read_text() or not complete:
        raise SystemExit("ParaView reported errors or wrote no field")


def check(result, N=4):
    reader = vtkPolyDataReader()  # not XML: see README, "Files"
    reader.SetFileName(str(result))
    reader.Update()
    field = reader.GetOutput()
    assert field.GetFieldData().GetArray("Converged").GetValue(0) == 1
    for attributes in (field.GetPointData(), field.GetCellData()):
        assert attributes.HasArray("Direction0") and attributes.HasArray(f"Direction{N - 1}")
    # Poincare-Hopf: the indices sum to the Euler characteristic.
    indices = vtk_to_numpy(field.GetPointData().GetArray("SingularityIndex"))
    assert abs(indices.sum() - 2) < 1e-12, indices.sum()
    return field


def check_guide(result):
    """The arc was followed, segment by segment, and nothing else was."""
    report = check(result).GetFieldData()
    assert report.GetArray("GuidesTaken").GetValue(0) == 9
    assert report.GetArray("GuidesTooFar").GetValue(0) == 0


def check_features(result):
    """Crosses run along and across the axis of the ellipsoid, but for its ends; nothing else is followed."""
    field = check(result)
    places = vtk_to_numpy(field.GetPoints().GetData())
    across = np.stack([-places[:, 1], places[:, 0], 0 * places[:, 2]], axis=1)
    across /= np.linalg.norm(across, axis=1, keepdims=True) + 1e-300
    crosses = np.stack([vtk_to_numpy(field.GetPointData().GetArray(f"Direction{k}")) for k in range(4)])
    away = np.abs(places[:, 2]) < 0.8 * places[:, 2].max()
    assert (crosses * across).sum(axis=2).max(axis=0)[away].min() > 0.99
    assert not field.GetFieldData().HasArray("GuidesTaken")
    assert field.GetPointData().HasArray("MaximumDirection")


def check_nothing_said(result):
    """The window shows the smoothest lines: four singularities, and lines and spheres in the colours of the map."""
    field = check(result, 2)
    assert field.GetFieldData().GetArray("Eigenvalues").GetNumberOfTuples() == 1
    indices = vtk_to_numpy(field.GetPointData().GetArray("SingularityIndex"))
    assert list(indices[indices != 0]) == [0.5] * 4, indices[indices != 0]
    reader = vtkPNGReader()
    reader.SetFileName(str(result.with_suffix(".png")))
    reader.Update()
    image = vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars())[:, :3].astype(int)
    blue = (image[:, 2] > 1.8 * image[:, 0]) & (image[:, 2] > 100)
    assert blue.sum() > 5000, blue.sum()


def main():
    paraview, folder, name = sys.argv[1], pathlib.Path(sys.argv[2]).resolve(), sys.argv[3]
    folder.mkdir(parents=True, exist_ok=True)
    data, result = folder / f"{name}.vtp", folder / f"{name}.vtk"
    result.unlink(missing_ok=True)
    write_data, check_result = {"FieldInTheWindow": (write_sphere, check),
                                "GuideInTheWindow": (write_guide, check_guide),
                                "NothingSaidInTheWindow": (write_sphere, check_nothing_said),
                                "FeaturesInTheWindow": (write_ellipsoid, check_features)}[name]
    write_data(data)
    play(paraview, data, result, folder)
    check_result(result)


if __name__ == "__main__":
    main()
