#!/usr/bin/env python3
"""Plays in ParaView's window what a person does, action by action, and counts: a click, a menu choice or a typed value is one.

    test_actions.py PARAVIEW OUTPUT-FOLDER NAME

plays NAME (those of TESTS below) and leaves what it saves on the way in the folder. Needs a display and xdotool; ParaView has to
find the plugin by itself.
"""

import os
import pathlib
import subprocess
import sys
import time

import numpy as np
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkFiltersCore import vtkTriangleFilter
from vtkmodules.vtkFiltersSources import vtkDiskSource, vtkSphereSource
from vtkmodules.vtkIOImage import vtkPNGWriter

from test_window import focus, is_5_11, number_of_red, pixels, read, take_picture, toolbar, write, write_bare_sphere, write_flow, write_sphere, xdotool

MAIN = "pqClientMainWindow"
PANEL = (f"{MAIN}/propertiesDock/propertiesPanel/scrollArea/qt_scrollarea_viewport/scrollAreaWidgetContents/PropertiesFrame/"
         "ProxyPanel")


class Window:
    """ParaView with a file that is open, but not yet applied: the first action."""

    def __init__(self, paraview, folder, name, data):
        self.paraview, self.folder, self.name, self.data = paraview, folder, name, data
        self.process, self.log, self.actions = None, folder / f"{name}.log", 1

    def __enter__(self):
        return self

    def __exit__(self, *_):
        subprocess.run(["import", "-window", "root", self.folder / f"{self.name}.png"], check=False)
        if self.process:
            self.process.kill()
            self.process.wait()
        print(self.log.read_text())

    # Actions -------------------------------------------------------------------------------------

    def apply(self):
        return self.event(f"{MAIN}/propertiesDock/propertiesPanel/Accept", "activate")

    def choose_filter(self, name):
        # ParaView 5.13 fills the menu when it is opened.
        return self.opened(f"{MAIN}/menubar", "menuFilters") + self.event(
            f"{MAIN}/menubar/menuFilters/Directional Fields", "activate", name)

    def choose_source(self, name):
        return self.event(f"{MAIN}/menubar/menuSources/pqProxyGroupMenuManager0/{name}", "activate")

    def choose_other_filter(self, name):
        """One that is in no category of the Filters menu."""
        return self.opened(f"{MAIN}/menubar", "menuFilters") + self.event(
            f"{MAIN}/menubar/menuFilters/Alphabetical", "activate", name)

    def look_at(self, item):
        """What is saved next; nothing that a person would have to do."""
        return self.opened(f"{MAIN}/pipelineBrowserDock/pipelineBrowser", item + "|0", "currentChanged")

    def select(self, item):
        return self.event(f"{MAIN}/pipelineBrowserDock/pipelineBrowser", "currentChanged", item + "|0")

    def set(self, widget, value):
        return self.event(f"{PANEL}/{widget}", "set_string", value)

    def check(self, widget, on):
        return self.event(f"{PANEL}/{widget}", "set_boolean", "true" if on else "false")

    def set_display(self, widget, value, command="set_string"):
        return self.event(f"{PANEL.replace('PropertiesFrame', 'DisplayFrame')}/{widget}", command, value)

    def show_advanced(self):
        """The gear beside the search box."""
        return self.event(f"{MAIN}/propertiesDock/propertiesPanel/SearchBox/AdvancedButton", "set_boolean", "true")

    def colour_by(self, name):
        return self.event(f"{MAIN}/variableToolbar/displayColor/Variables", "set_string", name)

    def click_eye(self, row):
        """The eye of a row of the pipeline, the server's being 0."""
        self.actions += 1
        xdotool("mousemove", 12, 174 + 22 * row)
        xdotool("click", 1)

    def press(self, key, place):
        """A key, with the mouse over a place of the view."""
        self.actions += 1
        xdotool("mousemove", *place)
        xdotool("key", key)

    def picture(self, name):
        """The colours of the screen, a row each."""
        take_picture(self.folder / f"{self.name}-{name}.png")
        return pixels(self.folder / f"{self.name}-{name}.png")

    def save(self, file):
        """The selected output, as one action: the menu and the dialogs belong together."""
        return (self.event(f"{MAIN}/menubar/menu_File/actionFileSaveData", "activate")
                + self.opened(f"{MAIN}/FileSaveDialog", self.folder / file, "filesSelected")
                + self.opened(f"{MAIN}/WriterSettingsDialog/widget/OKButton", ""))

    def open(self, file):
        return (self.event(f"{MAIN}/menubar/menu_File/actionFileOpen", "activate")
                + self.opened(f"{MAIN}/FileOpenDialog", self.folder / file, "filesSelected"))

    # How they are played -------------------------------------------------------------------------

    def event(self, widget, command, arguments=""):
        self.actions += 1
        return self.opened(widget, arguments, command)

    @staticmethod
    def opened(widget, arguments, command="activate"):
        return f'<pqevent object="{widget}" command="{command}" arguments="{arguments}" />\n'

    def play(self, what, *events):
        """Plays events, after which the selected output is saved; returns it. The last event comes after that where it makes a
        source or a filter, which has no data yet."""
        path = self.folder / f"{self.name}-{what}.vtk"
        saved = self.saved_as(path)
        makes_one = "menuSources" in events[-1] or "menuFilters" in events[-1]
        ordered = [*events[:-1], saved, events[-1]] if makes_one else [*events, saved]
        script = path.with_suffix(".xml")
        script.write_text("<pqevents>\n" + "".join(ordered) + "</pqevents>\n")
        self.start(script) if self.process is None else self.play_test(script)
        self.wait_for(path)
        if makes_one:
            time.sleep(3)
            focus("ParaView")
        return read(path)

    def saved_as(self, path):
        """The menu choice File, Save Data..., with what stands in its dialogs."""
        return (self.opened(f"{MAIN}/menubar/menu_File/actionFileSaveData", "")
                + self.opened(f"{MAIN}/FileSaveDialog", path, "filesSelected")
                + self.opened(f"{MAIN}/WriterSettingsDialog/widget/OKButton", ""))

    def start(self, script):
        command = [self.paraview, "--disable-registry", f"--data={self.data}", f"--test-directory={self.folder}",
                   f"--test-script={script}"]
        with self.log.open("w") as output:
            self.process = subprocess.Popen(command, stdout=output, stderr=subprocess.STDOUT)

    def play_test(self, script):
        """The menu choice Tools, Play Test..., which is the seventh or eighth from below."""
        focus("ParaView")
        xdotool("key", "alt+t")
        xdotool("key", *["Up"] * (7 if is_5_11(self.paraview) else 8))
        xdotool("key", "Return")
        focus("Test")
        xdotool("type", script)
        xdotool("key", "Return")

    def wait_for(self, path):
        size, deadline = 0, time.monotonic() + 60
        while time.monotonic() < deadline and self.process.poll() is None and "critical:" not in self.log.read_text():
            time.sleep(0.5)
            former, size = size, path.stat().st_size if path.exists() else 0
            if size == former > 0:
                assert "ERR|" not in self.log.read_text(), self.log.read_text()
                return
        raise SystemExit(f"{path} was not written:\n{self.log.read_text()}")


