#!/usr/bin/env python3
"""Drives ParaView's window as a user does: filters from the menu, arrays and guides from their lists, Apply.

    test_window.py PARAVIEW OUTPUT-FOLDER NAME

plays NAME.xml (those of TESTS below), leaves NAME.vtk, as saved by the window in the end, and a screenshot of it in the folder,
and checks them. Needs a display, and xdotool where mouse and keys are played; ParaView has to find the plugin by itself.
"""

import functools
import pathlib
import shutil
import subprocess
import sys
import time
from xml.etree import ElementTree

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkMultiBlockDataSet, vtkPartitionedDataSetCollection, vtkPolyData
from vtkmodules.vtkFiltersSources import vtkArcSource, vtkSphereSource
from vtkmodules.vtkIOImage import vtkPNGReader
from vtkmodules.vtkIOLegacy import vtkGenericDataObjectReader, vtkPolyDataReader
from vtkmodules.vtkIOParallelXML import vtkXMLPartitionedDataSetCollectionWriter
from vtkmodules.vtkIOXML import (vtkXMLImageDataWriter, vtkXMLMultiBlockDataReader, vtkXMLMultiBlockDataWriter,
                                 vtkXMLPartitionedDataSetCollectionReader, vtkXMLPolyDataWriter, vtkXMLRectilinearGridWriter,
                                 vtkXMLStructuredGridWriter, vtkXMLUnstructuredGridWriter)

sys.path.insert(0, str(pathlib.Path(__file__).parents[1] / "Python"))
import any_surfaces


def bare_sphere(resolution=60):
    """The unit sphere, with normals."""
    source = vtkSphereSource()
    source.SetRadius(1)
    source.SetThetaResolution(resolution)
    source.SetPhiResolution(resolution)
    source.Update()
    return source.GetOutput()


def write_bare_sphere(path):
    write(path, bare_sphere())


def write_sphere(path, resolution=60, zero=False):
    """The unit sphere with prescribed directions on one side."""
    sphere = bare_sphere(resolution)
    points = vtk_to_numpy(sphere.GetPoints().GetData())
    arrays = {"Mask": (points[:, 0] > 0.9).astype("i4"), "Directions": 0 * points + (0, 1, 0)}
    if zero:
        arrays["Directions"] = 0 * points
    for name, values in arrays.items():
        array = numpy_to_vtk(values, deep=True)
        array.SetName(name)
        sphere.GetPointData().AddArray(array)
    write(path, sphere)


def write_large_sphere(path):
    """One that is not worth a factorisation, so that the solver iterates."""
    write_sphere(path, 200)


def write_zero_directions(path):
    """A sphere with vectors as a simulation leaves them at its first step."""
    write_sphere(path, zero=True)


def write_ellipsoid(path):
    """Twice as long along the z-axis as across."""
    source = vtkSphereSource()
    source.SetThetaResolution(60)
    source.SetPhiResolution(60)
    source.Update()
    ellipsoid = source.GetOutput()
    vtk_to_numpy(ellipsoid.GetPoints().GetData())[:, 2] *= 2
    write(path, ellipsoid)


def write_flow(path):
    """The unit sphere, as active vectors its rotation about the x-axis and the gradient of z."""
    sphere = bare_sphere()
    x, y, z = vtk_to_numpy(sphere.GetPoints().GetData()).T.astype(float)
    flow = numpy_to_vtk(np.stack([0 * x, -z, y + 1], axis=1), deep=True)
    flow.SetName("Flow")
    sphere.GetPointData().SetVectors(flow)
    write(path, sphere)


def write_guide(path):
    """An arc around a part of the equator of ParaView's own sphere, of radius 1/2, with an array of upward vectors and weights."""
    arc = vtkArcSource()
    arc.SetPoint1(0.5, 0, 0.01)
    arc.SetPoint2(0, 0.5, 0.01)
    arc.SetCenter(0, 0, 0.01)
    arc.SetResolution(9)
    arc.Update()
    for name, values in (("Along", np.tile((0.0, 0.0, 1.0), (10, 1))), ("Weight", np.full(10, 7.0))):
        array = numpy_to_vtk(values, deep=True)
        array.SetName(name)
        arc.GetOutput().GetPointData().AddArray(array)
    write(path, arc.GetOutput())


