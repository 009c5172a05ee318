"""What every filter promises, whatever it computes: the same bits for any number of threads and whatever was computed before,
an abort that leaves nothing behind, an input that stays as it was. A new filter joins by a row of FILTERS. What it has besides, as
other kinds of unknowns, joins by a row of VARIANTS."""

import hashlib
import unittest

import numpy as np
from directionalmultigrid import vtkFiltersDirectionalFields as module
from surfaces import add, torus, values_of_points
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonCore import VTK_STRING, vtkPoints, vtkSMPTools
from vtkmodules.vtkCommonDataModel import vtkDataObject, vtkMultiBlockDataSet, vtkPolyData
from vtkmodules.vtkCommonExecutionModel import vtkAlgorithm

AXIS = np.array([0.2, 0.3, 1.0])


def surface(around=72, shift=0.0):
    """A torus with vectors and functions at its points, and a few directions on its cells."""
    data = torus(around, 30)
    at = values_of_points(data)
    add(data.GetPointData(), "flow", np.cross(AXIS, at) + np.stack([at[:, 2] + shift, at[:, 0] * at[:, 1], 0 * at[:, 0]], 1))
    add(data.GetPointData(), "directions", np.cross(AXIS, at) / np.linalg.norm(np.cross(AXIS, at), axis=1)[:, None])
    add(data.GetPointData(), "sources", np.where(np.arange(len(at))[:, None] % 500 == 7, np.cross(AXIS, at), 0))
    add(data.GetPointData(), "height", np.sin(3 * at[:, 0] + shift) + at[:, 1])
    add(data.GetPointData(), "region", 1.0 * (at[:, 0] > 1.2 + 0.1 * shift))
    return data


def field(data):
    solver = module.vtkHarmonicFieldSolver()
    solver.SetInputData(data)
    solver.SetInputArrayToProcess(1, 0, 0, 0, "sources")
    solver.Update()
    return solver.GetOutput()


def arrays(*names):
    """Sets up a filter that reads these arrays of points, by index."""
    def set_up(filter, data):
        filter.SetInputData(data)
        for index, name in enumerate(names):
            if name:
                filter.SetInputArrayToProcess(index, 0, 0, 0, name)
    return set_up


def of_field(filter, data):
    filter.SetInputData(field(data))


def scales(filter, data):
    filter.SetInputData(data)
    filter.AddArray("flow")
    filter.AddArray("height")


def solver(kind, **properties):
    """A solver of unknowns of a kind by multigrid."""
    def set_up(filter, data):
        filter.SetInputData(data)
        filter.SetDiscretisation(getattr(module.vtkHarmonicFieldSolver, kind))
        filter.SetSolver(filter.ConjugateGradients)
        function = kind == "ScalarFunction"
        filter.SetInputArrayToProcess(3 if function else 1, 0, 0, 0, "region" if function else "sources")
        for name, value in properties.items():
            getattr(filter, f"Set{name}")(value)
    return set_up


def with_singularities(filter, data):
    solver("PointPowerField")(filter, data)
    places = vtkPolyData()
    places.SetPoints(vtkPoints())
    for at in ((1.4, 0, 0), (-1.4, 0, 0)):
        places.GetPoints().InsertNextPoint(at)
    add(places.GetPointData(), "Index", np.array([0.25, -0.25]))
    filter.SetInputData(2, places)


def by_overlay(filter, data):
    filter.SetInputData(data)
    filter.SetConstruction(filter.ExactOverlay)


FILTERS = {
    "vtkHarmonicFieldSolver": arrays(None, "sources"),
    "vtkDirectionalField": arrays(None, "sources"),
    "vtkDirectionalProlongation": arrays(),
    "vtkPrincipalDirections": arrays(),
    "vtkFieldAngles": arrays("directions", "flow"),
    "vtkFieldSingularities": of_field,
    "vtkFieldLines": of_field,
    "vtkFieldGlyphs": of_field,
    "vtkFieldQuads": of_field,
    "vtkHodgeDecomposition": arrays("flow"),
    "vtkParallelTransport": arrays("sources"),
    "vtkSurfaceDistance": arrays("region"),
    "vtkScaleFilter": scales,
}