def prescribed(field):
    return vtk_to_numpy(field.GetPointData().GetArray("Prescribed"))


def number_of_golden(image):
    return ((image[:, 0] > 180) & (image[:, 1] > 0.5 * image[:, 0]) & (image[:, 2] < 0.4 * image[:, 0])).sum()


def taken(field):
    return field.GetFieldData().GetArray("GuidesTaken").GetValue(0)


def draw_strokes(window):
    """A field at first sight, a stroke on it, a second one beside it, and the weight of one of them."""
    field = window.play("field", window.apply(), window.choose_filter("DirectionalField"), window.apply(),
                        window.choose_source("PolyLineSource"))
    assert window.actions - 1 == 4, window.actions  # the last one is the stroke's
    assert abs(vtk_to_numpy(field.GetCellData().GetArray("SingularityIndex")).sum() - 2) < 1e-9
    window.press(1, (680, 420))
    window.press(2, (780, 500))
    first = window.play("first", window.select("/0/0/0"), window.set("Guides/1QComboBox0", "PolyLineSource1"),
                        window.apply(), window.choose_source("PolyLineSource"))
    assert window.actions - 1 == 10, window.actions
    assert taken(first) == 1 and (prescribed(first) > 0).sum() > 10
    before = window.actions - 1
    window.press(1, (680, 520))
    window.press(2, (760, 560))
    second = window.play("second", window.select("/0/0/0"), window.set("SecondGuide/1QComboBox0", "PolyLineSource2"),
                         window.apply())
    assert window.actions - before == 6, window.actions
    assert taken(second) == 2 and (prescribed(second) > 0).sum() > (prescribed(first) > 0).sum() + 10
    before = window.actions
    third = window.play("weight", window.set("GuideWeights/Guide Weights", "1 0.25"), window.apply())
    assert window.actions - before == 2
    ratios = prescribed(third)[prescribed(second) > 0] / prescribed(second)[prescribed(second) > 0]
    assert set(np.round(ratios[(ratios < 0.26) | (ratios > 0.99)], 6)) == {0.25, 1}, ratios
    path = window.play("path", window.look_at("/0/2/3"))
    radii = np.linalg.norm(vtk_to_numpy(path.GetPoints().GetData()), axis=1)
    assert path.GetNumberOfLines() == 2 and (radii > 0.99).all() and (radii < 1.001).all(), radii
    assert number_of_golden(window.picture("golden")) > 100

    # Without the first one, the second one keeps its weight, in a list that still shows.
    alone = window.play("alone", window.select("/0/2"), window.set("Guides/1QComboBox0", "(none)"), window.apply())
    assert taken(alone) == 1
    of_second = prescribed(second) > 1.001 * prescribed(first)
    assert np.allclose(prescribed(alone)[of_second & (prescribed(first) == 0)],
                       0.25 * prescribed(second)[of_second & (prescribed(first) == 0)])
    # Chosen in the first list, it is no longer in the second one, and keeps its weight, its arrow in the pipeline (the field is below none
    # of its two inputs) and the selection.
    moved = window.play("moved", window.set("Guides/1QComboBox0", "PolyLineSource2"), window.apply())
    assert taken(moved) == 1 and "more than once" not in window.log.read_text()
    assert np.allclose(prescribed(moved), prescribed(alone))
    assert taken(window.play("arrow", window.look_at("/0/2"), window.look_at("/0/3"))) == 1
    bare = window.play("bare", window.set("Guides/1QComboBox0", "(none)"), window.apply())
    assert not bare.GetFieldData().HasArray("GuidesTaken")