def write_plate_with_stiffener(path):
    """A plate of quads, and a wall on its middle line."""
    write(path, any_surfaces.plate_with_stiffener())


def write(path, data):
    writer = vtkXMLPolyDataWriter()
    writer.SetFileName(str(path))
    writer.SetInputData(data)
    writer.SetDataModeToBinary()  # see Testing/Examples/README.md, "Files"
    writer.Write()


# Sources that ParaView brings along, each with the filter that makes it a surface, if it is none; and types of files.
SHAPES = [(shape, None) for shape in ("ArrowSource", "CubeSource", "ConeSource", "CylinderSource", "DiskSource", "PlaneSource",
                                      "SphereSource", "SuperquadricSource")] + [("LineSource", "TubeFilter")]
FILES = ["grid.vtu", "grid.vts", "grid.vtr", "grid.vti", "blocks.vtm", "parts.vtpc"]
COMPOSITE = (".vtm", ".vtpc")


def write_files(path):
    """Surfaces of other types than vtkPolyData: hexagons, a seam with poles, rectangles, pixels, blocks of two types, and parts
    of one, with nothing in the middle."""
    hexagonal, blocks, pixels = any_surfaces.grid_of(any_surfaces.hexagons(2)), vtkMultiBlockDataSet(), any_surfaces.image()
    numbers = numpy_to_vtk(np.arange(pixels.GetNumberOfPoints()), deep=True)  # without an array ParaView fails to draw an image
    numbers.SetName("Number")
    pixels.GetPointData().SetScalars(numbers)
    blocks.SetBlock(0, hexagonal)
    blocks.SetBlock(1, any_surfaces.sphere())
    parts = vtkPartitionedDataSetCollection()
    parts.SetPartition(0, 0, any_surfaces.sphere())
    parts.SetPartition(1, 0, vtkPolyData())
    parts.SetPartition(2, 0, any_surfaces.plate_with_stiffener())
    for name, writer, data in zip(FILES, (vtkXMLUnstructuredGridWriter(), vtkXMLStructuredGridWriter(), vtkXMLRectilinearGridWriter(),
                                          vtkXMLImageDataWriter(), vtkXMLMultiBlockDataWriter(),
                                          vtkXMLPartitionedDataSetCollectionWriter()),
                                  (hexagonal, any_surfaces.latitude_longitude(), any_surfaces.rectilinear(), pixels, blocks, parts)):
        writer.SetFileName(str(path.with_name(f"{path.stem}-{name}")))
        writer.SetInputData(data)
        writer.SetDataModeToBinary()
        writer.Write()
    write_sphere(path)


def event(widget, command, arguments=""):
    return f'  <pqevent object="pqClientMainWindow/{widget}" command="{command}" arguments="{arguments}" />\n'


APPLY = event("propertiesDock/propertiesPanel/Accept", "activate")


def save(path):
    """Saves the first output of what is active."""
    saved = event("menubar/menu_File/actionFileSaveData", "activate")
    saved += event("FileSaveDialog", "filesSelected", f"$PARAVIEW_TEST_ROOT/{path}")
    return saved + event("WriterSettingsDialog/widget/OKButton", "activate")


def open_file(path):
    opened = event("menubar/menu_File/actionFileOpen", "activate")
    return opened + event("FileOpenDialog", "filesSelected", f"$PARAVIEW_TEST_ROOT/{path}") + APPLY


def menu(name, group, entry):
    """ParaView 5.13 fills a menu when it is opened."""
    return event("menubar", "activate", name) + event(f"menubar/{name}/{group}", "activate", entry)


def apply_to_any_surface(name):
    """Each source, or each file, Apply, Directional Field, Apply: nothing else is said."""
    field = menu("menuFilters", "Directional Fields", "DirectionalField") + APPLY
    # What stands in the first row of the pipeline, and what was made of it: else the window becomes slow.
    forget = event("pipelineBrowserDock/pipelineBrowser", "currentChanged", "/0/0|0")
    forget += event("menubar/menu_Edit/actionDeleteTree", "activate")
    events = forget
    for shape, between in SHAPES if name.startswith("Sources") else []:
        events += menu("menuSources", "Alphabetical", shape) + APPLY
        if between:
            events += menu("menuFilters", "Alphabetical", between) + APPLY
        events += field + save(f"{name}-{shape}.vtk") + forget
    for file in FILES if name.startswith("Grids") else []:
        events += open_file(f"{name}-{file}") + field
        events += save(f"{name}-field-{file}" if file.endswith(COMPOSITE) else f"{name}-{file}.vtk") + forget
    events += open_file(f"{name}.vtp") + field + save(f"{name}.vtk")
    return f"<pqevents>\n{events}</pqevents>\n"


