"""Exceptions: one tree, with the names and the numbers of the errors in Rust.

`BadInput` is what exit code 2 of the command is, `NoResult` what 1 is. A class below them that can be
either, such as `StoreError`, says which by its `exit_code`.
"""

from collections.abc import Mapping
from typing import Any


class HammerbeamError(Exception):
    """Why there is no result.

    * `exit_code`: that of the command: 1 no result, 2 bad input.
    * `name`: the name of the error in Rust, such as `OtherStudy`.
    * `numbers`: what the message says, as values: frequencies found and allowed, pieces that are done.
    """

    exit_code: int = 1
    name: str = ""
    numbers: Mapping[str, Any] = {}

    def __init__(
        self,
        message: str,
        *,
        exit_code: int | None = None,
        name: str | None = None,
        numbers: Mapping[str, Any] | None = None,
    ) -> None:
        super().__init__(message)
        self.exit_code = type(self).exit_code if exit_code is None else exit_code
        self.name = type(self).__name__ if name is None else name
        self.numbers = {} if numbers is None else numbers

    def __reduce__(self) -> tuple[Any, ...]:
        keywords = {"exit_code": self.exit_code, "name": self.name, "numbers": self.numbers}
        return _again, (type(self), str(self), keywords)


def _again(error: type[HammerbeamError], message: str, keywords: Mapping[str, Any]) -> HammerbeamError:
    """An error that comes out of another process."""
    return error(message, **keywords)


class BadInput(HammerbeamError, ValueError):
    """What was given is not right."""

    exit_code = 2


class NoResult(HammerbeamError):
    """There is nothing to give."""


class StudyError(BadInput):
    """A study has faults, or cannot be read. `problems` has each with its line, key, message and help."""

    @property
    def problems(self) -> list[dict[str, Any]]:
        """The faults: `file`, `line`, `column`, `key`, `message`, `help`."""
        return list(self.numbers.get("problems", []))


class InitialStateError(BadInput):
    """A motion cannot begin at a state."""


class CoordinateError(BadInput):
    """A grid has no such coordinate."""


class FallingFrequencies(BadInput):
    """The last frequency of a series is below its first."""


class SimulationTooLarge(BadInput):
    """A motion takes too much of memory or of the disk."""


class Drifts(BadInput):
    """Nothing holds the structure in a direction."""


class FrequencyNotResolved(BadInput):
    """The range of the excitation reaches too high."""


class ClosedResults(BadInput):
    """Results are asked for something after they were closed."""


class NoSearch(NoResult):
    """No periodic solution could be looked for."""


class RunError(NoResult):
    """A run cannot go on."""


class DrawingError(NoResult):
    """Something is not drawn."""


class StoreError(HammerbeamError):
    """A results folder cannot be used."""


class ExportError(HammerbeamError):
    """A table cannot be written."""


class WriteError(HammerbeamError):
    """A file cannot be written."""


class AttractorError(HammerbeamError):
    """A motion cannot be computed, or what is asked of it makes no sense."""


class HammerbeamWarning(UserWarning):
    """Something to know although the work goes on."""


class Interrupted(KeyboardInterrupt):
    """Ctrl-C: what was finished is kept, and the same call goes on from there."""

    exit_code: int = 130
    name: str = "Interrupted"

    def __init__(self, message: str, **_: Any) -> None:
        super().__init__(message)
