"""Functions and flows below and above a wavelength, and their spectra: scale_filter(), spectrum(), and the filter behind them."""

import unittest
import warnings

import numpy as np
from directionalmultigrid import FieldError, FieldWarning, scale_filter, spectrum, update
from directionalmultigrid.vtkFiltersDirectionalFields import vtkScaleFilter
from surfaces import add, grid, torus, values_of_points
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkCommonDataModel import vtkPolyData
from vtkmodules.vtkFiltersCore import vtkPointDataToCellData
from vtkmodules.vtkFiltersSources import vtkSphereSource


def values(data, name):
    return vtk_to_numpy(data.GetArray(name))


def amplitude(wavelength, wave, order=2):
    return 1 / (1 + 2 * (wavelength / wave) ** (2 * order))


def plane(n=40):
    """The square [0, 2]^2 with half waves of lengths 1 and 0.25, whose slopes are zero at the sides."""
    data = grid(n, lambda x, y: (x + 1, y + 1, 0 * x))
    x, y, _ = values_of_points(data).T
    add(data.GetPointData(), "long", np.cos(2 * np.pi * x) + 7)
    add(data.GetPointData(), "short", np.cos(8 * np.pi * y))
    add(data.GetPointData(), "both", np.cos(2 * np.pi * x) + np.cos(8 * np.pi * y))
    add(data.GetPointData(), "U", np.stack([-np.sin(2 * np.pi * x), 0 * x, 0 * x], 1))
    return data


def globe():
    source = vtkSphereSource()
    source.SetThetaResolution(72)
    source.SetPhiResolution(37)
    data = update(source)
    data.GetPointData().Initialize()
    places = values_of_points(data)
    longitude, latitude = np.arctan2(places[:, 1], places[:, 0]), np.arcsin(2 * places[:, 2])
    add(data.GetPointData(), "ssh", np.cos(latitude) ** 2 * np.cos(2 * longitude))  # of degree 2
    add(data.GetPointData(), "u", np.cos(latitude))
    add(data.GetPointData(), "v", 0 * latitude)
    return data


