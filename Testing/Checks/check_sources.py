#!/usr/bin/env python3
"""Checks what a compiler does not: which rooms include which, and a few rules of the sources.

    check_sources.py ROOT

prints one line per violation, "path:line: what is wrong", and fails if there is any. The rules:

- the rooms of the core include downwards only (FLOORS), and never VTK; nor do its tests;
- the rooms of the adapters include downwards only (ADAPTERS), and no header of a filter;
- Core/Discretisations alone asks which discretisation a field has (DiscretisationKind::);
- no text of the core names a class of VTK, or a property or choice of the panel by a label of several words: the
  core says remedies in words of its own (Support/Remedy.h);
- the headers of the filters, which VTK's wrappers parse, include VTK and plain C++ only;
- no "using namespace" in a header;
- no two types, and no two functions with a body, of Filters have one qualified name (outside anonymous namespaces): the linker would
  take either, without a word;
- Eigen's index of all rows comes from Support/AllIndices.h alone;
- sources are ASCII;
- a property of a filter, or of its base class, is told in its header and in its proxy, or the base proxy, with one default;
- the class comment of a filter has at most COMMENT_LIMIT words, besides its tables;
- CMakeLists.txt, pyproject.toml and CITATION.cff name one version;
- every file in Data is listed, with its origin, in Data/README.md;
- in Filters, at most SUBJECTLESS_LIMIT comments begin with a clause that has no subject ("What is left over");
- no comment of Filters holds a measurement, a date, or the name of a machine or a measured surface: these stand in
  Testing/Benchmarks/README.md.

The last two are counted, and named where there are too many. With --list they are always named.
"""

import pathlib
import re
import sys
import xml.etree.ElementTree as ElementTree

# The rooms of Filters/Core and their floors: a file includes its own room and rooms of smaller floors. A room with rooms below it is the
# files that stand in it directly.
FLOORS = {
    "Support": 0,
    # A solver receives matrices and never learns that a mesh exists.
    "Solvers/Kernels": 1, "Solvers/Krylov": 1, "Solvers/Direct": 2, "Solvers/Multigrid": 3,
    "Solvers/Laplacian": 4, "Solvers/LeastSquares": 4, "Solvers": 4,
    "Mesh": 5,
    "Places": 6, "Preparation": 6, "Operators": 6, "Levels": 6,
    "Directions": 7, "Analysis": 7,
    "Constraints": 8, "Drawing": 9,
    # Unknowns: the penalties and the levels that each kind of field shares with others, and the kinds themselves.
    "Discretisations/Constraints": 9, "Discretisations/Levels": 9, "Discretisations": 10,
    # The thesis's levels. Only the top of the core and the filters come in here.
    "StructurePreserving/Decimation": 11, "StructurePreserving/Transfers": 12, "StructurePreserving/Overlay": 12, "StructurePreserving": 13,
    "Setup": 14,
    "Singularities": 15,
    # The door: fields, as users ask for them and get them. What else is computed on a surface stands beside it.
    ".": 16, "Flows": 16, "Geodesics": 16, "Scales": 17,
    "Quads/Crosses": 16, "Quads/Map": 17, "Quads/Isolines": 18, "Quads": 19,
    # The only rooms that know MPI and PETSc; nothing else of the core includes them. They give a Field, as FieldSolver does.
    "Pieces/Surface": 20, "Pieces/Constraints": 21, "Pieces/Solvers": 22, "Pieces": 23,
}
# The solver itself, which programs and filters include, and no other file of the core but those that solve for something else by it.
ENTRANCE = "FieldSolver.h"
BY_THE_ENTRANCE = {"FieldSolver", "SurfaceQuads"}

# The rooms of Filters/Adapters, lowest first: each may include itself and those before it.
ADAPTERS = ["Data", "Ranks", "Pipeline", "Surface", "View", "Input", "Output"]

# A line that asks which discretisation a field has.
ASKS_KIND = re.compile(r"\bDiscretisationKind::|Field\.Kind\s*[!=]=|[!=]=\s*[\w.]*Field\.Kind\b")

