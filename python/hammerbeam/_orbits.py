"""Periodic solutions with their motion, states and multipliers."""

from collections.abc import Iterator, Sequence
from functools import cached_property
from typing import Any, overload

import numpy as np

from . import _plot
from ._check import whole
from ._native import NativeOrbits
from ._tables import Array, array

MOST_SAMPLES = 1_000_000


class _Number:
    """A number of the row of an orbit."""

    def __init__(self, column: str, doc: str) -> None:
        self._column, self.__doc__ = column, doc

    def __get__(self, orbit: Any, owner: Any = None) -> float:
        return self if orbit is None else float(orbit._row[self._column])  # type: ignore[return-value]


class Orbit:
    """A periodic solution.

    Numbers are those of a row of the branches; `state` is `[q; q']` in modal coordinates at `phase_cycles`
    of the excitation, `multipliers` holds all Floquet multipliers, the largest first.
    """

    def __init__(self, orbits: NativeOrbits, index: int, row: Any) -> None:
        self._orbits, self._index, self._row = orbits, index, row

    frequency_hz = _Number("frequency_hz", "Excitation frequency [Hz].")
    max_abs_displacement_m = _Number(
        "max_abs_displacement_m", "Largest displacement of the response point [m]."
    )
    max_abs_acceleration_m_s2 = _Number("max_abs_acceleration_m_s2", "Its largest acceleration [m/s^2].")
    max_contact_force_n = _Number("max_contact_force_n", "Largest contact force [N].")
    max_impact_velocity_m_s = _Number("max_impact_velocity_m_s", "Largest impact velocity [m/s].")
    impulse_n_s = _Number("impulse_n_s", "Impulse of all contacts [N s].")
    residual = _Number("residual", "Largest mismatch of the shooting equations, relative to the orbit.")
    error_estimate = _Number("error_estimate", "Estimated error of the nodes, relative to the orbit.")
    phase_cycles = _Number("phase_cycles", "Phase of the excitation at which the orbit begins [cycles].")

    @property
    def period_multiple(self) -> int:
        """Orbit period over excitation period."""
        return int(self._row["period_multiple"])

    @property
    def contacts(self) -> int:
        """Number of contacts in an orbit period."""
        return int(self._row["contacts"])

    @property
    def event(self) -> str:
        """Its events, joined by `+`."""
        return str(self._row["event"])

    @property
    def branch(self) -> int | None:
        """Number of the branch that holds it."""
        number = int(self._row["branch"])
        return number if number > 0 else None

    @property
    def stable(self) -> bool:
        """Whether all multipliers lie inside the unit circle, beyond doubt."""
        return bool(self._row["stable"])

    @property
    def stability(self) -> str:
        """`stable`, `marginal` or `unstable`."""
        return str(self._row["stability"])

    @property
    def state(self) -> np.ndarray[Any, np.dtype[np.float64]]:
        """`[q; q']` at the phase at which the orbit begins."""
        return np.array(self._row["state"])

    @property
    def multipliers(self) -> np.ndarray[Any, np.dtype[np.complex128]]:
        """All Floquet multipliers, the largest first."""
        values: np.ndarray[Any, np.dtype[np.complex128]] = np.array(self._row["multipliers"])
        known: np.ndarray[Any, np.dtype[np.complex128]] = values[~np.isnan(values)]
        return known

    @cached_property
    def nodes(self) -> np.ndarray[Any, np.dtype[np.float64]]:
        """Shooting nodes, one row for each segment."""
        return np.array(self._orbits.nodes(self._index))

    def waveform(self, samples: int = 256) -> Array:
        """The motion over the period of the orbit, from phase 0 of the excitation on.

        * `samples`: in each excitation period.

        Returns a structured array: `time_s`, `phase_cycles`, for every point `<point>_displacement_m`,
        `<point>_velocity_m_s` and `<point>_acceleration_m_s2`, for every stop `<stop>_force_n`, and `state`.
        """
        count = whole("samples", samples, 1, MOST_SAMPLES)
        return array(self._orbits.waveform(self._index, count))

    def plot(self, ax: Any = None, point: str | None = None) -> Any:
        """Draws the displacement of a point, the response point by default, over the period, with
        matplotlib."""
        return _plot.orbit(self.waveform(), self, self._orbits.response_point if point is None else point, ax)

    def __repr__(self) -> str:
        size = f"{self.max_abs_displacement_m:.6e} m"
        return f"<Orbit {self.frequency_hz:.6g} Hz, period {self.period_multiple}, {self.stability}, {size}>"


class Orbits(Sequence[Orbit]):
    """Periodic solutions; `table` has a row for each. A slice of them is `Orbits` again.

    * `incomplete`: why a search for them is not complete, in words.
    """

    def __init__(self, orbits: NativeOrbits, incomplete: str | None = None) -> None:
        self._native = orbits
        self.incomplete = incomplete
        self.table: Array = array(orbits.table())

    def __len__(self) -> int:
        return len(self.table)

    @overload
    def __getitem__(self, index: int) -> Orbit: ...
    @overload
    def __getitem__(self, index: slice) -> "Orbits": ...
    def __getitem__(self, index: int | slice) -> "Orbit | Orbits":
        if isinstance(index, slice):
            places = range(*index.indices(len(self)))
            return Orbits(self._native.chosen(list(places)), self.incomplete)
        place = range(len(self))[index]
        return Orbit(self._native, place, self.table[place])

    def __iter__(self) -> Iterator[Orbit]:
        return (self[k] for k in range(len(self)))

    def __repr__(self) -> str:
        return f"<Orbits {list(self)}>"
