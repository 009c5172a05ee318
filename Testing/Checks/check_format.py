#!/usr/bin/env python3
"""Checks that the sources are formatted as .clang-format says.

    check_format.py ROOT [CLANG_FORMAT]

names each place that clang-format would change, and fails if there is any. Major versions of clang-format differ in what
they make of the same rules, so that only version 14, Debian 12's, counts: with another one, or without any, the check
exits with 77, which CTest counts as skipped.
"""

import pathlib
import re
import subprocess
import sys

VERSION = 14
SKIPPED = 77
FOLDERS = ("Filters", "ParaViewPlugin", "Testing")


def version_of(program):
    """The major version of a clang-format, or None where it does not run."""
    try:
        said = subprocess.run([program, "--version"], capture_output=True, text=True, check=True).stdout
    except (OSError, subprocess.CalledProcessError):
        return None
    found = re.search(r"version (\d+)", said)
    return int(found.group(1)) if found else None


def main():
    root = pathlib.Path(sys.argv[1])
    program = sys.argv[2] if len(sys.argv) > 2 else "clang-format"
    version = version_of(program)
    if version != VERSION:
        have = f"this is version {version}" if version else f"{program} does not run"
        print(f"skipped: the format is checked with clang-format {VERSION} of Debian 12; {have}")
        return SKIPPED
    paths = sorted(path for folder in FOLDERS for path in (root / folder).rglob("*") if path.suffix in {".h", ".cxx"})
    print(f"{len(paths)} sources")
    return subprocess.run([program, "--dry-run", "--Werror", *map(str, paths)], check=False).returncode


if __name__ == "__main__":
    sys.exit(main())
