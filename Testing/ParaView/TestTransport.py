"""Parallel Transport through ParaView's Python: every property, by its label, and Apply with nothing said."""

import numpy as np
import paraview.simple as simple
from directionalmultigrid import vtkFiltersDirectionalFields  # so that Python knows the class
from vtkmodules.util.numpy_support import vtk_to_numpy


def points_of(proxy):
    data = simple.servermanager.Fetch(proxy)
    return data.GetPointData(), vtk_to_numpy(data.GetPoints().GetData()).astype(float)


def array(attributes, name):
    return vtk_to_numpy(attributes.GetArray(name))


def map_point(proxy):
    return int(simple.servermanager.Fetch(proxy).GetFieldData().GetArray("MapPoint").GetValue(0))


def check_chosen_point():
    """Nothing said: the filter chooses a point of the surface, and Point is there after the update. Whoever gives one has chosen."""
    ball = simple.Sphere(Radius=2, ThetaResolution=40, PhiResolution=40, Center=[5, 0, 0])
    ball.UpdatePipeline()
    carried = simple.ParallelTransport(Input=ball)
    assert np.allclose(carried.Point, [5, 0, 2]) and not carried.UsePoint  # in the middle of the front of the bounds
    bumps = simple.Calculator(Input=ball, CoordinateResults=1, Function="coords + 0.1 * sin(5 * coordsX) * coords")
    carried = simple.ParallelTransport(Input=bumps)
    arrays, places = points_of(carried)
    start = map_point(carried)
    assert list(carried.Point) == list(places[start]) and carried.UsePoint, (carried.Point, places[start])
    carried.UpdatePipeline()
    solves = carried.GetClientSideObject().GetNumberOfSolves()
    for given in ([0, 0, 0], list(places[7])):  # the first is that of a new property
        carried = simple.ParallelTransport(Input=bumps, Point=given)
        carried.UpdatePipeline()
        assert list(carried.Point) == given and carried.UsePoint
        assert carried.GetClientSideObject().GetNumberOfSolves() == solves  # one execution
        away = np.linalg.norm(places - given, axis=1)
        assert away[map_point(carried)] < away.min() + 1e-6, (map_point(carried), away.argmin())
    blocks = simple.ParallelTransport(Input=simple.GroupDatasets(Input=[ball, simple.Sphere()]))
    blocks.UpdatePipeline()
    assert not blocks.UsePoint  # each block has a point of its own


def main():
    check_chosen_point()
    plane = simple.Plane(XResolution=14, YResolution=14)
    carried = simple.ParallelTransport(Input=plane)
    arrays, places = points_of(carried)
    # The middle of the plane, and the x-axis.
    assert np.abs(array(arrays, "LogarithmicMap") - places[:, :2]).max() < 1e-6
    assert np.abs(array(arrays, "TransportedVectors") - [1, 0, 0]).max() < 1e-9
    assert arrays.GetTCoords().GetName() == "TextureCoordinates"
    assert array(arrays, "TextureCoordinates").min() >= 0 and array(arrays, "TextureCoordinates").max() <= 1

    # Arrows are a drawing of what is carried; circles have one distance each, 20 in all.
    arrows, circles = (simple.servermanager.Fetch(carried, idx=port) for port in (1, 2))
    assert arrows.GetNumberOfCells() > 50 and arrows.GetCellData().HasArray("Magnitude")
    of_circles = array(circles.GetPointData(), "GeodesicDistance")
    assert len(np.unique(np.round(of_circles, 9))) == 20
    assert np.abs(np.linalg.norm(vtk_to_numpy(circles.GetPoints().GetData()), axis=1) - of_circles).max() < 0.02  # linear on triangles
    carried.ArrowDistance, carried.NumberOfCircles = 0.1, 3
    fewer, circles = (simple.servermanager.Fetch(carried, idx=port) for port in (1, 2))
    assert 3 < arrows.GetNumberOfCells() / fewer.GetNumberOfCells() < 10
    assert len(np.unique(np.round(array(circles.GetPointData(), "GeodesicDistance"), 9))) == 3

    carried.Point = [-0.5, -0.5, 3]
    carried.Direction = [0, 2, 0]
    carried.TextureSize = 2
    arrays, places = points_of(carried)
    offsets = places[:, :2] + 0.5
    assert np.abs(array(arrays, "GeodesicDistance") - np.linalg.norm(offsets, axis=1)).max() < 1e-6
    texture = 0.5 + np.stack([offsets[:, 1], -offsets[:, 0]], 1) / 2
    assert np.abs(array(arrays, "TextureCoordinates") - texture).max() < 1e-6

    given = simple.Calculator(Input=plane, ResultArrayName="Given", Function="if(coordsX > 0.49, 1, 0) * jHat")
    carried = simple.ParallelTransport(Input=given, Vectors=["POINTS", "Given"], Point=[-0.5, 0, 0], LogarithmicMap=0)
    arrays, places = points_of(carried)
    assert np.abs(array(arrays, "TransportedVectors") - [0, 1, 0]).max() < 1e-9
    assert not arrays.HasArray("LogarithmicMap")
    carried.AddPoint = 1
    carried.TimeStep = 1
    arrays, places = points_of(carried)
    assert np.abs(array(arrays, "TransportedVectors")[places[:, 0] < -0.4] - [1, 0, 0]).max() < 0.05

    # East at (0.7, 0, 0.7) is +y, and -y where the north pole is below.
    ball = simple.Sphere(Radius=1, ThetaResolution=40, PhiResolution=40)
    one = "if(coordsX > 0.65 & coordsX < 0.75 & coordsZ > 0 & abs(coordsY) < 0.01, 1, 0)"
    eastward = simple.Calculator(Input=ball, ResultArrayName="u", Function=one)
    both = simple.Calculator(Input=eastward, ResultArrayName="v", Function="0 * coordsX")
    wind = simple.ParallelTransport(Input=both, Eastward=["POINTS", "u"], Northward=["POINTS", "v"], LogarithmicMap=0)
    for pole, sign in ((1, 1), (-1, -1)):
        wind.Axis = [0, 0, pole]
        arrays, places = points_of(wind)
        given = array(arrays, "u") > 0
        assert given.any() and np.abs(array(arrays, "TransportedVectors")[given] - [0, sign, 0]).max() < 0.01

    carried.JoinPoints = 0
    carried.Strict = 1
    assert points_of(carried)[0].HasArray("TransportedVectors")
    print("vectors are carried")


main()
