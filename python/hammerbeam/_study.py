"""Studies, and what can be asked of them."""

from collections.abc import Sequence
from os import PathLike

from . import _check
from ._attractors import Attractors
from ._errors import Interrupted, NoResult
from ._model import AnyPath, loads
from ._native import NativeOrbits
from ._orbits import Orbit, Orbits
from ._progress import Progress, interruptible, watched
from ._results import Results


class Study(Attractors):
    """A structure, its stops and its excitation, with the equations of motion that they make.

    Made by `Study.read`, `Study.parse`, `Study.from_dict` or `Study.from_matrices`. Methods do what the
    commands of the same names do. Each works without the interpreter's lock, shows its progress as
    `progress` says, and ends on Ctrl-C with `Interrupted`; what was stored in `out` by then is kept, and the
    same call goes on from there.
    """

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
        if isinstance(start_from, PathLike):
            raise _check.refused("start_from", start_from, "must be a list of folders")
        given = _check.entries("start_from", start_from, "must be a list of folders")
        folders = [str(_check.folder("start_from", one)) for one in given]
        asked = (folder, folders, _check.jobs(jobs), _check.flag("figures", figures))
        kept = f"what was computed is kept in {folder}, the same call goes on from there"
        with interruptible(kept), watched(progress) as callbacks:
            report, is_interrupted = native.run(asked, callbacks)
        found = loads(report)
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
            place = f"period {period_multiple} was found at {float(frequency_hz)} Hz"
            message = f"no periodic solution of {place}"
            raise NoResult(message + (f"; {found.incomplete}" if found.incomplete else ""), name="NoOrbit")
        return found[0]
