"""Memory that runs out on one rank ends the work of all ranks, whenever it is: by an exception on each, or by one line and the end.

    test_memory.py RUN-OF-WithoutMemory...
"""

import re
import subprocess
import sys

RUN = sys.argv[1:]
SECONDS = 60  # a rank that waits for ever is stopped
# Boxes that mpiexec prints where a rank ends, in the middle of another line, too.
BOXES = re.compile(r"-{60,}\n.*?\n-{60,}\n", re.DOTALL)
ENDS = re.compile(r"DirectionalMultigrid: rank \d+ of \d+: (?:memory|PETSc) .*All ranks end")


def run(failing):
    """The outcome in words."""
    result = subprocess.run([*RUN, str(failing)], stdout=subprocess.PIPE, stderr=subprocess.STDOUT, text=True, timeout=SECONDS)
    if result.returncode == 0 and "all ranks throw" in result.stdout:
        return "throw"
    if result.returncode == 0 and (count := re.search(r"(\d+) requests", result.stdout)):
        return count[1]
    if result.returncode != 0 and len(ENDS.findall(BOXES.sub("", result.stdout).replace("\n", ""))) == 1:
        return "end"
    if result.returncode != 0 and "PetscFunctionListAdd" in result.stdout:
        return "PETSc"  # whose lists of functions, from 3.22 on, do not look whether they got memory
    raise AssertionError(f"request {failing}: exit code {result.returncode}\n{result.stdout}")


def main():
    requests = int(run(0))
    # From the first to the last one, the nearer the more likely.
    failing = sorted({1, 2, 3, *(1 + (requests - 1) * k // 16 for k in range(17))})
    outcomes = [run(each) for each in failing]
    print(f"{requests} requests; {dict(zip(failing, outcomes))}")
    assert requests > 1000, requests
    assert "throw" in outcomes, "no step that is agreed upon has failed"
    assert "end" in outcomes, "no request of PETSc has failed"
    # A library may do without, as where it gives memory back; the field is there then, and converged. Or it may not survive that itself.
    assert sum(outcome not in ("throw", "end") for outcome in outcomes) <= 2, "failed requests have passed unseen"


main()
