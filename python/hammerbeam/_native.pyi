# Made by python/test.sh from the compiled module: HAMMERBEAM_UPDATE=1 python/test.sh.
"""
What the typed layer takes.
"""

from _typeshed import SupportsGetItem
from os import PathLike
from pathlib import Path
from typing import Any, SupportsFloat, SupportsIndex, final

__all__ = ["NativeOrbits", "NativeResults", "NativeStudy", "version", "write_matrix"]

@final
class NativeOrbits:
    """
    Periodic solutions of a study.
    """
    def __len__(self, /) -> int: ...
    def chosen(self, /, indices: SupportsGetItem[int, SupportsIndex]) -> NativeOrbits:
        """
        Some of them, in the order that is given.
        """
    def nodes(self, /, index: SupportsIndex) -> list[list[float]]:
        """
        Shooting nodes of one of them.
        """
    @property
    def response_point(self, /) -> str:
        """
        Name of the response point.
        """
    def table(self, /) -> tuple[str, list[tuple[str, str, int | None]], int, Any]:
        """
        One row for each.
        """
    def tables_of_all(self, /, samples: SupportsIndex, callbacks: tuple[Any | None, Any | None]) -> list[tuple[str, list[tuple[str, str, int | None]], int, Any]]:
        """
        All of them with their motions.
        """
    def waveform(self, /, index: SupportsIndex, samples: SupportsIndex) -> tuple[str, list[tuple[str, str, int | None]], int, Any]:
        """
        The motion of one of them over its period.
        """

@final
class NativeResults:
    """
    A results folder that is open for reading.
    """
    def branch_rows(self, /) -> list[tuple[int, int, int]]:
        """
        Number of rows of each branch.
        """
    def close(self, /) -> None:
        """
        Lets the folder go.
        """
    @property
    def closed_already(self, /) -> bool: ...
    def draw(self, /, folder: str | PathLike[str], asked: tuple[SupportsGetItem[int, str], SupportsGetItem[int, str], SupportsFloat | SupportsIndex | None], callbacks: tuple[Any | None, Any | None]) -> list[str]:
        """
        Draws figures into a folder: their names.
        """
    def export(self, /, format: str, folder: str | PathLike[str], states: bool) -> list[Path]:
        """
        Writes what is stored as `csv`, `json` or `npz`: the files.
        """
    @staticmethod
    def export_orbits(orbits: NativeOrbits, format: str, folder: str | PathLike[str], samples: SupportsIndex, callbacks: tuple[Any | None, Any | None]) -> list[Path]:
        """
        Writes orbits and their motions as `csv`, `json` or `npz`: the files.
        """
    @property
    def folder(self, /) -> Path: ...
    @staticmethod
    def open(folder: str | PathLike[str]) -> NativeResults:
        """
        Opens a results folder.
        """
    def orbits(self, /, branches: SupportsGetItem[int, SupportsIndex], frequencies_hz: SupportsGetItem[int, SupportsFloat | SupportsIndex], events: SupportsGetItem[int, str]) -> NativeOrbits:
        """
        Stored orbits by branch, frequency and event.
        """
    def request_tables(self, /, request: SupportsIndex) -> list[tuple[str, list[tuple[str, str, int | None]], int, Any]]:
        """
        Tables of one request.
        """
    @property
    def study(self, /) -> NativeStudy:
        """
        The study whose results these are.
        """
    def tables(self, /, name: str, branches: SupportsGetItem[int, SupportsIndex]) -> list[tuple[str, list[tuple[str, str, int | None]], int, Any]]:
        """
        Tables by their names.
        """

