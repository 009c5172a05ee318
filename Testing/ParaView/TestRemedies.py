"""Messages name filters of ParaView's menus, each with its class for C++: both exist. And duplicates go by the menus."""

import re
from pathlib import Path

import paraview.simple as simple
from paraview import servermanager, vtk
from vtkmodules import vtkFiltersCore, vtkFiltersGeneral, vtkFiltersGeometry, vtkFiltersModeling
from vtkmodules.vtkCommonDataModel import vtkPolyData

SOURCES = Path(__file__).parents[2] / "Filters"
MODULES = [vtkFiltersCore, vtkFiltersGeneral, vtkFiltersGeometry, vtkFiltersModeling]
NAMED = re.compile(r"((?:[A-Z]\w+)(?: (?:to|[A-Z]\w+))*) \((vtk\w+)\)")


def named_filters():
    """{(label, class)} of all string literals in the sources."""
    found = set()
    for path in SOURCES.rglob("*.cxx"):
        text = re.sub(r'"\s*\n\s*"', "", path.read_text())  # literals over several lines
        for literal in re.findall(r'"((?:[^"\\\n]|\\.)*)"', text):
            found.update(NAMED.findall(literal))
    return found


def labels_of_filters():
    definitions = servermanager.ProxyManager().GetProxyDefinitionManager().NewIterator()
    definitions.AddTraversalGroupName("filters")
    definitions.InitTraversal()
    labels = set()
    while not definitions.IsDoneWithTraversal():
        prototype = servermanager.ProxyManager().SMProxyManager.GetPrototypeProxy(
            "filters", definitions.GetProxyName())
        labels.add(prototype.GetXMLLabel())
        definitions.GoToNextItem()
    return labels


def check_names():
    labels = labels_of_filters()
    named = named_filters()
    assert len(named) >= 9, named
    for label, name in named:
        # Later versions of ParaView say "Surface Normals".
        assert label in labels or label.replace("Generate ", "") in labels, f"no filter is called {label}"
        is_ours = name.startswith(("vtkDirectional", "vtkHarmonic"))
        assert is_ours or any(hasattr(module, name) for module in MODULES), f"there is no {name}"
    return len(named)


def check_duplicates():
    data = vtkPolyData()
    points = vtk.vtkPoints()
    for point in ((0, 0, 0), (1, 0, 0), (1, 1, 0), (0, 1, 0)):
        points.InsertNextPoint(point)
    cells = vtk.vtkCellArray()
    for triangle in ((0, 1, 2), (0, 2, 3), (1, 2, 0)):
        cells.InsertNextCell(3, triangle)
    data.SetPoints(points)
    data.SetPolys(cells)
    source = simple.TrivialProducer()
    source.GetClientSideObject().SetOutput(data)
    cleaned = simple.ExtractSurface(Input=simple.CleanCellstoGrid(Input=simple.CleantoGrid(Input=source)))
    given = simple.Calculator(Input=cleaned, ResultArrayName="Given", Function="iHat + 0.5 * jHat")
    field = servermanager.Fetch(simple.HarmonicFieldSolver(Input=given, Directions=["POINTS", "Given"]))
    assert field.GetNumberOfCells() == 2, field.GetNumberOfCells()


number = check_names()
check_duplicates()
print(number, "filters that messages name exist")
