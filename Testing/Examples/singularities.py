"""A cross field with prescribed singularities:  pvbatch singularities.py Data/double_torus.vtp

Prescribes eight singularities of index -1/4, four on the front of a subdivided surface and four on its back, and nothing else,
and leaves prescribed_singularities.png in the current folder: the picture of the help.
"""

import sys

from demo import BLUE, IVORY, SurfaceNormals, open_surface, show, show_singularities, view_from
from paraview.simple import *

# As parts of the surface's box.
PLACES = [(0.5, y, z) for y in (0.14, 0.38, 0.62, 0.86) for z in (0.0, 1.0)]


def singularities_on(surface):
    """The points, each with its index."""
    bounds = surface.GetDataInformation().GetBounds()
    places = [bounds[2 * k] + place[k] * (bounds[2 * k + 1] - bounds[2 * k]) for place in PLACES for k in range(3)]
    return Calculator(Input=PolyLineSource(Points=places), ResultArrayName="Index", Function="-0.25")


def main(path, subdivisions=2):
    surface = LoopSubdivision(Input=open_surface(path), NumberofSubdivisions=subdivisions)
    surface.UpdatePipeline()
    field = HarmonicFieldSolver(Input=surface, Singularities=singularities_on(surface))
    view = view_from([0.35, 0.3, 1], [580, 406])
    show(SurfaceNormals(Input=field, FeatureAngle=60), view, IVORY, Ambient=0.2, Diffuse=0.85)
    show(Tube(Input=FieldLines(Input=field, SeparatingDistance=0.025), Radius=0.01), view, BLUE)
    singularities = show_singularities(field, view)
    ResetCamera(view)
    GetActiveCamera().Zoom(1.67)
    SaveScreenshot("prescribed_singularities.png", view, ImageResolution=[580, 406], CompressionLevel="9")
    return singularities


if __name__ == "__main__":
    if len(sys.argv) != 2:
        sys.exit(__doc__)
    spheres = main(sys.argv[1])
    sum_of_indices = spheres.GetFieldData().GetArray("SumOfIndices").GetValue(0)
    print(f"{spheres.GetNumberOfPoints()} singularities, whose indices sum to {sum_of_indices:g}")
