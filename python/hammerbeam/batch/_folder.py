"""The files of a batch folder, and what they say of an item."""

import enum
import json
import os
from collections.abc import Iterable
from dataclasses import dataclass
from pathlib import Path
from typing import Any

from .._errors import BadInput
from .._files import write_whole

ITEMS_A_FOLDER = 100
"""Items that share a folder below `items`: ten thousand of them are a hundred folders of a hundred."""


class Status(enum.Enum):
    """How far an item is.

    `FINISHED` needs its product: the results, and the report that is put beside them, whole, as the last
    thing. `FAILED`: the last try says why in `failure.json`. `STARTED`: there are results without a report,
    of an item that is computed just now or was stopped. `MISSING`: nothing is there.
    """

    FINISHED = "finished"
    FAILED = "failed"
    STARTED = "started"
    MISSING = "missing"


@dataclass(frozen=True)
class Counts:
    """How many items are how far."""

    finished: int
    failed: int
    started: int
    missing: int

    @classmethod
    def of(cls, statuses: Iterable[Status]) -> "Counts":
        """Counts them."""
        all_of_them = list(statuses)
        return cls(*(all_of_them.count(status) for status in Status))

    @property
    def items(self) -> int:
        """All of them."""
        return self.finished + self.failed + self.started + self.missing

    def __str__(self) -> str:
        rest = f"{self.failed} failed, {self.started} started, {self.missing} missing"
        return f"{self.finished} of {self.items} items are finished, {rest}"


@dataclass(frozen=True)
class ItemFolder:
    """The folder of an item, or of a study that was put together from its parts."""

    path: Path

    @classmethod
    def of(cls, parent: Path, number: int) -> "ItemFolder":
        """That of a number, counted from 1, in a shared folder such as `000101-000200`."""
        first = (number - 1) // ITEMS_A_FOLDER * ITEMS_A_FOLDER + 1
        shared = f"{first:06d}-{first + ITEMS_A_FOLDER - 1:06d}"
        return cls(parent / shared / f"{number:06d}")

    @property
    def study(self) -> Path:
        """The study file."""
        return self.path / "study.toml"

    @property
    def results(self) -> Path:
        """The results folder."""
        return self.path / "results"

    @property
    def report(self) -> Path:
        """What came of it, written when it was finished."""
        return self.path / "report.json"

    @property
    def failure(self) -> Path:
        """Why the last try gave nothing."""
        return self.path / "failure.json"

    def status(self) -> Status:
        """How far it is."""
        database = self.results / "results.db"
        if database.is_file() and _is_whole(self.report):
            return Status.FINISHED
        if self.failure.is_file():
            return Status.FAILED
        return Status.STARTED if database.is_file() else Status.MISSING


def _is_whole(report: Path) -> bool:
    """Whether a report is there and ends as it was written; the whole of it is read only when gathered."""
    try:
        with report.open("rb") as file:
            file.seek(0, os.SEEK_END)
            file.seek(max(file.tell() - 2, 0))
            return file.read() == b"}\n"
    except OSError:
        return False


def json_text(document: Any) -> str:
    """Plain data as text."""
    return json.dumps(document, indent=1, ensure_ascii=False) + "\n"


def write_json(path: Path, document: Any) -> None:
    """Writes plain data, whole or not at all."""
    write_whole(path, json_text(document))


def read_json(path: Path) -> Any:
    """Plain data from a file, a dictionary; `BadInput` with its name where the file is damaged."""
    try:
        document = json.loads(path.read_text(encoding="utf-8"))
    except OSError as error:
        raise BadInput(f"{path}: {error.strerror or error}") from error
    except ValueError as error:
        raise BadInput(f"{path} is damaged: {error}") from error
    if not isinstance(document, dict):
        raise BadInput(f"{path} is damaged: it holds no table")
    return document
