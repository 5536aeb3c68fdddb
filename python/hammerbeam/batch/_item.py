"""Computing one item: what every engine calls, on whatever machine."""

from typing import TYPE_CHECKING

from .._errors import HammerbeamError, Interrupted
from .._study import Study
from ._folder import ItemFolder, Status, write_json
from ._numbers import numbers

if TYPE_CHECKING:
    from ._batch import Batch


def compute_item(batch: "Batch", number: int, jobs: int = 1) -> Status:
    """Computes an item unless it is finished; goes on where a try before was stopped.

    The report is put there last, whole. Why there is none stands in `failure.json`, but for Ctrl-C, which
    raises `Interrupted`.
    """
    folder = batch.item(number)
    if folder.status() is Status.FINISHED:
        return Status.FINISHED
    folder.failure.unlink(missing_ok=True)
    try:
        study = Study.read(folder.study)
        report = batch.task.compute(study, folder.results, batch.part(number), jobs)
        finish(folder, batch, report)
    except (Interrupted, KeyboardInterrupt):
        raise
    except Exception as error:
        # Of an item that another process computes just now nothing is to be said.
        if not isinstance(error, HammerbeamError) or error.name != "Locked":
            _note(folder, error)
    return folder.status()


def compute_whole(batch: "Batch", row: int, jobs: int = 1) -> Status:
    """Puts a study together from its parts, if all of them are finished.

    * `row`: of the table of parameters, counted from 1.
    """
    folder = batch.whole(row)
    parts = [batch.item(number) for number in batch.numbers_of(row)]
    if folder.status() is Status.FINISHED or any(part.status() is not Status.FINISHED for part in parts):
        return folder.status()
    folder.path.mkdir(parents=True, exist_ok=True)
    study = Study.read(parts[0].study)
    report = batch.task.merge(study, [part.results for part in parts], folder.results, jobs)
    finish(folder, batch, report)
    return folder.status()


def finish(folder: ItemFolder, batch: "Batch", report: dict[str, object]) -> None:
    """Writes the report, with the numbers of it that the table of all items shows."""
    # The folder may be moved, and two runs of the same item are to say the same.
    report = {**report, "results": folder.results.name}
    found = numbers(batch.task, report, folder.results)
    write_json(folder.report, {"numbers": found, "report": report})
    folder.failure.unlink(missing_ok=True)


def _note(folder: ItemFolder, error: Exception) -> None:
    name = error.name if isinstance(error, HammerbeamError) else type(error).__name__
    code = error.exit_code if isinstance(error, HammerbeamError) else 1
    write_json(folder.failure, {"error": name, "exit_code": code, "message": str(error)})