class Scales(unittest.TestCase):
    def test_waves_keep_the_amplitude_of_their_length(self):
        data = plane()
        for order in (1, 2):
            result = scale_filter(data, ["long", "short"], [0.5, 1], Order=order).GetPointData()
            for name, wave, mean in (("long", 1, 7), ("short", 0.25, 0)):
                given = values(data.GetPointData(), name)
                for wavelength, words in ((0.5, "0.5"), (1, "1")):
                    below, above = values(result, f"{name} below {words}"), values(result, f"{name} above {words}")
                    kept = (below - mean) @ (given - mean) / ((given - mean) @ (given - mean))
                    self.assertAlmostEqual(kept, amplitude(wavelength, wave, order), delta=0.02)
                    np.testing.assert_allclose(below + above, given, rtol=0, atol=1e-14)

    def test_means_stay_and_are_told(self):
        with warnings.catch_warnings():
            warnings.simplefilter("ignore", FieldWarning)  # of the length of the surface
            data = scale_filter(plane(), ["long", "both"], [0.4, 2, 40]).GetFieldData()
        np.testing.assert_allclose(values(data, "MeansAfter"), values(data, "MeansBefore"), rtol=0, atol=1e-12)
        np.testing.assert_allclose(values(data, "MeansAfter")[:, 1], 7, atol=1e-3)
        self.assertEqual([data.GetAbstractArray("ScaledFunctions").GetValue(i) for i in range(2)], ["both", "long"])
        np.testing.assert_allclose(values(data, "Wavelengths"), [0.4, 2, 40])
        self.assertEqual(data.GetArray("Converged").GetValue(0), 1)
        self.assertEqual(values(data, "Iterations").shape, (3, 2))

    def test_without_a_choice_the_active_scalars_at_ten_mean_edges(self):
        data = plane()
        data.GetPointData().SetActiveScalars("both")
        result = scale_filter(data)
        wavelength, = values(result.GetFieldData(), "Wavelengths")
        edge = 0.05 * (2 * 40 * 41 + 40 * 40 * 2 ** 0.5) / (2 * 40 * 41 + 40 * 40)
        self.assertAlmostEqual(wavelength, 10 * edge, delta=0.006)
        self.assertEqual(result.GetPointData().GetScalars().GetName(), f"both below {wavelength:g}")

    def test_a_bare_array_needs_no_choice(self):
        data = plane()
        for name in ("long", "short", "U"):
            data.GetPointData().RemoveArray(name)
        self.assertTrue(any("below" in update_name for update_name in names(scale_filter(data).GetPointData())))

    def test_nothing_to_filter_is_an_error_beside_the_surface(self):
        data = plane()
        with self.assertRaisesRegex(FieldError, "there is nothing to filter: no array is chosen"):
            scale_filter(data)
        scales = vtkScaleFilter()
        scales.SetInputData(data)
        scales.AddObserver("ErrorEvent", lambda *_: None)
        scales.GetExecutive().AddObserver("ErrorEvent", lambda *_: None)
        scales.Update()
        self.assertEqual(scales.GetOutput().GetNumberOfCells(), data.GetNumberOfCells())

    def test_cells_keep_their_mean_and_the_sum(self):
        convert = vtkPointDataToCellData()
        convert.SetInputData(plane())
        data = update(convert)
        result = scale_filter(data, "both", 0.5).GetCellData()
        below, above = values(result, "both below 0.5"), values(result, "both above 0.5")
        np.testing.assert_allclose(below + above, values(data.GetCellData(), "both"), atol=1e-13)
        self.assertAlmostEqual(above.mean(), 0, delta=1e-13)  # cells are of one area
        self.assertLess(below.std(), 0.8 * values(data.GetCellData(), "both").std())

    def test_the_spectrum_peaks_at_the_waves_and_sums_to_the_variance(self):
        table = spectrum(plane(), "both", SpectrumFrom=0.1, SpectrumTo=4, SpectrumRows=40)
        rows = table.GetRowData()
        wavelengths, octave = values(rows, "Wavelength"), values(rows, "both per octave")
        np.testing.assert_allclose(values(rows, "Wavenumber") * wavelengths, 2 * np.pi)
        for wave in (1, 0.25):
            near = abs(np.log2(wavelengths / wave)) < 0.7
            peak = wavelengths[near][octave[near].argmax()]
            self.assertLess(abs(np.log2(peak / wave)), 0.15)
        variance = table.GetFieldData().GetArray("both variance").GetValue(0)
        self.assertAlmostEqual(variance, 1, delta=0.03)  # half of each amplitude squared
        self.assertAlmostEqual(values(rows, "both in band").sum(), variance, delta=1e-12)
        self.assertTrue((np.diff(values(rows, "both above")) > -1e-4).all())

    def test_units_of_length(self):
        data = plane()
        expected = values(scale_filter(data, "both", 0.5).GetPointData(), "both below 0.5")
        result = scale_filter(data, "both", 500, LengthScale=1000).GetPointData()
        np.testing.assert_array_equal(values(result, "both below 500"), expected)
        a, b = (spectrum(data, "both", SpectrumRows=4, LengthScale=scale).GetRowData() for scale in (1, 1000))
        np.testing.assert_allclose(1000 * values(a, "Wavelength"), values(b, "Wavelength"))
        np.testing.assert_allclose(values(a, "both per octave"), values(b, "both per octave"), rtol=1e-9)

    def test_a_gradient_flow_is_the_gradient_of_the_filtered_potential(self):
        data = plane(60)
        result = scale_filter(data, "U", 0.5, PartsApart=True).GetPointData()
        given = values(data.GetPointData(), "U")
        below, divergent = values(result, "U below 0.5"), values(result, "U divergent below 0.5")
        kept = (below * given).sum() / (given * given).sum()
        self.assertAlmostEqual(kept, amplitude(0.5, 1), delta=0.02)
        np.testing.assert_allclose(below + values(result, "U above 0.5"), given, atol=1e-14)
        np.testing.assert_allclose(divergent, below, atol=1e-4)
        np.testing.assert_allclose(values(result, "U rotational below 0.5"), 0, atol=1e-4)
        rows = spectrum(data, "U").GetRowData()
        self.assertGreater(values(rows, "U divergent in band").sum(), 0.99 * values(rows, "U in band").sum())

    def test_a_solid_rotation_has_the_wavenumber_of_its_stream_function_or_one(self):
        data = globe()  # of radius 1/2
        given = values(data.GetPointData(), "u")
        for kind, wave in (("Parts", np.pi / 2 ** 0.5), ("Wholes", np.pi)):
            below = values(scale_filter(data, eastward="u", northward="v", wavelengths=1, FlowKind=kind).GetPointData(), "Flow below 1")
            places = values_of_points(data)
            east = np.stack([-places[:, 1], places[:, 0], 0 * given], 1) * 2
            kept = (below * east).sum() / (east * east).sum()
            self.assertAlmostEqual(kept, amplitude(1, wave), delta=0.01)

    def test_nothing_flows_through_coasts(self):
        data = grid(30, lambda x, y: (x, y, 0 * x))
        x, y, _ = values_of_points(data).T
        psi = np.cos(np.pi * x / 2) * np.cos(np.pi * y / 2) * np.cos(3 * x)
        add(data.GetPointData(), "U", np.stack([-np.gradient(psi.reshape(31, 31), 2 / 30, axis=1).ravel(),
                                                np.gradient(psi.reshape(31, 31), 2 / 30, axis=0).ravel(), 0 * x], 1))
        below = values(scale_filter(data, "U", 1).GetPointData(), "U below 1")
        speed = np.linalg.norm(below, axis=1)
        self.assertLess(abs(below[abs(x) == 1, 0]).max(), 0.12 * speed.max())  # of half a cell beside the coast
        self.assertLess(abs(below[abs(y) == 1, 1]).max(), 0.12 * speed.max())

    def test_land_takes_no_part(self):
        data = plane(20)
        x, y, _ = values_of_points(data).T
        field = np.where((abs(x - 1) < 0.3) & (abs(y - 1) < 0.3), np.nan, 5)
        add(data.GetPointData(), "salt", field)
        result = scale_filter(data, "salt", 0.5)
        below = values(result.GetPointData(), "salt below 0.5")
        np.testing.assert_allclose(below[np.isfinite(below)], 5, atol=1e-12)
        self.assertTrue(np.isnan(below[np.isnan(field)]).all())
        self.assertGreater(result.GetFieldData().GetArray("CellsWithoutData").GetValue(0), 0)
        add(data.GetPointData(), "salt", np.where(np.isnan(field), 1e20, field))
        with self.assertRaisesRegex(FieldError, "1e\\+20"):
            scale_filter(data, "salt", 0.5)
        add(data.GetPointData(), "salt", np.full(len(x), np.nan))
        with self.assertRaisesRegex(FieldError, "array 'salt' is NaN at each cell"):
            scale_filter(data, "salt", 0.5)

    def test_a_map_is_the_globe(self):
        data = grid(20, lambda x, y: (90 + 60 * x, 50 * y, 0 * x))
        x, y, _ = np.radians(values_of_points(data).T)
        ball = vtkPolyData()
        ball.DeepCopy(data)
        for i in range(len(x)):
            ball.GetPoints().SetPoint(i, np.cos(y[i]) * np.cos(x[i]), np.cos(y[i]) * np.sin(x[i]), np.sin(y[i]))
        for each in (data, ball):
            add(each.GetPointData(), "T", np.sin(3 * x) * np.cos(y))
        on_map = scale_filter(data, "T", 1.5, Coordinates="LongitudeAndLatitude").GetPointData()
        np.testing.assert_allclose(values(on_map, "T below 1.5"), values(scale_filter(ball, "T", 1.5).GetPointData(), "T below 1.5"),
                                   atol=1e-9)

    def test_wavelengths_that_vary(self):
        data = plane()
        x = values_of_points(data)[:, 0]
        add(data.GetPointData(), "half", np.full(len(x), 0.5))
        add(data.GetPointData(), "salt", np.full(len(x), 35.0))
        add(data.GetPointData(), "local", np.where(x < 1, 0.02, 2))
        same = values(scale_filter(data, "both", 1).GetPointData(), "both below 1")
        scaled = values(scale_filter(data, "both", 2, relative_wavelengths="half").GetPointData(), "both below 2")
        np.testing.assert_allclose(scaled, same, atol=1e-5)
        with warnings.catch_warnings():
            warnings.simplefilter("ignore")  # of wavelengths that the mesh does not have
            varying = scale_filter(data, ["salt", "short"], relative_wavelengths="local")
        np.testing.assert_allclose(values(varying.GetPointData(), "salt below 1"), 35, rtol=0, atol=1e-11)
        below, given = values(varying.GetPointData(), "short below 1"), values(data.GetPointData(), "short")
        self.assertGreater(np.abs(below[x < 0.9]).max(), 0.95)  # a wave of 0.25 passes one of 0.02 and not one of 2
        self.assertLess(np.abs(below[x > 1.5]).max(), 0.05)
        self.assertAlmostEqual(np.abs(given).max(), 1)
        self.assertEqual(spectrum(data, "both", relative_wavelengths="half").GetNumberOfRows(), 24)

    def test_wrong_relative_wavelengths_are_refused_by_point(self):
        data = plane(10)
        x = values_of_points(data)[:, 0]
        numbers = x + 1
        numbers[17] = 0
        add(data.GetPointData(), "local", numbers)
        with self.assertRaisesRegex(FieldError, "relative wavelength of point 17 is 0"):
            scale_filter(data, "both", relative_wavelengths="local")
        numbers[17] = 1
        add(data.GetPointData(), "local", numbers)
        with self.assertRaisesRegex(FieldError, "filter flows by their parts"):
            scale_filter(data, "U", relative_wavelengths="local", FlowKind="Wholes")

    def test_wrong_wavelengths_and_arrays(self):
        data = plane(10)
        for wrong, words in ((0, "wavelength 0 is not a positive"), (-1, "wavelength -1"), (float("inf"), "wavelengths = inf is out of range"),
                             (float("nan"), "wavelengths = nan is out of range")):
            with self.assertRaisesRegex(FieldError, words):
                scale_filter(data, "both", wrong)
        with self.assertRaisesRegex(FieldError, "array 'none of it'"):
            scale_filter(data, "none of it", 1)
        add(data.GetPointData(), "tensor", np.zeros((121, 9)))
        with self.assertRaisesRegex(FieldError, "array 'tensor', chosen for the function of the surface, does not hold 1 number"):
            scale_filter(data, "tensor", 1)
        with self.assertRaisesRegex(TypeError, "wavelengths = '1'"):
            scale_filter(data, "both", "1")
        with self.assertRaisesRegex(TypeError, "did you mean wavelengths"):
            scale_filter(data, "both", Wavelength=1)
        with self.assertRaisesRegex(TypeError, "3 is no name"):
            scale_filter(data, 3)
        with self.assertRaisesRegex(FieldError, "Order"):
            scale_filter(data, "both", 1, Order=3)
        with self.assertRaisesRegex(FieldError, "spectrum goes from"):
            spectrum(data, "both", SpectrumFrom=2, SpectrumTo=1)

    def test_wavelengths_that_the_mesh_does_not_have_are_warned_of(self):
        with self.assertWarnsRegex(FieldWarning, "fewer than 4, and is not resolved: such waves keep about 0.5"):
            scale_filter(plane(10), "both", 650, LengthScale=1000)
        with self.assertWarnsRegex(FieldWarning, "longest waves, of about 4000, keep"):
            scale_filter(plane(10), "both", 9000, LengthScale=1000)

    def test_one_setup_for_all_wavelengths_arrays_and_times(self):
        data = torus(40, 20)
        x, y, z = values_of_points(data).T
        scales = vtkScaleFilter()
        for name in ("f", "g"):
            scales.AddArray(name)
        for wavelength in (0.8, 2):
            scales.AddWavelength(wavelength)
        scales.SetSpectrumRows(3)
        for time in range(3):
            add(data.GetPointData(), "f", x + time)
            add(data.GetPointData(), "g", z * time)
            data.Modified()
            scales.SetInputData(data)
            update(scales)
            self.assertEqual(scales.GetNumberOfSetups(), 1)
            self.assertEqual(scales.GetNumberOfSplits(), (time + 1) * 2 * (2 + 4))
        scales.SetOrder(1)
        update(scales)
        self.assertEqual(scales.GetNumberOfSetups(), 1)
        fresh = values(scale_filter(data, ["f", "g"], [0.8, 2], Order=1).GetPointData(), "f below 2")
        np.testing.assert_array_equal(values(scales.GetOutput().GetPointData(), "f below 2"), fresh)

    def test_lists(self):
        scales = vtkScaleFilter()
        for name in ("a", "b", "a", "", None):
            scales.AddArray(name)
        self.assertEqual([scales.GetArray(k) for k in range(-1, 3)], [None, "a", "b", None])
        scales.ClearArrays()
        self.assertEqual(scales.GetNumberOfArrays(), 0)
        for wavelength in (3, 2, 3):
            scales.AddWavelength(wavelength)
        self.assertEqual([scales.GetWavelength(k) for k in range(-1, 3)], [0, 3, 2, 0])
        scales.ClearWavelengths()
        self.assertEqual(scales.GetNumberOfWavelengths(), 0)
        before = scales.GetMTime()
        scales.ClearWavelengths()
        scales.ClearArrays()
        self.assertEqual(scales.GetMTime(), before)


def names(data):
    return [data.GetArrayName(i) for i in range(data.GetNumberOfArrays())]


if __name__ == "__main__":
    unittest.main()