def export_field(window):
    """A field as files for remeshers, by their extensions alone; then a stroke on it."""
    files = {suffix: window.folder / f"{window.name}-field.{suffix}" for suffix in ("rosy", "rawfield", "sharp")}
    field = window.play("field", window.apply(), window.choose_filter("DirectionalField"), window.apply(),
                        *map(window.saved_as, files.values()), window.choose_source("PolyLineSource"))
    triangles = field.GetNumberOfPolys()
    first = vtk_to_numpy(field.GetCellData().GetArray("Direction0"))
    rosy = files["rosy"].read_text().split()
    assert [int(word) for word in rosy[:2]] == [triangles, 4]
    assert np.abs(np.array(rosy[2:], float).reshape(-1, 3) - first).max() < 1e-6
    raw = files["rawfield"].read_text().split()
    assert [int(word) for word in raw[:2]] == [4, triangles]
    assert np.abs(np.array(raw[2:], float).reshape(-1, 4, 3).sum(axis=1)).max() < 1e-6  # those of a cross cancel
    assert files["sharp"].read_text() == "0\n"  # of a sphere
    place_third_point(window)


def place_third_point(window):
    """A stroke of three points on the surface: both ends by keys, one inserted on the line by Ctrl and a click, and placed by P."""
    window.press(1, (640, 420))
    window.press(2, (820, 480))
    xdotool("mousemove", 730, 450)
    xdotool("keydown", "ctrl")
    xdotool("click", 1)
    xdotool("keyup", "ctrl")
    window.press("p", (700, 560))
    stroke = window.play("stroke", window.apply())
    points = vtk_to_numpy(stroke.GetPoints().GetData())
    assert len(points) == 3 and np.abs(np.linalg.norm(points, axis=1) - 1).max() < 0.01, points


def draw_flow(window):
    """Two arrows on the surface, and the flow that follows both: lines with heads. Drawing takes six actions, and the filter two. The
    other three select the surface again and choose each guide, since nothing is followed that was not chosen."""
    window.play("surface", window.apply(), window.choose_source("PolyLineSource"))
    before = window.actions - 1
    window.press(1, (680, 420))
    window.press(2, (780, 420))
    window.play("first", window.look_at("/0/0"), window.choose_source("PolyLineSource"))
    window.press(1, (780, 500))
    window.press(2, (680, 500))
    flow = window.play("flow", window.select("/0/0"), window.choose_other_filter("VectorField"),
                       window.set("Guides/1QComboBox0", "PolyLineSource1"),
                       window.set("SecondGuide/1QComboBox0", "PolyLineSource2"), window.apply(), window.look_at("/0/3/1"))
    assert window.actions - before == 11, window.actions - before
    sizes = [flow.GetCell(line).GetNumberOfPoints() for line in range(flow.GetNumberOfCells())]
    assert sizes.count(3) > 20, sizes  # heads


