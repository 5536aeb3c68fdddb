"""Motions that need not repeat: in time, swept, their exponents, their basins."""

from collections.abc import Mapping
from typing import Any, NamedTuple

import numpy as np

from . import _plot
from ._tables import Array


class ForcedTime(NamedTuple):
    """How long a forced motion is; `duration_s` outranks `periods`."""

    frequency_hz: float
    transient: int
    periods: int
    duration_s: float | None
    samples: int


class Motion:
    """A motion in time.

    * `report`: it in few numbers, as `simulate --json` says.
    * `samples`, `contacts`, `section`: structured arrays with the columns of `samples.csv`, `contacts.csv`
      and `stroboscopic.csv`; the modal state of the section is one column `state`.
    """

    def __init__(self, report: Mapping[str, Any], tables: Mapping[str, Array]) -> None:
        self.report = report
        self.samples = tables["samples"]
        self.contacts = tables["contacts"]
        self.section = tables["stroboscopic"]

    def plot(self, ax: Any = None) -> Any:
        """Draws the displacement of the response point over time, with matplotlib."""
        return _plot.motion(self.samples, ax)

    def __repr__(self) -> str:
        counts = f"{len(self.samples)} samples, {len(self.contacts)} contacts"
        return f"<Motion {self.report['time_s']:.6g} s, {counts}>"


class Sweep:
    """Settled motions over the frequency.

    * `report`: as `sweep --json` says.
    * `motions`: a structured array with the columns of `sweep.csv`; NaN or -1 where there is no number.
    * `samples`: one row for each sample of a motion.
    """

    def __init__(self, report: Mapping[str, Any]) -> None:
        self.report = report
        motions = report["motions"]
        self.motions = _table(
            motions,
            {
                "from": "U",
                "frequency_hz": "f8",
                "class": "U",
                "period": "i8",
                "max_abs_displacement_m": "f8",
                "contacts_per_period": "f8",
                "largest_exponent_per_s": "f8",
                "half_width_per_s": "f8",
                "zero_one_k": "f8",
                "branch": "i8",
            },
        )
        each = [
            {"from": motion["from"], "frequency_hz": motion["frequency_hz"], "displacement_m": sample}
            for motion in motions
            for sample in motion["sampled_displacements_m"]
        ]
        self.samples = _table(each, {"from": "U", "frequency_hz": "f8", "displacement_m": "f8"})

    def plot(self, ax: Any = None) -> Any:
        """Draws the samples over the frequency, with matplotlib."""
        return _plot.sweep(self.samples, ax)

    def __repr__(self) -> str:
        return f"<Sweep of {len(self.motions)} motions>"


class Exponents:
    """Spectra of Lyapunov exponents.

    * `report`: as `lyapunov --json` says of a series.
    * `frequency_hz`, `exponents_per_s`, `half_widths_per_s`, `kaplan_yorke_dimension`: one row for each
      frequency.
    """

    def __init__(self, report: Mapping[str, Any]) -> None:
        self.report = report
        spectra = report["spectra"]
        # Minus infinity, of directions that a rigid stop takes for good, is null in JSON.
        exponents = [
            [-np.inf if one is None else one for one in spectrum["exponents_per_s"]] for spectrum in spectra
        ]
        widths = [
            [np.nan if one is None else one for one in spectrum["half_widths_per_s"]] for spectrum in spectra
        ]
        self.frequency_hz = np.array([spectrum["frequency_hz"] for spectrum in spectra])
        self.exponents_per_s = np.array(exponents)
        self.half_widths_per_s = np.array(widths)
        self.kaplan_yorke_dimension = np.array(
            [spectrum["kaplan_yorke_dimension"] for spectrum in spectra], dtype=float
        )

    def __repr__(self) -> str:
        return f"<Exponents at {len(self.frequency_hz)} frequencies>"


class Basins:
    """Basins of attraction over a grid of initial states.

    * `report`: as `basins --json` says.
    * `cells`: number of the attractor of each cell, from 1 on, 0 where there is none; rows go along y.
    * `x`, `y`: middles of the cells; `attractors`: one dictionary for each.
    """

    def __init__(self, report: Mapping[str, Any]) -> None:
        self.report = report
        grid = report["grid"]
        self.cells = np.array(report["cells"], dtype=np.int64).reshape(grid, grid)
        self.x, self.y = (_middles(report[axis], grid) for axis in ("x", "y"))
        self.attractors: list[dict[str, Any]] = list(report["attractors"])

    def plot(self, ax: Any = None) -> Any:
        """Draws the basins, with matplotlib."""
        return _plot.basins(self, ax)

    def __repr__(self) -> str:
        return f"<Basins of {len(self.attractors)} attractors over {self.cells.size} cells>"


def _middles(axis: Mapping[str, Any], count: int) -> np.ndarray[Any, np.dtype[np.float64]]:
    ends = np.linspace(axis["low"], axis["high"], count + 1)
    return (ends[:-1] + ends[1:]) / 2


def _table(rows: list[Any], kinds: Mapping[str, str]) -> Array:
    none = {"U": "", "f8": np.nan, "i8": -1}

    def column(name: str, kind: str) -> Array:
        values = [none[kind] if row.get(name) is None else row[name] for row in rows]
        return np.array(values, dtype=str if kind == "U" else kind)

    columns = {name: column(name, kind) for name, kind in kinds.items()}
    table = np.empty(len(rows), dtype=[(name, values.dtype) for name, values in columns.items()])
    for name, values in columns.items():
        table[name] = values
    return table
