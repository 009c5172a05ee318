#!/usr/bin/env python3
"""Draws what BenchmarkFields, BenchmarkKernels and time_filter.py wrote: plot_fields.py [folder] reads their CSV
files and leaves PNGs beside them.

Files that are not there are left out.
"""
import sys
from pathlib import Path

from plot_thesis import column, figure, of, pyplot, read

COLOURS = {"ours": "tab:red", "CHOLMOD, AMD": "tab:blue", "CHOLMOD, METIS": "tab:cyan",
           "geometry-central's factor": "tab:pink", "IC(0)-CG, RCM": "tab:green", "Eigen SimplicialLDLT": "tab:purple",
           "hypre BoomerAMG": "tab:brown", "hypre AMS": "tab:olive", "PETSc GAMG": "tab:orange"}


def discretisations_of(rows):
    return list(dict.fromkeys(row["discretisation"] for row in rows))


def name_of(solver):
    """As in the program; cells of a CSV hold no commas."""
    return solver.replace(";", ",")


def finished(rows):
    """The rows of solvers that ran to an end, smallest surface first."""
    return sorted((row for row in rows if row["total"]), key=lambda row: float(row["faces"]))


def draw_solvers(rows, quantity, label):
    def draw(axis, discretisation):
        here = finished(of(rows, discretisation))
        for solver, colour in COLOURS.items():
            some = [row for row in here if name_of(row["solver"]) == solver]
            if quantity == "iterations":
                some = [row for row in some if float(row["iterations"]) > 0]
            if some:
                axis.loglog(column(some, "faces"), column(some, quantity), "o-", color=colour,
                            label=solver, linewidth=2 if solver == "ours" else 1)
        axis.set_xlabel("faces")
        axis.set_ylabel(label)
        axis.grid(True, which="both", alpha=0.3)
        axis.legend(fontsize=7)
    return draw


def stem_of(regime):
    return "_" + regime.replace(" %", "_percent")


def plot_fields(folder):
    rows = read(folder / "fields.csv")
    for regime in sorted({row["prescribed"] for row in rows}):
        some = [row for row in rows if row["prescribed"] == regime]
        stem = stem_of(regime)
        for quantity, label in (("total", "prepare + solve, seconds"),
                                ("bare", "from the bare mesh, seconds"),
                                ("iterations", "iterations"), ("peak_mb", "peak memory, MB")):
            figure(folder, quantity + stem + ".png", f"{label}; {regime} prescribed",
                   draw_solvers(some, quantity, label), discretisations_of(some))


def plot_resolves(folder):
    rows = read(folder / "resolves.csv")
    for regime in sorted({row["prescribed"] for row in rows}):
        some = [row for row in rows if row["prescribed"] == regime]
        figure(folder, "resolves" + stem_of(regime) + ".png",
               f"Second solves, seconds; {regime} prescribed", draw_resolves(some),
               discretisations_of(some))


def draw_resolves(rows):
    def draw(axis, discretisation):
        here = of(rows, discretisation)
        surfaces = list(dict.fromkeys(row["surface"] for row in here))
        kinds = list(dict.fromkeys((row["change"], name_of(row["solver"])) for row in here))
        for change, solver in kinds:
            some = [row for row in here
                    if (row["change"], name_of(row["solver"])) == (change, solver)]
            axis.semilogy([surfaces.index(row["surface"]) for row in some],
                          [float(row["prepare"]) + float(row["solve"]) for row in some],
                          "o" if solver.startswith("ours") else "x", label=f"{change}: {solver}")
        axis.set_xticks(range(len(surfaces)))
        axis.set_xticklabels([name[:14] for name in surfaces], rotation=60, ha="right", fontsize=7)
        axis.set_xlim(-0.5, 2 * len(surfaces))  # the right half is the legend's
        axis.grid(True, axis="y", alpha=0.3)
        axis.legend(fontsize=6, loc="right")
    return draw


def plot_iterations(folder):
    rows = read(folder / "iterations.csv")
    varied = "alignment" if len({row["alignment"] for row in rows}) > 1 else "prescribed"

    def draw(axis, discretisation):
        here = of(rows, discretisation)
        for surface in dict.fromkeys(row["surface"] for row in here):
            some = [row for row in here if row["surface"] == surface]
            axis.plot([row[varied] for row in some], column(some, "iterations"), "o",
                      label=surface[:18])
        axis.set_xlabel(varied)
        axis.set_ylabel("iterations to 1e-8")
        axis.set_ylim(bottom=0)
        axis.grid(True, alpha=0.3)
        axis.legend(fontsize=6)
    figure(folder, f"iterations_by_{varied}.png", "Iterations of ours", draw,
           discretisations_of(rows))


def plot_kernels(folder):
    rows = [row for row in read(folder / "kernels.csv") if row["level"] == "0"]

    def draw(axis, discretisation):
        here = of(rows, discretisation)
        kernels = list(dict.fromkeys(row["kernel"] for row in here))
        for (surface, threads), marker in zip(
                dict.fromkeys((row["surface"], row["threads"]) for row in here), "ox^vsd*P" * 9):
            some = [row for row in here if (row["surface"], row["threads"]) == (surface, threads)]
            axis.plot([kernels.index(row["kernel"]) for row in some],
                      [100 * float(row["share_of_stream"]) for row in some], marker,
                      label=f"{surface[:18]}, {threads} threads")
        axis.axhline(100, color="black", linewidth=0.5)
        axis.set_xticks(range(len(kernels)))
        axis.set_xticklabels([name_of(kernel) for kernel in kernels], rotation=60, ha="right",
                             fontsize=7)
        axis.set_ylabel("% of STREAM")
        axis.set_ylim(bottom=0)
        axis.grid(True, alpha=0.3)
        axis.legend(fontsize=6)
    figure(folder, "kernels.png", "Memory bandwidth of the kernels on the finest level", draw,
           discretisations_of(rows))


def plot_filter(folder):
    rows = read(folder / "filter.csv")
    names = [f"{row['surface'][:18]}, {row['field']}: {row['solver']}" for row in rows]
    drawing, axis = pyplot.subplots(figsize=(10, 1 + 0.3 * len(rows)), constrained_layout=True)
    left = [0.0] * len(rows)
    for stage in ("setup", "prepare", "solve", "other"):
        seconds = column(rows, stage)
        axis.barh(range(len(rows)), seconds, left=left, label=stage)
        left = [a + b for a, b in zip(left, seconds)]
    axis.set_yticks(range(len(rows)))
    axis.set_yticklabels(names, fontsize=7)
    axis.invert_yaxis()
    axis.set_xlabel("seconds")
    axis.grid(True, axis="x", alpha=0.3)
    axis.legend(fontsize=7)
    axis.set_title("The whole job: from a bare vtkPolyData to all arrays")
    drawing.savefig(folder / "filter.png", dpi=100)
    pyplot.close(drawing)
    print(folder / "filter.png")


PLOTS = {"fields.csv": plot_fields, "resolves.csv": plot_resolves,
         "iterations.csv": plot_iterations, "kernels.csv": plot_kernels, "filter.csv": plot_filter}


def main():
    folder = Path(sys.argv[1] if len(sys.argv) > 1 else ".")
    for name, plot in PLOTS.items():
        if (folder / name).exists() and read(folder / name):
            plot(folder)


if __name__ == "__main__":
    main()
