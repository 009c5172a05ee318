"""Each scene of the gallery is what its page says, in numbers, and its picture shows something:  pvpython TestGallery.py SCENE"""

import importlib
import os
import sys
import tempfile
from xml.etree import ElementTree

import numpy as np
import paraview.simple as simple
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkPNGReader


def fetch(proxy):
    return simple.servermanager.Fetch(proxy)


def cells(data, name):
    return vtk_to_numpy(data.GetCellData().GetArray(name)).astype(float)


def corners(data):
    """Of each triangle: faces x 3 corners x 3 coordinates."""
    return vtk_to_numpy(data.GetPoints().GetData())[vtk_to_numpy(data.GetPolys().GetConnectivityArray()).reshape(-1, 3)]


def unit(vectors):
    return vectors / (np.linalg.norm(vectors, axis=-1, keepdims=True) + 1e-300)


def normals(data):
    a, b, c = np.moveaxis(corners(data), 1, 0)
    return unit(np.cross(b - a, c - a))


def angles(data, ways, N):
    """Degrees from vectors, a row per triangle, to the nearest of N directions, all within the triangles' planes."""
    n, first = normals(data), unit(cells(data, "Direction0"))
    flat = unit(ways - (ways * n).sum(1)[:, None] * n)
    turns = np.degrees(np.arctan2((np.cross(first, flat) * n).sum(1), (first * flat).sum(1)))
    return np.abs((turns + 180 / N) % (360 / N) - 180 / N)


def field_data(data, name):
    return data.GetFieldData().GetArray(name).GetValue(0)


def to_segments(data, start, end, near):
    """Degrees from those of some segments whose middles are near triangles to lines along the field there."""
    centres = corners(data).mean(1)
    where = [np.linalg.norm(centres - middle, axis=1).argmin() for middle in (start + end) / 2]
    ways = np.zeros_like(centres)
    ways[where] = end - start
    assert (np.linalg.norm(centres[where] - (start + end) / 2, axis=1) < near).all()
    return angles(data, ways, 2)[where]


def check_nothing_said(result):
    field, singularities = fetch(result[0]), result[1]
    assert field_data(field, "Converged") == 1 and field.GetFieldData().HasArray("Eigenvalues")
    assert abs(field_data(singularities, "SumOfIndices") - 2) < 1e-9  # Euler's characteristic


def check_strokes(result):
    field = fetch(result[0])
    for stroke in map(fetch, result[1]):
        points = vtk_to_numpy(stroke.GetPoints().GetData())
        off = to_segments(field, points[:-1], points[1:], 0.1)
        assert np.median(off) < 3 and off.max() < 20, off


def check_features(result):
    """Boundary and folds are found here by counting triangles at edges."""
    field = fetch(result[0])
    triangles = vtk_to_numpy(field.GetPolys().GetConnectivityArray()).reshape(-1, 3)
    sides = triangles[:, [[0, 1], [1, 2], [2, 0]]]
    n, faces, off = normals(field), {}, []
    for face, three in enumerate(sides):
        for side in three:
            faces.setdefault(tuple(sorted(side)), []).append(face)
    points = vtk_to_numpy(field.GetPoints().GetData())
    for (a, b), at in faces.items():
        if len(at) == 1 or n[at[0]] @ n[at[1]] < 0.8:
            off.append([at[0], *(points[b] - points[a])])
    off = np.array(off)
    ways = np.zeros_like(n)
    ways[off[:, 0].astype(int)] = off[:, 1:]
    degrees = angles(field, ways, 4)[off[:, 0].astype(int)]
    assert len(off) > 500 and np.percentile(degrees, 95) < 5, np.percentile(degrees, 95)
    assert abs(field_data(result[2], "SumOfIndices") + 3) < 1e-9  # boundary loops included; a disc with four holes


def check_noisy_flow(result):
    field = fetch(result)
    off, measured = angles(field, cells(field, "Truth"), 1), cells(field, "Measured")
    known = np.linalg.norm(measured, axis=1) > 0
    cosines = (unit(measured) * unit(cells(field, "Truth"))).sum(1)[known]
    noise = np.degrees(np.arccos(np.clip(cosines, -1, 1)))
    print(f"measured {noise.mean():.1f} degrees off, {known.mean():.0%} of the triangles; the field {off.mean():.1f}")
    assert abs(noise.mean() - 58) < 0.5 and abs(off.mean() - 5.9) < 0.3  # as its page says


