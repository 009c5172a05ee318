"""What the scenes of the gallery share: how surfaces are opened, lit and coloured, and how fields are drawn on them."""

import os
import tempfile

import numpy as np
from paraview.simple import *
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkImageData
from vtkmodules.vtkCommonTransforms import vtkTransform
from vtkmodules.vtkFiltersGeneral import vtkTransformPolyDataFilter
from vtkmodules.vtkIOImage import vtkPNGWriter
from vtkmodules.vtkRenderingFreeType import vtkVectorText

try:
    SurfaceNormals
except NameError:  # until ParaView 5.12
    SurfaceNormals = GenerateSurfaceNormals

RED, BLUE = [0.83, 0.15, 0.17], [0.1, 0.26, 0.45]
IVORY, GOLD = [1, 0.97, 0.92], [0.98, 0.68, 0.08]


def open_surface(path):
    """Triangles without doubled points."""
    return Clean(Input=Triangulate(Input=ExtractSurface(Input=OpenDataFile(path))))


def size_of(data):
    """The diagonal of the box around it."""
    data.UpdatePipeline()
    bounds = data.GetDataInformation().GetBounds()
    return sum((bounds[k + 1] - bounds[k]) ** 2 for k in (0, 2, 4)) ** 0.5


def view_from(direction, size, up=(0, 1, 0)):
    """On white paper."""
    return CreateRenderView(ViewSize=size, OrientationAxesVisibility=0, UseColorPaletteForBackground=0, Background=[1, 1, 1],
                            CameraParallelProjection=1, CameraPosition=direction, CameraViewUp=up)


def show(source, view, colour="", **properties):
    """In one colour, or in those of an array of points."""
    if "Position" in properties and GetParaViewVersion() >= (5, 13):
        properties["Translation"] = properties.pop("Position")  # its new name
    display = Show(source, view, **{"Representation": "Surface", **properties})
    ColorBy(display, ("POINTS", colour if isinstance(colour, str) else ""))
    if not isinstance(colour, str):
        display.AmbientColor = display.DiffuseColor = colour
    return display


def show_surface(surface, view, colour=IVORY, **properties):
    """Smooth but for sharp edges."""
    look = dict(Ambient=0.35, Diffuse=0.72, Specular=0.06, SpecularPower=20)
    return show(SurfaceNormals(Input=surface, FeatureAngle=50), view, colour, **{**look, **properties})


def colour_by_size(name, largest):
    """An array from 0 (blue) to its largest value (red)."""
    GetColorTransferFunction(name).RGBPoints = [0, 0.62, 0.74, 0.9, 0.5 * largest, 1, 0.97, 0.88, largest, 0.93, 0.55, 0.42]


def lines_along(field, distance, width=0.0011, shortest=8, heads=1):
    """Evenly spaced lines as tubes of one width, without short ones. Distance and width are relative to the size of the field's surface,
    and the shortest line to the distance."""
    lines = FieldLines(Input=field, SeparatingDistance=distance, MinimumLength=shortest, Lift=0.7 * width, ArrowHeads=heads)
    return Tube(Input=lines, Radius=width * size_of(field), NumberofSides=8)


def glyphs_on(data, **properties):
    """Glyphs that stand a little off the surface: these pictures show them as surfaces, not as Ink."""
    return FieldGlyphs(Input=data, Lift=0.001, **properties)


def show_lines(field, view, distance, colour=BLUE, shortest=8, heads=1, **properties):
    return show(lines_along(field, distance, shortest=shortest, heads=heads), view, colour, **properties)


def along(line):
    """A line with the array Way, its vector from end to end."""
    way = " + ".join(f"({b} - {a}) * {axis}" for a, b, axis in zip(line.Point1, line.Point2, ("iHat", "jHat", "kHat")))
    return Calculator(Input=line, ResultArrayName="Way", Function=way)


def show_arrow(line, view, length, **properties):
    """A golden arrow from the first point of a line, along it."""
    arrow = Glyph(Input=along(line), GlyphType="Arrow", OrientationArray=["POINTS", "Way"],
                  ScaleArray=["POINTS", "No scale array"], ScaleFactor=length)
    arrow.GlyphMode, arrow.Stride = "Every Nth Point", 1000
    arrow.GlyphType.ShaftRadius, arrow.GlyphType.TipRadius, arrow.GlyphType.TipLength = 0.06, 0.16, 0.4
    arrow.GlyphType.ShaftResolution = arrow.GlyphType.TipResolution = 24
    return show(arrow, view, GOLD, Specular=0.4, **properties)


