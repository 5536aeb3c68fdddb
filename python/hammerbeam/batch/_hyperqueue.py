"""HyperQueue: from one workstation to jobs of Slurm and PBS."""

import shutil
import subprocess
import sys
import uuid
from collections.abc import Sequence
from concurrent.futures import ThreadPoolExecutor
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any

from .._files import write_whole
from .. import _check
from .._errors import BadInput
from .._tables import needed
from ._folder import json_text

if TYPE_CHECKING:
    from ._batch import Batch


class HyperQueue:
    """Workers of a HyperQueue server, each item a task.

    Where the command `hq` is there, it submits a file with one entry for each item, `hq submit
    --from-json`. Without it the package `hyperqueue` does; it needs `client`, or finds the server by
    `server_dir` as the command does.

    On Ctrl-C, or an error, tasks that are left are cancelled. Without `hq` those that are computed just then
    are finished, since the package cannot cancel a job.

    * `server_dir`: the folder of the server.
    * `client`: a `hyperqueue.Client`, as from its `LocalCluster`; then the command is not used.
    * `cpus`: cores of a task.
    * `options`: further options of `hq submit`, such as `["--time-limit=1h"]`.
    """

    def __init__(
        self,
        server_dir: str | PathLike[str] | None = None,
        *,
        client: Any = None,
        cpus: int = 1,
        options: Sequence[str] = (),
    ) -> None:
        self.server_dir = _check.optional_folder("server_dir", server_dir)
        self.client = client
        self.cpus = _check.whole("cpus", cpus, 1, _check.MOST_JOBS)
        self.options = _check.words("options", options) if options else []

    def compute(self, batch: "Batch", numbers: Sequence[int]) -> None:
        """Submits items and waits for them."""
        command = shutil.which("hq") if self.client is None else None
        logs = batch.folder / "hyperqueue"
        logs.mkdir(exist_ok=True)
        if command is None:
            self._by_package(batch, numbers, logs)
        else:
            self._by_command(command, batch, numbers, logs)

    def _by_command(self, command: str, batch: "Batch", numbers: Sequence[int], logs: Path) -> None:
        entries = logs / "items.json"
        write_whole(entries, json_text([{"item": number} for number in numbers]))
        server = [] if self.server_dir is None else [f"--server-dir={self.server_dir}"]
        hq = [command, *server, "--output-mode=quiet"]
        submit = ["submit", f"--from-json={entries}", f"--name={batch.folder.name}", f"--cpus={self.cpus}"]
        files = ["--stdout=none", f"--stderr={logs}/%{{JOB_ID}}-%{{TASK_ID}}.txt:rm-if-finished"]
        task = item_command(batch, self.cpus, "--entry")
        with ThreadPoolExecutor(1) as pool:
            # By another thread: on Ctrl-C, which raises in this one, the number of the job is still wanted.
            submitted = pool.submit(_said, [*hq, *submit, *files, *self.options, "--", *task])
            try:
                # One is also the answer when tasks failed: then the items say so.
                subprocess.run([*hq, "job", "wait", submitted.result()], capture_output=True)
            except BaseException:
                if submitted.exception() is None:
                    _said([*hq, "job", "cancel", submitted.result()])
                raise

    def _by_package(self, batch: "Batch", numbers: Sequence[int], logs: Path) -> None:
        package, output = needed("hyperqueue", "hyperqueue"), needed("hyperqueue.output", "hyperqueue")
        resources = needed("hyperqueue.ffi.protocol", "hyperqueue").ResourceRequest(cpus=self.cpus)
        try:
            client = package.Client(self.server_dir) if self.client is None else self.client
        except Exception as error:
            place = "" if self.server_dir is None else f" in {self.server_dir}"
            words = str(error).strip().splitlines()
            said = words[0] if words else repr(error)
            raise BadInput(f"there is no HyperQueue server{place}: {said}") from None
        job = package.Job(name=batch.folder.name, max_fails=None)
        stop = logs / f"stop-{uuid.uuid4().hex}"
        for number in numbers:
            job.program(
                ["sh", "-c", _UNLESS, str(stop), *item_command(batch, self.cpus, str(number))],
                cwd=batch.folder,
                stdout=None,
                stderr=output.StdioDef.remove_if_finished(logs / f"%{{JOB_ID}}-{number}.txt"),
                resources=resources,
            )
        try:
            client.wait_for_jobs([client.submit(job)], raise_on_error=False)
        except BaseException:
            # The package cannot cancel a job: its tasks look for this file before they start.
            stop.touch()
            raise


_UNLESS = 'test -e "$0" || exec "$@"'
"""Script of a shell: a command, unless a file is there."""


def _said(command: Sequence[str]) -> str:
    """What `hq` answers. In a session of its own, Ctrl-C from a terminal does not reach it."""
    done = subprocess.run(command, capture_output=True, text=True, start_new_session=True)
    if done.returncode != 0:
        words = [word for word in command if not word.startswith("-")][1]
        raise BadInput(f"hq {words}: {(done.stderr or done.stdout).strip()}")
    return done.stdout.strip()


def item_command(batch: "Batch", jobs: int, *which: str) -> list[str]:
    """The command that computes items of a batch."""
    threads = [] if jobs == 1 else [f"--jobs={jobs}"]
    return [sys.executable, "-m", "hammerbeam.batch", "item", *threads, str(batch.folder), *which]