def check_measured_fibres(result):
    field = fetch(result)
    off, measured = angles(field, cells(field, "Truth"), 2), cells(field, "Measured")
    known = np.linalg.norm(measured, axis=1) > 0
    print(f"the field {np.median(off[known]):.1f} degrees off where measured, {np.median(off[~known]):.1f} elsewhere")
    assert 0.3 < known.mean() < 0.36
    assert abs(np.median(off[known]) - 1) < 0.5 and abs(np.median(off[~known]) - 6) < 1  # as its page says


def check_fibres(result):
    for layer, rotation in zip(map(fetch, result), (60, 0, -60)):
        off = np.abs((cells(layer, "Angle") - rotation + 90) % 180 - 90)
        assert np.median(off) < 2 and np.percentile(off, 90) < 8, (np.median(off), np.percentile(off, 90))


def check_singularities(result):
    indices = vtk_to_numpy(result.GetPointData().GetArray("Index"))
    assert np.allclose(indices, -0.25) and len(indices) == 8
    assert abs(field_data(result, "SumOfIndices") + 2) < 1e-9


def check_handles(result):
    """No source, no sink and no vortex: all indices are negative."""
    indices = vtk_to_numpy(fetch(result).GetPointData().GetArray("SingularityIndex"))
    assert indices.max() <= 0 and abs(indices.sum() + 8) < 1e-9, indices[indices != 0]


def check_way_in(result):
    """The plate of the stiffened plate is flat, so a field that goes on under the stiffener is parallel there; the seam is closed."""
    plate, sphere = map(fetch, result)
    crosses = (cells(plate, "Direction0")[:24 * 24] @ [1, 1j, 0]) ** 4
    assert abs(crosses - crosses.mean()).max() < 1e-3, abs(crosses - crosses.mean()).max()
    assert plate.GetFieldData().GetAbstractArray("SurfacePreparation").GetValue(0) == "24 edges of more than two sheets parted"
    indices = vtk_to_numpy(sphere.GetCellData().GetArray("SingularityIndex"))
    assert abs(indices.sum() - 2) < 1e-9, indices.sum()


def check_how_many(result):
    assert result == [2, 4, 8, 12], result


def check_moving_guides(result):
    import moving_guides
    for field, angle in zip(result, np.radians(moving_guides.ANGLES)):
        way = 0.3 * np.array([[np.cos(angle), np.sin(angle), 0]])
        places = np.array([[0, 0.5, 0.42]]), np.array([[0, -0.75, 0.38]])
        assert to_segments(field, places[0] - way, places[0] + way, 0.1).max() < 5
        assert to_segments(field, places[1] - (0.3, 0, 0), places[1] + (0.3, 0, 0), 0.1).max() < 5
        assert field_data(field, "SetupSeconds") == field_data(result[0], "SetupSeconds")  # not repeated


def check_principal_directions(result):
    """The top of the head is nearly a ball of radius 0.46; both directions are perpendicular."""
    bends = fetch(result)
    largest, smallest = cells(bends, "MaximumDirection"), cells(bends, "MinimumDirection")
    assert np.abs((largest * smallest).sum(1)).max() < 1e-6
    top = corners(bends).mean(1)[:, 1] > 1.25
    for name in ("MaximumCurvature", "MinimumCurvature"):
        assert (np.abs(cells(bends, name)[top] * 0.46 - 1) < 0.15).all()


def check_levels(result):
    faces = [surface.GetNumberOfCells() for surface in result]
    assert len(faces) == 4 and np.allclose(np.divide(faces[1:], faces[:-1]), 0.25, atol=0.02), faces
    for surface in result:  # a closed surface without handles
        assert 2 * surface.GetNumberOfPoints() - surface.GetNumberOfCells() == 4


def check_scales(result):
    """Less and less is below longer wavelengths, and rows of the spectrum sum to the variance."""
    data, table = fetch(result), simple.servermanager.Fetch(result, idx=1)
    deviations = [vtk_to_numpy(data.GetPointData().GetArray(name)).std()
                  for name in ("T", "T below 1500", "T below 4000", "T below 10000")]
    assert all(np.diff(deviations) < 0), deviations
    rows = vtk_to_numpy(table.GetRowData().GetArray("T in band"))
    assert abs(rows.sum() / table.GetFieldData().GetArray("T variance").GetValue(0) - 1) < 1e-9


