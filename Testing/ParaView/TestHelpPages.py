"""The pages that `?` opens: one per filter, with a picture and a row for each property; and every link leads somewhere.

    TestHelpPages.py FOLDER-OF-PAGES FOLDER-OF-XML
"""

import html
import pathlib
import re
import sqlite3
import sys
import unittest
from xml.etree import ElementTree

from vtkmodules.vtkIOImage import vtkImageReader2Factory

PAGES, XML = map(pathlib.Path, sys.argv[1:3])
del sys.argv[1:]


def proxies():
    """Those of the Filters menu: their elements."""
    for path in sorted(XML.glob("*.xml")):
        for group in ElementTree.parse(path).getroot():
            yield from (proxy for proxy in group if proxy.find("Hints/ShowInMenu") is not None)


class HelpPages(unittest.TestCase):
    def test_a_page_per_filter(self):
        self.assertGreaterEqual(len(list(proxies())), 8)
        for proxy in proxies():
            with self.subTest(proxy.get("name")):
                text = (PAGES / f"filters.{proxy.get('name')}.html").read_text()
                for part in (f"<h1>{proxy.get('label')}</h1>", "<img ", "<h2>When to use it</h2>", "<h2>Limits", "ources</h2>" if proxy.tag == "SourceProxy" else ""):
                    self.assertIn(part, text)

    def test_a_row_per_property(self):
        bases = {proxy.get("name"): proxy for path in XML.glob("*.xml")
                 for proxy in ElementTree.parse(path).iterfind("ProxyGroup[@name='internal_filters']/SourceProxy")}
        for proxy in proxies():
            text = html.unescape((PAGES / f"filters.{proxy.get('name')}.html").read_text())
            for child in [*proxy, *bases.get(proxy.get("base_proxyname"), ())]:
                if child.tag.endswith("VectorProperty"):
                    self.assertIn(f"<th>{child.get('label')}</th>", text, proxy.get("name"))
            for exposed in proxy.findall("ExposedProperties/Property"):
                self.assertRegex(text, f"<(th|i)>{exposed.get('exposed_name')}</(th|i)>", proxy.get("name"))

    def test_tables_are_ascii(self):
        """The window takes pages for Latin-1."""
        for page in [*PAGES.glob("filters.*.html"), *PAGES.glob("writers.*.html")]:
            page.read_text(encoding="ascii")

    def test_contents_are_labels(self):
        """The window's list of contents has the titles of pages: those of the menu, each once."""
        titles = [re.search("<title>(.*)</title>", page.read_text()).group(1) for page in PAGES.glob("*.html")]
        self.assertEqual(len(titles), len(set(titles)), sorted(titles))
        for proxy in proxies():
            self.assertIn(proxy.get("label"), titles)
        for title in titles:
            self.assertNotRegex(title, "[a-z][A-Z]")

    def test_pictures_have_the_size_that_they_are_shown_in(self):
        """The window would scale them roughly."""
        for path in PAGES.glob("*.html"):
            for name, *shown in re.findall(r'<img src="([^"]+)" width="(\d+)" height="(\d+)"', path.read_text()):
                reader = vtkImageReader2Factory.CreateImageReader2(str(PAGES / name))
                reader.SetFileName(str(PAGES / name))
                reader.Update()
                self.assertEqual(reader.GetOutput().GetDimensions()[:2], tuple(map(int, shown)), f"{path.name}: {name}")

    def test_links(self):
        for path in [*PAGES.glob("*.html"), *PAGES.glob("*.md")]:
            text = path.read_text()
            links = re.findall(r'(?:src|href)="([^":]+)"', text) + re.findall(r"!\[[^]]*\]\(([^):]+)\)", text)
            for link in links:
                self.assertTrue((PAGES / link.split("#")[0]).is_file(), f"{path.name}: {link}")

    def test_the_help_file_has_them(self):
        """What the plugin carries is an SQLite file of Qt."""
        with sqlite3.connect(PAGES / "DirectionalMultigrid.qch") as database:
            names = {row[0] for row in database.execute("SELECT Name FROM FileNameTable")}
        for name in ["DirectionalFields.html", "SeveralRanks.html", "PowerField.md", *(f"filters.{proxy.get('name')}.html" for proxy in proxies())]:
            self.assertIn(name, {pathlib.PurePath(name).name for name in names})


if __name__ == "__main__":
    unittest.main()
