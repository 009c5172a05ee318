"""Lines, glyphs and contours in a surface, drawn by plain VTK as ink: they show from both sides, near and far, in their colour, and
nothing shines through.

What is seen of them on the surface is compared with what is seen of them alone.
"""

import html
import json
import pathlib
import re
import unittest

import numpy as np
from directionalmultigrid import draw_as_ink, smooth_field, update
from directionalmultigrid.drawing import WITHOUT_LIGHT
from directionalmultigrid.vtkFiltersDirectionalFields import vtkFieldGlyphs, vtkFieldLines
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkFiltersSources import vtkPlaneSource, vtkTessellatedBoxSource
from vtkmodules.vtkFiltersCore import vtkReverseSense
from vtkmodules.vtkRenderingCore import (vtkActor, vtkDataSetMapper, vtkPolyDataMapper, vtkRenderer, vtkRenderWindow,
                                         vtkWindowToImageFilter)
import vtkmodules.vtkRenderingOpenGL2  # draws

ROOT = pathlib.Path(__file__).resolve().parents[2]


def plane(distance=0, clockwise=True):
    """Squares in the plane z = distance, as seen from +z."""
    source, turned = vtkPlaneSource(), vtkReverseSense()
    source.SetResolution(20, 20)
    source.Push(distance)
    turned.SetInputConnection(source.GetOutputPort())
    return update(turned if clockwise else source)


def drawings(field):
    """Lines, and solid glyphs."""
    for drawing in (vtkFieldLines(), vtkFieldGlyphs()):
        drawing.SetInputData(field)
        drawing.SetSeparatingDistance(0.06)
        yield update(drawing)


def actor_of(data, colour, mapper=vtkPolyDataMapper):
    actor = vtkActor()
    actor.SetMapper(mapper())
    actor.GetMapper().SetInputData(data)
    actor.GetMapper().ScalarVisibilityOff()
    actor.GetProperty().SetColor(colour)
    actor.GetProperty().SetLineWidth(3)
    return actor


def red_pixels(*actors, position, distance, parallel):
    """How many there are in a picture from a direction, from so many sizes away."""
    renderer, window, image = vtkRenderer(), vtkRenderWindow(), vtkWindowToImageFilter()
    for actor in actors:
        renderer.AddActor(actor)
    window.SetOffScreenRendering(True)
    window.SetMultiSamples(0)
    window.SetSize(300, 300)
    window.AddRenderer(renderer)
    camera = renderer.GetActiveCamera()
    camera.SetPosition(position)
    camera.SetParallelProjection(parallel)
    renderer.ResetCamera()
    camera.Dolly(1 / distance)
    camera.SetParallelScale(camera.GetParallelScale() * distance)
    renderer.ResetCameraClippingRange()
    window.Render()
    image.SetInput(window)
    colours = vtk_to_numpy(update(image).GetPointData().GetScalars())
    return int(((colours[:, 0] > 200) & (colours[:, 1] < 60)).sum())


class Ink(unittest.TestCase):
    def test_shows_on_a_plane_from_both_sides_whatever_maps_it(self):
        surface, field = actor_of(plane(), (0.9, 0.9, 0.9)), smooth_field(plane(), n=4, BoundaryWeight=1)
        for drawing, mapper in zip(drawings(field), (vtkPolyDataMapper, vtkDataSetMapper)):
            ink = draw_as_ink(actor_of(drawing, (1, 0, 0), mapper))
            for side, distance, parallel in ((1, 0.6, False), (-1, 2, False), (-1, 0.6, True)):
                with self.subTest(mapper=mapper.__name__, side=side, distance=distance, parallel=parallel):
                    picture = dict(position=(0.3, -0.2, side), distance=distance, parallel=parallel)
                    alone = red_pixels(ink, **picture)
                    self.assertGreater(alone, 300)
                    self.assertGreater(red_pixels(surface, ink, **picture), 0.98 * alone)

    def test_does_not_shine_through_what_stands_before_it(self):
        for drawing in drawings(smooth_field(plane(), n=4, BoundaryWeight=1)):
            ink, screen = draw_as_ink(actor_of(drawing, (1, 0, 0))), actor_of(plane(0.05), (1, 1, 1))
            for parallel in (False, True):
                self.assertEqual(red_pixels(screen, ink, position=(0, 0, 1), distance=1, parallel=parallel), 0)

    def test_of_a_thin_wall_shows_from_its_own_side_alone(self):
        """Lines of the upper sheet are red here, and those of the lower one are white, as the wall is."""
        for thickness in (0, 1e-4, 1e-3):
            wall = vtkTessellatedBoxSource()  # a sheet that is open has the same side on both of its faces
            wall.SetBounds(-0.5, 0.5, -0.5, 0.5, 0, thickness)
            wall.SetLevel(20)
            wall.QuadsOn()
            field = smooth_field(update(wall), n=4)
            for drawing in drawings(field):
                upper = vtk_to_numpy(drawing.GetPointData().GetNormals())[:, 2] > 0
                colours = numpy_to_vtk(np.where(upper[:, None], (255, 0, 0), (255, 255, 255)).astype(np.uint8), deep=True)
                drawing.GetPointData().SetScalars(colours)
                ink = draw_as_ink(actor_of(drawing, (1, 0, 0)))
                ink.GetMapper().ScalarVisibilityOn()
                for distance, parallel in ((0.6, False), (2, False), (0.6, True)):
                    with self.subTest(thickness=thickness, distance=distance, parallel=parallel):
                        above, below = (red_pixels(actor_of(field, (1, 1, 1)), ink, position=(0.3, -0.2, side), distance=distance,
                                                   parallel=parallel) for side in (1, -1))
                        self.assertGreater(above, 100)
                        self.assertLess(below, 0.02 * above)

    def test_is_what_the_representation_of_paraview_draws(self):
        representations = (ROOT / "ParaViewPlugin/Representations.xml").read_text(encoding="utf-8")
        replaced = re.search(r'name="InkRepresentation".*?default_values="(\[\{.*?\}\])"', representations, re.DOTALL)[1]
        self.assertEqual(json.loads(html.unescape(replaced)),
                         [{"type": "vertex", "original": "//VTK::PositionVC::Impl", "replacement": vtkFieldLines.GetInkShader()},
                          {"type": "fragment", "original": "//VTK::Light::Impl", "replacement": WITHOUT_LIGHT}])


if __name__ == "__main__":
    unittest.main()
