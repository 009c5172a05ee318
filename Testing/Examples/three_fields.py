"""The three discretisations beside each other:  pvbatch three_fields.py Data/double_torus.vtp

Solves for a cross field (power field), a face field and a 1-form that follow the same three arrows, and leaves
power_field.png, face_field.png and one_form.png in the current folder: the pictures of the README and of the help. Lines
follow the field; the colour of the surface is its magnitude, from 0 (blue) to 1 (red), that of the arrows.
"""

import sys

from demo import BLUE, SurfaceNormals, open_surface, show, show_singularities, view_from
from paraview.simple import *

# From and to. The second opposes the flow from the first to the third.
STROKES = [((0.5, 1.65, 1.0), (0.5, 1.35, 1.0)), ((2.35, 2.7, 1.0), (2.65, 2.7, 1.0)), ((4.43, 1.37, 1.0), (4.57, 1.63, 1.0))]
FIELDS = {"power_field": dict(Discretisation="Power Field", NumberOfDirections=4),
          "face_field": dict(Discretisation="Face Field"),
          "one_form": dict(Discretisation="1-Form")}


def show_arrow(line, view):
    """From the first point of a line, along it."""
    way = " + ".join(f"({b} - {a}) * {axis}" for a, b, axis in zip(line.Point1, line.Point2, ("iHat", "jHat", "kHat")))
    arrow = Glyph(Input=Calculator(Input=line, ResultArrayName="Way", Function=way), GlyphType="Arrow", ScaleFactor=0.5,
                  OrientationArray=["POINTS", "Way"], ScaleArray=["POINTS", "No scale array"])
    arrow.GlyphMode, arrow.Stride = "Every Nth Point", 1000
    arrow.GlyphType.ShaftRadius, arrow.GlyphType.TipRadius, arrow.GlyphType.TipLength = 0.06, 0.16, 0.4
    show(arrow, view, [0.98, 0.72, 0.10], Specular=0.4, Position=[0, 0, 0.05])


def draw(field, strokes, image):
    view = view_from([0.35, 0.3, 1], [580, 406])
    magnitude = Calculator(Input=field, ResultArrayName="Magnitude", Function="mag(Direction0)")
    show(SurfaceNormals(Input=magnitude, FeatureAngle=60), view, "Magnitude", Ambient=0.3, Diffuse=0.8)
    GetColorTransferFunction("Magnitude").RGBPoints = [0, 0.62, 0.74, 0.9, 0.5, 1, 0.97, 0.88, 1, 0.93, 0.55, 0.42]
    show(Tube(Input=FieldLines(Input=field, SeparatingDistance=0.03), Radius=0.01), view, BLUE)
    if image != "power_field.png":
        show(FieldGlyphs(Input=field, SeparatingDistance=0.05), view, BLUE)
    for stroke in strokes:
        show_arrow(stroke, view)
    show_singularities(field, view)
    ResetCamera(view)
    GetActiveCamera().Zoom(1.67)
    SaveScreenshot(image, view, ImageResolution=[580, 406], CompressionLevel="9")
    Delete(view)


def main(path, subdivisions=2):
    """Draws the pictures; returns the fields."""
    surface = LoopSubdivision(Input=open_surface(path), NumberofSubdivisions=subdivisions)
    strokes = [Line(Point1=start, Point2=end) for start, end in STROKES]
    fields = {name: HarmonicFieldSolver(Input=surface, Guides=strokes, ConstraintType="Hard", UnitLength=0, **properties)
              for name, properties in FIELDS.items()}
    for name, field in fields.items():
        draw(field, strokes, f"{name}.png")
    return fields


if __name__ == "__main__":
    main(sys.argv[1]) if len(sys.argv) == 2 else sys.exit(__doc__)
