#!/usr/bin/env python3
"""Checks that the core is C++ for Windows, too: MinGW's compiler reads every source of Filters/Core, without making objects.

    check_mingw.py ROOT [SOURCE...]

SuiteSparse, CGAL, Boost, GMP and MPFR have no packages for MinGW in Debian; their headers for this machine are read instead. The rooms
of Pieces are left out, which need MPI and PETSc. The compiler is that of Debian's package g++-mingw-w64-x86-64-posix; without it, the
check is skipped (exit status 77).
"""

import concurrent.futures
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile

COMPILER = "x86_64-w64-mingw32-g++-posix"
# Headers of libraries alone: those of the system's C library are none for Windows.
INCLUDED = ["eigen3/Eigen", "eigen3/unsupported", "CGAL", "boost", "gmp*.h", "*-linux-gnu/gmp.h", "mpfr.h", "suitesparse/*.h"]


def link_headers(folder):
    for pattern in INCLUDED:
        for path in pathlib.Path("/usr/include").glob(pattern):
            link = folder / path.name
            if not link.exists():
                link.symlink_to(path)


FLAGS = ["-std=c++17", "-Wall", "-Wextra"]


def precompile_eigen(folder):
    """Most of the time is for Eigen's headers, which nearly all sources include."""
    header = folder / "eigen.h"
    header.write_text("#include <Eigen/Core>\n#include <Eigen/Geometry>\n#include <Eigen/SparseCore>\n")
    subprocess.run([COMPILER, *FLAGS, "-isystem", str(folder), "-x", "c++-header", str(header), "-o", f"{header}.gch"], check=True)


def complaints(root, headers, source):
    command = [COMPILER, *FLAGS, "-fsyntax-only", "-include", str(headers / "eigen.h"), f"-I{root / 'Filters' / 'Core'}",
               "-isystem", str(headers), str(source)]
    return subprocess.run(command, capture_output=True, text=True).stderr


def main():
    if not shutil.which(COMPILER):
        print(f"{COMPILER} is not installed")
        return 77
    root = pathlib.Path(sys.argv[1]).resolve()
    sources = [root / name for name in sys.argv[2:]] or [
        path for path in sorted((root / "Filters" / "Core").rglob("*.cxx")) if "Pieces" not in path.parts]
    with tempfile.TemporaryDirectory() as folder, concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as threads:
        headers = pathlib.Path(folder)
        link_headers(headers)
        precompile_eigen(headers)
        found = list(threads.map(lambda source: complaints(root, headers, source), sources))
    print("".join(found) + f"{len(sources)} sources")
    return 1 if any(found) else 0


if __name__ == "__main__":
    sys.exit(main())
