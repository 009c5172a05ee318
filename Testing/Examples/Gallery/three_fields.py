"""The three discretisations beside each other:  pvbatch three_fields.py ../../../Data/double_torus.vtp

Solves for a cross field (power field), a face field and a 1-form that follow the same three arrows, and leaves
power_field.png, face_field.png and one_form.png in the current folder: the pictures of the README and of the help. Lines
follow the field; the colour of the surface is its magnitude, from 0 (blue) to 1 (red), that of the arrows. The 1-form shows as what it
is: the integral along each edge, here of a coarser mesh.
"""

import sys

from scene import *

# From and to. The second opposes the flow from the first to the third.
STROKES = [((0.5, 1.65, 1.0), (0.5, 1.35, 1.0)), ((2.35, 2.7, 1.0), (2.65, 2.7, 1.0)), ((4.43, 1.37, 1.0), (4.57, 1.63, 1.0))]
FIELDS = {"power_field": dict(Discretisation="Power Field at Points", NumberOfDirections=4),
          "face_field": dict(Discretisation="Face Field"),
          "one_form": dict(Discretisation="1-Form")}


def show_integrals(form, view):
    """The edges of a coarse mesh, in the colours of their integrals."""
    sizes = Calculator(Input=OutputPort(form, 1), AttributeType="Cell Data", ResultArrayName="Integral", Function="abs(OneForm)")
    sizes.UpdatePipeline()
    ColorBy(show(Tube(Input=sizes, Radius=0.022), view, BLUE), ("CELLS", "Integral"))
    largest = sizes.CellData["Integral"].GetRange()[1]
    colours = GetColorTransferFunction("Integral")
    colours.RGBPoints = [0, 0.93, 0.9, 0.86, 0.2 * largest, 0.45, 0.6, 0.8, 0.5 * largest, *RED]
    bar = GetScalarBar(colours, view)
    bar.Title, bar.ComponentTitle, bar.Visibility, bar.Orientation = "integral along an edge", "", 1, "Horizontal"
    bar.TitleColor = bar.LabelColor = [0, 0, 0]
    bar.TitleFontSize = bar.LabelFontSize = 24
    bar.WindowLocation, bar.Position, bar.ScalarBarLength, bar.ScalarBarThickness = "Any Location", [0.25, 0.01], 0.5, 18
    bar.UseCustomLabels, bar.CustomLabels, bar.AddRangeLabels, bar.LabelFormat = 1, [0, 0.1, 0.2, 0.3, 0.4], 0, "%.1f"


def draw(field, strokes, name):
    height = 800 if name == "one_form" else 630  # with a legend below
    view = view_from([0.35, 0.3, 1], [900, height])
    if name == "one_form":
        show_surface(field, view)
        show_integrals(field, view)
    else:
        magnitude = Calculator(Input=field, ResultArrayName="Magnitude", Function="mag(Direction0)")
        show_surface(magnitude, view, "Magnitude")
        colour_by_size("Magnitude", 1)
        show_lines(field, view, 0.025)
    for stroke in strokes:
        show_arrow(stroke, view, 0.5, Position=[0, 0, 0.05])
    show_singularities(field, view)
    save(view, name, 1.67 * 630 / height)
    Delete(view)


def main(path, subdivisions=2):
    """Draws the pictures; returns the fields."""
    surface = LoopSubdivision(Input=open_surface(path), NumberofSubdivisions=subdivisions)
    strokes = [Line(Point1=start, Point2=end) for start, end in STROKES]
    fields = {name: HarmonicFieldSolver(Input=surface, Guides=strokes, ConstraintType="Hard", UnitLength=0, **properties)
              for name, properties in FIELDS.items()}
    coarse = HarmonicFieldSolver(Input=open_surface(path), Guides=strokes, ConstraintType="Hard", UnitLength=0, Discretisation="1-Form")
    for name, field in fields.items():
        draw(coarse if name == "one_form" else field, strokes, name)
    return fields


if __name__ == "__main__":
    main(sys.argv[1]) if len(sys.argv) == 2 else sys.exit(__doc__)
