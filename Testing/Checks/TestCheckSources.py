"""Each rule of check_sources.py finds what breaks it, and a tree that keeps them all passes."""

import pathlib
import tempfile
import unittest

import check_sources

CLEAN = {
    "CMakeLists.txt": "project(Clean)\n",
    "Data/README.md": "| `plane.ply` | made by Testing/Support |\n",
    "Data/plane.ply": "ply\n",
    "Filters/vtkFilter.h": '#include "vtkPolyDataAlgorithm.h"\n#include <memory>\n',
    "Filters/Core/FieldSolver.h": '#include "Discretisations/Field.h"\n#include "Solvers/Solver.h"\n',
    "Filters/Core/Support/Types.h": "#include <Eigen/Core>\n",
    "Filters/Core/Mesh/Mesh.h": '#include "Support/Types.h"\n',
    "Filters/Core/Discretisations/Field.h": '#include "Mesh/Mesh.h"\n',
    "Filters/Core/Solvers/Solver.h": '#include "Support/Types.h"\n',
    "Testing/Core/TestMesh.cxx": '#include "Mesh/Mesh.h"\n',
}


class CheckSources(unittest.TestCase):
    def found(self, changes={}):
        """Violations of the clean tree with some files replaced or added."""
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder).resolve()
            for name, text in {**CLEAN, **changes}.items():
                (root / name).parent.mkdir(parents=True, exist_ok=True)
                (root / name).write_text(text, encoding="utf-8")
            return list(check_sources.violations(root))

    def test_clean_tree_passes(self):
        self.assertEqual(self.found(), [])

    def assert_found(self, name, text, message):
        self.assertEqual(self.found({name: text}), [f"{name}:{message}"])

    def test_core_without_vtk(self):
        self.assert_found("Filters/Core/Mesh/Mesh.h", "#include <vtkPolyData.h>\n",
                          "1: the core includes vtkPolyData.h")

    def test_core_tests_without_vtk(self):
        self.assert_found("Testing/Core/TestMesh.cxx", '\n#include "vtkNew.h"\n',
                          "2: a test of the core includes vtkNew.h")

    def test_arrows_point_downwards(self):
        self.assert_found("Filters/Core/Mesh/Mesh.h", '#include "Discretisations/Field.h"\n',
                          "1: Mesh may not include Discretisations/Field.h")

    def test_solvers_know_no_mesh(self):
        self.assert_found("Filters/Core/Solvers/Solver.h", '#include "Mesh/Mesh.h"\n',
                          "1: Solvers may not include Mesh/Mesh.h")

    def test_only_the_top_sees_the_top(self):
        self.assert_found("Filters/Core/Mesh/Mesh.h", '#include "FieldSolver.h"\n',
                          "1: Mesh may not include FieldSolver.h")

    def test_discretisations_alone_know_their_kinds(self):
        message = "1: Core/Discretisations alone asks which discretisation a field has"
        for line in ("if (kind == DiscretisationKind::OneForm)", "if (a.Field.Kind == b.Field.Kind)"):
            self.assert_found("Filters/Core/Mesh/Mesh.h", line + "\n", message)
            self.assert_found("Filters/Core/Discretisations/Levels/Level.h", line + "\n", message)
            self.assertEqual(self.found({"Filters/Core/Discretisations/Field.h": line + "\n"}), [])

    def test_rooms_below_the_kinds_of_fields_do_not_see_these(self):
        for room in ("Constraints", "Levels"):
            self.assert_found(f"Filters/Core/Discretisations/{room}/Part.h", '#include "Discretisations/Field.h"\n',
                              f"1: Discretisations/{room} may not include Discretisations/Field.h")

    def test_operators_do_not_see_directions(self):
        changes = {"Filters/Core/Directions/Signs.h": "", "Filters/Core/Operators/Matrix.h": '#include "Directions/Signs.h"\n'}
        self.assertEqual(self.found(changes), ["Filters/Core/Operators/Matrix.h:1: Operators may not include Directions/Signs.h"])

    def test_new_folder_needs_a_place(self):
        self.assertEqual(self.found({"Filters/Core/Odds/Ends.h": ""}),
                         ["Filters/Core/Odds/Ends.h:0: Odds has no floor in FLOORS"])

    def test_rooms_below_the_door_do_not_see_it(self):
        wrong = {"Singularities/Stages.h": "FieldSolver.h", "Pieces/Piece.h": "FieldSolver.h", "Setup/Cache.h": "FieldProblem.h",
                 "FieldProblem.h": "Flows/Flow.h"}
        for name, included in wrong.items():
            changes = {"Filters/Core/FieldProblem.h": "", "Filters/Core/Flows/Flow.h": "",
                       f"Filters/Core/{name}": f'#include "{included}"\n'}
            room = pathlib.PurePosixPath(name).parent.as_posix()
            self.assertEqual(self.found(changes), [f"Filters/Core/{name}:1: {room} may not include {included}"])

    def words_of_core(self, text):
        panel = """<P><IntVectorProperty name="ConstraintType"><Entry text="Power Field at Points"/></IntVectorProperty>
          <IntVectorProperty name="N" label="Number Of Directions"/><DoubleVectorProperty name="Weight"/></P>"""
        return self.found({"ParaViewPlugin/Filter.xml": panel, "Filters/Core/Mesh/Mesh.cxx": text})

    def test_core_has_words_of_its_own(self):
        wrong = {'f("apply vtkCleanPolyData");': "vtkCleanPolyData",
                 'f("set Constraint Type to Soft");': "Constraint Type",
                 'f("set Constraint "\n  "Type to Soft");': "Constraint Type",
                 'f(\'"\', "the Number Of Directions");': "Number Of Directions",
                 'f("\\"quoted\\" Number Of Directions");': "Number Of Directions",
                 'f("http://a", "choose Power Field at Points");': "Power Field at Points"}
        for text, name in wrong.items():
            self.assertEqual(self.words_of_core(text),
                             [f"Filters/Core/Mesh/Mesh.cxx:1: a text of the core says {name}, a word of VTK or of the panel"])
        right = ['f("the constraint type, N, Weight");', '// "Constraint Type" of vtkFilter', 'f("a"); // "Constraint Type"',
                 '/* "Constraint Type"\n "vtkFilter" */', 'f("Constraint ", "Type");', 'f("vtk", "an ovtkA");',
                 'f("Constraint Types");']
        for text in right:
            self.assertEqual(self.words_of_core(text), [], text)

    def test_adapters_include_downwards(self):
        self.assert_found("Filters/Adapters/Surface/Mesh.h", '#include "Adapters/Output/Arrays.h"\n',
                          "1: Adapters/Surface may not include Adapters/Output/Arrays.h")

    def test_adapters_know_no_filter(self):
        self.assert_found("Filters/Adapters/Surface/Mesh.h", '#include "vtkFilter.h"\n', "1: an adapter includes vtkFilter.h")

    def test_new_room_of_adapters_needs_a_place(self):
        self.assert_found("Filters/Adapters/Odds/Ends.h", "", "0: Adapters/Odds has no place in ADAPTERS")

    def test_wrapped_headers_are_plain(self):
        self.assert_found("Filters/vtkFilter.h", "#include <Eigen/Core>\n",
                          "1: a header that VTK's wrappers parse includes Eigen/Core")

    def test_no_using_namespace_in_headers(self):
        self.assert_found("Filters/Core/Mesh/Mesh.h", "using namespace std;\n",
                          "1: using namespace in a header")

    def test_ascii(self):
        self.assert_found("Testing/Core/TestMesh.cxx", "// \u03bb\n", "1: not ASCII")

    def test_two_of_one_name(self):
        first, second = "Filters/Core/Mesh/Mesh.h", "Filters/Core/Support/Types.h"
        for text, name in (("namespace dmg\n{\nclass Line\n{\n  int A;\n};\n}\n", "3: dmg::Line"),
                           ("namespace dmg\n{\n// struct\nstruct Line final : Base\n{\n};\n}\n", "4: dmg::Line"),
                           ("namespace dmg::test\n{\nenum class Kind\n{\n  A\n};\n}\n", "3: dmg::test::Kind"),
                           ("namespace dmg\n{\ninline int\nLength(const Line& line)\n{\n  return 1;\n}\n}\n",
                            "4: dmg::Length(const Line& line)")):
            self.assertEqual(self.found({first: text, second: text}), [f"{second}:{name} is defined in {first}, too"])
            hidden = text.replace("namespace", "namespace\n{\nnamespace", 1) + "}\n"
            self.assertEqual(self.found({first: text, second: hidden}), [])
        different = ("namespace dmg\n{\nclass Line;\nint Length(const Line&);\nstruct A\n{\n  struct Line\n  {\n  };\n};\n}\n",
                     "namespace dmg\n{\nclass Line\n{\n};\ninline int Length(int line)\n{\n  return line;\n}\n}\n")
        self.assertEqual(self.found(dict(zip((first, second), different))), [])

    def test_all_indices_by_one_name(self):
        self.assert_found("Testing/Core/TestMesh.cxx", "a = b(c, Eigen::all);\n",
                          "1: Eigen::all is not in every release; take All of Support/AllIndices.h")

    def test_one_version(self):
        changes = {"CMakeLists.txt": "project(Clean\n  VERSION 1.2.0\n", "pyproject.toml": 'version = "1.2.0"\n',
                   "CITATION.cff": "version: 1.3.0\n"}
        self.assertEqual(self.found(changes), ["CITATION.cff:0: version 1.3.0, which is 1.2.0 in CMakeLists.txt"])

    def test_data_have_an_origin(self):
        self.assert_found("Data/torus.ply", "ply\n",
                          "0: Data/README.md does not list `torus.ply` and its origin")

    HEADER = """/** @class vtkFilter */
  ///@{
  /** How far it goes. Default 0.5, at least 0. */
  vtkSetMacro(Reach, double);
  vtkGetMacro(Reach, double);
  ///@}
"""
    PROXY = """<P><SourceProxy class="vtkFilter"><DoubleVectorProperty name="Reach" command="SetReach"
  number_of_elements="1" default_values="0.5"><Documentation>How far.</Documentation></DoubleVectorProperty></SourceProxy></P>
"""

    def properties(self, header, proxy):
        return self.found({"Filters/vtkFilter.h": header, "ParaViewPlugin/Filter.xml": proxy})

    def test_properties_are_told_twice_with_one_default(self):
        self.assertEqual(self.properties(self.HEADER, self.PROXY), [])
        self.assertEqual(self.properties(self.HEADER.replace("0.5", "0.25"), self.PROXY),
                         ["Filters/vtkFilter.h:4: Reach has another default in Filter.xml"])
        self.assertEqual(self.properties(self.HEADER, self.PROXY.replace("How far.", "")),
                         ["ParaViewPlugin/Filter.xml:0: Reach is not told"])
        self.assertEqual(self.properties(self.HEADER, self.PROXY.replace("SetReach", "SetLength")),
                         ["Filters/vtkFilter.h:4: Reach is no property of Filter.xml"])
        self.assertEqual(self.properties("/** @class vtkFilter */\n\n  vtkSetMacro(Reach, double);\n", self.PROXY),
                         ["Filters/vtkFilter.h:3: Reach is not told"])

    def test_properties_of_base_classes_are_those_of_base_proxies(self):
        names = {"Filters/vtkBase.h": self.HEADER.replace("*/", "*/\nvtkAbstractTypeMacro(vtkBase, vtkAlgorithm);\n", 1),
                 "Filters/vtkFilter.h": "/** @class vtkFilter */\nvtkTypeMacro(vtkFilter, vtkBase);\n"}
        proxy = '<SourceProxy class="vtkFilter" base_proxygroup="bases" base_proxyname="Base"></SourceProxy>'
        base = self.PROXY.replace("<P>", "<P>" + proxy).replace('class="vtkFilter"><', 'name="Base"><')

        def found(proxies):
            return self.found({**names, "ParaViewPlugin/Filter.xml": proxies})

        self.assertEqual(found(base), [])
        self.assertEqual(found(base.replace("SetReach", "SetLength")), ["Filters/vtkBase.h:6: Reach is no property of Filter.xml"])
        self.assertEqual(found(base.replace('"0.5"', '"2"')), ["Filters/vtkBase.h:6: Reach has another default in Filter.xml"])
        self.assertEqual(found(base.replace('base_proxyname="Base"', "")),
                         ["Filters/vtkBase.h:6: Reach is no property of Filter.xml"])

    def test_class_comments_are_short(self):
        limit = check_sources.COMMENT_LIMIT
        self.assertEqual(self.found({"Filters/vtkFilter.h": "/**\n" + " * one two\n" * (limit // 2) + " */\n"}), [])
        self.assert_found("Filters/vtkFilter.h", "/**\n" + " * one two\n" * (limit // 2 + 1) + " */\n",
                          f"1: a class comment of {2 * (limit // 2) + 2} words, of at most {limit}")

    def test_comments_without_a_subject(self):
        wrong = ["// What is left over.\n", "/// Those of\n/// the edges.\n", "/**\n * Where it ends.\n */\n",
                 "/** @brief   By name. */\n", "int x; ///< As before.\n", "/// \\return Which one.\n",
                 "// Of all.\n", "// So it ends.\n", "// In that case nothing.\n", "// How many.\n"]
        right = ["// The rest.\n", "// A line,\n// What follows is not the opening.\n", "/** Edges. */\n",
                 'auto page = "https://What.org";\n', "/// Inside of it.\n", "/// \\return a face.\n"]
        for text in wrong:
            self.assertEqual(len(self.subjectless(text)), 1, text)
        for text in right:
            self.assertEqual(self.subjectless(text), [], text)

    def test_too_many_comments_without_a_subject(self):
        limit = check_sources.SUBJECTLESS_LIMIT
        self.assertEqual(self.found({"Filters/vtkFilter.cxx": "// What.\n\n" * limit}), [])
        found = self.found({"Filters/vtkFilter.cxx": "// What.\n\n" * (limit + 1)})
        self.assertEqual(found[0], "Filters/vtkFilter.cxx:1: a comment without a subject: What.")
        self.assertEqual(found[-1], f"{limit + 1} comments without a subject, of at most {limit}")

    def test_too_many_measurements(self):
        limit = check_sources.MEASUREMENT_LIMIT
        for text in ("/// Cost: 3 us per face.", "/// It takes twice as long.", "int n; ///< 12 on t02, 9 elsewhere",
                     "/** On a Xeon. */", "// Seen on 2026-11-26."):
            for name in ("Mesh.h", "Mesh.cxx"):
                found = self.found({f"Filters/Core/Mesh/{name}": (text + "\n") * (limit + 1)})
                self.assertEqual(len(found), limit + 2, text)
        self.assertEqual(self.found({"Filters/Core/Mesh/Mesh.h": "/// Cost: linear.\n" * (limit + 1),
                                     "Filters/Core/Mesh/Mesh.cxx": "const char* date = \"2026-11-26\";\n"}), [])

    def subjectless(self, text):
        with tempfile.TemporaryDirectory() as folder:
            root = pathlib.Path(folder).resolve()
            (root / "Filters").mkdir()
            (root / "Filters" / "Mesh.h").write_text(text, encoding="utf-8")
            return list(check_sources.subjectless_comments(root))


if __name__ == "__main__":
    unittest.main()
