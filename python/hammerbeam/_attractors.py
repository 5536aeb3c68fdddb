"""Motions of a study in time: simulated, swept, their exponents, their basins."""

import tempfile
from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from . import _asked, _check
from ._errors import BadInput, NoResult
from ._model import AnyPath, Model, loads
from ._motions import Basins, Exponents, Motion, Sweep
from ._native import NativeResults
from ._progress import Progress, interruptible, watched
from ._tables import Array, array

Initial = str | Mapping[str, float] | Sequence[float] | Array
"""A state at phase 0: `"rest"`; `"linear"`, the motion without contacts; the numbers of a modal state;
`{"tip.y": 1e-3, "tip.v": 0.2}` for points in space; or `"branch:3"`, the orbit in which that branch of
`results` crosses the frequency."""


class Attractors(Model):
    """What `Study` computes of motions that need not repeat."""

    def simulate(
        self,
        frequency_hz: float | None = None,
        *,
        periods: int | None = None,
        duration_s: float | None = None,
        transient_periods: int = 0,
        samples_per_period: int | None = None,
        sampling_hz: float | None = None,
        initial: Initial = "rest",
        section_phase: float = 0.0,
        results: AnyPath | None = None,
        out: AnyPath | None = None,
        progress: Progress = None,
    ) -> Motion:
        """A motion in time: so many periods of the excitation, or a duration of a study without one."""
        skipped = _check.whole("transient_periods", transient_periods, 0, _asked.MOST_PERIODS)
        start = (_check.phase("section_phase", section_phase), _check.initial(initial))
        forced, free = None, None
        if self.range_hz is None:
            only_forced = {
                "frequency_hz": frequency_hz,
                "periods": periods,
                "samples_per_period": samples_per_period,
                "transient_periods": skipped or None,
                "section_phase": start[0] or None,
            }
            free = _asked.free_time(duration_s, sampling_hz, only_forced)
        else:
            if sampling_hz is not None:
                message = "sampling_hz is for a study without [excitation]; allowed here: samples_per_period"
                raise BadInput(message)
            forced = _asked.forced_time(frequency_hz, periods, duration_s, skipped, samples_per_period)
        stored = _check.optional_folder("results", results)
        place = _check.optional_folder("out", out)
        with tempfile.TemporaryDirectory(prefix="hammerbeam-") as temporary:
            folder = Path(temporary) / "motion" if place is None else place
            native = self._native if place is None else self._placed(place)
            with interruptible(_asked.kept(place)), watched(progress) as callbacks:
                report = loads(native.simulate((forced, free), start, (stored, folder), callbacks))
            read = NativeResults.open(folder)
            try:
                tables = {packed[0]: array(packed) for packed in read.request_tables(report["request"])}
            finally:
                read.close()
        if place is None:
            report["results"] = report["request"] = None
        return Motion(report, tables)

    def sweep(
        self,
        from_hz: float | None = None,
        to_hz: float | None = None,
        step_hz: float | None = None,
        *,
        down: bool = False,
        starts: int | None = None,
        initial: Initial = "rest",
        samples: int = 64,
        transient_periods: int = 50,
        patience_periods: int = 500,
        longest_period: int = 32,
        averaged_periods: int = 1000,
        results: AnyPath | None = None,
        out: AnyPath | None = None,
        parts: Sequence[AnyPath] = (),
        jobs: int | None = None,
        progress: Progress = None,
    ) -> Sweep:
        """Settled motions over the frequency, the range of the study by default: each begun where the one
        before has ended, or, with `starts`, at so many states at every frequency.

        * `parts`: folders of `sweep_part`, whose motions are taken from there; the rest is computed.
        """
        asked = self._range_or(from_hz, to_hz, step_hz), _asked.swept(starts, down, initial, samples)
        spent = _asked.effort(transient_periods, patience_periods, longest_period, averaged_periods)
        place = _check.optional_folder("out", out)
        folders = (_check.optional_folder("results", results), place, _asked.taken(parts))
        with interruptible(_asked.kept(place)), watched(progress) as callbacks:
            report = self._placed(place).sweep(*asked, (spent, _check.jobs(jobs)), folders, callbacks)
        found = loads(report)
        if not found["motions"]:
            raise NoResult("no motion could be computed", name="NoMotion")
        return Sweep(found)

    def sweep_part(
        self,
        part: tuple[int, int],
        out: AnyPath,
        *,
        starts: int,
        from_hz: float | None = None,
        to_hz: float | None = None,
        step_hz: float | None = None,
        samples: int = 64,
        transient_periods: int = 50,
        patience_periods: int = 500,
        longest_period: int = 32,
        averaged_periods: int = 1000,
        jobs: int | None = None,
        progress: Progress = None,
    ) -> dict[str, Any]:
        """A part of the frequencies of a `sweep` with `starts`, into a folder.

        * `part`: as `(2, 4)`, the second of four.
        """
        asked = self._range_or(from_hz, to_hz, step_hz), _asked.swept(starts, False, "rest", samples)
        place = _check.folder("out", out)
        folders = (None, place, _asked.only(part))
        spent = _asked.effort(transient_periods, patience_periods, longest_period, averaged_periods)
        with interruptible(_asked.kept(place)), watched(progress) as callbacks:
            return loads(self._placed(place).sweep(*asked, (spent, _check.jobs(jobs)), folders, callbacks))

    def _range_or(self, from_hz: Any, to_hz: Any, step_hz: Any) -> tuple[float, float, float | None]:
        """A series of frequencies, the range of the study by default."""
        low, high = self.range_hz or (None, None)
        return _asked.series(low if from_hz is None else from_hz, high if to_hz is None else to_hz, step_hz)

    def lyapunov(
        self,
        frequency_hz: float,
        to_hz: float | None = None,
        step_hz: float | None = None,
        *,
        periods: int = 1000,
        transient_periods: int = 200,
        sections_per_period: int = 1,
        initial: Initial = "rest",
        results: AnyPath | None = None,
        out: AnyPath | None = None,
        progress: Progress = None,
    ) -> Exponents:
        """Lyapunov exponents of a motion at a frequency, or at a series of them."""
        series = _asked.series(frequency_hz, frequency_hz if to_hz is None else to_hz, step_hz)
        asked = (
            _check.initial(initial),
            _check.whole("transient_periods", transient_periods, 0, _asked.MOST_PERIODS),
            _check.whole("periods", periods, 20, _asked.MOST_PERIODS),
            _check.whole("sections_per_period", sections_per_period, 1, 1024),
        )
        place = _check.optional_folder("out", out)
        folders = (_check.optional_folder("results", results), place)
        with interruptible(_asked.kept(place)), watched(progress) as callbacks:
            return Exponents(loads(self._placed(place).lyapunov(series, asked, folders, callbacks)))

    def basins(
        self,
        frequency_hz: float,
        x: tuple[str, float, float],
        y: tuple[str, float, float],
        grid: int = 50,
        *,
        transient_periods: int = 50,
        patience_periods: int = 500,
        longest_period: int = 32,
        averaged_periods: int = 1000,
        results: AnyPath | None = None,
        out: AnyPath | None = None,
        parts: Sequence[AnyPath] = (),
        jobs: int | None = None,
        progress: Progress = None,
    ) -> Basins:
        """Which attractor each of a grid of initial states leads to.

        * `x`, `y`: coordinate with its range, such as `("q1", -1e-3, 1e-3)`: `q1` .. `qn`, `v1` .. `vn`,
          `displacement` or `velocity`.
        * `parts`: folders of `basins_part`, whose cells are taken from there; the rest is computed.
        """
        hertz = _check.frequency("frequency_hz", frequency_hz)
        asked = (_asked.axis("x", x), _asked.axis("y", y), _check.whole("grid", grid, 1, 10_000))
        spent = _asked.effort(transient_periods, patience_periods, longest_period, averaged_periods)
        place = _check.optional_folder("out", out)
        folders = (_check.optional_folder("results", results), place, _asked.taken(parts))
        with interruptible(_asked.kept(place)), watched(progress) as callbacks:
            report = self._placed(place).basins(hertz, asked, (spent, _check.jobs(jobs)), folders, callbacks)
        found = loads(report)
        if found["cells_not_computed"] == len(found["cells"]):
            raise NoResult(f"no motion from any of the {len(found['cells'])} cells", name="NoCell")
        return Basins(found)

    def basins_part(
        self,
        part: tuple[int, int],
        out: AnyPath,
        *,
        frequency_hz: float,
        x: tuple[str, float, float],
        y: tuple[str, float, float],
        grid: int = 50,
        transient_periods: int = 50,
        patience_periods: int = 500,
        longest_period: int = 32,
        averaged_periods: int = 1000,
        jobs: int | None = None,
        progress: Progress = None,
    ) -> dict[str, Any]:
        """A part of the cells of `basins`, into a folder.

        * `part`: as `(2, 4)`, the second of four.
        """
        hertz = _check.frequency("frequency_hz", frequency_hz)
        asked = (_asked.axis("x", x), _asked.axis("y", y), _check.whole("grid", grid, 1, 10_000))
        place = _check.folder("out", out)
        folders = (None, place, _asked.only(part))
        spent = _asked.effort(transient_periods, patience_periods, longest_period, averaged_periods)
        with interruptible(_asked.kept(place)), watched(progress) as callbacks:
            report = self._placed(place).basins(hertz, asked, (spent, _check.jobs(jobs)), folders, callbacks)
        return loads(report)