VARIANTS = {
    "on faces": ("vtkHarmonicFieldSolver", solver("PowerField")),
    "on samples": ("vtkHarmonicFieldSolver", solver("PointPowerField")),
    "by structure-preserving operators": ("vtkHarmonicFieldSolver", solver("OneForm", CoarseSpace=1)),
    "with a harmonic basis": ("vtkHarmonicFieldSolver", solver("FaceField", HarmonicBasis=True)),
    "of a function": ("vtkHarmonicFieldSolver", solver("ScalarFunction")),
    "with prescribed singularities": ("vtkHarmonicFieldSolver", with_singularities),
    "by exact overlays": ("vtkDirectionalProlongation", by_overlay),
}

RUNS = {name: (name, set_up) for name, set_up in FILTERS.items()} | VARIANTS


def digest(filter):
    """A number by port of all that it holds, but for what a clock says."""
    return [digest_of(filter.GetOutputDataObject(port)) for port in range(filter.GetNumberOfOutputPorts())]


def digest_of(data):
    bits = hashlib.sha256()
    for attributes in range(vtkDataObject.NUMBER_OF_ATTRIBUTE_TYPES):
        held = data.GetAttributesAsFieldData(attributes)
        for k in range(held.GetNumberOfArrays() if held else 0):
            array = held.GetAbstractArray(k)
            if "Seconds" in array.GetName():
                continue
            bits.update(array.GetName().encode())
            bits.update(str([array.GetValue(i) for i in range(array.GetNumberOfValues())]).encode()
                        if array.GetDataType() == VTK_STRING else vtk_to_numpy(array).tobytes())
    if hasattr(data, "GetPoints") and data.GetPoints():
        bits.update(vtk_to_numpy(data.GetPoints().GetData()).tobytes())
    if isinstance(data, vtkPolyData):
        for cells in (data.GetVerts(), data.GetLines(), data.GetPolys()):
            bits.update(vtk_to_numpy(cells.GetConnectivityArray()).tobytes())
            bits.update(vtk_to_numpy(cells.GetOffsetsArray()).tobytes())
    return bits.hexdigest()


def is_empty(filter):
    return all(filter.GetOutputDataObject(port).GetNumberOfElements(vtkDataObject.POINT) == 0
               for port in range(filter.GetNumberOfOutputPorts()))


