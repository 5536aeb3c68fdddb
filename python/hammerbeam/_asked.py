"""What is asked of motions, checked and as the extension takes it."""

from collections.abc import Mapping, Sequence
from pathlib import Path
from typing import Any

from . import _check
from ._errors import BadInput
from ._model import AnyPath
from ._motions import ForcedTime

MOST_PERIODS = 100_000_000


def kept(out: Path | None) -> str:
    """What Ctrl-C leaves."""
    if out is None:
        return "nothing is kept without out"
    return f"what was computed is kept in {out}, the same call goes on from there"


def forced_time(
    frequency_hz: Any, periods: Any, duration_s: Any, transient_periods: int, samples_per_period: Any
) -> ForcedTime:
    """How long a motion of a study with an excitation is."""
    if frequency_hz is None:
        raise BadInput("frequency_hz is missing: the study has an [excitation]")
    if periods is not None and duration_s is not None:
        raise BadInput("periods and duration_s are given; allowed: one of them")
    samples = 100 if samples_per_period is None else samples_per_period
    return ForcedTime(
        _check.frequency("frequency_hz", frequency_hz),
        transient_periods,
        10 if periods is None else _check.whole("periods", periods, 1, MOST_PERIODS),
        None if duration_s is None else _check.seconds("duration_s", duration_s),
        _check.whole("samples_per_period", samples, 1, 1_000_000),
    )


def free_time(
    duration_s: Any, sampling_hz: Any, only_forced: Mapping[str, Any]
) -> tuple[float, float | None]:
    """How long a motion of a study without an excitation is.

    * `only_forced`: what only a forced motion has, by its name, `None` where it is not given.
    """
    for name, value in only_forced.items():
        if value is not None:
            message = "the study has no [excitation], so no period; allowed: duration_s and sampling_hz"
            raise BadInput(f"{name}: {message}")
    if duration_s is None:
        raise BadInput("duration_s is missing: the study has no [excitation], so no period to count")
    sampling = None if sampling_hz is None else _check.frequency("sampling_hz", sampling_hz)
    return _check.seconds("duration_s", duration_s), sampling


def swept(starts: Any, down: Any, initial: Any, samples: Any) -> tuple[str, bool, int | None, int]:
    """From where motions of a sweep start, and how often each is sampled."""
    falls, state = _check.flag("down", down), _check.initial(initial)
    if starts is not None and (falls or state != "rest"):
        raise BadInput("starts: cannot be used with down or initial")
    many = None if starts is None else _check.whole("starts", starts, 1, 100_000)
    return state, falls, many, _check.whole("samples", samples, 1, 100_000)


def series(from_hz: Any, to_hz: Any, step_hz: Any) -> tuple[float, float, float | None]:
    """A series of frequencies [Hz]."""
    if from_hz is None or to_hz is None:
        raise BadInput(
            "the study has no [excitation]: without a frequency there are no periodic responses to look for"
        )
    step = None if step_hz is None else _check.frequency("step_hz", step_hz)
    return _check.frequency("from_hz", from_hz), _check.frequency("to_hz", to_hz), step


def effort(
    transient_periods: Any, patience_periods: Any, longest_period: Any, averaged_periods: Any
) -> tuple[int, int, int, int]:
    """What is spent on the kind of a motion."""
    return (
        _check.whole("transient_periods", transient_periods, 0, MOST_PERIODS),
        _check.whole("patience_periods", patience_periods, 1, MOST_PERIODS),
        _check.whole("longest_period", longest_period, 1, 1024),
        _check.whole("averaged_periods", averaged_periods, 240, 10_000_000),
    )


def taken(parts: Sequence[AnyPath]) -> tuple[None, list[Path]]:
    """Folders of parts."""
    if isinstance(parts, (str, bytes)) or not isinstance(parts, Sequence):
        raise _check.refused("parts", parts, "must be a list of folders")
    return None, [_check.folder("parts", one) for one in parts]


def only(part: Any) -> tuple[str, list[Path]]:
    """A part to compute."""
    try:
        number, of = part
    except (TypeError, ValueError):
        raise _check.refused("part", part, "must be (K, N), as in (2, 4)") from None
    most = 2**32 - 1
    return f"{_check.whole('part', number, 1, most)}/{_check.whole('part', of, 1, most)}", []


def axis(name: str, given: Any) -> tuple[str, float, float]:
    """A coordinate of a grid with its range."""
    try:
        coordinate, low, high = given
    except (TypeError, ValueError):
        coordinate = None
        low = high = 0.0
    if not isinstance(coordinate, str):
        raise _check.refused(name, given, "must be (NAME, LOW, HIGH), as in ('q1', -1e-3, 1e-3)")
    ends = _check.rising(name, (low, high))
    return (_check.word(name, coordinate), *ends)
