"""Power fields at points and on faces: how far they are from the exact field, and where they have their singularities.

    pvpython compare_power_fields.py [--out folder] [surface.ply ...]     # with the filters on PYTHONPATH

accuracy.csv: surfaces of revolution, on which a field X = f(s) exp(i m phi) of N directions, in the frame of meridians and
parallels, is harmonic where (r f')' = (m + N r')^2 f / r. It is held in a strip at each rim, hard, as it is, on the elements of
the kind; "error" is the root of the mean square of X - exact over that of the exact X, on all other elements.

singularities.csv: crosses that follow principal directions with weight 1, on each surface that is given. The reference is the same
field on the surface cut 1:4 in its plane triangles, once or twice, whose smoothness energy linear elements have right on any
triangles. "near" are singularities with one of the same index of the reference within 2 % of the diagonal of the surface's
box, each of which counts once.
"""
import argparse
import csv
from pathlib import Path

import numpy as np
from directionalmultigrid import smooth_field, update
from directionalmultigrid.vtkFiltersDirectionalFields import vtkFieldSingularities, vtkPrincipalDirections
from vtkmodules.util.numpy_support import numpy_to_vtk, numpy_to_vtkIdTypeArray, vtk_to_numpy
from vtkmodules.vtkCommonCore import vtkPoints
from vtkmodules.vtkCommonDataModel import vtkCellArray, vtkPolyData
from vtkmodules.vtkFiltersModeling import vtkLinearSubdivisionFilter
from vtkmodules.vtkIOPLY import vtkPLYReader

KINDS = {"points": "PointPowerField", "faces": "PowerField"}


def polydata(points, triangles):
    data = vtkPolyData()
    data.SetPoints(vtkPoints())
    data.GetPoints().SetData(numpy_to_vtk(np.ascontiguousarray(points), deep=True))
    cells = vtkCellArray()
    cells.SetData(numpy_to_vtkIdTypeArray(np.arange(0, 3 * len(triangles) + 1, 3), deep=True),
                  numpy_to_vtkIdTypeArray(np.ascontiguousarray(triangles, np.int64).ravel(), deep=True))
    data.SetPolys(cells)
    return data


class Revolution:
    """A meridian (r, z) of unit speed over s in [a, b], turned around the z-axis."""

    def __init__(self, r, z, slope, a, b, N=4, m=0, rims=(1.0, 0.8)):
        self.r, self.z, self.slope, self.a, self.b, self.N, self.m = r, z, slope, a, b, N, m
        self.s, self.f = self.solution(rims)

    def solution(self, rims, size=4000):
        """By central differences, of second order in 1 / size."""
        s = np.linspace(self.a, self.b, size + 1)
        h = s[1] - s[0]
        middle = self.r(s[:-1] + h / 2)
        inner = s[1:-1]
        diagonal = (middle[:-1] + middle[1:]) / h**2 + (self.m + self.N * self.slope(inner)) ** 2 / self.r(inner)
        right = np.zeros(size - 1)
        right[0] = middle[0] / h**2 * rims[0]
        right[-1] = middle[-1] / h**2 * rims[1]
        off = -middle[1:-1] / h**2
        for k in range(1, size - 1):
            factor = off[k - 1] / diagonal[k - 1]
            diagonal[k] -= factor * off[k - 1]
            right[k] -= factor * right[k - 1]
        f = np.empty(size + 1)
        f[0], f[-1] = rims
        for k in range(size - 2, -1, -1):
            f[k + 1] = (right[k] - (off[k] * f[k + 2] if k < size - 2 else 0.0)) / diagonal[k]
        return s, f

    def frame(self, s, phi):
        up = np.sqrt(np.maximum(0.0, 1 - self.slope(s) ** 2)) * np.sign(self.z(s + 1e-6) - self.z(s - 1e-6))
        along = np.stack([self.slope(s) * np.cos(phi), self.slope(s) * np.sin(phi), up], 1)
        return along, np.stack([-np.sin(phi), np.cos(phi), 0 * phi], 1)

    def exact(self, s, phi):
        return np.interp(s, self.s, self.f) * np.exp(1j * self.m * phi)

    def points(self, s, phi):
        return np.stack([self.r(s) * np.cos(phi), self.r(s) * np.sin(phi), self.z(s)], 1)

    def rows(self, rows, stagger, diagonals):
        """Rows of points along parallels, every second one moved by `stagger` of a step; about square cells, or even triangles."""
        radius = self.r(np.linspace(self.a, self.b, 101)).mean()
        height = (self.b - self.a) / rows
        around = 2 * round(np.pi * radius / (height * (2 / np.sqrt(3) if stagger else 1)))
        i, j = np.meshgrid(np.arange(rows + 1), np.arange(around), indexing="ij")
        s = self.a + height * i.ravel()
        phi = (2 * np.pi / around * (j + stagger * (i % 2))).ravel()
        i, j = (k.ravel() for k in np.meshgrid(np.arange(rows), np.arange(around), indexing="ij"))
        at = lambda a, b: a * around + b % around
        a, b, c, d = at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)
        rises = {"alike": np.ones(len(a), bool), "alternating": (i + j) % 2 == 0, "even": i % 2 == 1}[diagonals]
        first = np.where(rises[:, None], np.stack([a, b, c], 1), np.stack([a, b, d], 1))
        second = np.where(rises[:, None], np.stack([a, c, d], 1), np.stack([b, c, d], 1))
        return s, phi, np.concatenate([first, second])


