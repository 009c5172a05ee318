"""What demo.pvsm shows in ParaView's window: the surface of demo.vtp, blue lines on it, and balls in the colours of their signs.

    TestDemoState.py PARAVIEW

in the folder where the demo has run. The window is opened as README.md says, and its picture is looked at.
"""

import subprocess
import sys
import time

import numpy as np
from vtkmodules.util.numpy_support import vtk_to_numpy
from vtkmodules.vtkIOImage import vtkPNGReader

PICTURE = "demo-window.png"


def missing():
    """The parts of the scene that the screen does not show."""
    subprocess.run(["import", "-window", "root", f"png24:{PICTURE}"], check=True)  # in colours, also while the screen is black
    reader = vtkPNGReader()
    reader.SetFileName(PICTURE)
    reader.Update()
    red, green, blue = vtk_to_numpy(reader.GetOutput().GetPointData().GetScalars())[:, :3].astype(int).T
    # The window's own colours are greys and a few icons.
    found = {
        "lines": np.sum((blue > 1.5 * red) & (blue > green) & (blue < 150)) > 4000,
        "balls": np.sum((red > 2 * green) & (red > 2 * blue) & (red > 100)) + np.sum((green > 1.5 * red) & (green > 1.5 * blue)) > 60,
        "surface": np.sum((red > 150) & (red >= green + 3) & (green >= blue + 3)) > 50000,
    }
    return [name for name, is_there in found.items() if not is_there]


def main():
    window = subprocess.Popen([sys.argv[1], "--disable-registry", "--state=demo.pvsm"])
    try:
        deadline = time.monotonic() + 120
        while (absent := missing()) and time.monotonic() < deadline and window.poll() is None:
            time.sleep(1)
    finally:
        window.kill()
        window.wait()
    assert not absent, f"the window shows no {', no '.join(absent)}: see {PICTURE}"
    print("the window shows lines, balls and the surface")


if __name__ == "__main__":
    main()
