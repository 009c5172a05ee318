"""Save Data writes every output of every filter in the types of files that ParaView offers for surfaces, and reads them again.

    TestSavedData.py FOLDER
"""

import pathlib
import sys
import unittest

import paraview.simple as simple

FOLDER = pathlib.Path(sys.argv.pop())
TYPES = ("vtk", "ply", "stl", "obj", "csv")


def outputs():
    """(name, output, whether it has polygons alone) of each output that has cells."""
    sphere = simple.Sphere(ThetaResolution=30, PhiResolution=30)
    flow = simple.Calculator(Input=sphere, ResultArrayName="Flow", Function="coordsX * jHat - coordsY * iHat")
    dome = simple.Calculator(Input=simple.Sphere(ThetaResolution=30, PhiResolution=30, EndPhi=80), ResultArrayName="Flow",
                             Function="coordsX * jHat - coordsY * iHat")
    stroke = simple.Line(Point1=[-0.2, 0, 0.5], Point2=[0.2, 0.1, 0.5])
    field = simple.HarmonicFieldSolver(Input=sphere)
    filters = [simple.DirectionalField(Input=sphere, Guides=stroke), field, simple.QuadMesh(Input=sphere, NumberOfQuads=300),
               simple.QuadMesh(Input=sphere, NumberOfQuads=300, CutForTextures=1), simple.ParallelTransport(Input=sphere),
               simple.SurfaceDistance(Input=sphere, Targets=stroke), simple.HodgeDecomposition(Input=dome, Vectors=["POINTS", "Flow"]),
               simple.FieldLines(Input=field), simple.FieldGlyphs(Input=field), simple.FieldSingularities(Input=field),
               simple.FieldAngles(Input=field), simple.PrincipalDirections(Input=sphere), simple.ScaleFilter(Input=flow),
               simple.DirectionalProlongation(Input=sphere)]
    for number, source in enumerate(filters):
        source.UpdatePipeline()
        for port in range(source.SMProxy.GetNumberOfOutputPorts()):
            information = source.GetDataInformation(port)
            if information.GetDataSetTypeAsString() == "vtkPolyData" and information.GetNumberOfCells() > 0:
                data = simple.servermanager.Fetch(source, idx=port)
                name = f"{number}-{source.SMProxy.GetXMLName()}-{port}"
                yield name, simple.OutputPort(source, port), data.GetNumberOfPolys() == data.GetNumberOfCells()


class SavedData(unittest.TestCase):
    def test_every_output_in_every_type(self):
        count = 0
        for name, output, has_polygons in outputs():
            cells = output.GetDataInformation().GetNumberOfCells()
            for suffix in TYPES:
                with self.subTest(output=name, type=suffix):
                    path = FOLDER / f"{name}.{suffix}"
                    path.unlink(missing_ok=True)
                    simple.SaveData(str(path), output)
                    count += 1
                    self.assertGreater(path.stat().st_size, 50)
                    if suffix == "vtk" or has_polygons and suffix in ("ply", "obj"):
                        again = simple.OpenDataFile(str(path))
                        again.UpdatePipeline()
                        self.assertEqual(again.GetDataInformation().GetNumberOfCells(), cells)
                        simple.Delete(again)
        self.assertGreater(count, 100)


if __name__ == "__main__":
    unittest.main()
