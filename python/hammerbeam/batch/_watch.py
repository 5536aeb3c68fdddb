"""How far a batch is while an engine computes it."""

import sys
import threading
import time
from collections.abc import Iterator, Sequence
from contextlib import contextmanager
from typing import TYPE_CHECKING

from .._progress import Report
from ._folder import Status

if TYPE_CHECKING:
    from ._batch import Batch

_LOOK_S = 1.0
_LINE_S = 10.0


@contextmanager
def followed(batch: "Batch", numbers: Sequence[int], report: Report | None) -> Iterator[None]:
    """Looks into the folders of items once a second, whichever engine computes them, and reports the part
    that is done."""
    if report is None:
        yield
        return
    done = threading.Event()

    def look() -> None:
        left = list(numbers)
        while not done.wait(_LOOK_S):
            left = [number for number in left if batch.item(number).status() is not Status.FINISHED]
            finished = len(numbers) - len(left)
            report(finished / len(numbers), f"{finished} of {len(numbers)} items are finished")

    thread = threading.Thread(target=look, daemon=True)
    thread.start()
    try:
        yield
    finally:
        done.set()
        thread.join()


class Lines:
    """Where nobody looks, into a file: a line on standard error every ten seconds."""

    def __init__(self) -> None:
        self._last = time.monotonic()

    def __call__(self, fraction: float | None, text: str) -> None:
        """Writes a line if the last one is ten seconds old."""
        if time.monotonic() - self._last >= _LINE_S:
            self._last = time.monotonic()
            print(text if fraction is None else f"{100 * fraction:5.1f} %  {text}", file=sys.stderr)