SOURCES = {".h", ".cxx"}
TEXTS = SOURCES | {".cmake", ".in", ".json", ".module", ".plugin", ".py", ".sh", ".txt", ".xml"}

COMMENT_LIMIT = 750

# A comment that begins with one of these has no subject.
SUBJECTLESS = re.compile(r"(What|Those|Where|Of|By|So|As|In|How|Which|Else)\b")
SUBJECTLESS_LIMIT = 0

MEASUREMENT = re.compile(
    r"\d (ns|us|ms|s|seconds|minutes|MB|GB)\b"
    r"|\b(times|twice) as (long|slow|fast|expensive)\b|\btimes (slower|faster)\b|\b(took|takes) .*\b(longer|less)\b"
    r"|\bof the time\b|\b20\d\d-\d\d-\d\d\b|\b(EPYC|Xeon|Ryzen|Threadripper|Intel)\b"
    r"|\b(t[0-2]\d|beetle|bunny|camelhead|cessna|cheese|fertility|igea|kitten)\b|\b(bnd|cad|genus\d+)_\w+")
MEASUREMENT_LIMIT = 0

INCLUDE = re.compile(r'^\s*#\s*include\s*["<]([^">]+)[">]')


def files(folder, suffixes):
    return sorted(path for path in folder.rglob("*") if path.suffix in suffixes and path.is_file())


def includes(path):
    """(line number, included name) of each include."""
    for number, line in enumerate(path.read_text(errors="replace").splitlines(), 1):
        match = INCLUDE.match(line)
        if match:
            yield number, match.group(1)


def check_core(root):
    core = root / "Filters" / "Core"
    for path in files(core, SOURCES):
        room = path.parent.relative_to(core).as_posix()
        if room not in FLOORS:
            yield path, 0, f"{room} has no floor in FLOORS"
            continue
        for number, name in includes(path):
            if re.match(r"vtk|Adapters/|\.\./", name):
                yield path, number, f"the core includes {name}"
            elif not room.startswith("Pieces") and re.match(r"mpi\.h|petsc|Pieces/", name):
                yield path, number, f"{name} is known in the rooms of Pieces alone"
            elif (core / name).exists():
                target = pathlib.PurePosixPath(name).parent.as_posix()
                is_for_programs = name == ENTRANCE and path.stem not in BY_THE_ENTRANCE
                if is_for_programs or target != room and FLOORS.get(target, 0) >= FLOORS[room]:
                    yield path, number, f"{room} may not include {name}"


def check_kinds(root):
    filters = root / "Filters"
    for path in files(filters, SOURCES):
        name = path.relative_to(filters).as_posix()
        if path.parent == filters / "Core" / "Discretisations":
            continue
        for number, line in enumerate(path.read_text(errors="replace").splitlines(), 1):
            if ASKS_KIND.search(line):
                yield path, number, "Core/Discretisations alone asks which discretisation a field has"


def panel_labels(root):
    """Labels of properties and choices that have several words, each with a capital: "Constraint Type"."""
    labels = set()
    for path in sorted((root / "ParaViewPlugin").glob("*.xml")):
        for element in ElementTree.parse(path).iter():
            name = element.get("name", "") if element.tag.endswith("Property") else ""
            texts = [element.get("label", ""), re.sub(r"(?<=[a-z0-9])(?=[A-Z])", " ", name)]
            texts += [element.get("text", "")] if element.tag == "Entry" else []
            labels.update(text for text in texts if re.fullmatch(r"[A-Z]\w*(( at| of)? [A-Z]\w*)+", text))
    return labels


TOKEN = re.compile(r'(?P<comment>//[^\n]*|/\*.*?\*/)|(?P<include>^[ \t]*\#[^\n]*)|"(?P<text>(?:[^"\\\n]|\\.)*)"|\'(?:[^\'\\\n]|\\.)\'',
                   re.DOTALL | re.MULTILINE)


