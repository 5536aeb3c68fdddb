"""The look of Hammerbeam's own figures for matplotlib: colours, widths, marks, axes, legend.

The numbers are those of `crates/figure/src/style.rs` and `marks.rs`, in points.
"""

from collections.abc import Sequence
from typing import Any, NamedTuple

import numpy as np

from ._check import refused
from ._tables import Array, needed

PERIODS = ("#23276a", "#ae3509", "#2ca68a", "#5f1301", "#69587b", "#b87ecf", "#492331", "#045bc5", "#7b9f59")
"""Colours of period multiples 1, 2, 3 and so on."""
FILLS = ("#2b4f87", "#f2c38a", "#5fae96", "#a0476b", "#dfe6ee", "#8c8c3a")
INK, PALE_INK, PAPER, GRID = "#222222", "#7d7d7d", "#ffffff", "#e3e3e3"
_SIZES = {
    "font.size": 8.0,
    "axes.labelsize": 8.0,
    "axes.titlesize": 8.0,
    "axes.titlelocation": "left",
    "axes.linewidth": 0.5,
    "xtick.labelsize": 7.0,
    "ytick.labelsize": 7.0,
    "xtick.major.width": 0.5,
    "ytick.major.width": 0.5,
    "legend.fontsize": 8.0,
}
LINES: dict[str, dict[str, Any]] = {
    "stable": {"linewidth": 0.9, "linestyle": "-"},
    "unstable": {"linewidth": 0.6, "linestyle": (0, (2.6 / 0.6, 1.4 / 0.6))},
    "marginal": {"linewidth": 0.9, "linestyle": (0, (1.0, 1.3 / 0.9))},
}
"""How lines of each stability are drawn."""


class Mark(NamedTuple):
    """The mark of an event on a branch: marker of matplotlib, its size, fill, edge and the width of that."""

    name: str
    marker: str
    size: float
    fill: str
    edge: str
    width: float

    def style(self) -> dict[str, Any]:
        """For `plot` of matplotlib."""
        return {
            "marker": self.marker,
            "markersize": self.size,
            "markerfacecolor": self.fill,
            "markeredgecolor": self.edge,
            "markeredgewidth": self.width,
            "linestyle": "",
        }


_OF_UNSTABLE = "bifurcation of unstable solutions"
MARKS = (
    Mark("fold", "o", 2.6, INK, PAPER, 0.3),
    Mark("fold at a grazing", "^", 3.4, INK, PAPER, 0.3),
    Mark("flip", "D", 3.2, PAPER, INK, 0.6),
    Mark("Neimark-Sacker", "o", 3.4, PAPER, INK, 0.6),
    Mark("branch point", "s", 2.9, PAPER, INK, 0.6),
    Mark(_OF_UNSTABLE, "o", 1.8, PAPER, PALE_INK, 0.45),
    Mark("grazing", "^", 3.6, "none", PALE_INK, 0.45),
)
"""In the order of the legend."""


_MARKED = {
    "fold": "fold",
    "flip": "flip",
    "neimark-sacker": "Neimark-Sacker",
    "branch-point": "branch point",
    "grazing": "grazing",
}


def marks_of(events: Array, stability: Array) -> Array:
    """The name of the mark of each row of a branch; none without an event.

    * `events`: such as `fold+grazing`.
    * `stability`: in words.
    """
    unstable = stability == "unstable"
    around = np.append(unstable[1:], True) & np.append(True, unstable[:-1])

    def one(event: str, is_within: bool) -> str:
        kinds = set(event.split("+"))
        if {"fold", "grazing"} <= kinds:
            return "fold at a grazing"
        if is_within and kinds & {"flip", "neimark-sacker"}:
            return _OF_UNSTABLE
        return next((mark for name, mark in _MARKED.items() if name in kinds), "")

    return np.array([one(str(event), bool(within)) for event, within in zip(events, around, strict=True)])


def axes(ax: Any) -> Any:
    """What is given, or axes of a new figure, 174 mm wide as for two columns of a journal."""
    if ax is not None:
        if not all(hasattr(ax, name) for name in ("plot", "set_xlabel", "grid")):
            raise refused("ax", ax, "must be axes of matplotlib")
        return ax
    pyplot = needed("matplotlib.pyplot", "plot")
    with needed("matplotlib", "plot").rc_context(_SIZES):
        return pyplot.subplots(figsize=(174 / 25.4, 95 / 25.4), layout="constrained")[1]


def framed(ax: Any, x: str, y: str) -> Any:
    """Axes with their labels and a grid."""
    ax.set_xlabel(x, color=INK)
    ax.set_ylabel(y, color=INK)
    ax.grid(color=GRID, linewidth=0.5)
    ax.set_axisbelow(True)
    return ax


def scaled(ax: Any, values: Array) -> None:
    """A logarithmic vertical axis with plain numbers where positive values span more than a factor of 40,
    else one from 0 on."""
    finite = values[np.isfinite(values)]
    if not len(finite) or finite.min() <= 0 or finite.max() <= 40 * finite.min():
        ax.set_ylim(bottom=0.0)
        return
    ticker = needed("matplotlib.ticker", "plot")
    decades = np.log10(finite.max() / finite.min())
    ax.set_yscale("log")
    ax.yaxis.set_major_locator(ticker.LogLocator(subs=(1.0, 2.0, 5.0) if decades < 3 else (1.0,)))
    ax.yaxis.set_major_formatter(ticker.FuncFormatter(lambda value, _: f"{value:g}"))
    ax.yaxis.set_minor_formatter(ticker.NullFormatter())


_A_ROW = 5
"""Entries of a legend that fit side by side."""


def legend(ax: Any, entries: Sequence[tuple[str, dict[str, Any]]], title: str) -> None:
    """A legend in rows above the axes, and the title above it.

    * `entries`: each a name and how its sample is drawn.
    """
    rows = max(-(-len(entries) // _A_ROW), 1)
    line = needed("matplotlib.lines", "plot").Line2D
    samples = [line([], [], label=name, **{"color": INK, **look}) for name, look in entries]
    columns = max(-(-len(samples) // rows), 1)
    shown = ax.legend(
        handles=samples, loc="lower left", bbox_to_anchor=(0.0, 1.0), ncols=columns, frameon=False,
        fontsize=7.5, borderaxespad=0.2, handlelength=2.2, columnspacing=1.0, handletextpad=0.5,
    )  # fmt: skip
    # The title keeps room above the axes for it; a wide legend would make the axes narrow.
    shown.set_in_layout(False)
    ax.set_title(title or " ", color=INK, loc="left", fontsize=8.0, pad=6 + 12 * rows)