class Disc(Revolution):
    """Crosses along the boundary of the unit disc: X = r^4 in the radial frame."""

    def __init__(self):
        self.r, self.z, self.slope = (lambda s: s), (lambda s: 0 * s), (lambda s: 1 + 0 * s)
        self.a, self.b, self.N, self.m = -1.0, 1.0, 4, 0
        self.s = np.linspace(0, 1, 10001)
        self.f = self.s**4

    def frame(self, s, phi):
        return np.stack([np.cos(phi), np.sin(phi), 0 * phi], 1), np.stack([-np.sin(phi), np.cos(phi), 0 * phi], 1)

    def rows(self, rows, stagger, diagonals):
        if diagonals == "even":
            return self.rings(rows // 2)
        t = np.linspace(-1, 1, rows + 1)
        x, y = (k.ravel() for k in np.meshgrid(t, t, indexing="ij"))
        i, j = (k.ravel() for k in np.meshgrid(np.arange(rows), np.arange(rows), indexing="ij"))
        at = lambda a, b: a * (rows + 1) + b
        a, b, c, d = at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1)
        rises = np.ones(len(a), bool) if diagonals == "alike" else (i + j) % 2 == 0
        first = np.where(rises[:, None], np.stack([a, b, c], 1), np.stack([a, b, d], 1))
        second = np.where(rises[:, None], np.stack([a, c, d], 1), np.stack([b, c, d], 1))
        u, v = x * np.sqrt(1 - y * y / 2), y * np.sqrt(1 - x * x / 2)
        return np.hypot(u, v), np.arctan2(v, u), np.concatenate([first, second])

    @staticmethod
    def rings(count):
        """Ring k has 6 k points."""
        start = [0] + [1 + 3 * k * (k - 1) for k in range(1, count + 2)]
        s = np.concatenate([[0.0]] + [np.full(6 * k, k / count) for k in range(1, count + 1)])
        phi = np.concatenate([[0.0]] + [2 * np.pi * np.arange(6 * k) / (6 * k) for k in range(1, count + 1)])
        at = lambda k, i: start[k] + (i % (6 * k) if k else 0)
        triangles = []
        for k in range(count):
            for side in range(6):
                for i in range(k + 1):
                    inner, outer = side * k + i, side * (k + 1) + i
                    triangles.append((at(k, inner), at(k + 1, outer), at(k + 1, outer + 1)))
                    if i < k:
                        triangles.append((at(k, inner), at(k + 1, outer + 1), at(k, inner + 1)))
        return s, phi, np.array(triangles)


def revolutions():
    return {
        "disc": Disc(),
        "annulus": Revolution(lambda s: s, lambda s: 0 * s, lambda s: 1 + 0 * s, 0.4, 1.0, m=-2),
        "sphere": Revolution(np.cos, np.sin, lambda s: -np.sin(s), -1.0, 1.0, m=1),
        "torus": Revolution(lambda s: 1 + 0.4 * np.cos(s / 0.4), lambda s: 0.4 * np.sin(s / 0.4),
                            lambda s: -np.sin(s / 0.4), -2.6 * 0.4, 2.6 * 0.4, m=1),
    }


MESHES = {"diagonals alike": (0.0, "alike"), "alternating": (0.0, "alternating"), "even": (0.5, "even")}


def place(surface, positions):
    """s and phi of positions near to the surface, by the nearest point of its meridian."""
    phi = np.arctan2(positions[:, 1], positions[:, 0])
    radius, z = np.hypot(positions[:, 0], positions[:, 1]), positions[:, 2]
    t = np.linspace(max(surface.a, surface.s[0]), surface.b, 2001)
    r, h = surface.r(t), surface.z(t)
    k = np.array([np.argmin((r - a) ** 2 + (h - b) ** 2) for a, b in zip(radius, z)])
    dr, dz = np.gradient(r, t)[k], np.gradient(h, t)[k]
    return t[k] + (radius - r[k]) * dr + (z - h[k]) * dz, phi


