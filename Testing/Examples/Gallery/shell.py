"""Lines inside a shell:  pvbatch shell.py

Crosses on a bowl, which follow its rim. The window shows lines as Ink, from both sides of a surface: outside in front, and inside behind.
"""

from scene import *
from surfaces import cup, source


def main():
    field = DirectionalField(Input=source(cup(1, 1.1)), BoundaryWeight=1, LineDistance=0.022)
    view = view_from([0.25, -1, 0.75], [900, 760], [0, 0, 1])
    show_surface(field, view)
    show(OutputPort(field, 1), view, BLUE, Representation="Ink", LineWidth=4, InkColor=BLUE)
    show(OutputPort(field, 2), view, Representation="Sign Colors", Specular=0.4)
    save(view, "shell", 1.3)
    return field


if __name__ == "__main__":
    main()
