"""Runs the blocks of code in pages as they are printed.

    TestReadme.py shell BINARY_FOLDER PAGE...     commands: the files, presets and packages that they name exist
    TestReadme.py python PAGE...                  Python with VTK, in this interpreter
    TestReadme.py paraview PAGE...                the same for blocks that import ParaView's modules
    TestReadme.py cxx CMAKE PREFIXES PAGE...      a program and its CMakeLists.txt, built against PREFIXES and run

The blocks of one page and language share their names. Each picture that they write has to show something.
"""

import glob
import json
import os
import pathlib
import re
import subprocess
import sys
import tempfile

ROOT = pathlib.Path(__file__).resolve().parents[2]
PACKAGES = {"apt install ./directionalmultigrid_*.deb"}  # made by the line before


def blocks(page, language):
    """The fenced blocks of a page in a language."""
    text = pathlib.Path(page).read_text(encoding="utf-8")
    return re.findall(rf"^```{language}\n(.*?)^```$", text, re.MULTILINE | re.DOTALL)


def presets(kind):
    return {preset["name"] for preset in json.loads((ROOT / "CMakePresets.json").read_text())[kind]}


def check_command(line, binary):
    """Raises where a command names what does not exist."""
    line = re.sub(r"^sudo ", "", line)
    for pattern in re.findall(r"\bbuild/default[^\s)]*", line):
        assert glob.glob(pattern.replace("build/default", binary)), f"{pattern} does not exist"
    words = line.split()
    if words[0] == "cmake":
        for kind, names in (("buildPresets", re.findall(r"--build --preset (\S+)", line)),
                            ("configurePresets", re.findall(r"cmake --preset (\S+)", line))):
            assert set(names) <= presets(kind), f"{line}: no such preset"
    elif words[0].startswith("PV_PLUGIN_PATH="):
        assert line.endswith(") paraview --state=demo.pvsm"), line
        written = set(re.findall(r'"(demo\.\w+)"', (ROOT / "Testing/Examples/demo.py").read_text()))
        assert "demo.pvsm" in written, "the demo writes another file"
        ignored = (ROOT / ".gitignore").read_text().split()
        assert all(f"/{name}" in ignored for name in written | {"demo.png"}), "git sees what the demo writes"
    elif words[0] == "cpack" or line in PACKAGES:
        pass
    else:
        assert os.access(ROOT / words[0], os.X_OK), f"{words[0]} is no program of this project"


def check_shell(binary, pages):
    lines = [line for page in pages for block in blocks(page, "sh") for line in block.splitlines()]
    for line in lines:
        check_command(line, binary)
    return len(lines)


def check_pictures(code):
    """Each PNG that the code names was written, and has more than one colour; where there is a stroke, it is seen in gold."""
    from vtkmodules.util.numpy_support import vtk_to_numpy
    from vtkmodules.vtkIOImage import vtkPNGReader
    for name in re.findall(r"[\w.]+\.png", code):
        reader = vtkPNGReader()
        reader.SetFileName(name)
        reader.Update()
        colours = reader.GetOutput().GetPointData().GetScalars()
        assert colours and colours.GetRange(0)[0] < colours.GetRange(0)[1], f"{name} shows nothing"
        if "stroke" in code:
            red, green, blue = vtk_to_numpy(colours)[:, :3].astype(int).T
            gold = (red > 1.3 * green) & (green > 2 * blue) & (red > 150)
            assert len(red) >= 1200 * 1200 and gold.sum() > 600, f"{name} shows no stroke"


def run_python(pages, with_paraview):
    count = 0
    for page in pages:
        names = {"__name__": "__main__"}
        of_paraview = False
        for code in blocks(page, "python"):
            if "import" in code:  # one without goes on from the block before
                of_paraview = "from paraview" in code
            if of_paraview == with_paraview:
                exec(compile(code, str(page), "exec"), names)
                check_pictures(code)
                count += 1
    return count


def run_cxx(cmake, prefixes, pages):
    count = 0
    for page in pages:
        for project, source in zip(blocks(page, "cmake"), blocks(page, "cpp")):
            program = re.search(r"add_executable\((\w+) (\w+\.cxx)\)", project)
            pathlib.Path("CMakeLists.txt").write_text(project)
            pathlib.Path(program.group(2)).write_text(source)
            subprocess.run([cmake, "-S", ".", "-B", "build", "-G", "Ninja", "-DCMAKE_BUILD_TYPE=Release",
                            f"-DCMAKE_PREFIX_PATH={prefixes}"], check=True)
            subprocess.run([cmake, "--build", "build"], check=True)
            subprocess.run([pathlib.Path("build").resolve() / program.group(1)], check=True)
            check_pictures(source)
            count += 1
    return count


def main():
    how, *rest = sys.argv[1:]
    pages = [pathlib.Path(page).resolve() for page in rest if page.endswith(".md")]
    with tempfile.TemporaryDirectory() as folder:
        os.chdir(folder)
        if how == "shell":
            count = check_shell(rest[0], pages)
        elif how == "cxx":
            count = run_cxx(rest[0], rest[1], pages)
        else:
            count = run_python(pages, how == "paraview")
        os.chdir(ROOT)
    assert count > 0, "the pages have no such block"
    print(f"{count} blocks or commands of {len(pages)} pages")


if __name__ == "__main__":
    main()