def error(surface, rows, mesh, kind):
    s, phi, triangles = surface.rows(rows, *MESHES[mesh])
    points = surface.points(s, phi)
    data = polydata(points, triangles)
    attributes = data.GetPointData()
    if kind == "faces":
        centres = points[triangles].mean(1)
        s, phi = place(surface, centres)
        attributes = data.GetCellData()
    along, across = surface.frame(s, phi)
    exact = surface.exact(s, phi)
    width = 0.1 * (surface.b - surface.a) if surface.a > -1 or not isinstance(surface, Disc) else 0.1
    held = s > surface.b - width
    if not isinstance(surface, Disc):
        held |= s < surface.a + width
    angle = np.angle(exact) / surface.N
    vectors = np.abs(exact)[:, None] * (np.cos(angle)[:, None] * along + np.sin(angle)[:, None] * across)
    array = numpy_to_vtk(np.where(held[:, None], vectors, 0.0), deep=True)
    array.SetName("Given")
    attributes.AddArray(array)
    field = smooth_field(data, n=surface.N, Discretisation=KINDS[kind], Directions="Given", ConstraintType="Hard",
                         UnitLength=False, Tolerance=1e-10)
    found = vtk_to_numpy((field.GetCellData() if kind == "faces" else field.GetPointData()).GetArray("Direction0"))
    z = (found * along).sum(1) + 1j * (found * across).sum(1)
    difference = np.abs(z) * np.exp(1j * surface.N * np.angle(z)) - exact
    return np.sqrt((np.abs(difference[~held]) ** 2).mean() / (np.abs(exact[~held]) ** 2).mean())


def accuracy():
    for name, surface in revolutions().items():
        for mesh in MESHES:
            row = [name, mesh]
            for kind in KINDS:
                row += [100 * error(surface, rows, mesh, kind) for rows in (40, 80)]
            yield row


def read(path):
    reader = vtkPLYReader()
    reader.SetFileName(str(path))
    return update(reader)


def cut(data, times):
    subdivision = vtkLinearSubdivisionFilter()
    subdivision.SetInputData(data)
    subdivision.SetNumberOfSubdivisions(times)
    return update(subdivision)


def with_principal_directions(data):
    """Those of the faces, the same on the parts of a face that is cut."""
    principal = vtkPrincipalDirections()
    principal.SetInputData(data)
    result = update(principal)
    for name in ("MaximumDirection", "Confidence"):
        result.GetPointData().RemoveArray(name)
    return result


def areas(data):
    points = vtk_to_numpy(data.GetPoints().GetData())
    a, b, c = (points[vtk_to_numpy(data.GetPolys().GetConnectivityArray()).reshape(-1, 3)[:, k]] for k in range(3))
    return np.linalg.norm(np.cross(b - a, c - a), axis=1) / 2


def singularities(data, kind):
    """The weights are those of CurvatureWeight = 1: the same energy, however the surface is cut."""
    size = areas(data)
    weights = 2 * 900 / size.sum() * size.mean() * vtk_to_numpy(data.GetCellData().GetArray("Confidence"))
    array = numpy_to_vtk(weights, deep=True)
    array.SetName("Weight")
    data.GetCellData().AddArray(array)
    field = smooth_field(data, n=4, Discretisation=KINDS[kind], Directions="MaximumDirection", Weights="Weight", Tolerance=1e-8)
    found = vtkFieldSingularities()
    found.SetInputData(field)
    result = update(found)
    places = np.array([result.GetPoint(i) for i in range(result.GetNumberOfPoints())]).reshape(-1, 3)
    return places, vtk_to_numpy(result.GetPointData().GetArray("Index"))


def near(found, reference, distance):
    """How many have a partner, nearest pairs first."""
    apart = np.linalg.norm(found[0][:, None] - reference[0][None], axis=2)
    apart[np.abs(found[1][:, None] - reference[1][None]) > 1e-6] = np.inf
    count = 0
    while apart.size and apart.min() <= distance:
        i, j = np.unravel_index(np.argmin(apart), apart.shape)
        apart[i], apart[:, j] = np.inf, np.inf
        count += 1
    return count


def places(paths):
    for path in paths:
        data = with_principal_directions(read(path))
        times = 2 if data.GetNumberOfCells() < 25000 else 1
        fine = cut(data, times)
        distance = 0.02 * data.GetLength()
        reference = {kind: singularities(fine, kind) for kind in KINDS}
        row = [path.stem, data.GetNumberOfCells(), len(reference["points"][1])]
        for kind in KINDS:
            found = singularities(data, kind)
            row += [len(found[1]), near(found, reference["points"], distance), near(found, reference["faces"], distance)]
        yield row + [len(reference["faces"][1])]


def write(path, header, rows):
    with open(path, "w", newline="") as file:
        table = csv.writer(file)
        table.writerow(header)
        for row in rows:
            table.writerow(row)
            file.flush()
            print(*(f"{x:.3g}" if isinstance(x, float) else x for x in row), sep="\t", flush=True)


def main():
    parser = argparse.ArgumentParser(description=__doc__, formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("--out", type=Path, default=Path("."))
    parser.add_argument("surfaces", type=Path, nargs="*")
    arguments = parser.parse_args()
    sizes = [f"{kind}: error % at {rows} rows" for kind in KINDS for rows in (40, 80)]
    if not arguments.surfaces:
        write(arguments.out / "accuracy.csv", ["surface", "mesh", *sizes], accuracy())
    columns = [f"{kind}{text}" for kind in KINDS for text in ("", ": near reference", ": near that of faces")]
    if arguments.surfaces:
        write(arguments.out / "singularities.csv", ["surface", "triangles", "reference", *columns, "reference of faces"],
              places(arguments.surfaces))


if __name__ == "__main__":
    main()
