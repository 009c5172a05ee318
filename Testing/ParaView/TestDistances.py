"""Surface Distance through ParaView's Python: every property, by its label, and Apply with nothing said."""

import numpy as np
import paraview.simple as simple
from directionalmultigrid import vtkFiltersDirectionalFields  # so that Python knows the class
from vtkmodules.util.numpy_support import vtk_to_numpy


def fetched(proxy, port=0):
    return simple.servermanager.Fetch(proxy, idx=port)


def points_of(proxy, port=0):
    data = fetched(proxy, port)
    return data.GetPointData(), vtk_to_numpy(data.GetPoints().GetData()).astype(float)


def values(attributes, name):
    return vtk_to_numpy(attributes.GetArray(name))


def expect(proxy, exact, tolerance=1e-6):
    arrays, places = points_of(proxy)
    error = np.abs(values(arrays, "Distance") - exact(places)).max()
    assert error < tolerance, error
    return arrays


def check_nothing_said():
    """The filter chooses a point of the surface, and Point is there after the update. Whoever gives one has chosen."""
    ball = simple.Sphere(Radius=2, ThetaResolution=40, PhiResolution=40, Center=[5, 0, 0])
    bumps = simple.Calculator(Input=ball, CoordinateResults=1, Function="coords + 0.1 * sin(5 * coordsX) * coords")
    measured = simple.SurfaceDistance(Input=bumps)
    arrays, places = points_of(measured)
    start = int(values(arrays, "Distance").argmin())
    assert list(measured.Point) == list(places[start]) and measured.UsePoint, (measured.Point, places[start])
    given = [0, 0, 0]  # those of a new property
    measured = simple.SurfaceDistance(Input=bumps, Point=given)
    measured.UpdatePipeline()
    assert list(measured.Point) == given and measured.UsePoint
    blocks = simple.SurfaceDistance(Input=simple.GroupDatasets(Input=[ball, simple.Sphere()]))
    blocks.UpdatePipeline()
    assert not blocks.UsePoint  # each block has a point of its own


def check_looks():
    """Colours go one way, from light to dark; lines show as ink, and the table has no view."""
    view = simple.CreateRenderView()
    measured = simple.SurfaceDistance(Input=simple.Sphere(ThetaResolution=40, PhiResolution=40),
                                      Targets=simple.PointSource(Center=[0, 0, -0.5], NumberOfPoints=1, Radius=0))
    display = simple.Show(measured, view)
    assert display.ColorArrayName[1] == "Distance", list(display.ColorArrayName)
    colours = np.reshape(list(simple.GetColorTransferFunction("Distance").RGBPoints), (-1, 4))
    light = colours[:, 1:] @ [0.2126, 0.7152, 0.0722]
    assert (np.diff(light) < 0).all() and light[-1] > 0.4, light
    assert abs(colours[0, 0]) < 1e-9 and 1.4 < colours[-1, 0] < 1.7, colours[:, 0]  # from 0 to half the way around
    assert simple.Show(simple.OutputPort(measured, 1), view).Representation == "Ink"
    assert simple.Show(simple.OutputPort(measured, 2), view).Representation == "Guide Ink"
    simple.GetColorTransferFunction("Distance").RGBPoints = [0, 0, 0, 0, 1, 1, 1, 1]  # somebody's own stay
    simple.SurfaceDistance(Input=simple.Sphere())
    assert list(simple.GetColorTransferFunction("Distance").RGBPoints)[:4] == [0, 0, 0, 0]
    simple.Delete(view)


