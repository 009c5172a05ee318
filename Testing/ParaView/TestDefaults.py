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

XML_FOLDER = pathlib.Path(sys.argv.pop())
REFUSED = {"Alignment", "BoundaryWeight", "SharpEdgesWeight", "CurvatureWeight"}  # not clamped
simple.LoadPlugin(sys.argv.pop(), remote=False, ns=globals())


def proxies():
    """(proxy name, its XML element, a fresh proxy, a fresh C++ object) of each filter."""
    for path in sorted(XML_FOLDER.glob("*.xml")):
        for element in ElementTree.parse(path).iter("SourceProxy"):
            name = element.get("name")
            yield (name, element, getattr(simple.servermanager.filters, name)(),
                   getattr(filters, element.get("class"))())


def properties(element):
    """(proxy property name, C++ property name, element) of each property with a plain setter."""
    for child in element:
        if child.get("number_of_elements") != "1":
            continue  # vectors have setters and domains of their own
        match = re.fullmatch(r"Set(\w+)", child.get("command", ""))
        if match and child.get("number_of_elements") == "1":
            yield child.get("name"), match.group(1), child


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

    def test_ranges_agree(self):
        """Values at the ends of a range pass the setters of C++ unchanged."""
        for name, element, proxy, algorithm in proxies():
            for propertyName, member, child in properties(element):
                for end in ("min", "max"):
                    for domain in child.iter():
                        if domain.tag.endswith("RangeDomain") and domain.get(end):
                            with self.subTest(proxy=name, property=propertyName, end=end):
                                number = int if child.tag.startswith("Int") else float
                                value = number(domain.get(end))
                                getattr(algorithm, "Set" + member)(value)
                                self.assertEqual(getattr(algorithm, "Get" + member)(), value)
                                beyond = value - 1 if end == "min" else value + 1
                                getattr(algorithm, "Set" + member)(number(beyond))
                                if member not in REFUSED:
                                    self.assertEqual(getattr(algorithm, "Get" + member)(), value)

    def test_entries_agree(self):
        """The entries of an enumeration are those of C++, which clamps at its ends."""
        for name, element, proxy, algorithm in proxies():
            for propertyName, member, child in properties(element):
                entries = [int(entry.get("value")) for entry in child.iter("Entry")]
                if entries:
                    with self.subTest(proxy=name, property=propertyName):
                        getattr(algorithm, "Set" + member)(-1)
                        self.assertEqual(getattr(algorithm, "Get" + member)(), min(entries))
                        getattr(algorithm, "Set" + member)(1000)
                        self.assertEqual(getattr(algorithm, "Get" + member)(), max(entries))

    def test_every_property_is_offered(self):
        for name, element, proxy, algorithm in proxies():
            offered = {member for _, member, _ in properties(element)}
            own = set(type(algorithm).__dict__)
            settable = {member[3:] for member in own
                        if member.startswith("Set") and "G" + member[1:] in own}
            settable -= {child.get("command")[3:] for child in element
                         if child.tag == "DoubleVectorProperty" and child.get("number_of_elements") != "1"}
            with self.subTest(proxy=name):
                self.assertEqual(offered, settable)

    def test_names_in_python_are_those_of_the_xml(self):
        """paraview.simple calls a property by its label; that must give the proxy's own name."""
        for name, element, proxy, algorithm in proxies():
            for child in element:
                if child.tag.endswith("Property"):
                    with self.subTest(proxy=name, property=child.get("name")):
                        self.assertIn(child.get("name"), proxy.ListProperties())

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