def show_singularities(field, view, radius=0.01, **properties):
    """Balls, red where the index is positive and green where it is negative."""
    singularities = FieldSingularities(Input=field, SphereRadius=radius)
    show(OutputPort(singularities, 3), view, Representation="Sign Colors", Specular=0.4, **properties)
    return servermanager.Fetch(singularities)


def show_text(text, place, view, height, colour=(0.1, 0.1, 0.14)):
    """Letters around a place, towards the viewer of a parallel view."""
    letters, transform, placed = vtkVectorText(), vtkTransform(), vtkTransformPolyDataFilter()
    letters.SetText(text)
    letters.Update()
    left, right, below, above, _, _ = letters.GetOutput().GetBounds()
    towards, up = (np.array(v) / np.linalg.norm(v) for v in (view.CameraPosition, view.CameraViewUp))
    across = np.cross(up, towards) / np.linalg.norm(np.cross(up, towards))
    matrix = np.eye(4)
    matrix[:3, :3], matrix[:3, 3] = height * np.stack([across, np.cross(towards, across), towards], 1), place
    transform.SetMatrix(matrix.ravel())
    transform.Translate(-(left + right) / 2, -(below + above) / 2, 0)
    placed.SetTransform(transform)
    placed.SetInputConnection(letters.GetOutputPort())
    placed.Update()
    producer = TrivialProducer()
    producer.GetClientSideObject().SetOutput(placed.GetOutput())
    return show(producer, view, list(colour), Ambient=1, Diffuse=0)


def show_quads(quads, view, width=0.0011, **properties):
    """Quads with their edges as tubes, and a ball at each irregular vertex: red with fewer than four quads, green with more."""
    show_surface(quads, view, **properties)
    show(Tube(Input=ExtractEdges(Input=quads), Radius=width * size_of(quads), NumberofSides=8), view, BLUE, **properties)
    show(OutputPort(quads, 2), view, Representation="Sign Colors", Specular=0.4, **properties)


def texture_of(colours):
    """A texture of rows of pixels, the lowest first: height x width x 3 numbers from 0 to 255."""
    height, width = colours.shape[:2]
    image = vtkImageData()
    image.SetDimensions(width, height, 1)
    image.GetPointData().SetScalars(numpy_to_vtk(np.reshape(colours, (-1, 3)).astype("u1"), deep=True))
    writer = vtkPNGWriter()
    writer.SetInputData(image)
    with tempfile.TemporaryDirectory() as folder:
        writer.SetFileName(os.path.join(folder, "texture.png"))
        writer.Write()
        texture = CreateTexture(writer.GetFileName())
        texture.FileName = writer.GetFileName()  # ParaView 5.13 has not read it before
        return texture


def fill(view, margin=0.01):
    """What a parallel view shows reaches from edge to edge: it gets the view's width, and the view its height."""
    picture = view.CaptureWindow(1)
    across, high, _ = picture.GetDimensions()
    colours = vtk_to_numpy(picture.GetPointData().GetScalars()).reshape(high, across, -1)
    rows, columns = np.nonzero((colours[:, :, :3] < 250).any(axis=2))
    towards, up = (np.array(v) / np.linalg.norm(v) for v in (np.subtract(view.CameraPosition, view.CameraFocalPoint), view.CameraViewUp))
    right = np.cross(up, towards) / np.linalg.norm(np.cross(up, towards))
    pixel = 2 * view.CameraParallelScale / high
    shift = pixel * (((columns.min() + columns.max() + 1 - across) / 2) * right
                     + ((rows.min() + rows.max() + 1 - high) / 2) * np.cross(towards, right))
    view.CameraFocalPoint, view.CameraPosition = (np.array(v) + shift for v in (view.CameraFocalPoint, view.CameraPosition))
    width, height = (np.ptp(x) + 1 + 2 * margin * across for x in (columns, rows))
    view.CameraParallelScale = pixel * height / 2
    view.ViewSize = [view.ViewSize[0], round(view.ViewSize[0] * height / width)]


def save(view, name, zoom=1.3):
    """As a picture that is larger than 2400 pixels, to be shrunk. Without a zoom, what it shows fills it."""
    ResetCamera(view)
    GetActiveCamera().Zoom(zoom or 1)
    if not zoom:
        fill(view)
    factor = max(2, -(-2700 // view.ViewSize[0]))
    SaveScreenshot(f"{name}.png", view, ImageResolution=[factor * length for length in view.ViewSize])
