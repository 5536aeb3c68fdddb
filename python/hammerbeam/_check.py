"""Numbers that are given, checked as the options of the command are, with the same words.

What is refused has `numbers`: `found`, and `low` and `high` where a range is allowed.
"""

import os
import sys
from collections.abc import Iterable, Mapping, Sequence
from itertools import islice
from pathlib import Path
from typing import Any, SupportsFloat, SupportsIndex

import numpy as np

from ._errors import BadInput

MOST_JOBS = 65535
MOST = 1e100
"""Ends of a range are at most so far from zero."""


def number(name: str, value: Any) -> float:
    """A finite number."""
    most = sys.float_info.max
    return _between(name, value, (-most, most), "must be a finite number")


def frequency(name: str, value: Any) -> float:
    """A frequency of the excitation [Hz]."""
    return _between(name, value, (1e-10, 1e10), "must be a number of hertz from 1e-10 to 1e10")


def seconds(name: str, value: Any) -> float:
    """A duration [s]."""
    return _between(name, value, (1e-15, 1e15), "must be a number of seconds from 1e-15 to 1e15")


def phase(name: str, value: Any) -> float:
    """A phase [cycles]."""
    return _between(name, value, (0.0, 1.0), "must be a number of cycles from 0 to 1")


def resolution(value: Any) -> float:
    """A resolution of figures [pixels per inch]."""
    return _between("resolution", value, (24.0, 1200.0), "must be 24 to 1200 pixels per inch")


def whole(name: str, value: Any, low: int, high: int) -> int:
    """A whole number in a range."""
    must = f"must be a whole number from {low} to {high}"
    if isinstance(value, (bool, np.bool_)) or not isinstance(value, SupportsIndex):
        raise refused(name, value, must, low=low, high=high)
    try:
        found = value.__index__()
    except TypeError:
        raise refused(name, value, must, low=low, high=high) from None
    if not low <= found <= high:
        raise BadInput(
            f"{name}: {found} is not in {low}..={high}", numbers={"found": found, "low": low, "high": high}
        )
    return found


def flag(name: str, value: Any) -> bool:
    """True or false."""
    if not isinstance(value, (bool, np.bool_)):
        raise refused(name, value, "must be True or False")
    return bool(value)


def jobs(value: Any) -> int | None:
    """A number of threads."""
    return None if value is None else whole("jobs", value, 1, MOST_JOBS)


def folder(name: str, value: Any) -> Path:
    """A path."""
    if not isinstance(value, (str, os.PathLike)):
        raise refused(name, value, "must be a path")
    path = os.fspath(value)
    if not isinstance(path, str) or "\0" in path or not path:
        raise refused(name, path, "must be a path")
    try:
        path.encode()
    except UnicodeEncodeError:
        raise refused(name, path, "must be a path") from None
    return Path(path)


def optional_folder(name: str, value: Any) -> Path | None:
    """A path, or none."""
    return None if value is None else folder(name, value)


def word(name: str, value: str) -> str:
    """A text that is Unicode."""
    try:
        value.encode()
    except UnicodeEncodeError:
        raise refused(name, value, "must be Unicode") from None
    return value


def setting(key: Any, value: Any) -> str:
    """A key of a study with its value, as `--set` has it."""
    if not isinstance(key, str):
        raise refused("key", key, "must be a word")
    if isinstance(value, str):
        return f"{word('key', key)}={word(key, value)}"
    if isinstance(value, np.ndarray) and value.ndim == 0:
        value = value.item()
    if isinstance(value, (Sequence, np.ndarray)):
        parts = (setting("", entry).removeprefix("=") for entry in value)
        return f"{word('key', key)}=[{', '.join(parts)}]"
    if isinstance(value, (bool, np.bool_)):
        return f"{word('key', key)}={'true' if value else 'false'}"
    if isinstance(value, SupportsIndex):
        return f"{word('key', key)}={value.__index__()}"
    return f"{word('key', key)}={number(key, value)!r}"


def words(name: str, value: Any) -> list[str]:
    """A word or several."""
    if isinstance(value, str):
        return [word(name, value)]
    if isinstance(value, Sequence) and all(isinstance(one, str) for one in value):
        return [word(name, one) for one in value]
    raise refused(name, value, "must be a word or a list of words")


