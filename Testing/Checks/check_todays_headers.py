#!/usr/bin/env python3
"""Checks that the core compiles with the libraries of tomorrow: this machine's compiler reads every source of Filters/Core with the headers of
Eigen, SuiteSparse, CGAL and Boost that Debian's testing has today.

    check_todays_headers.py ROOT FOLDER [SOURCE...]

Their packages are unpacked below FOLDER and stay there for a day. Nothing is installed. MPI and PETSc are this machine's; without
them, the rooms of Pieces are left out. Where Debian's archive cannot be reached, the check is skipped (exit status 77).
"""

import os
import pathlib
import re
import shutil
import subprocess
import sys
import time

import syntax

ARCHIVE = "deb http://deb.debian.org/debian testing main\n"
PACKAGES = ["libcgal-dev", "libeigen3-dev", "libsuitesparse-dev"]
# The package lists of testing alone, beside the machine's own.
CONFIGURATION = """
Dir::Etc::SourceList "{folder}/sources.list";
Dir::Etc::SourceParts "-";
Dir::State::Lists "{folder}/lists";
Dir::Cache "{folder}/cache";
APT::Sandbox::User "";
Acquire::Languages "none";
Acquire::Check-Valid-Until "false"; // a mirror of testing may be some weeks old
"""
LINKED = ["eigen3/Eigen", "eigen3/unsupported", "CGAL", "boost", "suitesparse/*.h"]
FRESH = 86400  # seconds


def apt(folder, *words):
    return subprocess.run(words, cwd=folder, env={**os.environ, "APT_CONFIG": str(folder / "apt.conf")}, capture_output=True, text=True)


def unpack(folder):
    """The packages below a folder; what went wrong, or an empty text."""
    shutil.rmtree(folder, ignore_errors=True)
    for name in ("lists/partial", "cache/archives/partial", "headers"):
        (folder / name).mkdir(parents=True)
    (folder / "sources.list").write_text(ARCHIVE)
    (folder / "apt.conf").write_text(CONFIGURATION.format(folder=folder))
    update = apt(folder, "apt-get", "update", "--quiet=2", "--error-on=any")
    if update.returncode:
        return update.stderr
    boost = re.search(r"Depends: (libboost[\d.]+-dev)", apt(folder, "apt-cache", "depends", "libboost-dev").stdout)
    download = apt(folder, "apt-get", "download", "--quiet=2", *PACKAGES, boost.group(1))
    if download.returncode:
        return download.stderr
    for archive in folder.glob("*.deb"):
        subprocess.run(["dpkg-deb", "--extract", archive, folder / "unpacked"], check=True)
    for pattern in LINKED:
        for path in (folder / "unpacked/usr/include").glob(pattern):
            (folder / "headers" / path.name).symlink_to(path)
    (folder / "complete").touch()
    return ""


def pieces_flags():
    """What the rooms of Pieces need beside this machine's own headers; None where these do not fit each other, or are not there."""
    petsc = pathlib.Path("/usr/lib/petscdir/petsc-complex/include")
    mpi = shutil.which("mpicc") and subprocess.run(["mpicc", "--showme:compile"], capture_output=True, text=True)
    if not petsc.exists() or not mpi or mpi.returncode:
        return None
    flags = [*mpi.stdout.split(), "-isystem", str(petsc), "-DOMPI_SKIP_MPICXX", "-DMPICH_SKIP_MPICXX"]
    read = subprocess.run(["g++", "-fsyntax-only", "-x", "c++", *flags, "-"], input="#include <petscsys.h>", text=True,
                          capture_output=True)
    return None if read.returncode else flags  # PETSc was built for another MPI, as while Debian testing changes it


def main():
    root, folder = (pathlib.Path(name).resolve() for name in sys.argv[1:3])
    complete = folder / "complete"
    if not shutil.which("apt-get"):
        print("there is no apt-get")
        return 77
    if not complete.exists() or time.time() - complete.stat().st_mtime > FRESH:
        trouble = unpack(folder)
        if trouble:
            print(f"Debian's archive cannot be reached:\n{trouble}")
            return 77
    pieces = pieces_flags()
    sources = [root / name for name in sys.argv[3:]] or [
        path for path in sorted((root / "Filters" / "Core").rglob("*.cxx")) if pieces or "Pieces" not in path.parts]
    print(*sorted(path.stem for path in folder.glob("*.deb")))
    return syntax.report(syntax.complaints("g++", folder / "headers", root, sources, *(pieces or [])))


if __name__ == "__main__":
    sys.exit(main())