def check_ocean(result):
    """Each coast is a streamline; what flows between two of them is the difference of their stream functions."""
    flow = fetch(result)
    points = vtk_to_numpy(flow.GetPoints().GetData())
    triangles = vtk_to_numpy(flow.GetPolys().GetConnectivityArray()).reshape(-1, 3)
    psi = vtk_to_numpy(flow.GetPointData().GetArray("StreamFunction"))
    coasts = vtk_to_numpy(flow.GetFieldData().GetArray("BoundaryStreamFunction"))
    assert len(coasts) == 5 and coasts[0] == 0, coasts
    shares = vtk_to_numpy(flow.GetFieldData().GetArray("FlowShares"))
    assert abs(shares.sum() - 1) < 1e-9 and shares[1] > 0.5, shares
    # A walk along edges from the first coast to another; what crosses each edge, by the vectors of a face beside it.
    start, end = (int(flow.GetFieldData().GetArray("BoundaryPoint").GetValue(k)) for k in (0, 1))
    beside = {}
    for face, three in enumerate(triangles):
        for a, b in zip(three, np.roll(three, -1)):
            beside.setdefault(a, {})[b] = face
            beside.setdefault(b, {}).setdefault(a, face)
    before, queue = {start: None}, [start]
    for point in queue:
        for other in beside[point]:
            if other not in before:
                before[other] = point
                queue.append(other)
    vectors, n, transport = cells(flow, "RotationalPart"), normals(flow), 0.0
    while before[end] is not None:
        face = beside[before[end]][end]
        along = points[end] - points[before[end]]
        transport += 6371000 * np.cross(along, n[face]) @ vectors[face]  # to the right of the walk
        end = before[end]
    print(f"transport between the first two coasts: {transport / 1e6:.3f} million m^2/s, by stream function {(coasts[1] - coasts[0]) / 1e6:.3f}")
    assert abs(abs(transport) - abs(coasts[1] - coasts[0])) < 1e-6 * np.ptp(psi)


def check_organ_flow(result):
    """The planted sources and vortices are where both functions have their extremes, in spite of the errors."""
    import organ_flow
    flow = fetch(result)
    points = vtk_to_numpy(flow.GetPoints().GetData())
    potential, stream = (vtk_to_numpy(flow.GetPointData().GetArray(name)) for name in ("Potential", "StreamFunction"))
    for function, planted in ((potential, organ_flow.SOURCES), (stream, organ_flow.VORTICES)):
        for place, height in planted.items():
            near = np.linalg.norm(points - organ_flow.nearest(points, place), axis=1)
            disc = np.flatnonzero(near < 0.4)
            extreme = disc[(-height * function[disc]).argmax()]
            assert near[extreme] < 0.12, (place, near[extreme])
    shares = vtk_to_numpy(flow.GetFieldData().GetArray("FlowShares"))
    assert abs(shares.sum() - 1) < 1e-9 and min(shares[:2]) > 0.3 and shares[2] == 0, shares
    assert 0.02 < shares[3] < 0.2, shares  # most of the errors


def check_carried(result):
    """Distances are no shorter than straight lines, and change along edges by no more than their lengths; directions are
    as long everywhere."""
    data = fetch(result)
    points = vtk_to_numpy(data.GetPoints().GetData()).astype(float)
    triangles = vtk_to_numpy(data.GetPolys().GetConnectivityArray()).reshape(-1, 3)
    distance = vtk_to_numpy(data.GetPointData().GetArray("GeodesicDistance"))
    start = points[int(field_data(data, "MapPoint"))]
    straight = np.linalg.norm(points - start, axis=1)
    assert (distance > 0.97 * straight - 0.02).all() and distance.max() > straight.max()
    for a, b in ((0, 1), (1, 2), (2, 0)):
        lengths = np.linalg.norm(points[triangles[:, a]] - points[triangles[:, b]], axis=1)
        slopes = np.abs(distance[triangles[:, a]] - distance[triangles[:, b]]) / lengths
        assert (slopes < 1.1).mean() > 0.99 and slopes.max() < 1.3  # there, where shortest paths meet
    vectors = cells(data, "TransportedVectors")
    lengths = np.linalg.norm(vectors, axis=1)
    assert np.ptp(lengths) < 1e-6 * lengths.max() and np.abs((vectors * normals(data)).sum(1)).max() < 1e-6