@functools.lru_cache
def is_5_11(paraview):
    """Whether it is ParaView 5.11; later versions have other names and other menus."""
    version = subprocess.run([paraview, "--version"], capture_output=True, text=True, check=True).stdout
    return " 5.11" in version


def toolbar(paraview):
    """The name of the filters' toolbar."""
    return "Directional Fields" if is_5_11(paraview) else "filters.Directional Fields"


def xdotool(*arguments):
    done = subprocess.run(["xdotool", *map(str, arguments)], capture_output=True, text=True, check=True, timeout=20)
    time.sleep(0.5)  # as a person takes from one action to the next
    return done.stdout.split()


def focus(title):
    """Waits for a window, which takes the keys from now on."""
    for _ in range(80):  # a busy machine takes its time
        found = subprocess.run(["xdotool", "search", "--onlyvisible", "--name", title], capture_output=True, text=True)
        if found.stdout:
            xdotool("windowfocus", found.stdout.split()[-1])
            return
        time.sleep(0.5)
    raise SystemExit(f"there is no window {title}")


def place_points(_, result):
    """Keys 1 and 2 place both ends of the line on the surface below the mouse; then Apply, and the line is saved."""
    focus("ParaView")
    time.sleep(3)
    for key, place in ((1, (680, 420)), (2, (780, 500))):
        xdotool("mousemove", *place)
        xdotool("key", key)
    apply_and_save(former(result, "line"))


def choose_first_of_menu(paraview, result):
    """The first entry of the plugin's menu, by keys; pictures without and with it."""
    focus("ParaView")
    time.sleep(3)
    take_picture(former(result, "closed", ".png"))
    xdotool("key", "alt+l")
    if is_5_11(paraview):
        xdotool("key", "d")  # opens Data Analysis, which comes before
        xdotool("key", "Left", "Down", "Right")
    else:
        xdotool("key", *7 * ["Down"], "Right")  # from Search past Recent, Favorites, Alphabetical, Common, Data Array and Data Model
    take_picture(former(result, "open", ".png"))
    xdotool("key", "Return")
    apply_and_save(former(result, "field"))


def take_picture(path):
    subprocess.run(["import", "-window", "root", path], check=True)


def apply_and_save(path):
    xdotool("key", "alt+a")
    xdotool("key", "ctrl+s")
    focus("Save File")
    xdotool("type", path)
    xdotool("key", "Return")
    focus("Configure Writer")
    xdotool("key", "Return")
    deadline = time.monotonic() + 60
    while not path.exists() and time.monotonic() < deadline:
        time.sleep(0.5)


WITH_KEYS = {"PointsPlacedInTheWindow": place_points, "MenuInTheWindow": choose_first_of_menu}


def play(paraview, data, result, folder, fails):
    """Runs the window until the result is written and no longer grows; takes the screenshot then. With or without an error."""
    events = (apply_to_any_surface(result.stem) if result.stem in ("SourcesInTheWindow", "GridsInTheWindow")
              else pathlib.Path(__file__).with_name(result.stem + ".xml").read_text())
    script = result.with_suffix(".xml")
    script.write_text(events.replace("$TOOLBAR", toolbar(paraview)))
    command = [paraview, "--disable-registry", f"--data={data}", f"--test-directory={folder}", f"--test-script={script}"]
    log = result.with_suffix(".log")
    with log.open("w") as output:
        window = subprocess.Popen(command, stdout=output, stderr=subprocess.STDOUT)
    try:
        size, complete = 0, False
        deadline = time.monotonic() + 200
        while not complete and time.monotonic() < deadline and window.poll() is None:
            time.sleep(0.5)
            if "critical:" in log.read_text():
                break
            former_size, size = size, result.stat().st_size if result.exists() else 0
            complete = size == former_size > 0
        if complete and result.stem in WITH_KEYS:
            WITH_KEYS[result.stem](paraview, result)
        take_picture(result.with_suffix(".png"))
    finally:
        window.kill()
        window.wait()
    print(log.read_text())
    if ("ERR|" in log.read_text()) != fails or not complete:
        raise SystemExit("ParaView reported errors, or not the one that was expected, or wrote no field")


