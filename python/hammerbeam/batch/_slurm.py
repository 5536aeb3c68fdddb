"""A job array of Slurm: a script to hand to `sbatch`."""

import shlex
from collections.abc import Sequence
from os import PathLike
from typing import TYPE_CHECKING

from .. import _check
from .._errors import BadInput
from .._files import write_whole
from ._hyperqueue import item_command

if TYPE_CHECKING:
    from pathlib import Path

    from ._batch import Batch


def slurm_script(
    batch: "Batch",
    path: str | PathLike[str] | None = None,
    *,
    cpus: int = 1,
    tasks: int = 1000,
    options: Sequence[str] = (),
) -> "Path":
    """Writes the script of a job array over the items that are not finished, `slurm.sh` in the batch folder.

    Run it with `sbatch slurm.sh`; written again later it has what is missing then.

    * `cpus`: cores of an item.
    * `tasks`: at most so many tasks of the array: Slurm allows 1000 unless it is set up otherwise. With
      more items than that a task computes several, one after the other.
    * `options`: lines for Slurm, such as `["--time=01:00:00", "--partition=long"]`.
    """
    # Imported here: a batch is run by engines, and one of them is this.
    from ._batch import Batch

    if not isinstance(batch, Batch):
        raise _check.refused("batch", batch, "must be a Batch")
    threads = _check.whole("cpus", cpus, 1, _check.MOST_JOBS)
    size = -(-len(batch) // _check.whole("tasks", tasks, 1, 4_000_000))
    wanted = sorted({(number - 1) // size for number in batch.missing()})
    if not wanted:
        raise BadInput("all items are finished: there is nothing to hand to Slurm")
    logs = batch.folder / "slurm"
    logs.mkdir(exist_ok=True)
    # Slurm takes `%` in a path for a number of its own unless it stands twice, and quotes as a shell does.
    output = f"{logs}".replace("%", "%%") + "/%A-%a.txt"
    lines = [
        f"--job-name={shlex.quote(batch.folder.name)}",
        f"--array={_ranges(wanted)}",
        f"--cpus-per-task={threads}",
        f"--output={shlex.quote(output)}",
        *(_check.words("options", options) if options else []),
    ]
    head = "".join(f"#SBATCH {line}\n" for line in lines)
    first, last = f"SLURM_ARRAY_TASK_ID * {size} + 1", f"(SLURM_ARRAY_TASK_ID + 1) * {size}"
    command = shlex.join(item_command(batch, threads))
    text = f'#!/bin/bash\n{head}\nexec {command} "$(({first}))-$(({last}))"\n'
    script = batch.folder / "slurm.sh" if path is None else _check.folder("path", path)
    write_whole(script, text)
    return script


def _ranges(numbers: Sequence[int]) -> str:
    """Rising numbers as Slurm takes them: `0-3,7,9-12`."""
    ranges = list[list[int]]()
    for number in numbers:
        if ranges and number == ranges[-1][1] + 1:
            ranges[-1][1] = number
        else:
            ranges.append([number, number])
    return ",".join(f"{low}" if low == high else f"{low}-{high}" for low, high in ranges)
