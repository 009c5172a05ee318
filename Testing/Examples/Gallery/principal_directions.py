"""Principal directions:  pvbatch principal_directions.py

How a bath toy bends: lines along the directions of the largest (red) and the smallest curvature (blue). The surface is
darker where both differ more, which is where the directions are clear.
"""

from scene import *
from surfaces import duck, source


def main():
    bends = PrincipalDirections(Input=source(duck()), Scale=4)
    view = view_from([0.55, 0.2, 1], [900, 760])
    show_surface(bends, view, "Confidence")
    GetColorTransferFunction("Confidence").RGBPoints = [0, *IVORY, 1, 0.95, 0.75, 0.45]
    for name, colour in (("MaximumDirection", RED), ("MinimumDirection", BLUE)):
        clear = Calculator(Input=bends, AttributeType="Cell Data", ResultArrayName="Clear",
                           Function=f"if(Confidence > 0.05, {name}, 0 * {name})")
        lines = FieldLines(Input=clear, Directions=["CELLS", "Clear"], NumberOfDirections=2, SeparatingDistance=0.012)
        show(Tube(Input=lines, Radius=0.004), view, colour)
    save(view, "principal_directions", 1.45)
    return bends


if __name__ == "__main__":
    main()
