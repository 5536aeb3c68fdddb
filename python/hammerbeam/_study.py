"""Studies, and what can be asked of them."""

import json
import tempfile
from collections.abc import Iterable, Mapping, Sequence
from os import PathLike
from pathlib import Path
from typing import Any

import numpy as np

from . import _check
from ._bundle import Bundle
from ._errors import BadInput, Interrupted, NoResult
from ._matrices import write_bundle
from ._motions import Basins, Exponents, ForcedTime, Motion, Sweep
from ._native import NativeOrbits, NativeResults, NativeStudy
from ._orbits import Orbit, Orbits
from ._progress import Progress, interruptible, watched
from ._results import Results
from ._tables import Array, array
from ._toml import study_text

AnyPath = str | PathLike[str]
Initial = str | Mapping[str, float] | Sequence[float] | Array
"""A state at phase 0: `"rest"`; `"linear"`, the motion without contacts; the numbers of a modal state;
`{"tip.y": 1e-3, "tip.v": 0.2}` for points in space; or `"branch:3"`, the orbit in which that branch of
`results` crosses the frequency."""

_MOST_PERIODS = 100_000_000


class Modes:
    """Eigenfrequencies before and after the reduction, and mode shapes at points.

    * `frequency_hz`: of the equations of motion [Hz]; `clamped_hz`: as supported; `free_interface_hz`,
      `fixed_interface_hz`, `reduced_hz`: of the reduction.
    * `shapes`: of each point by its name, mass-normalised.
    * `report`: as `modes --json` says.
    """

    def __init__(self, report: Mapping[str, Any], check: Mapping[str, Any]) -> None:
        self.report = report
        self.frequency_hz = np.array(check["eigenfrequencies_hz"], dtype=float)
        self.clamped_hz = np.array(report["clamped_hz"], dtype=float)
        self.free_interface_hz = np.array(report["free_interface_hz"], dtype=float)
        self.fixed_interface_hz = np.array(report["fixed_interface_hz"], dtype=float)
        self.reduced_hz = np.array(report["reduced_hz"], dtype=float)
        self.shapes = {name: np.array(shape) for name, shape in report["mass_normalised_shapes"].items()}

    def __repr__(self) -> str:
        return f"<Modes {np.array2string(self.frequency_hz, precision=6, threshold=8)} Hz>"