def entries(name: str, value: Any, must: str, most: int = 1_000_000) -> list[Any]:
    """What a list or an array holds, or whatever else gives one thing after the other, `most` at most."""
    if isinstance(value, (str, bytes, Mapping)):
        raise refused(name, value, must)
    try:
        found = list(islice(iter(value), most + 1))
    except TypeError:
        raise refused(name, value, must) from None
    if len(found) > most:
        raise BadInput(f"{name}: found more than {most}, which are allowed", numbers={"high": most})
    return found


def numbers(name: str, value: Any) -> list[float]:
    """A frequency or several."""
    is_row = isinstance(value, np.ndarray) and value.ndim > 0
    if not is_row and isinstance(value, (SupportsFloat, str)):
        return [frequency(name, value)]
    try:
        entries = list(value)
    except TypeError:
        entries = [value]
    if not entries:
        raise BadInput(f"{name}: found no number")
    return [frequency(name, entry) for entry in entries]


def initial(value: Any) -> str:
    """A state, in the words of `--initial`."""
    if isinstance(value, str):
        return word("initial", value)
    if isinstance(value, Mapping):
        return word(
            "initial", ",".join(f"{key}={number('initial', entry)!r}" for key, entry in value.items())
        )
    array = vector("initial", value)
    return ",".join(repr(float(entry)) for entry in array)


def vector(name: str, value: Any) -> np.ndarray[Any, np.dtype[np.float64]]:
    """A row of numbers."""
    array = _array(name, value)
    if array.ndim != 1:
        raise shaped(name, array, "must have one dimension")
    return array


def _array(name: str, value: Any) -> np.ndarray[Any, np.dtype[np.float64]]:
    try:
        given = np.asarray(value)
    except (TypeError, ValueError) as error:
        raise BadInput(f"{name}: {error}") from error
    if np.ma.is_masked(value):
        raise BadInput(f"{name}: numbers are masked; allowed: numbers everywhere")
    if given.dtype.kind not in "iuf":
        raise BadInput(f"{name}: found an array of {given.dtype}, must be real numbers")
    return given.astype(np.float64)


def _between(name: str, value: Any, ends: tuple[float, float], must: str) -> float:
    """A number in a range, both ends among it."""
    low, high = ends
    if isinstance(value, (bool, np.bool_, np.complexfloating, str, bytes)) or not isinstance(value, SupportsFloat):
        raise refused(name, value, must, low=low, high=high)
    try:
        found = float(value)
    except (TypeError, ValueError, OverflowError):
        raise refused(name, value, must, low=low, high=high) from None
    if not low <= found <= high:
        raise refused(name, found, must, low=low, high=high)
    return found


def rising(name: str, ends: Any) -> tuple[float, float]:
    """A range of numbers, the lower end first."""
    try:
        low, high = ends
    except (TypeError, ValueError):
        raise refused(name, ends, "must be (LOW, HIGH)") from None
    low, high = number(name, low), number(name, high)
    if max(abs(low), abs(high)) > MOST:
        numbers = {"found": [low, high], "low": -MOST, "high": MOST}
        raise BadInput(f"{name}: must be numbers from -1e100 to 1e100", numbers=numbers)
    if high <= low:
        message = f"{name}: the range {low}..{high} is empty; LOW must be below HIGH"
        raise BadInput(message, numbers={"found": [low, high]})
    return low, high


def refused(name: str, value: Any, must: str, **allowed: float) -> BadInput:
    """The error of a value: what was found and what must be, in words and as numbers."""
    return BadInput(f"{name}: found {value!r}, {must}", numbers={"found": _plain(value), **allowed})


def unknown(what: str, value: Any, allowed: Iterable[str]) -> BadInput:
    """The error of a word that is none of those that are allowed."""
    known = list(allowed)
    numbers = {"found": _plain(value), "allowed": known}
    return BadInput(f"there is no {what} {value!r}; allowed: {', '.join(known)}", numbers=numbers)


def shaped(name: str, array: Any, must: str) -> BadInput:
    """The error of an array of another shape."""
    message = f"{name}: found an array of shape {tuple(array.shape)}, {must}"
    return BadInput(message, numbers={"shape": [int(size) for size in array.shape]})


def _plain(value: Any) -> Any:
    """A value as it can be kept with an error and go to another process: else as it is shown."""
    if isinstance(value, np.generic):
        value = value.item()
    return value if value is None or isinstance(value, (bool, int, float, str)) else repr(value)
