"""All cores of this machine."""

import os
import queue
import subprocess
import sys
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor, wait
from pathlib import Path
from typing import TYPE_CHECKING

from .. import _check

if TYPE_CHECKING:
    from ._batch import Batch


class Local:
    """Processes on this machine, each computing one item after the other on one core.

    They are `python -m hammerbeam.batch item FOLDER -`, so a script needs no guard around its main part. An
    item whose process ends is handed out again, to a new one.

    * `processes`: how many; by default as many as there are cores.
    """

    def __init__(self, processes: int | None = None) -> None:
        self.processes = _check.jobs(processes) or _cores()

    def compute(self, batch: "Batch", numbers: Sequence[int]) -> None:
        """Has items computed; the pool of the standard library hands them out."""
        idle = queue.SimpleQueue[_Process | None]()
        count = min(self.processes, len(numbers))
        for _ in range(count):
            idle.put(None)

        def one(number: int) -> None:
            process = idle.get()
            process = _Process(batch.folder) if process is None else process
            is_alive = process.compute(number)
            idle.put(process if is_alive else None)

        with ThreadPoolExecutor(count) as pool:
            try:
                wait([pool.submit(one, number) for number in numbers])
            finally:
                # On Ctrl-C the processes get it as well, and end.
                pool.shutdown(cancel_futures=True)
                for _ in range(count):
                    process = idle.get()
                    if process is not None:
                        process.close()


class _Process:
    """A process that computes the items whose numbers it is sent."""

    def __init__(self, folder: Path) -> None:
        command = [sys.executable, "-m", "hammerbeam.batch", "item", str(folder), "-"]
        self._process = subprocess.Popen(command, stdin=subprocess.PIPE, stdout=subprocess.PIPE, text=True)

    def compute(self, number: int) -> bool:
        """Has an item computed; false if the process has ended."""
        assert self._process.stdin is not None and self._process.stdout is not None
        try:
            self._process.stdin.write(f"{number}\n")
            self._process.stdin.flush()
            answer = self._process.stdout.readline()
        except OSError:
            answer = ""
        if not answer:
            self._process.wait()
        return bool(answer)

    def close(self) -> None:
        """Lets it end."""
        self._process.communicate()


def _cores() -> int:
    """Cores that this process may use."""
    if hasattr(os, "sched_getaffinity"):
        return len(os.sched_getaffinity(0))
    return os.cpu_count() or 1