class Contracts(unittest.TestCase):
    @classmethod
    def setUpClass(cls):
        cls.data, cls.other = surface(), surface(60, 0.5)
        cls.expected = {name: digest(cls.updated(name, cls.data)) for name in RUNS}

    @staticmethod
    def made(name, data):
        kind, set_up = RUNS[name]
        filter = getattr(module, kind)()
        set_up(filter, data)
        return filter

    @classmethod
    def updated(cls, name, data):
        filter = cls.made(name, data)
        filter.Update()
        return filter

    def test_hold_for_all_filters_of_the_module(self):
        concrete = set()
        for name, kind in vars(module).items():
            if isinstance(kind, type) and issubclass(kind, vtkAlgorithm):
                try:
                    filter = kind()
                except TypeError:  # a base class
                    continue
                if filter.GetNumberOfOutputPorts() > 0:  # else it writes files
                    concrete.add(name)
        self.assertEqual(concrete, set(FILTERS))

    def test_something_is_computed(self):
        for name in RUNS:
            with self.subTest(filter=name):
                self.assertFalse(is_empty(self.updated(name, self.data)))

    def test_same_bits_for_any_number_of_threads(self):
        before = vtkSMPTools.GetBackend()
        self.addCleanup(vtkSMPTools.SetBackend, before)
        self.addCleanup(vtkSMPTools.Initialize, 0)
        for backend, threads in (("Sequential", 1), ("STDThread", 3)):
            self.assertTrue(vtkSMPTools.SetBackend(backend))
            vtkSMPTools.Initialize(threads)
            for name in RUNS:
                with self.subTest(filter=name):
                    self.assertEqual(digest(self.updated(name, self.data)), self.expected[name], backend)

    def test_same_bits_whatever_was_computed_before(self):
        for name in RUNS:
            with self.subTest(filter=name):
                filter = self.updated(name, self.other)
                RUNS[name][1](filter, self.data)
                filter.Update()
                self.assertEqual(digest(filter), self.expected[name])
                filter.Modified()
                filter.Update()
                self.assertEqual(digest(filter), self.expected[name])

    def test_an_abort_leaves_nothing_behind(self):
        for name in RUNS:
            for fraction in (0.0, 0.2, 0.51, 0.71, 0.91):  # the solver's stages end at 0.5, 0.7 and 0.9
                with self.subTest(filter=name, fraction=fraction):
                    filter = self.made(name, self.data)
                    told = []
                    filter.AddObserver("ErrorEvent", lambda *_: told.append("error"))
                    filter.AddObserver("WarningEvent", lambda *_: told.append("warning"))
                    seen = []

                    def hear(caller, _event):
                        seen.append(caller.GetProgress())
                        caller.SetAbortExecute(seen[-1] >= fraction)

                    tag = filter.AddObserver("ProgressEvent", hear)
                    filter.Update()
                    self.assertTrue(filter.GetAbortExecute())
                    if fraction <= 0.2 or seen[-1] < 1.0:  # some tell no more before they are done
                        self.assertTrue(is_empty(filter))
                    self.assertEqual(told, [])
                    filter.RemoveObserver(tag)
                    filter.SetAbortExecute(False)
                    filter.Modified()
                    filter.Update()
                    self.assertEqual(digest(filter), self.expected[name])

    def test_progress_never_goes_back(self):
        for name in RUNS:
            with self.subTest(filter=name):
                filter = self.made(name, self.data)
                seen = []
                filter.AddObserver("ProgressEvent", lambda caller, _event: seen.append(caller.GetProgress()))
                filter.Update()
                self.assertEqual(seen, sorted(seen))
                self.assertLessEqual(seen[-1], 1)

    def test_the_input_stays_as_it_was(self):
        before = digest_of(self.data)
        for name in RUNS:
            with self.subTest(filter=name):
                self.updated(name, self.data)
                self.assertEqual(digest_of(self.data), before)

    def test_of_nothing_is_nothing(self):
        for name in RUNS:
            with self.subTest(filter=name):
                filter = self.made(name, self.data)
                told = []
                filter.AddObserver("ErrorEvent", lambda *_: told.append("error"))
                filter.AddObserver("WarningEvent", lambda *_: told.append("warning"))
                filter.SetInputData(vtkPolyData())
                filter.Update()
                self.assertTrue(is_empty(filter))
                self.assertEqual(told, [])

    def test_piece_zero_of_many_is_the_whole(self):
        """On one process, whatever number of pieces is asked for."""
        for name in RUNS:
            with self.subTest(filter=name):
                filter = self.made(name, self.data)
                filter.UpdatePiece(1, 2, 0)
                self.assertTrue(is_empty(filter))
                filter.UpdatePiece(0, 2, 0)
                self.assertEqual(digest(filter)[0], self.expected[name][0])

    def test_two_blocks_are_two_surfaces(self):
        for name in RUNS:
            with self.subTest(filter=name):
                alone = [self.expected[name], digest(self.updated(name, self.other))]
                blocks = vtkMultiBlockDataSet()
                filter = self.made(name, self.data)
                for k, data in enumerate((self.data, self.other)):
                    blocks.SetBlock(k, self.made(name, data).GetInputDataObject(0, 0))
                filter.SetInputDataObject(0, blocks)
                filter.Update()
                output = filter.GetOutputDataObject(0)
                self.assertEqual([digest_of(output.GetBlock(k)) for k in (0, 1)], [ports[0] for ports in alone])

    def test_results_outlive_their_filter(self):
        """Outputs share no memory that another execution writes."""
        for name in RUNS:
            with self.subTest(filter=name):
                filter = self.updated(name, self.data)
                kept = []
                for port in range(filter.GetNumberOfOutputPorts()):
                    output = filter.GetOutputDataObject(port)
                    kept.append(output.NewInstance())
                    kept[-1].ShallowCopy(output)
                RUNS[name][1](filter, self.other)
                filter.Update()
                self.assertEqual([digest_of(output) for output in kept], self.expected[name])


if __name__ == "__main__":
    unittest.main()