def main():
    check_nothing_said()
    check_looks()
    plane = simple.Plane(XResolution=14, YResolution=14)  # from -0.5 to 0.5
    measured = simple.SurfaceDistance(Input=plane, Point=[0.11, -0.23, 3])
    arrays = expect(measured, lambda p: np.hypot(p[:, 0] - 0.11, p[:, 1] + 0.23))
    assert arrays.GetScalars().GetName() == "Distance" and not values(arrays, "NearestSource").any()
    assert np.abs(np.linalg.norm(values(arrays, "DirectionFromSource"), axis=1) - 1).max() < 1e-9
    assert len(np.unique(np.round(values(points_of(measured, 1)[0], "Distance"), 9))) == 20
    measured.NumberOfLevels = 3
    assert len(np.unique(np.round(values(points_of(measured, 1)[0], "Distance"), 9))) == 3
    measured.OffsetDistances = [0.2, 0.1]
    lines, places = points_of(measured, 1)
    assert set(np.round(values(lines, "Distance"), 9)) == {0.1, 0.2}
    assert np.abs(np.hypot(places[:, 0] - 0.11, places[:, 1] + 0.23) - values(lines, "Distance")).max() < 0.015  # linear on triangles
    measured.OffsetDistances = []
    assert len(np.unique(np.round(values(points_of(measured, 1)[0], "Distance"), 9))) == 3
    measured.MaximumDistance = 0.3
    measured.UpdatePipeline()
    known = values(points_of(measured)[0], "Distance")
    assert np.isnan(known).any() and np.nanmax(known) <= 0.3
    assert int(fetched(measured).GetFieldData().GetArray("PointsWithoutSource").GetValue(0)) == np.isnan(known).sum()

    stroke = simple.PolyLineSource(Points=[-0.6, 0.13, 0, 0.6, 0.13, 0])
    measured = simple.SurfaceDistance(Input=plane, Sources=stroke, Signed=1)
    expect(measured, lambda p: 0.13 - p[:, 1])  # the left of the stroke is above
    measured.Signed = 0
    measured.AddPoint = 1
    measured.Point = [0.2, -0.4, 0]
    expect(measured, lambda p: np.minimum(np.abs(p[:, 1] - 0.13), np.hypot(p[:, 0] - 0.2, p[:, 1] + 0.4)))
    far = simple.PolyLineSource(Points=[-0.6, 0.13, 0.2, 0.6, 0.13, 0.2])
    measured = simple.SurfaceDistance(Input=plane, Sources=[stroke, far], MaximumSourceDistance=0.5)
    measured.UpdatePipeline()
    assert fetched(measured).GetFieldData().GetArray("SourcesTaken").GetValue(0) == 2

    masked = simple.Calculator(Input=plane, ResultArrayName="Left", Function="if(coordsX < -0.2, 1, 0)")
    column = points_of(masked)[1][:, 0]
    edge = column[column < -0.2].max()
    measured = simple.SurfaceDistance(Input=masked, Mask=["POINTS", "Left"])
    expect(measured, lambda p: np.maximum(p[:, 0] - edge, 0))
    rim = simple.SurfaceDistance(Input=plane, Boundary=1, JoinPoints=0, Strict=1)
    expect(rim, lambda p: 0.5 - np.abs(p[:, :2]).max(axis=1), 0.1 / 14)
    box = simple.Box()
    sharp = simple.SurfaceDistance(Input=simple.Subdivide(Input=simple.Triangulate(Input=box), NumberofSubdivisions=3),
                                   SharpEdges=1, FeatureAngle=80)
    expect(sharp, lambda p: 0.5 - np.sort(np.abs(p), axis=1)[:, 1], 0.02)

    # Paths, and their table.
    ends = simple.PolyLineSource(Points=[0.4, 0.4, 0, -0.4, 0.3, 0])
    measured = simple.SurfaceDistance(Input=plane, Point=[-0.33, -0.41, 0], Targets=ends)
    measured.UpdatePipeline()
    exact = np.hypot([0.73, -0.07], [0.81, 0.71])
    assert np.allclose(values(fetched(measured, 2).GetCellData(), "PathLength"), exact)
    table = fetched(measured, 3).GetRowData()
    for name in ("Distance", "PathLength", "StraightLength"):
        assert np.allclose(values(table, name), exact), name
    assert list(values(table, "Target")) == [0, 1] and list(values(table, "Source")) == [0, 0]

    # A map, with land.
    script = "import numpy\nat = inputs[0].Points\noutput.PointData.append(numpy.where(abs(at[:, 1]) > 70, numpy.nan, 7.0), 'Depth')"
    sea = simple.ProgrammableFilter(Input=simple.Plane(Origin=[-180, -90, 0], Point1=[180, -90, 0], Point2=[-180, 90, 0], XResolution=72,
                                                       YResolution=36), CopyArrays=1, Script=script)
    globe = simple.SurfaceDistance(Input=sea, Point=[171, 3, 0], Coordinates="Longitude and Latitude in Degrees", LengthScale=6371,
                                   Gaps=["POINTS", "Depth"])
    arrays, places = points_of(globe)
    longitude, latitude = np.radians(places[:, 0]), np.radians(places[:, 1])
    exact = 6371 * np.arccos(np.clip(np.sin(latitude) * np.sin(np.radians(3))
                                     + np.cos(latitude) * np.cos(np.radians(3)) * np.cos(longitude - np.radians(171)), -1, 1))
    near = (np.abs(places[:, 1]) < 60) & (exact < 5000)
    known = values(arrays, "Distance")
    assert near.sum() > 100 and np.abs(known - exact)[near].max() < 30
    assert np.isnan(known[np.abs(places[:, 1]) > 72]).all()
    print("distances are measured")


main()