def check_offset_lines(result):
    """The ends of lines are as far as they say from the stroke: no nearer than through space, and lines are apart by the step of 0.1."""
    measured, stroke = result
    lines = simple.servermanager.Fetch(measured, idx=1)
    at, from_ = (vtk_to_numpy(data.GetPoints().GetData()).astype(float) for data in (lines, fetch(stroke)))
    distance = vtk_to_numpy(lines.GetPointData().GetArray("Distance"))
    straight = np.linalg.norm(at[:, None] - from_[None], axis=2).min(axis=1)
    assert len(np.unique(np.round(distance, 9))) > 20
    assert (distance > straight - 0.05).all() and (distance[distance < 0.25] < straight[distance < 0.25] + 0.08).all()


def check_paths(result):
    """Each path is as long as its polyline and as the distance, and starts at the nearest place; cells are those of the nearest one."""
    measured, places = result
    paths = simple.servermanager.Fetch(measured, idx=2)
    arrays = {name: cells(paths, name) for name in ("PathLength", "Distance", "StraightLength", "Source")}
    at = vtk_to_numpy(paths.GetPoints().GetData()).astype(float)
    ends = vtk_to_numpy(paths.GetLines().GetOffsetsArray())
    steps = np.linalg.norm(np.diff(at, axis=0), axis=1)
    lengths = np.array([steps[a:b - 1].sum() for a, b in zip(ends[:-1], ends[1:])])
    assert len(lengths) > 140 and np.abs(lengths / arrays["PathLength"] - 1).max() < 1e-5
    assert np.abs(arrays["PathLength"] / arrays["Distance"] - 1).max() < 0.005
    assert (arrays["StraightLength"] <= arrays["PathLength"] + 1e-6).all()
    off = np.linalg.norm(at[ends[:-1]] - np.array(places)[arrays["Source"].astype(int)], axis=1)
    assert off.max() < 0.25  # places are brought to the surface
    assert set(vtk_to_numpy(fetch(measured).GetPointData().GetArray("NearestSource"))) == set(range(len(places)))


def sides_of_quads(mesh):
    """The directed edges of a mesh of quads alone, each of which is there once; in four columns, a row per quad."""
    assert mesh.GetPolys().IsHomogeneous() == 4 and mesh.GetNumberOfCells() == mesh.GetPolys().GetNumberOfCells()
    points = vtk_to_numpy(mesh.GetPolys().GetConnectivityArray()).reshape(-1, 4).astype(np.int64)
    sides = points * mesh.GetNumberOfPoints() + np.roll(points, -1, axis=1)
    assert len(np.unique(sides)) == sides.size
    return points, np.roll(points, -1, axis=1)


def euler(mesh, a, b):
    return mesh.GetNumberOfPoints() - len(np.unique(np.sort([a.ravel(), b.ravel()], axis=0), axis=1).T) + mesh.GetNumberOfCells()


def check_quads(result):
    """A toy, a solid with two holes through it, and sheet metal with four holes."""
    for quads, characteristic in zip(map(fetch, result), (2, -2, -3)):
        assert euler(quads, *sides_of_quads(quads)) == characteristic
        jacobians = cells(quads, "ScaledJacobian")
        assert jacobians.min() > 0 and jacobians.mean() > 0.93, (jacobians.min(), jacobians.mean())


def check_quad_way(result):
    """As many quads as wanted, or nearly so; irregular vertices are the singularities of the field."""
    quads = fetch(result)
    assert euler(quads, *sides_of_quads(quads)) == 2
    assert abs(quads.GetNumberOfCells() - 1100) < 110, quads.GetNumberOfCells()
    irregular = vtk_to_numpy(quads.GetPointData().GetArray("Irregular"))
    assert irregular.sum() == -8 and (irregular != 0).sum() == field_data(quads, "Singularities")


def check_quad_map(result):
    """Valences sum as on a sphere, and the map has seams."""
    quads, seams = result
    irregular = vtk_to_numpy(fetch(quads).GetPointData().GetArray("Irregular"))
    assert -irregular.sum() == 8 and 8 <= np.abs(irregular).sum() < 60, irregular.sum()  # 4 times the Euler characteristic
    assert fetch(seams).GetNumberOfCells() > 50


