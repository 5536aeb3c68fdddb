"""What is computed of each item."""

import inspect
import json
import math
from collections.abc import Mapping, Sequence
from dataclasses import dataclass, field
from pathlib import Path
from typing import Any

import numpy as np

from .. import _check
from .._errors import BadInput
from .._results import Results
from .._study import Study

_METHODS = ("run", "simulate", "sweep", "lyapunov", "basins")
_OWN = ("self", "out", "jobs", "progress", "parts", "part", "results")


@dataclass(frozen=True)
class Task:
    """A method of `Study` and what it is given. Made by `Task.run()`, `Task.sweep(...)` and so on.

    * `method`: its name.
    * `options`: its keyword arguments.
    * `parts`: items into which every study is cut: of basins the cells, of a sweep with `starts` the
      frequencies.
    """

    method: str = "run"
    options: Mapping[str, Any] = field(default_factory=dict)
    parts: int = 1

    def __post_init__(self) -> None:
        if not isinstance(self.method, str) or self.method not in _METHODS:
            raise _check.unknown("task", self.method, _METHODS)
        if not isinstance(self.options, Mapping):
            raise _check.refused("options", self.options, "must be a dictionary of keyword arguments")
        _check.whole("parts", self.parts, 1, 100_000)
        allowed = inspect.signature(getattr(Study, self.method)).parameters
        plain = {name: _plain(name, value) for name, value in self.options.items()}
        object.__setattr__(self, "options", plain)
        for name in self.options:
            if name in _OWN or name not in allowed:
                known = ", ".join(other for other in allowed if other not in _OWN)
                raise BadInput(f"{name}: {self.method} of many studies does not take this; allowed: {known}")
        if self.parts > 1 and self.method == "sweep" and self.options.get("starts") is None:
            raise BadInput("parts: a sweep with the state carried over has none; allowed: with starts")

    @classmethod
    def run(cls, *, figures: bool = False) -> "Task":
        """Everything that the study asks for."""
        return cls("run", {"figures": _check.flag("figures", figures)})

    @classmethod
    def simulate(cls, frequency_hz: float | None = None, **options: Any) -> "Task":
        """A motion in time."""
        return cls("simulate", {"frequency_hz": frequency_hz, **options})

    @classmethod
    def sweep(cls, *, parts: int = 1, **options: Any) -> "Task":
        """Settled motions over the frequency; with `starts` also by parts."""
        return cls("sweep", options, parts)

    @classmethod
    def lyapunov(cls, frequency_hz: float, **options: Any) -> "Task":
        """Lyapunov exponents."""
        return cls("lyapunov", {"frequency_hz": frequency_hz, **options})

    @classmethod
    def basins(cls, frequency_hz: float, x: Any, y: Any, *, parts: int = 1, **options: Any) -> "Task":
        """Basins of attraction, also by parts."""
        for name, axis in (("x", x), ("y", y)):
            if isinstance(axis, str) or not isinstance(axis, Sequence):
                must = "must be (NAME, LOW, HIGH), as in ('q1', -1e-3, 1e-3)"
                raise _check.refused(name, axis, must)
        return cls("basins", {"frequency_hz": frequency_hz, "x": x, "y": y, **options}, parts)

    @classmethod
    def from_document(cls, document: Mapping[str, Any]) -> "Task":
        """The task that `document` describes."""
        if not isinstance(document, Mapping) or not {"method", "options", "parts"} <= set(document):
            raise _check.refused("task", document, "must have method, options and parts")
        return cls(document["method"], document["options"], document["parts"])

    def document(self) -> dict[str, Any]:
        """The task as plain data."""
        try:
            json.dumps(self.options)
        except TypeError as error:
            raise BadInput(
                f"options: {error}; allowed: numbers, words, and lists and dictionaries of them"
            ) from None
        return {"method": self.method, "options": dict(self.options), "parts": self.parts}

    def compute(self, study: Study, out: Path, part: int, jobs: int) -> dict[str, Any]:
        """Computes it, or what is left of it, into a folder: the report of the command.

        * `part`: which of the parts, counted from 1.
        """
        if self.parts > 1:
            method = getattr(study, f"{self.method}_part")
            report: dict[str, Any] = method(
                (part, self.parts), out, jobs=jobs, progress=False, **self.options
            )
            return report
        return self._whole(study, out, {"jobs": jobs})

    def merge(self, study: Study, folders: list[Path], out: Path, jobs: int) -> dict[str, Any]:
        """The whole from the folders of its parts."""
        return self._whole(study, out, {"jobs": jobs, "parts": folders})

    def _whole(self, study: Study, out: Path, given: dict[str, Any]) -> dict[str, Any]:
        if self.method in ("simulate", "lyapunov"):
            del given["jobs"]
        found = getattr(study, self.method)(out=out, progress=False, **given, **self.options)
        if isinstance(found, Results):
            found.close()
        return dict(found.report)


def _plain(name: str, value: Any) -> Any:
    """An option as plain data, which is kept as JSON: numbers of NumPy as numbers, arrays as lists."""
    if isinstance(value, (np.ndarray, np.generic)):
        value = value.tolist()
    if name == "frequency_hz" and value is not None:
        return _check.frequency(name, value)
    if isinstance(value, Mapping):
        return {str(key): _plain(name, entry) for key, entry in value.items()}
    if isinstance(value, (list, tuple)):
        return [_plain(name, entry) for entry in value]
    if isinstance(value, float) and not math.isfinite(value):
        raise _check.refused(name, value, "must be a finite number")
    return value
