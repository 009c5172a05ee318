"""A smooth cross field on a surface, through ParaView's Python:  pvbatch demo.py SURFACE

Finds the smoothest crosses that follow the principal directions of a PLY, OBJ, STL, VTK or VTP file, and leaves
demo.vtp, the surface with the field, and demo.png, a picture of its lines and singularities, in the current folder.
"""

import sys

from paraview.simple import *

try:
    SurfaceNormals
except NameError:  # until ParaView 5.12
    SurfaceNormals = GenerateSurfaceNormals

GREEN, RED, BLUE, IVORY = [0.12, 0.53, 0.3], [0.83, 0.15, 0.17], [0.16, 0.33, 0.52], [1, 0.97, 0.92]


def open_surface(path):
    """Triangles without doubled points."""
    return Clean(Input=Triangulate(Input=ExtractSurface(Input=OpenDataFile(path))))


def show(source, view, colour="", **properties):
    """In one colour, or in those of an array of points."""
    display = Show(source, view, **properties)
    ColorBy(display, ("POINTS", colour if isinstance(colour, str) else ""))
    if not isinstance(colour, str):
        display.AmbientColor = display.DiffuseColor = colour


def show_singularities(field, view, radius=0.012):
    """Balls, red where the index is positive and green where it is negative."""
    singularities = FieldSingularities(Input=field, SphereRadius=radius)
    show(OutputPort(singularities, 3), view, "Index", Specular=0.4)
    GetColorTransferFunction("Index").RGBPoints = [-1, *GREEN, 0, *GREEN, 0, *RED, 1, *RED]
    return servermanager.Fetch(singularities)


def view_from(direction, size):
    return CreateRenderView(ViewSize=size, OrientationAxesVisibility=0, UseColorPaletteForBackground=0, Background=[1, 1, 1],
                            CameraParallelProjection=1, CameraPosition=direction, CameraViewUp=[0, 1, 0])


def main(path):
    field = HarmonicFieldSolver(Input=open_surface(path), NumberOfDirections=4, CurvatureWeight=0.3)
    SaveData("demo.vtp", field, DataMode="Binary")  # see README, "Files"
    bounds = field.GetDataInformation().GetBounds()
    size = sum((bounds[k + 1] - bounds[k]) ** 2 for k in (0, 2, 4)) ** 0.5
    view = view_from([0.35, 0.3, 1], [1200, 1050])
    show(SurfaceNormals(Input=field, FeatureAngle=60), view, IVORY, Ambient=0.12, Specular=0.1)
    show(Tube(Input=FieldLines(Input=field, SeparatingDistance=0.016), Radius=0.0009 * size), view, BLUE)
    singularities = show_singularities(field, view, 0.008)
    ResetCamera(view)
    GetActiveCamera().Zoom(1.37)
    SaveScreenshot("demo.png", view, ImageResolution=[2400, 2100])
    indices = singularities.GetFieldData().GetArray("SumOfIndices").GetValue(0)
    print(f"wrote demo.vtp and demo.png; the indices of {singularities.GetNumberOfPoints()} singularities sum to {indices:g}")


if __name__ == "__main__":
    main(sys.argv[1]) if len(sys.argv) == 2 else sys.exit(__doc__)