def check_symmetry(result):
    """Each point has one at its mirror image, and some lie on the plane, where there was symmetry asked for; else they have none."""
    shares = []
    for quads in map(fetch, result):
        assert euler(quads, *sides_of_quads(quads)) == 2
        points = vtk_to_numpy(quads.GetPoints().GetData()).astype(float)
        mirrored = points * (1, 1, -1)
        nearest = np.array([np.abs(points - place).max(axis=1).min() for place in mirrored])
        shares.append((nearest < 1e-3).mean())
    assert shares[0] < 0.1 and shares[1] == 1, shares
    assert (np.abs(points[:, 2]) < 1e-3).sum() > 40


def check_unit_length(result):
    """Edges are alike where singularities keep apart."""
    spreads = []
    for quads in map(fetch, result):
        a, b = sides_of_quads(quads)
        points = vtk_to_numpy(quads.GetPoints().GetData())
        lengths = np.linalg.norm(points[b] - points[a], axis=-1)
        spreads.append(lengths.std() / lengths.mean())
        assert euler(quads, a, b) == 1
    print(f"edges differ by {spreads[0]:.0%} and {spreads[1]:.0%} of their mean")
    assert spreads[0] > 0.3 and spreads[1] < 0.15, spreads


def check_decal(result):
    """The middle of the image is at the point, and lengths on the image are those on the surface, across the decal."""
    data = fetch(result)
    points = vtk_to_numpy(data.GetPoints().GetData()).astype(float)
    places = 1.1 * (vtk_to_numpy(data.GetPointData().GetArray("TextureCoordinates")) - 0.5)
    assert np.abs(places[int(field_data(data, "MapPoint"))]).max() < 1e-9
    triangles = vtk_to_numpy(data.GetPolys().GetConnectivityArray()).reshape(-1, 3)
    triangles = triangles[(np.linalg.norm(places[triangles], axis=2) < 0.45).all(axis=1)]
    ratios = [np.linalg.norm(places[triangles[:, a]] - places[triangles[:, b]], axis=1)
              / np.linalg.norm(points[triangles[:, a]] - points[triangles[:, b]], axis=1) for a, b in ((0, 1), (1, 2), (2, 0))]
    assert len(triangles) > 300 and 0.9 < np.median(ratios) < 1.1 and np.percentile(ratios, 95) < 1.4, np.percentile(ratios, [5, 50, 95])


def check_shell(result):
    """Lines lie in the surface, which is seen from both sides."""
    lines = simple.servermanager.Fetch(result, idx=1)
    surface = vtk_to_numpy(fetch(result).GetPoints().GetData())
    assert lines.GetNumberOfCells() > 50 and np.allclose(lines.GetBounds(), [f(surface[:, k]) for k in range(3) for f in (np.min, np.max)], atol=0.1)


def check_hatching(result):
    """The drawing is made of lines, as many as there are, and lighter where the light is: above."""
    ends, hatching, outline, drawing = result
    shapes = list(ElementTree.parse(drawing).iter("{http://www.w3.org/2000/svg}polyline"))
    assert len(shapes) == sum(lines.GetNumberOfCells() for lines in (ends, hatching, outline))
    assert ends.GetNumberOfCells() == 2 * hatching.GetNumberOfCells()  # of each line
    assert hatching.GetNumberOfCells() > 150 and outline.GetNumberOfCells() >= 1
    heights = vtk_to_numpy(hatching.GetPoints().GetData())[:, 1]
    low, high = outline.GetBounds()[2:4]
    assert heights.mean() < (low + high) / 2 and heights.min() > low - 0.01 and heights.max() < high + 0.01


def check_convergence(result):
    """From 0 to below -10, by more than half a decade in each iteration."""
    assert result[0] == 0 and result[-1] < -10 and np.diff(result).max() < -0.5, result


def picture(path):
    """A row per pixel."""
    reader = vtkPNGReader()
    reader.SetFileName(path)
    reader.Update()
    return vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars())


def check_picture(path):
    pixels = picture(path)
    background = (pixels == 255).all(axis=1).mean()
    assert 0.1 < background < 0.98 and len(np.unique(pixels[::7], axis=0)) > (50 if any(name in path for name in ("hatching", "convergence", "spectrum")) else 1000), (background, path)


def main(scene):
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        result = importlib.import_module(scene).main()
        pictures = [name for name in os.listdir() if name.endswith(".png")]
        assert pictures
        for picture in pictures:
            check_picture(picture)
        globals()[f"check_{scene}"](result)
        os.chdir("/")


if __name__ == "__main__":
    main(sys.argv[1])