def draw_after_the_filter(window):
    """As draw_flow, but the filter is made before its guides, none of them applied."""
    window.play("surface", window.apply(), window.choose_other_filter("VectorField"))
    window.play("filter", window.look_at("/0/0"), window.choose_source("PolyLineSource"))
    window.press(1, (680, 420))
    window.press(2, (780, 420))
    window.play("first", window.look_at("/0/0"), window.choose_source("PolyLineSource"))
    window.press(1, (780, 500))
    window.press(2, (680, 500))
    flow = window.play("flow", window.select("/0/0/0"), window.set("Guides/1QComboBox0", "PolyLineSource1"),
                       window.set("SecondGuide/1QComboBox0", "PolyLineSource2"), window.apply())
    assert taken(flow) == 2


def place_singularities(window):
    """Two points on the surface, and vectors that are singular there and nowhere else: four actions to a field, and six more."""
    window.play("surface", window.apply(), window.choose_filter("DirectionalField"), window.set("NumberOfDirections/ComboBox", "Vectors"),
                window.apply(), window.choose_source("PolyLineSource"))
    before = window.actions - 1
    window.press(1, (680, 420))
    window.press(2, (780, 500))
    field = window.play("field", window.select("/0/0/0"), window.set("PrescribedSingularities/1QComboBox0", "PolyLineSource1"), window.apply())
    assert window.actions - before == 6, window.actions - before
    line = window.play("line", window.look_at("/0/1"))
    indices = vtk_to_numpy(field.GetPointData().GetArray("SingularityIndex"))
    assert list(indices[indices != 0]) == [1, 1], indices[indices != 0]
    places = vtk_to_numpy(field.GetPoints().GetData())[indices != 0]
    ends = vtk_to_numpy(line.GetPoints().GetData())
    for end in ends:
        assert np.linalg.norm(places - end, axis=1).min() < 0.1, (places, ends)


def number_of_ink(image):
    return (np.abs(image.astype(int) - (26, 51, 153)).max(axis=1) < 6).sum()


def lay_a_decal(window):
    """The recipe of the page Parallel Transport: an image around the point in front, and neither arrows nor circles."""
    image = window.folder / f"{window.name}-image.png"
    colours = np.full((64, 64, 3), 255, "u1")
    colours[8:56, 8:56] = (255, 0, 0)
    write_picture(image, colours)
    window.play("map", window.apply(), window.choose_filter("ParallelTransport"), window.set("TextureSize/DoubleLineEdit0", "1"), window.apply(),
                window.look_at("/0/0/0/0"))
    assert number_of_ink(window.picture("map")) > 1000
    for row in (4, 5):
        window.click_eye(row)
    window.play("decal", window.select("/0/0/0/0"), window.colour_by("Solid Color"), window.show_advanced(),
                window.set_display("Texture/1pqTextureComboBox0", "Load ..."),
                window.set_display("Texture/1pqTextureComboBox0/LoadTextureDialog", image, "filesSelected"),
                window.set_display("RepeatTextures/CheckBox", "false", "set_boolean"))
    picture = window.picture("decal").astype(int)
    assert number_of_ink(picture) < 20
    red = ((picture[:, 0] > 100) & (picture[:, 1:].max(axis=1) < 40)).sum()
    assert 5000 < red < 60000, red


def hatch(window):
    """The recipe of the page Directional Fields, but for the file in the end: dark lines, without balls, on a surface in one tone."""
    window.play("field", window.apply(), window.choose_filter("DirectionalField"), window.check("FollowCurvature/CheckBox", True),
                window.show_advanced(), window.set("CurvatureWeight/DoubleLineEdit0", "0.3"),
                window.set("LineDistance/DoubleRangeWidget/DoubleLineEdit", "0.009"), window.apply(), window.look_at("/0/0/0/0"))
    with_balls = number_of_red(window.picture("with-balls"))
    window.click_eye(5)
    paper = [window.set_display(f"{name}/DoubleRangeWidget/DoubleLineEdit", value) for name, value in (("Ambient", "1"), ("Diffuse", "0"))]
    lines = window.play("lines", window.select("/0/0/0/0"), window.colour_by("Solid Color"), *paper, window.look_at("/0/0/0/1"))
    assert set(vtk_to_numpy(lines.GetCellData().GetArray("Branch"))) == {0, 1} and lines.GetNumberOfLines() > 100
    picture = window.picture("hatching").astype(int)
    assert number_of_ink(picture) > 5000
    assert number_of_red(picture) < with_balls - 50
    tones, counts = np.unique(picture[(np.ptp(picture, axis=1) < 40) & (picture.min(axis=1) > 180)], axis=0, return_counts=True)
    assert counts.max() > 0.3 * counts.sum(), (tones[counts.argmax()], counts.max(), counts.sum())


