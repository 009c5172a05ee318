"""Vectors along shortest paths and logarithmic maps: transport(), and the filter behind it."""

import unittest
import warnings

import numpy as np
from directionalmultigrid import FieldError, transport
from directionalmultigrid.vtkFiltersDirectionalFields import vtkParallelTransport
from surfaces import add, values_of_points
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkMultiBlockDataSet
from vtkmodules.vtkFiltersSources import vtkPlaneSource, vtkSphereSource


def values(data, name):
    return vtk_to_numpy(data.GetArray(name))


def sphere(resolution=50):
    source = vtkSphereSource()
    source.SetRadius(1)
    source.SetThetaResolution(resolution)
    source.SetPhiResolution(resolution)
    source.Update()
    return source.GetOutput()


def plane(cells=12):
    """Quadrilaterals on [-1, 1]^2."""
    source = vtkPlaneSource()
    source.SetOrigin(-1, -1, 0)
    source.SetPoint1(1, -1, 0)
    source.SetPoint2(-1, 1, 0)
    source.SetResolution(cells, cells)
    source.Update()
    return source.GetOutput()


class Geodesics(unittest.TestCase):
    def test_map_of_a_sphere(self):
        surface = sphere()
        result = transport(surface, point=(1, 0.1, 0.2), direction=(0, 0, 1))
        self.assertIs(type(result), type(surface))
        self.assertFalse(surface.GetPointData().HasArray("LogarithmicMap"))  # the input stays
        points = values_of_points(surface)
        points /= np.linalg.norm(points, axis=1)[:, None]
        start = points[int(values(result.GetFieldData(), "MapPoint")[0])]
        self.assertLess(np.linalg.norm(start - np.array([1, 0.1, 0.2]) / np.sqrt(1.05)), 0.1)
        up = np.array([0, 0, 1]) - start[2] * start
        up /= np.linalg.norm(up)
        tangents = points - (points @ start)[:, None] * start
        distance = np.arccos(np.clip(points @ start, -1, 1))
        exact = np.stack([tangents @ up, tangents @ np.cross(start, up)], 1)
        exact *= (distance / np.maximum(np.linalg.norm(exact, axis=1), 1e-300))[:, None]
        near = distance < 2  # beyond, other directions are nearly as short
        off = np.linalg.norm(values(result.GetPointData(), "LogarithmicMap") - exact, axis=1)
        self.assertLess(np.quantile(off[near], 0.9), 0.02)  # near the poles, triangles are thin
        self.assertLess(off[near].max(), 0.06)
        self.assertLess(np.abs(values(result.GetPointData(), "GeodesicDistance") - distance)[near].max(), 0.02 * np.pi)
        vectors = values(result.GetPointData(), "TransportedVectors")
        carried = up - (points @ up / (1 + points @ start))[:, None] * (start + points)
        lengths = np.linalg.norm(vectors, axis=1)
        turns = np.arccos(np.clip((vectors * carried).sum(1) / lengths, -1, 1))[near]
        self.assertLess(np.quantile(turns, 0.9), 0.02)
        self.assertLess(turns.max(), 0.06)
        # Of (0, 0, 1), only the part along the surface was carried.
        np.testing.assert_allclose(lengths, np.sqrt(1 - start[2] ** 2), atol=0.02)

    def test_vectors_of_an_array_and_the_point(self):
        surface = plane()
        places = values_of_points(surface)
        given = np.full_like(places, np.nan)
        given[np.abs(places - [-1, 0, 0]).sum(1).argmin()] = 0, 2, 0
        add(surface.GetPointData(), "Given", given)
        surface = transport(surface, "Given", LogarithmicMap=False)  # an output is an input
        np.testing.assert_allclose(values(surface.GetPointData(), "TransportedVectors"), len(places) * [[0, 2, 0]], atol=1e-9)
        self.assertFalse(surface.GetPointData().HasArray("GeodesicDistance"))
        both = transport(surface, "Given", point=(1, 0, 0), direction=(3, 0, 0), AddPoint=True, TimeStep=0.5)
        vectors = values(both.GetPointData(), "TransportedVectors")
        left, right = places[:, 0] < -0.5, places[:, 0] > 0.5
        np.testing.assert_allclose(vectors[left], left.sum() * [[0, 2, 0]], atol=0.05)
        np.testing.assert_allclose(vectors[right], right.sum() * [[3, 0, 0]], atol=0.05)
        middle = transport(plane(), TextureSize=4)
        np.testing.assert_allclose(values(middle.GetPointData(), "TextureCoordinates"), 0.5 + places[:, :2] / 4, atol=1e-6)

    def test_sources_of_very_different_lengths_are_no_fill_values(self):
        surface = plane()
        places = values_of_points(surface)
        given = np.zeros_like(places)
        for x, length in ((-1, 1), (1, 1e6)):
            given[np.abs(places - [x, 0, 0]).sum(1).argmin()] = 0, length, 0
        add(surface.GetPointData(), "Given", given)
        with warnings.catch_warnings(record=True) as said:
            warnings.simplefilter("always")
            result = transport(surface, "Given")
        self.assertEqual([str(each.message) for each in said if "TransportedVectors" in str(each.message)], [])
        lengths = np.linalg.norm(values(result.GetPointData(), "TransportedVectors"), axis=1)
        np.testing.assert_allclose(lengths[places[:, 0] < -0.5], 1, rtol=1e-6)
        np.testing.assert_allclose(lengths[places[:, 0] > 0.5], 1e6, rtol=1e-6)

    def test_cells(self):
        surface = plane()
        given = np.zeros((surface.GetNumberOfCells(), 3))
        given[17] = -1, 1, 7
        add(surface.GetCellData(), "Given", given)
        result = transport(surface, "Given")
        np.testing.assert_allclose(values(result.GetCellData(), "TransportedVectors"), len(given) * [[-1, 1, 0]], atol=1e-9)

    def test_blocks(self):
        blocks = vtkMultiBlockDataSet()
        blocks.SetBlock(0, plane())
        blocks.SetBlock(1, sphere(20))
        carry = vtkParallelTransport()
        carry.SetInputData(blocks)
        carry.Update()
        for index in range(2):
            block = carry.GetOutputDataObject(0).GetBlock(index)
            self.assertTrue(block.GetPointData().HasArray("TransportedVectors"))
            start = block.GetPoint(int(values(block.GetFieldData(), "MapPoint")[0]))  # each block has one of its own
            np.testing.assert_allclose(start, [(0, 0, 0), (0, 0, 1)][index], atol=1e-6)
        self.assertTrue(np.isnan(carry.GetPointOnSurface()).all())

    def test_mistakes(self):
        with self.assertRaisesRegex(TypeError, "did you mean TimeStep"):
            transport(plane(), Timestep=3)
        with self.assertRaisesRegex(FieldError, "Time Step is 0"):
            transport(plane(), TimeStep=0)
        with self.assertRaisesRegex(FieldError, "point has 2 numbers"):
            transport(plane(), point=(1, 2))
        with self.assertRaisesRegex(FieldError, "Direction is zero"):
            transport(plane(), direction=(0, 0, 0))
        with self.assertRaisesRegex(FieldError, "no array 'Wind'"):
            transport(plane(), "Wind")


if __name__ == "__main__":
    unittest.main()
