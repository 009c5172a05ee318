"""The thesis's operators in a solver of your own: crosses by PETSc's multigrid, through petsc4py.

    python3 crosses_by_pcmg.py
    mpiexec -n 2 python3 crosses_by_pcmg.py

Directional Prolongation keeps its operators as sparse matrices in the field data of the surface. PETSc's PCMG takes these by
PCMGSetInterpolation, makes the coarse matrices as Galerkin products, and preconditions conjugate gradients. The field is compared with
that of Harmonic Field Solver.

The operators of power fields are complex, and so is the PETSc of petsc4py here (Debian: python3-petsc4py-complex, for which
PYTHONPATH needs /usr/lib/petscdir/petsc-complex/lib/python3/dist-packages).
"""

import sys

import numpy as np
from petsc4py import PETSc
from vtkmodules.util.numpy_support import numpy_to_vtk, vtk_to_numpy
from vtkmodules.vtkFiltersModeling import vtkLoopSubdivisionFilter
from vtkmodules.vtkFiltersSources import vtkPlatonicSolidSource

from directionalmultigrid import smooth_field, update
from directionalmultigrid.vtkFiltersDirectionalFields import vtkDirectionalProlongation

N = 4  # directions per face


def surface_with_directions():
    """A sphere of 20480 even triangles, and one direction on each triangle of a cap."""
    solid, sphere = vtkPlatonicSolidSource(), vtkLoopSubdivisionFilter()
    solid.SetSolidTypeToIcosahedron()
    sphere.SetInputConnection(solid.GetOutputPort())
    sphere.SetNumberOfSubdivisions(5)
    surface = update(sphere)
    points, triangles = arrays(surface)
    on_cap = points[triangles].mean(axis=1)[:, 2] > 0.9 * points[:, 2].max()
    directions = numpy_to_vtk(np.where(on_cap[:, None], [1.0, 0.0, 0.0], 0.0), deep=True)
    directions.SetName("Directions")  # zero where nothing is prescribed
    surface.GetCellData().AddArray(directions)
    return surface


def arrays(surface):
    """Points, and corners of triangles."""
    corners = vtk_to_numpy(surface.GetPolys().GetConnectivityArray())
    return vtk_to_numpy(surface.GetPoints().GetData()).astype(float), corners.reshape(-1, 3)


class Frames:
    """An orthonormal frame per face. Its first axis is along the first side, as the operators want it."""

    def __init__(self, points, triangles):
        a, b, c = (points[triangles[:, k]] for k in range(3))
        normals = np.cross(b - a, c - a)
        doubled = np.linalg.norm(normals, axis=1, keepdims=True)
        self.areas = doubled[:, 0] / 2
        self.x = (b - a) / np.linalg.norm(b - a, axis=1, keepdims=True)
        self.y = np.cross(normals / doubled, self.x)

    def power(self, faces, vectors):
        """Vectors on faces as complex numbers of the same length with N times the angle."""
        z = (self.x[faces] * vectors).sum(axis=1) + 1j * (self.y[faces] * vectors).sum(axis=1)
        length = np.abs(z)
        return np.where(length > 0, z**N / np.where(length > 0, length, 1) ** (N - 1), 0)


def equations(surface):
    """Your own problem: the rows, columns and values of a Hermitian matrix, and the right-hand side.

    This one is of power fields on faces, with soft constraints of weight 1 (PowerField.md). The energy is, for each edge e between faces f
    and g, 3 |e|^2 / (A_f + A_g) times |X_f conj(e_f)^N - X_g conj(e_g)^N|^2; and for each constraint, A_f / mean A times |X_f - Y_f|^2.
    """
    points, triangles = arrays(surface)
    frames = Frames(points, triangles)
    faces = np.repeat(np.arange(len(triangles)), 3)
    starts, ends = triangles.reshape(-1), np.roll(triangles, -1, axis=1).reshape(-1)
    order = np.lexsort((starts > ends, np.maximum(starts, ends), np.minimum(starts, ends)))  # both sides of an edge follow each other
    one, other = order[0::2], order[1::2]  # the surface is closed
    f, g, sides = faces[one], faces[other], points[ends[one]] - points[starts[one]]
    weights = 3 * (sides**2).sum(axis=1) / (frames.areas[f] + frames.areas[g])
    units = sides / np.linalg.norm(sides, axis=1, keepdims=True)
    coupling = -weights * frames.power(f, units) * frames.power(g, units).conj()

    directions = vtk_to_numpy(surface.GetCellData().GetArray("Directions"))
    everywhere = np.arange(len(triangles))
    prescribed = frames.power(everywhere, directions)
    penalties = np.where(prescribed != 0, frames.areas / frames.areas.mean(), 0)
    rows = np.concatenate([f, g, f, g, everywhere])
    columns = np.concatenate([f, g, g, f, everywhere])
    values = np.concatenate([weights, weights, coupling, coupling.conj(), penalties])
    return rows, columns, values, penalties * prescribed