class Study:
    """A structure, its stops and its excitation, with the equations of motion that they make.

    Made by `Study.read`, `Study.parse`, `Study.from_dict` or `Study.from_matrices`. Methods do what the
    commands of the same names do. Each works without the interpreter's lock, shows its progress as
    `progress` says, and ends on Ctrl-C with `Interrupted`; what was stored in `out` by then is kept, and the
    same call goes on from there.
    """

    def __init__(self, native: NativeStudy, bundle: Bundle | None = None) -> None:
        if not isinstance(native, NativeStudy):
            raise BadInput(
                f"found {native!r}; a study is made by Study.read(path), Study.parse(text), "
                "Study.from_dict(tables) or Study.from_matrices(M, K, ...)"
            )
        self._native, self._bundle = native, bundle

    @classmethod
    def read(cls, path: AnyPath) -> "Study":
        """Reads a study file."""
        return cls(NativeStudy.read(_check.folder("path", path)))

    @classmethod
    def parse(cls, text: str, folder: AnyPath = ".") -> "Study":
        """Reads a study from a text in the form of a study file.

        * `folder`: to which names of files in it are relative.
        """
        if not isinstance(text, str):
            raise BadInput(f"text: found {text!r}, must be a text in the form of a study file")
        try:
            text.encode()
        except UnicodeEncodeError:
            raise BadInput("text: must be Unicode") from None
        return cls(NativeStudy.parse(str(_check.folder("folder", folder) / "study"), text))

    @classmethod
    def from_dict(cls, tables: Mapping[str, Any], folder: AnyPath = ".") -> "Study":
        """A study from a dictionary with the tables and keys of a study file."""
        return cls.parse(study_text(tables), folder)

    @classmethod
    def from_matrices(
        cls,
        M: Any,
        K: Any,
        C: Any = None,
        *,
        points: Mapping[str, int],
        fixed: Sequence[int] = (),
        folder: AnyPath | None = None,
        **tables: Any,
    ) -> "Study":
        """A study of a structure given by its matrices, in SI units.

        * `M`, `K`, `C`: mass, stiffness and damping, symmetric, of n rows: arrays, or sparse matrices of
          SciPy.
        * `points`: rows by names, from 0 on; stops, loads and the response go by these names.
        * `fixed`: rows that are held.
        * `folder`: where `K.mtx`, `M.mtx`, `C.mtx` and `study.toml` are written; by default somewhere
          temporary, and with the results of a run into its folder.
        * `tables`: further tables of the study file: `excitation`, `stop` (a list), `load`, `reduction`,
          `response`, `title` and so on.
        """
        matrices = {"K": K, "M": M, "C": C}
        if folder is not None:
            return cls.read(write_bundle(_check.folder("folder", folder), matrices, points, fixed, tables))
        bundle = Bundle(matrices, points, fixed, tables)
        return cls(bundle.study(), bundle)

    @property
    def text(self) -> str:
        """The study file."""
        return self._native.text

    def text_with(self, settings: Mapping[str, Any]) -> str:
        """The study file with other values of its keys, as `--set` of the command gives them.

        * `settings`: values by keys such as `stop.1.gap_m`; a text may have its unit, as in `"2 mm"`.
        """
        if not isinstance(settings, Mapping):
            raise BadInput(f"settings: found {settings!r}, must be a dictionary of values by keys")
        return self._native.text_with([_check.setting(key, value) for key, value in settings.items()])

    def with_values(self, settings: Mapping[str, Any]) -> "Study":
        """The study with other values of its keys, on the same structure.

        * `settings`: as in `text_with`.

        Matrices of `from_matrices` are shared, and kept as long as one of the studies is there.
        """
        text = self.text_with(settings)
        if self._bundle is None:
            return Study(NativeStudy.parse(self._native.name, text))
        return Study(self._bundle.study(text), self._bundle)

    @property
    def title(self) -> str:
        """Its title."""
        return self._native.title

    @property
    def dof(self) -> int:
        """Number of modes n; a state has 2n entries."""
        return self._native.dof

    @property
    def points(self) -> list[str]:
        """Names of the points of the structure."""
        return self._native.points

    @property
    def range_hz(self) -> tuple[float, float] | None:
        """Range of the excitation frequency [Hz], if there is an excitation."""
        return self._native.range_hz

    def check(self) -> dict[str, Any]:
        """What was understood, as `check --json` says."""
        return _loads(self._native.check())

    def modes(self) -> Modes:
        """Eigenfrequencies and mode shapes."""
        return Modes(_loads(self._native.modes()), self.check())

    def run(
        self,
        out: AnyPath,
        jobs: int | None = None,
        progress: Progress = None,
        *,
        start_from: Sequence[AnyPath] = (),
        figures: bool = True,
    ) -> Results:
        """Everything that the study asks for, into a results folder.

        * `out`: made if it is not there; a run that was stopped goes on from there.
        * `jobs`: number of threads, all cores by default; results do not depend on it.
        * `start_from`: results folders of sweeps and basins, at whose motions branches begin as well; or
          `FOLDER:POINT` for a special point of its branches, by the number that the page shows.
        * `figures`: whether figures and the page are drawn at the end.
        """
        folder = _check.folder("out", out)
        native = self._placed(folder)
        if isinstance(start_from, (str, bytes, PathLike)) or not isinstance(start_from, Iterable):
            raise BadInput(f"start_from: found {start_from!r}, must be a list of folders")
        folders = [str(_check.folder("start_from", one)) for one in start_from]
        asked = (folder, folders, _check.jobs(jobs), bool(figures))
        kept = f"what was computed is kept in {folder}, the same call goes on from there"
        with interruptible(kept), watched(progress) as callbacks:
            report, is_interrupted = native.run(asked, callbacks)
        found = _loads(report)
        if is_interrupted:
            raise Interrupted(f"interrupted; {kept}")
        if not found["branches"]:
            low, high = self.range_hz or (0.0, 0.0)
            raise NoResult(
                f"no periodic solution was found between {low} Hz and {high} Hz", name="NoBranches"
            )
        return Results(folder, report=found)

    def orbits(self, frequency_hz: float, period_multiple: int = 1, progress: Progress = None) -> Orbits:
        """All periodic solutions of a period at a frequency that are found."""
        hertz = _check.frequency("frequency_hz", frequency_hz)
        multiple = _check.whole("period_multiple", period_multiple, 1, 64)
        found: tuple[NativeOrbits, str | None]
        with interruptible("nothing was written"), watched(progress) as callbacks:
            found = self._native.orbits(hertz, multiple, callbacks)
        return Orbits(*found)

    def orbit(self, frequency_hz: float, period_multiple: int = 1, progress: Progress = None) -> Orbit:
        """The periodic solution at a frequency that the search comes to first; `orbits` has the others.

        Raises `NoResult` if none is found.
        """
        found = self.orbits(frequency_hz, period_multiple, progress)
        if not found:
            place = f"{period_multiple} excitation period(s) was found at {float(frequency_hz)} Hz"
            message = f"no periodic solution of {place}"
            raise NoResult(message + (f"; {found.incomplete}" if found.incomplete else ""), name="NoOrbit")
        return found[0]

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
        forced, free = None, None
        if self.range_hz is None:
            given = {
                "frequency_hz": frequency_hz,
                "periods": periods,
                "samples_per_period": samples_per_period,
            }
            given |= {"transient_periods": transient_periods or None, "section_phase": section_phase or None}
            for name, value in given.items():
                if value is not None:
                    message = (
                        "the study has no [excitation], so no period; allowed: duration_s and sampling_hz"
                    )
                    raise BadInput(f"{name}: {message}")
            if duration_s is None:
                raise BadInput("duration_s is missing: the study has no [excitation], so no period to count")
            sampling = None if sampling_hz is None else _check.frequency("sampling_hz", sampling_hz)
            free = (_check.seconds("duration_s", duration_s), sampling)
        else:
            if sampling_hz is not None:
                message = "sampling_hz is for a study without [excitation]; allowed here: samples_per_period"
                raise BadInput(message)
            if frequency_hz is None:
                raise BadInput("frequency_hz is missing: the study has an [excitation]")
            if periods is not None and duration_s is not None:
                raise BadInput("periods and duration_s are given; allowed: one of them")
            hertz = _check.frequency("frequency_hz", frequency_hz)
            seconds = None if duration_s is None else _check.seconds("duration_s", duration_s)
            count = 10 if periods is None else _check.whole("periods", periods, 1, _MOST_PERIODS)
            transient = _check.whole("transient_periods", transient_periods, 0, _MOST_PERIODS)
            samples = 100 if samples_per_period is None else samples_per_period
            sampled = _check.whole("samples_per_period", samples, 1, 1_000_000)
            forced = ForcedTime(hertz, transient, count, seconds, sampled)
        start = (_check.phase("section_phase", section_phase), _check.initial(initial))
        stored = _check.optional_folder("results", results)
        place = _check.optional_folder("out", out)
        with tempfile.TemporaryDirectory(prefix="hammerbeam-") as temporary:
            folder = Path(temporary) / "motion" if place is None else place
            native = self._native if place is None else self._placed(place)
            with interruptible(_kept(place)), watched(progress) as callbacks:
                report = _loads(native.simulate((forced, free), start, (stored, folder), callbacks))
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
        asked = self._sweep_asked(from_hz, to_hz, step_hz, starts, down, initial, samples)
        spent = _effort(transient_periods, patience_periods, longest_period, averaged_periods)
        place = _check.optional_folder("out", out)
        folders = (_check.optional_folder("results", results), place, _taken(parts))
        with interruptible(_kept(place)), watched(progress) as callbacks:
            report = self._placed(place).sweep(*asked, (spent, _check.jobs(jobs)), folders, callbacks)
        found = _loads(report)
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
        jobs: int | None = None,
        progress: Progress = None,
        **spent: int,
    ) -> dict[str, Any]:
        """A part of the frequencies of a `sweep` with `starts`, into a folder.

        * `part`: as `(2, 4)`, the second of four.
        * `spent`: `transient_periods` and so on, as in `sweep`.
        """
        asked = self._sweep_asked(from_hz, to_hz, step_hz, starts, False, "rest", samples)
        place = _check.folder("out", out)
        folders = (None, place, _only(part))
        effort = (_effort(**{**_EFFORT, **spent}), _check.jobs(jobs))
        with interruptible(_kept(place)), watched(progress) as callbacks:
            return _loads(self._placed(place).sweep(*asked, effort, folders, callbacks))

    def _sweep_asked(
        self, from_hz: Any, to_hz: Any, step_hz: Any, starts: Any, down: Any, initial: Any, samples: Any
    ) -> tuple[tuple[float, float, float | None], tuple[str, bool, int | None, int]]:
        low, high = self.range_hz or (None, None)
        series = _series(low if from_hz is None else from_hz, high if to_hz is None else to_hz, step_hz)
        if starts is not None and (down or not isinstance(initial, str) or initial != "rest"):
            raise BadInput("starts: cannot be used with down or initial")
        many = None if starts is None else _check.whole("starts", starts, 1, 100_000)
        return series, (
            _check.initial(initial),
            bool(down),
            many,
            _check.whole("samples", samples, 1, 100_000),
        )

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
        series = _series(frequency_hz, frequency_hz if to_hz is None else to_hz, step_hz)
        asked = (
            _check.initial(initial),
            _check.whole("transient_periods", transient_periods, 0, _MOST_PERIODS),
            _check.whole("periods", periods, 20, _MOST_PERIODS),
            _check.whole("sections_per_period", sections_per_period, 1, 1024),
        )
        place = _check.optional_folder("out", out)
        folders = (_check.optional_folder("results", results), place)
        with interruptible(_kept(place)), watched(progress) as callbacks:
            return Exponents(_loads(self._placed(place).lyapunov(series, asked, folders, callbacks)))

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
        asked = (_axis("x", x), _axis("y", y), _check.whole("grid", grid, 1, 10_000))
        spent = _effort(transient_periods, patience_periods, longest_period, averaged_periods)
        place = _check.optional_folder("out", out)
        folders = (_check.optional_folder("results", results), place, _taken(parts))
        with interruptible(_kept(place)), watched(progress) as callbacks:
            report = self._placed(place).basins(hertz, asked, (spent, _check.jobs(jobs)), folders, callbacks)
        found = _loads(report)
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
        jobs: int | None = None,
        progress: Progress = None,
        **spent: int,
    ) -> dict[str, Any]:
        """A part of the cells of `basins`, into a folder.

        * `part`: as `(2, 4)`, the second of four.
        * `spent`: `transient_periods` and so on, as in `basins`.
        """
        hertz = _check.frequency("frequency_hz", frequency_hz)
        asked = (_axis("x", x), _axis("y", y), _check.whole("grid", grid, 1, 10_000))
        place = _check.folder("out", out)
        folders = (None, place, _only(part))
        effort = (_effort(**{**_EFFORT, **spent}), _check.jobs(jobs))
        with interruptible(_kept(place)), watched(progress) as callbacks:
            return _loads(self._placed(place).basins(hertz, asked, effort, folders, callbacks))

    def placed(self, folder: AnyPath) -> "Study":
        """The same study, with matrices that are somewhere temporary copied into a folder, which goes on
        being read."""
        return Study(self._placed(_check.folder("folder", folder)))

    def _placed(self, out: Path | None) -> NativeStudy:
        """The study, with matrices that are somewhere temporary copied to its results, which go on being
        read."""
        if self._bundle is None or out is None:
            return self._native
        return self._bundle.placed(self.text, out)

    def __repr__(self) -> str:
        return f"<Study {self.title or self._native.name!r}, {self.dof} modes>"

    def _repr_markdown_(self) -> str:
        return f"**{self.title}**\n\n```toml\n{self.text.strip()}\n```"


