"""HyperQueue: from one workstation to jobs of Slurm and PBS."""

import shutil
import subprocess
import sys
from collections.abc import Sequence
from os import PathLike
from pathlib import Path
from typing import TYPE_CHECKING, Any

from .. import _check
from .._errors import BadInput
from .._tables import needed
from ._folder import json_text, write_whole

if TYPE_CHECKING:
    from ._batch import Batch


class HyperQueue:
    """Workers of a HyperQueue server, each item a task.

    Where the command `hq` is there, it submits a file with one entry for each item, `hq submit
    --from-json`. Without it the package `hyperqueue` does; it needs `client`, or finds the server by
    `server_dir` as the command does.

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
        submit = ["submit", f"--from-json={entries}", f"--name={batch.folder.name}", f"--cpus={self.cpus}"]
        files = ["--stdout=none", f"--stderr={logs}/%{{JOB_ID}}-%{{TASK_ID}}.txt:rm-if-finished", "--wait"]
        task = item_command(batch, self.cpus, "--entry")
        done = subprocess.run(
            [command, *server, *submit, *files, *self.options, "--", *task], capture_output=True, text=True
        )
        # One is also the answer when tasks failed: then the items say so.
        if done.returncode != 0 and "submitted" not in done.stdout:
            raise BadInput(f"hq submit: {(done.stderr or done.stdout).strip()}")

    def _by_package(self, batch: "Batch", numbers: Sequence[int], logs: Path) -> None:
        package, output = needed("hyperqueue", "hyperqueue"), needed("hyperqueue.output", "hyperqueue")
        resources = needed("hyperqueue.ffi.protocol", "hyperqueue").ResourceRequest(cpus=self.cpus)
        try:
            client = package.Client(self.server_dir) if self.client is None else self.client
        except Exception as error:
            place = "" if self.server_dir is None else f" in {self.server_dir}"
            words = str(error).strip().splitlines()
            raise BadInput(f"there is no HyperQueue server{place}: {words[0] if words else error!r}") from None
        job = package.Job(name=batch.folder.name, max_fails=None)
        for number in numbers:
            job.program(
                item_command(batch, self.cpus, str(number)),
                cwd=batch.folder,
                stdout=None,
                stderr=output.StdioDef.remove_if_finished(logs / f"%{{JOB_ID}}-{number}.txt"),
                resources=resources,
            )
        client.wait_for_jobs([client.submit(job)], raise_on_error=False)


def item_command(batch: "Batch", jobs: int, *which: str) -> list[str]:
    """The command that computes items of a batch."""
    threads = [] if jobs == 1 else [f"--jobs={jobs}"]
    return [sys.executable, "-m", "hammerbeam.batch", "item", *threads, str(batch.folder), *which]
