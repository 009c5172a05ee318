"""Compiles sources of the core as far as their syntax, without making objects, against headers of one's choice."""

import concurrent.futures
import os
import subprocess

FLAGS = ["-std=c++17", "-Wall", "-Wextra"]


def precompile_eigen(compiler, headers):
    """Most of the time is for Eigen's headers, which nearly all sources include."""
    header = headers / "eigen.h"
    header.write_text("#include <Eigen/Core>\n#include <Eigen/Geometry>\n#include <Eigen/SparseCore>\n")
    subprocess.run([compiler, *FLAGS, "-isystem", str(headers), "-x", "c++-header", str(header), "-o", f"{header}.gch"], check=True)


def complaints(compiler, headers, root, sources, *flags):
    """The compiler's errors and warnings on the sources, below the folder `root`; the folder `headers` has those of the libraries."""
    precompile_eigen(compiler, headers)

    def read(source):
        command = [compiler, *FLAGS, "-fsyntax-only", "-include", str(headers / "eigen.h"), f"-I{root / 'Filters' / 'Core'}",
                   "-isystem", str(headers), *flags, str(source)]
        return subprocess.run(command, capture_output=True, text=True).stderr

    with concurrent.futures.ThreadPoolExecutor(os.cpu_count()) as threads:
        return list(threads.map(read, sources))


def report(found):
    """Prints what was found and returns the exit status of a check."""
    print("".join(found) + f"{len(found)} sources")
    return 1 if any(found) else 0
