#!/usr/bin/env python3
"""Draws what BenchmarkThesis wrote: plot_thesis.py [folder] reads its CSV files and leaves PNGs beside them."""
import csv
import sys
from pathlib import Path

import matplotlib
matplotlib.use("Agg")
from matplotlib import pyplot

DISCRETISATIONS = ["DEC", "face-based", "power"]


def read(path):
    with open(path, newline="") as file:
        return list(csv.DictReader(file))


def number(text):
    return float(text) if text else float("nan")


def column(rows, name):
    return [number(row[name]) for row in rows]


def of(rows, discretisation):
    return [row for row in rows if row["discretisation"] == discretisation]


def pairs(axis, rows, names):
    """Per surface, ours (dot) beside the thesis's (cross), on a logarithmic axis."""
    places = range(len(rows))
    for name, colour in names:
        axis.semilogy(places, column(rows, name), "o", color=colour, label=name)
        if "thesis_" + name in rows[0]:
            axis.semilogy(places, column(rows, "thesis_" + name), "x", color=colour,
                          label="thesis's " + name)
    axis.set_xticks(list(places))
    axis.set_xticklabels([row["surface"][:14] for row in rows], rotation=60, ha="right", fontsize=7)
    axis.grid(True, axis="y", alpha=0.3)
    axis.legend(fontsize=7)


def figure(folder, name, title, draw, discretisations=DISCRETISATIONS):
    drawing, axes = pyplot.subplots(1, len(discretisations), figsize=(5 * len(discretisations), 5),
                                    constrained_layout=True, squeeze=False)
    for axis, discretisation in zip(axes[0], discretisations):
        axis.set_title(discretisation)
        draw(axis, discretisation)
    drawing.suptitle(title)
    drawing.savefig(folder / name, dpi=100)
    pyplot.close(drawing)
    print(folder / name)


def main():
    folder = Path(sys.argv[1] if len(sys.argv) > 1 else ".")
    solves, sweeps, setup, curves = (
        read(folder / (name + ".csv")) for name in ("solves", "sweeps", "setup", "curves"))

    figure(folder, "errors.png", "Errors against Cholesky (tables 7.8 to 7.10)",
           lambda axis, d: pairs(axis, of(solves, d),
                                 [("cp_error", "tab:blue"), ("ni_error", "tab:orange"),
                                  ("fmg_error", "tab:green")]))
    figure(folder, "times.png", "Milliseconds (tables 7.11 to 7.13)",
           lambda axis, d: pairs(axis, of(solves, d),
                                 [("cholesky_prepare", "tab:blue"), ("mg_prepare", "tab:green"),
                                  ("ni_solve", "tab:orange"), ("fmg_solve", "tab:red")]))

    def draw_sweeps(axis, discretisation):
        rows = of(sweeps, discretisation)
        for name, style in (("total", "o-"), ("thesis_total", "x--")):
            axis.semilogy(column(rows, "sweeps"), column(rows, name), style, label=name)
        axis.set_xlabel("sweeps per level")
        axis.grid(True, alpha=0.3)
        axis.legend(fontsize=7)
    figure(folder, "sweeps.png", "V-cycles to an error of 1e-3: milliseconds (tables 7.14 to 7.16)",
           draw_sweeps)

    def draw_curves(by, label):
        def draw(axis, discretisation):
            rows = of(curves, discretisation)
            for surface in sorted({row["surface"] for row in rows}):
                some = [row for row in rows if row["surface"] == surface]
                axis.semilogy(column(some, by), column(some, "error"), label=surface[:18])
            axis.set_xlabel(label)
            axis.set_ylabel("error")
            axis.grid(True, alpha=0.3)
            axis.legend(fontsize=6)
        return draw
    figure(folder, "curves_by_cycle.png", "Convergence of V-cycles (figures 7.14 and 7.16)",
           draw_curves("cycle", "cycle"))
    figure(folder, "curves_by_time.png", "Convergence of V-cycles (figures 7.1 to 7.3, 7.13, 7.15)",
           draw_curves("milliseconds", "milliseconds"))

    drawing, axis = pyplot.subplots(figsize=(7, 5), constrained_layout=True)
    for name, style in (("setup", "o"), ("thesis_setup", "x")):
        axis.loglog(column(setup, "faces"), [t / 1e3 for t in column(setup, name)], style, label=name)
    axis.set_xlabel("faces")
    axis.set_ylabel("seconds")
    axis.set_title("Set-up with all operators (table 7.18, figure 7.12)")
    axis.grid(True, which="both", alpha=0.3)
    axis.legend()
    drawing.savefig(folder / "setup.png", dpi=100)
    print(folder / "setup.png")


if __name__ == "__main__":
    main()
