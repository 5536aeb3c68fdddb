"""Figures with matplotlib, in the look of Hammerbeam's own."""

from typing import Any

import numpy as np

from ._check import refused, unknown
from ._tables import Array, needed

PERIODS = ("#262d72", "#b24b13", "#4bb897", "#681505", "#726587", "#cd8ee3", "#512834", "#3864d1", "#86b361")
"""Colours of period multiples 1, 2, 3 and so on."""
FILLS = ("#2b4f87", "#f2c38a", "#5fae96", "#a0476b", "#dfe6ee", "#8c8c3a")
INK, GRID = "#222222", "#e3e3e3"
MARKS = {"fold": "o", "flip": "^", "neimark-sacker": "s", "branch-point": "D", "grazing": "|"}

QUANTITIES = {
    "displacement": ("max_abs_displacement_m", "Maximum displacement (m)"),
    "acceleration": ("max_abs_acceleration_m_s2", "Maximum acceleration (m/s²)"),
    "force": ("max_contact_force_n", "Maximum contact force (N)"),
    "velocity": ("max_impact_velocity_m_s", "Maximum impact velocity (m/s)"),
}


def axes(ax: Any) -> Any:
    """What is given, or axes of a new figure."""
    if ax is not None:
        if not all(hasattr(ax, name) for name in ("plot", "set_xlabel", "grid")):
            raise refused("ax", ax, "must be axes of matplotlib")
        return ax
    pyplot = needed("matplotlib.pyplot", "plot")
    return pyplot.subplots(figsize=(7.1, 4.0), layout="constrained")[1]


def framed(ax: Any, x: str, y: str) -> Any:
    """Axes with their labels and a grid."""
    ax.set_xlabel(x, color=INK)
    ax.set_ylabel(y, color=INK)
    ax.grid(color=GRID, linewidth=0.5)
    ax.set_axisbelow(True)
    return ax


def checked_quantity(quantity: Any) -> tuple[str, str]:
    """Column and label of a quantity that can be drawn."""
    if not isinstance(quantity, str) or quantity not in QUANTITIES:
        raise unknown("quantity", quantity, QUANTITIES)
    return QUANTITIES[quantity]


def response(table: Array, quantity: str, ax: Any, title: str) -> Any:
    """Branches over the frequency: a colour for each period, dashes for unstable solutions, marks for
    events."""
    column, label = checked_quantity(quantity)
    ax = framed(axes(ax), "Frequency (Hz)", label)
    known: set[int] = set()
    for number in np.unique(table["branch"]):
        rows = table[table["branch"] == number]
        period = int(rows["period_multiple"][0])
        colour = PERIODS[(period - 1) % len(PERIODS)]
        for stable, dashes in ((True, "-"), (False, (0, (3, 1.5)))):
            values = np.where(_with_next(rows["stability"] != "unstable", stable), rows[column], np.nan)
            name = f"period {period}" if stable and period not in known else None
            ax.plot(rows["frequency_hz"], values, color=colour, linestyle=dashes, linewidth=1.1, label=name)
        known.add(period)
        for event, mark in MARKS.items():
            at = rows[np.char.find(rows["event"], event) >= 0]
            ax.plot(
                at["frequency_hz"],
                at[column],
                mark,
                color=colour,
                markersize=3,
                markerfacecolor="white",
                linestyle="",
            )
    values = table[column]
    positive = values[values > 0]
    if len(positive) == len(values) > 0 and positive.max() > 40 * positive.min():
        ax.set_yscale("log")
    if title:
        ax.set_title(title, color=INK, fontsize="medium")
    if len(known) > 1:
        ax.legend(frameon=False)
    return ax


def _with_next(stable: Array, wanted: bool) -> Array:
    """Rows of a kind, with the row behind each stretch, so that lines meet."""
    found = np.asarray(stable == wanted)
    if not wanted:
        found = found | np.append(found[1:], False) | np.append(False, found[:-1])
    return found


def orbit(waveform: Array, solution: Any, point: str, ax: Any) -> Any:
    """Displacement over a period."""
    names = [
        name.removesuffix("_displacement_m")
        for name in waveform.dtype.names or ()
        if name.endswith("_displacement_m")
    ]
    if not isinstance(point, str) or point not in names:
        raise unknown("point", point, names)
    ax = framed(axes(ax), "Time (excitation periods)", f"Displacement of {point} (m)")
    colour = PERIODS[(solution.period_multiple - 1) % len(PERIODS)]
    ax.plot(waveform["phase_cycles"], waveform[f"{point}_displacement_m"], color=colour, linewidth=1.1)
    return ax


def motion(samples: Array, ax: Any) -> Any:
    """Displacement over time."""
    ax = framed(axes(ax), "Time (s)", "Displacement (m)")
    ax.plot(samples["time_s"], samples["displacement_m"], color=PERIODS[0], linewidth=0.9)
    return ax


def sweep(samples: Array, ax: Any) -> Any:
    """Samples of settled motions over the frequency."""
    ax = framed(axes(ax), "Frequency (Hz)", "Displacement at phase 0 (m)")
    for place, origin in enumerate(np.unique(samples["from"])):
        rows = samples[samples["from"] == origin]
        colour = PERIODS[place % len(PERIODS)]
        ax.plot(
            rows["frequency_hz"], rows["displacement_m"], ".", color=colour, markersize=2, label=str(origin)
        )
    return ax


def basins(found: Any, ax: Any) -> Any:
    """Cells of a grid in the colour of their attractor."""
    colors = needed("matplotlib.colors", "plot")
    ax = framed(axes(ax), str(found.report["x"]["coordinate"]), str(found.report["y"]["coordinate"]))
    count = max(int(found.cells.max(initial=0)), 1)
    shown = colors.ListedColormap([INK, *(FILLS[k % len(FILLS)] for k in range(count))])
    extent = [found.report[axis][end] for axis in ("x", "y") for end in ("low", "high")]
    ax.imshow(
        found.cells, origin="lower", extent=extent, aspect="auto", cmap=shown, vmin=-0.5, vmax=count + 0.5
    )
    return ax
