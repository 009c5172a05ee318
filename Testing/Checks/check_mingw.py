#!/usr/bin/env python3
"""Checks that the core is C++ for Windows, too: MinGW's compiler reads every source of Filters/Core.

    check_mingw.py ROOT [SOURCE...]

SuiteSparse, CGAL, Boost, GMP and MPFR have no packages for MinGW in Debian; their headers for this machine are read instead. The rooms
of Pieces are left out, which need MPI and PETSc. The compiler is that of Debian's package g++-mingw-w64-x86-64-posix; without it, the
check is skipped (exit status 77).
"""

import pathlib
import shutil
import sys
import tempfile

import syntax

COMPILER = "x86_64-w64-mingw32-g++-posix"
# Headers of libraries alone: those of the system's C library are none for Windows.
INCLUDED = ["eigen3/Eigen", "eigen3/unsupported", "CGAL", "boost", "gmp*.h", "*-linux-gnu/gmp.h", "mpfr.h", "suitesparse/*.h"]


def link_headers(folder):
    for pattern in INCLUDED:
        for path in pathlib.Path("/usr/include").glob(pattern):
            link = folder / path.name
            if not link.exists():
                link.symlink_to(path)


def main():
    if not shutil.which(COMPILER):
        print(f"{COMPILER} is not installed")
        return 77
    root = pathlib.Path(sys.argv[1]).resolve()
    sources = [root / name for name in sys.argv[2:]] or [
        path for path in sorted((root / "Filters" / "Core").rglob("*.cxx")) if "Pieces" not in path.parts]
    with tempfile.TemporaryDirectory() as folder:
        link_headers(pathlib.Path(folder))
        return syntax.report(syntax.complaints(COMPILER, pathlib.Path(folder), root, sources))


if __name__ == "__main__":
    sys.exit(main())
