"""A result in few numbers: a row of the table of all items, and what Dakota asks for."""

from collections.abc import Mapping
from pathlib import Path
from typing import TYPE_CHECKING, Any

import numpy as np

from .._results import Results

if TYPE_CHECKING:
    from ._task import Task

Numbers = dict[str, float]


def numbers(task: "Task", report: Mapping[str, Any], results: Path) -> Numbers:
    """The numbers of what a task has computed.

    * `report`: what the command says with `--json`.
    * `results`: its results folder.
    """
    if "part" in report:
        return {"pieces": float(report["pieces"])}
    if task.method == "run":
        with Results(results) as read:
            return of_results(read)
    return {"sweep": _sweep, "basins": _basins, "lyapunov": _lyapunov, "simulate": _plain}[task.method](
        report
    )


def of_results(results: Results) -> Numbers:
    """Those of the branches of a results folder.

    `branches`, `solutions`, `stable_solutions`; the largest value over all stable solutions of every column
    that starts with `max_`, and the frequency of the largest displacement; for every kind of event its
    number, as in `events_fold`, and its lowest and highest frequency, as in `lowest_fold_hz`.
    """
    rows, events = results.branches(), results.events()
    stable = rows[rows["stable"]]
    found: Numbers = {
        "branches": float(len(np.unique(rows["branch"]))),
        "solutions": float(len(rows)),
        "stable_solutions": float(len(stable)),
    }
    if len(stable):
        largest = stable[int(np.argmax(stable["max_abs_displacement_m"]))]
        found["frequency_of_max_displacement_hz"] = float(largest["frequency_hz"])
    for name in rows.dtype.names or ():
        if name.startswith("max_") and rows.dtype[name].kind == "f" and len(stable):
            found[name] = float(stable[name].max())
    # Two at one place stand as flip+grazing.
    kinds = [set(event.split("+")) for event in events["event"].tolist()]
    for kind in sorted(set[str]().union(*kinds)):
        frequencies = events["frequency_hz"][[kind in of_row for of_row in kinds]]
        word = kind.replace("-", "_").replace(" ", "_")
        found[f"events_{word}"] = float(len(frequencies))
        found[f"lowest_{word}_hz"] = float(frequencies.min())
        found[f"highest_{word}_hz"] = float(frequencies.max())
    return found


def _sweep(report: Mapping[str, Any]) -> Numbers:
    motions = report["motions"]
    largest = max(motions, key=lambda motion: motion["max_abs_displacement_m"])
    return {
        "motions": float(len(motions)),
        "periodic_motions": float(sum(motion["class"] == "periodic" for motion in motions)),
        "max_abs_displacement_m": largest["max_abs_displacement_m"],
        "frequency_of_max_displacement_hz": largest["frequency_hz"],
    }


def _basins(report: Mapping[str, Any]) -> Numbers:
    fractions = sorted((attractor["fraction"] for attractor in report["attractors"]), reverse=True)
    return {
        "attractors": float(len(fractions)),
        "largest_fraction": fractions[0] if fractions else 0.0,
        "cells": float(len(report["cells"])),
        "cells_not_computed": float(report["cells_not_computed"]),
    }


def _lyapunov(report: Mapping[str, Any]) -> Numbers:
    largest = [spectrum["exponents_per_s"][0] for spectrum in report["spectra"]]
    finite = [exponent for exponent in largest if exponent is not None]
    return {"spectra": float(len(largest)), "largest_exponent_per_s": max(finite, default=-np.inf)}


def _plain(report: Mapping[str, Any]) -> Numbers:
    return {
        name: float(value)
        for name, value in report.items()
        if isinstance(value, (int, float)) and not isinstance(value, bool) and name != "request"
    }