def read(path):
    reader = vtkPolyDataReader()  # not XML: see Testing/Examples/README.md, "Files"
    reader.SetFileName(str(path))
    reader.Update()
    return reader.GetOutput()


def former(result, what="before", suffix=".vtk"):
    """What the window has saved earlier on."""
    return result.with_name(f"{result.stem}-{what}{suffix}")


def pixels(result):
    """The colours of the screenshot, a row each."""
    reader = vtkPNGReader()
    reader.SetFileName(str(result.with_suffix(".png")))
    reader.Update()
    return vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars())[:, :3].astype(int)


def number_of_blue(image):
    return ((image[:, 2] > 1.8 * image[:, 0]) & (image[:, 2] > 100)).sum()


def is_red(image):
    return (image[:, 0] > 1.8 * image[:, 2]) & (image[:, 0] > 1.8 * image[:, 1]) & (image[:, 0] > 100)


def number_of_red(image):
    return is_red(image).sum()


def shows_surface(image):
    """Whether a grey surface is seen."""
    return ((np.ptp(image, axis=1) < 40) & (image.min(axis=1) > 60) & (image.max(axis=1) < 239)).sum() > 20000


def check(result, N=4):
    field = read(result)
    assert field.GetFieldData().GetArray("Converged").GetValue(0) == 1
    for attributes in (field.GetPointData(), field.GetCellData()):
        assert attributes.HasArray("Direction0") and not attributes.HasArray("Direction1")
    assert field.GetFieldData().GetArray("NumberOfDirections").GetValue(0) == N
    # Poincare-Hopf: the indices sum to the Euler characteristic.
    indices = vtk_to_numpy(field.GetCellData().GetArray("SingularityIndex"))
    assert abs(indices.sum() - 2) < 1e-12, indices.sum()
    return field


def check_guide(result):
    """The array of the arc was followed at its points, upwards, with its weight, and nothing else was."""
    field = check(result, 2)
    report = field.GetFieldData()
    assert report.GetArray("GuidesTaken").GetValue(0) == 10
    assert report.GetArray("GuidesTooFar").GetValue(0) == 0
    # Each prescribes the corners of the face below it, a third of its area each.
    prescribed = vtk_to_numpy(field.GetPointData().GetArray("Prescribed"))
    cells = vtk_to_numpy(field.GetPolys().GetConnectivityArray()).reshape(-1, 3)
    a, b, c = (vtk_to_numpy(field.GetPoints().GetData()).astype(float)[cells[:, k]] for k in range(3))
    areas = np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2
    of_points = np.bincount(cells.ravel(), np.repeat(areas / 3, 3))
    held = (prescribed > 0)[cells].all(axis=1)
    guided = (prescribed * of_points).sum() / 7
    assert 10 * areas[held].min() < guided * (1 + 1e-6) and guided < 10 * areas[held].max() * (1 + 1e-6), (guided, areas[held])
    assert np.abs(vtk_to_numpy(field.GetPointData().GetArray("Direction0"))[prescribed > 0, 2]).min() > 0.9


def check_features(result):
    """Crosses run along and across the axis of the ellipsoid, but for its ends; nothing else is followed."""
    field = check(result)
    places = vtk_to_numpy(field.GetPoints().GetData())
    across = np.stack([-places[:, 1], places[:, 0], 0 * places[:, 2]], axis=1)
    across /= np.linalg.norm(across, axis=1, keepdims=True) + 1e-300
    first = vtk_to_numpy(field.GetPointData().GetArray("Direction0"))
    along = (first * across).sum(axis=1)
    away = np.abs(places[:, 2]) < 0.8 * places[:, 2].max()
    assert np.maximum(along ** 2, 1 - along ** 2)[away].min() > 0.98  # a cross has a direction along or one across
    assert not field.GetFieldData().HasArray("GuidesTaken")
    assert field.GetPointData().HasArray("MaximumDirection")


