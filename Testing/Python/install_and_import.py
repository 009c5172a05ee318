"""Installs the build tree below a prefix, as README says, and imports the filters from there.

    install_and_import.py cmake build prefix python_destination
"""

import os
import shutil
import subprocess
import sys

IMPORT = """
import sys
from directionalmultigrid.vtkFiltersDirectionalFields import vtkHarmonicFieldSolver
assert vtkHarmonicFieldSolver().GetNumberOfDirections() == 4
import importlib.metadata
import directionalmultigrid
assert importlib.metadata.version("directionalmultigrid")
names = [point.value for point in importlib.metadata.entry_points(group="pyvista.accessors") if point.name == "directional"]
assert names[0] == "directionalmultigrid.pyvista_accessor", names
for name in directionalmultigrid.__all__:
    print(getattr(directionalmultigrid, name).__name__, file=sys.stderr)
for line in open("/proc/self/maps"):
    if "FiltersDirectionalFields" in line:
        print(line.split()[-1])
"""


def main():
    cmake, build, prefix, destination = sys.argv[1:]
    shutil.rmtree(prefix, ignore_errors=True)
    subprocess.run([cmake, "--install", build, "--prefix", prefix], check=True, stdout=subprocess.DEVNULL)
    environment = dict(os.environ, PYTHONPATH=os.pathsep.join(
        [os.path.join(prefix, destination)] + os.environ.get("PYTHONPATH", "").split(os.pathsep)))
    done = subprocess.run([sys.executable, "-c", IMPORT], env=environment, check=True, text=True, stdout=subprocess.PIPE)
    loaded = set(done.stdout.split())
    assert len(loaded) == 2, loaded  # the module and its wrapping
    for path in loaded:
        assert os.path.realpath(path).startswith(os.path.realpath(prefix) + os.sep), path


main()