def literals(source):
    """(line number, text) of each string literal; literals with nothing but space between them are one."""
    found, end = [], None
    for match in TOKEN.finditer(source):
        text = match.group("text")
        if text is None:
            continue
        if end is not None and not source[end:match.start()].strip():
            found[-1][1] += text
        else:
            found.append([source.count("\n", 0, match.start()) + 1, text])
        end = match.end()
    return found


def check_words_of_core(root):
    labels = panel_labels(root)
    names = re.compile("|".join([r"\bvtk[A-Z]\w*"] + [rf"\b{re.escape(label)}\b" for label in sorted(labels, reverse=True)]))
    for path in files(root / "Filters" / "Core", SOURCES):
        for number, text in literals(path.read_text(errors="replace")):
            for name in names.findall(text):
                yield path, number, f"a text of the core says {name}, a word of VTK or of the panel"


def check_adapters(root):
    adapters = root / "Filters" / "Adapters"
    filters = {path.name for path in (root / "Filters").glob("*.h")}
    for path in files(adapters, SOURCES):
        room = path.parent.relative_to(adapters).as_posix()
        if room not in ADAPTERS:
            yield path, 0, f"Adapters/{room} has no place in ADAPTERS"
            continue
        for number, name in includes(path):
            if name in filters:
                yield path, number, f"an adapter includes {name}"
            match = re.match(r"Adapters/(\w+)/", name)
            if match and ADAPTERS.index(match.group(1)) > ADAPTERS.index(room):
                yield path, number, f"Adapters/{room} may not include {name}"


def check_core_tests(root):
    for folder in ("Core", "Support", "Convergence", "Benchmarks"):
        for path in files(root / "Testing" / folder, SOURCES):
            for number, name in includes(path):
                if name.startswith("vtk"):
                    yield path, number, f"a test of the core includes {name}"


def check_filter_headers(root):
    for path in sorted((root / "Filters").glob("vtk*.h")):
        for number, name in includes(path):
            if "/" in name or name.endswith(".h") and not name.startswith("vtk"):
                yield path, number, f"a header that VTK's wrappers parse includes {name}"


def check_texts(root):
    folders = ["Filters", "Testing", "ParaViewPlugin", ".ci"]
    paths = [path for folder in folders for path in files(root / folder, TEXTS)]
    for path in paths + [root / "CMakeLists.txt", root / "CMakePresets.json"]:
        if not path.exists():
            continue
        for number, line in enumerate(path.read_bytes().splitlines(), 1):
            if not line.isascii():
                yield path, number, "not ASCII"
            if path.suffix == ".h" and re.match(rb"\s*using\s+namespace\b", line):
                yield path, number, "using namespace in a header"


SCOPE = re.compile(r"(?P<head>[^;{}]*)(?P<mark>[;{}])")
NAMESPACE = re.compile(r"\bnamespace\s*([\w:]*)\s*$")
TYPE = re.compile(r"\b(?:class|struct|union|enum(?:\s+class)?)\s+(\w+)\s*(?:final\s*)?(?::[^:].*)?$", re.DOTALL)
FUNCTION = re.compile(r"([\w:~]+)\s*\(([^()]*(?:\([^()]*\)[^()]*)*)\)[\s\w]*(?::[^:].*)?$", re.DOTALL)


def definitions(source):
    """(line number, qualified name) of each type and each function with a body that is in no class and no anonymous namespace; the
    parameters of a function belong to its name. Templates and static functions are left out."""
    text = TOKEN.sub(lambda match: re.sub(r"[^\n]", " ", match.group()), source)
    text = re.sub(r"^[ \t]*#(?:.*\\\n)*.*$", lambda match: "\n" * match.group().count("\n"), text, flags=re.MULTILINE)
    scopes = []  # the name of a namespace, None of anything else
    for match in SCOPE.finditer(text):
        head, mark = match.group("head", "mark")
        space = NAMESPACE.search(head)
        if mark == "}":
            del scopes[-1:]
        elif mark == "{":
            found = TYPE.search(head) or FUNCTION.search(head)
            if found and not space and all(scopes) and not re.search(r"\b(static|template)\b", head):
                name = "::".join([*scopes, found.group(1)])
                parameters = " ".join(found.group(2).split()) if found.re is FUNCTION else None
                number = text.count("\n", 0, match.start() + found.start(1)) + 1
                yield number, name if parameters is None else f"{name}({parameters})"
            scopes.append(space.group(1) if space else None)


