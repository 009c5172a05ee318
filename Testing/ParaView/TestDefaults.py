"""The proxies of the plugin offer every property of the C++ classes, with the same default.

Arguments: the plugin, the folder of its XML.
"""

import pathlib
import re
import sys
import unittest
import xml.etree.ElementTree as ElementTree

from directionalmultigrid import vtkFiltersDirectionalFields as filters
import paraview.simple as simple
from vtkmodules.vtkCommonExecutionModel import vtkAlgorithm
from vtkmodules.vtkFiltersSources import vtkSphereSource

XML_FOLDER = pathlib.Path(sys.argv.pop())
UNIT = " (\N{DEGREE SIGN})"  # which Python leaves out of the names that it makes of labels
WEIGHTS = {"Alignment", "BoundaryWeight", "SharpEdgesWeight", "CurvatureWeight"}  # refused where they are used
simple.LoadPlugin(sys.argv.pop(), remote=False, ns=globals())


def proxies():
    """(proxy name, its XML element with the properties of its base, a fresh proxy, a fresh C++ object) of each filter."""
    groups = [group for path in sorted(XML_FOLDER.glob("*.xml")) for group in ElementTree.parse(path).getroot()]
    bases = {element.get("name"): element for group in groups if group.get("name") == "internal_filters" for element in group}
    for element in (element for group in groups if group.get("name") == "filters" for element in group.iter("SourceProxy")):
        if element.get("base_proxygroup") == "filters":
            continue  # has the properties of another one, with defaults of its own: see TestFirstContact.py
        name = element.get("name")
        own = {child.get("name") for child in element if child.get("name")}
        element.extend(child for child in bases.get(element.get("base_proxyname"), ()) if child.get("name") not in own)
        yield (name, element, getattr(simple.servermanager.filters, name)(), getattr(filters, element.get("class"))())


def properties(element):
    """(proxy property name, C++ property name, element) of each property with a plain setter."""
    for child in element:
        if child.get("number_of_elements") != "1":
            continue  # vectors have setters and domains of their own
        match = re.fullmatch(r"Set(\w+)", child.get("command", ""))
        if match and child.get("number_of_elements") == "1":
            yield child.get("name"), match.group(1), child


def ends(element):
    """(the last value that a property may have, a step beyond) of each end of its range or enumeration."""
    entries = [int(entry.get("value")) for entry in element.iter("Entry")]
    if entries:
        yield from ((min(entries), -1), (max(entries), 1))
    number = int if element.tag.startswith("Int") else float
    for domain in element.iter():
        if domain.tag.endswith("RangeDomain"):
            for last, step in ((number(domain.get(end)), step) for end, step in (("min", -1), ("max", 1)) if domain.get(end)):
                yield last, step if last + step != last else step * abs(last)  # 1e30 + 1 is no step


def listener(messages):
    def listen(_source, _event, text):
        messages.append(text)

    listen.CallDataType = "string0"
    return listen


