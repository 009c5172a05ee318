"""Installs the package by pip into a virtual environment, as CONTRIBUTING says, and uses it there.

    pip_install.py source folder cmake_prefix_path

Exits with 77, which means skipped, where Python has no scikit-build-core or cannot make environments.
"""

import importlib.util
import os
import shutil
import subprocess
import sys

SKIPPED = 77

USE = """
import importlib.metadata
import sys
from vtkmodules.vtkFiltersSources import vtkSphereSource
import directionalmultigrid

assert directionalmultigrid.__file__.startswith(sys.prefix), directionalmultigrid.__file__
sphere = vtkSphereSource()
sphere.SetThetaResolution(20)
sphere.SetPhiResolution(20)
sphere.Update()
field = directionalmultigrid.smooth_field(sphere.GetOutput(), n=4)
indices = field.GetCellData().GetArray("SingularityIndex")
assert abs(sum(indices.GetValue(k) for k in range(indices.GetNumberOfTuples())) - 2) < 1e-12
assert importlib.metadata.version("directionalmultigrid")
names = [point.value for point in importlib.metadata.entry_points(group="pyvista.accessors") if point.name == "directional"]
assert names[0] == "directionalmultigrid.pyvista_accessor", names
loaded = {line.split()[-1] for line in open("/proc/self/maps") if "FiltersDirectionalFields" in line}
assert len(loaded) == 2 and all(path.startswith(sys.prefix) for path in loaded), loaded  # the module and its wrapping
try:
    import pyvista
    has_accessors = hasattr(pyvista, "register_dataset_accessor")
except ImportError:
    has_accessors = False
if has_accessors:
    crosses = pyvista.Sphere().directional.cross_field()
    assert "Direction0" in crosses.point_data, crosses
print("a field was computed" + (", and one by PyVista's accessor" if has_accessors else "; there is no PyVista with accessors"))
"""


def main():
    source, folder, prefix_path = sys.argv[1:]
    missing = [name for name in ("scikit_build_core", "ensurepip", "pip") if not importlib.util.find_spec(name)]
    if missing:
        print("pip install . is NOT tested: this Python has no", " and no ".join(missing))
        return SKIPPED
    environment = os.path.join(folder, "environment")
    shutil.rmtree(environment, ignore_errors=True)
    subprocess.run([sys.executable, "-m", "venv", "--system-site-packages", environment], check=True)
    python = os.path.join(environment, "bin", "python")
    settings = {"build-dir": os.path.join(folder, "build"), "cmake.define.CMAKE_PREFIX_PATH": prefix_path}
    settings.update({f"cmake.define.CMAKE_{language}_COMPILER_LAUNCHER": "ccache" for language in ("C", "CXX") if shutil.which("ccache")})
    subprocess.run([python, "-m", "pip", "install", "--no-index", "--no-build-isolation", "--no-deps",
                    *(f"--config-settings={name}={value}" for name, value in settings.items()), source], check=True)
    subprocess.run([python, "-c", USE], check=True, cwd=folder)
    return 0


sys.exit(main())