def check_names(root):
    known = {}
    for path in files(root / "Filters", SOURCES):
        for number, name in definitions(path.read_text(errors="replace")):
            if known.setdefault(name, path) != path:  # one file may have two, one for each platform
                yield path, number, f"{name} is defined in {known[name].relative_to(root)}, too"


def check_all_indices(root):
    home = root / "Filters" / "Core" / "Support" / "AllIndices.h"
    for folder in ("Filters", "Testing"):
        for path in files(root / folder, SOURCES):
            for number, line in enumerate(path.read_text(errors="replace").splitlines(), 1):
                if path != home and re.search(r"\bEigen::(placeholders::)?all\b", line):
                    yield path, number, "Eigen::all is not in every release; take All of Support/AllIndices.h"


VERSIONS = {"CMakeLists.txt": r"^\s*VERSION (\S+)$", "pyproject.toml": r'^version = "(.*)"$', "CITATION.cff": r"^version: (\S+)$"}


def check_versions(root):
    first = None
    for name, pattern in VERSIONS.items():
        path = root / name
        found = re.search(pattern, path.read_text(), re.MULTILINE) if path.exists() else None
        if found and found.group(1) != (first or found.group(1)):
            yield path, 0, f"version {found.group(1)}, which is {first} in CMakeLists.txt"
        first = first or (found and found.group(1))


def check_data(root):
    data = root / "Data"
    paths = [path for path in data.rglob("*") if path.is_file() and path.name != "README.md"]
    listed = (data / "README.md").read_text() if (data / "README.md").exists() else ""
    for path in sorted(paths):
        name = path.relative_to(data).as_posix()
        if f"`{name}`" not in listed:
            yield path, 0, f"Data/README.md does not list `{name}` and its origin"


def documented_setters(header):
    """(line number, property, its comment) of each setter of a wrapped header: a comment tells the setters up to the next."""
    comment, number = "", 0
    for number, line in enumerate(header.splitlines(), 1):
        if line.strip().startswith("/**"):
            comment = ""
        if line.strip().startswith(("/**", "*")):
            comment += " " + line.strip(" /*")
        match = re.match(r"\s*(?:vtkSet\w*Macro\((\w+)|void Set(\w+)\([^,]*\))", line)
        if match:
            yield number, match.group(1) or match.group(2), comment
        elif line.strip() == "///@}" or line.strip() == "":
            comment = comment if line.strip() else ""


def headers_of_filter(root, name):
    """The header of a filter, and those of its abstract base classes."""
    header = root / "Filters" / f"{name}.h"
    while header.exists():
        yield header
        base = re.search(r"TypeMacro\(\w+, (\w+)\)", header.read_text())
        header = root / "Filters" / f"{base.group(1)}.h" if base else root / "none"
        if header.exists() and "vtkAbstractTypeMacro" not in header.read_text():
            return


def properties_of_proxy(proxy, proxies):
    """The properties of a proxy, and those of its base, by their C++ names, whose setters for the panel may end with OfPanel."""
    base = proxies.get(proxy.get("base_proxyname", ""))
    properties = {} if base is None else properties_of_proxy(base, proxies)
    properties.update((child.get("command")[3:].removesuffix("OfPanel"), child) for child in proxy if child.get("command", "").startswith("Set"))
    return properties