@final
class NativeStudy:
    """
    A study with its model.
    """
    def basins(self, /, frequency_hz: SupportsFloat | SupportsIndex, asked: tuple[tuple[str, SupportsFloat | SupportsIndex, SupportsFloat | SupportsIndex], tuple[str, SupportsFloat | SupportsIndex, SupportsFloat | SupportsIndex], SupportsIndex], spent_on: tuple[tuple[SupportsIndex, SupportsIndex, SupportsIndex, SupportsIndex], SupportsIndex | None], kept_in: tuple[str | PathLike[str] | None, str | PathLike[str] | None, tuple[str | None, SupportsGetItem[int, str | PathLike[str]]]], callbacks: tuple[Any | None, Any | None]) -> str:
        """
        Basins over a grid of two coordinates `(name, low, high)`, or a part of them.
        """
    def check(self, /) -> str:
        """
        What `check --json` says.
        """
    @property
    def dof(self, /) -> int: ...
    def lyapunov(self, /, asked: tuple[SupportsFloat | SupportsIndex, SupportsFloat | SupportsIndex, SupportsFloat | SupportsIndex | None], motion: tuple[str, SupportsIndex, SupportsIndex, SupportsIndex], kept_in: tuple[str | PathLike[str] | None, str | PathLike[str] | None], callbacks: tuple[Any | None, Any | None]) -> str:
        """
        Lyapunov exponents over `(from_hz, to_hz, step_hz)`.
        """
    def modes(self, /) -> str:
        """
        What `modes --json` says.
        """
    @property
    def name(self, /) -> str: ...
    def orbits(self, /, frequency_hz: SupportsFloat | SupportsIndex, period_multiple: SupportsIndex, callbacks: tuple[Any | None, Any | None]) -> tuple[NativeOrbits, str | None]:
        """
        All periodic solutions at a frequency, and why the search is not complete, if it is not.
        """
    @staticmethod
    def parse(name: str, text: str) -> NativeStudy:
        """
        Reads a study from a text.
        """
    @property
    def points(self, /) -> list[str]: ...
    @property
    def range_hz(self, /) -> tuple[float, float] | None:
        """
        The range of the excitation frequency [Hz]; `None` without an excitation.
        """
    @staticmethod
    def read(path: str | PathLike[str]) -> NativeStudy:
        """
        Reads a study file.
        """
    def run(self, /, asked: tuple[str | PathLike[str], SupportsGetItem[int, str], SupportsIndex | None, bool], callbacks: tuple[Any | None, Any | None]) -> tuple[str, bool]:
        """
        Runs what is left of the study: its report, and whether it was stopped.
        """
    def simulate(self, /, asked: tuple[tuple[SupportsFloat | SupportsIndex, SupportsIndex, SupportsIndex, SupportsFloat | SupportsIndex | None, SupportsIndex] | None, tuple[SupportsFloat | SupportsIndex, SupportsFloat | SupportsIndex | None] | None], motion: tuple[SupportsFloat | SupportsIndex, str], kept_in: tuple[str | PathLike[str] | None, str | PathLike[str] | None], callbacks: tuple[Any | None, Any | None]) -> str:
        """
        A motion in time: of a study with an excitation `(frequency_hz, transient, periods, duration_s,
        samples)`, where a duration counts before periods; of one without `(duration_s, sampling_hz)`.
        """
    def sweep(self, /, asked: tuple[SupportsFloat | SupportsIndex, SupportsFloat | SupportsIndex, SupportsFloat | SupportsIndex | None], motion: tuple[str, bool, SupportsIndex | None, SupportsIndex], spent_on: tuple[tuple[SupportsIndex, SupportsIndex, SupportsIndex, SupportsIndex], SupportsIndex | None], kept_in: tuple[str | PathLike[str] | None, str | PathLike[str] | None, tuple[str | None, SupportsGetItem[int, str | PathLike[str]]]], callbacks: tuple[Any | None, Any | None]) -> str:
        """
        Settled motions over `(from_hz, to_hz, step_hz)`: carried over from a state, or from so many states;
        of the last also a part.
        """
    @property
    def text(self, /) -> str: ...
    def text_with(self, /, settings: SupportsGetItem[int, str]) -> str:
        """
        The text of this study with other values of keys, in the form of `--set`, which can stand in another
        folder. It is read again; of files of matrices only whether they are there.
        """
    @property
    def title(self, /) -> str: ...

def version() -> str:
    """
    Version of the package.
    """

def write_matrix(path: str | PathLike[str], size: tuple[SupportsIndex, SupportsIndex], rows: bytes, columns: bytes, values: bytes) -> None:
    """
    Writes a matrix in Matrix Market format, every entry as it is given.

    * `rows`, `columns`: of each entry from 0 on, as 8-byte integers; `values`: as 8-byte floats.
    """