def check_flow(result):
    """Both functions are those of the file; the second output shows contours of the stream function, blue lines."""
    flow = read(result)
    x, _, z = vtk_to_numpy(flow.GetPoints().GetData()).T
    for name, expected in (("StreamFunction", -x), ("Potential", z)):
        assert np.abs(vtk_to_numpy(flow.GetPointData().GetArray(name)) - expected).max() < 0.01, name
    shares = vtk_to_numpy(flow.GetFieldData().GetArray("FlowShares"))
    assert abs(shares[0] - 0.5) < 0.01 and abs(shares[1] - 0.5) < 0.01, shares
    image = pixels(result).astype(int)
    blue, warm = image[:, 2] > 1.8 * image[:, 0], image[:, 0] > 1.15 * image[:, 2]
    assert (blue[4:-4] & warm[:-8] & warm[8:]).sum() > 500  # thin lines on the half where the stream function is positive


def check_transport(result):
    """The point in front is chosen, and the handle is there. Distances from it are those of great circles; colours show them."""
    carried = read(result)
    places = vtk_to_numpy(carried.GetPoints().GetData()).astype(float)
    start = places[int(carried.GetFieldData().GetArray("MapPoint").GetValue(0))]
    assert start[2] > 1 - 1e-6, start
    state = ElementTree.parse(result.with_suffix(".pvsm"))
    transport = next(proxy for proxy in state.iter("Proxy") if proxy.get("type") == "ParallelTransport")
    assert [float(value_of(transport, "Point", k)) for k in range(3)] == list(start), start
    exact = np.arccos(np.clip(places @ start, -1, 1))
    near = exact < 2.6
    distance = vtk_to_numpy(carried.GetPointData().GetArray("GeodesicDistance"))
    assert np.abs(distance - exact)[near].max() < 0.02 * np.pi
    lengths = np.linalg.norm(vtk_to_numpy(carried.GetPointData().GetArray("TransportedVectors")), axis=1)
    assert lengths.min() > 0 and np.ptp(lengths) < 1e-5 * lengths.max()
    image = pixels(result).astype(int)
    assert (np.ptp(image, axis=1) > 60).sum() > 20000  # coloured by the distance


def check_nothing_said(result):
    """The smoothest crosses, then the smoothest lines: four singularities, which the window shows as red spheres, and blue lines."""
    for path, N in ((former(result), 4), (result, 2)):
        field = check(path, N)
        assert field.GetFieldData().GetArray("Eigenvalues").GetNumberOfTuples() == 1
        indices = vtk_to_numpy(field.GetCellData().GetArray("SingularityIndex"))
        assert list(indices[indices != 0]) == [1 / N] * (2 * N), indices[indices != 0]
    lines = read(former(result, "lines"))
    assert set(vtk_to_numpy(lines.GetCellData().GetArray("Branch"))) == {0}  # crosses have two
    assert number_of_blue(pixels(result)) > 5000 and number_of_red(pixels(result)) > 50


def check_guide_moved(result):
    """At the front, lines run along the line that was drawn, first upwards, then sideways; the picture shows the latter."""
    for path, axis in ((former(result), 1), (result, 0)):
        field = check(path, 2)
        assert field.GetFieldData().GetArray("GuidesTaken").GetValue(0) == 1
        places = vtk_to_numpy(field.GetPoints().GetData())
        directions = vtk_to_numpy(field.GetPointData().GetArray("Direction0"))
        front = np.linalg.norm(places - (0, 0, 1), axis=1) < 0.3
        assert np.abs(directions[front, axis]).min() > 0.9, path
    assert number_of_blue(pixels(result)) > 1500  # lines, on the surface


def check_filters(result):
    """Eight singularities; blue lines of both branches, and red spheres, on the surface that stays."""
    points = read(result)
    indices = vtk_to_numpy(points.GetPointData().GetArray("Index"))
    assert list(indices) == [0.25] * 8, indices
    lines = read(former(result, "lines"))
    assert set(vtk_to_numpy(lines.GetCellData().GetArray("Branch"))) == {0, 1}
    image = pixels(result)
    assert number_of_blue(image) > 1500 and number_of_red(image) > 50
    assert shows_surface(image)