def _loads(document: str) -> dict[str, Any]:
    found: dict[str, Any] = json.loads(document)
    return found


def _kept(out: Path | None) -> str:
    if out is None:
        return "nothing is kept without out"
    return f"what was computed is kept in {out}, the same call goes on from there"


def _series(from_hz: Any, to_hz: Any, step_hz: Any) -> tuple[float, float, float | None]:
    if from_hz is None or to_hz is None:
        raise BadInput(
            "the study has no [excitation]: without a frequency there are no periodic responses to look for"
        )
    step = None if step_hz is None else _check.frequency("step_hz", step_hz)
    return _check.frequency("from_hz", from_hz), _check.frequency("to_hz", to_hz), step


_EFFORT = {"transient_periods": 50, "patience_periods": 500, "longest_period": 32, "averaged_periods": 1000}


def _effort(
    transient_periods: Any, patience_periods: Any, longest_period: Any, averaged_periods: Any
) -> tuple[int, int, int, int]:
    return (
        _check.whole("transient_periods", transient_periods, 0, _MOST_PERIODS),
        _check.whole("patience_periods", patience_periods, 1, _MOST_PERIODS),
        _check.whole("longest_period", longest_period, 1, 1024),
        _check.whole("averaged_periods", averaged_periods, 240, 10_000_000),
    )