def write_picture(path, colours):
    """Rows from below."""
    image, writer = vtkImageData(), vtkPNGWriter()
    image.SetDimensions(colours.shape[1], colours.shape[0], 1)
    image.GetPointData().SetScalars(numpy_to_vtk(colours.reshape(-1, 3), deep=True))
    writer.SetInputData(image)
    writer.SetFileName(str(path))
    writer.Write()


def write_annulus(path):
    """Between the radii 1/2 and 1, turning about the middle: 3/8 flow through each radius."""
    source, triangles = vtkDiskSource(), vtkTriangleFilter()
    source.SetInnerRadius(0.5)
    source.SetOuterRadius(1)
    source.SetRadialResolution(20)
    source.SetCircumferentialResolution(80)
    triangles.SetInputConnection(source.GetOutputPort())
    triangles.Update()
    x, y, z = vtk_to_numpy(triangles.GetOutput().GetPoints().GetData()).T
    flow = numpy_to_vtk(np.stack([-y, x, z], axis=1), deep=True)
    flow.SetName("Flow")
    triangles.GetOutput().GetPointData().SetVectors(flow)
    write(path, triangles.GetOutput())


def choose_reference(window):
    """Transports against one boundary, then against the other, by two actions."""
    def transports(what, *events):
        boundaries = window.play(what, *events, window.look_at("/0/0/0/2"))
        return vtk_to_numpy(boundaries.GetCellData().GetArray("BoundaryTransport"))

    first = transports("first", window.apply(), window.choose_filter("HodgeDecomposition"), window.apply())
    former = int(np.abs(first).argmin())
    second = transports("second", window.select("/0/0/0"), window.set("ReferenceBoundary/LineEdit0", str(1 - former)), window.apply())
    assert first[former] == 0 and second[1 - former] == 0, (first, second)
    assert np.allclose(second[former], -first[1 - former]) and abs(abs(second[former]) - 0.375) < 0.02, (first, second)


def draw_fibres(window):
    """Measured vectors, the only ones of a file, are followed by four actions."""
    field = window.play("fibres", window.apply(), window.choose_other_filter("FibreOrientation"), window.apply())
    assert window.actions == 4, window.actions
    assert field.GetFieldData().GetArray("NumberOfDirections").GetValue(0) == 2
    assert (prescribed(field) > 0).mean() > 0.9
    assert "the field follows array 'Flow'" in window.log.read_text()


def write_eigenvectors(path):
    """A sphere with normals, an axis whose sign is random, and a tensor; none is active."""
    source = vtkSphereSource()
    source.SetThetaResolution(60)
    source.SetPhiResolution(60)
    source.Update()
    sphere = source.GetOutput()
    points = vtk_to_numpy(sphere.GetPoints().GetData()).astype(float)
    signs = np.random.default_rng(3).choice((-1.0, 1.0), (len(points), 1))
    for name, values in (("Axis", np.cross((0, 0, 1.0), points) * signs), ("Stress", np.tile((1.0, 0, 0, 0, 0, 0), (len(points), 1)))):
        array = numpy_to_vtk(values, deep=True)
        array.SetName(name)
        sphere.GetPointData().AddArray(array)
    write(path, sphere)


def draw_eigenvectors(window):
    """Lines along axes without a sign: a message says what to choose, and then they are as long as circles. Tensors have lines at once."""
    scraps = window.play("scraps", window.apply(), window.choose_filter("FieldLines"), window.apply())
    assert window.actions == 4, window.actions
    assert "'Axis' seems to have no sign" in window.log.read_text() and "choose 2 as Number Of Directions" in window.log.read_text()
    circles = window.play("circles", window.set("NumberOfDirections/IntRangeWidget/LineEdit", "2"), window.apply())
    assert circles.GetNumberOfCells() < scraps.GetNumberOfCells() / 5, (circles.GetNumberOfCells(), scraps.GetNumberOfCells())
    stress = window.play("stress", window.set("NumberOfDirections/IntRangeWidget/LineEdit", "0"), window.set(
        "Directions/ComboBox", "Stress"), window.apply())
    ends = vtk_to_numpy(stress.GetPoints().GetData())[vtk_to_numpy(stress.GetLines().GetConnectivityArray())]
    assert stress.GetNumberOfCells() > 20 and np.ptp(ends[:, 0]) > 0.9  # from one end of the x-axis to the other
    assert window.log.read_text().count("no sign") == 1