def check_state(result):
    """All arrays of the field have the same bits as before the state was saved."""
    before, after = check(former(result), 3), check(result, 3)
    for kind in ("GetPointData", "GetCellData"):
        one, other = getattr(before, kind)(), getattr(after, kind)()
        assert one.GetNumberOfArrays() == other.GetNumberOfArrays() >= 3  # Direction0 and two more
        for index in range(one.GetNumberOfArrays()):
            name = one.GetArrayName(index)
            assert np.array_equal(vtk_to_numpy(one.GetArray(name)), vtk_to_numpy(other.GetArray(name))), name
    assert number_of_blue(pixels(result)) > 1500


def check_convergence(result):
    """The chart shows one curve, the logarithm of the table's residuals, on white, with titles and whole iterations."""
    check(result)
    table, chart = (np.genfromtxt(former(result, what, ".csv"), delimiter=",", names=True, deletechars="")
                    for what in ("table", "chart"))
    residuals, = (chart[name] for name in chart.dtype.names)
    assert len(residuals) > 2 and residuals[0] == 0 and residuals[-1] < -4, residuals
    assert np.abs(residuals - np.log10(table["RelativeResidual"])).max() < 1e-3
    assert (pixels(result).min(axis=1) > 250).sum() > 200000
    state = ElementTree.parse(result.with_suffix(".pvsm"))
    view = next(proxy for proxy in state.iter("Proxy") if proxy.get("type") == "XYChartView")
    assert value_of(view, "BottomAxisTitle", 0) == "iteration"
    assert value_of(view, "LeftAxisTitle", 0) == "log10 of the relative residual"
    labels = [element.get("value") for element in view.findall("Property[@name='BottomAxisLabels']/Element")]
    assert labels == [text for k in range(len(residuals)) for text in 2 * [str(k)]], labels  # at most ten


def check_failed_first(result):
    """The displays of the outputs have the defaults of data, which they did not have after the error, and show them."""
    field = check(result)
    sizes, vectors = {}, {}
    for what, suffix in (("before", "-before.pvsm"), ("after", ".pvsm")):
        state = ElementTree.parse(result.with_name(result.stem + suffix))
        displays = [proxy for proxy in state.iter("Proxy") if proxy.get("type") in ("GeometryRepresentation", "FieldDrawingRepresentation")]
        sizes[what] = [value_of(display, "ScaleFactor", 0) for display in displays]
        vectors[what] = [value_of(display, "SelectOrientationVectors", 0) for display in displays]
    print(sizes, vectors)
    assert len(sizes["before"]) == len(sizes["after"]) == 5  # the file and the outputs, of which that of guides stays empty
    of_nothing = max(sizes["before"], key=sizes["before"].count)  # of four of five displays; by release
    of_data = [float(size) for size in sizes["after"] if size != of_nothing]
    assert len(of_data) == 4 and np.allclose(of_data, 0.2, rtol=0.05)  # a tenth of the diameter
    assert sum(np.array(sizes["before"]) != sizes["after"]) == 3
    assert "Direction0" in vectors["after"] and "Direction0" not in vectors["before"]
    assert number_of_blue(pixels(result)) > 5000 and number_of_red(pixels(result)) > 50


def value_of(proxy, name, element):
    values = proxy.find(f"Property[@name='{name}']").findall("Element")
    return values[element].get("value")


def check_points_placed(result):
    """Both points lie on the sphere that the window shows, apart from each other."""
    check(result)
    points = vtk_to_numpy(read(former(result, "line")).GetPoints().GetData())
    assert len(points) == 2, points
    assert np.allclose(np.linalg.norm(points, axis=1), 1, atol=0.02), points
    assert np.linalg.norm(points[1] - points[0]) > 0.2, points


def check_menu(result):
    """Directional Field has the first button of the toolbar and the first entry of the menu, with its icon's red dot."""
    check(result)
    check(former(result, "field"))
    closed, opened = (is_red(pixels(former(result, what))) for what in ("closed", "open"))
    assert 8 < (opened & ~closed).sum() < 60, (opened & ~closed).sum()


def check_directions(field, name):
    """Unit vectors on all cells."""
    lengths = np.linalg.norm(vtk_to_numpy(field.GetCellData().GetArray("Direction0")), axis=1)
    assert len(lengths) and np.allclose(lengths, 1), name
    assert field.GetFieldData().GetArray("Converged").GetValue(0) == 1, name


