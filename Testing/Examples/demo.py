"""A smooth cross field on a surface, through ParaView's Python:  pvbatch demo.py SURFACE

Finds the smoothest crosses that follow the principal directions of a PLY, OBJ, STL, VTK or VTP file, and leaves
demo.vtp, the surface with the field, demo.png, a picture of its lines and singularities, and demo.pvsm, a state of ParaView's window that
shows the same, in the current folder.
"""

import os
import sys

from Gallery.scene import *


def main(path):
    field = HarmonicFieldSolver(Input=open_surface(path), NumberOfDirections=4, CurvatureWeight=0.3)
    SaveData("demo.vtp", field, DataMode="Binary")  # see Testing/Examples/README.md, "Files"
    for source in GetSources().values():
        Delete(source)  # the state is that of the file, which needs no solver
    field = XMLPolyDataReader(registrationName="demo.vtp", FileName=os.path.abspath("demo.vtp"))
    view = view_from([0.35, 0.3, 1], [1200, 1050])
    show_surface(field, view)
    show_lines(field, view, 0.016)
    singularities = show_singularities(field, view, 0.008)
    save(view, "demo", 1.37)
    AssignViewToLayout(view, CreateLayout("Field"))  # a window shows views of layouts alone
    SaveState("demo.pvsm")
    indices = singularities.GetFieldData().GetArray("SumOfIndices").GetValue(0)
    print(f"wrote demo.vtp, demo.pvsm and demo.png; the indices of {singularities.GetNumberOfPoints()} singularities sum to {indices:g}")


if __name__ == "__main__":
    main(sys.argv[1]) if len(sys.argv) == 2 else sys.exit(__doc__)