class Defaults(unittest.TestCase):
    def test_defaults_agree(self):
        for name, element, proxy, algorithm in proxies():
            for propertyName, member, child in properties(element):
                with self.subTest(proxy=name, property=propertyName):
                    expected = getattr(algorithm, "Get" + member)()
                    kind = str if isinstance(expected, str) else float
                    self.assertEqual(kind(child.get("default_values")), kind(expected))
                    value = proxy.SMProxy.GetProperty(propertyName).GetElement(0)
                    self.assertEqual(kind(value), kind(expected))

    def test_buttons_have_icons(self):
        """The toolbar shows a text for a filter without one."""
        resources = ElementTree.parse(XML_FOLDER / "Resources/Resources.qrc").getroot()
        ours = {f":{group.get('prefix')}/{file.text}" for group in resources for file in group}
        files = [*sorted(XML_FOLDER.glob("*.xml")), XML_FOLDER / "Resources/Menu.xml"]
        elements = [element for path in files for element in ElementTree.parse(path).getroot().iter()]
        buttons = [element.get("icon", "") for element in elements if element.tag == "ShowInMenu" and element.get("category") or
                   element.tag == "Proxy" and element.get("group") == "filters" and not len(element)]
        self.assertGreater(len(buttons), 12)
        for icon in buttons:
            self.assertTrue(icon in ours or icon.startswith(":/pqWidgets/"), icon)

    def test_boxes_name_their_weights(self):
        """A property without a command is a box, whose default is that of its weight."""
        boxes = 0
        for name, element, proxy, algorithm in proxies():
            for child in element:
                if child.tag.endswith("Property") and not child.get("command"):
                    weight = element.find(f"*[@name='{child.find('Hints/Switches').get('property')}']")
                    self.assertEqual(int(child.get("default_values")), float(weight.get("default_values")) > 0)
                    boxes += 1
        self.assertEqual(boxes, 5)

    def test_ranges_agree(self):
        """C++ takes the values at the ends of a range, and refuses those beyond by one error that says which.

        The error comes before that of a surface whose points are nowhere; so nothing runs."""
        for name, element, proxy, algorithm in proxies():
            nowhere = vtkSphereSource()
            nowhere.SetOutputPointsPrecision(vtkAlgorithm.DOUBLE_PRECISION)
            nowhere.SetRadius(1e300)
            algorithm.SetInputConnection(nowhere.GetOutputPort())
            errors = []
            algorithm.AddObserver("ErrorEvent", listener(errors))
            for propertyName, member, child in properties(element):
                default = getattr(algorithm, "Get" + member)()
                for end, step in ends(child) if member not in WEIGHTS else ():
                    with self.subTest(proxy=name, property=propertyName, end=end):
                        for value in (end, end + step):
                            getattr(algorithm, "Set" + member)(value)
                            self.assertEqual(getattr(algorithm, "Get" + member)(), value)
                            errors.clear()
                            algorithm.Update()
                            self.assertEqual(len(errors), 1)
                            check = self.assertNotIn if value == end else self.assertIn
                            check(f": {child.get('label').removesuffix(UNIT)} is {value:.6g}; ", errors[0])
                getattr(algorithm, "Set" + member)(default)

    def test_every_property_is_offered(self):
        for name, element, proxy, algorithm in proxies():
            offered = {member for _, member, _ in properties(element)}
            own = {member for kind in type(algorithm).__mro__
                   if kind is type(algorithm) or kind.__name__ in ("vtkOrientedSurfaceAlgorithm", "vtkFieldDrawingAlgorithm")
                   for member in vars(kind)}
            settable = {member[3:] for member in own
                        if member.startswith("Set") and "G" + member[1:] in own}
            settable -= {child.get("name") for child in element
                         if child.tag == "DoubleVectorProperty" and child.get("number_of_elements") != "1"}
            with self.subTest(proxy=name):
                inherited = {member[3:] for base in type(algorithm).__mro__[1:] for member in vars(base)} - settable
                self.assertEqual(offered - inherited, settable)

    def test_names_in_python_are_those_of_the_xml(self):
        """paraview.simple calls a property by its label; that must give the proxy's own name."""
        for name, element, proxy, algorithm in proxies():
            for child in element:
                if child.tag.endswith("Property"):
                    with self.subTest(proxy=name, property=child.get("name")):
                        self.assertIn(child.get("name").replace(" ", ""), proxy.ListProperties())

    def test_angles_have_a_unit(self):
        angles = 0
        for path in XML_FOLDER.glob("*.xml"):
            for child in ElementTree.parse(path).getroot().iter():
                if child.tag.endswith("Property") and child.get("name"):
                    isAngle = "in degrees" in " ".join(child.findtext("Documentation", "").split())
                    angles += isAngle
                    with self.subTest(file=path.name, property=child.get("name")):
                        self.assertEqual(child.get("label", "").endswith(UNIT), isAngle)
        self.assertGreater(angles, 12)

    def test_everything_is_documented(self):
        for name, element, proxy, algorithm in proxies():
            documentation = element.find("Documentation")
            self.assertTrue(documentation.get("short_help"))
            self.assertTrue(documentation.get("long_help"))
            for child in element:
                if child.tag.endswith("Property"):
                    with self.subTest(proxy=name, property=child.get("name")):
                        self.assertGreater(len(child.findtext("Documentation", "").strip()), 20)


if __name__ == "__main__":
    unittest.main()