def check_properties(root):
    """Each plain setter has a comment and a property of the proxy with a Documentation, and the defaults are the same."""
    panels = {path: list(ElementTree.parse(path).iter("SourceProxy")) for path in sorted((root / "ParaViewPlugin").glob("*.xml"))}
    proxies = {proxy.get("name"): proxy for panel in panels.values() for proxy in panel}
    for path, panel in panels.items():
        for proxy in panel:
            if proxy.get("base_proxygroup") == "filters":  # another filter with other defaults
                continue
            told = properties_of_proxy(proxy, proxies)
            setters = [(header, *setter) for header in headers_of_filter(root, proxy.get("class"))
                       for setter in documented_setters(header.read_text())]
            for header, number, name, comment in setters:
                element = told.get(name)
                default = re.search(r"\b[Dd]efault (-?\d[\d.e-]*\d|\d)\b", comment)
                if not comment.strip():
                    yield header, number, f"{name} is not told"
                elif element is None:
                    yield header, number, f"{name} is no property of {path.name}"
                elif not (element.findtext("Documentation") or "").strip():
                    yield path, 0, f"{element.get('name')} is not told"
                elif default and float(default.group(1)) != float(element.get("default_values", "nan")):
                    yield header, number, f"{name} has another default in {path.name}"


def check_class_comments(root):
    for path in sorted((root / "Filters").glob("vtk*.h")):
        comment = re.sub(r"(?m)^ \* \|.*$", "", path.read_text().split("*/", 1)[0])
        count = len(re.findall(r"[^\s*|/-]\S*", comment))
        if count > COMMENT_LIMIT:
            yield path, 1, f"a class comment of {count} words, of at most {COMMENT_LIMIT}"


def comments(path):
    """(line number, text) of each line of comments; the text is None where a line has none."""
    inside = False
    for number, line in enumerate(path.read_text(errors="replace").splitlines(), 1):
        line = line.strip()
        if inside:
            inside = "*/" not in line
            yield number, line.split("*/")[0].lstrip("* ")
        elif line.startswith("/*"):
            inside = "*/" not in line
            yield number, line.split("*/")[0].lstrip("/*! ")
        else:
            match = re.search(r"(?<![:\"])//+[!<]*\s*(.*)", line)
            yield number, match and match.group(1)


def openings(path):
    """(line number, first line) of each comment, which may be a block or lines without code between them."""
    begun = False
    for number, text in comments(path):
        if text is None:
            begun = False
        elif text and not begun:
            begun = True
            yield number, re.sub(r"^[@\\](brief|name|return)\s+", "", text)


def subjectless_comments(root):
    for path in files(root / "Filters", SOURCES):
        for number, text in openings(path):
            if SUBJECTLESS.match(text):
                yield path, number, f"a comment without a subject: {text}"


def measurements(root):
    for path in files(root / "Filters", SOURCES):
        for number, text in comments(path):
            match = MEASUREMENT.search(text or "")
            if match:
                yield path, number, f"a measurement in a comment: {match.group(0)}"


CHECKS = [check_core, check_kinds, check_words_of_core, check_adapters, check_core_tests, check_filter_headers, check_texts, check_properties,
          check_class_comments, check_data, check_names, check_all_indices,
          check_versions]
COUNTED = [("comments without a subject", subjectless_comments, SUBJECTLESS_LIMIT),
           ("measurements in comments", measurements, MEASUREMENT_LIMIT)]


def listed(root, check):
    return [f"{path.relative_to(root)}:{number}: {message}" for path, number, message in check(root)]


def violations(root):
    for check in CHECKS:
        yield from listed(root, check)
    for name, check, limit in COUNTED:
        found = listed(root, check)
        if len(found) > limit:
            yield from found
            yield f"{len(found)} {name}, of at most {limit}"


def main():
    root = pathlib.Path(sys.argv[1]).resolve()
    for name, check, limit in COUNTED:
        found = listed(root, check)
        if "--list" in sys.argv:
            print("\n".join(found))
        print(f"{len(found)} {name}, of at most {limit}")
    found = list(violations(root))
    print("\n".join(found) if found else "no violations")
    return 1 if found else 0


if __name__ == "__main__":
    sys.exit(main())