def read_any(path):
    reader = vtkGenericDataObjectReader()
    reader.SetFileName(str(path))
    reader.Update()
    return reader.GetOutput()


def check_sources(result):
    for shape, _ in SHAPES:
        check_directions(read_any(former(result, shape)), shape)
    check_directions(read(result), "sphere")


def check_failed_strict(result):
    """Strict said why, and how to go on; the field is on the plate and its stiffener."""
    log = result.with_suffix(".log").read_text()
    assert "switch Strict off" in log and "3 triangles" in log, log
    field = read(result)
    check_directions(field, "plate")
    assert field.GetNumberOfCells() == any_surfaces.plate_with_stiffener().GetNumberOfCells()
    assert "more than two sheets" in field.GetFieldData().GetAbstractArray("SurfacePreparation").GetValue(0)


def check_without_field(result):
    """Each of the three filters says once what to choose, and the sphere stays in sight."""
    log = result.with_suffix(".log").read_text()
    assert log.count("choose another array of vectors") == 2 and log.count("there is no flow to decompose") == 1, log
    assert log.count("ERR|") == 3, log
    for path in (former(result), result):
        assert read(path).GetNumberOfCells() == bare_sphere().GetNumberOfCells(), path
    assert shows_surface(pixels(result))


def check_grids(result):
    for name in FILES:
        if not name.endswith(COMPOSITE):
            check_directions(read_any(former(result, name)), name)
    reader = vtkXMLMultiBlockDataReader()
    reader.SetFileName(str(former(result, "field-blocks", ".vtm")))
    reader.Update()
    blocks = reader.GetOutput()
    assert blocks.GetNumberOfBlocks() == 2
    for k in range(2):
        check_directions(blocks.GetBlock(k), f"block {k}")
    reader = vtkXMLPartitionedDataSetCollectionReader()
    reader.SetFileName(str(former(result, "field-parts", ".vtpc")))
    reader.Update()
    parts = reader.GetOutput()
    for k, cells in ((0, any_surfaces.sphere().GetNumberOfCells()), (2, any_surfaces.plate_with_stiffener().GetNumberOfCells())):
        check_directions(parts.GetPartition(k, 0), f"part {k}")
        assert parts.GetPartition(k, 0).GetNumberOfCells() == cells
    check_directions(read(result), "sphere")


TESTS = {"SourcesInTheWindow": (write_sphere, check_sources),
         "GridsInTheWindow": (write_files, check_grids),
         "PointsPlacedInTheWindow": (write_sphere, check_points_placed),
         "MenuInTheWindow": (write_sphere, check_menu),
         "FieldInTheWindow": (write_sphere, check),
         "GuideInTheWindow": (write_guide, check_guide),
         "NothingSaidInTheWindow": (write_sphere, check_nothing_said),
         "FeaturesInTheWindow": (write_ellipsoid, check_features),
         "GuideMovedInTheWindow": (write_sphere, check_guide_moved),
         "FailedStrictInTheWindow": (write_plate_with_stiffener, check_failed_strict),
         "FailedWithoutFieldInTheWindow": (write_bare_sphere, check_without_field),
         "FailedFirstInTheWindow": (write_zero_directions, check_failed_first),
         "FiltersInTheWindow": (write_sphere, check_filters),
         "StateInTheWindow": (write_sphere, check_state),
         "FlowInTheWindow": (write_flow, check_flow),
         "TransportInTheWindow": (write_sphere, check_transport),
         "ConvergenceInTheWindow": (write_large_sphere, check_convergence)}


def main():
    paraview, folder, name = sys.argv[1], pathlib.Path(sys.argv[2]).resolve(), sys.argv[3]
    folder.mkdir(parents=True, exist_ok=True)
    data, result = folder / f"{name}.vtp", folder / f"{name}.vtk"
    for old in folder.glob(f"{name}*"):
        shutil.rmtree(old) if old.is_dir() else old.unlink()
    write_data, check_result = TESTS[name]
    write_data(data)
    play(paraview, data, result, folder, fails=name.startswith("Failed"))
    check_result(result)


if __name__ == "__main__":
    main()