def quads_of(mesh):
    """The points of each cell, all of which have four; every directed edge is there once, and so is its opposite."""
    assert mesh.GetPolys().IsHomogeneous() == 4 and mesh.GetNumberOfCells() == mesh.GetPolys().GetNumberOfCells()
    quads = vtk_to_numpy(mesh.GetPolys().GetConnectivityArray()).reshape(-1, 4)
    ends = np.stack([quads, np.roll(quads, -1, axis=1)], axis=2).reshape(-1, 2)
    directed = set(map(tuple, ends))
    assert len(directed) == len(ends) and directed == {(b, a) for a, b in directed}
    assert mesh.GetNumberOfPoints() - len(ends) // 2 + len(quads) == 2
    return quads


def make_quads(window):
    """Quads of a bare sphere by four actions, another number by two more. A file of them opens as the same quads."""
    quads = quads_of(window.play("quads", window.apply(), window.choose_filter("QuadMesh"), window.apply()))
    assert window.actions == 4, window.actions
    assert abs(len(quads) - 4000) < 400, len(quads)
    fewer = window.play("fewer", window.set("NumberOfQuads/IntRangeWidget/LineEdit", "600"), window.apply())
    assert window.actions == 6, window.actions
    assert abs(len(quads_of(fewer)) - 600) < 60, len(quads_of(fewer))
    irregular = (vtk_to_numpy(fewer.GetPointData().GetArray("Irregular")) != 0).sum()
    assert f"QuadMesh1: {len(quads_of(fewer))} quads, {irregular} irregular vertices, 0 inverted" in window.log.read_text()
    balls = window.play("balls", window.look_at("/0/0/0/2"))  # which are shown, half as large as an edge is long
    assert balls.GetNumberOfPolys() > 0
    picture = window.picture("balls").astype(int)
    assert ((picture[:, 0] > 120) & (picture[:, 1] < 80) & (picture[:, 2] < 80)).sum() > 100  # red ones
    window.play("quads again", window.select("/0/0/0"))
    hide_the_field(window)
    file = f"{window.name}.obj"
    again = window.play("again", window.save(file), window.open(file), window.apply())
    assert np.array_equal(quads_of(again), quads_of(fewer))
    assert np.abs(vtk_to_numpy(again.GetPoints().GetData()) - vtk_to_numpy(fewer.GetPoints().GetData())).max() < 1e-5


def hide_the_field(window):
    """Where quads come from a field, its lines give way to them: nothing has the colour of ink."""
    window.play("field", window.select("/0/0"), window.choose_filter("DirectionalField"), window.apply())
    assert number_of_ink(window.picture("field")) > 1000
    window.play("of field", window.choose_filter("QuadMesh"), window.apply())
    assert number_of_ink(window.picture("of-field")) < 20
    window.play("former quads", window.select("/0/0/0"))


TESTS = {"Decal": (write_bare_sphere, lay_a_decal), "Hatching": (write_bare_sphere, hatch), "Reference": (write_annulus, choose_reference), "Quads": (write_bare_sphere, make_quads), "Fibres": (write_flow, draw_fibres),
         "Export": (write_sphere, export_field), "Eigenvectors": (write_eigenvectors, draw_eigenvectors),
         "Strokes": (write_sphere, draw_strokes), "Flow": (write_sphere, draw_flow),
         "Singularities": (write_bare_sphere, place_singularities), "FilterFirst": (write_sphere, draw_after_the_filter)}


def main():
    paraview, folder, name = sys.argv[1], pathlib.Path(sys.argv[2]).resolve(), sys.argv[3]
    folder.mkdir(parents=True, exist_ok=True)
    for old in folder.glob(f"{name}*"):
        old.unlink()
    write_data, play = TESTS[name]
    data = folder / f"{name}.vtp"
    write_data(data)
    with Window(paraview, folder, name, data) as window:
        play(window)


if __name__ == "__main__":
    main()
