"""A batch: planning it, how far it is, computing what is missing."""

import csv
import shutil
from collections.abc import Iterator, Mapping, Sequence
from io import StringIO
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Protocol

from .._files import write_whole
from .. import _check
from .._errors import BadInput
from .._progress import Progress, interruptible, watched
from .._study import Study
from ._folder import Counts, ItemFolder, Status, json_text, read_json
from ._item import compute_item, compute_whole
from ._parameters import Parameters
from ._task import Task
from ._watch import followed

if TYPE_CHECKING:
    from ._gather import Gathered

AnyPath = str | PathLike[str]
_VERSION = 1


class Engine(Protocol):
    """Has items computed, by processes of its own."""

    def compute(self, batch: "Batch", numbers: Sequence[int]) -> None:
        """Returns when it has done with all of them, whatever came of them."""


class Batch:
    """A batch folder: a study, a table of parameters, and for each row an item, or several parts.

    Made by `Batch.plan`; `Batch(folder)` opens one that is there.

    * `folder`: the folder.
    * `parameters`: the table.
    * `task`: what is computed of each item.
    """

    def __init__(self, folder: AnyPath) -> None:
        self.folder = _check.folder("folder", folder).absolute()
        plan = self.folder / "batch.json"
        if not plan.is_file() or not (self.folder / "items").is_dir():
            raise BadInput(f"{self.folder} is no batch folder: it has no batch.json with items beside it")
        document = read_json(plan)
        if document.get("version") != _VERSION:
            message = f"{plan} has the version {document.get('version')}, this program reads {_VERSION}"
            raise BadInput(message)
        try:
            self.task = Task.from_document(document["task"])
        except (KeyError, TypeError) as error:
            raise BadInput(f"{plan} is damaged: it has no task") from error
        self.parameters = Parameters.read(self.folder / "parameters.csv")

    @classmethod
    def plan(
        cls, folder: AnyPath, study: AnyPath | Study, parameters: Parameters, task: Task | None = None
    ) -> "Batch":
        """Makes a batch folder with a study file for each item; nothing is computed.

        Every study is read as the command reads it, so a key or a value that is not allowed raises
        `StudyError` here. A folder that holds the same batch already is opened.
        """
        if not isinstance(parameters, Parameters):
            raise _check.refused("parameters", parameters, "must be Parameters")
        if task is not None and not isinstance(task, Task):
            raise _check.refused("task", task, "must be a Task")
        place = _check.folder("folder", folder).absolute()
        if any(path.is_file() for path in (place, *place.parents)):
            raise BadInput(f"folder: {place} is a file, or lies in one; must be a folder")
        given = study.placed(place) if isinstance(study, Study) else Study.read(study)
        wanted = Task.run() if task is None else task
        plan = {"version": _VERSION, "task": wanted.document()}
        files = {
            "batch.json": json_text(plan),
            "parameters.csv": _csv(parameters),
            "study.toml": given.text_with({}),
        }
        if (place / "items").exists():
            _refuse_other(place, files)
            return cls(place)
        texts = (given.text_with(parameters.settings(row)) for row in range(len(parameters)))
        planned = place / "items.planned"
        shutil.rmtree(planned, ignore_errors=True)
        _write_items(planned, texts, wanted.parts)
        for name, text in files.items():
            write_whole(place / name, text)
        # Last: a folder without items is no batch.
        planned.rename(place / "items")
        return cls(place)

    def __len__(self) -> int:
        """Number of items."""
        return len(self.parameters) * self.task.parts

    def item(self, number: int) -> ItemFolder:
        """The folder of an item, counted from 1."""
        return ItemFolder.of(self.folder / "items", _check.whole("item", number, 1, len(self)))

    def row(self, number: int) -> int:
        """The row of the table, counted from 1, that an item belongs to."""
        return (_check.whole("item", number, 1, len(self)) - 1) // self.task.parts + 1

    def part(self, number: int) -> int:
        """Which part of its study an item is, counted from 1."""
        return (_check.whole("item", number, 1, len(self)) - 1) % self.task.parts + 1

    def numbers_of(self, row: int) -> range:
        """The items of a row of the table, counted from 1."""
        place = _check.whole("row", row, 1, len(self.parameters))
        return range((place - 1) * self.task.parts + 1, place * self.task.parts + 1)

    def whole(self, row: int) -> ItemFolder:
        """The folder of a row's result: its item, or what its parts are put together to."""
        if self.task.parts == 1:
            return self.item(row)
        return ItemFolder.of(self.folder / "merged", _check.whole("row", row, 1, len(self.parameters)))

    def statuses(self) -> list[Status]:
        """How far each item is."""
        return [self.item(number).status() for number in range(1, len(self) + 1)]

    def counts(self) -> Counts:
        """How many items are how far."""
        return Counts.of(self.statuses())

    def missing(self) -> list[int]:
        """Numbers of the items that are not finished."""
        return [number for number, status in enumerate(self.statuses(), 1) if status is not Status.FINISHED]

    def failures(self) -> dict[int, str]:
        """Why items failed, by their numbers."""
        failed = (number for number, status in enumerate(self.statuses(), 1) if status is Status.FAILED)
        return {number: str(read_json(self.item(number).failure).get("message")) for number in failed}

    def run(
        self, engine: Engine | None = None, *, attempts: int = 3, progress: Progress = None
    ) -> Counts:
        """Has all items computed that are not finished, on all cores of this machine by default.

        Items that are neither finished nor failed afterwards were lost with a process or a machine; they
        are handed out again, until `attempts` times in a row nothing was finished. Those that failed are
        tried again by the next call.
        """
        from ._local import Local

        chosen = Local() if engine is None else engine
        left = self.missing()
        most = tries = _check.whole("attempts", attempts, 1, 1000)
        while left and tries:
            kept = f"what was computed is kept in {self.folder}, the same call goes on from there"
            with interruptible(kept), watched(progress) as (report, _), followed(self, left, report):
                chosen.compute(self, left)
            lost = [
                number for number in left if self.item(number).status() in (Status.STARTED, Status.MISSING)
            ]
            tries = most if len(lost) < len(left) else tries - 1
            left = lost
        return self.counts()

    def compute(self, number: int, jobs: int = 1) -> Status:
        """Computes one item here: what engines call."""
        return compute_item(self, _check.whole("item", number, 1, len(self)), jobs)

    def merge(self, jobs: int | None = None) -> Counts:
        """Puts studies together whose parts are all finished. Does what one process would do, to the same
        bytes."""
        threads = _check.jobs(jobs) or 1
        rows = range(1, len(self.parameters) + 1)
        if self.task.parts == 1:
            return self.counts()
        return Counts.of([compute_whole(self, row, threads) for row in rows])

    def gather(self) -> "Gathered":
        """One table of all rows of the parameters, with what came of them in few numbers."""
        from ._gather import Gathered

        self.merge()
        return Gathered(self)

    def results(self) -> Iterator[tuple[int, Path]]:
        """Rows of the table, counted from 1, that are finished, with their results folders."""
        for row in range(1, len(self.parameters) + 1):
            folder = self.whole(row)
            if folder.status() is Status.FINISHED:
                yield row, folder.results

    def __repr__(self) -> str:
        return f"<Batch {self.folder}: {self.counts()}>"


def _csv(parameters: Parameters) -> str:
    out = StringIO()
    writer = csv.writer(out, lineterminator="\n")
    writer.writerow(parameters.keys)
    writer.writerows(parameters.rows)
    return out.getvalue()


def _write_items(place: Path, texts: Iterator[str], parts: int) -> None:
    """A study file for each item. By one thread: several wait for one another in the journal of the disk."""
    shared = set[Path]()
    for number, text in enumerate((text for text in texts for _ in range(parts)), 1):
        folder = ItemFolder.of(place, number)
        if folder.path.parent not in shared:
            folder.path.parent.mkdir(parents=True)
            shared.add(folder.path.parent)
        folder.path.mkdir()
        folder.study.write_bytes(text.encode())


def _refuse_other(place: Path, files: Mapping[str, str]) -> None:
    for name, text in files.items():
        path = place / name
        if not path.is_file() or path.read_bytes() != text.encode():
            raise BadInput(
                f"{place} holds something else than this batch: {name} is another one, or is not there"
            )
