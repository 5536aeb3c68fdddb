"""Results folders."""

import html
import tempfile
from collections.abc import Mapping, Sequence
from os import PathLike
from pathlib import Path
from types import TracebackType
from typing import TYPE_CHECKING, Any

import numpy as np

from . import _check, _export, _plot
from ._errors import BadInput, ClosedResults, DrawingError
from ._native import NativeResults
from ._orbits import MOST_SAMPLES, Orbits
from ._progress import Progress, interruptible, watched
from ._tables import Array, array

if TYPE_CHECKING:
    from ._study import Study

AnyPath = str | PathLike[str]
Branches = int | Sequence[int] | Array | None
"""Numbers of branches; `None` for all."""


class Page:
    """The page of a results folder; a notebook shows it in a frame."""

    def __init__(self, path: Path) -> None:
        self.path = path

    def _repr_html_(self) -> str:
        document = html.escape(self.path.read_text(encoding="utf-8"), quote=True)
        return f'<iframe srcdoc="{document}" width="100%" height="720" style="border:0"></iframe>'

    def __repr__(self) -> str:
        return f"<Page {self.path}>"


class Results:
    """A results folder, open for reading. Shows itself in a notebook as its response diagram.

    Tables are structured arrays with the columns of the tables of `hammerbeam export`; `hammerbeam.frame`
    makes data frames of them. `report` is what the run that made it said, if it did.
    """

    def __init__(self, folder: AnyPath, *, report: Mapping[str, Any] | None = None) -> None:
        # Absolute: the folder stays the same when the working directory changes.
        self._native = NativeResults.open(_check.folder("folder", folder).absolute())
        self.report = report

    @property
    def folder(self) -> Path:
        """The folder."""
        return Path(self._native.folder)

    @property
    def study(self) -> "Study":
        """The study whose results these are."""
        from ._study import Study

        return Study(self._native.study)

    def branches(self, branch: Branches = None) -> Array:
        """One row per solution, end to end along each branch: the columns of `branches.csv`, with
        `stability` in words beside `stable`."""
        return self._table("branches", branch)

    def events(self, branch: Branches = None) -> Array:
        """One row per event: the columns of `events.csv`."""
        return self._table("events", branch)

    def ends(self, branch: Branches = None) -> Array:
        """One row per end of a branch: why it ended, and its last state."""
        return self._table("ends", branch)

    def states(self, branch: Branches = None) -> Array:
        """One row per solution: `state`, `[q; q']` at `phase_cycles`, and all `multipliers`, complex."""
        return self._table("states", branch)

    def outputs(self, branch: Branches = None) -> Array:
        """One row per solution and `[[output]]` of the study: extrema, mean, root mean square, harmonics."""
        return self._table("outputs", branch)

    def varied(self) -> dict[str, Array]:
        """`parameter_branches` and `curves`, as far as the study asks for them."""
        return {packed[0]: array(packed) for packed in self._native.tables("varied", [])}

    def motions(self) -> dict[str, Array]:
        """Tables of motions, sweeps, exponents and basins in the folder, with the numbers of their
        requests."""
        return {packed[0]: array(packed) for packed in self._native.tables("motions", [])}

    def orbits(
        self,
        frequency_hz: float | Sequence[float] | Array | None = None,
        *,
        branch: Branches = None,
        event: str | Sequence[str] | None = None,
    ) -> Orbits:
        """Orbits in which branches cross frequencies, and solutions with events such as `"fold"` or
        `"grazing"`."""
        frequencies = [] if frequency_hz is None else _check.numbers("frequency_hz", frequency_hz)
        events = [] if event is None else _check.words("event", event)
        if not frequencies and not events:
            raise BadInput("orbits: which are meant is missing; allowed: frequency_hz, event, or both")
        if (numbers := _numbers(branch)) is None:
            numbers = [_NO_BRANCH]
        return Orbits(self._native.orbits(numbers, frequencies, events))

    def frame(self, branch: Branches = None) -> Any:
        """The branches as a data frame of pandas."""
        from ._tables import frame

        return frame(self.branches(branch))

    def plot(self, quantity: str = "displacement", ax: Any = None) -> Any:
        """Draws the response diagram with matplotlib: `displacement`, `acceleration`, `force` or
        `velocity`."""
        return _plot.response(self.branches(), quantity, ax, self._native.study.title)

    def draw(
        self,
        out: AnyPath | None = None,
        *,
        kinds: str | Sequence[str] = (),
        formats: str | Sequence[str] = (),
        resolution: float | None = None,
        progress: Progress = None,
    ) -> list[Path]:
        """Draws figures with Hammerbeam itself, into the folder by default.

        * `kinds`: such as `response`, `orbits`, `page`; all by default. `formats`: `svg`, `png`, `pdf`.
        """
        folder = self.folder if out is None else _check.folder("out", out)
        pixels = None if resolution is None else _check.resolution(resolution)
        asked = (_check.words("kinds", kinds), _check.words("formats", formats), pixels)
        with interruptible("figures that were drawn are kept"), watched(progress) as callbacks:
            names = self._native.draw(folder, asked, callbacks)
        return [folder / name for name in names]

    def svg(self, quantity: str = "displacement") -> str:
        """The response diagram as drawn by Hammerbeam itself, as SVG.

        * `quantity`: as in `plot`.
        """
        _plot.checked_quantity(quantity)
        drawn = self._svg(quantity)
        if drawn is None:
            raise DrawingError(f"there is no diagram of {quantity}: the results have no branches with it")
        return drawn

    def _svg(self, quantity: str) -> str | None:
        with tempfile.TemporaryDirectory(prefix="hammerbeam-") as folder:
            files = self.draw(folder, kinds="response", formats="svg", progress=False)
            wanted = [path for path in files if path.name == f"response_{quantity}.svg"]
            return wanted[0].read_text(encoding="utf-8") if wanted else None

    def page(self) -> Page:
        """The page, drawn if it is not there yet."""
        self._refuse_closed()
        path = self.folder / "page.html"
        if not path.is_file():
            self.draw(kinds="page", progress=False)
        return Page(path)

    def export(self, format: str = "csv", out: AnyPath | None = None, *, states: bool = False) -> list[Path]:
        """Writes everything for other programs: `csv`, `json`, `npz`, `mat` (SciPy), `parquet` (PyArrow) or
        `hdf5` (h5py), into `export` in the folder by default.

        * `states`: also states and multipliers of every solution.
        """
        folder = self.folder / "export" if out is None else _check.folder("out", out)
        states = _check.flag("states", states)
        if _export.checked(format) in _export.WRITERS:
            more = [*(["states"] if states else []), *(["outputs"] if len(self.outputs()) else [])]
            names = ["branches", "events", "ends", *more, "varied", "motions"]
            tables = {packed[0]: array(packed) for name in names for packed in self._native.tables(name, [])}
            return _export.write(tables, format, folder, "results")
        return [Path(path) for path in self._native.export(format, folder, states)]

    def export_orbits(
        self,
        orbits: Orbits,
        format: str = "csv",
        out: AnyPath | None = None,
        *,
        samples: int = 256,
        progress: Progress = None,
    ) -> list[Path]:
        """Writes orbits with their motion at all points, states and multipliers, in the formats of
        `export`."""
        folder = self.folder / "export" if out is None else _check.folder("out", out)
        if not isinstance(orbits, Orbits):
            must = "must be Orbits, as `orbits` gives them, or a slice of them"
            raise _check.refused("orbits", orbits, must)
        self._refuse_closed()
        count = _check.whole("samples", samples, 1, MOST_SAMPLES)
        is_ours = _export.checked(format) in _export.WRITERS
        native = orbits._native
        with interruptible("orbits are written whole or not at all"), watched(progress) as callbacks:
            if is_ours:
                tables = {packed[0]: array(packed) for packed in native.tables_of_all(count, callbacks)}
                return _export.write(tables, format, folder, "orbits")
            written = NativeResults.export_orbits(native, format, folder, count, callbacks)
            return [Path(path) for path in written]

    def close(self) -> None:
        """Lets the folder go; asked for anything afterwards it raises `ClosedResults`."""
        self._native.close()

    @property
    def closed(self) -> bool:
        """Whether it was closed."""
        return self._native.closed_already

    def __enter__(self) -> "Results":
        self._refuse_closed()
        return self

    def __exit__(
        self, kind: type[BaseException] | None, value: BaseException | None, trace: TracebackType | None
    ) -> None:
        self.close()

    def _refuse_closed(self) -> None:
        if self.closed:
            message = f"the results of {self.folder} are closed"
            raise ClosedResults(message, numbers={"folder": str(self.folder)})

    def _table(self, name: str, branch: Branches) -> Array:
        numbers = _numbers(branch)
        [packed] = self._native.tables(name, [_NO_BRANCH] if numbers is None else numbers)
        return array(packed)

    def __repr__(self) -> str:
        if self.closed:
            return f"<Results {self.folder}, closed>"
        branches = self._native.branch_rows()
        solutions = sum(rows for *_, rows in branches)
        return f"<Results {self.folder}: {solutions} solutions on {len(branches)} branches>"

    def _repr_svg_(self) -> str | None:
        return None if self.closed else self._svg("displacement")


_NO_BRANCH = 2**32 - 1
"""The number of no branch: no numbers at all mean every branch to the extension."""


def _numbers(branch: Any) -> list[int] | None:
    """Numbers of branches; an empty list for all of them, `None` for none of them."""
    if branch is None:
        return []
    if isinstance(branch, np.ndarray) and branch.ndim == 1:
        branch = list(branch)
    many = branch if isinstance(branch, Sequence) and not isinstance(branch, (str, bytes)) else [branch]
    return [_check.whole("branch", one, 1, _NO_BRANCH) for one in many] or None