def _taken(parts: Sequence[AnyPath]) -> tuple[None, list[Path]]:
    """Folders of parts, as the extension takes them."""
    if isinstance(parts, (str, bytes)) or not isinstance(parts, Sequence):
        raise BadInput(f"parts: found {parts!r}, must be a list of folders")
    return None, [_check.folder("parts", one) for one in parts]


def _only(part: Any) -> tuple[str, list[Path]]:
    """A part to compute, as the extension takes it."""
    try:
        number, of = part
    except (TypeError, ValueError):
        raise BadInput(f"part: found {part!r}, must be (K, N), as in (2, 4)") from None
    most = 2**32 - 1
    return f"{_check.whole('part', number, 1, most)}/{_check.whole('part', of, 1, most)}", []


def _axis(name: str, axis: Any) -> tuple[str, float, float]:
    try:
        coordinate, low, high = axis
    except (TypeError, ValueError):
        coordinate = None
        low = high = 0.0
    if not isinstance(coordinate, str):
        raise BadInput(f"{name}: found {axis!r}, must be (NAME, LOW, HIGH), as in ('q1', -1e-3, 1e-3)")
    low, high = _check.number(name, low), _check.number(name, high)
    if max(abs(low), abs(high)) > 1e100:
        raise BadInput(f"{name}: must be numbers from -1e100 to 1e100")
    if high <= low:
        raise BadInput(f"{name}: the range {low}..{high} is empty; LOW must be below HIGH")
    return _check.word(name, coordinate), low, high
