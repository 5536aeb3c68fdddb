"""Figures with matplotlib, in the look of Hammerbeam's own."""

from typing import Any

import numpy as np

from ._check import unknown
from ._look import (
    FILLS,
    INK,
    LINES,
    MARKS,
    PALE_INK,
    PERIODS,
    axes,
    framed,
    legend,
    marks_of,
    scaled,
)
from ._tables import Array, needed

QUANTITIES = {
    "displacement": ("max_abs_displacement_m", "Displacement max |y| (m)"),
    "acceleration": ("max_abs_acceleration_m_s2", "Acceleration max |ÿ| (m/s²)"),
    "force": ("max_contact_force_n", "Largest contact force (N)"),
    "velocity": ("max_impact_velocity_m_s", "Largest impact velocity (m/s)"),
}


def checked_quantity(quantity: Any) -> tuple[str, str]:
    """Column and label of a quantity that can be drawn."""
    if not isinstance(quantity, str) or quantity not in QUANTITIES:
        raise unknown("quantity", quantity, QUANTITIES)
    return QUANTITIES[quantity]


def response(table: Array, quantity: str, ax: Any, title: str) -> Any:
    """Branches over the frequency: a colour for each period, lines by stability, marks for events."""
    column, label = checked_quantity(quantity)
    ax = framed(axes(ax), "Excitation frequency (Hz)", label)
    marked = np.full(len(table), "", dtype="U64")
    periods, stabilities = dict[str, dict[str, Any]](), set[str]()
    for number in np.unique(table["branch"]):
        of_branch = table["branch"] == number
        rows = table[of_branch]
        marked[of_branch] = marks_of(rows["event"], rows["stability"])
        period = int(rows["period_multiple"][0])
        colour = PERIODS[(period - 1) % len(PERIODS)]
        periods[f"period {period}"] = {"color": colour, **LINES["stable"]}
        # The row of a fold is marginal, between a stable and an unstable stretch.
        is_between = (rows["stability"] == "marginal") & (rows["event"] != "")
        words = np.where(is_between, "unstable", rows["stability"])
        for stability in LINES:
            is_so = words == stability
            if is_so.any():
                values = np.where(_joined(is_so, stability), rows[column], np.nan)
                ax.plot(rows["frequency_hz"], values, color=colour, **LINES[stability])
                stabilities.add(stability)
    marks = [mark for mark in MARKS if (marked == mark.name).any()]
    for mark in marks:
        at = table[marked == mark.name]
        behind = mark.edge == PALE_INK
        ax.plot(at["frequency_hz"], at[column], zorder=1.5 if behind else 3, **mark.style())
    scaled(ax, table[column])
    ax.margins(x=0.0)
    lines = [(name, look) for name, look in LINES.items() if name in stabilities]
    several = sorted(periods.items()) if len(periods) > 1 else []
    legend(ax, [*lines, *several, *((mark.name, mark.style()) for mark in marks)], title)
    return ax


def _joined(is_so: Array, stability: str) -> Array:
    """Rows of a stability; of others than stable ones the rows beside them as well, so that lines meet."""
    if stability == "stable":
        return is_so
    return np.asarray(is_so | np.append(is_so[1:], False) | np.append(False, is_so[:-1]))


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
    ax.plot(waveform["phase_cycles"], waveform[f"{point}_displacement_m"], color=colour, linewidth=0.9)
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