def operator(field_data, level):
    """SP from one level to the next finer one: rows, columns, complex values for N-th powers, shape."""
    offsets, columns, values = (vtk_to_numpy(field_data.GetArray(f"Prolongation.SP.{level}.{part}"))
                                for part in ("Offsets", "Columns", "Values"))
    turned = values[:, 0] + 1j * values[:, 1]  # the modulus is a weight, the argument a rotation of directions
    weights = np.abs(turned)
    rows = np.repeat(np.arange(len(offsets) - 1), np.diff(offsets))
    faces = vtk_to_numpy(field_data.GetArray("Prolongation.NumbersOfFaces"))
    return rows, columns, turned**N / weights ** (N - 1), (faces[level], faces[level + 1])


def matrix(rows, columns, values, shape):
    """PETSc's matrix. Each rank keeps its block of rows; entries at one place add up."""
    result = PETSc.Mat().create()
    result.setSizes(shape)
    result.setType(PETSc.Mat.Type.AIJ)
    result.setUp()
    first, end = result.getOwnershipRange()
    places, here = np.unique(rows.astype(np.int64) * shape[1] + columns, return_inverse=True)
    sums = np.bincount(here, values.real) + 1j * np.bincount(here, values.imag)
    of_rank = slice(*np.searchsorted(places, [first * shape[1], end * shape[1]]))
    offsets = np.searchsorted(places[of_rank], np.arange(first, end + 1) * shape[1])
    csr = offsets.astype(PETSc.IntType), (places[of_rank] % shape[1]).astype(PETSc.IntType), sums[of_rank]
    result.setPreallocationCSR(csr)
    result.assemble()
    return result


def multigrid(A, prolongations):
    """Conjugate gradients with one V-cycle. PETSc counts levels from the coarsest."""
    options = PETSc.Options()
    for name, value in {"pc_mg_galerkin": "both", "mg_levels_ksp_type": "chebyshev", "mg_levels_pc_type": "jacobi",
                        "mg_levels_ksp_max_it": 3, "mg_coarse_pc_type": "redundant"}.items():
        options[name] = value
    solver = PETSc.KSP().create()
    solver.setOperators(A)
    solver.setType(PETSc.KSP.Type.CG)
    solver.setNormType(PETSc.KSP.NormType.NATURAL)
    solver.setTolerances(rtol=1e-10)
    cycle = solver.getPC()
    cycle.setType(PETSc.PC.Type.MG)
    cycle.setMGLevels(len(prolongations) + 1)
    for level, P in enumerate(prolongations):
        above = len(prolongations) - level
        cycle.setMGInterpolation(above, P)
        # Without this, PETSc restricts by the transpose, and conjugate gradients need the conjugate transpose.
        R = P.copy()
        R.hermitianTranspose()
        cycle.setMGRestriction(above, R)
    solver.setFromOptions()
    return solver


def solve(A, right_hand_side, prolongations):
    """The solution, the same on all ranks, and the number of iterations."""
    x, b = A.createVecs()
    b.setArray(right_hand_side[slice(*b.getOwnershipRange())])
    solver = multigrid(A, prolongations)
    solver.solve(b, x)
    if solver.getConvergedReason() <= 0:
        sys.exit(f"PETSc has not converged, reason {solver.getConvergedReason()}")
    scatter, whole = PETSc.Scatter.toAll(x)
    scatter.scatter(x, whole)
    return whole.getArray().copy(), solver.getIterationNumber()


def main():
    if not np.issubdtype(PETSc.ScalarType, np.complexfloating):
        sys.exit("this petsc4py has real numbers; the operators of power fields need python3-petsc4py-complex")
    surface = surface_with_directions()  # the same on every rank
    prolongation = vtkDirectionalProlongation()
    prolongation.SetInputData(surface)
    stored = update(prolongation).GetFieldData()
    if stored.HasArray("Prolongation.CellsOfFaces") or stored.HasArray("Prolongation.PointsOfVertices"):
        sys.exit("the operators belong to the triangles that the filter has made of this surface; triangulate and clean it first")

    rows, columns, values, right_hand_side = equations(surface)
    size = len(right_hand_side)
    levels = stored.GetArray("Prolongation.NumbersOfFaces").GetNumberOfTuples()
    prolongations = [matrix(*operator(stored, level)) for level in range(levels - 1)]
    powers, iterations = solve(matrix(rows, columns, values, (size, size)), right_hand_side, prolongations)

    field = smooth_field(surface, n=N, Discretisation="PowerField", Directions="Directions", Tolerance=1e-10)
    theirs = vtk_to_numpy(field.GetCellData().GetArray("PowerField")) @ [1, 1j]
    difference = np.abs(powers - theirs).max() / np.abs(theirs).max()
    PETSc.Sys.Print(f"{size} faces, {levels} levels, {PETSc.COMM_WORLD.getSize()} ranks: {iterations} iterations, "
                    f"{difference:.1e} off the field of Harmonic Field Solver")
    return 0 if difference < 1e-7 and iterations <= 20 else 1


if __name__ == "__main__":
    sys.exit(main())
