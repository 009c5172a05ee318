"""Levels:  pvbatch levels.py

What Directional Prolongation makes of a bath toy: levels with a quarter of the triangles each, between which fields are
carried.
"""

from scene import *
from surfaces import duck, source


def main():
    prolongation = DirectionalProlongation(Input=source(duck(0.06)), MinimumNumberOfFaces=100)
    prolongation.UpdatePipeline()
    levels = prolongation.GetClientSideObject().GetOutputDataObject(1)
    surfaces = [levels.GetPartition(k, 0) for k in range(levels.GetNumberOfPartitionedDataSets())]
    view = view_from([0, 0.15, 1], [900, 640])
    for k, surface in enumerate(surfaces):
        show(source(surface), view, IVORY, Representation="Surface With Edges", EdgeColor=BLUE, Ambient=0.2,
             Position=[3 * (k % 2), -2.2 * (k // 2), 0])
    save(view, "levels", 1.3)
    return surfaces


if __name__ == "__main__":
    main()
